#include "app/run/peak_note.hpp"

#include <fmt/format.h>

#include "app/run/summary.hpp"

namespace perilink {

std::optional<std::string> note_of_peaks(const PeakWatch& peaks) {
  if (!peaks.climbed_again()) return std::nullopt;
  return fmt::format(
      "the load reached {:.6g} at displacement {:.6g} (first_peak_load), fell below half of that, "
      "and climbed again, to {:.6g} at {:.6g} (peak_load): this is borne by what was left of the "
      "body",
      peaks.first().load, peaks.first().displacement, peaks.highest().load,
      peaks.highest().displacement);
}

std::optional<std::string> note_of_peaks(const DamageResult& result, const Model& model,
                                         std::span<const Index> broken) {
  std::optional<std::string> note = note_of_peaks(result.peaks);
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
