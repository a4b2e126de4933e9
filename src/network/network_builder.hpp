#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "calibration/calibration.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/rebar.hpp"
#include "material/elasticity.hpp"
#include "material/micropolar.hpp"
#include "network/network.hpp"

namespace perilink {

/// Where a constant of the bonds comes from.
enum class Constants {
  lattice,    ///< sums over the neighbours that a particle of the lattice really has
  continuum,  ///< integrals over the infinite body
};

/// What a bond resists.
enum class BondModel {
  bond_based,  ///< its extension: a truss
  micropolar,  ///< extension, shear and bending: a frame; particles rotate
};

/// A brittle elastic solid.
struct SolidMaterial {
  double youngs_modulus = 0.0;                                       ///< E [force/length^2]
  double fracture_energy = std::numeric_limits<double>::infinity();  ///< G_F [force/length];
                                                                     ///< infinity: unbreakable
  double poissons_ratio = 0.0;  ///< nu of micropolar bonds; others have no choice
};

/// A reinforcing bar.
struct BarMaterial {
  double youngs_modulus = 0.0;                                      ///< E [force/length^2]
  double area = 0.0;                                                ///< A [length^2]
  double yield_strength = std::numeric_limits<double>::infinity();  ///< f_y [force/length^2];
                                                                    ///< infinity: stays elastic
  bool ties_break = true;  ///< false: nothing breaks between the bar and the solid
};

/// What makes a network out of the particles of a body.
struct NetworkInput {
  Problem problem = Problem::plane_stress;
  BondModel model = BondModel::bond_based;
  double torsion = 1.0;    ///< Network::torsion
  double horizon = 0.0;    ///< delta [length]
  double thickness = 1.0;  ///< t of two-dimensional bodies [length]
  Constants micromodulus = Constants::lattice;
  Constants critical_stretch = Constants::lattice;
  std::vector<SolidMaterial> materials;  ///< by Particles::material
  std::vector<Box> solid;  ///< the body is the union of these; bonds that leave it are not made.
                           ///< Empty: every pair within the horizon is bonded
  /// There before the analysis begins; bonds and ties do not cross them.
  std::vector<Crack> cracks;
  std::vector<RebarLine> bars;
  std::vector<BarMaterial> bar_materials;  ///< per bar
  CalibrationObserver on_search;           ///< told of the calibration of bonds; may be empty
  bool draft = false;  ///< bonds as they are before calibration: whatever does not depend on it can
                       ///< be asked before it is paid for
};

/// Constants c [force/length^6] and d [force/length^4] of the bonds of a material of the body; d is
/// zero in bond-based solids.
/// \throws std::invalid_argument for a Poisson's ratio that the bonds cannot have
MicropolarModuli moduli_of(const Body& body, const NetworkInput& input,
                           const SolidMaterial& material);

/// Lame's constants of a material in the body's kinematics; of bond-based solids lambda = mu.
LameConstants lame_constants(const NetworkInput& input, const SolidMaterial& material);

/// Bonds, bars and ties of a body with their constants, corrected near surfaces as the body's
/// surface option asks (correct_surfaces).
/// - Bond: k = c V_i V_j / xi with the mean c of its ends; a ghost's c is zero, hence half
///   stiffness (Gerstle, Sau & Silling 2005, section 4). It breaks at the critical stretch of the
///   mean fracture energy and mean micromodulus of its ends; a bond to a ghost at that of its solid
///   end. It cannot break where either end is unbreakable.
/// - Micropolar bond: the same, and the bending stiffness 12 d V_i V_j / xi^3 with the mean d of
///   its ends. Ties and segments carry no moments.
/// - Tie: stiffness and critical stretch of a bond of its solid end,
///   k = c V_i V / max(xi, spacing / 10), V the volume of a particle inside the lattice. Where bars
///   share a node its ties are unbreakable as soon as those of one of the bars are.
/// - Segment: k = E A / L, yield strain f_y / E, cannot break.
/// Bonds that leave the body or cross a pre-crack are not made.
/// Ghosts that too few bonds hold are left out, and bars add particles: the network's particles,
/// not the body's, are the ones that count from here on.
/// \throws std::invalid_argument where a material is missing, the numbers of bars and of their
///         materials differ, or the horizon is too small for the lattice
Network build_network(const Body& body, const NetworkInput& input);

/// Takes out the elements that are not marked. Only before bars are added.
void keep_elements(Network& network, std::span<const std::uint8_t> keep);

/// Particles that elements in fewer than dim independent directions hold: without a support they
/// move freely. Ascending.
std::vector<Index> find_loose_particles(const Network& network);

}  // namespace perilink
