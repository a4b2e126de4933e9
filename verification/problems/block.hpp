#pragma once

#include <string>
#include <vector>

#include "analysis/damage_analysis.hpp"
#include "app/configure.hpp"

/// \file
/// The refined tension block that studies and benchmarks share: the plain concrete block of Gerstle,
/// Sau & Silling (2005), Fig. 9 (100 in by 200 in between two unbreakable caps of 50 in, weak patch in
/// the middle), on a conforming hexagonal lattice with a horizon of three spacings; calibrated bonds or
/// those of the infinite body (`surface` of the case).

namespace perilink::verification {

/// The case file of the block with so many particles across its width and bonds "calibrated" or "none".
std::string block_case(int columns, const std::string& surface);

/// Columns that give about 5 000, 50 000, 300 000 and 1 000 000 unknowns.
inline constexpr int columns_5k = 27;
inline constexpr int columns_50k = 85;
inline constexpr int columns_300k = 209;
inline constexpr int columns_1m = 381;

Model make_block(int columns, const std::string& surface = "calibrated");

/// Keeps the rows of a history in memory.
class RowRecorder final : public StepObserver {
 public:
  void on_step(const StepRecord& record, StateSource& /*source*/) override {
    rows.push_back(record);
  }
  std::vector<StepRecord> rows;
};

/// One run of a block.
struct BlockRun {
  DamageResult result;
  std::vector<StepRecord> rows;
  double seconds = 0.0;
};

/// Runs a model to so many broken bonds (or to collapse).
BlockRun run_block(const Model& model, FactorRoute route, Index broken_bonds, int threads = 1);

}  // namespace perilink::verification
