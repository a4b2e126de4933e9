#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/types.hpp"
#include "calibration/bond_equations.hpp"
#include "calibration/calibration.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/rebar.hpp"
#include "discretization/region.hpp"
#include "material/elasticity.hpp"
#include "material/force_curve.hpp"
#include "material/micromodulus.hpp"
#include "material/micropolar.hpp"
#include "material/softening.hpp"
#include "material/strength/property_field.hpp"

namespace perilink {

/// Deformations that a bond resists.
enum class BondModel {
  bond_based,  ///< extension: a truss
  micropolar,  ///< extension, shear and bending: a frame; particles rotate
};

/// An elastic solid whose bonds break or soften.
struct SolidMaterial {
  double youngs_modulus = 0.0;                                       ///< E [force/length^2]
  double fracture_energy = std::numeric_limits<double>::infinity();  ///< G_F [force/length];
                                                                     ///< infinity: unbreakable
  double poissons_ratio = 0.0;  ///< nu of micropolar bonds; other bonds have a fixed one
  SofteningMaterial softening = {};
};

/// Bond between an embedded bar and the solid around its nodes.
struct BarBond {
  /// Bond stress over slip [force/length^2, length]; empty: perfect bond without slip.
  std::optional<ForceCurve> curve = {};
  bool elastic = false;    ///< the first line of the curve has no end
  double perimeter = 0.0;  ///< perimeter [length]
  bool hook_from = false;  ///< the first end of the bar does not slip
  bool hook_to = false;    ///< the last end of the bar does not slip
};

/// A reinforcing bar.
struct BarMaterial {
  double youngs_modulus = 0.0;                                      ///< E [force/length^2]
  double area = 0.0;                                                ///< A [length^2]
  double yield_strength = std::numeric_limits<double>::infinity();  ///< f_y [force/length^2];
                                                                    ///< infinity: stays elastic
  bool slip_springs_break =
      true;  ///< false: bonds between the bar and the solid are unbreakable; not for embedded bars
  /// Stress over strain from the yield strength on, instead of a plateau.
  std::optional<ForceCurve> curve = {};
  BarBond bond = {};   ///< bond of embedded bars
  bool bends = false;  ///< the bar also resists bending, as a round bar; only for embedded bars
  /// Bar elements end at embedded points that a prestrain or flow shifts from their nodes; only for
  /// embedded bars.
  bool shifts = false;
};

/// A face with its own fracture energy and law.
struct WeakInterface {
  /// Side of each particle: 1 or 2; 0: neither, 3: in both regions. Bonds between the two sides
  /// cross the face. Empty: bonds that cross the lines or planes.
  std::vector<std::uint8_t> side;
  std::vector<Crack> faces;
  double fracture_energy = 0.0;  ///< [force/length]
  SofteningMaterial softening = {};
};

/// Whether the bonds of a body are calibrated.
enum class Calibrating {
  always,
  only_alike,  ///< bonds stay uncalibrated if the symmetry-reduced equations have no solution
  never,       ///< draft: shows results that do not depend on the calibration before it runs
  estimated    ///< draft that reports the expected cost of the calibration
};

/// Parameters that turn the particles of a body into a network.
struct NetworkInput {
  Problem problem = Problem::plane_stress;
  BondModel model = BondModel::bond_based;
  double torsion = 1.0;    ///< Network::torsion
  double horizon = 0.0;    ///< delta [length]
  double thickness = 1.0;  ///< t of two-dimensional bodies [length]
  bool shell = false;      ///< the body is the mid-surface of a shell, in plane stress
  double radius = 0.0;     ///< radius of a cylindrical shell, x around it; 0: flat [length]
  Constants micromodulus = Constants::lattice;
  Constants critical_stretch = Constants::lattice;
  /// No limits: critical_stretch and bending_ratio of the network stay empty, and interfaces equal
  /// their surroundings.
  bool elastic = false;
  std::vector<SolidMaterial> materials;  ///< by Particles::material
  std::vector<Box> solid;  ///< the body is the union of these boxes; bonds do not leave it. Empty:
                           ///< every pair within the horizon is bonded
  /// Pre-cracks; bonds and slip springs do not cross them.
  std::vector<Crack> cracks;
  std::vector<WeakInterface> interfaces;  ///< a later interface takes precedence for common bonds
  std::vector<PropertyField> fields;      ///< factors of one property are multiplied
  std::vector<RebarLine> bars;
  std::vector<BarMaterial> bar_materials;  ///< per bar
  CalibrationCalls calibration;
  Calibrating calibrating = Calibrating::always;

  /// Whether the model stays uncalibrated.
  bool is_draft() const {
    return calibrating == Calibrating::never || calibrating == Calibrating::estimated;
  }
};

/// Returns the constants c [force/length^6] and d [force/length^4] of the bonds of a material; d is
/// zero in bond-based solids.
/// \throws std::invalid_argument for a Poisson's ratio that the bonds cannot have
MicropolarModuli moduli_of(const Body& body, const NetworkInput& input,
                           const SolidMaterial& material);

/// Returns Lame's constants of a material in the body's kinematics; bond-based solids have
/// lambda = mu.
LameConstants lame_constants(const NetworkInput& input, const SolidMaterial& material);

}  // namespace perilink
