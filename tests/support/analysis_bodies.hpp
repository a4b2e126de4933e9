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
/// Small bodies with supports and loads. Their dense equilibrium solution shares no code with the
/// program.

namespace perilink::test {

/// Network with supports and loads.
using AnalysisBody = LoadedNetwork;

/// Routes by which a factor can follow a failed bond.
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
AnalysisBody free_body(Network network);

/// Whether a particle's component has a prescribed displacement.
using IsHeld = std::function<bool(Index particle, int axis)>;

/// Numbers the unknowns.
/// \param embedded  whether embedded points follow particles; in explicit runs they do not move
void number(AnalysisBody& body, const IsHeld& is_held, bool embedded = true);

inline std::size_t slot(const AnalysisBody& body, Index particle, int axis) {
  return static_cast<std::size_t>(particle) * body.network.width() + axis;
}

/// Independent rows of `columns` bonds in series: a square lattice of unit spacing, with four
/// neighbours per particle and no displacements along y. The left end is fixed; the right one has
/// the force 1 per row or the displacement 1. All bonds along x have the stiffness `stiffness` and
/// the critical stretch `limit`, so all results can be computed by hand.
AnalysisBody make_chains(int columns, int rows, bool driven, double stiffness, double limit,
                         const std::vector<RebarLine>& bars = {}, BarMaterial bar = {});

/// Four particles at the corners of a unit square, every pair bonded with stiffness 1 and critical
/// stretch 0.01. The left two are fixed, the right ones move along x only with the force 1 each.
/// Horizontal bonds have the stiffness 1 and diagonals 1/2 along x, so the right ones are
/// independent. Thus u = 1 / (1 + 1/2) = 2/3, or 1 / (1/2) = 2 without the horizontal bond.
AnalysisBody make_square();

/// Returns the number of the bond between two points.
Index bond_between(const Network& network, std::array<double, 2> from, std::array<double, 2> to);

/// Returns bonds along x at height y, from left to right.
std::vector<Index> bonds_of_row(const Network& network, double y);

/// Loads and laws of a block.
struct BlockCase {
  LatticeCase lattice;
  bool driven = false;  ///< the right face has displacements instead of forces
  bool bar = false;     ///< a yielding bar runs along x
  int columns = 6;
  double scatter = 0.1;     ///< relative scatter of the critical stretches; 0: symmetric bonds fail
                            ///< together
  bool micropolar = false;  ///< Poisson's ratio 0.1, torsion 1.3
  bool toothed = false;     ///< bonds lose their stiffness in three segments
  bool closing = false;     ///< damaged bonds have their full stiffness in compression
  bool slipping = false;    ///< the bar's slip springs soften in two segments; for explicit runs
};

std::string to_string(const BlockCase& block);

inline std::ostream& operator<<(std::ostream& out, const BlockCase& block) {
  return out << to_string(block);
}

/// Returns a law between brittle bonds and yielding bars.
inline BondLaw three_segments() { return BondLaw::saw_tooth({{1.0, 1.0}, {0.6, 1.4}, {0.2, 3.0}}); }

/// Returns a block fixed at the left face and loaded at the right one. Bonds of particles on these
/// faces do not break, so the block fails between them.
AnalysisBody make_block(const BlockCase& block);

/// Returns the dense stiffness of all components, including supported ones.
template <class Real = double>
Eigen::MatrixX<Real> dense_stiffness(const Network& network, Secants secants);

/// Returns the displacement at load factor 1. Components with a nonzero flag in `left_out` stay
/// zero; empty: no such components.
Eigen::VectorXd dense_displacement(const AnalysisBody& body, Secants secants,
                                   const std::vector<std::uint8_t>& left_out = {});

/// Returns the largest difference of the components that are not left out, over the largest
/// displacement.
double difference(std::span<const double> displacement, const Eigen::VectorXd& reference,
                  const std::vector<std::uint8_t>& left_out = {});

double extension_of(const Network& network, std::span<const double> displacement, Index e);

/// Returns the strain of an element; for a micropolar bond in tension its equivalent stretch.
double stretch(const Network& network, std::span<const double> displacement, Index e);

/// Returns the energy stored in all elements.
double stored_energy(const Network& network, Secants secants, std::span<const double> displacement);

/// Stores the rows of a run and calls `look` for each.
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
