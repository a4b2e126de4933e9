#pragma once

#include <memory>

#include "app/run/run_kind.hpp"

namespace perilink {

/// Builds the model of a case for the kind of run that it asks for.
/// \param input  must outlive the run
/// \throws InputError where the case makes no sense for its body
std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, bool quiet);

}  // namespace perilink
