#pragma once

#include <array>
#include <vector>

#include <memory>

#include "discretization/least_change.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Second level of the preconditioner of least_change(): functions that are linear on boxes of
/// points, one set for each equation row. Single points exchange errors only with their neighbours;
/// what varies over the whole body is taken out here. With a box for each point it is the system
/// itself.
class CoarseSpace {
 public:
  enum class Boxes { of_many_points, of_single_points };
  /// \param active  1 for the variables that the system holds, else 0
  /// \param shifts      added to the diagonal of the fine system, one for each row
  /// \param compliance  added to it, one for each row of each point, or empty
  CoarseSpace(const PointEquations& equations, const std::vector<double>& active,
              const std::vector<double>& shifts, const std::vector<double>& compliance,
              Boxes boxes);

  /// Adds P (P' S P)^-1 P' residual to `result`, both of shape (points, rows).
  void add_correction(const double* residual, double* result) const;

 private:
  void number_boxes(const PointEquations& equations);
  void put_points_in_boxes_of_their_own(const PointEquations& equations);
  void assemble(const PointEquations& equations, const std::vector<double>& active,
                const std::vector<double>& shifts, const std::vector<double>& compliance);
  template <class BlockOf>
  void add_compliance(const std::vector<double>& compliance, BlockOf block) const;
  void factorize(const std::vector<Eigen::Triplet<double>>& entries);  // of the lower triangle

  int dim_, rows_;
  int functions_ = 1;  // per row and box
  Index num_boxes_ = 0;
  std::vector<Index> box_of_;   // of each point
  std::vector<double> values_;  // of the functions at the points, shape (points, functions)
  std::unique_ptr<Factor> factor_;
};

}  // namespace perilink
