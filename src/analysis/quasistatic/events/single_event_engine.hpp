#pragma once

#include <memory>
#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"
#include "analysis/quasistatic/events/event_engine.hpp"
#include "analysis/quasistatic/events/removal.hpp"
#include "assembly/internal_force.hpp"

namespace perilink {

/// One factor, one event at a time: search all elements, downdate, move the displacement.
class SingleEventEngine final : public EventEngine {
 public:
  SingleEventEngine(const LoadedNetwork& problem, const EngineOptions& options);

  Event next_event() override;
  EventOutcome apply(const Event& event) override;
  std::span<const double> displacement() override;
  LoadWork load_work() override;
  std::span<const double> secants() const override { return secants_; }
  Equilibrium check_equilibrium() override;
  int factorizations() const override { return factor_->factorizations(); }
  FactorStatistics factor_statistics() const override { return factor_->statistics(); }

  /// Removes elements whatever their stretch, also the last ones that hold a fragment: a fragment
  /// that comes loose without load is held by ground springs, one per rigid-body mode, added to the
  /// factor before the bond goes. The rest of the body keeps its exact equilibrium.
  /// \return number of ground springs added
  /// \throws SolverError when a loaded part comes loose
  int cut(std::span<const Index> elements);

 private:
  struct Change {
    SparseVector x;            ///< sqrt(stiffness lost) times the extension gradient
    double load_change = 0.0;  ///< part of the extension that comes from prescribed displacements
    double extension = 0.0;    ///< sqrt(stiffness lost) times the whole extension at load factor 1
  };
  Change make_change(Index element, double stiffness_lost) const;
  void factorize();
  Tooth next_tooth(Index element) const;
  void pass_limit(Index element, double secant);
  void commit(const Change& change, Index element, double secant);
  void follow(const EventOutcome& outcome);
  void scatter_solution();
  void choose_current_unknowns();
  void refresh();
  void refine(std::vector<double>& residual);
  double work_of_forces() const;
  std::vector<double> present_load() const;
  double measure_residual(std::vector<double>& residual);
  void add_ground_spring(Index unknown);
  double ground_stiffness_of(Index unknown) const;
  Index most_mobile_unknown(const SparseVector& x);
  void keep_all_current();
  bool is_frame(Index element) const {
    return network_.carries_moments() && network_.bending[element] > 0.0;
  }

  // Separation and extended precision: separation.cpp.
  /// How far a pivot from the factor may be from the one from energies before a fresh factor is
  /// worth its price, and before that has to be made without the element.
  static constexpr double same_pivot = 1e-8, usable_pivot = 1e-6;
  /// Where pivots of the factor are this far off, each event is looked at: its energy is off by as
  /// much.
  static constexpr double noisy_pivot = 1e-8;
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
  double pivot_of(const Change& change, Index element, double kept);
  bool hangs_on_weak_supports(double compliance_growth) const;
  bool rebuild_without(Index element, double kept);
  Equilibrium polish();
  LoadWork work_by_energy();

  // Micropolar bonds: frame_events.cpp.
  std::vector<double> refined_compliance(const Removal& removal);
  void measure_pivots(Removal& removal, Index element, double kept);
  void look_closely(Removal& removal, Index element, double kept);
  bool hold_free_modes(Removal& removal, Index element, double unloaded, int& springs);
  void commit_frame(const Removal& removal, Index element, double secant);
  EventOutcome weaken_frame(Index element, double secant);
  int cut_frame(Index element);
  std::pair<double, double> driven_work_of(Index element) const;

  const Network& network_;
  const Unknowns& unknowns_;
  const Loads& loads_;
  EngineOptions options_;
  std::unique_ptr<Factor> factor_;
  std::unique_ptr<BreakSearch> search_;

  std::vector<double> secants_;
  std::vector<int> teeth_;              ///< present tooth of each element
  std::vector<Index> driven_elements_;  ///< elements that end at a driven particle
  std::vector<std::size_t> loaded_slots_;
  bool partial_ = false;  ///< events keep only the displacements current that the search looks at
  bool stale_ = false;    ///< the other displacements are those of an earlier event
  double force_work_ = 0.0;           ///< f'u, followed through the events while partial_
  double driven_spring_work_ = 0.0;   ///< work of elastic supports at driven displacements
  std::vector<std::size_t> slot_of_;  ///< Unknowns::slots()
  std::vector<double> solution_;      ///< per unknown
  std::vector<double> displacement_;
  std::vector<double> observed_;  ///< displacements of all particles for observers, while stale_
  std::vector<double> ground_stiffness_;  ///< per unknown, empty until a fragment came loose
  std::vector<double> ground_load_;
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
  double residual_floor_ = 0.0;  ///< what a fresh factor can reach
  double factor_error_ = 0.0;    ///< Refined::factor_error where the body was last polished ...
  double factor_floor_ = 0.0;    ///< ... and with the last fresh factor
};

}  // namespace perilink
