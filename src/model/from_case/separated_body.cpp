#include "model/from_case/separated_body.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "model/from_case/configure.hpp"
#include "network/rigid_modes.hpp"

namespace perilink {
namespace {

/// Returns the first piece of the solid that is unsupported without some elements; empty: none.
std::string loose_piece(const Model& model, const std::vector<Index>& without) {
  Network open = model.network;
  for (const Index element : without) open.stiffness[element] = 0.0;
  std::vector<std::uint8_t> held;
  for (const Index number : model.unknowns.number) held.push_back(number == no_index);
  for (const Fragment& fragment : find_fragments(open, held)) {
    const bool is_solid = open.particles.kind[fragment.particles.front()] == ParticleKind::solid;
    if (fragment.free_modes == 0 || !is_solid) continue;
    const auto at = open.particles.position(fragment.particles.front());
    return fmt::format("the piece of {} at ({})", counted(fragment.particles.size(), "particle"),
                       joined(at));
  }
  return "";
}

}  // namespace

void refuse_pieces_on_bars(const CaseFile& input, const Model& model, int threads) {
  const Network& network = model.network;
  if (network.bars.bar.empty()) return;
  std::vector<Index> bars(
      static_cast<std::size_t>(network.num_elements() - network.first_slip_spring));
  std::iota(bars.begin(), bars.end(), network.first_slip_spring);
  const std::string piece = loose_piece(model, bars);
  if (piece.empty()) return;
  try {
    require_held_pieces(model, damage_options(input, threads));
  } catch (const SolverError& error) {
    throw InputError(
        input.where(item_key("rebar", 0)),
        fmt::format("only bars hold {}, and it moves freely on them: {}", piece, error.what()),
        "hold the piece with [[supports]] or [[springs]]");
  }
}

std::optional<std::string> note_of_separated_body(const CaseFile& input, const Model& model,
                                                  int threads) {
  refuse_pieces_on_bars(input, model, threads);
  const bool may_close = model.network.has_closing() && model.network.num_contacts > 0;
  if (!may_close) return std::nullopt;
  const std::string piece = loose_piece(model, model.network.contacts());
  if (piece.empty()) return std::nullopt;
  try {
    if (input.analysis.type == AnalysisType::elastic) {
      find_closed_cracks(model, elastic_options(input, threads));
    } else {
      require_held_pieces(model, damage_options(input, threads));
    }
  } catch (const SolverError&) {  // the cracks separate the piece, or the body has no stiffness
    throw InputError(
        input.where(item_key("cracks", 0)),
        fmt::format("cut {} off, and the loads pull it away or let it slide: only closed crack "
                    "faces, which carry pressure and no shear, could hold it",
                    piece),
        "end the cracks inside the body, hold the piece with [[supports]] or "
        "[[springs]], or press the faces together in an earlier one of [[stages]]");
  }
  return fmt::format("cracks cut {} off: only their closed faces hold it{}", piece,
                     input.analysis.type == AnalysisType::elastic
                         ? ""
                         : ", and the run ends where the loads pull it away");
}

}  // namespace perilink
