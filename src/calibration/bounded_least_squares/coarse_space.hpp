#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "calibration/bounded_least_squares/coarse_system.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/bounded_least_squares/subdomain_modes.hpp"

namespace perilink {

/// Modes of subdomains that span the coarse space.
enum class CoarseModes {
  killing,  ///< Killing tensors, which do no work on any bond (killing_fields())
  soft,     ///< near-null-space modes of the interior variables: expensive, for any variables
};

/// Second level of the preconditioner of bounded_least_squares(): the near-null-space modes of
/// subdomains of neighbouring points. Blocks of single points precondition the remaining modes, so
/// that the number of iterations does not grow with the body (docs/theory/calibration.md).
class CoarseSpace {
 public:
  /// \param active  active-set weight per variable, from 0 to 1
  /// \param diagonal  added to the diagonal of the system, shape (points, rows)
  CoarseSpace(const PointEquations& equations, const std::vector<double>& active,
              const std::vector<double>& diagonal, CoarseModes fields);

  /// Makes the coarse system P' S P of other variables or diagonals, with unchanged modes.
  void refactorize(const PointEquations& equations, const std::vector<double>& active,
                   const std::vector<double>& diagonal);

  /// Adds P (P' S P)^-1 P' residual to `result`, both of shape (points, rows).
  void add_correction(const double* residual, double* result) const;

  Index num_fields() const { return first_field_.back(); }
  /// Whether the coarse system is solved approximately, which takes more iterations.
  bool is_nested() const { return CoarseSystem::is_nested(num_subdomains()); }

 private:
  Index num_subdomains() const { return static_cast<Index>(boxes_.size()); }
  Index num_fields(Index box) const { return first_field_[box + 1] - first_field_[box]; }
  using Key = std::array<Index, 4>;  // subdomains on which a variable acts, ascending
  using GroupProducts = std::array<std::array<Eigen::MatrixXd, 4>, 4>;
  void sort_variables(const PointEquations& equations);
  void add_diagonal(Index box, const std::vector<double>& diagonal, Eigen::MatrixXd& own) const;
  GroupProducts products(std::size_t group, const PointEquations& equations,
                         const std::vector<double>& active) const;
  static void add(const Key& key, const GroupProducts& sums, SubdomainMatrix& matrix,
                  SubdomainMatrix* inside);
  void make_boxes(const PointEquations& equations, CoarseModes fields);
  void number_points();
  std::vector<std::vector<Index>> inner_variables(const PointEquations& equations,
                                                  const std::vector<double>& active) const;
  void find_fields(const PointEquations& equations, const std::vector<double>& active,
                   const std::vector<double>& diagonal, CoarseModes fields);
  Eigen::MatrixXd near_null_modes(Index box, const std::vector<Index>& inside,
                                  const PointEquations& equations,
                                  const std::vector<double>& active,
                                  const std::vector<double>& blocks) const;

  int rows_;
  int threads_;                               // limited by the buffers of BLAS
  std::vector<std::vector<Index>> boxes_;     // points of each subdomain
  std::vector<Index> box_of_, place_;         // per point: subdomain, and number in it
  std::vector<Index> first_, second_;         // points that variables join
  std::vector<std::pair<Key, Index>> order_;  // variables, by subdomains
  std::vector<std::size_t> groups_;           // where each set of subdomains begins in order_
  std::vector<std::pair<Index, Index>>
      pairs_;                           // pairs of subdomains that variables join, ascending
  std::vector<SubdomainModes> fields_;  // per subdomain
  std::vector<Index> first_field_;      // per subdomain, and the total at the end
  CoarseSystem coarse_;
};

/// Returns the blocks of the single points of A D A' + diagonal, shape (points, rows, rows). Rows
/// without variables get a one.
std::vector<double> point_blocks(const PointEquations& equations, const std::vector<double>& active,
                                 const std::vector<double>& diagonal);

/// Adds the diagonal to the blocks of the single points of A D A'. Rows without any variable get a
/// one.
/// \param rows  number of equations per point
void finish_blocks(int rows, const std::vector<double>& diagonal, std::vector<double>& blocks);

/// Replaces symmetric positive definite blocks, shape (points, rows, rows), by their inverses.
void invert_blocks(int rows, std::vector<double>& blocks);

}  // namespace perilink
