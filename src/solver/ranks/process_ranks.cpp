#include "solver/ranks/process_ranks.hpp"

namespace perilink {
namespace {

Ranks* shared_ranks = nullptr;

}  // namespace

Ranks* ranks() { return shared_ranks; }
void set_ranks(Ranks* ranks) { shared_ranks = ranks->count() > 1 ? ranks : nullptr; }

}  // namespace perilink
