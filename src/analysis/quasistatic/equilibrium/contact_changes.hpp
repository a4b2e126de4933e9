#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/contact.hpp"
#include "analysis/quasistatic/equilibrium/reaction_work.hpp"
#include "analysis/quasistatic/equilibrium/separation.hpp"

namespace perilink {

/// Changes contact states of unilateral elements until the equilibrium violates none: they have
/// their intact stiffness in compression.
class ContactChanges {
 public:
  ContactChanges(DamagedBody& body, Solution& solution, SeparationCheck& separation,
                 ReactionWork& work)
      : body_(body),
        solution_(solution),
        separation_(separation),
        work_(work),
        contact_(solution) {}

  const Contact& contact() const { return contact_; }

  /// Settles the contact states. The outcome is a mechanism if elements that must open hold the
  /// body.
  /// \param direction  of the load if only elements with zero extension change; see Reading
  /// \throws SolverError if the contact states do not settle
  void settle(EventOutcome& outcome, double direction = 0.0);
  /// Opens a closed element.
  /// \return false if only this element holds the body; then at most K^-1 is new
  bool open(Index element);
  /// Forgets which contact states and closed stiffness ratios the last call of settle() changed.
  void begin() {
    changed_.clear();
    ratios_before_.clear();
  }
  /// Sets the closed stiffness of broken bonds around those that have just broken.
  void follow_broken() { set_closed_ratios(body_.faces().take_around_broken()); }
  /// Takes back what has changed since then. K^-1 and displacements stay.
  void take_back();

 private:
  bool follow(const std::vector<Index>& wrong, EventOutcome& outcome);
  bool search(const std::vector<Index>& wrong);
  std::vector<Index> take_over(const std::vector<Index>& wrong);
  std::vector<Index> change(std::vector<Index> wrong);
  bool change_together(const std::vector<Index>& wrong);
  bool holds_apart(const std::vector<Index>& opened);
  void close(Index element);
  void turn(const std::vector<Index>& elements);
  std::vector<Index> opened() const;
  void set_closed_ratios(std::span<const Index> bonds);
  void add_growth(Index element, const Extension& before, EventOutcome& outcome) const;

  DamagedBody& body_;
  Solution& solution_;
  SeparationCheck& separation_;
  ReactionWork& work_;
  Contact contact_;
  std::vector<Index> changed_;  ///< elements whose contact state changed last, in order
  std::vector<CrackFaces::Ratio> ratios_before_;  ///< closed ratios that changed last
};

}  // namespace perilink
