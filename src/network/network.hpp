#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/bonds.hpp"
#include "discretization/embedded_points.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"
#include "material/bond_law.hpp"
#include "material/force_curve.hpp"
#include "network/cells/linear_elements.hpp"
#include "network/secants.hpp"

namespace perilink {

/// Ends of a bond, as bits.
enum BondEnd : std::uint8_t { first_end = 1, second_end = 2 };

/// Strength and toughness of a material with its bonds.
struct MaterialStrength {
  double tensile_strength = 0.0;      ///< uniaxial [force/length^2]; 0: unbreakable
  double compressive_strength = 0.0;  ///< uniaxial [force/length^2]; 0: unknown
  double fracture_energy = 0.0;       ///< released by its bonds [force/length]
  double process_zone = 0.0;          ///< E G_F / f_t^2 [length]
  double first_stretch = 0.0;         ///< stretch of a bond at peak force, s_0 [-]
  double last_stretch = 0.0;          ///< stretch of a bond at zero force, s_1 [-]
  Index segments = 0;                 ///< events until a bond is broken
};

/// Bonds across a weak interface.
struct InterfaceBonds {
  Index count = 0;    ///< number of bonds
  double area = 0.0;  ///< area of the face [length^2]
  MaterialStrength strength = {};
};

/// Further properties of bar elements, in their order: bar after bar, from the beginning of each to
/// its end.
struct Bars {
  std::vector<double> area;          ///< cross-section [length^2], per bar element
  std::vector<Index> bar;            ///< number of the bar, per bar element
  std::vector<std::uint8_t> turned;  ///< nonzero: its second end comes first along the bar
  /// Perimeter of the contact with the solid [length], per bar element; empty: round bars.
  std::vector<double> perimeter = {};
  /// Parts of each bar element that the nodes at its two ends, along the bar, tie to the solid [-];
  /// empty: half of it each.
  std::vector<std::array<double, 2>> tied_parts = {};
  /// Stress over strain, relative to yielding, per bar; without points: a plateau. Empty: all
  /// plateaus.
  std::vector<ForceCurve> curves = {};
  /// Returns whether a bar element and the one before belong to one bar.
  bool continues(std::size_t segment) const {
    return segment > 0 && segment < bar.size() && bar[segment] == bar[segment - 1];
  }
};

/// Properties of plates and shells that a plane network does not have: thickness and shape in space
/// (docs/theory/shells.md).
struct Shell {
  Particles mid_surface;        ///< particles of the flat mid-surface, z = 0
  double thickness = 0.0;       ///< t [length]
  std::vector<double> normals;  ///< normal of the mid-surface at each bond; shape (elements, 3) [-]
  std::vector<double> rise;     ///< mean height of the mid-surface over each bond [length]
  std::vector<double> shear_ratio;  ///< out-of-plane shear stiffness over k [-]
};

/// States of state-based particles. In addition to its bonds a particle stores c s^2 / 2, with s
/// the sum of the extensions of its neighbours' bonds.
struct ParticleStates {
  /// Stiffness c = b / 2 [force/length], per particle; b / (2 L_0) in a lattice. It is negative if
  /// Poisson's ratio is below the ratio of a network of bonds.
  std::vector<double> stiffness;
  /// Ends whose sums include the extension of a bond, see BondEnd, per element; empty: both ends.
  /// Nearest neighbours need not be mutual.
  std::vector<std::uint8_t> ends = {};
};

/// Results of building a network, for messages and estimates.
struct NetworkReport {
  std::optional<CalibrationReport> calibration;  ///< present if bonds were calibrated
  std::vector<MaterialStrength> strengths;       ///< by material; empty if bonds have no laws
  std::vector<Index> cut_by_crack;               ///< number of bonds removed by each pre-crack
  std::vector<InterfaceBonds> interfaces;        ///< bonds of each weak interface
};

/// Particles with truss or frame elements. Elements are numbered in this order: bonds of the solid,
/// contact springs of pre-cracks, slip springs between bars and solid, bar elements.
struct Network {
  Particles particles;
  Bonds bonds;
  std::vector<double> stiffness;  ///< intact axial stiffness k [force/length], per element
  /// Intact bending stiffness 12 d V_i V_j / xi^3 of micropolar bonds [force/length], per element;
  /// empty where no bond carries a moment.
  std::vector<double> bending;
  /// Ratio k_b / k of the uncalibrated bond [-], per element. It weights shear and bending in the
  /// equivalent stretch of calibrated bonds (docs/theory/micropolar.md, section 5). Empty: bending
  /// over stiffness of the bond.
  std::vector<double> bending_ratio;
  /// Inflection of micropolar bonds bent by a transverse force: distance from the first end over
  /// the length [-], per element. Empty: in the middle.
  std::vector<double> inflection;
  /// Hinged ends of micropolar bonds, see BondEnd, per element. With a hinge the relative rotation
  /// of the ends is free, and the inflection lies at the hinge. With two hinges the bond is a
  /// truss. Empty: no hinges.
  std::vector<std::uint8_t> hinged;
  std::optional<ParticleStates> states;  ///< present in state-based bodies, networks of trusses
  double torsion = 1.0;  ///< torsional over bending modulus of micropolar bonds in 3D [-]
  /// Laws of the elements, and the number of each element's law; empty: all have the first law.
  std::vector<BondLaw> laws = {BondLaw::brittle()};
  std::vector<Index> law_of;
  /// Reference stretch of each element's law [-]: the critical stretch of brittle bonds, the yield
  /// strain of bars. Infinity: elastic. Empty: all elements are elastic.
  std::vector<double> critical_stretch;
  /// Materials whose mean determines the strength of a bond, per element: the materials of its
  /// layers. Empty: the materials of its ends.
  std::vector<std::array<Index, 2>> materials_of;
  /// Stiffness of elastic supports between the components of particles and the ground
  /// [force/length], shape (particles, width); empty: no supports.
  std::vector<double> support_stiffness;
  /// Contact springs between the faces of pre-cracks, the last elements before slip springs. They
  /// act in compression only. Their second ends are embedded points (docs/theory/softening.md,
  /// section 8).
  Index num_contacts = 0;
  Index first_slip_spring = 0;  ///< number of the first slip spring
  /// Number of the first slip spring between a bar node and its embedded point. Each node has one
  /// along the bar, then those across it.
  Index first_embedded_slip_spring = 0;
  Index first_bar_element = 0;  ///< number of the first bar element
  Bars bars;
  EmbeddedPoints embedded_points;  ///< the last particles
  Facets facets;  ///< surface and interfaces, with the nodal area fractions that the bonds balance
  NetworkReport report;

  /// Tied finite elements where the body has no bonds. Particles are their vertices. Their edges
  /// are the last bonds of the solid; they have no stiffness and serve for connectivity.
  std::optional<LinearElements> cells;

  std::optional<Shell> shell;  ///< present for plates and shells
  /// Distance from the axis of a beam to its faces [length], per element; empty: not a beam.
  std::vector<double> half_height;

  int dim() const { return particles.dim; }
  /// Returns the particles at the positions that a case uses; a shell uses its flat mid-surface.
  const Particles& places() const { return shell ? shell->mid_surface : particles; }
  /// Returns the number of components of a particle's motion: displacements and, where bonds carry
  /// moments, rotations. These are (u, v) or (u, v, theta) in two dimensions. In three they are (u,
  /// v, w) or (u, v, w, theta_x, theta_y, theta_z).
  int width() const { return !carries_moments() ? dim() : dim() == 2 ? 3 : 6; }
  double ratio_of_bending(Index element) const {
    return bending_ratio.empty() ? bending[element] / stiffness[element] : bending_ratio[element];
  }
  double inflection_of(Index element) const {
    return inflection.empty() ? 0.5 : inflection[element];
  }
  bool is_hinged(Index element) const { return !hinged.empty() && hinged[element] != 0; }
  bool carries_moments() const { return !bending.empty(); }
  bool is_beam() const { return !half_height.empty(); }
  /// Returns whether bonds represent whole sections of a shell or a beam. Particles then have no
  /// stress, and cracks have no opening.
  bool has_sections() const { return shell.has_value() || is_beam(); }
  bool has_states() const { return states.has_value(); }
  /// Returns whether the extension of a bond counts in the sum of the given end.
  bool counts_for(Index element, BondEnd end) const {
    return states->ends.empty() || (states->ends[element] & end) != 0;
  }
  Index num_elements() const { return bonds.size(); }
  /// Returns the number of particles without the points of contact springs.
  Index num_particles() const { return particles.size() - num_contacts; }
  /// Returns the number of bonds of the solid, without the edges of cells.
  Index num_bonds() const { return first_contact() - num_edges_of_cells(); }
  Index first_contact() const { return first_slip_spring - num_contacts; }
  /// Returns the numbers of the contact springs, ascending.
  std::vector<Index> contacts() const {
    std::vector<Index> numbers(static_cast<std::size_t>(num_contacts));
    std::iota(numbers.begin(), numbers.end(), first_contact());
    return numbers;
  }
  bool is_contact(Index element) const {
    return element >= first_contact() && element < first_slip_spring;
  }
  Index num_edges_of_cells() const { return cells ? cells->num_edges : 0; }
  const BondLaw& law(Index element) const { return laws[law_of.empty() ? 0 : law_of[element]]; }
  /// Returns whether some elements have crack closure.
  bool has_closing() const {
    return std::any_of(laws.begin(), laws.end(), [](const BondLaw& law) { return law.closes(); });
  }
  /// Returns whether some elements have a compressive branch.
  bool has_crushing() const {
    return std::any_of(laws.begin(), laws.end(), [](const BondLaw& law) { return law.crushes(); });
  }
  /// Returns whether some elements retain shear stiffness as they lose axial stiffness.
  bool has_kept_shear() const {
    return std::any_of(laws.begin(), laws.end(),
                       [](const BondLaw& law) { return law.keeps_shear(); });
  }
  double critical_stretch_of(Index element) const {
    return critical_stretch.empty() ? infinity : critical_stretch[element];
  }
  /// Returns whether the law of an element has events; otherwise it stays elastic.
  bool has_limit(Index element) const { return !std::isinf(critical_stretch_of(element)); }
  bool can_break(Index element) const { return has_limit(element) && !law(element).endless(); }
  bool is_segment(Index element) const { return element >= first_bar_element; }
  Index first_embedded_point() const { return particles.size() - embedded_points.size(); }
  bool is_embedded_point(Index particle) const { return particle >= first_embedded_point(); }
  /// Returns whether an end of an element is an embedded point.
  bool is_embedded(Index element) const {
    return is_embedded_point(bonds.second[element]) || is_embedded_point(bonds.first[element]);
  }
};

/// Calls visit(particle, whether at the second end, weight) for the particles that move the ends of
/// an element. An embedded point is replaced by the particles around it.
template <class Visit>
void for_each_end(const Network& network, Index element, Visit visit) {
  for (const bool second : {false, true}) {
    const Index end = second ? network.bonds.second[element] : network.bonds.first[element];
    if (!network.is_embedded_point(end)) {
      visit(end, second, 1.0);
      continue;
    }
    const Index embedded_point = end - network.first_embedded_point();
    const auto particles = network.embedded_points.particles.row(embedded_point);
    const auto weights = network.embedded_points.weights_of(embedded_point);
    for (std::size_t k = 0; k < particles.size(); ++k) visit(particles[k], second, weights[k]);
  }
}

/// Removes the elements that are not marked. Call it only before bars are added.
void keep_elements(Network& network, std::span<const std::uint8_t> keep);

}  // namespace perilink
