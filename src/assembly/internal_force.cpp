#include "assembly/internal_force.hpp"

#include <array>

#include "assembly/cell_terms.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

/// All elements of a network, as a list of indices.
struct AllElements {
  Index count;
  Index size() const { return count; }
  Index operator[](Index k) const { return k; }
};

/// Reading the elements takes most of the time. Consecutive elements mostly share their first
/// particle, so its motion and force stay in registers.
template <int Dim, class Real, class Elements>
void add_elements(const Network& network, const Elements& elements, Secants secants,
                  std::span<const Real> displacement, ForcesAndEnergy<Real>& result) {
  Real* forces = result.forces.data();
  const Bonds& bonds = network.bonds;
  const auto count = static_cast<Index>(elements.size());
  Real energy = 0.0;  // in a register: forces may alias the result
  for (Index k = 0; k < count;) {
    const Index own = bonds.first[elements[k]];
    std::array<Real, Dim> motion, force;
    const std::size_t first = static_cast<std::size_t>(own) * Dim;
    Real* own_force = forces + first;
    for (int axis = 0; axis < Dim; ++axis) {
      motion[axis] = displacement[first + axis];
      force[axis] = own_force[axis];
    }
    for (; k < count && bonds.first[elements[k]] == own; ++k) {
      const Index e = elements[k];
      const double* n = bonds.direction(e).data();
      const std::size_t second = static_cast<std::size_t>(bonds.second[e]) * Dim;
      Real* other_force = forces + second;
      Real extension = 0.0;
      for (int axis = 0; axis < Dim; ++axis) {
        extension += n[axis] * (displacement[second + axis] - motion[axis]);
      }
      const Real tension = network.stiffness[e] * secants.axial(e) * extension;
      energy += 0.5 * tension * extension;
      for (int axis = 0; axis < Dim; ++axis) {
        force[axis] -= tension * n[axis];
        other_force[axis] += tension * n[axis];
      }
    }
    for (int axis = 0; axis < Dim; ++axis) own_force[axis] = force[axis];
  }
  result.energy += energy;
}

template <class Real>
std::vector<Real> sums_of_extensions(const Network& network, Secants secants,
                                     std::span<const Real> displacement) {
  const Bonds& bonds = network.bonds;
  const std::size_t dim = network.dim();
  std::vector<Real> sums(displacement.size() / static_cast<std::size_t>(network.dim()));
  for (Index e = 0; e < network.num_elements(); ++e) {
    const auto n = bonds.direction(e);
    const std::size_t first = bonds.first[e], second = bonds.second[e];
    Real extension = 0.0;
    for (std::size_t axis = 0; axis < dim; ++axis) {
      extension += n[axis] * (displacement[second * dim + axis] - displacement[first * dim + axis]);
    }
    if (network.counts_for(e, first_end)) sums[first] += secants[e] * extension;
    if (network.counts_for(e, second_end)) sums[second] += secants[e] * extension;
  }
  return sums;
}

/// Adds the forces of the states: c_i s_i + c_j s_j in the bond between i and j, for sums that
/// include it.
template <int Dim, class Real>
void add_states(const Network& network, Secants secants, std::span<const Real> displacement,
                ForcesAndEnergy<Real>& result) {
  const Bonds& bonds = network.bonds;
  std::vector<Real> tension = sums_of_extensions(network, secants, displacement);
  for (std::size_t i = 0; i < tension.size(); ++i) {
    result.energy += 0.5 * network.states->stiffness[i] * tension[i] * tension[i];
    tension[i] *= network.states->stiffness[i];
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    const double* n = bonds.direction(e).data();
    const std::size_t first = bonds.first[e], second = bonds.second[e];
    const Real pull = secants[e] * ((network.counts_for(e, first_end) ? tension[first] : Real()) +
                                    (network.counts_for(e, second_end) ? tension[second] : Real()));
    for (int axis = 0; axis < Dim; ++axis) {
      result.forces[first * Dim + axis] -= pull * n[axis];
      result.forces[second * Dim + axis] += pull * n[axis];
    }
  }
}

template <int Dim, class Real, class Elements>
void add_frames(const Network& network, const Elements& elements, Secants secants,
                std::span<const Real> displacement, ForcesAndEnergy<Real>& result) {
  using Modes = FrameModes<Dim>;
  const auto count = static_cast<Index>(elements.size());
  for (Index k = 0; k < count; ++k) {
    const Index e = elements[k];
    if (secants.axial(e) == 0.0) continue;
    const Modes modes = frame_modes<Dim>(network, e);
    const std::size_t first = static_cast<std::size_t>(network.bonds.first[e]) * Modes::width;
    const std::size_t second = static_cast<std::size_t>(network.bonds.second[e]) * Modes::width;
    for (int m = 0; m < Modes::count; ++m) {
      const Real deformation =
          modes.deformation(m, displacement.data() + first, displacement.data() + second);
      const double secant = m == 0 ? secants.axial(e) : secants[e];
      const Real tension = modes.stiffness[m] * secant * deformation;
      result.energy += 0.5 * tension * deformation;
      for (int a = 0; a < Modes::width; ++a) {
        result.forces[first + a] += tension * modes.first[m][a];
        result.forces[second + a] += tension * modes.second[m][a];
      }
    }
  }
}

template <class Real, class Elements>
void add_bonds(const Network& network, const Elements& elements, Secants secants,
               std::span<const Real> displacement, ForcesAndEnergy<Real>& result) {
  result.energy = result.support_energy = 0.0;
  result.forces.assign(displacement.size(), 0.0);
  if (network.carries_moments()) {
    network.dim() == 2 ? add_frames<2>(network, elements, secants, displacement, result)
                       : add_frames<3>(network, elements, secants, displacement, result);
  } else {
    network.dim() == 2 ? add_elements<2>(network, elements, secants, displacement, result)
                       : add_elements<3>(network, elements, secants, displacement, result);
  }
}

template <class Real, class Elements>
void add_bonds_and_cells(const Network& network, const Elements& elements, Secants secants,
                         std::span<const Real> displacement, ForcesAndEnergy<Real>& result) {
  add_bonds(network, elements, secants, displacement, result);
  if (!network.cells) return;
  const int width = network.width();
  network.dim() == 2
      ? add_cells<2>(*network.cells, displacement, width, result.forces, result.energy)
      : add_cells<3>(*network.cells, displacement, width, result.forces, result.energy);
}

template <class Real>
void add_all(const Network& network, Secants secants, std::span<const Real> displacement,
             ForcesAndEnergy<Real>& result) {
  add_bonds_and_cells(network, AllElements{network.num_elements()}, secants, displacement, result);
  if (network.has_states()) {
    network.dim() == 2 ? add_states<2>(network, secants, displacement, result)
                       : add_states<3>(network, secants, displacement, result);
  }
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    const Real force = network.support_stiffness[slot] * displacement[slot];
    result.forces[slot] += force;
    result.support_energy += 0.5 * force * displacement[slot];
  }
  result.energy += result.support_energy;
}

}  // namespace

void internal_force(const Network& network, Secants secants, std::span<const double> displacement,
                    InternalForce& result) {
  add_all(network, secants, displacement, result);
}

void internal_force(const Network& network, Secants secants,
                    std::span<const long double> displacement,
                    ForcesAndEnergy<long double>& result) {
  add_all(network, secants, displacement, result);
}

void internal_force(const Network& network, Secants secants, std::span<const double> displacement,
                    std::span<const Index> elements, InternalForce& result) {
  add_bonds_and_cells(network, elements, secants, displacement, result);
}

InternalForce internal_force(const Network& network, Secants secants,
                             std::span<const double> displacement) {
  InternalForce result;
  internal_force(network, secants, displacement, result);
  return result;
}

std::vector<double> extension_sums(const Network& network, Secants secants,
                                   std::span<const double> displacement) {
  return sums_of_extensions(network, secants, displacement);
}

}  // namespace perilink
