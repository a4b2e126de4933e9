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

namespace perilink {

/// What a bond resists.
enum class BondModel {
  bond_based,  ///< its extension: a truss
  micropolar,  ///< extension, shear and bending: a frame; particles rotate
};

/// An elastic solid whose bonds break or soften.
struct SolidMaterial {
  double youngs_modulus = 0.0;                                       ///< E [force/length^2]
  double fracture_energy = std::numeric_limits<double>::infinity();  ///< G_F [force/length];
                                                                     ///< infinity: unbreakable
  double poissons_ratio = 0.0;  ///< nu of micropolar bonds; others have no choice
  SofteningMaterial softening = {};
};

/// How the nodes of an anchored bar are held by the solid around them.
struct BarBond {
  /// Bond stress over slip [force/length^2, length]; empty: perfect, the bar does not slip.
  std::optional<ForceCurve> curve = {};
  bool elastic = false;    ///< its first line goes on for ever
  double perimeter = 0.0;  ///< around the bar [length]
  bool hook_from = false;  ///< the end where the bar begins does not slip
  bool hook_to = false;    ///< nor does the other
};

/// A reinforcing bar.
struct BarMaterial {
  double youngs_modulus = 0.0;                                      ///< E [force/length^2]
  double area = 0.0;                                                ///< A [length^2]
  double yield_strength = std::numeric_limits<double>::infinity();  ///< f_y [force/length^2];
                                                                    ///< infinity: stays elastic
  bool slip_springs_break =
      true;  ///< false: nothing breaks between the bar and the solid, if it is not
             ///< anchored
  /// Stress over strain from the yield strength on, in place of a plateau.
  std::optional<ForceCurve> curve = {};
  BarBond bond = {};   ///< that anchored bars have
  bool bends = false;  ///< it resists bending too, as round bars do, if it is anchored
  /// Its segments end at anchors of their own that a prestrain or flow moves away from their nodes;
  /// of anchored bars.
  bool shifts = false;
};

/// A face whose bonds break by an energy of their own.
struct WeakInterface {
  /// Per particle: on which side it lies, 1 or 2; 0: neither, 3: in both regions. Bonds with an end
  /// on either side cross the face. Empty: those do that cross the lines or planes.
  std::vector<std::uint8_t> side;
  std::vector<Crack> faces;
  double fracture_energy = 0.0;  ///< [force/length]
  SofteningMaterial softening = {};
};

/// What makes a network out of the particles of a body.
struct NetworkInput {
  Problem problem = Problem::plane_stress;
  BondModel model = BondModel::bond_based;
  double torsion = 1.0;    ///< Network::torsion
  double horizon = 0.0;    ///< delta [length]
  double thickness = 1.0;  ///< t of two-dimensional bodies [length]
  bool shell = false;      ///< the body is a sheet of a shell, in plane stress
  double radius = 0.0;     ///< the cylinder it lies on, x around it; 0: flat [length]
  Constants micromodulus = Constants::lattice;
  Constants critical_stretch = Constants::lattice;
  /// Nothing breaks: no bond gets a limit, Network::critical_stretch and bending_ratio stay empty,
  /// and interfaces are as their surroundings.
  bool elastic = false;
  std::vector<SolidMaterial> materials;  ///< by Particles::material
  std::vector<Box> solid;  ///< the body is the union of these; bonds that leave it are not made.
                           ///< Empty: every pair within the horizon is bonded
  /// There before the analysis begins; bonds and ties do not cross them.
  std::vector<Crack> cracks;
  std::vector<WeakInterface> interfaces;  ///< later ones count where several have a bond
  std::vector<RebarLine> bars;
  std::vector<BarMaterial> bar_materials;  ///< per bar
  CalibrationObserver on_search;           ///< told of the calibration of bonds; may be empty
  /// Calibrated bonds stay as they are where those that lie alike have no solution alike.
  bool only_alike = false;
  bool draft = false;  ///< bonds as they are before calibration: whatever does not depend on it can
                       ///< be asked before it is paid for
  bool estimates_cost = false;  ///< drafts tell what the calibration is expected to cost
};

/// Constants c [force/length^6] and d [force/length^4] of the bonds of a material of the body; d is
/// zero in bond-based solids.
/// \throws std::invalid_argument for a Poisson's ratio that the bonds cannot have
MicropolarModuli moduli_of(const Body& body, const NetworkInput& input,
                           const SolidMaterial& material);

/// Lame's constants of a material in the body's kinematics; of bond-based solids lambda = mu.
LameConstants lame_constants(const NetworkInput& input, const SolidMaterial& material);

}  // namespace perilink
