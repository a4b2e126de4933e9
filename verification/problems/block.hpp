#pragma once

#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "discretization/region.hpp"
#include "model/from_case/configure.hpp"

/// \file
/// The tension block that studies and benchmarks share: the plain concrete block of Gerstle, Sau &
/// Silling (2005), Fig. 9: 100 in by 200 in between two unbreakable caps of 50 in, weak patch in
/// the middle.

namespace perilink::verification {

inline constexpr double block_fracture_energy = 0.001;             ///< [kip/in]
inline constexpr double block_weak_fracture_energy = 0.00095;      ///< in the weak patch [kip/in]
inline constexpr Box block_weak_patch{{35, 85, 0}, {65, 115, 0}};  ///< [in]

/// What the cases of the block do not share.
struct BlockLattice {
  std::string title;
  std::string layout;           ///< lines of [body]: pattern, number of columns or spacing, horizon
  std::string surface;          ///< "calibrated", "ghost" or "none"
  double inset = 0.0;           ///< distance of the caps' regions from the ends of the block [in]
  double poissons_ratio = 0.0;  ///< micropolar bonds have it; zero: bond-based
  double tensile_strength = 0.0;  ///< zero: brittle; the patch has 5 % less
};

/// The case file of the block.
std::string block_case(const BlockLattice& lattice);

/// The refined block: a conforming hexagonal lattice with so many particles across the width and a
/// horizon of three spacings; bonds "calibrated" or "none".
std::string block_case(int columns, const std::string& surface);

/// Columns that give about 5 000, 50 000, 300 000 and 1 000 000 unknowns.
inline constexpr int columns_5k = 27;
inline constexpr int columns_50k = 85;
inline constexpr int columns_300k = 209;
inline constexpr int columns_1m = 381;

/// The model of the refined block.
Model make_block(int columns, const std::string& surface = "calibrated");

/// Keeps the rows of a history in memory, and ends a run that has so many.
class RowRecorder final : public StepObserver {
 public:
  explicit RowRecorder(std::size_t most = std::numeric_limits<std::size_t>::max()) : most_(most) {}
  void on_step(const StepRecord& record, StateSource& /*source*/) override {
    rows.push_back(record);
    if (rows.size() == 1) first_ = std::clock();
    last_ = std::clock();
  }
  bool stop_requested() override { return rows.size() >= most_; }
  /// Processor time from the first row to the last, over the rows between [s].
  double seconds_per_row() const {
    return rows.size() < 2 ? 0.0
                           : static_cast<double>(last_ - first_) /
                                 (static_cast<double>(rows.size() - 1) * CLOCKS_PER_SEC);
  }
  std::vector<StepRecord> rows;

 private:
  std::size_t most_;
  std::clock_t first_ = 0, last_ = 0;
};

/// One run of a block.
struct BlockRun {
  DamageResult result;
  std::vector<StepRecord> rows;
  double seconds = 0.0;
  double seconds_per_event = 0.0;  ///< processor time, without what comes before the first
};

/// Runs a model to so many broken bonds (or to collapse).
/// \param check_interval  DamageOptions::check_interval
/// \param rows  after which it ends at the latest
BlockRun run_block(const Model& model, FactorRoute route, Index broken_bonds, int threads = 1,
                   int check_interval = DamageOptions{}.check_interval,
                   std::size_t rows = std::numeric_limits<std::size_t>::max());

}  // namespace perilink::verification
