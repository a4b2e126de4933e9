#pragma once

#include <string>
#include <vector>

#include "cohesive_disc.hpp"
#include "problems/lattice_test.hpp"

/// \file
/// The tests of Nikravesh & Gerstle (2018, section 3) in N, m, kg, s, with the parameters of their
/// Table 1 by the case files of meshes/.

namespace perilink::verification {

inline constexpr double tension_strength = 2.62e6;     ///< f_t [N/m^2]
inline constexpr double fracture_energy = 91.7;        ///< area under the law of the opening [N/m]
inline constexpr double block_section = 0.15 * 0.15;   ///< area of the block [m^2]
inline constexpr double printed_block_step = 6.55e-7;  ///< at the spacing 0.01 m [s]
inline constexpr double printed_disc_step = 3.27e-7;   ///< at 0.005 m [s]

/// The rules of a run.
inline const std::vector<std::string> variants = {"2017", "2018", "consistent"};

/// Rules of the papers take their time step, the consistent ones nine tenths of the critical one.
LatticeTest tension_test(const std::string& variant, double degrees);
/// By the consistent rules at any spacing, in the box that is cut at 0.01 m.
LatticeTest spaced_tension_test(double degrees, double spacing);
/// Mean section of the lattice of a block that is pulled along y: the volume of its particles over
/// its height [m^2].
double mean_section(const LatticeTest& block);
LatticeTest compression_test(const std::string& variant, double degrees);
/// Cut a quarter of a spacing beyond the radius, held within the last spacing of what is cut.
LatticeTest disc_test(const std::string& variant, double degrees, double spacing);
/// The same with a lattice point off the centre by parts of the two lattice vectors.
LatticeTest placed_disc_test(const std::string& variant, double degrees, double spacing, double a,
                             double b);
/// Half of the width of the columns of particles that a platen drives, each as wide as columns are
/// apart in the mean [m].
double half_platen(const LatticeTest& disc, bool upper);
/// The continuum that such a disc stands for: as large as its particles together, between platens
/// as wide as the columns of particles that they drive.
CohesiveDisc continuum_of(const LatticeTest& disc);

}  // namespace perilink::verification
