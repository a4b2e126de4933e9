#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>

#include "base/timer.hpp"
#include "hinge.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"
#include "skin.hpp"
#include "specimens.hpp"

namespace perilink::verification {
namespace {

class Table {
 public:
  explicit Table(const std::string& head) { add(head + "\n"); }
  void add(const std::string& line) {
    fmt::print("{}", line);
    std::fflush(stdout);
    text_ += line;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string made(const Make& make) {
  return fmt::format("{},{},{},{},{}", make.model, make.pattern, make.softening, make.spacing,
                     make.horizon_ratio);
}

void add_strip(const Make& make, Table& table) {
  const Outcome outcome = run_text(strip(make));
  table.add(fmt::format("strip,{},,,{:.4f},{:.4f},{:.1e},{},{}\n", made(make),
                        outcome.peak / (tensile_strength * section_of(make)),
                        outcome.dissipated / (fracture_energy * section_of(make)),
                        outcome.energy_error, outcome.events, outcome.termination));
}

/// Nominal strength: the largest stress of a beam without a crack, 6 M / D^2 with M = P D.
double bending_strength(const Outcome& outcome, const Beam& size) {
  return 6.0 * outcome.peak / size.depth / tensile_strength;
}

void add_beam(const Make& make, const Beam& size, Table& table) {
  const Outcome outcome = run_text(beam(make, size));
  table.add(fmt::format("beam,{},{},{},{:.4f},,{:.1e},{},{}\n", made(make), size.depth, size.notch,
                        bending_strength(outcome, size), outcome.energy_error, outcome.events,
                        outcome.termination));
}

constexpr const char* head =
    "specimen,model,pattern,softening,spacing,horizon_ratio,depth,notch,strength,energy,"
    "energy_error,events,ending";

void run_strips() {
  Table table(head);
  for (const char* model : {"bond_based", "micropolar"}) {
    for (const char* softening : {"linear", "bilinear", "exponential"}) {
      for (const double spacing : {5.0, 10.0 / 3.0, 2.5}) {
        add_strip({model, "rectangular", softening, spacing, 3.0}, table);
      }
      add_strip({model, "rectangular", softening, 3.75, 4.0}, table);
      add_strip({model, "hexagonal", softening, 5.0, 3.0}, table);
    }
    for (const double spacing : {5.0, 10.0 / 3.0, 2.5}) {
      add_strip({model, "mesh", "bilinear", spacing, 3.0}, table);
    }
    add_strip({model, "mesh", "bilinear", 3.75, 4.0}, table);
  }
  add_strip({"bond_based", "cubic", "bilinear", 5.0, 3.0}, table);
  write_result(PERILINK_STUDY_DIR, table.text(), "strips.csv");
}

/// Energies of strips whose part that may soften has other lengths: what goes with the area of the
/// crack and what with the volume. All over G_F times the section.
void run_lengths() {
  Table table(
      "model,pattern,softening,spacing,horizon_ratio,soft_length,energy,crack,beside,cut,"
      "strength,ending,seconds");
  const auto add = [&](Make make) {
    const double unit = fracture_energy * section_of(make), part = soft_length_of(make);
    for (const double more : {0.0, 0.5 * part, part}) {
      if (section_of(make) > 100.0 && more == part) continue;  // bars of two lengths
      make.longer = make.spacing * std::round(more / make.spacing);
      const Timer timer;
      const Outcome outcome = run_text(strip(make), &make);
      const Released& released = outcome.released;
      table.add(fmt::format("{},{:.4g},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.1f}\n", made(make),
                            soft_length_of(make), outcome.dissipated / unit, released.crack / unit,
                            released.beside / unit, released.cut / unit,
                            outcome.peak / (tensile_strength * section_of(make)),
                            outcome.termination, timer.seconds()));
    }
    write_result(PERILINK_STUDY_DIR, table.text(), "lengths.csv");
  };
  for (const char* model : {"bond_based", "micropolar"}) {
    for (const char* softening : {"linear", "bilinear", "exponential"}) {
      add({model, "rectangular", softening, 5.0, 3.0});
      add({model, "hexagonal", softening, 5.0, 3.0});
    }
    add({model, "rectangular", "bilinear", 2.5, 3.0});
    add({model, "rectangular", "bilinear", 3.75, 4.0});
  }
  add({"bond_based", "cubic", "bilinear", 5.0, 3.0});
}

void run_beams() {
  Table table(head);
  for (const double part : {20.0, 32.0}) {
    for (const double depth : {50.0, 100.0, 200.0, 400.0}) {
      add_beam({.spacing = depth / part}, {.depth = depth, .notch = 0.2}, table);
    }
  }
  for (const double spacing : {5.0, 10.0 / 3.0, 2.5}) {
    add_beam({.spacing = spacing}, {}, table);
  }
  for (const double spacing : {5.0, 2.5}) {
    add_beam({.softening = "brittle", .spacing = spacing}, {}, table);
  }
  write_result(PERILINK_STUDY_DIR, table.text(), "beams.csv");
}

void add_unnotched(const Make& make, const Beam& size, Table& table) {
  const Outcome outcome = run_text(beam(make, size));
  table.add(fmt::format("{},{:.3g},{:.3g},{},{},{:.4f},{},{}\n", made(make), make.knee_stress_ratio,
                        make.knee_opening_ratio, size.patch, size.point_supports,
                        bending_strength(outcome, size), outcome.events, outcome.termination));
}

constexpr const char* unnotched_head =
    "model,pattern,softening,spacing,horizon_ratio,knee_stress_ratio,knee_opening_ratio,patch,"
    "point_supports,strength,events,ending";
constexpr Beam on_points{.point_supports = true, .load_fraction = 0.8};

/// What the strength of the beam without a crack depends on.
void run_unnotched() {
  Table table(unnotched_head);
  add_unnotched({}, {.load_fraction = 0.8}, table);
  add_unnotched({}, on_points, table);
  add_unnotched({}, {.patch = 0.2, .point_supports = true, .load_fraction = 0.8}, table);
  add_unnotched({.spacing = 10.0 / 3.0}, on_points, table);
  add_unnotched({.spacing = 4.0, .horizon_ratio = 3.75}, on_points, table);
  add_unnotched({.model = "micropolar"}, on_points, table);
  add_unnotched({.model = "micropolar", .spacing = 10.0 / 3.0}, on_points, table);
  add_unnotched({.pattern = "mesh"}, on_points, table);
  add_unnotched({.pattern = "mesh", .spacing = 10.0 / 3.0}, on_points, table);
  add_unnotched({.softening = "linear"}, on_points, table);
  add_unnotched({.softening = "exponential"}, on_points, table);
  write_result(PERILINK_STUDY_DIR, table.text(), "unnotched.csv");
}

/// The same with other knees of bilinear curves.
void run_knees() {
  Table table(unnotched_head);
  constexpr double knees[][2] = {{0.25, 0.15}, {0.15, 0.10}};
  for (const double spacing : {5.0, 10.0 / 3.0}) {
    for (const auto& [stress, opening] : knees) {
      add_unnotched(
          {.spacing = spacing, .knee_stress_ratio = stress, .knee_opening_ratio = opening},
          on_points, table);
    }
  }
  write_result(PERILINK_STUDY_DIR, table.text(), "knees.csv");
}

/// The same over spacing with the horizon of a spacing of 5, and finer with three spacings.
void run_fixed() {
  Table table(unnotched_head);
  const auto add = [&](const Make& make) {
    add_unnotched(make, on_points, table);
    write_result(PERILINK_STUDY_DIR, table.text(), "fixed_horizon.csv");
  };
  for (const double ratio : {3.75, 4.5}) {
    const double spacing = 15.0 / ratio;
    add({.spacing = spacing, .horizon_ratio = ratio});
    add({.model = "micropolar", .spacing = spacing, .horizon_ratio = ratio});
    add({.spacing = spacing,
         .horizon_ratio = ratio,
         .knee_stress_ratio = 0.15,
         .knee_opening_ratio = 0.10});
    add({.pattern = "mesh", .spacing = spacing, .horizon_ratio = ratio});
    add({.softening = "exponential", .spacing = spacing, .horizon_ratio = ratio});
  }
  add({.model = "micropolar", .spacing = 2.5});
  add({.spacing = 2.5, .knee_stress_ratio = 0.15, .knee_opening_ratio = 0.10});
}

/// The same by a cohesive hinge.
void run_hinge() {
  Table table("knee_stress_ratio,knee_opening_ratio,strength");
  const double depth = 100.0 * tensile_strength * tensile_strength / (30000.0 * fracture_energy);
  constexpr double knees[][2] = {{1.0 / 3.0, 2.0 / 9.0}, {0.25, 0.15}, {0.15, 0.10}, {0.5, 0.5}};
  for (const auto& [stress, opening] : knees) {
    table.add(fmt::format("{:.3g},{:.3g},{:.4f}\n", stress, opening,
                          hinge_strength(stress, opening, depth)));
  }
  write_result(PERILINK_STUDY_DIR, table.text(), "hinge.csv");
}

/// The same by a cohesive hinge whose fibres soften before they crack as the body does.
void run_skin() {
  Table table(
      "model,knee_stress_ratio,knee_opening_ratio,horizon,strength_factor,strain_at_strength,"
      "softened_before,hinge");
  const double length = 30000.0 * fracture_energy / (tensile_strength * tensile_strength);
  constexpr double knees[][2] = {{1.0 / 3.0, 2.0 / 9.0}, {0.25, 0.15}, {0.15, 0.10}, {0.5, 0.5}};
  for (const double poissons_ratio : {1.0 / 3.0, 0.2}) {
    for (const auto& [stress, opening] : knees) {
      for (const double horizon : {15.0, 10.0, 7.5, 5.0}) {
        const Skin skin = skin_of({poissons_ratio, stress, opening, horizon / length});
        table.add(fmt::format("{},{:.3g},{:.3g},{},{:.4f},{:.4f},{:.4f},{:.4f}\n",
                              poissons_ratio > 0.3 ? "bond_based" : "micropolar", stress, opening,
                              horizon, skin.strength_factor, skin.curve.back().strain,
                              softened_before(skin),
                              hinge_strength(stress, opening, 100.0 / length, skin.curve)));
      }
    }
  }
  write_result(PERILINK_STUDY_DIR, table.text(), "skin.csv");
}

}  // namespace
}  // namespace perilink::verification

/// Strength and energy of strips and beams whose bonds soften, over what the material says:
/// `softening strips` writes strips.csv, and so lengths, beams, unnotched, knees, hinge, skin;
/// `softening fixed` writes fixed_horizon.csv.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::map<std::string, void (*)()> parts = {
      {"strips", run_strips},       {"lengths", run_lengths},
      {"beams", run_beams},         {"hinge", run_hinge},
      {"unnotched", run_unnotched}, {"knees", run_knees},
      {"fixed", run_fixed},         {"skin", run_skin}};
  const auto part = parts.find(arguments.empty() ? "" : arguments[0]);
  if (part == parts.end()) {
    throw std::invalid_argument(
        "name strips, lengths, beams, unnotched, knees, fixed, hinge or skin");
  }
  part->second();
  return true;
}
