#include "app/report/report_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/plot/plot_body.hpp"
#include "app/report/report_fields.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Share of the smallest and largest values that the colours of a field leave out.
constexpr double outliers = 0.005;

/// A field file as read; only what a report shows is kept.
struct ReportFrame {
  Json facts;                              ///< step, load, broken bonds, time
  std::vector<std::vector<float>> values;  ///< per field, shape (particles)
  std::vector<std::uint8_t> loose;         ///< per particle: its displacement has no meaning
  std::vector<float> bar_stress;           ///< per segment
  Csr elements;
};

/// Ranges of all files of a body.
struct ReportRanges {
  std::vector<NumberRange> whole, inner;  ///< per field
  NumberRange bars;
};

Json facts_of(const VtuGrid& grid) {
  Json facts;
  for (const char* name : {"step", "time", "load_factor", "load", "broken_bonds"}) {
    const double value = grid.field(name, std::nan(""));
    if (!std::isnan(value)) facts[name] = value;
  }
  return facts;
}

ReportFrame read_frame(const VtuGrid& grid, PlotBody& body,
                       const std::vector<ReportField>& fields) {
  ReportFrame frame;
  frame.facts = facts_of(grid);
  for (const ReportField& field : fields) frame.values.push_back(values_of_field(grid, field));
  for (Index i = 0; i < body.size(); ++i) frame.loose.push_back(body.is_loose(i) ? 1 : 0);
  frame.bar_stress.assign(body.bar_stress.begin(), body.bar_stress.end());
  frame.elements = std::move(body.elements);
  return frame;
}

/// Leaves particles out whose values have no meaning: loose ones, ghosts, nodes of bars.
std::vector<float> meaningful(const ReportFrame& frame, std::size_t field,
                              const std::vector<int>& kind) {
  const std::vector<float>& values = frame.values[field];
  std::vector<float> kept;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (frame.loose[i] == 0 && kind[i] == 0) kept.push_back(values[i]);
  }
  return kept;
}

ReportRanges ranges_of(const std::vector<ReportFrame>& frames, std::size_t fields,
                       const std::vector<int>& kind) {
  ReportRanges ranges{std::vector<NumberRange>(fields), std::vector<NumberRange>(fields), {}};
  for (const ReportFrame& frame : frames) {
    for (std::size_t f = 0; f < fields; ++f) {
      const std::vector<float> values = meaningful(frame, f, kind);
      ranges.whole[f].include(range_of(values));
      ranges.inner[f].include(inner_range(values, outliers));
    }
    ranges.bars.include(range_of(frame.bar_stress));
  }
  return ranges;
}

/// Returns the bytes of a file; `facts` gets the numbers of elements and of their corners.
std::string bytes_of(ReportFrame& frame, const ReportRanges& ranges) {
  std::string bytes;
  for (std::size_t f = 0; f < frame.values.size(); ++f) {
    append_steps(bytes, frame.values[f], ranges.whole[f].low, ranges.whole[f].high);
  }
  append_steps(bytes, frame.bar_stress, ranges.bars.low, ranges.bars.high);
  if (frame.elements.rows() > 0) {
    bytes.resize((bytes.size() + 3) / 4 * 4);  // numbers of 32 bits begin at multiples of four
    frame.facts["elements"] = frame.elements.rows();
    frame.facts["corners"] = frame.elements.values.size();
    append_numbers(bytes, std::span<const std::int32_t>(frame.elements.offsets));
    append_numbers(bytes, std::span<const std::int32_t>(frame.elements.values));
  }
  return bytes;
}

/// Returns positions, sizes, kinds, broken bonds with their numbers, and segments of bars.
std::string bytes_of(const PlotBody& body) {
  std::string bytes;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(body.dim); ++axis) {
    std::vector<float> places;
    for (const Vector3& at : body.positions) places.push_back(static_cast<float>(at[axis]));
    append_numbers(bytes, places);
  }
  append_numbers(bytes, std::vector<float>(body.sizes.begin(), body.sizes.end()));
  append_numbers(bytes, std::span<const std::int32_t>(body.kind));
  for (const std::vector<Ends>* lines : {&body.broken_bonds, &body.segments}) {
    std::vector<std::int32_t> first, second;
    for (const auto& [i, j] : *lines) {
      first.push_back(i);
      second.push_back(j);
    }
    append_numbers(bytes, first);
    append_numbers(bytes, second);
  }
  append_numbers(bytes, std::span<const std::int32_t>(body.broken_at));
  return bytes;
}

/// The files of fields.pvd, read one by one.
class FieldFiles {
 public:
  explicit FieldFiles(const fs::path& directory)
      : directory_(directory), entries_(read_pvd((directory / "fields.pvd").string())) {}

  std::size_t size() const { return entries_.size(); }
  std::string path(std::size_t k) const { return (directory_ / entries_[k].file).string(); }

  /// Returns the last file up to a row or time.
  std::size_t at(double time) const {
    std::size_t found = 0;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (entries_[k].time <= time) found = k;
    }
    return found;
  }

  ReportFrame read(std::size_t k, const PlotBody& last, const std::vector<ReportField>& fields) {
    const VtuGrid grid = read_vtu(path(k));
    PlotBody body = read_body(grid, path(k));
    if (body.size() != last.size() || body.segments.size() != last.segments.size()) {
      throw FileError(
          fmt::format("{}: has {} particles and {} segments of bars, but {} has {} and "
                      "{}; the files are not of one run",
                      path(k), body.size(), body.segments.size(), path(size() - 1), last.size(),
                      last.segments.size()));
    }
    ReportFrame frame = read_frame(grid, body, fields);
    for (std::vector<float>& values : frame.values) values.resize(last.positions.size());
    frame.bar_stress.resize(last.bar_stress.size());
    return frame;
  }

 private:
  fs::path directory_;
  std::vector<PvdEntry> entries_;
};

Json pair_of(const NumberRange& range) {
  return range.low <= range.high ? Json{range.low, range.high} : Json{0, 0};
}

Json fields_json(const std::vector<ReportField>& fields, const ReportRanges& ranges,
                 const UnitNames& units) {
  Json list = Json::array();
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const bool share = fields[f].array == "damage";
    list.push_back({{"name", fields[f].name},
                    {"unit", unit_of_quantity(fields[f].array, units)},
                    {"range", pair_of(ranges.whole[f])},
                    {"shown", share ? Json{0, 1} : pair_of(ranges.inner[f])}});
  }
  return list;
}

/// Returns the table of stresses in bars of a field file; empty where there is none.
std::string bar_text(const fs::path& directory, const Json& facts) {
  const fs::path path = directory / fmt::format("bars_{:06.0f}.csv", facts.value("step", 0.0));
  std::error_code error;
  return fs::exists(path, error) ? read_regular_file(path.string()) : "";
}

}  // namespace

std::vector<std::size_t> shown_files(std::size_t count, std::size_t most, std::size_t peak) {
  const std::size_t parts = std::clamp<std::size_t>(most, 3, std::max<std::size_t>(count, 3)) - 1;
  std::set<std::size_t> shown;
  for (std::size_t k = 0; k <= parts && count > 0; ++k) {
    shown.insert((k * (count - 1) + parts / 2) / parts);
  }
  if (shown.contains(peak) || count < 3 || peak >= count) return {shown.begin(), shown.end()};
  // The nearest one between the first and the last makes room.
  const auto distance = [&](std::size_t k) { return k > peak ? k - peak : peak - k; };
  const auto nearest =
      std::ranges::min_element(std::next(shown.begin()), std::prev(shown.end()), {}, distance);
  shown.erase(nearest);
  shown.insert(peak);
  return {shown.begin(), shown.end()};
}

Json report_body(const fs::path& directory, double peak_time, std::size_t most,
                 const UnitNames& units, ReportStreams& streams) {
  if (!fs::exists(directory / "fields.pvd")) return nullptr;
  FieldFiles files(directory);
  if (files.size() == 0) return nullptr;
  const std::string last_path = files.path(files.size() - 1);
  const VtuGrid last_grid = read_vtu(last_path);
  const PlotBody body = read_body(last_grid, last_path);
  const std::vector<ReportField> fields = fields_of(last_grid, body.dim);

  const std::size_t stays = streams.add(bytes_of(body));
  const std::size_t used = streams.texts().back().size();
  std::vector<ReportFrame> frames;
  frames.push_back(files.read(files.size() - 1, body, fields));
  // The last file, with most cracks, says how many of its size there is room for.
  ReportStreams trial;
  trial.add(bytes_of(frames.back(), ranges_of(frames, fields.size(), body.kind)));
  const std::vector<std::size_t> shown =
      shown_files(files.size(), (std::max(most, used) - used) / trial.texts().front().size(),
                  files.at(peak_time));
  frames.clear();
  for (const std::size_t k : shown) frames.push_back(files.read(k, body, fields));
  const ReportRanges ranges = ranges_of(frames, fields.size(), body.kind);

  Json list = Json::array();
  for (ReportFrame& frame : frames) {
    const std::string bytes = bytes_of(frame, ranges);
    frame.facts["stream"] = streams.add(bytes);
    if (const std::string bars = bar_text(directory, frame.facts); !bars.empty()) {
      frame.facts["bars"] = streams.add(bars);
    }
    list.push_back(frame.facts);
  }
  return {{"dimension", body.dim},
          {"spacing", body.spacing},
          {"square", on_square_lattice(body)},
          {"scale", automatic_scale(body)},
          {"particles", body.size()},
          {"broken", body.broken_bonds.size()},
          {"segments", body.segments.size()},
          {"has_bar_stress", !body.bar_stress.empty()},
          {"bar_range", pair_of(ranges.bars)},
          {"stress_unit", unit_of_quantity("stress", units)},
          {"stream", stays},
          {"fields", fields_json(fields, ranges, units)},
          {"files", files.size()},
          {"frames", list}};
}

}  // namespace perilink
