#include "model/body/horizon_limits.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

/// A horizon is refused above the diagonal of the body and above this many spacings. In bodies of a
/// few particles a usual horizon exceeds the diagonal.
constexpr double least_ratio_refused = 20.0;

/// Memory of a run per bond without its factor. Bar lattices solved with subdomains, in which
/// nothing breaks, take less: 56 to 62.
constexpr double bytes_per_bond = 300.0, bytes_per_bar = 65.0;

constexpr const char* usual = "two to four spacings are usual: horizon_ratio = 3";

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

double diagonal_of(const HorizonReach& reach) {
  return std::hypot(reach.extents[0], reach.extents[1], reach.extents[2]);
}

/// Estimates the neighbours of a particle: those of the infinite lattice, limited along each axis
/// by the horizon and by the size of the body.
double neighbours_of(const HorizonReach& reach) {
  const double ratio = reach.horizon / reach.spacing;
  const double ball = reach.dim == 2 ? std::numbers::pi * ratio * ratio
                                     : 4.0 / 3.0 * std::numbers::pi * std::pow(ratio, 3);
  double box = 1.0;
  for (int a = 0; a < reach.dim; ++a) {
    box *= std::min(2.0 * ratio + 1.0, reach.extents[a] / reach.spacing + 1.0);
  }
  return std::min({ball, box, reach.particles});
}

void refuse_too_many_bonds(const CaseFile& input, const HorizonReach& reach) {
  const double neighbours = neighbours_of(reach);
  const double bonds = 0.5 * neighbours * reach.particles;
  const bool bars = input.analysis.type == AnalysisType::elastic && !has_cells(input.body) &&
                    input.body.model == BodyModel::bond_based &&
                    input.analysis.solver != LinearSolver::direct;
  const double bytes = (bars ? bytes_per_bar : bytes_per_bond) * bonds;
  const bool numbered = bonds <= std::numeric_limits<Index>::max();
  if (numbered && bytes <= reach.memory) return;
  throw InputError(
      input.where(horizon_key(input.body)),
      fmt::format("makes the horizon {:.6g}, {:.4g} spacings: each of about {:.3g} particles would "
                  "have {:.3g} neighbours, together {:.2g} bonds and {:.3g} GB; {}",
                  reach.horizon, reach.horizon / reach.spacing, reach.particles, neighbours, bonds,
                  bytes / 1e9,
                  numbered ? fmt::format("this machine has {:.3g} GB", reach.memory / 1e9)
                           : fmt::format("at most {:.2g} bonds can be numbered",
                                         1.0 * std::numeric_limits<Index>::max())),
      usual);
}

}  // namespace

std::string horizon_key(const BodySection& body) {
  if (body.horizon) return "body.horizon";
  return body.horizon_ratio ? "body.horizon_ratio" : "body.horizon_level";
}

HorizonReach reach_of(const Particles& particles, double horizon, double spacing) {
  HorizonReach reach{horizon, spacing,       static_cast<double>(particles.size()),
                     {},      particles.dim, machine_memory()};
  for (int a = 0; a < reach.dim; ++a) {
    double lower = INFINITY, upper = -INFINITY;
    for (Index i = 0; i < particles.size(); ++i) {
      lower = std::min(lower, particles.position(i)[a]);
      upper = std::max(upper, particles.position(i)[a]);
    }
    reach.extents[a] = upper - lower;
  }
  return reach;
}

HorizonReach reach_of(const Box& box, int dim, double horizon, double spacing) {
  HorizonReach reach{horizon, spacing, 1.0, {}, dim, machine_memory()};
  for (int a = 0; a < dim; ++a) {
    reach.extents[a] = box.upper[a] - box.lower[a];
    reach.particles *= std::max(1.0, reach.extents[a] / spacing);
  }
  return reach;
}

void refuse_impossible_horizon(const CaseFile& input, const HorizonReach& reach) {
  const SourceLocation where = input.where(horizon_key(input.body));
  if (reach.horizon < reach.spacing * (1.0 - 1e-9)) {
    throw InputError(where,
                     fmt::format("the horizon {:.6g} is smaller than the spacing {:.6g}: no "
                                 "particle would have a neighbour",
                                 reach.horizon, reach.spacing),
                     "use two to four spacings");
  }
  const double diagonal = diagonal_of(reach);
  if (reach.horizon > diagonal && reach.horizon > least_ratio_refused * reach.spacing) {
    throw InputError(
        where,
        fmt::format("makes the horizon {:.6g}, {:.4g} spacings, but the body's diagonal is "
                    "{:.6g}: each of about {:.3g} particles would be bonded to every other",
                    reach.horizon, reach.horizon / reach.spacing, diagonal, reach.particles),
        usual);
  }
  refuse_too_many_bonds(input, reach);
}

void refuse_shearing_lattice(const CaseFile& input, const Lattice& lattice, double horizon) {
  const bool rows = lattice.pattern == Pattern::rectangular || lattice.pattern == Pattern::cubic;
  if (!rows || input.body.model != BodyModel::bond_based) return;
  double longest = 0.0;  // diagonal of a cell face
  for (int a = 0; a < lattice.dim; ++a) {
    for (int b = 0; b < a; ++b) {
      longest = std::max(longest, std::hypot(lattice.step[a], lattice.step[b]));
    }
  }
  if (horizon >= longest * (1.0 - 1e-9)) return;
  const double least = std::ceil(1e4 * longest / lattice.spacing) / 1e4;
  throw InputError(
      input.where(horizon_key(input.body)),
      fmt::format("makes the horizon {:.6g}, shorter than the diagonals of the lattice, "
                  "{:.6g}: bonds along the rows do not resist shear, and the body would "
                  "be a mechanism",
                  horizon, longest),
      fmt::format("give at least horizon_ratio = {:.4f}; two to four are usual", least));
}

}  // namespace perilink
