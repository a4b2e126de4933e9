#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// What the bonds of a material make of it.
struct MaterialStrength {
  double tensile_strength = 0.0;      ///< uniaxial [force/length^2]; 0: nothing can break
  double compressive_strength = 0.0;  ///< uniaxial [force/length^2]; 0: not known
  double fracture_energy = 0.0;       ///< that its bonds release [force/length]
  double process_zone = 0.0;          ///< E G_F / f_t^2 [length]
  double first_stretch = 0.0;         ///< where the force of a bond begins to fall, s_0 [-]
  double last_stretch = 0.0;          ///< where it has fallen to zero, s_1 [-]
  Index segments = 0;                 ///< events until a bond is broken
};

/// What crosses a weak interface.
struct InterfaceBonds {
  Index count = 0;    ///< bonds
  double area = 0.0;  ///< area of the face [length^2]
  MaterialStrength strength = {};
};

/// What segments of reinforcing bars are beside elements, in the order of these: bar after bar,
/// from the beginning of each to its end.
struct Bars {
  std::vector<double> area;          ///< cross-section [length^2], per segment
  std::vector<Index> bar;            ///< number of the bar, per segment
  std::vector<std::uint8_t> turned;  ///< nonzero: its second end comes first along the bar
  /// Around the surface that touches the solid [length], per segment; empty: round bars.
  std::vector<double> perimeter = {};
  /// Stress over strain, over those of yielding, per bar; no points: a plateau. Empty: all are.
  std::vector<ForceCurve> curves = {};
  /// Whether the segment and the one before belong to one bar.
  bool continues(std::size_t segment) const {
    return segment > 0 && segment < bar.size() && bar[segment] == bar[segment - 1];
  }
};

/// What the bonds of plates and shells have beside those of a sheet in the plane: they are as thick
/// as it is, and lie in space (docs/theory/shells.md).
struct Shell {
  Particles mid_surface;        ///< the particles before the sheet was laid on its surface, z = 0
  double thickness = 0.0;       ///< t [length]
  std::vector<double> normals;  ///< across each bond, of the middle surface; shape (elements, 3)
  std::vector<double> rise;     ///< mean height of that surface over each bond [length]
  std::vector<double> shear_ratio;  ///< stiffness against shear across the sheet over k [-]
};

/// A body as mechanics sees it: particles and truss or frame elements. Elements are numbered: bonds
/// of the solid first, then ties between bars and solid, then the segments of the bars.
struct Network {
  Particles particles;
  Bonds bonds;
  std::vector<double> stiffness;  ///< intact axial stiffness k [force/length], per element
  /// Intact bending stiffness 12 d V_i V_j / xi^3 of micropolar bonds [force/length], per element;
  /// empty where no bond carries a moment.
  std::vector<double> bending;
  /// The k_b / k with which shear and bending of calibrated bonds count in their equivalent
  /// stretch, that of the uncalibrated bond (docs/theory/micropolar.md, section 5) [-], per
  /// element; empty: bending over stiffness of the bond itself.
  std::vector<double> bending_ratio;
  /// Where micropolar bonds bent by a transverse force have their inflection, from the first end
  /// over the length [-], per element; empty: in the middle.
  std::vector<double> inflection;
  /// Ends at which micropolar bonds are hinged, see BondEnd, per element: with a hinge nothing
  /// resists the relative rotation of the ends, and the inflection lies at it; with two the bond is
  /// a truss. Empty: none is.
  std::vector<std::uint8_t> hinged;
  /// State-based particles only: beside its bonds a particle stores c s^2 / 2, s the sum of the
  /// extensions of its neighbours' bonds, c = b / 2 [force/length] (b / (2 L_0) in a lattice), per
  /// particle; negative where Poisson's ratio is below that of the bonds alone. Empty: bonds only.
  /// Trusses alone have it.
  std::vector<double> state_stiffness;
  /// In whose sums the extension of a bond counts, see BondEnd, per element; empty: in those of
  /// both its ends. Nearest neighbours need not be mutual.
  std::vector<std::uint8_t> state_of;
  double torsion = 1.0;  ///< torsional over bending modulus of micropolar bonds in 3D [-]
  /// Laws of the elements, and the number of each element's; empty: all have the first one.
  std::vector<BondLaw> laws = {BondLaw::brittle()};
  std::vector<Index> law_of;
  /// By which each element's law counts its stretches [-]: where brittle bonds break, the yield
  /// strain of bars; infinity: stays elastic. Empty: all do, as in every elastic analysis.
  std::vector<double> critical_stretch;
  /// Materials whose mean breaks a bond, per element: those of the layers that it belongs to.
  /// Empty: those of its ends.
  std::vector<std::array<Index, 2>> materials_of;
  std::vector<MaterialStrength> strengths;  ///< by material; empty where bonds were not asked
  /// Stiffness of elastic supports between the components of particles and the ground
  /// [force/length], shape (particles, width); empty: none.
  std::vector<double> support_stiffness;
  Index first_slip_spring = 0;  ///< number of the first tie
  /// Number of the first tie between a node of a bar and its anchor. At a node there is one along
  /// the bar, then those across it.
  Index first_embedded_slip_spring = 0;
  Index first_bar_element = 0;  ///< number of the first bar segment
  Bars bars;
  EmbeddedPoints embedded_points;  ///< the last particles
  Facets facets;  ///< surface and interfaces, with the shares that the bonds balance
  std::optional<CalibrationReport> calibration;  ///< where bonds were calibrated

  /// Bonds that pre-cracks have broken and that close where they are compressed, ascending; others
  /// are taken out.
  std::vector<Index> cut_elements;
  std::vector<Index> cut_by_crack;         ///< bonds that each pre-crack took out
  std::vector<InterfaceBonds> interfaces;  ///< bonds of each weak interface

  /// Ordinary finite elements where the body has no bonds. Particles are their vertices; their
  /// edges are the last bonds of the solid, without stiffness: they connect, and carry nothing.
  std::optional<LinearElements> cells;

  std::optional<Shell> shell;  ///< where the body is a plate or a shell
  /// From the axis of a beam to its faces [length], per element; empty: the body is no beam.
  std::vector<double> half_height;

  int dim() const { return particles.dim; }
  /// The particles where a case means them: those of a shell on its flat sheet.
  const Particles& places() const { return shell ? shell->mid_surface : particles; }
  /// Components of the motion of a particle: displacements along the axes and, where bonds carry
  /// moments, rotations: (u, v) or (u, v, theta) in two dimensions, (u, v, w) or
  /// (u, v, w, theta_x, theta_y, theta_z) in three.
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
  /// Whether bonds stand for whole sections of a shell or a beam: particles have no stress, and
  /// cracks no opening.
  bool has_sections() const { return shell.has_value() || is_beam(); }
  bool has_states() const { return !state_stiffness.empty(); }
  /// Whether the extension of a bond counts in the sum of its first end, or its second.
  bool counts_for(Index element, BondEnd end) const {
    return state_of.empty() || (state_of[element] & end) != 0;
  }
  Index num_elements() const { return bonds.size(); }
  /// Bonds of the solid, without the edges of cells.
  Index num_bonds() const { return first_slip_spring - num_edges_of_cells(); }
  Index num_edges_of_cells() const { return cells ? cells->num_edges : 0; }
  const BondLaw& law(Index element) const { return laws[law_of.empty() ? 0 : law_of[element]]; }
  /// Whether some elements close once they are damaged.
  bool has_closing() const {
    return std::any_of(laws.begin(), laws.end(), [](const BondLaw& law) { return law.closes(); });
  }
  /// Whether some elements have teeth in compression of their own.
  bool has_crushing() const {
    return std::any_of(laws.begin(), laws.end(), [](const BondLaw& law) { return law.crushes(); });
  }
  /// Whether some lose their stiffness against a change of length alone.
  bool has_kept_shear() const {
    return std::any_of(laws.begin(), laws.end(),
                       [](const BondLaw& law) { return law.keeps_shear(); });
  }
  double critical_stretch_of(Index element) const {
    return critical_stretch.empty() ? infinity : critical_stretch[element];
  }
  /// Whether its law has events, or it stays elastic.
  bool has_limit(Index element) const { return !std::isinf(critical_stretch_of(element)); }
  bool can_break(Index element) const { return has_limit(element) && !law(element).endless(); }
  bool is_segment(Index element) const { return element >= first_bar_element; }
  Index first_embedded_point() const { return particles.size() - embedded_points.size(); }
  bool is_embedded_point(Index particle) const { return particle >= first_embedded_point(); }
  /// Whether the motion of an end is that of particles around it.
  bool is_embedded(Index element) const {
    return is_embedded_point(bonds.second[element]) || is_embedded_point(bonds.first[element]);
  }
};

/// Calls visit(particle, whether at the second end, weight) for what moves the ends of an element:
/// particles, and those around an anchor.
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

/// Takes out the elements that are not marked. Only before bars are added.
void keep_elements(Network& network, std::span<const std::uint8_t> keep);

}  // namespace perilink
