#pragma once

namespace perilink {

/// How the force of a bond follows from the force states of its two particles, and with it every
/// rule in which the papers differ. Those of 2017 and 2018 are kept for comparison with the papers.
enum class LatticeRules {
  consistent,  ///< derivative of an energy; tributary volumes; cohesive band of the true opening
  least_2018,  ///< the smaller one where they agree in sign, else the mean (Nikravesh & Gerstle
               ///< 2018, Eq. 5): no derivative of any energy, even where nothing is damaged
  mean_2017,   ///< mean of the two (Nikravesh 2017)
};

}  // namespace perilink
