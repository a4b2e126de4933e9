#pragma once

#include "app/model/from_case/configure.hpp"
#include "app/model/from_case/lattice_case.hpp"
#include "app/run/bond_run.hpp"
#include "solver/factor.hpp"

/// \file
/// What a run will take on one core, for people who plan it: rates of a quiet machine like that of
/// verification/benchmarks.

namespace perilink {

/// Time of the calibration [s], of a draft (draft_model()) the expected one. Where that is short it
/// is tried: how the search goes on the body at hand no rate can tell.
double time_of_calibration(const CaseFile& input, const Model& model);

struct ExpectedSetUp {
  double drafted;      ///< time that the draft took [s]
  double calibration;  ///< [s]
  double seconds() const { return drafted + calibration; }
};

/// What a quasistatic run costs after its set-up.
struct ExpectedCost {
  double memory = 0.0;         ///< [bytes]
  double factorization = 0.0;  ///< [s]
  double broken_bond = 0.0;    ///< with its row of the history [s]
  double batch = 0.0;          ///< events that go together [s]
  double field_file = 0.0;     ///< [s]
};

/// Field files of a run until so many bonds are broken.
Index field_files(const OutputSection& output, Index broken_bonds);

ExpectedCost expected_cost(const Network& network, const FactorStatistics& factor,
                           bool forces_alone);

/// What conjugate gradients cost in place of a factor.
/// \param events  whether the run follows events
ExpectedCost expected_cost_of_subdomains(const Network& network, bool events);

/// Time of a step of an explicit run, from some steps of it that begin at rest [s]. What cracks
/// cost is a mean, what flow costs is not in it.
double seconds_per_step(const Model& model, const BondRunCase& built);
double seconds_per_step(const ExplicitCase& built);

}  // namespace perilink
