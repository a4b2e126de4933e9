#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "calibration/bounded_least_squares/direction_search.hpp"
#include "calibration/bounded_least_squares/equations/normal_system.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/bounded_least_squares/kept_preconditioner.hpp"
#include "calibration/bounded_least_squares/packed_product.hpp"

namespace perilink {

/// NormalSystem of equations at points, by conjugate gradients.
class NormalEquations : public NormalSystem {
 public:
  NormalEquations(const PointEquations& equations, const LeastSquaresOptions& options,
                  KeptPreconditioner& kept);

  void measure(const std::vector<double>& weights, const Vector& y,
               Vector& residual) const override;
  void prepare() override;
  void prepare_if_stale(bool settled, bool last) override;
  int solve(const Vector& residual, double reduction, Vector& direction) override;
  double penalty() const override { return options_.penalty; }
  bool has_penalty(std::size_t k) const override {
    return std::isfinite(options_.penalty) && equations_.ridge_of(k % rows()) == 0.0;
  }

 private:
  std::size_t rows() const { return static_cast<std::size_t>(equations_.rows); }
  void apply(const std::vector<double>& w, Vector& result) const;
  /// Adds the forces of a range of variables, times their weights.
  virtual void add_forces(const std::vector<double>& w, std::size_t begin, std::size_t end,
                          Vector& result) const = 0;
  /// Adds A D A' y, without the scale.
  virtual void add_product(const Vector& y, Vector& result) const = 0;
  /// Sets the inverses of the blocks of all points.
  virtual void set_blocks(const std::vector<double>& blocks) = 0;
  virtual void apply_blocks(const Vector& residual, Vector& result) const = 0;
  void find_direction(DirectionSearch& search);
  bool iterate(DirectionSearch& search, int most);
  void apply_system(const Vector& shift, const Vector& y, Vector& result);
  void precondition(const Vector& residual, Vector& result) const;
  /// Means of the preconditioner: blocks, which may get a coarse space or give way to a factor;
  /// blocks with a coarse space; a factor; blocks to the end.
  enum class Means { blocks, boxes, factor, only_blocks };
  static Means first_means(const LeastSquaresOptions& options, const KeptPreconditioner& kept);
  void build_blocks();
  template <class Make>
  void use_boxes(Make make);
  void renew_coarse();
  void build_factor();
  Vector diagonal() const;

  const LeastSquaresOptions& options_;
  KeptPreconditioner& kept_;
  Means by_;
  std::optional<PackedProduct> packed_;  // for the steps of conjugate gradients
  bool last_ = false;                    // whether the step must satisfy the equations
  int last_iterations_ = 0;
  bool gave_up_ = false;  // not even a new factor leads to a solution
  /// Active-set weights of the factor or the coarse system; empty: of another problem.
  std::vector<double> prepared_for_;
  Vector compliance_of_factor_;

 protected:
  bool threads_share() const;

  const PointEquations& equations_;
  std::size_t size_;
  std::size_t num_paired_;  // variables that act at both ends in all rows
  Vector scaled_;
};

}  // namespace perilink
