#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "base/types.hpp"
#include "calibration/least_change/box_fields.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// A symmetric matrix of the fields of boxes, by its blocks.
struct SubdomainMatrix {
  std::vector<Index> first;                    ///< where each box begins, and the end of all
  std::vector<std::pair<Index, Index>> pairs;  ///< boxes (a, b), a <= b, ascending
  std::vector<Eigen::MatrixXd> blocks;         ///< per pair, shape (fields of b, fields of a)

  Index num_subdomains() const { return static_cast<Index>(first.size()) - 1; }
  Index size(Index box) const { return first[box + 1] - first[box]; }
  /// \param a, b  boxes in any order
  bool has(Index a, Index b) const;
  Eigen::MatrixXd& block(Index a, Index b);
  const Eigen::MatrixXd& block(Index a, Index b) const;
};

/// Solves the system of the fields of boxes (BoxSpace): by its factor where there are few
/// boxes. A factor of many would take more than all the rest; there they are gathered in large
/// boxes, whose soft fields have a factor, beside the blocks of the single boxes:
/// D^-1 + P (P' A P)^-1 P', as BoxSpace does with points.
class CoarseSystem {
 public:
  /// The large box of each box.
  static Index large_box(Index box) { return box / boxes_of_large; }
  static bool is_nested(Index num_subdomains) { return num_subdomains > most_in_factor; }

  /// \param matrix  that of all variables
  /// \param inside  that of those inside of large boxes, where it is nested; asked for at first
  void factorize(const SubdomainMatrix& matrix, const SubdomainMatrix& inside);
  bool has_fields() const { return !fields_.empty(); }

  /// \param values  right side and solution, shape (fields)
  void solve(std::span<double> values) const;

 private:
  static constexpr Index boxes_of_large = 8, most_in_factor = 128;

  void find_fields(const SubdomainMatrix& matrix, const SubdomainMatrix& inside);
  static BoxFields soft_fields(Index large, const SubdomainMatrix& matrix,
                               const SubdomainMatrix& inside);
  SubdomainMatrix of_large_boxes(const SubdomainMatrix& matrix) const;
  void factorize_directly(const SubdomainMatrix& matrix);

  std::vector<Index> first_;
  /// Inverse of the lower factor of each box's own block, transposed, where it is nested: what it
  /// makes of a block is definite whatever single precision rounds.
  std::vector<BoxFields> roots_;
  std::vector<BoxFields> fields_;  // per large box
  std::vector<Index> first_large_;
  std::vector<std::pair<Index, Index>> pairs_;  // those of the factor
  std::unique_ptr<Factor> factor_;
};

}  // namespace perilink
