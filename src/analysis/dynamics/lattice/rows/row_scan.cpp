#include "analysis/dynamics/lattice/rows/row_scan.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"

namespace perilink {
namespace {

/// Margins of the particles of a row before a crack begins and before they yield, in stress times
/// volume. Negative margins mean that the particle must be checked.
struct Left {
  std::vector<double> damage, flow;
};

/// Returns the path of the row's stretches, for particles with a threshold of the path. Near
/// weakened bonds that threshold is void, because factors change with the sign of a stretch.
double path_of(const ExplicitModel& model, const ExplicitState& state, Index r) {
  return has_weakened_rows(model, state, r) ? never : state.path[r];
}

/// Bond fields that loops over a row read: stretches only, plastic parts too, or damage factors as
/// well.
enum class RowBonds { whole, flowed, weakened };

/// Computes the margins of each particle of a row in the plane.
/// \return the least margin
template <RowBonds Bonds, bool Yields>
double scan_plane(const ExplicitModel& model, const ExplicitState& state, Index r, Left& left) {
  const LatticeRow& row = model.lattice.rows[r];
  const BondPointers<6> bond(model, state, r);
  const double* sum = state.now.sum.data() + state.now.places.first[r];
  const double* volume = model.volume.data() + row.first;
  const double* crack_at = state.crack_at.data() + row.first;
  const double* look_at = Yields ? state.flow.look_at.data() + row.first : nullptr;
  const PlaneProducts nn(model.lattice);
  const double own = model.moduli.own, modulus = model.moduli.sum;
  const double half_length = 0.5 * model.lattice.spacing;
  const double* root_tension = state.root_tension.data() + row.first;
  const double* root_compression = state.root_compression.data() + row.first;
  const double nu = model.problem == Problem::plane_strain ? model.material.poissons_ratio : 0.0;
  const double* normal = Yields ? state.flow.normal.data() + row.first : nullptr;
  const double* quiet_until = state.quiet_until.data() + row.first;
  const double path = path_of(model, state, r), stiffness = stress_stiffness(model);
  double least = never;
  double *damage = left.damage.data(), *flow = left.flow.data();
#pragma omp simd reduction(min : least)
  for (Index i = 0; i < row.size; ++i) {
    const double shared = modulus * sum[i];
    double sxx = 0.0, syy = 0.0, sxy = 0.0;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      const int k = j % 3;
      const double present = bond.present[j][i];
      double force = own * bond.effective[j][i], factor = present, root = 1.0;
      if constexpr (Bonds == RowBonds::weakened) {
        const double stretch = bond.stretch[j][i];
        factor = by_sign(stretch, bond.tension[j][i], bond.compression[j][i]);
        root = by_sign(stretch, root_tension[i], root_compression[i]);
      }
      if constexpr (Bonds != RowBonds::whole && Yields) {
        force += (j < 3 ? own : -own) * factor * bond.half[j][i];
      }
      force += present * root * shared;
      sxx += force * nn.xx[k];
      syy += force * nn.yy[k];
      sxy += force * nn.xy[k];
    }
    const double mean = 0.5 * (sxx + syy), difference = 0.5 * (sxx - syy);
    const double radius = std::sqrt(difference * difference + sxy * sxy);
    const double rest = std::max(crack_at[i] * volume[i] - half_length * (mean + radius),
                                 (quiet_until[i] - path) * stiffness);
    if constexpr (Yields) {
      // Mean in-plane stress minus the out-of-plane stress.
      const double over = half_length * (1.0 - 2.0 * nu) * mean + normal[i] * volume[i];
      const double shear = half_length * radius;
      const double other = look_at[i] * volume[i] - std::sqrt(over * over + 3.0 * shear * shear);
      flow[i] = other;
      least = std::min(least, other);
    }
    damage[i] = rest;
    least = std::min(least, rest);
  }
  return least;
}

/// Computes margins in space on the safe side. n n' has the eigenvalues 1 and 0, so no principal or
/// von Mises stress exceeds the sum of the forces.
/// \return the least margin
double scan_space(const ExplicitModel& model, const ExplicitState& state, Index r, Left& left) {
  const LatticeRow& row = model.lattice.rows[r];
  const BondPointers<18> bond(model, state, r);
  const double* sum = state.now.sum.data() + state.now.places.first[r];
  const double* volume = model.volume.data() + row.first;
  const double* crack_at = state.crack_at.data() + row.first;
  const double* look_at = model.material.yields ? state.flow.look_at.data() + row.first : nullptr;
  const double* quiet_until = state.quiet_until.data() + row.first;
  const double path = path_of(model, state, r), stiffness = stress_stiffness(model);
  double least = never;
  for (Index i = 0; i < row.size; ++i) {
    const double shared = model.moduli.sum * sum[i];
    double pull = 0.0, size = 0.0;
    for (int j = 0; j < 18; ++j) {
      const int k = j % 9;
      const double half_length = 0.5 * model.lattice.bonds[k].length;
      const double plastic = look_at != nullptr ? std::abs(bond.half[j][i]) : 0.0;
      const double own = model.own_modulus(k) * bond.effective[j][i];
      const double part = bond.present[j][i] * shared;
      // Damage may also reduce the shared part.
      const double excess = model.own_modulus(k) * plastic;
      pull += half_length * std::max(0.0, std::max(own, own + part) + excess);
      size += half_length * (std::max(std::abs(own), std::abs(own + part)) + excess);
    }
    left.damage[i] = std::max(crack_at[i] * volume[i] - pull, (quiet_until[i] - path) * stiffness);
    if (look_at != nullptr) left.flow[i] = look_at[i] * volume[i] - size;
    least = std::min({least, left.damage[i], left.flow[i]});
  }
  return least;
}

double scan_stress(const ExplicitModel& model, const ExplicitState& state, Index r,
                   std::uint8_t bond_changes, Left& left) {
  if (model.lattice.dim == 3) return scan_space(model, state, r, left);
  const bool weakened = (bond_changes & BondChanges::weakened) != 0;
  if (!model.material.yields) {
    return weakened ? scan_plane<RowBonds::weakened, false>(model, state, r, left)
                    : scan_plane<RowBonds::whole, false>(model, state, r, left);
  }
  if (weakened) return scan_plane<RowBonds::weakened, true>(model, state, r, left);
  return (bond_changes & BondChanges::altered) != 0
             ? scan_plane<RowBonds::flowed, true>(model, state, r, left)
             : scan_plane<RowBonds::whole, true>(model, state, r, left);
}

}  // namespace

std::uint8_t changes_of_bonds(const LatticeRows& lattice, const ExplicitState& state, Index row) {
  std::uint8_t bond_changes = state.bond_changes[row];
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const Index in = lattice.row_in[row * lattice.own_bonds() + k];
    if (in != no_index) bond_changes |= state.bond_changes[in];
  }
  return bond_changes;
}

bool has_weakened_rows(const ExplicitModel& model, const ExplicitState& state, Index row) {
  const Index reach = model.lattice.reach, rows = static_cast<Index>(state.bond_changes.size());
  const auto first = state.bond_changes.begin() + std::max<Index>(0, row - 2 * reach);
  const auto last = state.bond_changes.begin() + std::min<Index>(rows - 1, row + reach) + 1;
  return std::any_of(first, last,
                     [](auto bond_changes) { return (bond_changes & BondChanges::weakened) != 0; });
}

bool is_scan_due(const ExplicitModel& model, ExplicitState& state, Index row) {
  // Rows are numbered so that the bonds of a particle's neighbours belong to rows near its own.
  const Index reach = model.lattice.reach, rows = static_cast<Index>(state.fastest.size());
  const Index first = std::max<Index>(0, row - 2 * reach);
  const Index last = std::min<Index>(rows - 1, row + reach);
  const double fastest =
      *std::max_element(state.fastest.begin() + first, state.fastest.begin() + last + 1);
  // Rates along the present directions slightly exceed the changes of stretches.
  constexpr double margin = 1.01;
  state.slack[row] -= margin * fastest;
  state.path[row] += margin * fastest;
  return !(state.slack[row] > 0.0);
}

double stress_stiffness(const ExplicitModel& model) {
  double own = 0.0, weights = 0.0;
  const int bonds = model.lattice.own_bonds();
  for (int k = 0; k < bonds; ++k) {
    const double length = model.lattice.bonds[k].length;
    own += length * model.own_modulus(k);
    weights += length;
  }
  return own + 2.0 * weights * std::abs(model.moduli.sum) * weights / model.lattice.spacing;
}

void scan_row(const ExplicitModel& model, ExplicitState& state, Index r, DueParticles& due) {
  const LatticeRow& row = model.lattice.rows[r];
  thread_local Left left;
  left.damage.resize(row.size);
  left.flow.assign(row.size, never);
  const std::uint8_t bond_changes = changes_of_bonds(model.lattice, state, r);
  const double least = scan_stress(model, state, r, bond_changes, left);
  // LatticeDamage::watch sets crack_at by the consistent rules only.
  const bool cracked =
      (state.row_changes[r] & RowChanges::cracked) != 0 && model.rules != LatticeRules::consistent;
  due.damage.clear();
  due.flow.clear();
  for (Index i = 0; i < row.size; ++i) {
    const bool grows = cracked && state.crack_band[row.first + i] > 0.0;
    if (left.damage[i] < 0.0 || grows) due.damage.push_back(row.first + i);
    if (left.flow[i] < 0.0) due.flow.push_back(row.first + i);
  }
  // Factors change with the sign of a stretch, so weakened rows have no slack.
  const bool weakened = (bond_changes & BondChanges::weakened) != 0;
  state.slack[r] = weakened ? 0.0 : least / stress_stiffness(model);
}

}  // namespace perilink
