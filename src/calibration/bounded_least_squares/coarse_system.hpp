#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "base/types.hpp"
#include "calibration/bounded_least_squares/subdomain_modes.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// A symmetric matrix of the modes of subdomains, by its blocks.
struct SubdomainMatrix {
  std::vector<Index> first;  ///< where each subdomain begins, and the total at the end
  std::vector<std::pair<Index, Index>> pairs;  ///< subdomains (a, b), a <= b, ascending
  std::vector<Eigen::MatrixXd> blocks;         ///< per pair, shape (modes of b, modes of a)

  Index num_subdomains() const { return static_cast<Index>(first.size()) - 1; }
  Index size(Index box) const { return first[box + 1] - first[box]; }
  /// \param a, b  subdomains in any order
  bool has(Index a, Index b) const;
  Eigen::MatrixXd& block(Index a, Index b);
  const Eigen::MatrixXd& block(Index a, Index b) const;
};

/// Solves the coarse system P' S P of the modes of all subdomains. Few subdomains have a factor. A
/// factor of many would take longer than the rest of an iteration. Then subdomains are joined to
/// aggregates with near-null-space modes P2. The approximate solution is D^-1 + P2 (P2' A P2)^-1
/// P2', with the diagonal blocks D of the subdomains.
class CoarseSystem {
 public:
  /// Returns the aggregate of a subdomain.
  static Index large_box(Index box) { return box / boxes_of_large; }
  static bool is_nested(Index num_subdomains) { return num_subdomains > most_in_factor; }

  /// \param matrix  matrix of all variables
  /// \param inside  matrix of the variables inside aggregates, for the first nested factorisation
  void factorize(const SubdomainMatrix& matrix, const SubdomainMatrix& inside);
  bool has_fields() const { return !fields_.empty(); }

  /// \param values  right side and solution, shape (modes)
  void solve(std::span<double> values) const;

 private:
  static constexpr Index boxes_of_large = 8, most_in_factor = 128;

  void find_fields(const SubdomainMatrix& matrix, const SubdomainMatrix& inside);
  static SubdomainModes near_null_modes(Index large, const SubdomainMatrix& matrix,
                                        const SubdomainMatrix& inside);
  SubdomainMatrix of_large_boxes(const SubdomainMatrix& matrix) const;
  void factorize_directly(const SubdomainMatrix& matrix);

  std::vector<Index> first_;
  /// Transposed inverse of the lower factor of each diagonal block, where the system is nested: its
  /// square stays definite in single precision.
  std::vector<SubdomainModes> roots_;
  std::vector<SubdomainModes> fields_;  // per aggregate
  std::vector<Index> first_large_;
  std::vector<std::pair<Index, Index>> pairs_;  // pairs of the factor
  std::unique_ptr<Factor> factor_;
};

}  // namespace perilink
