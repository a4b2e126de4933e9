#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/micropolar_networks.hpp"
#include "support/textbook_beams.hpp"

/// \file
/// Small bodies with supports and loads, and a dense solution of their equilibrium that shares no
/// code with the program.

namespace perilink::test {

/// All that an analysis needs.
using AnalysisBody = LoadedNetwork;

/// Routes by which the factor of a matrix can follow a bond that breaks.
inline constexpr FactorRoute routes[] = {FactorRoute::in_place, FactorRoute::cholmod_updown,
                                         FactorRoute::refactorize};

inline EquilibriumOptions with_route(FactorRoute route) {
  EquilibriumOptions options;
  options.route = route;
  return options;
}

inline std::vector<double> intact(const Network& network) {
  return std::vector<double>(static_cast<std::size_t>(network.num_elements()), 1.0);
}

/// Body without supports and loads.
inline AnalysisBody free_body(Network network) {
  AnalysisBody body;
  const std::size_t slots = static_cast<std::size_t>(network.particles.size()) * network.width();
  body.network = std::move(network);
  body.unknowns.width = body.network.width();
  body.unknowns.number.assign(slots, 0);
  body.unknowns.prescribed.assign(slots, 0.0);
  body.loads.forces.assign(slots, 0.0);
  return body;
}

/// Which component of which particle has a prescribed displacement.
using IsHeld = std::function<bool(Index particle, int axis)>;

/// \param carried  whether anchors follow particles; those of explicit runs stand still
inline void number(AnalysisBody& body, const IsHeld& is_held, bool carried = true) {
  std::vector<std::uint8_t> held;
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    for (int a = 0; a < body.network.width(); ++a) held.push_back(is_held(i, a));
  }
  hold_idle_rotations(body.network, held);
  hold_anchors(body.network, held);
  body.unknowns = number_unknowns(body.network.width(), held, body.unknowns.prescribed);
  if (carried) carry_anchors(body.network, body.unknowns);
}

inline std::size_t slot(const AnalysisBody& body, Index particle, int axis) {
  return static_cast<std::size_t>(particle) * body.network.width() + axis;
}

/// Rows of `columns` bonds in series that know nothing of one another: a square lattice of unit
/// spacing whose particles keep their y, each bonded to its four neighbours. The left end is held,
/// the right one pulled by 1 per row or moved by 1. All bonds along x have the stiffness
/// `stiffness` and the critical stretch `limit`, so that every figure can be worked out by hand.
inline AnalysisBody make_chains(int columns, int rows, bool driven, double stiffness, double limit,
                                const std::vector<RebarLine>& bars = {}, BarMaterial bar = {}) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.spacing = input.horizon = 1.0;
  input.solid = {{{0.0, 0.0, 0.0}, {1.0 * columns, rows - 1.0, 0.0}}};
  input.material = {0};
  NetworkInput constants = network_input(input);
  constants.bars = bars;
  constants.bar_materials.assign(bars.size(), bar);
  AnalysisBody body = free_body(build_network(make_body(input), constants));
  std::fill_n(body.network.stiffness.begin(), body.network.first_tie, stiffness);
  std::fill_n(body.network.critical_stretch.begin(), body.network.first_tie, limit);
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

/// Four particles at the corners of a unit square, every pair bonded with stiffness 1 and critical
/// stretch 0.01. The left two are held, the right ones keep their y and are pulled by 1 each. With
/// horizontal bonds (stiffness 1) and diagonals (1/2 along x) the right ones are independent:
/// u = 1 / (1 + 1/2) = 2/3, without its horizontal bond 1 / (1/2) = 2.
inline AnalysisBody make_square() {
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

/// Number of the bond between two points.
inline Index bond_between(const Network& network, std::array<double, 2> from,
                          std::array<double, 2> to) {
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

/// Numbers of the bonds along x that end at height y, from left to right.
inline std::vector<Index> bonds_of_row(const Network& network, double y) {
  std::vector<Index> row;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (std::abs(network.bonds.direction(e)[0]) < 0.5) continue;
    if (std::abs(network.particles.position(network.bonds.second[e])[1] - y) < 1e-9) {
      row.push_back(e);
    }
  }
  return row;
}

/// How a block is loaded and made up.
struct BlockCase {
  LatticeCase lattice;
  bool driven = false;  ///< the right face is moved, not pulled
  bool bar = false;     ///< a bar that yields runs along x
  int columns = 6;
  double scatter = 0.1;  ///< relative scatter of the critical stretches; 0: exact ties by symmetry
  bool micropolar = false;  ///< Poisson's ratio 0.1, torsion 1.3
  bool toothed = false;     ///< bonds lose their stiffness in three steps
  bool closing = false;     ///< damaged ones resist compression like intact ones
  bool slipping = false;    ///< the bar has bond that falls in two steps; for explicit runs
};

inline std::string to_string(const BlockCase& block) {
  return (block.micropolar ? "micropolar_" : "") + block.lattice.name +
         (block.driven ? "_driven" : "_pulled") + (block.bar ? "_bar" : "") +
         (block.toothed ? "_toothed" : "") + (block.closing ? "_closing" : "") +
         (block.slipping ? "_slipping" : "");
}

inline std::ostream& operator<<(std::ostream& out, const BlockCase& block) {
  return out << to_string(block);
}

/// A law between brittle bonds and bars that yield.
inline BondLaw three_teeth() { return BondLaw::saw_tooth({{1.0, 1.0}, {0.6, 1.4}, {0.2, 3.0}}); }

/// Block held at the left face and pulled at (or moved by 1 with) the right one. Nothing breaks at
/// the particles of these faces, so that the block fails between them.
inline AnalysisBody make_block(const BlockCase& block) {
  const LatticeInput input = body_input(block.lattice, block.columns);
  NetworkInput constants = block.micropolar ? micropolar_input(input) : network_input(input);
  const Vector3 end = input.solid[0].upper;
  if (block.bar) {
    // Yields at about the stretch at which bonds break.
    constants.bars = {
        {{0.01, 0.4 * end[1], 0.45 * end[2]}, {end[0] - 0.01, 0.4 * end[1], 0.45 * end[2]}}};
    constants.bar_materials = {{200.0, 0.005, 7.0, false}};
    if (block.slipping) {
      constants.bars[0].anchored = true;
      constants.bar_materials[0].bond.perimeter = 0.4;
      constants.bar_materials[0].bond.curve = ForceCurve{{{1e-4, 0.3}, {1e-3, 0.4}}};
    }
  }
  AnalysisBody body = free_body(build_network(make_body(input), constants));
  std::mt19937 random(11);  // fixed: the same body in every run
  std::uniform_real_distribution<double> scatter(1.0 - block.scatter, 1.0 + block.scatter);
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    const double factor = scatter(random);
    if (!body.network.is_segment(e)) body.network.critical_stretch[e] *= factor;
  }
  if (block.toothed) body.network.laws.front() = three_teeth();
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

/// That of the change of length alone, for the motions of both ends.
inline Eigen::MatrixXd axial_stiffness(const Network& network, Index e) {
  const int width = network.width();
  Eigen::VectorXd n = Eigen::VectorXd::Zero(2 * width);
  for (int a = 0; a < network.dim(); ++a) {
    n[width + a] = network.bonds.direction(e)[a];
    n[a] = -n[width + a];
  }
  return network.stiffness[e] * n * n.transpose();
}

/// Stiffness over all components, supported ones and all, as a dense matrix.
inline Eigen::MatrixXd dense_stiffness(const Network& network, Secants secants) {
  const int width = network.width();
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(network.particles.size() * width, network.particles.size() * width);
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Eigen::MatrixXd block = secants[e] * element_stiffness(network, e) +
                                  (secants.axial(e) - secants[e]) * axial_stiffness(network, e);
    const Index i = network.bonds.first[e] * width, j = network.bonds.second[e] * width;
    matrix.block(i, i, width, width) += block.topLeftCorner(width, width);
    matrix.block(j, j, width, width) += block.bottomRightCorner(width, width);
    matrix.block(i, j, width, width) += block.topRightCorner(width, width);
    matrix.block(j, i, width, width) += block.bottomLeftCorner(width, width);
  }
  return matrix;
}

/// Displacement at load factor 1 of the components whose flag in `left_out` is zero (all, when it
/// is empty); the others stay zero.
inline Eigen::VectorXd dense_displacement(const AnalysisBody& body, Secants secants,
                                          const std::vector<std::uint8_t>& left_out = {}) {
  const Eigen::MatrixXd matrix = dense_stiffness(body.network, secants);
  const Eigen::VectorXd prescribed =
      Eigen::Map<const Eigen::VectorXd>(body.unknowns.prescribed.data(), matrix.rows());
  const Eigen::VectorXd forces =
      Eigen::Map<const Eigen::VectorXd>(body.loads.forces.data(), matrix.rows());
  const Eigen::VectorXd rhs = forces - matrix * prescribed;
  std::vector<Index> unknown;
  for (std::size_t k = 0; k < body.unknowns.number.size(); ++k) {
    if (body.unknowns.number[k] == no_index || (!left_out.empty() && left_out[k])) continue;
    unknown.push_back(static_cast<Index>(k));
  }
  const auto size = static_cast<Index>(unknown.size());
  Eigen::MatrixXd part(size, size);
  Eigen::VectorXd load(size);
  for (Index row = 0; row < size; ++row) {
    load[row] = rhs[unknown[row]];
    for (Index col = 0; col < size; ++col) part(row, col) = matrix(unknown[row], unknown[col]);
  }
  const Eigen::VectorXd solution = part.ldlt().solve(load);
  Eigen::VectorXd result = prescribed;
  for (Index row = 0; row < size; ++row) result[unknown[row]] = solution[row];
  return result;
}

/// Largest difference of the components that are not left out, relative to the largest
/// displacement.
inline double difference(std::span<const double> displacement, const Eigen::VectorXd& reference,
                         const std::vector<std::uint8_t>& left_out = {}) {
  double largest = 0.0;
  for (std::size_t k = 0; k < displacement.size(); ++k) {
    if (!left_out.empty() && left_out[k]) continue;
    largest = std::max(largest, std::abs(displacement[k] - reference[static_cast<Index>(k)]));
  }
  return largest / reference.cwiseAbs().maxCoeff();
}

inline double extension_of(const Network& network, std::span<const double> displacement, Index e) {
  double extension = 0.0;
  for (int a = 0; a < network.dim(); ++a) {
    extension += network.bonds.direction(e)[a] *
                 (displacement[network.bonds.second[e] * network.width() + a] -
                  displacement[network.bonds.first[e] * network.width() + a]);
  }
  return extension;
}

/// Extension of an element per length; of a micropolar bond in tension the stretch of equal energy.
inline double stretch(const Network& network, std::span<const double> displacement, Index e) {
  const double length = network.bonds.lengths[e];
  const double extension = extension_of(network, displacement, e);
  if (!network.carries_moments()) return extension / length;
  const double equivalent =
      std::sqrt(2.0 * element_energy(network, displacement, e) / network.stiffness[e]);
  // Bonds that symmetry neither stretches nor shortens do not break.
  return (extension > 1e-6 * equivalent ? equivalent : extension) / length;
}

/// Energy stored in all elements.
inline double stored_energy(const Network& network, Secants secants,
                            std::span<const double> displacement) {
  double energy = 0.0;
  for (Index e = 0; e < network.num_elements(); ++e) {
    energy += secants[e] * element_energy(network, displacement, e);
    const double extension = extension_of(network, displacement, e);
    energy += 0.5 * network.stiffness[e] * (secants.axial(e) - secants[e]) * extension * extension;
  }
  return energy;
}

/// Keeps the rows of a run; calls `look` at each.
class Recorder final : public StepObserver {
 public:
  using Look = std::function<void(const StepRecord&, StateSource&)>;
  explicit Recorder(Look look = {}, int stop_after = -1) : look_(look), stop_after_(stop_after) {}

  void on_step(const StepRecord& record, StateSource& source) override {
    rows.push_back(record);
    if (look_) look_(record, source);
  }
  void on_end(const StepRecord& last, StateSource& source) override {
    ++ends;
    const StepState state = source.state();
    broken_at_end = broken_bonds(state);
    row_at_end = last;
  }
  bool stop_requested() override { return static_cast<int>(rows.size()) == stop_after_; }

  static Index broken_bonds(const StepState& state) {
    return static_cast<Index>(std::count(state.secants.begin(), state.secants.end(), 0.0));
  }

  std::vector<StepRecord> rows;
  int ends = 0;
  Index broken_at_end = 0;
  StepRecord row_at_end;

 private:
  Look look_;
  int stop_after_;
};

inline DamageResult run(const AnalysisBody& body, const DamageOptions& options,
                        Recorder& recorder) {
  return run_damage_analysis(body, options, recorder);
}

}  // namespace perilink::test
