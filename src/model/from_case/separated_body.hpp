#pragma once

#include <optional>
#include <string>

#include "io/case/case_file.hpp"
#include "model/model.hpp"

namespace perilink {

/// Refuses a piece of the solid that only bars support and that moves freely on them, as on
/// straight parallel bars. Costs a factorisation where only bars support a piece.
/// \throws InputError
void refuse_pieces_on_bars(const CaseFile& input, const Model& model, int threads);

/// Returns a note on a piece of the body that only closed bonds of cracks support. The check of
/// such a piece costs a factorisation.
/// \throws InputError where the first loads pull the piece away or let it slide, or where
///     refuse_pieces_on_bars() refuses it
std::optional<std::string> note_of_separated_body(const CaseFile& input, const Model& model,
                                                  int threads);

}  // namespace perilink
