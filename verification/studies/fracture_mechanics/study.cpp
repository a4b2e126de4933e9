// Cracks against linear elastic fracture mechanics, see README.md:
//
//   fracture_mechanics strips|beams|directions|kinks
//
// Each part writes its own table, a row as soon as a run has ended, and the last two a picture.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/timer.hpp"
#include "draw.hpp"
#include "measures.hpp"
#include "problems/handbook.hpp"
#include "problems/program.hpp"

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

/// Runs something for brittle and bilinear bonds, bond-based and micropolar; what fails becomes a
/// row that says so.
void for_all_bonds(Table& table, Make make, const std::function<std::string(const Make&)>& row,
                   const std::vector<bool>& moments = {false, true}) {
  for (const bool softens : {false, true}) {
    for (const bool micropolar : moments) {
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
}

const std::vector<Arrangement> arrangements = {{Kind::lattice, false, 0.0},
                                               {Kind::lattice, true, 0.0},
                                               {Kind::turned, true, 15.0},
                                               {Kind::turned, true, 30.0},
                                               {Kind::cloud}};

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
      if (horizon_ratio == 3.0) {
        for_all_bonds(table, all, row);
      } else {  // three times as many bonds: without moments only
        for_all_bonds(table, all, row, {false});
      }
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
        for_all_bonds(table, {arrangement, false, false, 100.0 / parts}, [&](const Make& make) {
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

void run_directions() {
  Table table("directions.csv", "lattice,model,law,angle,spread_over_horizon,events,seconds");
  std::vector<CrackPicture> pictures;
  const std::vector<Arrangement> all = {{Kind::lattice, false},       {Kind::turned, false, 15.0},
                                        {Kind::lattice, true},        {Kind::turned, true, 15.0},
                                        {Kind::turned, true, 30.0},   {Kind::cloud, false, 0.0, 1},
                                        {Kind::cloud, false, 0.0, 5}, {Kind::cloud, false, 0.0, 6}};
  for (const Arrangement& arrangement : all) {
    for_all_bonds(table, {arrangement}, [&](const Make& make) {
      const Specimen specimen = crack_tip_field(make, 0.0);
      const Crack crack = run_specimen(specimen);
      const Direction direction = direction_of(crack, specimen.tip);
      pictures.push_back({make, crack, specimen.tip, direction.angle});
      draw_cracks(pictures).save(std::string(PERILINK_STUDY_DIR) + "/crack_paths.svg");
      return fmt::format("{:.2f},{:.3f},{}", direction.angle, direction.spread, crack.events);
    });
  }
}

void run_kinks() {
  Table table("kinks.csv",
              "lattice,model,law,mixity,hoop_stress,angle,spread_over_horizon,seconds");
  std::vector<Kink> kinks;
  for (const Arrangement& arrangement : {arrangements[0], arrangements[1], arrangements[4]}) {
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 90.0}) {
      for_all_bonds(table, {arrangement}, [&](const Make& make) {
        const double mixity = degrees * std::numbers::pi / 180.0;
        const Specimen specimen = crack_tip_field(make, mixity);
        const Direction direction = direction_of(run_specimen(specimen), specimen.tip);
        kinks.push_back({make, degrees, direction.angle});
        return fmt::format("{},{:.2f},{:.2f},{:.3f}", degrees,
                           hoop_stress_kink(mixity) * 180.0 / std::numbers::pi, direction.angle,
                           direction.spread);
      });
    }
  }
  draw_kinks(kinks).save(std::string(PERILINK_STUDY_DIR) + "/kinks.svg");
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string part = arguments.empty() ? "" : arguments[0];
  const std::vector<std::pair<std::string, void (*)()>> parts = {{"strips", run_strips},
                                                                 {"beams", run_beams},
                                                                 {"directions", run_directions},
                                                                 {"kinks", run_kinks}};
  for (const auto& [name, run] : parts) {
    if (name != part) continue;
    run();
    std::filesystem::remove_all(temporary_folder());
    return true;
  }
  throw std::invalid_argument("name strips, beams, directions or kinks");
}
