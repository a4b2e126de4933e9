// Cracks against linear elastic fracture mechanics, see README.md:
//
//   fracture_mechanics strips|beams|directions|kinks|more|more_kinks|rows|patterns
//   fracture_mechanics directions|kinks|more|more_kinks 4      another horizon over spacing than 3
//
// Each part writes its own table, a row as soon as a run has ended, and directions and kinks a
// picture.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/timer.hpp"
#include "draw.hpp"
#include "measures.hpp"
#include "problems/handbook.hpp"
#include "problems/program.hpp"
#include "rows.hpp"

namespace perilink::verification {
namespace {

using Kind = Arrangement::Kind;

/// A table that grows row by row on the screen and in the study's folder.
class Table {
 public:
  Table(const std::string& name, const std::string& head)
      : file_(std::filesystem::path(PERILINK_STUDY_DIR) / name) {
    add(head);
  }
  void add(const std::string& line) {
    file_ << line << std::endl;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

 private:
  std::ofstream file_;
};

struct Bonds {
  bool micropolar, softens;
};
const std::vector<Bonds> all_bonds = {{false, false}, {true, false}, {false, true}, {true, true}};
const std::vector<Bonds> without_moments = {{false, false}, {false, true}};
const std::vector<Bonds> with_moments = {{true, false}, {true, true}};
/// All but brittle ones without moments, whose paths have no bar.
const std::vector<Bonds> that_keep_to_paths = {{true, false}, {false, true}, {true, true}};

/// Runs something for several kinds of bonds; what fails becomes a row that says so.
void for_bonds(const std::vector<Bonds>& kinds, Table& table, Make make,
               const std::function<std::string(const Make&)>& row) {
  for (const auto& [micropolar, softens] : kinds) {
    make.softens = softens;
    make.micropolar = micropolar;
    const std::string name = fmt::format("{},{}", name_of(make.arrangement), bonds_of(make));
    const Timer timer;
    try {
      const std::string values = row(make);
      table.add(fmt::format("{},{},{:.1f}", name, values, timer.seconds()));
    } catch (const std::exception& error) {
      table.add(fmt::format("{},failed: {}", name, error.what()));
    }
  }
}

const std::vector<Arrangement> arrangements = {{Kind::lattice, false, 0.0},
                                               {Kind::lattice, true, 0.0},
                                               {Kind::turned, true, 15.0},
                                               {Kind::turned, true, 30.0},
                                               {Kind::particle_set}};

void run_strips() {
  Table table(
      "strips.csv",
      "lattice,model,law,horizon_ratio,zone_over_horizon,dissipated_over_GF,events,seconds");
  // All lengths in proportion give the same figures: these are the ratios that count.
  for (const auto& [horizon_ratio, zone] : {std::pair{3.0, 1.0}, {3.0, 2.0}, {4.0, 1.0}}) {
    for (const Arrangement& arrangement : arrangements) {
      if (arrangement.kind != Kind::lattice && (horizon_ratio > 3.0 || zone > 1.0)) continue;
      Make all{arrangement};
      all.horizon_ratio = horizon_ratio;
      all.zone = zone;
      const auto row = [](const Make& make) {
        const StripEnergy energy = energy_of_strip(make);
        return fmt::format("{},{},{:.4f},{}", make.horizon_ratio, make.softens ? make.zone : 0.0,
                           energy.dissipated, energy.events);
      };
      // With four spacings three times as many bonds: without moments only.
      for_bonds(horizon_ratio == 3.0 ? all_bonds : without_moments, table, all, row);
    }
  }
}

void run_beams() {
  Table table("beams.csv",
              "lattice,model,law,specimen,spacing,peak_over_form,smoothed_over_form,"
              "smoothed_over_later_form,unknowns,events,energy_error,seconds");
  struct Series {
    const char* name;
    Specimen (*make)(const Make&);
    std::array<double, 3> parts;  ///< spacings in the width or the arm
  };
  const std::vector<Series> all = {{"edge crack", edge_crack, {24.0, 36.0, 54.0}},
                                   {"centre crack", centre_crack, {24.0, 36.0, 54.0}},
                                   {"bent beam", bent_beam, {20.0, 30.0, 45.0}},
                                   {"double cantilever", double_cantilever, {12.0, 16.0, 24.0}}};
  for (const Series& series : all) {
    for (const double parts : series.parts) {
      for (const Arrangement& arrangement : arrangements) {
        // Dear to calibrate: clouds at one spacing, turned lattices in one specimen.
        if (arrangement.kind != Kind::lattice && parts != series.parts[1]) continue;
        if (arrangement.kind == Kind::turned && series.make != edge_crack) continue;
        const Make all_of{arrangement, false, false, 100.0 / parts};
        for_bonds(all_bonds, table, all_of, [&](const Make& make) {
          const Specimen specimen = series.make(make);
          const Crack crack = run_specimen(specimen);
          return fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{:.0e}", series.name,
                             make.spacing, crack.peak / specimen.load,
                             crack.smoothed_peak / specimen.load,
                             crack.smoothed_peak / specimen.later_load, crack.unknowns,
                             crack.events, crack.energy_error);
        });
      }
    }
  }
}

/// Horizon over spacing of directions and kinks where nothing else is said.
constexpr double usual_ratio = 3.0;

/// "kinks", "kinks_4" with four spacings.
std::string file_of(const std::string& part, double ratio) {
  return ratio == usual_ratio ? part : fmt::format("{}_{}", part, ratio);
}

/// With four spacings what misses the bar with three; with more, which take long, the farthest.
bool is_worth(const Arrangement& arrangement, double ratio) {
  if (arrangement.kind == Kind::particle_set) return ratio <= 4.0;
  return arrangement.degrees == 15.0 && (ratio <= 4.0 || !arrangement.hexagonal);
}

void run_directions(double ratio) {
  const std::string file = file_of("directions", ratio);
  Table table(file + ".csv", "lattice,model,law,angle,spread_over_horizon,events,seconds");
  std::vector<CrackPicture> pictures;
  const std::vector<Arrangement> all = {{Kind::lattice, false},
                                        {Kind::turned, false, 15.0},
                                        {Kind::lattice, true},
                                        {Kind::turned, true, 15.0},
                                        {Kind::turned, true, 30.0},
                                        {Kind::particle_set, false, 0.0, 1},
                                        {Kind::particle_set, false, 0.0, 5},
                                        {Kind::particle_set, false, 0.0, 6}};
  for (const Arrangement& arrangement : all) {
    const bool is_usual = ratio == usual_ratio;
    if (!is_usual && !is_worth(arrangement, ratio)) continue;
    Make make_all{arrangement};
    make_all.horizon_ratio = ratio;
    for_bonds(is_usual ? all_bonds : that_keep_to_paths, table, make_all, [&](const Make& make) {
      const Specimen specimen = crack_tip_field(make, 0.0);
      const Crack crack = run_specimen(specimen);
      const Direction direction = direction_of(crack, specimen.tip);
      pictures.push_back({make, crack, specimen.tip, direction.angle});
      draw_cracks(pictures).save(
          fmt::format("{}/{}.svg", PERILINK_STUDY_DIR, file_of("crack_paths", ratio)));
      return fmt::format("{:.2f},{:.3f},{}", direction.angle, direction.spread, crack.events);
    });
  }
}

void run_kinks(double ratio) {
  const std::string file = file_of("kinks", ratio);
  Table table(file + ".csv",
              "lattice,model,law,mixity,hoop_stress,angle,spread_over_horizon,seconds");
  std::vector<Kink> kinks;
  for (const Arrangement& arrangement : {arrangements[0], arrangements[1], arrangements[4]}) {
    Make make_all{arrangement};
    make_all.horizon_ratio = ratio;
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 90.0}) {
      const std::vector<Bonds>& bonds = ratio == usual_ratio ? all_bonds : with_moments;
      for_bonds(bonds, table, make_all, [&](const Make& make) {
        const double mixity = degrees * degree;
        const Specimen specimen = crack_tip_field(make, mixity);
        const Direction direction = direction_of(run_specimen(specimen), specimen.tip);
        kinks.push_back({make, degrees, direction.angle});
        return fmt::format("{},{:.2f},{:.2f},{:.3f}", degrees, hoop_stress_kink(mixity) / degree,
                           direction.angle, direction.spread);
      });
    }
  }
  if (ratio == usual_ratio) draw_kinks(kinks).save(std::string(PERILINK_STUDY_DIR) + "/kinks.svg");
}

/// Kinks on more clouds, micropolar bonds.
void run_more_kinks(double ratio) {
  Table table(file_of("more_kinks", ratio) + ".csv",
              "lattice,model,law,sample,mixity,hoop_stress,angle,spread_over_horizon,seconds");
  for (const double degrees : {90.0, 60.0, 30.0, 45.0, 15.0}) {
    for (const int sample : {1, 2}) {
      Make make_all{{Kind::particle_set, false, 0.0, 5, sample}};
      make_all.horizon_ratio = ratio;
      for_bonds(with_moments, table, make_all, [&](const Make& make) {
        const Specimen specimen = crack_tip_field(make, degrees * degree);
        const Direction direction = direction_of(run_specimen(specimen), specimen.tip);
        return fmt::format("{},{},{:.2f},{:.2f},{:.3f}", make.arrangement.sample, degrees,
                           hoop_stress_kink(degrees * degree) / degree, direction.angle,
                           direction.spread);
      });
    }
  }
}

/// How far from the criterion a lattice turned by any angle may lead a crack [degrees].
struct Worst {
  double mode_one = 0.0, turned = 0.0;  ///< under mode I, and how that lattice is turned
  double kink = 0.0, mixity = 0.0;      ///< under mixed mode, and under which
};

Worst worst_of(const Rows& rows) {
  Worst worst;
  for (int turned = 0; turned < 90; ++turned) {
    for (const double mixity : {0.0, 15.0, 30.0, 45.0, 60.0, 90.0}) {
      const double angle = rows.direction(mixity * degree, turned * degree);
      const double miss = std::abs(angle - hoop_stress_kink(mixity * degree)) / degree;
      if (mixity == 0.0 && miss > worst.mode_one) {
        worst.mode_one = miss;
        worst.turned = turned;
      } else if (mixity > 0.0 && miss > worst.kink) {
        worst.kink = miss;
        worst.mixity = mixity;
      }
    }
  }
  return worst;
}

/// What the energies of straight cracks tell.
void run_rows() {
  Table table(
      "rows.csv",
      "lattice,horizon_ratio,rows,least_energy,most_energy,mode_I,turned,turned_15,kinks,mixity");
  for (const bool hexagonal : {false, true}) {
    for (const double ratio : {3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0}) {
      const Rows rows(hexagonal, ratio);
      double least = 2.0, most = 0.0;
      for (int angle = 0; angle < 90; ++angle) {
        least = std::min(least, rows.energy(angle * degree));
        most = std::max(most, rows.energy(angle * degree));
      }
      const Worst worst = worst_of(rows);
      table.add(fmt::format("{},{},{},{:.4f},{:.4f},{:.1f},{},{:.1f},{:.1f},{}",
                            hexagonal ? "hexagonal" : "rectangular", ratio, rows.count(), least,
                            most, worst.mode_one, worst.turned,
                            rows.direction(0.0, 15.0 * degree) / degree, worst.kink, worst.mixity));
    }
  }
}

/// Mode I on more clouds and lattices turned by the worst angle; with the usual ratio longer cracks
/// in those turned by 15 degrees, too.
void run_more(double ratio) {
  Table table(file_of("more_directions", ratio) + ".csv",
              "lattice,model,law,sample,radius,to_3_horizons,to_4.5,to_6,length,seconds");
  struct Run {
    Arrangement arrangement;
    double radius;
  };
  std::vector<Run> all;
  for (const int algorithm : {5, 6, 1}) {
    for (const int sample : {1, 2}) {
      if (sample > 1 && ratio != usual_ratio) continue;
      all.push_back(
          {{Kind::particle_set, false, 0.0, algorithm, sample}, ratio == usual_ratio ? 10.0 : 8.0});
    }
  }
  if (ratio == usual_ratio) {
    all.push_back({{Kind::turned, false, 15.0}, 10.0});
    all.push_back({{Kind::turned, true, 15.0}, 10.0});
  }
  for (const bool hexagonal : {false, true}) {
    const double turned = worst_of(Rows(hexagonal, ratio)).turned;
    // By nine degrees a corner of the mesh would lie on a side of a cell, in a larger plate not.
    all.push_back({{Kind::turned, hexagonal, turned, 5, turned == 9.0 && hexagonal ? 1 : 0}, 8.0});
  }
  for (const auto& [arrangement, radius] : all) {
    Make make_all{arrangement};
    make_all.horizon_ratio = ratio;
    make_all.radius = radius;
    for_bonds(that_keep_to_paths, table, make_all, [&](const Make& make) {
      const Specimen specimen = crack_tip_field(make, 0.0);
      const Crack crack = run_specimen(specimen);
      std::string row = fmt::format("{},{}", make.arrangement.sample, make.radius);
      for (const double horizons : {3.0, 4.5, 6.0}) {
        row += fmt::format(",{:.2f}", direction_of(crack, specimen.tip, horizons).angle);
      }
      double end = specimen.tip[0];
      for (const Place& place : crack.broken) end = std::max(end, place[0]);
      return fmt::format("{},{:.1f}", row, (end - specimen.tip[0]) / crack.horizon);
    });
  }
}

/// Cracks at six angles to the axes of lattices and of three sets of unstructured particles.
void run_patterns(double ratio) {
  Table table(file_of("patterns", ratio) + ".csv",
              "lattice,model,law,seed,turned,off,peak,unknowns,set_up,breaking,seconds");
  const std::vector<Arrangement> all = {{Kind::lattice, false},
                                        {Kind::lattice, true},
                                        {Kind::unstructured, false, 0.0, 5, 1},
                                        {Kind::unstructured, false, 0.0, 5, 2},
                                        {Kind::unstructured, false, 0.0, 5, 3}};
  for (const Arrangement& arrangement : all) {
    for (const double degrees : {0.0, 7.5, 15.0, 22.5, 30.0, 45.0}) {
      Make make_all{arrangement};
      make_all.horizon_ratio = ratio;
      make_all.turned = degrees * degree;
      for_bonds(all_bonds, table, make_all, [&](const Make& make) {
        const Specimen specimen = crack_tip_field(make, 0.0);
        const Crack crack = run_specimen(specimen);
        const double off = direction_of(crack, specimen.tip).angle - degrees;
        return fmt::format("{},{},{:.2f},{:.4f},{},{:.2f},{:.2f}", arrangement.sample, degrees,
                           std::remainder(off, 360.0), crack.peak, crack.unknowns, crack.set_up,
                           crack.breaking);
      });
    }
  }
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string part = arguments.empty() ? "" : arguments[0];
  const double ratio = arguments.size() > 1 ? std::stod(arguments[1]) : usual_ratio;
  const std::vector<std::pair<std::string, std::function<void()>>> parts = {
      {"strips", run_strips},
      {"beams", run_beams},
      {"directions", [&] { run_directions(ratio); }},
      {"kinks", [&] { run_kinks(ratio); }},
      {"rows", run_rows},
      {"patterns", [&] { run_patterns(ratio); }},
      {"more_kinks", [&] { run_more_kinks(ratio); }},
      {"more", [&] { run_more(ratio); }}};
  for (const auto& [name, run] : parts) {
    if (name != part) continue;
    run();
    std::filesystem::remove_all(temporary_folder());
    return true;
  }
  throw std::invalid_argument(
      "name strips, beams, directions, kinks, more, more_kinks, rows or patterns");
}
