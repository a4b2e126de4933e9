#pragma once

#include "material/force_curve.hpp"

namespace perilink {

/// How the concrete around a ribbed bar fails (fib Model Code 2010, Table 6.1-1).
enum class BondFailure {
  pull_out,            ///< well confined
  splitting,           ///< unconfined
  splitting_stirrups,  ///< held together by stirrups
};

/// How the bar lay as it was cast.
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

/// tau_max (s / s_1)^0.4 up to the bond strength, a plateau up to s_2, a straight fall to the
/// frictional stress at s_3, which stays. The infinite stiffness at the beginning is cut off at s_1
/// / 1000.
ForceCurve model_code_curve(const ModelCodeBond& bond);

}  // namespace perilink
