#include "app/run/run_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/plain_text.hpp"

namespace perilink {
namespace {

/// Counts elements that end at particles with supports or prescribed displacements.
std::size_t count_at_clamps(const Model& model, std::span<const Index> elements) {
  const Bonds& bonds = model.network.bonds;
  return std::count_if(elements.begin(), elements.end(), [&](Index e) {
    return model.gripped[bonds.first[e]] != 0 || model.gripped[bonds.second[e]] != 0;
  });
}

}  // namespace

std::optional<std::string> note_of_clamps(const Model& model, std::span<const Index> broken) {
  if (model.network.is_beam()) return std::nullopt;  // moments are largest at loads and supports
  const std::size_t at_clamp = count_at_clamps(model, broken);
  if (at_clamp == 0) return std::nullopt;
  return fmt::format(
      "{} of {} at particles of [[supports]] or "
      "[[displacements]]; if the clamps caused these breaks, give the "
      "clamped regions a material with fracture_energy = \"infinite\"; model "
      "planes of symmetry by [[symmetry]], which this note ignores",
      at_clamp, counted(broken.size(), "broken bond ends", "broken bonds end"));
}

std::optional<std::string> text_of_contacts(const Model& model, const EquilibriumOptions& options) {
  if (model.network.num_contacts == 0 || model.network.dim() == 2) return std::nullopt;
  if (options.solver != LinearSolver::automatic || !(options.event_tolerance > 0.0)) {
    return std::nullopt;
  }
  if (model.unknowns.count < fewest_for_subdomains) return std::nullopt;
  return "the faces of pre-cracks may close, which needs the direct solver: closing = false in "
         "[[cracks]], for notches that stay open, allows conjugate gradients with less memory";
}

std::optional<std::string> text_of_peaks(const PeakWatch& peaks, bool bars) {
  if (!peaks.climbed_again()) return std::nullopt;
  return fmt::format(
      "{}the load reached {:.6g} at displacement {:.6g} ({}), it fell or a "
      "crack separated the body, and the load rose again to {:.6g} at {:.6g} "
      "({}){}",
      bars ? "" : "residual strength: ", peaks.first().load, peaks.first().displacement,
      bars ? "first_peak_load" : "peak_load", peaks.highest().load, peaks.highest().displacement,
      bars ? "peak_load" : "largest_load",
      bars ? ""
           : ": the later peak is the residual strength after failure, or comes "
             "from unbreakable parts; it is not the strength of the body");
}

std::optional<std::string> text_of_peaks(const DamageResult& result, const Model& model,
                                         std::span<const Index> broken) {
  const bool bars = model.network.first_slip_spring < model.network.num_elements();
  std::optional<std::string> text = text_of_peaks(result.peaks, bars);
  const std::size_t before = static_cast<std::size_t>(result.broken_as_gave_way);
  if (!text || broken.size() <= before) return text;
  const std::span<const Index> later = broken.subspan(before);
  const auto at_clamps = count_at_clamps(model, later);
  if (at_clamps == 0) return text;
  return fmt::format(
      "{}; {} of the {} at "
      "particles of [[supports]] or [[displacements]]",
      *text, at_clamps,
      counted(later.size(), "bond that broke after the first peak ends",
              "bonds that broke after the first peak end"));
}

}  // namespace perilink
