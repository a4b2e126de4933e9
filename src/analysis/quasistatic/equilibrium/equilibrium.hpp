#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/quasistatic/equilibrium/constant_field.hpp"
#include "analysis/quasistatic/equilibrium/element_state.hpp"
#include "analysis/quasistatic/equilibrium/event_batch.hpp"
#include "analysis/quasistatic/equilibrium/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/removal.hpp"
#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "assembly/internal_force.hpp"
#include "base/error.hpp"
#include "network/loaded_network.hpp"
#include "solver/factor_routes.hpp"
#include "solver/linear_solver.hpp"

namespace perilink {

/// Thrown if initial cracks have cut off a piece that the first loads pull away.
class CracksSeparate : public SolverError {
 public:
  CracksSeparate() : SolverError("cracks have separated the body, and the loads pull it apart") {}
};

/// Options of the equilibrium solver.
struct EquilibriumOptions {
  FactorRoute route = FactorRoute::in_place;
  double residual_tolerance = 1e-10;
  int threads = 1;
  LinearSolver solver = LinearSolver::automatic;
  SubdomainSolverOptions subdomains = {};  ///< used if conjugate gradients replace the factor
  /// Relative difference of load factors within which elements whose laws have segments fail
  /// together; 0: one by one.
  double event_tolerance = 0.0;
};

/// Returns whether conjugate gradients replace a factor that follows every event. They do if the
/// options ask for them, and for batches in large three-dimensional bodies
/// (docs/theory/large_bodies.md, section 5).
bool is_followed_by_subdomains(const LoadedNetwork& problem, const EquilibriumOptions& options);

/// Pivots below this are recomputed from energies. The condition number of a slender or nearly
/// separated body takes most digits of the factor's pivots.
inline constexpr double uncertain_pivot = 1e-2;

/// Equilibrium of a network at load factor 1 while its elements lose stiffness. Holds the factor of
/// K, updates factor and displacements at events, and checks their accuracy. All event engines are
/// built on it.
class Equilibrium {
 public:
  /// \throws SolverError if the stiffness matrix is not positive definite
  /// \throws std::invalid_argument if conjugate gradients are asked for and particles are embedded
  Equilibrium(const LoadedNetwork& problem, const EquilibriumOptions& options)
      : Equilibrium(problem, options, problem.unknowns, nullptr) {}

  /// Finds the equilibrium of a damaged body.
  /// \param unknowns  motion of the particles; must outlive this object
  /// \param saved     state of this network with these unknowns; null: the intact body
  Equilibrium(const LoadedNetwork& problem, const EquilibriumOptions& options,
              const Unknowns& unknowns, const ElementState* saved);

  ElementState state() const;

  /// Returns the present stiffness of every element over its intact stiffness.
  Secants secants() const { return axial_.empty() ? Secants(secants_) : Secants(secants_, axial_); }

  /// Returns displacements at load factor 1, rotations included, shape (particles, width). They are
  /// current wherever an element can fail; others may belong to an earlier event.
  std::span<const double> where_elements_fail() const { return displacement_; }

  /// Returns displacements at load factor 1, current everywhere. Costs a solve if some are not.
  std::span<const double> displacement();

  LoadWork work();

  /// Reduces the secant of an element; zero breaks it. Damaged bonds then close in compression and
  /// open in tension.
  /// \throws SolverError if the contact states do not settle
  EventOutcome weaken(Index element, double secant);

  /// Reduces the secants of elements at once, with one solve for all. The factor is changed, made
  /// anew or kept as a preconditioner, whichever costs least (batches.cpp).
  /// \return nothing if elements must fail one by one to show whether the body survives; then all
  ///         is unchanged
  std::optional<EventOutcome> weaken_together(std::span<const Weakening> changes);

  /// Returns whether weaken() of one element needs no new factor and no columns.
  bool follows_single_events() const { return !lags_ && subdomains_ == nullptr; }
  /// Returns twice the energy of an element's lost stiffness, at load factor 1 or at the present
  /// one of a stage.
  double energy_lost(const Weakening& change) const;

  /// First contact state change of a damaged bond as the load factor of a stage moves, and the
  /// distance of the load factor to it.
  struct SideChange {
    Index element = no_index;
    double distance = 0.0;
  };
  /// \param distance  largest change of the load factor, with its sign; may be infinite
  SideChange next_side_change(double distance) const;

  /// Changes the contact states of damaged bonds with zero extension according to the direction of
  /// the load.
  /// \param direction  1 if the load factor grows, -1 if it falls
  EventOutcome pass_side_change(double direction);

  /// Removes an element in any case. A part that comes loose without load is held by ground
  /// springs, one per rigid-body mode, added before the removal. The rest of the body keeps its
  /// exact equilibrium.
  /// \return number of ground springs added
  /// \throws SolverError if a loaded part comes loose
  int cut(Index element);

  /// Makes a full residual check. Above the tolerance, refines the displacements once, then
  /// factorises anew.
  Balance check();

  /// Makes a cheap residual check where elements can fail, without a solve. Above the tolerance,
  /// calls check().
  /// \return balance whose stored energy is not a number if some displacements are not current
  Balance check_cheaply();

  /// Changes the unknowns that move the particles. Loads, secants and prescribed motions stay.
  /// \param unknowns  must outlive this object
  /// \return growth of the compliance, positive if particles became freer
  /// \throws SolverError while ground springs hold a part, or if the new unknowns leave a part
  ///         without support; particles then move as before
  /// \throws std::invalid_argument if prescribed motions differ
  Freedom change_motion(const Unknowns& unknowns);

  const Factor& factor() const { return *factor_; }
  FactorStatistics factor_statistics() const;
  /// Returns the largest error of displacement differences, also between particles at rest, caused
  /// by motion elsewhere in the body [length]. Zero for trusses with a factor.
  double noise() const { return 1e-12 * largest_motion_; }

  /// Returns noise() after events by columns, whose errors the next check() removes [length].
  double noise_of_events() const {
    return subdomains_ == nullptr ? noise() : options_.subdomains.tolerance * largest_motion_;
  }

  /// Returns whether an event of the element needs no solve by conjugate gradients.
  bool is_prepared(Index element) const;
  /// Solves for the columns of an element's event and of expected events, and removes errors that
  /// earlier events left.
  /// \param expected  elements that are expected to have events next, in order of load factor
  void prepare(Index element, std::span<const Index> expected);

  // Constant and growing loads: constant_loads.cpp.

  /// Starts a stage: other loads and prescribed motions grow, in addition to constant ones. All
  /// displacements are kept current.
  /// \param unknowns  former unknowns with other motions and possibly more clamps; must outlive
  ///                  this object, as must the loads
  void begin_stage(const Unknowns& unknowns, const Loads& loads, ConstantField constant);

  /// Goes on with a stage of a saved run, after begin_stage(): ground springs keep their loads.
  void go_on(const ElementState& saved);

  /// Restores the intact stiffness of elements at the start of the next stage.
  void restore(std::span<const Index> elements);

  /// Sets the load factor of the growing loads.
  void move_to(double load_factor) { constant_->load_factor = load_factor; }

  /// Returns the displacements by constant loads, at load factor 0.
  std::span<const double> constant_displacement() const { return constant_->displacement; }

  /// Returns the contribution of permanent loads to work().
  ConstantWork constant_work();

  /// Adds the contribution of permanent loads to check(); refines their displacements if necessary.
  void check_constant(Balance& balance);

 private:
  using Deformations = Removal::Deformations;
  using Batch = EventBatch;
  /// Residual above which errors of columns by conjugate gradients are removed, before they grow.
  static constexpr double fine_residual = 1e-13;
  static double norm(std::span<const double> values);
  void refresh_constant();
  void refine_permanent();
  void scatter_constant();
  void find_driven_slots();
  Removal removal_of(Index element, double secant) const;
  Removal removal_from(const Unknowns& unknowns, Index element, double secant) const;
  Deformations deformations_now(const Removal& removal, Index element) const;
  double release_constant(const Removal& removal, Index element, EventOutcome& outcome) const;
  void commit_both(const Removal& removal);
  void move_constant(const Removal& removal);
  void use_motion(const Unknowns& unknowns);
  void adopt_motion(bool resists = false);
  void adopt_load();
  void factorize_anew(bool resists = false);
  void find_driven_elements();
  void find_loaded_slots();
  void choose_current_unknowns();
  void choose_checked(const std::vector<std::uint8_t>& current);
  void factorize();
  void refresh();
  void refine(std::vector<double>& residual);
  void scatter_solution();
  void find_largest_motion();
  double largest_of(std::span<const double> displacement) const;
  double refine_followed(double size, std::vector<double>& residual);
  void judge_columns(std::span<const double> missing, std::span<const double> correction);
  void scatter_current();
  double work_of_forces() const;
  LoadWork sum_work();
  std::pair<double, double> driven_work_of(Index element) const;
  std::vector<double> present_load() const;
  double measure_residual(std::vector<double>& residual);
  double residual_of_current();
  Balance restore();
  bool is_frame(Index element) const {
    return network_.carries_moments() && network_.bending[element] > 0.0;
  }

  // Events and cuts: weakening.cpp.
  Deformations deformations(const Removal& removal, Index element) const;
  double prepare(Removal& removal);
  void measure_pivots(Removal& removal, Index element, double kept);
  void look_closely(Removal& removal, Index element, double kept);
  std::vector<double> refined_compliance(const Removal& removal);
  bool hold_free_modes(Removal& removal, Index element, double unloaded, int& springs);
  void follow(const EventOutcome& outcome);
  void commit(const Removal& removal, Index element, double secant);
  void add_ground_spring(Index unknown);
  void keep_all_current();

  // Several elements at once: batches.cpp.
  enum class Way { change, renew, gradients };
  Batch batch_of(std::span<const Weakening> changes) const;
  Way cheapest_way(const Batch& batch);
  void add_growth(const Removal& removal, Index element, const Deformations& before,
                  const Deformations& beside, EventOutcome& outcome) const;
  bool follow_batch(Batch& batch, double& pivot);
  bool resists_without(const Batch& batch);
  bool change_factor(const Batch& batch, double& pivot);
  void follow_forces(const ForceOfElements& forces);
  bool search_equilibrium();
  bool search_constant();
  int gradients(std::vector<double>& residual, std::span<double> solution, double energy);
  void multiply(std::span<const double> q, std::span<double> result);
  void take_back(std::span<const Weakening> changes, const Batch& batch);
  /// Returns whether solves by conjugate gradients with subdomains follow batches.
  bool follows_subdomains() const {
    return subdomains_ != nullptr && options_.event_tolerance > 0.0;
  }
  /// Makes the factor anew if it lags behind the secants.
  void bring_factor_up();

  // Crack closure: closing.cpp.
  bool is_closed(Index element) const { return axial_[element] > secants_[element]; }
  /// Extension at the present load factor, and its parts from growing and constant loads [length].
  struct Extension {
    double now = 0.0, growing = 0.0, constant = 0.0;
    double side = 0.0;  ///< negative: in compression, or about to be
  };
  /// Offsets of the ends in the displacements, and the direction.
  struct BondEnds {
    std::size_t first, second;
    double n[3];
  };
  std::span<const BondEnds> damaged_ends() const;
  template <int Dim>
  Extension extension_at(const BondEnds& bond) const;
  Extension extension_of(Index element) const;
  template <class Visit>
  void for_each_damaged(Visit visit) const;
  void add_growth(Index element, const Extension& before, EventOutcome& outcome) const;
  bool is_grounded(Index element) const;
  std::vector<Index> on_wrong_side() const;
  void turn(const std::vector<Index>& elements);
  void close(Index element);
  bool open(Index element);
  bool is_cheaper_anew(std::size_t changes) const;
  bool holds_apart(const std::vector<Index>& opened) const;
  bool change_together(const std::vector<Index>& wrong);
  std::vector<Index> change_sides(std::vector<Index> wrong);
  void settle_closing(EventOutcome& outcome);
  bool follow_sides(const std::vector<Index>& wrong, EventOutcome& outcome);
  std::vector<double> telling_motion() const;
  std::vector<double> telling_extensions(std::span<const double> motion) const;
  double line_minimum(std::span<const double> from, std::span<const double> to) const;
  void take_back(Index element, double secant);
  void open_cut_elements();

  // Separation and extended precision: separation.cpp.
  struct Refined {
    double residual = 0.0;  ///< norm of the residual forces
    double energy = 0.0;    ///< u'K u of the refined motion
    double error = 0.0;     ///< uncertainty of the energy after the last correction, with round-off
    double least_error = 0.0;  ///< part by the round-off of rigid motions
    /// Relative error of a solve by the factor, in the energy norm.
    double factor_error = 0.0;
  };
  /// Motion in extended precision: the unknowns, and all particles, shape (particles, width).
  struct FineMotion {
    std::vector<long double> unknowns, particles;
  };
  Refined refine_finely(std::span<const double> load, FineMotion& motion);
  std::pair<FineMotion, double> motion_of(const SparseVector& x);
  double pivot_by_energy(const SparseVector& x, Index element, double kept);
  bool hangs_on_weak_supports(double compliance_growth) const;
  bool rebuild_without(Index element, double kept);
  Balance refine_in_extended_precision();
  LoadWork work_by_energy();

  const Network& network_;
  const Unknowns* unknowns_;
  const Loads* loads_;
  EquilibriumOptions options_;
  std::unique_ptr<Factor> factor_;
  SubdomainFactor* subdomains_ = nullptr;  // the factor if it is a SubdomainFactor, or null

  /// Returns whether shear and bending of the element stay intact until it breaks.
  bool keeps_shear(Index element) const { return has_kept_ && network_.law(element).keeps_shear(); }
  double secant_of(Index element) const {
    return keeps_shear(element) ? axial_[element] : secants_[element];
  }
  void set_secant(Index element, double secant) {
    secants_[element] = secant > 0.0 && keeps_shear(element) ? 1.0 : secant;
    if (!axial_.empty()) axial_[element] = secant;
  }
  bool restored_ = false;     ///< elements were restored since the last factorisation
  bool lags_ = false;         ///< the factor belongs to an earlier body and only preconditions
  int gradient_steps_ = 0;    ///< steps of conjugate gradients in all batches
  bool found_sides_ = false;  ///< a search has found the last contact states and their equilibrium
  int last_steps_ = 0;        ///< steps of conjugate gradients in the last batch
  /// Savings that changes of an up-to-date factor would have brought [time].
  double missed_savings_ = 0.0;
  std::vector<double> secants_;
  std::vector<double> axial_;         ///< secants against a change of length; empty if none differs
  bool has_kept_;                     ///< Network::has_kept_shear()
  double direction_ = 0.0;            ///< sign of the load change while contact states settle
  std::vector<Index> changed_sides_;  ///< elements whose contact state changed last, in order
  std::vector<Index> damaged_;        ///< elements that close in compression
  mutable std::vector<BondEnds> damaged_ends_;  ///< ends of damaged_, as far as requested so far
  std::vector<Index> driven_elements_;  ///< elements with an end at a prescribed displacement
  std::vector<std::size_t> loaded_slots_;
  /// All elements of the unknowns in the cheap residual check.
  std::vector<Index> checked_elements_;
  std::vector<std::uint8_t> checked_;  ///< flag per unknown, while partial_
  bool partial_ = false;               ///< events update only displacements that a search needs
  bool stale_ = false;                 ///< the other displacements belong to an earlier event
  double force_work_ = 0.0;            ///< f'u, updated at events while partial_
  double driven_spring_work_ = 0.0;    ///< work of elastic supports at prescribed displacements
  std::vector<std::size_t> slot_of_;   ///< Unknowns::slots()
  /// With embedded particles: slots that unknowns move. The first list holds all, the second,
  /// while partial_, only slots that the search needs.
  std::vector<std::size_t> moving_slots_, current_slots_;
  std::vector<double> solution_;  ///< per unknown
  std::vector<double> displacement_;
  double noise_of_sides_ = 0.0;   ///< extensions below this have no contact state [length]
  double largest_motion_ = 0.0;   ///< largest |displacement_|, see noise() [length]
  std::vector<double> observed_;  ///< displacements of all particles for observers, while stale_
  std::vector<double> ground_stiffness_;  ///< per unknown; empty until a part came loose
  std::vector<double> ground_load_;
  std::optional<ConstantField> constant_;
  InternalForce internal_;
  ForcesAndEnergy<long double> fine_;
  double stiffness_sum_ = 0.0;        ///< sum over all elements and supports
  bool must_rebuild_ = false;         ///< the pivot is more accurate than the factor can follow
  bool look_closer_ = false;          ///< pivots that are not small may be noise too
  bool supports_alone_ = false;       ///< elastic supports hold most of the motion examined last
  bool resists_ = true;               ///< the refined body stores energy above round-off
  double last_work_ = 0.0;            ///< last f'u + R'd of a body under prescribed displacements
  int events_to_follow_ = 0;          ///< events left before the work is summed again
  double followed_compliance_ = 0.0;  ///< f'u - R'd, updated by its growth
  double followed_from_ = 0.0;        ///< f'u + R'd when it was last summed
  double load_norm_ = 0.0;
  double fresh_residual_ = 0.0;  ///< residual of a fresh factor, unrefined
  double residual_floor_ = 0.0;  ///< residual that a fresh factor can reach
  /// Refined::factor_error at the last refinement in extended precision.
  double factor_error_ = 0.0;
  double factor_floor_ = 0.0;  ///< Refined::factor_error that a fresh factor can reach
};

}  // namespace perilink
