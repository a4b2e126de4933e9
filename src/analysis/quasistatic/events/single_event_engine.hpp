#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"
#include "analysis/quasistatic/events/crushing_bonds.hpp"
#include "analysis/quasistatic/events/event_engine.hpp"
#include "base/thread_choice.hpp"

namespace perilink {

/// Engine for one event at a time: searches all elements, weakens the one found and updates the
/// displacements.
class SingleEventEngine : public EventEngine {
 public:
  /// \param saved     state to go on from; null: begins with the intact body
  /// \param unknowns  motion of the particles in that state, must outlive this object; null: as the
  ///                  problem says
  SingleEventEngine(const LoadedNetwork& problem, const EquilibriumOptions& options,
                    const BodyState* saved = nullptr, const Unknowns* unknowns = nullptr);

  Event next_event_below(double most) override;
  EventOutcome apply(const Event& event) override;
  std::span<const double> displacement(std::span<const double> earlier = {},
                                       Secants secants = {}) override {
    return equilibrium_.displacement(earlier, secants);
  }
  std::span<const double> where_elements_fail() override {
    return equilibrium_.where_elements_fail();
  }
  LoadWork load_work() override { return equilibrium_.work(); }
  Secants secants() const override { return equilibrium_.secants(); }
  Balance check_equilibrium() override { return equilibrium_.check(); }
  Balance check_cheaply() override { return equilibrium_.check_cheaply(); }
  Freedom change_motion(const Unknowns& unknowns) override {
    return equilibrium_.change_motion(unknowns);
  }
  void set_release_threshold(std::span<const Index> elements, double fraction) override;
  std::vector<Index> near_events(const Event& event, double fraction) override;
  FactorStatistics factor_statistics() const override { return equilibrium_.update().statistics(); }
  BodyState state() const override { return {equilibrium_.state(), progress_, {}}; }

  /// Removes elements, see Equilibrium::cut(); they have no more events.
  /// \return number of ground springs added
  int cut(std::span<const Index> elements);

 protected:
  void prepare(const Event& event);
  /// Returns whether the element may fail together with others, since its law has segments.
  bool fails_with_others(Index element) const {
    return tolerance_ > 0.0 && !network_.law(element).is_brittle();
  }
  void add_others(Event& event, double ratio, double most);
  void limit_batch(const Event& event, double energy, std::vector<BreakSearch::Hit>& hits);
  EventOutcome apply_one(const Event& event);
  EventOutcome apply_all(std::span<const Index> elements, double load_factor);
  int next_segment(Index element) const;
  void pass_limit(Index element, int segment, EventOutcome& outcome);

  /// Returns the elements whose ratio at the load factor of the event is at least `fraction`,
  /// ascending.
  virtual std::vector<BreakSearch::Hit> near_hits(const Event& event, double fraction);

  /// Returns the stretch at the element's next event; infinity if it is broken.
  double limit_of(Index element) const;

  /// Returns the law of the element; its limits are multiples of stretch_of().
  const BondLaw& law_of(Index element) const;
  double stretch_of(Index element) const;

  double release_threshold_of(Index element) const {
    return release_threshold_.empty() ? 1.0 : release_threshold_[element];
  }

  /// Passes the next limits of an element to the search after its event.
  void set_limits(Index element);

  /// Returns that there is no event.
  /// \param reached  the largest ratio, which is round-off; no element if none is in tension
  /// \throws SolverError if round-off hides the strains of an undamaged body
  Event no_event(const BreakSearch::Hit& reached = {});

  const Network& network_;
  ThreadChoice threads_;
  double tolerance_;  ///< EquilibriumOptions::event_tolerance
  Equilibrium equilibrium_;
  std::unique_ptr<BreakSearch> search_;
  bool closes_;  ///< Network::has_closing()
  /// Present if there are bonds with segments in compression.
  std::optional<CrushingBonds> crushing_;
  EventProgress progress_;
  /// Law and reference stretch of a bar that has flowed.
  struct OwnLaw {
    BondLaw law;
    double stretch;
  };
  std::map<Index, OwnLaw> own_laws_;
  std::vector<double>
      release_threshold_;  ///< per element: fraction of the limit that counts; empty: 1
};

}  // namespace perilink
