#pragma once

namespace perilink {

/// Rules for the force of a bond from the force states of its two particles. They also select the
/// other rules that differ between Nikravesh (2017) and Nikravesh & Gerstle (2018). Both papers'
/// rules serve for comparison only.
enum class LatticeRules {
  consistent,  ///< derivative of an energy; tributary volumes; cohesive band with the true opening
  least_2018,  ///< the smaller one if both have one sign, else the mean (Nikravesh & Gerstle 2018,
               ///< Eq. 5); not conservative, even undamaged
  mean_2017,   ///< mean of the two (Nikravesh 2017)
};

}  // namespace perilink
