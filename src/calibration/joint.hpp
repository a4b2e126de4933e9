#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calibration/bond_equations.hpp"
#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Materials in layers, which meet in parallel planes, and the displacements that are linear in
/// each layer, continuous, and in equilibrium across the planes: strains along the planes and
/// tractions across them are the same in all layers. In every one of these fields bonds are to be
/// in balance as linear finite elements are (docs/theory/calibration.md, section 4).
///
/// Equations of a particle: the components of its force in every field, along the axes of the
/// planes (the last is their normal). Those in front settle it where all its bonds lie in one
/// layer; the others say something new only where bonds cross a plane or end on it.
struct Joint {
  int dim = 2;
  std::vector<Vector3> axes;             ///< unit vectors, the normal last
  std::vector<double> planes;            ///< coordinates along the normal, ascending [length]
  std::vector<Index> layers;             ///< materials between them, one more than planes
  std::vector<LameConstants> materials;  ///< all
  double tolerance = 0.0;                ///< this close to a plane a particle lies in it [length]

  int rows() const { return dim == 2 ? 6 : 18; }
  int rows_in_front() const { return dim == 2 ? 4 : 10; }
  double height(std::span<const double> position) const;
  /// Whether a bond between these heights has parts in two layers.
  bool crosses(double from, double to) const;
  bool in_plane(double height) const;
  /// Modulus lambda + 2 mu that the material between two heights has in series.
  double modulus_between(double from, double to) const;

  /// Per unit of the stiffness of a bond, at the end at `from`, whose direction points away.
  void axial(double length, std::span<const double> direction, double from, double to,
             double* row) const;
  /// Energy of a bond over its stiffness, and of a material over its volume, in the field that is
  /// a dilatation in the first layer.
  double dilatation(double length, std::span<const double> direction, double from, double to) const;
  double dilatation_at(double height) const;  ///< in a plane the mean of both sides
  /// Right side: less the traction on an area of the inside, whose outside takes its own.
  void right(std::span<const double> area, Index inside, Index outside, double* row) const;
};

/// Nothing where materials of different constants meet otherwise, or not at all.
/// \param spacing  between particles [length]
std::optional<Joint> find_joint(const Facets& facets, const Particles& particles,
                                const std::vector<LameConstants>& materials, double spacing);

/// Whether each particle has bonds that cross a plane or lies in one.
std::vector<std::uint8_t> particles_at_joint(const Joint& joint, const Particles& particles,
                                             const Bonds& bonds);

/// Bonds that cross a plane and that no positive stiffness balances: those of particles all of whose
/// crossing bonds lie so near the normal that t^2 < (dim - 1) n^2 / 3, t and n the parts of their
/// directions along the plane and across it; and of those that are left alone by that
/// (docs/theory/calibration.md). Nonzero where a bond may stay.
std::vector<std::uint8_t> bonds_at_joint_to_keep(const Joint& joint, const Particles& particles,
                                                 const Bonds& bonds);

/// What bonds leave out of balance; shape (particles, Joint::rows()) [force].
std::vector<double> forces_out_of_balance(const Joint& joint, const Facets& facets,
                                          const Particles& particles, const Bonds& bonds,
                                          std::span<const double> stiffness);

}  // namespace perilink
