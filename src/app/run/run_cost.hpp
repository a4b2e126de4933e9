#pragma once

#include "app/model/from_case/configure.hpp"
#include "app/model/from_case/lattice_case.hpp"
#include "app/run/bond_run.hpp"
#include "solver/factor.hpp"

/// \file
/// What a run will take on one core, for people who plan it: rates of a quiet machine like that of
/// verification/benchmarks.

namespace perilink {

/// From a draft (draft_model()) and the time that it took [s].
struct ExpectedSetUp {
  ExpectedSetUp(const Model& draft, double drafted)
      : calibration(draft.network.calibration ? draft.network.calibration->seconds : 0.0),
        seconds(drafted + calibration) {}
  double calibration;  ///< [s]
  double seconds;      ///< with the calibration
};

/// What a quasistatic run costs after its set-up.
struct ExpectedCost {
  double memory = 0.0;         ///< [bytes]
  double factorization = 0.0;  ///< [s]
  double broken_bond = 0.0;    ///< with its row of the history [s]
};
ExpectedCost expected_cost(const Network& network, const FactorStatistics& factor);

/// Time of a step of an explicit run, from some steps of it that begin at rest [s]. What cracks
/// cost is a mean, what flow costs is not in it.
double seconds_per_step(const Model& model, const BondRunCase& built);
double seconds_per_step(const ExplicitCase& built);

}  // namespace perilink
