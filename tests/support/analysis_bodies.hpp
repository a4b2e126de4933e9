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
AnalysisBody free_body(Network network);

/// Which component of which particle has a prescribed displacement.
using IsHeld = std::function<bool(Index particle, int axis)>;

/// \param carried  whether anchors follow particles; those of explicit runs stand still
void number(AnalysisBody& body, const IsHeld& is_held, bool embedded = true);

inline std::size_t slot(const AnalysisBody& body, Index particle, int axis) {
  return static_cast<std::size_t>(particle) * body.network.width() + axis;
}

/// Rows of `columns` bonds in series that know nothing of one another: a square lattice of unit
/// spacing whose particles keep their y, each bonded to its four neighbours. The left end is held,
/// the right one pulled by 1 per row or moved by 1. All bonds along x have the stiffness
/// `stiffness` and the critical stretch `limit`, so that every figure can be worked out by hand.
AnalysisBody make_chains(int columns, int rows, bool driven, double stiffness, double limit,
                         const std::vector<RebarLine>& bars = {}, BarMaterial bar = {});

/// Four particles at the corners of a unit square, every pair bonded with stiffness 1 and critical
/// stretch 0.01. The left two are held, the right ones keep their y and are pulled by 1 each. With
/// horizontal bonds (stiffness 1) and diagonals (1/2 along x) the right ones are independent:
/// u = 1 / (1 + 1/2) = 2/3, without its horizontal bond 1 / (1/2) = 2.
AnalysisBody make_square();

/// Number of the bond between two points.
Index bond_between(const Network& network, std::array<double, 2> from, std::array<double, 2> to);

/// Numbers of the bonds along x that end at height y, from left to right.
std::vector<Index> bonds_of_row(const Network& network, double y);

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

std::string to_string(const BlockCase& block);

inline std::ostream& operator<<(std::ostream& out, const BlockCase& block) {
  return out << to_string(block);
}

/// A law between brittle bonds and bars that yield.
inline BondLaw three_segments() { return BondLaw::saw_tooth({{1.0, 1.0}, {0.6, 1.4}, {0.2, 3.0}}); }

/// Block held at the left face and pulled at (or moved by 1 with) the right one. Nothing breaks at
/// the particles of these faces, so that the block fails between them.
AnalysisBody make_block(const BlockCase& block);

/// Stiffness over all components, supported ones and all, as a dense matrix.
Eigen::MatrixXd dense_stiffness(const Network& network, Secants secants);

/// Displacement at load factor 1 of the components whose flag in `left_out` is zero (all, when it
/// is empty); the others stay zero.
Eigen::VectorXd dense_displacement(const AnalysisBody& body, Secants secants,
                                   const std::vector<std::uint8_t>& left_out = {});

/// Largest difference of the components that are not left out, relative to the largest
/// displacement.
double difference(std::span<const double> displacement, const Eigen::VectorXd& reference,
                  const std::vector<std::uint8_t>& left_out = {});

double extension_of(const Network& network, std::span<const double> displacement, Index e);

/// Extension of an element per length; of a micropolar bond in tension the stretch of equal energy.
double stretch(const Network& network, std::span<const double> displacement, Index e);

/// Energy stored in all elements.
double stored_energy(const Network& network, Secants secants, std::span<const double> displacement);

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
