#include "app/run/run_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace perilink {
namespace {

/// How many elements end at particles that supports or driven displacements hold.
std::size_t count_at_grips(const Model& model, std::span<const Index> elements) {
  const Bonds& bonds = model.network.bonds;
  return std::count_if(elements.begin(), elements.end(), [&](Index e) {
    return model.gripped[bonds.first[e]] != 0 || model.gripped[bonds.second[e]] != 0;
  });
}

}  // namespace

std::optional<std::string> note_of_grips(const Model& model, std::span<const Index> broken) {
  if (model.network.is_beam()) return std::nullopt;  // moments are largest at loads and supports
  const std::size_t at_grip = count_at_grips(model, broken);
  if (at_grip == 0) return std::nullopt;
  return fmt::format(
      "{} of {} broken bonds end at particles of [[supports]] or [[displacements]]; where the body "
      "should not break there, give it a material with fracture_energy = \"infinite\"; hold planes "
      "of symmetry by [[symmetry]], which this note leaves out",
      at_grip, broken.size());
}

std::optional<std::string> note_of_peaks(const PeakWatch& peaks) {
  if (!peaks.climbed_again()) return std::nullopt;
  return fmt::format(
      "the load reached {:.6g} at displacement {:.6g} (first_peak_load), fell below half of that, "
      "and climbed again, to {:.6g} at {:.6g} (peak_load): this is borne by what was left of the "
      "body",
      peaks.first().load, peaks.first().displacement, peaks.highest().load,
      peaks.highest().displacement);
}

namespace {

/// Whether some bonds of the solid stay whole and others break, and no bar takes the load.
bool has_unbreakable_bonds(const Network& network) {
  if (network.first_tie < network.num_elements()) return false;
  Index whole = 0;
  for (Index b = 0; b < network.num_elements(); ++b) whole += network.can_break(b) ? 0 : 1;
  return whole > 0 && whole < network.num_elements();
}

}  // namespace

std::optional<std::string> note_of_peaks(const DamageResult& result, const Model& model,
                                         std::span<const Index> broken) {
  std::optional<std::string> note = note_of_peaks(result.peaks);
  if (!note && result.dip && has_unbreakable_bonds(model.network)) {
    return fmt::format(
        "the load fell from {:.6g} to {:.6g} and climbed again, to {:.6g} (peak_load): bonds that "
        "cannot break may have stopped the crack",
        result.dip->peak, result.dip->lowest, std::abs(result.peaks.highest().load));
  }
  const std::size_t before = static_cast<std::size_t>(result.broken_as_gave_way);
  if (!note || broken.size() <= before) return note;
  const std::span<const Index> later = broken.subspan(before);
  const auto at_grips = count_at_grips(model, later);
  if (at_grips == 0) return note;
  return fmt::format(
      "{}; {} of the {} bonds that broke since then end at particles of "
      "[[supports]] or [[displacements]]",
      *note, at_grips, later.size());
}

}  // namespace perilink
