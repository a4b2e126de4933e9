#pragma once

#include <vector>

#include "app/plot/svg.hpp"
#include "measures.hpp"

namespace perilink::verification {

struct CrackPicture {
  Make make;
  Crack crack;
  Place tip{};
  double angle = 0.0;  ///< [degrees]
};

/// The bonds that broke, a panel for each run: a row for each arrangement, a column for each kind
/// of bonds.
Svg draw_cracks(const std::vector<CrackPicture>& pictures);

struct Kink {
  Make make;
  double mixity = 0.0;  ///< atan2(K_II, K_I) [degrees]
  double angle = 0.0;   ///< [degrees]
};

/// Angles over mixity beside the largest hoop stress, a panel for each kind of bonds.
Svg draw_kinks(const std::vector<Kink>& kinks);

}  // namespace perilink::verification
