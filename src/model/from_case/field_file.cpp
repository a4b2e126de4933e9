#include "model/from_case/field_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/input_text.hpp"
#include "io/text/point_file.hpp"

namespace perilink {
namespace {

constexpr std::string_view axes = "xyz";

/// Returns "4 x 3".
std::string product_of(const PointField& field) {
  std::string text;
  for (const std::size_t count : field.counts()) {
    if (count > 0) text += fmt::format("{}{}", text.empty() ? "" : " x ", count);
  }
  return text;
}

std::string points_text(const PointField& field) {
  if (field.is_grid()) return fmt::format("is a grid of {} points", product_of(field));
  std::size_t crossings = 1;
  for (const std::size_t count : field.counts()) crossings *= std::max<std::size_t>(count, 1);
  return fmt::format("has {} scattered points{}", field.values().size(),
                     crossings > 1
                         ? fmt::format(" ({} short of a grid of {})",
                                       crossings - field.values().size(), product_of(field))
                         : "");
}

/// Returns "x = 0 to 100, y = 0 to 200".
std::string box_text(const Box& box, int dim) {
  std::string text;
  for (int a = 0; a < dim; ++a) {
    text += fmt::format("{}{} = {:.6g} to {:.6g}", a == 0 ? "" : ", ", axes[a], box.lower[a],
                        box.upper[a]);
  }
  return text;
}

/// Particles outside of the points.
struct Outside {
  Vector3 below{}, above{};  ///< largest distances [length]
  Box body{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  bool all = true;  ///< no particle lies among the points

  Outside(const PointField& field, const Particles& particles) {
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] == ParticleKind::solid) add(field, particles.position(i));
    }
  }

  void add(const PointField& field, std::span<const double> x) {
    constexpr double round_off = 1.0 + 1e-9;
    bool among = true;
    for (std::size_t a = 0; a < x.size(); ++a) {
      const int axis = static_cast<int>(a);
      body.lower[a] = std::min(body.lower[a], x[a]);
      body.upper[a] = std::max(body.upper[a], x[a]);
      const double under = field.box().lower[a] - x[a], over = x[a] - field.box().upper[a];
      if (under > field.margin(axis, false) * round_off) below[a] = std::max(below[a], under);
      if (over > field.margin(axis, true) * round_off) above[a] = std::max(above[a], over);
      among = among && under <= field.margin(axis, false) && over <= field.margin(axis, true);
    }
    all = all && !among;
  }

  std::string text() const {
    std::string sides;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      for (const auto& [sign, far] : {std::pair('-', below[a]), std::pair('+', above[a])}) {
        if (far == 0.0) continue;
        sides += fmt::format("{}{:.4g} at {}{}", sides.empty() ? "" : ", ", far, sign, axes[a]);
      }
    }
    return sides;
  }
};

}  // namespace

std::shared_ptr<const PointField> read_field_file(const CaseFile& input, std::size_t entry) {
  const GradedSection& section = input.fields.graded[entry];
  const std::string path = beside(input.source.path, *section.file);
  std::vector<int> lines;
  try {
    const int dim = dimension_of(input.body);
    PointValues points = read_point_file(path, dim, section.column);
    lines = std::move(points.lines);
    return std::make_shared<const PointField>(std::move(points.positions), std::move(points.values),
                                              dim);
  } catch (const FileError& error) {
    throw InputError(input.where(item_key("graded", entry, "file")), error.what(),
                     "give the path relative to the folder of the case");
  } catch (const UnlikePoints& points) {
    throw InputError(
        {path, lines[points.second], section.column},
        fmt::format("has another value than line {} at the same place", lines[points.first]),
        "keep one of the two points");
  }
}

std::string field_file_note(const CaseFile& input, std::size_t entry, const PointField& field,
                            const Particles& particles) {
  const GradedSection& section = input.fields.graded[entry];
  const Outside outside(field, particles);
  if (outside.all) {
    throw InputError(
        input.where(item_key("graded", entry, "file")),
        fmt::format("names {}, whose points have {}; no particle of the body lies there, but at {}",
                    *section.file, box_text(field.box(), particles.dim),
                    box_text(outside.body, particles.dim)),
        "give coordinates in the unit and the axes of the case");
  }
  const auto [least, most] = std::ranges::minmax(field.values());
  std::string note =
      fmt::format("graded {}: {} {} with values {:.4g} to {:.4g}{}", word_of(section.property),
                  *section.file, points_text(field), least, most,
                  field.is_grid() ? "" : "; every place takes the value of the nearest");
  if (const std::string sides = outside.text(); !sides.empty()) {
    note += fmt::format("; particles lie up to {} outside of them, where the nearest value holds",
                        sides);
  }
  return note;
}

}  // namespace perilink
