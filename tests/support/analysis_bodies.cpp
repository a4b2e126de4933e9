#include "support/analysis_bodies.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/textbook_beams.hpp"

namespace perilink::test {

AnalysisBody free_body(Network network) {
  AnalysisBody body;
  const std::size_t slots = static_cast<std::size_t>(network.particles.size()) * network.width();
  body.network = std::move(network);
  body.unknowns.width = body.network.width();
  body.unknowns.number.assign(slots, 0);
  body.unknowns.prescribed.assign(slots, 0.0);
  body.loads.forces.assign(slots, 0.0);
  return body;
}

void number(AnalysisBody& body, const IsHeld& is_held, bool embedded) {
  std::vector<std::uint8_t> held;
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    for (int a = 0; a < body.network.width(); ++a) held.push_back(is_held(i, a));
  }
  hold_idle_rotations(body.network, held);
  hold_embedded_points(body.network, held);
  body.unknowns = number_unknowns(body.network.width(), held, body.unknowns.prescribed);
  if (embedded) carry_embedded_points(body.network, body.unknowns);
}

AnalysisBody make_chains(int columns, int rows, bool driven, double stiffness, double limit,
                         const std::vector<RebarLine>& bars, BarMaterial bar) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.spacing = input.horizon = 1.0;
  input.solid = {{{0.0, 0.0, 0.0}, {1.0 * columns, rows - 1.0, 0.0}}};
  input.material = {0};
  NetworkInput constants = network_input(input);
  constants.bars = bars;
  constants.bar_materials.assign(bars.size(), bar);
  AnalysisBody body = free_body(build_network(make_body(input), constants));
  std::fill_n(body.network.stiffness.begin(), body.network.first_slip_spring, stiffness);
  std::fill_n(body.network.critical_stretch.begin(), body.network.first_slip_spring, limit);
  const auto at_end = [&](Index i, double x) {
    return std::abs(body.network.particles.position(i)[0] - x) < 1e-9;
  };
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    if (!at_end(i, columns)) continue;
    (driven ? body.unknowns.prescribed : body.loads.forces)[slot(body, i, 0)] = 1.0;
  }
  number(body, [&](Index i, int axis) {
    return axis == 1 || at_end(i, 0.0) || (driven && at_end(i, columns));
  });
  body.reference = {driven, driven ? 1.0 : 1.0 * rows};
  return body;
}

AnalysisBody make_square() {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.spacing = 1.0;
  input.horizon = 1.5;
  input.solid = {{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}};
  input.material = {0};
  AnalysisBody body = free_body(build_network(make_body(input), network_input(input)));
  std::fill(body.network.stiffness.begin(), body.network.stiffness.end(), 1.0);
  std::fill(body.network.critical_stretch.begin(), body.network.critical_stretch.end(), 0.01);
  const auto right = [&](Index i) { return body.network.particles.position(i)[0] > 0.5; };
  for (Index i = 0; i < 4; ++i) {
    if (right(i)) body.loads.forces[slot(body, i, 0)] = 1.0;
  }
  number(body, [&](Index i, int axis) { return axis == 1 || !right(i); });
  body.reference = {false, 2.0};
  return body;
}

Index bond_between(const Network& network, std::array<double, 2> from, std::array<double, 2> to) {
  const auto is_at = [&](Index i, const std::array<double, 2>& point) {
    const auto x = network.particles.position(i);
    return std::hypot(x[0] - point[0], x[1] - point[1]) < 1e-9;
  };
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    if ((is_at(i, from) && is_at(j, to)) || (is_at(i, to) && is_at(j, from))) return e;
  }
  return no_index;
}

std::vector<Index> bonds_of_row(const Network& network, double y) {
  std::vector<Index> row;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (std::abs(network.bonds.direction(e)[0]) < 0.5) continue;
    if (std::abs(network.particles.position(network.bonds.second[e])[1] - y) < 1e-9) {
      row.push_back(e);
    }
  }
  return row;
}

std::string to_string(const BlockCase& block) {
  return (block.micropolar ? "micropolar_" : "") + block.lattice.name +
         (block.driven ? "_driven" : "_pulled") + (block.bar ? "_bar" : "") +
         (block.toothed ? "_toothed" : "") + (block.closing ? "_closing" : "") +
         (block.slipping ? "_slipping" : "");
}

AnalysisBody make_block(const BlockCase& block) {
  const LatticeInput input = body_input(block.lattice, block.columns);
  NetworkInput constants = block.micropolar ? micropolar_input(input) : network_input(input);
  const Vector3 end = input.solid[0].upper;
  if (block.bar) {
    // Yields at about the stretch at which bonds break.
    constants.bars = {
        {{0.01, 0.4 * end[1], 0.45 * end[2]}, {end[0] - 0.01, 0.4 * end[1], 0.45 * end[2]}}};
    constants.bar_materials = {{200.0, 0.005, 7.0, false}};
    if (block.slipping) {
      constants.bars[0].embedded = true;
      constants.bar_materials[0].bond.perimeter = 0.4;
      constants.bar_materials[0].bond.curve = ForceCurve{{{1e-4, 0.3}, {1e-3, 0.4}}};
    }
  }
  AnalysisBody body = free_body(build_network(make_body(input), constants));
  std::mt19937 random(11);  // fixed: one body in all runs
  std::uniform_real_distribution<double> scatter(1.0 - block.scatter, 1.0 + block.scatter);
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    const double factor = scatter(random);
    if (!body.network.is_segment(e)) body.network.critical_stretch[e] *= factor;
  }
  if (block.toothed) body.network.laws.front() = three_segments();
  if (block.closing) body.network.laws.front() = body.network.laws.front().closing();

  const Particles& particles = body.network.particles;
  // Cell-centred particles lie half a spacing inside the faces; ghosts carry no load.
  const double margin = 0.6 * input.spacing;
  const auto in_solid = [&](Index i) { return particles.kind[i] == ParticleKind::solid; };
  const auto left = [&](Index i) { return in_solid(i) && particles.position(i)[0] < margin; };
  const auto right = [&](Index i) {
    return in_solid(i) && particles.position(i)[0] > end[0] - margin;
  };
  const Bonds& bonds = body.network.bonds;
  for (Index e = 0; e < bonds.size(); ++e) {
    for (const Index i : {bonds.first[e], bonds.second[e]}) {
      if (left(i) || right(i)) {
        body.network.critical_stretch[e] = std::numeric_limits<double>::infinity();
      }
    }
  }
  double total = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    if (!right(i)) continue;
    (block.driven ? body.unknowns.prescribed : body.loads.forces)[slot(body, i, 0)] =
        block.driven ? 1.0 : particles.volumes[i];
    total += particles.volumes[i];
  }
  body.reference = {block.driven, block.driven ? 1.0 : total};
  const auto is_held = [&](Index i, int axis) {
    return left(i) || (block.driven && axis == 0 && right(i));
  };
  number(body, is_held, !block.slipping);
  return body;
}

namespace {

/// Returns the stiffness against change of length only, for the motions of both ends.
template <class Real>
MatrixOf<Real> axial_stiffness(const Network& network, Index e) {
  const int width = network.width();
  Eigen::Matrix<Real, Eigen::Dynamic, 1> n(2 * width);
  n.setZero();
  for (int a = 0; a < network.dim(); ++a) {
    n[width + a] = network.bonds.direction(e)[a];
    n[a] = -n[width + a];
  }
  return network.stiffness[e] * n * n.transpose();
}

template <class Real>
MatrixOf<Real> stiffness_now(const Network& network, Secants secants, Index e) {
  MatrixOf<Real> block = secants[e] * element_stiffness<Real>(network, e);
  const double axial = secants.axial(e) - secants[e];
  if (axial != 0.0) block += axial * axial_stiffness<Real>(network, e);
  return block;
}

/// Returns the first index of an end's unknowns in the vector of all particles.
Index slot_of_end(const Network& network, Index e, Index k) {
  const int width = network.width();
  return k < width ? network.bonds.first[e] * width + k
                   : network.bonds.second[e] * width + k - width;
}

}  // namespace

template <class Real>
Eigen::MatrixX<Real> dense_stiffness(const Network& network, Secants secants) {
  const Index slots = network.particles.size() * network.width();
  Eigen::MatrixX<Real> matrix = Eigen::MatrixX<Real>::Zero(slots, slots);
  for (Index e = 0; e < network.num_elements(); ++e) {
    const MatrixOf<Real> block = stiffness_now<Real>(network, secants, e);
    for (Index row = 0; row < block.rows(); ++row) {
      for (Index col = 0; col < block.cols(); ++col) {
        matrix(slot_of_end(network, e, row), slot_of_end(network, e, col)) += block(row, col);
      }
    }
  }
  return matrix;
}

template Eigen::MatrixXd dense_stiffness(const Network& network, Secants secants);
template Eigen::MatrixX<long double> dense_stiffness(const Network& network, Secants secants);

Eigen::VectorXd dense_displacement(const AnalysisBody& body, Secants secants,
                                   const std::vector<std::uint8_t>& left_out) {
  const Network& network = body.network;
  std::vector<Index> unknown, place(body.unknowns.number.size(), no_index);
  for (std::size_t k = 0; k < place.size(); ++k) {
    if (body.unknowns.number[k] == no_index || (!left_out.empty() && left_out[k])) continue;
    place[k] = static_cast<Index>(unknown.size());
    unknown.push_back(static_cast<Index>(k));
  }
  const auto size = static_cast<Index>(unknown.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd load(size);
  for (Index row = 0; row < size; ++row) load[row] = body.loads.forces[unknown[row]];
  for (Index e = 0; e < network.num_elements(); ++e) {
    const ElementMatrix block = stiffness_now<double>(network, secants, e);
    for (Index a = 0; a < block.rows(); ++a) {
      const Index row = place[slot_of_end(network, e, a)];
      if (row == no_index) continue;
      for (Index b = 0; b < block.cols(); ++b) {
        const Index slot = slot_of_end(network, e, b), col = place[slot];
        if (col == no_index) load[row] -= block(a, b) * body.unknowns.prescribed[slot];
        if (col != no_index) matrix(row, col) += block(a, b);
      }
    }
  }
  // The faster solver of Eigen, for bodies without loose particles.
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  const bool positive = factor.info() == Eigen::Success;
  const Eigen::VectorXd solution =
      positive ? Eigen::VectorXd(factor.solve(load)) : Eigen::VectorXd(matrix.ldlt().solve(load));
  Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(
      body.unknowns.prescribed.data(), static_cast<Index>(body.unknowns.prescribed.size()));
  for (Index row = 0; row < size; ++row) result[unknown[row]] = solution[row];
  return result;
}

double difference(std::span<const double> displacement, const Eigen::VectorXd& reference,
                  const std::vector<std::uint8_t>& left_out) {
  double largest = 0.0;
  for (std::size_t k = 0; k < displacement.size(); ++k) {
    if (!left_out.empty() && left_out[k]) continue;
    largest = std::max(largest, std::abs(displacement[k] - reference[static_cast<Index>(k)]));
  }
  return largest / reference.cwiseAbs().maxCoeff();
}

double extension_of(const Network& network, std::span<const double> displacement, Index e) {
  double extension = 0.0;
  for (int a = 0; a < network.dim(); ++a) {
    extension += network.bonds.direction(e)[a] *
                 (displacement[network.bonds.second[e] * network.width() + a] -
                  displacement[network.bonds.first[e] * network.width() + a]);
  }
  return extension;
}

double stretch(const Network& network, std::span<const double> displacement, Index e) {
  const double length = network.bonds.lengths[e];
  const double extension = extension_of(network, displacement, e);
  if (!network.carries_moments()) return extension / length;
  const double equivalent =
      std::sqrt(2.0 * element_energy(network, displacement, e) / network.stiffness[e]);
  // Bonds that symmetry keeps at constant length do not break.
  return (extension > 1e-6 * equivalent ? equivalent : extension) / length;
}

double stored_energy(const Network& network, Secants secants,
                     std::span<const double> displacement) {
  double energy = 0.0;
  for (Index e = 0; e < network.num_elements(); ++e) {
    energy += secants[e] * element_energy(network, displacement, e);
    const double extension = extension_of(network, displacement, e);
    energy += 0.5 * network.stiffness[e] * (secants.axial(e) - secants[e]) * extension * extension;
  }
  return energy;
}

}  // namespace perilink::test
