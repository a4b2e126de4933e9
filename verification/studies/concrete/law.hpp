#pragma once

#include <fmt/format.h>

#include <string>

/// \file
/// Concrete of Gerstle, Sau & Aguilera (2007), section 6, in N and mm.

namespace perilink::verification {

inline constexpr double side = 203.2;  ///< eight inches [mm]

/// Lines of its material.
/// \param shear_softens  rule B: shear falls with the axial secant; else it stays, rule A
/// \param error  softening_error
inline std::string law_lines(bool shear_softens, double error = 0.01) {
  return fmt::format(
      "youngs_modulus = 24850\npoissons_ratio = 0.22\nsoftening = \"concrete\"\n"
      "tension_limit = 1.4e-4\ntension_factor = 2\ncompression_limit = 1e-3\n"
      "compression_factor = 3\nshear_softening = {}\nsoftening_error = {}\n",
      shear_softens, error);
}

}  // namespace perilink::verification
