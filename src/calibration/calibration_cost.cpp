#include "calibration/calibration_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/bond_sample.hpp"
#include "calibration/bond_surroundings.hpp"

namespace perilink {
namespace {

/// Seconds per free bond, of lattices (their free bonds lie along the surface) and of clouds.
struct Rates {
  double lattice, particle_set;
};

// Measured on bodies of 16 000 to 165 000 free bonds, alone on one core; lattices in space without
// moments on bodies of 27 000 to 615 000, on two cores; clouds in space of 360 000 to 27 million,
// on two cores: 22e-6 to 43e-6.
constexpr Rates in_plane{8e-6, 10e-6}, in_plane_with_moments{12e-6, 30e-6};
/// In the plane a factor of all equations takes most of the time of clouds: the rates are those of
/// so many particles and grow with this power of the number (4 000 to 149 000 particles).
constexpr double particles_of_rates = 12000.0, growth_of_factor = 0.38;
constexpr Rates in_space{35e-6, 35e-6}, in_space_with_moments{200e-6, 250e-6};
/// On lattices in space without moments it grows with this power of the number of free bonds and is
/// that of so many (170 000 to 1 100 000).
constexpr double bonds_of_rate = 170000.0, growth_in_space = 0.4;
/// Where particles have fewer bonds than this in space, all equations are factorised.
/// That takes longer the more they are: the rate is that of so many.
constexpr double few_bonds = 30.0, in_space_by_factor = 200e-6, bonds_by_factor = 70000.0;
/// Bonds that lie alike made alike: seconds for each bond, and operations of factors of their
/// equations over c r^3 n^2 for n kinds of places with r rows and c bonds each (a factor and a
/// hundred solutions).
constexpr double alike = 0.6e-6, alike_operations = 0.8, operations_per_second = 3e10;
/// So many end the attempt: bodies that need most of them take a half of it.
constexpr double most_alike_operations = 6.0;
/// They must save so much: they may have no solution, and both costs are rough.
constexpr double worth_a_try = 2.0;
/// Bytes for every bond that may change on its own, in space (lattices of 170 000 to 1 100 000
/// bonds: 900 to 1 600, clouds of 1 200 000 to 27 000 000: 580 to 610 in all; by a factor 21 000 of
/// 69 000 bonds), and for the square of the number of equations of bonds that are made alike and
/// that number (6 900 to 13 400 in bodies of 150 000 to 4 600 000 bonds: 0.08 to 0.27 GB in all,
/// within 23 %).
/// With all of them there are the bonds themselves, fewer bytes where they share directions, and
/// what searches, or a count of what they have reached, hold for each (7 667 168 in the plane,
/// mostly left out: 74 in all).
constexpr double bytes_of_any_bond = 75.0, bytes_where_held = 100.0, bytes_where_shared = 32.0;
constexpr double most_of_few = 0.5;
constexpr double bytes_of_bond = 1300.0, bytes_in_unstructured = 450.0;
constexpr double bytes_by_factor = 20000.0, bytes_of_equations = 0.36, bytes_of_equation = 6000.0;
/// The factor of their equations is nearly full, and its time grows with the third power.
constexpr double most_alike_equations = 20000.0;

/// The same constants all over; materials may differ in strength.
bool uniform(const CalibrationInput& input) {
  const LameConstants& first = input.materials[input.particles.material.front()];
  return std::all_of(input.particles.material.begin(), input.particles.material.end(),
                     [&](Index m) { return input.materials[m] == first; });
}

Index count_free(const CalibrationInput& input) {
  if (input.all_free()) return input.bonds.size();
  return static_cast<Index>(std::count(input.free.begin(), input.free.end(), 1));
}

/// Whether all equations of a lattice in space are factorised.
bool by_factor(const CalibrationInput& input, bool moments) {
  return input.particles.dim == 3 && !moments && !input.all_free() &&
         input.bonds.size() < few_bonds * input.particles.size();
}

/// Seconds for every bond on its own.
double cost_of_single_bonds(const CalibrationInput& input, bool moments) {
  const bool in_plane_only = input.particles.dim == 2;
  const Rates& rates = in_plane_only ? moments ? in_plane_with_moments : in_plane
                       : moments     ? in_space_with_moments
                                     : in_space;
  double rate = input.all_free() ? rates.particle_set : rates.lattice;
  const double free_bonds = count_free(input);
  if (by_factor(input, moments)) {
    rate = in_space_by_factor * free_bonds / bonds_by_factor;
  } else if (!in_plane_only && !moments && !input.all_free()) {
    rate *= std::pow(free_bonds / bonds_of_rate, growth_in_space);
  }
  if (input.all_free() && in_plane_only) {
    rate *= std::pow(input.particles.size() / particles_of_rates, growth_of_factor);
  }
  return rate * free_bonds;
}

double bytes_of_single_bonds(const CalibrationInput& input, bool moments) {
  if (input.particles.dim == 2) return 0.0;  // less than the run takes
  const bool particle_set = input.all_free() && !moments;
  const double bytes = by_factor(input, moments) ? bytes_by_factor
                       : particle_set            ? bytes_in_unstructured
                                                 : bytes_of_bond;
  return bytes * count_free(input);
}

double equations_of(const BondOrbits& orbits, int dim, bool moments) {
  return static_cast<double>(orbits.representatives.size()) * ForceRows{dim, moments}.count();
}

/// Operations of a factor over alike_operations.
double unit_alike(const CalibrationInput& input, const BondOrbits& orbits, bool moments) {
  const double equations = equations_of(orbits, input.particles.dim, moments);
  const double rows = ForceRows{input.particles.dim, moments}.count();
  const double bonds_of_place = static_cast<double>(input.bonds.size()) / input.particles.size();
  return bonds_of_place * rows * equations * equations;
}

double cost_alike(const CalibrationInput& input, const BondOrbits& orbits, bool moments) {
  return alike * count_free(input) +
         alike_operations * unit_alike(input, orbits, moments) / operations_per_second;
}

}  // namespace

std::optional<BondOrbits> alike_bonds(const CalibrationInput& input, const Facets& facets,
                                      const BondStiffness& stiffness) {
  if (input.all_free() || !(input.box || input.step) || !uniform(input)) return std::nullopt;
  const bool moments = !stiffness.bending.empty();
  const double rows = ForceRows{input.particles.dim, moments}.count();
  const auto most_places = static_cast<std::size_t>(most_alike_equations / rows);
  BondOrbits orbits = input.box ? find_orbits(*input.box, input.particles, input.bonds, input.free)
                                : find_surroundings(input, facets, stiffness, most_places);
  const double equations = equations_of(orbits, input.particles.dim, moments);
  if (equations == 0.0 || equations > most_alike_equations) return std::nullopt;
  const bool dear = !input.box && worth_a_try * cost_alike(input, orbits, moments) >
                                      cost_of_single_bonds(input, moments);
  return dear ? std::nullopt : std::optional(std::move(orbits));
}

double alike_budget(const CalibrationInput& input, const BondOrbits& orbits, bool moments) {
  return input.box ? std::numeric_limits<double>::infinity()
                   : most_alike_operations * unit_alike(input, orbits, moments);
}

bool meets_few(const CalibrationInput& input) {
  if (input.all_free()) return false;
  const Bonds& bonds = input.bonds;
  const std::vector<std::uint8_t> ends = mark_ends(bonds, input.free, input.particles.size());
  Index met = 0;
  for (Index b = 0; b < bonds.size(); ++b) met += ends[bonds.first[b]] || ends[bonds.second[b]];
  return met > 0 && met <= most_of_few * static_cast<double>(bonds.size());
}

CalibrationReport expected_calibration(const CalibrationInput& input, const Facets& facets,
                                       const BondStiffness& stiffness) {
  CalibrationReport report;
  report.free_bonds = count_free(input);
  const bool moments = !stiffness.bending.empty();
  const auto orbits = alike_bonds(input, facets, stiffness);
  if (orbits) {
    const double equations = equations_of(*orbits, input.particles.dim, moments);
    report.seconds = cost_alike(input, *orbits, moments);
    report.bytes = (bytes_of_equations * equations + bytes_of_equation) * equations;
  } else {
    report.seconds = cost_of_single_bonds(input, moments);
    report.bytes = bytes_of_single_bonds(input, moments);
  }
  const bool left_out = !orbits && meets_few(input);
  const bool shared = orbits && !input.bonds.kind.empty();
  report.bytes += (left_out ? bytes_of_any_bond
                   : shared ? bytes_where_shared
                            : bytes_where_held) *
                  input.bonds.size();
  return report;
}

}  // namespace perilink
