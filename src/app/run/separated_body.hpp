#pragma once

#include <optional>
#include <string>

#include "app/model/model.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// \throws InputError where a piece of the solid hangs on bars alone and moves freely on them, as
/// across straight ones; costs a factorisation where a piece hangs on bars alone
void refuse_pieces_on_bars(const CaseFile& input, const Model& model, int threads);

/// Where cracks cut a piece of the body off, so that nothing but their closed bonds holds it: what
/// to tell of it. Costs a factorisation then.
/// \throws InputError where the loads of the beginning pull the piece away, and as above
std::optional<std::string> note_of_separated_body(const CaseFile& input, const Model& model,
                                                  int threads);

}  // namespace perilink
