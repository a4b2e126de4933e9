#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/quasistatic/equilibrium/constant_field.hpp"
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

/// Cracks that were there from the start have cut a piece off, and the first loads pull it away.
class CracksSeparate : public SolverError {
 public:
  CracksSeparate() : SolverError("cracks have separated the body, and the loads pull it apart") {}
};

/// How equilibrium is solved for.
struct EquilibriumOptions {
  FactorRoute route = FactorRoute::in_place;
  double residual_tolerance = 1e-10;
  int threads = 1;
  LinearSolver solver = LinearSolver::automatic;
  SubdomainSolverOptions subdomains = {};  ///< where conjugate gradients take the factor's place
  /// Elements whose laws have segments fail together where their load factors differ by this part
  /// of the smallest; 0: one by one.
  double event_tolerance = 0.0;
};

/// Whether conjugate gradients take the place of a factor that follows every event: where they are
/// asked for, and for batches in large bodies in space (docs/theory/large_bodies.md, section 5).
bool is_followed_by_subdomains(const LoadedNetwork& problem, const EquilibriumOptions& options);

/// Pivots below this are computed again from energies: a body that is slender or about to separate
/// has a condition number that takes most digits of what the factor says.
inline constexpr double uncertain_pivot = 1e-2;

/// Equilibrium of a network at load factor 1 while its elements lose stiffness: the factor of K and
/// the displacements that follow, with the looks that tell how far both can be trusted. All engines
/// that go from event to event stand on it.
class Equilibrium {
 public:
  /// \throws SolverError when the stiffness matrix is not positive definite
  /// \throws std::invalid_argument where boxes are asked for and something carries particles
  Equilibrium(const LoadedNetwork& problem, const EquilibriumOptions& options);

  /// Present stiffness of every element as a fraction of the intact one.
  Secants secants() const { return axial_.empty() ? Secants(secants_) : Secants(secants_, axial_); }

  /// Displacements at load factor 1, rotations included, shape (particles, width), right wherever
  /// an element can fail; elsewhere they may be those of an earlier event.
  std::span<const double> where_elements_fail() const { return displacement_; }

  /// Displacements at load factor 1, right everywhere: costs a solve where some are not.
  std::span<const double> displacement();

  LoadWork work();

  /// The element goes on with a smaller secant; zero: it breaks. Damaged bonds close where they are
  /// compressed then, and open where they are pulled.
  /// \throws SolverError where the latter does not end
  EventOutcome weaken(Index element, double secant);

  /// Elements that go on with smaller secants at once: one solution for all of them. Their factor
  /// is changed, made anew or left behind, whichever costs least (batches.cpp).
  /// \return nothing where one by one has to tell whether the body survives it: then all is as it
  ///         was
  std::optional<EventOutcome> weaken_together(std::span<const Weakening> changes);

  /// Whether weaken() of an element alone costs no new factor and no columns.
  bool follows_single_events() const { return !lags_ && subdomains_ == nullptr; }
  /// Twice the energy of what an element loses, at load factor 1 or at the present one of a stage.
  double energy_lost(const Weakening& change) const;

  /// The first damaged bond that closes or opens as the load factor of a stage moves on, and how
  /// far it has to.
  struct SideChange {
    Index element = no_index;
    double distance = 0.0;
  };
  /// \param distance  to go, with its sign; may be infinite
  SideChange next_side_change(double distance) const;

  /// At the present load factor all damaged bonds whose extension is zero take the side to which
  /// the load moves them.
  /// \param direction  1 where the load factor grows, -1 where it falls
  EventOutcome pass_side_change(double direction);

  /// Removes an element whatever it holds: a part that comes loose without load is held by ground
  /// springs, one per rigid-body mode, added to the factor before the element goes. The rest of the
  /// body keeps its exact equilibrium.
  /// \return number of ground springs added
  /// \throws SolverError when a loaded part comes loose
  int cut(Index element);

  /// Measures the residual of all particles; above the tolerance refines the displacement once,
  /// then factorises anew.
  Balance check();

  /// The residual where elements can fail alone, without a solve; above the tolerance check().
  /// \return without the stored energy (not a number) where some displacements are not current
  Balance check_cheaply();

  /// Particles move by other unknowns from now on; loads, secants and prescribed motions stay.
  /// \param unknowns  must outlive this
  /// \return growth of the compliance, positive where particles became freer
  /// \throws SolverError while ground springs hold something, and where something is not held by
  ///         the new unknowns; particles then move as before
  /// \throws std::invalid_argument where prescribed motions differ
  Freedom change_motion(const Unknowns& unknowns);

  const Factor& factor() const { return *factor_; }
  FactorStatistics factor_statistics() const;
  /// Smaller differences of displacements may be none, also between particles that do not move: the
  /// rest of the body leaves its errors there [length]. Of trusses by a factor zero.
  double noise() const { return 1e-12 * largest_motion_; }

  /// noise() after events by columns, whose errors the next check() takes away [length].
  double noise_of_events() const {
    return subdomains_ == nullptr ? noise() : options_.subdomains.tolerance * largest_motion_;
  }

  /// Whether an event of the element costs no solution by conjugate gradients.
  bool is_prepared(Index element) const;
  /// Solves for what an event of the element costs, with what is expected next, and takes away what
  /// earlier events have left.
  /// \param expected  elements that are likely to have events next, the likeliest first
  void prepare(Index element, std::span<const Index> expected);

  // Constant loads beside those that grow: constant_loads.cpp.

  /// Other loads and prescribed motions grow from now on, beside constant ones; all displacements
  /// are kept current.
  /// \param unknowns  those of before, with other motions; some may be gripped that moved. Must
  ///                  outlive this, as the loads must.
  void begin_stage(const Unknowns& unknowns, const Loads& loads, ConstantField constant);

  /// Elements take back their intact stiffness as the next stage begins.
  void restore(std::span<const Index> elements);

  /// The load factor of the loads that grow, which tells what an element carries.
  void move_to(double load_factor) { constant_->load_factor = load_factor; }

  /// Displacements by constant loads alone, those at load factor 0.
  std::span<const double> constant_displacement() const { return constant_->displacement; }

  /// What constant loads add to work().
  ConstantWork constant_work();

  /// The same for check(): refines the displacements by constant loads where it must.
  void check_constant(Balance& balance);

 private:
  using Deformations = Removal::Deformations;
  using Batch = EventBatch;
  /// Columns by conjugate gradients leave more than a factor does: a larger residual is taken away
  /// before it grows.
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
  void adopt_motion();
  void adopt_load();
  void factorize_anew();
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
  double ground_stiffness_of(Index unknown) const;
  Index most_mobile_unknown(const SparseVector& x);
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
  /// Whether solutions by conjugate gradients with boxes follow batches.
  bool follows_subdomains() const {
    return subdomains_ != nullptr && options_.event_tolerance > 0.0;
  }
  /// The factor is made anew where it lags behind the secants.
  void bring_factor_up();

  // Damaged bonds that close: closing.cpp.
  bool is_closed(Index element) const { return axial_[element] > secants_[element]; }
  /// At the present load factor, and the parts of loads that grow and that do not [length].
  struct Extension {
    double now = 0.0, growing = 0.0, constant = 0.0;
    double side = 0.0;  ///< negative: in compression, or about to be
  };
  /// Where the ends are in the displacements, and the direction.
  struct BondEnds {
    std::size_t first, second;
    double n[3];
  };
  BondEnds ends_of(Index element) const;
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
    double residual = 0.0;  ///< norm of the forces out of balance
    double energy = 0.0;    ///< u'K u of the refined motion
    double error = 0.0;     ///< uncertainty of the energy after the last correction, with round-off
    /// Relative error of a solution by the factor, in the norm of energy.
    double factor_error = 0.0;
  };
  /// A motion in extended precision: the unknowns, and all particles, shape (particles, width).
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
  SubdomainFactor* subdomains_ = nullptr;  // the factor, where it is one

  /// Whether its shear and bending stay as they are until it breaks.
  bool keeps_shear(Index element) const { return has_kept_ && network_.law(element).keeps_shear(); }
  double secant_of(Index element) const {
    return keeps_shear(element) ? axial_[element] : secants_[element];
  }
  void set_secant(Index element, double secant) {
    secants_[element] = secant > 0.0 && keeps_shear(element) ? 1.0 : secant;
    if (!axial_.empty()) axial_[element] = secant;
  }
  bool restored_ = false;        ///< since the last factorisation
  bool lags_ = false;            ///< the factor is that of an earlier body, and only preconditions
  int gradient_steps_ = 0;       ///< conjugate gradients have made, in all batches
  bool found_sides_ = false;     ///< a search has found the last sides, and their equilibrium
  int last_steps_ = 0;           ///< that the last batch took
  double missed_savings_ = 0.0;  ///< by changes of a factor that lags behind [time]
  std::vector<double> secants_;
  std::vector<double> axial_;  ///< the same against a change of length; empty where none differs
  bool has_kept_;              ///< Network::has_kept_shear()
  double direction_ = 0.0;     ///< in which the load factor moves on, while sides are settled
  std::vector<Index> changed_sides_;            ///< in this order, when sides were settled last
  std::vector<Index> damaged_;                  ///< elements that close where they are compressed
  mutable std::vector<BondEnds> damaged_ends_;  ///< their ends, as far as they have been asked for
  std::vector<Index> driven_elements_;          ///< elements that end at a driven particle
  std::vector<std::size_t> loaded_slots_;
  std::vector<Index> checked_elements_;  ///< all elements of the unknowns glanced at
  std::vector<std::uint8_t> checked_;    ///< per unknown, while partial_
  bool partial_ = false;     ///< events keep only the displacements current that a search looks at
  bool stale_ = false;       ///< the other displacements are those of an earlier event
  double force_work_ = 0.0;  ///< f'u, followed through the events while partial_
  double driven_spring_work_ = 0.0;   ///< work of elastic supports at driven displacements
  std::vector<std::size_t> slot_of_;  ///< Unknowns::slots()
  /// Where something carries particles: slots that unknowns move, of all particles and, while
  /// partial_, of those that the search looks at.
  std::vector<std::size_t> moving_slots_, current_slots_;
  std::vector<double> solution_;  ///< per unknown
  std::vector<double> displacement_;
  double noise_of_sides_ = 0.0;   ///< extensions below it are on neither side [length]
  double largest_motion_ = 0.0;   ///< by displacement_, see noise()
  std::vector<double> observed_;  ///< displacements of all particles for observers, while stale_
  std::vector<double> ground_stiffness_;  ///< per unknown, empty until a fragment came loose
  std::vector<double> ground_load_;
  std::optional<ConstantField> constant_;
  InternalForce internal_;
  ForcesAndEnergy<long double> fine_;
  double stiffness_sum_ = 0.0;        ///< sum over all elements and supports
  bool must_rebuild_ = false;         ///< the pivot is known better than the factor can follow
  bool look_closer_ = false;          ///< pivots that are not small may be noise too
  bool supports_alone_ = false;       ///< elastic supports hold most of the motion looked at last
  bool resists_ = true;               ///< the polished body stores energy that is no round-off
  double last_work_ = 0.0;            ///< f'u + R'd of a driven body when last asked for
  int events_to_follow_ = 0;          ///< events left that follow the growth of the compliance ...
  double followed_compliance_ = 0.0;  ///< ... f'u - R'd, ...
  double followed_from_ = 0.0;        ///< ... since it was this
  double load_norm_ = 0.0;
  double fresh_residual_ = 0.0;  ///< what a fresh factor leaves, unrefined
  double residual_floor_ = 0.0;  ///< what a fresh factor can reach
  double factor_error_ = 0.0;    ///< Refined::factor_error where the body was last polished ...
  double factor_floor_ = 0.0;    ///< ... and with the last fresh factor
};

}  // namespace perilink
