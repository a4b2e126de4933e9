#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/ranks/part_solver.hpp"

namespace perilink {

/// Returns whether ranks can share a network: there are several ranks, at least one particle for
/// each, and the network has only bonds and springs.
/// \param ranks  null: one process
bool can_be_shared(const Network& network, const Unknowns& unknowns, const Ranks* ranks);

/// Communicator of all ranks for one body, used by the root. Workers serve one Team at a time.
class Team {
 public:
  /// Cuts the body into parts and sends them.
  /// \param stiffness  with inverted blocks
  /// \param ground     stiffness of ground springs per unknown, size n; empty until the first
  ///                   spring, then never empty again. null: neither springs nor secants change.
  ///                   `ground` and `secants` are kept by reference, and every solve uses their
  ///                   present values.
  Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
       const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
       const std::vector<double>* ground = nullptr);

  /// Solves for the whole body with conjugate_gradients(); vectors have all its unknowns.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  /// Solves with block_conjugate_gradients() where secants may change. Vectors have shape
  /// (particles, width, block_width).
  GradientsReport search_block(std::span<const double> right, std::span<double> solution,
                               const BlockRow& sizes, double enough, int most_iterations);

 private:
  /// Divides a field of shape (particles, width), or the unknowns, among the ranks.
  struct Share {
    std::vector<std::size_t> first;  ///< first row per rank, and the end; size ranks + 1
    std::size_t width = 1;
    template <class Values>
    auto of(int rank, Values values) const {
      return values.subspan(first[rank] * width, (first[rank + 1] - first[rank]) * width);
    }
  };

  template <class Order, class Search>
  GradientsReport search_with_all(const Order& order, const Share& share,
                                  std::span<const double> right, std::span<double> solution,
                                  Search search);
  void send_changes();

  Ranks& ranks_;
  Share unknowns_, blocks_;
  Secants secants_;
  const std::vector<double>* ground_ = nullptr;
  std::vector<double> sent_axial_, sent_other_, sent_ground_;  ///< values last sent to the parts
  std::unique_ptr<PartSolver> own_;
};

/// Solver of a worker for a Team.
class TeamMember {
 public:
  explicit TeamMember(Ranks& ranks) : ranks_(ranks) {}
  /// Carries out one request of the root.
  /// \param order  message buffer behind its Service
  void obey(Parcel& order);

 private:
  Ranks& ranks_;
  std::optional<PartSolver> solver_;
};

}  // namespace perilink
