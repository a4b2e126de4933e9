#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Ways to follow elements that lose stiffness at once: change K^-1, make it anew, or search for
/// the equilibrium by conjugate gradients, which an older K^-1 preconditions. A search that does
/// not converge ends with a new K^-1, except for search_only.
enum class Way { change, renew, search, search_only };

/// Loads of a solution: the loads that grow, or the constant loads of a stage.
enum class LoadSet { growing, permanent };

/// Errors that changes of an inexact K^-1 leave in displacements, and residuals over the load.
struct Drift {
  double of_motion;  ///< error of displacement differences over the largest motion [-]
  double removed;    ///< residual above which checks remove the error, before it grows [-]
  double doubtful;   ///< residual above which pivots of the next events may be wrong [-]
};

/// How K^-1 follows changes of K. Pivots, solves and changes of low rank are those of inverse().
class Update {
 public:
  explicit Update(const DamagedBody& body) : body_(body) {}
  virtual ~Update() = default;

  virtual Factor& inverse() = 0;
  virtual FactorStatistics statistics() const = 0;

  /// Makes K^-1 for new unknowns.
  /// \param resists  the body is known to resist its loads, and is not examined for mechanisms
  /// \throws NotPositiveDefinite if a part of the body can move without resistance
  virtual void begin(bool resists) = 0;
  /// Makes K^-1 anew for the present secants.
  /// \throws NotPositiveDefinite if a part of the body can move without resistance
  virtual void renew() = 0;
  /// Returns whether K^-1 belongs to an earlier body and only preconditions.
  bool lags() const { return lags_; }
  /// Declares that secants and contact states are again those before a search.
  void take_back_search(bool lagged) { lags_ = lagged; }

  /// Replaces a residual by K^-1 residual.
  /// \param energy  u'K u of the solution that it corrects
  virtual void correct(std::vector<double>& residual, double energy) = 0;
  /// Corrects a solution by conjugate gradients. K^-1 may lag afterwards.
  /// \param residual  residual of the solution; overwritten
  /// \param energy    u'K u of the solution
  /// \return false if they do not converge
  virtual bool search(std::vector<double>& residual, std::span<double> solution, double energy,
                      LoadSet kind) = 0;
  /// Replaces a load by K^-1 load of few digits.
  /// \param energy  scales the error of the energy of K^-1 load
  /// \throws SolverError if it is not found
  virtual void solve_roughly(std::vector<double>& load, double energy) = 0;

  /// Returns whether a search follows the next batch or change of contact states.
  virtual bool searches() const = 0;
  /// Returns the cheapest way to follow a batch.
  /// \param path  sum over its vectors of the numbers on their paths, see Factor::path_of()
  virtual Way cheapest_way(double path) = 0;
  /// Returns whether a new K^-1 costs less than this number of changes of contact states.
  virtual bool is_cheaper_anew(std::size_t changes) const = 0;
  /// Returns whether Factor::add_solution() follows changes of contact states.
  virtual bool adds_solutions() const = 0;
  /// Returns whether changes can keep a part of the displacements current, see
  /// Factor::keep_current().
  virtual bool can_follow_a_part() const = 0;
  virtual std::optional<Drift> drift() const { return std::nullopt; }

  /// Returns whether an event of the element needs no solve by conjugate gradients.
  virtual bool is_prepared(Index /*element*/) const { return true; }
  /// Solves for the columns of an element's event.
  /// \param expected  elements that are expected to have events next, in order of load factor
  virtual void prepare(Index /*element*/, std::span<const Index> /*expected*/) {}
  /// Announces a change of K by these vectors, before the secants change.
  virtual void announce(std::span<const SparseVector> /*x*/) {}
  /// Judges K^-1 by the error that changes have left in a solution.
  /// \param error   energy of the correction that removed it
  /// \param energy  u'K u of the solution
  virtual void judge(double /*error*/, double /*energy*/) {}

 protected:
  /// Relative error of solve_roughly() in the energy norm.
  static constexpr double rough = 1e-2;

  const DamagedBody& body_;
  bool lags_ = false;
};

}  // namespace perilink
