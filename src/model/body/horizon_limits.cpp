#include "model/body/horizon_limits.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/plain_text.hpp"
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

/// Width of the thin part of a body along an axis.
struct ThinPart {
  double width = 0.0;   ///< mean over its particles [length]
  Index particles = 0;  ///< along the axis, their lines of bonds are short
};

/// Returns the parts of a body that are narrow along one axis. Lines of bonds measure the distances
/// to both faces.
/// \param most    largest number of spacings of a narrow part
/// \param fewest  number of particles below which a part does not matter
ThinPart thin_part(const Model& model, std::size_t axis, double most, double fewest) {
  constexpr double along = 0.8;  // cosine of bonds that measure the width
  const Network& network = model.network;
  const auto count = static_cast<std::size_t>(network.num_particles());
  std::vector<double> up(count), down(count);
  ThinPart part;
  const auto measure = [&] {
    part = {};
    for (std::size_t i = 0; i < count; ++i) {
      const double width = up[i] + down[i];
      const bool wide = width >= (most + 0.1) * model.lattice.spacing;
      if (network.particles.material[i] == no_index || wide) continue;
      part.width += width;
      ++part.particles;
    }
    return part.particles >= fewest;
  };
  // Lines from a face of a wide body must reach beyond `most`. They only grow: most bodies are wide
  // after the first step.
  const double reach = std::floor(model.horizon / model.lattice.spacing + 0.1);
  for (double hops = 1.0 + std::ceil(most / reach); hops > 0.0; hops -= 1.0) {
    const std::vector<double> above = up, below = down;
    for (Index b = 0; b < network.num_bonds() && b < network.first_contact(); ++b) {
      Index lower = network.bonds.first[b], upper = network.bonds.second[b];
      double apart =
          network.particles.position(upper)[axis] - network.particles.position(lower)[axis];
      if (std::abs(apart) < along * network.bonds.length(b)) continue;
      if (apart < 0.0) std::swap(lower, upper);
      apart = std::abs(apart);
      up[lower] = std::max(up[lower], apart + above[upper]);
      down[upper] = std::max(down[upper], apart + below[lower]);
    }
    if (!measure()) break;
  }
  if (part.particles > 0) part.width /= static_cast<double>(part.particles);
  return part;
}

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

std::optional<std::string> thin_body_note(const CaseFile& input, const Model& model) {
  constexpr double fewest = 0.25, most_error = 0.1;
  if (is_shell(input.body) || is_beam(input.body) || input.elements || !input.symmetry.empty()) {
    return std::nullopt;
  }
  const double ratio = model.horizon / model.lattice.spacing;
  const bool turns = input.body.model == BodyModel::micropolar;
  // Measured on cantilevers: the bending stiffness is 1 + excess / steps^2 of a beam's.
  const double excess = turns ? 0.9 + 0.45 * ratio : 2.5 / ratio;
  const double most = std::sqrt(excess * (1.0 / most_error - 1.0));  // steps
  for (int axis = 0; axis < model.network.dim(); ++axis) {
    const double few = fewest * model.network.num_particles();
    const ThinPart part = thin_part(model, static_cast<std::size_t>(axis), most, few);
    const double steps = std::floor(part.width / model.lattice.spacing + 0.1);
    const double error = excess / (steps * steps + excess);
    if (part.particles < few || steps < 1.0) continue;
    if (error <= most_error) continue;
    return fmt::format(
        "thin body: along {} it is {:.4g} wide, {:.2g} horizons, at {}: if it bends there, its "
        "deflection is about {:.0f} % too small; use a finer spacing and horizon, method = "
        "\"linear_elements\", or problem = \"beam\"",
        "xyz"[axis], part.width, part.width / model.horizon, counted(part.particles, "particle"),
        100.0 * error);
  }
  return std::nullopt;
}

}  // namespace perilink
