#pragma once

namespace perilink {

/// Rules for the force of a bond from the force states of its two particles, and all other rules
/// that differ between the papers. The rules of 2017 and 2018 serve for comparison with the papers.
enum class LatticeRules {
  consistent,  ///< derivative of an energy; tributary volumes; cohesive band with the true opening
  least_2018,  ///< the smaller one if both have one sign, else the mean (Nikravesh & Gerstle 2018,
               ///< Eq. 5); not conservative, even undamaged
  mean_2017,   ///< mean of the two (Nikravesh 2017)
};

}  // namespace perilink
