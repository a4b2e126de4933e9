#include "model/body/bar_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/meshes/cell_search.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/toml_tree.hpp"
#include "model/body/groups/drawn_groups.hpp"
#include "model/body/solid_boxes.hpp"

namespace perilink {
namespace {

/// Points this close to a face, in spacings, are inside.
constexpr double inside_tolerance = 1e-6;

/// Distance of the points that are tested along a bar, in spacings.
constexpr double look_step = 0.25;

using Points = std::vector<Vector3>;

/// Returns the part of a box inside the cover.
Box room_of(const CaseFile& input, std::size_t k, int dim) {
  const BarLayout& layout = *input.rebar[k].layout;
  const auto region =
      std::find_if(input.regions.begin(), input.regions.end(),
                   [&](const Region& candidate) { return candidate.name == layout.region; });
  if (!region->group.empty() || region->round) {
    throw InputError(
        input.where(item_key("rebar", k, "inside")),
        fmt::format("is \"{}\", not a box", layout.region),
        "name a region that is a box (`x`, `y`, `z`), or give the `points` of each bar");
  }
  Box room = region->box;
  for (int a = 0; a < dim; ++a) {
    room.lower[a] += layout.cover;
    room.upper[a] -= layout.cover;
    if (room.upper[a] > room.lower[a]) continue;
    throw InputError(input.where(item_key("rebar", k, "cover")),
                     fmt::format("is {}, which leaves no room along {} in \"{}\"", layout.cover,
                                 axis_names[a], layout.region),
                     fmt::format("give less than half its width, {:.6g}",
                                 0.5 * (region->box.upper[a] - region->box.lower[a])));
  }
  return room;
}

/// Returns position k of `number` evenly spaced positions from `lower` to `upper`; a single one
/// lies in the middle.
double even(double lower, double upper, int k, int number) {
  return number == 1 ? 0.5 * (lower + upper) : lower + (upper - lower) * k / (number - 1);
}

/// Lays bars next to a face, parallel to an axis.
std::vector<Points> bars_at_face(const BarLayout& layout, const Box& room, int dim) {
  const int normal = *layout.face % 3, across = 3 - normal - layout.along;
  std::vector<Points> bars;
  for (int k = 0; k < layout.number; ++k) {
    Vector3 from{}, to{};
    from[layout.along] = room.lower[layout.along];
    to[layout.along] = room.upper[layout.along];
    from[normal] = to[normal] = *layout.face < 3 ? room.lower[normal] : room.upper[normal];
    if (dim == 3) {
      from[across] = to[across] = even(room.lower[across], room.upper[across], k, layout.number);
    }
    bars.push_back({from, to});
  }
  return bars;
}

/// Lays stirrups around an axis; in two dimensions straight bars across it.
std::vector<Points> stirrups(const BarLayout& layout, const Box& room, int dim) {
  const int along = layout.along;
  const double length = room.upper[along] - room.lower[along];
  const int number = static_cast<int>(std::ceil(length / *layout.spacing - 1e-9)) + 1;
  const int first = (along + 1) % dim, second = (along + 2) % dim;
  std::vector<Points> bars;
  for (int k = 0; k < number; ++k) {
    Vector3 corner = room.lower;
    corner[along] = even(room.lower[along], room.upper[along], k, number);
    if (dim == 2) corner[2] = 0.0;
    Points bar = {corner};
    const auto go = [&](int axis, const Box& box, bool up) {
      corner[axis] = up ? box.upper[axis] : box.lower[axis];
      bar.push_back(corner);
    };
    go(first, room, true);
    if (dim == 3) {
      go(second, room, true);
      go(first, room, false);
      go(second, room, false);
    }
    bars.push_back(bar);
  }
  return bars;
}

/// Most bars of an entry; more are taken for a typing error.
constexpr double most_bars = 1e5;

void refuse_too_many(const CaseFile& input, std::size_t k, double count) {
  if (count <= most_bars) return;
  const RebarSection& section = input.rebar[k];
  const char* key = section.layout && section.layout->spacing ? "spacing"
                    : section.copies.empty()                  ? "group"
                                                              : "copies";
  throw InputError(input.where(item_key("rebar", k, key)),
                   fmt::format("makes {:.0f} bars; an entry may have {:.0f}", count, most_bars),
                   "check the units, or lay fewer bars");
}

/// Refuses hooks on closed bars, which have no ends.
void refuse_hooks_of_closed(const CaseFile& input, std::size_t k, const Points& bar) {
  if (input.rebar[k].bond.hooks == Hooks::none || bar.front() != bar.back()) return;
  throw InputError(input.where(item_key("rebar", k, "hooks")),
                   fmt::format("is \"{}\", but the bar is closed: it has no ends",
                               word_of(input.rebar[k].bond.hooks)),
                   "delete the key; closed bars are anchored by their corners");
}

/// Returns the bars of an entry before they are copied.
std::vector<Points> first_bars(const CaseFile& input, std::size_t k, const Body& body) {
  const RebarSection& section = input.rebar[k];
  const int dim = body.particles.dim;
  if (!section.group.empty()) {
    return drawn_curves(input, item_key("rebar", k, "group"), section.group, body);
  }
  if (!section.layout) return {section.points};
  const Box room = room_of(input, k, dim);
  if (section.layout->spacing) {
    const int along = section.layout->along;
    refuse_too_many(input, k, (room.upper[along] - room.lower[along]) / *section.layout->spacing);
  }
  return section.layout->face ? bars_at_face(*section.layout, room, dim)
                              : stirrups(*section.layout, room, dim);
}

void copy_bars(const RebarSection& section, std::vector<Points>& bars) {
  for (std::size_t c = 0; c < section.copies.size(); ++c) {
    const std::size_t count = bars.size();
    for (int copy = 1; copy < section.copies[c]; ++copy) {
      for (std::size_t k = 0; k < count; ++k) {
        Points moved = bars[k];
        for (Vector3& point : moved) {
          for (int a = 0; a < 3; ++a) point[a] += copy * section.steps[c][a];
        }
        bars.push_back(std::move(moved));
      }
    }
  }
}

BarBond bond_of(const RebarSection& section) {
  BarBond bond;
  bond.perimeter =
      section.bond.perimeter.value_or(std::sqrt(4.0 * std::numbers::pi * section.area));
  bond.hook_from = section.bond.hooks == Hooks::from || section.bond.hooks == Hooks::both;
  bond.hook_to = section.bond.hooks == Hooks::to || section.bond.hooks == Hooks::both;
  if (section.bond.type == RebarBond::linear) {
    const double strength = section.bond.strength.value_or(*section.bond.stiffness);
    bond.curve = ForceCurve{{{strength / *section.bond.stiffness, strength}}};
    bond.elastic = !section.bond.strength;
  } else if (section.bond.type == RebarBond::curve) {
    bond.curve = ForceCurve{section.bond.curve};
  } else if (section.bond.type == RebarBond::model_code) {
    bond.curve = model_code_curve(section.bond.model_code);
  }
  return bond;
}

/// \param damage  whether bars may yield or slip
/// \param staged  whether loads may decrease
BarMaterial material_of(const RebarSection& section, bool damage, bool staged) {
  BarMaterial material{section.youngs_modulus, section.area};
  material.slip_springs_break = section.bond.slip_springs_break;
  material.bond = bond_of(section);
  if (!damage) material.bond.elastic = true;
  material.bends = section.bends;
  material.shifts = section.prestrain != 0.0;
  if (!section.yields || !damage) return material;
  if (section.yield_strength) material.yield_strength = *section.yield_strength;
  ForceCurve curve{section.curve};
  if (section.yield_strength && (section.hardening_modulus > 0.0 || section.rupture_strain)) {
    // Hardening without rupture_strain extends to a hundred times the yield strain.
    const double yield = *section.yield_strength / section.youngs_modulus;
    const double end = section.rupture_strain.value_or(100.0 * yield);
    curve.points = {{yield, *section.yield_strength},
                    {end, *section.yield_strength + section.hardening_modulus * (end - yield)}};
  }
  const bool yields = section.yield_strength || !curve.points.empty();
  if (yields && staged) material.shifts = true;  // plastic strain remains between stages
  if (curve.points.empty()) return material;
  if (section.rupture_strain) {
    const double end = *section.rupture_strain;
    if (end > curve.points.back()[0]) curve.points.push_back({end, curve.points.back()[1]});
    curve.endless = false;
  }
  material.yield_strength = curve.points.front()[1];
  material.curve = curve;
  return material;
}

/// Returns a test whether a point lies in the body.
std::function<bool(const Vector3&)> inside_of(const CaseFile& input, const Body& body) {
  const double tolerance = inside_tolerance * body.lattice.spacing;
  if (has_cells(input.body)) {
    Mesh mesh;
    mesh.dim = body.particles.dim;
    mesh.positions = body.particles.positions;
    mesh.cells = body.cells.vertices;
    std::vector<Index> all(static_cast<std::size_t>(body.cells.size()));
    std::iota(all.begin(), all.end(), 0);
    // Mesh edges are chords of a curved hole, so points on the curve need the tolerance.
    const auto cells =
        std::make_shared<CellSearch>(mesh, all, 1e-3 * body.lattice.spacing + tolerance);
    return [cells](const Vector3& point) { return cells->contains(point); };
  }
  std::vector<Box> boxes;
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    const std::vector<Box> own = boxes_of(input, m);
    boxes.insert(boxes.end(), own.begin(), own.end());
  }
  const auto dim = static_cast<std::size_t>(body.particles.dim);
  return [boxes, tolerance, dim](const Vector3& point) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
      return box.contains({point.data(), dim}, tolerance);
    });
  };
}

/// Returns the first point of a bar outside the body.
std::optional<Vector3> first_outside(const RebarLine& bar, double step,
                                     const std::function<bool(const Vector3&)>& inside) {
  Points corners = {bar.from};
  corners.insert(corners.end(), bar.bends.begin(), bar.bends.end());
  corners.push_back(bar.to);
  for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece) {
    const Vector3 way = minus(corners[piece + 1], corners[piece]);
    const int count = std::max(1, static_cast<int>(std::ceil(norm(way) / step)));
    for (int k = 0; k <= count; ++k) {
      Vector3 point = corners[piece];
      for (int a = 0; a < 3; ++a) point[a] += way[a] * k / count;
      if (!inside(point)) return point;
    }
  }
  return std::nullopt;
}

}  // namespace

LaidBars lay_bars(const CaseFile& input, const Body& body) {
  LaidBars laid;
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    const RebarSection& section = input.rebar[k];
    std::vector<Points> bars = first_bars(input, k, body);
    for (const Points& bar : bars) refuse_hooks_of_closed(input, k, bar);
    refuse_too_many(input, k,
                    std::accumulate(section.copies.begin(), section.copies.end(),
                                    static_cast<double>(bars.size()), std::multiplies<>()));
    copy_bars(section, bars);
    const BarMaterial material =
        material_of(section, input.analysis.type != AnalysisType::elastic, !input.stages.empty());
    std::function<bool(const Vector3&)> inside;
    if (section.across_gaps) inside = inside_of(input, body);
    for (const Points& points : bars) {
      RebarLine line{points.front(), points.back(), {points.begin() + 1, points.end() - 1}};
      line.embedded = section.bond.type != RebarBond::concrete;
      line.inside = inside;
      laid.lines.push_back(std::move(line));
      laid.materials.push_back(material);
      laid.sections.push_back(k);
    }
  }
  return laid;
}

void refuse_bars_outside(const CaseFile& input, const Body& body, const LaidBars& bars) {
  if (bars.lines.empty()) return;
  const auto inside = inside_of(input, body);
  for (std::size_t bar = 0; bar < bars.lines.size(); ++bar) {
    const std::size_t k = bars.sections[bar];
    const RebarSection& section = input.rebar[k];
    // Nodes outside the body are connected only to their bar.
    const bool stays_in_line = section.bends || section.bond.type == RebarBond::concrete;
    if (section.across_gaps && stays_in_line) continue;
    const auto point = first_outside(bars.lines[bar], look_step * body.lattice.spacing, inside);
    if (!point) continue;
    throw InputError(
        input.where(item_key("rebar", k)),
        fmt::format("leaves the body at ({})",
                    joined({point->data(), static_cast<std::size_t>(body.particles.dim)})),
        section.across_gaps
            ? "set bends = true: outside the body a bar without bending stiffness is a mechanism"
        : section.bond.type == RebarBond::concrete
            ? "move the bar into the body; a bar that runs through air needs another bond"
            : "move the bar into the body, or set across_gaps = true for one that runs through "
              "air");
  }
}

}  // namespace perilink
