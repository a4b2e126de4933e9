#pragma once

#include <optional>
#include <string>

#include "app/model/model.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Where cracks cut a piece of the body off, so that nothing but their closed bonds holds it: what
/// to tell of it. Costs a factorisation then.
/// \throws InputError where the loads of the beginning pull the piece away
std::optional<std::string> note_of_separated_body(const CaseFile& input, const Model& model,
                                                  int threads);

}  // namespace perilink
