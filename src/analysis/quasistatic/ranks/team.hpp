#pragma once

#include <memory>
#include <optional>
#include <span>

#include "analysis/quasistatic/ranks/lattice_part.hpp"
#include "analysis/quasistatic/ranks/part_solver.hpp"

namespace perilink {

/// Whether ranks can share the work on a network: their parts have bonds, sums of their extensions
/// and springs, no more.
inline bool can_be_shared(const Network& network, const Unknowns& unknowns) {
  return !network.cells && !network.shell && !unknowns.carries();
}

/// All ranks at work on one body, seen from the one that leads. The others obey, to one team at a
/// time.
class Team {
 public:
  /// Cuts the body into parts and sends them.
  /// \param stiffness  its blocks inverted
  /// \param ground     springs that hold unknowns, size n, or empty until there are some, and
  ///                   never again; null: neither these nor the secants change. Both are kept by
  ///                   reference, and every search is that of what they are by then
  Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
       const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
       const std::vector<double>* ground = nullptr);

  /// Lets every rank make its own part of a box of a lattice, which has as many planes at least.
  /// \param places  particles and springs of the whole body; no bonds
  /// \throws SolverError on all ranks
  Team(Ranks& ranks, const LatticePattern& pattern, const Network& places, const Unknowns& unknowns,
       Index particles_of_box);

  /// conjugate_gradients() of the whole body; vectors have all its unknowns.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  /// block_conjugate_gradients() of vectors of shape (particles, width, block_width), where changes
  /// may come.
  GradientsReport search_block(std::span<const double> right, std::span<double> solution,
                               const BlockRow& sizes, double enough, int most_iterations);

  /// internal_force() of parts that the ranks have made; motion of shape (particles, width).
  InternalForce internal(std::span<const double> motion);

  /// Puts what a rank has found of its own particles among what is known of all.
  /// \param own  shape (owned, width)
  /// \param all  shape (particles, width), zero there before
  void put_in_place(int rank, std::span<const double> own, std::size_t width,
                    std::span<double> all) const;

  FactorStatistics coarse() const { return own_->coarse(); }
  Index num_subdomains() const { return own_->num_subdomains(); }
  Ranks& ranks() const { return ranks_; }
  const PartSolver& own() const { return *own_; }

 private:
  void tell_changes();

  Ranks& ranks_;
  Partition partition_;
  std::size_t width_;
  Secants secants_;
  const std::vector<double>* ground_ = nullptr;
  std::vector<double> told_axial_, told_other_, told_ground_;  ///< what the parts know
  std::unique_ptr<PartSolver> own_;
};

/// What the other ranks do in a team.
class TeamMember {
 public:
  explicit TeamMember(Ranks& ranks) : ranks_(ranks) {}
  /// \param order  the team's, its Service read
  void obey(Parcel& order);
  /// \pre it has a part
  const PartSolver& own() const { return *solver_; }

 private:
  void find_forces(Parcel& order);

  Ranks& ranks_;
  std::optional<PartSolver> solver_;
};

}  // namespace perilink
