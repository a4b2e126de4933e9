#pragma once

#include <string>

#include "problems/lattice_test.hpp"

/// \file
/// The tests of Nikravesh (2017, chapter 5) in N, m, kg, s.

namespace perilink::verification {

/// Section 5.2.2, with the parameters of its Table 1.
LatticeTest tension_test(const std::string& variant, double degrees);

/// Section 5.2.3, compressed by as many critical openings as in 2018: by those of its tension test,
/// as the thesis seems to say, it would stay elastic.
LatticeTest compression_test(const std::string& variant, double degrees);

/// Section 5.2.4, with the same parameters: a cylinder 0.3 m high.
LatticeTest cylinder_test(const std::string& variant, double degrees);

/// Section 5.3.2: specimen B of van Vliet & van Mier (2000), or D, four times as large.
LatticeTest dog_bone_test(const std::string& variant, char specimen, double spacing);

/// Peak forces by the formulas of the thesis [N].
inline constexpr double block_strength = 2.6168e6 * 0.15 * 0.15;
inline constexpr double block_compressive_strength = 27.58e6 * 0.15 * 0.15;
inline constexpr double cylinder_strength = 193e3;  ///< Eq. 5.6 with a block of D/6
inline constexpr double dog_bone_b_strength = 2.415e6 * 0.06 * 0.1;
inline constexpr double dog_bone_d_strength = 4.0 * dog_bone_b_strength;

}  // namespace perilink::verification
