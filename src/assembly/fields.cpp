#include "assembly/fields.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "assembly/internal_force.hpp"
#include "assembly/results/neighbor_gradients.hpp"
#include "base/dense/decompositions.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

/// Computes the weights of the least-squares fit G xi = u_j - u_i: G = (sum du xi')
/// (sum xi xi')^-1.
template <int Dim>
bool fit_linear(std::span<const double> offsets, std::span<const double> /*marks*/,
                std::span<double> weights) {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  const Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>> xi(
      offsets.data(), Dim, static_cast<Eigen::Index>(offsets.size() / Dim));
  const Matrix shape = xi * xi.transpose();
  const Eigen::Vector<double, Dim> squares = eigenvalues(shape);
  // Squared sines of the angles between bonds; round-off leaves 1e-15.
  if (!(squares[0] > 1e-10 * squares[Dim - 1])) return false;
  Eigen::Map<Eigen::Matrix<double, Dim, Eigen::Dynamic>>(weights.data(), Dim, xi.cols()) =
      shape.inverse() * xi;
  return true;
}

template <int Dim>
void fill_principal_strains(const Network& network, const Csr& neighbourhoods, Secants secants,
                            std::span<const double> displacement, Strain measure,
                            std::vector<double>& strains) {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  constexpr Index block = NeighborGradients<Dim>::block;
#pragma omp parallel for schedule(dynamic)
  for (Index begin = 0; begin < neighbourhoods.rows(); begin += block) {
    NeighborGradients<Dim> gradients(network.particles, displacement, Dim, fit_linear<Dim>);
    std::vector<Index> neighbors;
    for (Index i = begin; i < std::min(begin + block, neighbourhoods.rows()); ++i) {
      neighbors.clear();
      for (const Index e : neighbourhoods.row(i)) {
        if (secants[e] > 0.0) neighbors.push_back(network.bonds.other_end(e, i));
      }
      Matrix gradient;
      if (!gradients.find(i, neighbors, gradient)) continue;
      Matrix strain = 0.5 * (gradient + gradient.transpose());
      if (measure == Strain::green) strain += 0.5 * gradient.transpose() * gradient;
      const Eigen::Vector<double, Dim> principal = eigenvalues(strain);
      for (int n = 0; n < Dim; ++n) {
        strains[static_cast<std::size_t>(i) * Dim + n] = principal[Dim - 1 - n];
      }
    }
  }
}

/// Calls visit(element, energy [force length]) for every element.
template <class Visit>
void for_each_truss_energy(const Network& network, Secants secants,
                           std::span<const double> displacement, Strain measure, Visit visit) {
  const Bonds& bonds = network.bonds;
  const int dim = network.dim();
  for (Index e = 0; e < bonds.size(); ++e) {
    const auto n = bonds.direction(e);
    double extension = 0.0, square = 0.0;
    for (int axis = 0; axis < dim; ++axis) {
      const double apart = displacement[static_cast<std::size_t>(bonds.second[e]) * dim + axis] -
                           displacement[static_cast<std::size_t>(bonds.first[e]) * dim + axis];
      extension += n[axis] * apart;
      square += apart * apart;
    }
    if (measure == Strain::green) extension += 0.5 * square / bonds.length(e);
    visit(e, 0.5 * network.stiffness[e] * secants.axial(e) * extension * extension);
  }
}

template <int Dim, class Visit>
void for_each_frame_energy(const Network& network, Secants secants, std::span<const double> motion,
                           Visit visit) {
  using Modes = FrameModes<Dim>;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Modes modes = frame_modes<Dim>(network, e);
    const double* first =
        motion.data() + static_cast<std::size_t>(network.bonds.first[e]) * Modes::width;
    const double* second =
        motion.data() + static_cast<std::size_t>(network.bonds.second[e]) * Modes::width;
    double energy = 0.0;
    for (int m = 0; m < Modes::count; ++m) {
      const double deformation = modes.deformation(m, first, second);
      const double secant = m == 0 ? secants.axial(e) : secants[e];
      energy += 0.5 * modes.stiffness[m] * secant * deformation * deformation;
    }
    visit(e, energy);
  }
}

}  // namespace

std::vector<double> particle_damage(const Network& network, const Csr& neighbourhoods,
                                    Secants secants) {
  std::vector<double> damage(static_cast<std::size_t>(neighbourhoods.rows()), 0.0);
  if (secants.size() == 0) return damage;  // undamaged
  for (Index i = 0; i < neighbourhoods.rows(); ++i) {
    double all = 0.0;
    double lost = 0.0;
    for (const Index e : neighbourhoods.row(i)) {
      if (network.is_contact(e)) continue;
      const double volume = network.particles.volumes[network.bonds.other_end(e, i)];
      all += volume;
      if (!network.law(e).endless()) lost += (1.0 - secants.least(e)) * volume;
    }
    if (all > 0.0) damage[i] = lost / all;
  }
  return damage;
}

std::vector<double> translations(const Network& network, std::span<const double> motion) {
  const std::size_t dim = network.dim(), width = network.width();
  if (width == dim) return {motion.begin(), motion.end()};
  std::vector<double> result;
  result.reserve(motion.size() / width * dim);
  for (std::size_t slot = 0; slot < motion.size(); slot += width) {
    result.insert(result.end(), motion.begin() + slot, motion.begin() + slot + dim);
  }
  return result;
}

std::vector<double> rotations(const Network& network, std::span<const double> motion) {
  const std::size_t dim = network.dim(), width = network.width();
  std::vector<double> result;
  for (std::size_t slot = 0; slot < motion.size() && width > dim; slot += width) {
    result.insert(result.end(), motion.begin() + slot + dim, motion.begin() + slot + width);
  }
  return result;
}

std::vector<double> strain_energy_density(const Network& network, Secants secants,
                                          std::span<const double> motion, Strain measure) {
  std::vector<double> density(network.particles.volumes.size(), 0.0);
  const auto add = [&](Index e, double energy) {
    density[network.bonds.first[e]] += energy;
    // The point of a contact spring is no particle.
    density[network.is_contact(e) ? network.bonds.first[e] : network.bonds.second[e]] += energy;
  };
  if (!network.carries_moments()) {
    for_each_truss_energy(network, secants, motion, measure, add);
  } else if (network.dim() == 2) {
    for_each_frame_energy<2>(network, secants, motion, add);
  } else {
    for_each_frame_energy<3>(network, secants, motion, add);
  }
  std::vector<double> states;
  if (network.has_states()) states = extension_sums(network, secants, motion);
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (network.has_states()) density[i] += network.states->stiffness[i] * states[i] * states[i];
    density[i] = 0.5 * density[i] / network.particles.volumes[i];
  }
  return density;
}

std::vector<double> face_strains(const Network& network, const Csr& neighbourhoods, Secants secants,
                                 std::span<const double> motion) {
  using Matrix = Eigen::Matrix2d;
  const Shell& shell = *network.shell;
  std::vector<double> strains(static_cast<std::size_t>(neighbourhoods.rows()) * 3, 0.0);
  for (Index i = 0; i < neighbourhoods.rows(); ++i) {
    // Least squares of G xi = (e + z e') n + (g - z g') t over all bonds, with z = t/2 and -t/2.
    Matrix shape = Matrix::Zero(), faces[2] = {Matrix::Zero(), Matrix::Zero()};
    for (const Index e : neighbourhoods.row(i)) {
      if (!(secants[e] > 0.0)) continue;
      const Index ends[2] = {network.bonds.first[e], network.bonds.second[e]};
      const auto from = shell.mid_surface.position(ends[0]),
                 to = shell.mid_surface.position(ends[1]);
      const Eigen::Vector2d xi(to[0] - from[0], to[1] - from[1]);
      const Eigen::Vector2d n = xi.normalized(), t(-n[1], n[0]);
      const FrameModes<3> modes = frame_modes<3>(network, e);
      std::array<double, 6> deformation;
      for (int m = 0; m < 6; ++m) {
        deformation[m] = modes.deformation(m, motion.data() + std::size_t{6} * ends[0],
                                           motion.data() + std::size_t{6} * ends[1]);
      }
      shape += xi * xi.transpose();
      for (int face = 0; face < 2; ++face) {
        const double z = (face == 0 ? 0.5 : -0.5) * shell.thickness;
        faces[face] += ((deformation[0] + z * deformation[3]) * n +
                        (deformation[1] - z * deformation[5]) * t) *
                       xi.transpose();
      }
    }
    const Eigen::Vector2d squares = eigenvalues(shape);
    if (!(squares[0] > 1e-10 * squares[1])) continue;
    Eigen::Vector2d largest(0.0, 0.0);
    for (const Matrix& moments : faces) {
      const Matrix gradient = moments * shape.inverse();
      const Matrix strain = 0.5 * (gradient + gradient.transpose());
      const Eigen::Vector2d found = eigenvalues(strain);
      if (&moments == faces || found[1] > largest[1]) largest = found;
    }
    strains[std::size_t{3} * i] = largest[1];
    strains[std::size_t{3} * i + 1] = largest[0];
  }
  return strains;
}

std::vector<double> principal_strains(const Network& network, const Csr& neighbourhoods,
                                      Secants secants, std::span<const double> displacement,
                                      Strain measure) {
  std::vector<double> strains(displacement.size(), 0.0);
  if (network.dim() == 2) {
    fill_principal_strains<2>(network, neighbourhoods, secants, displacement, measure, strains);
  } else {
    fill_principal_strains<3>(network, neighbourhoods, secants, displacement, measure, strains);
  }
  return strains;
}

}  // namespace perilink
