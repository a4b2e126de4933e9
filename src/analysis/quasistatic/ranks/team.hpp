#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/ranks/part_solver.hpp"

namespace perilink {

/// Whether ranks share the work on a network: there are several, a particle at least for each, and
/// their parts have nothing but bonds and springs.
/// \param ranks  null: this process is alone
bool can_be_shared(const Network& network, const Unknowns& unknowns, const Ranks* ranks);

/// All ranks at work on one body, seen from the first rank. The other ranks serve one team at a
/// time.
class Team {
 public:
  /// Cuts the body into parts and sends them.
  /// \param stiffness  its blocks inverted
  /// \param ground     springs that hold unknowns, size n, or empty until there are some, and
  ///                   never again; null: neither these nor the secants change. Both are kept by
  ///                   reference, and every search takes their present values
  Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
       const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
       const std::vector<double>* ground = nullptr);

  /// conjugate_gradients() of the whole body; vectors have all its unknowns.
  GradientsReport search(std::span<const double> right, std::span<double> solution, double enough,
                         double scale, int most_iterations);

  /// block_conjugate_gradients() of vectors of shape (particles, width, block_width), where secants
  /// may change.
  GradientsReport search_block(std::span<const double> right, std::span<double> solution,
                               const BlockRow& sizes, double enough, int most_iterations);

 private:
  /// Shares of a field of shape (particles, width) or of the unknowns.
  struct Share {
    std::vector<std::size_t> first;  ///< per rank, and an end
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
  std::vector<double> sent_axial_, sent_other_, sent_ground_;  ///< known to the parts
  std::unique_ptr<PartSolver> own_;
};

/// The work of another rank for a team.
class TeamMember {
 public:
  explicit TeamMember(Ranks& ranks) : ranks_(ranks) {}
  /// \param order  the team's, its Service read
  void obey(Parcel& order);

 private:
  Ranks& ranks_;
  std::optional<PartSolver> solver_;
};

}  // namespace perilink
