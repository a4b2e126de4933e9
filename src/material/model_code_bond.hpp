#pragma once

#include "material/force_curve.hpp"

namespace perilink {

/// Failure of the concrete around a ribbed bar (fib Model Code 2010, Table 6.1-1).
enum class BondFailure {
  pull_out,            ///< well confined
  splitting,           ///< unconfined
  splitting_stirrups,  ///< confined by stirrups
};

/// Bond conditions, from the position of the bar during casting.
enum class BondConditions { good, other };

/// Bond stress over slip of ribbed bars, fib Model Code 2010, section 6.1.1.1.
struct ModelCodeBond {
  double mean_strength = 0.0;  ///< f_cm, compressive [force/length^2]
  double rib_spacing = 0.0;    ///< clear distance between ribs [length]
  BondFailure failure = BondFailure::pull_out;
  BondConditions conditions = BondConditions::good;
  double megapascal = 1.0;  ///< 1 MPa [force/length^2]
  double millimetre = 1.0;  ///< 1 mm [length]
};

/// Returns the bond curve: tau_max (s / s_1)^0.4 up to the bond strength, then a plateau up to s_2.
/// It falls in a straight line to the frictional stress at s_3 and stays constant. A straight line
/// up to s_1 / 1000 replaces the infinite initial stiffness.
ForceCurve model_code_curve(const ModelCodeBond& bond);

}  // namespace perilink
