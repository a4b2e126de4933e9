// What a BoxFactor does about the errors of its columns.

#include <Eigen/Cholesky>

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "base/error.hpp"
#include "solver/blocks/block_gradients.hpp"

namespace perilink {
namespace {

/// z with H z = right. Vectors of the window may make each other up; what moves none of them is not
/// to be moved: a little more resistance, whose effect every pass divides by what a motion has of
/// its own (iterated Tikhonov regularisation).
class Resistance {
 public:
  explicit Resistance(const Eigen::MatrixXd& compliance) : compliance_(compliance) {
    const double largest = compliance.diagonal().maxCoeff();
    for (double little = 1e-8; little < 1.0 && compliance.allFinite(); little *= 100.0) {
      Eigen::MatrixXd more = compliance;
      more.diagonal().array() += little * largest;
      factor_.compute(more);
      if (factor_.info() == Eigen::Success) return;
    }
    throw SolverError(
        "what events need of the stiffness contradicts itself: parts of the body are so soft that "
        "round-off hides their stiffness; take solver = \"direct\"");
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const {
    constexpr int passes = 3;
    Eigen::MatrixXd solution = factor_.solve(right);
    for (int pass = 1; pass < passes; ++pass) {
      solution += factor_.solve(right - compliance_ * solution);
    }
    return solution;
  }

 private:
  const Eigen::MatrixXd& compliance_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace

/// x'y of vectors x and the columns y of a block.
Eigen::MatrixXd SubdomainFactor::on_columns(std::span<const SparseVector> x,
                                            std::size_t block) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(x.size()), block_width);
  for (Eigen::Index w = 0; w < result.rows(); ++w) {
    for (int m = 0; m < x[w].size(); ++m) {
      const double* row = blocks_[block].data() + slot_of_[x[w].rows[m]] * block_width;
      for (Eigen::Index c = 0; c < block_width; ++c) result(w, c) += x[w].values[m] * row[c];
    }
  }
  return result;
}

/// Columns of the window from `before` on are new: what others see of them is what they see of
/// others.
void SubdomainFactor::mirror_compliance(Eigen::Index before) {
  const Eigen::Index count = compliance_.cols() - before;
  compliance_.bottomLeftCorner(count, before) =
      compliance_.topRightCorner(before, count).transpose();
  const Eigen::MatrixXd own = compliance_.bottomRightCorner(count, count);
  compliance_.bottomRightCorner(count, count) = 0.5 * (own + own.transpose());
}

/// right_ <- what the columns of the last block leave of their right sides.
void SubdomainFactor::find_left_over(std::span<const SparseVector> x,
                                     const Correction* correction) {
  fill_right_sides(x, correction);
  solver_->take_products(blocks_.back(), right_);
}

/// What all columns at hand have with what is left over, shape (columns, block_width).
Eigen::MatrixXd SubdomainFactor::with_left_over() const {
  Eigen::MatrixXd result(shares_.rows(), block_width);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto products = products_of(blocks_[b], right_);
    for (int i = 0; i < block_width; ++i) {
      for (int j = 0; j < block_width; ++j) {
        result(static_cast<Eigen::Index>(b * block_width) + i, j) = products[i][j];
      }
    }
  }
  return result;
}

/// With r = e - K y left over of a new column y, and p of those at hand, what K^-1 has between e
/// and the vector of p is e'p + p'r, but for the product of their errors (L-7). Columns, and the
/// solution that has come with the block, then move by combinations of columns until the vectors of
/// the window see that of them.
/// \param before  columns of the window from here on are new
void SubdomainFactor::make_agree(Eigen::Index before, Correction* correction) {
  const Eigen::Index size = compliance_.cols(), count = size - before;
  const Eigen::MatrixXd left_over = shares_.transpose() * with_left_over();
  const Eigen::MatrixXd seen = compliance_.rightCols(count);
  compliance_.rightCols(count) += left_over.leftCols(count);
  mirror_compliance(before);

  const Resistance resistance(compliance_);
  const std::span<const SparseVector> added =
      std::span<const SparseVector>(window_).subspan(static_cast<std::size_t>(before));
  Eigen::MatrixXd seen_of_old = Eigen::MatrixXd::Zero(count, before);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto rows = static_cast<Eigen::Index>(b * block_width);
    seen_of_old += on_columns(added, b) * shares_.block(rows, 0, block_width, before);
  }
  const Eigen::MatrixXd moves =
      shares_ * resistance.solve(Eigen::MatrixXd::Identity(size, size).rightCols(count));
  const Eigen::MatrixXd moves_of_new =
      shares_ * resistance.solve(compliance_.rightCols(count) - seen);
  shares_.leftCols(before) += moves * (compliance_.bottomLeftCorner(count, before) - seen_of_old);
  shares_.rightCols(count) += moves_of_new;
  if (correction == nullptr) return;
  const std::vector<double> move =
      motion_of(shares_ * resistance.solve(left_over.col(block_width - 1)));
  for (std::size_t k = 0; k < move.size(); ++k) correction->residual[k] += move[k];
}

}  // namespace perilink
