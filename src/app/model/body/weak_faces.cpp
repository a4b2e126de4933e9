#include "app/model/body/weak_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {
namespace {

/// Particles this close to a region's side, in spacings, are inside.
constexpr double on_side = 1e-6;

/// Marks the particles of a region that the case names.
void mark(const CaseFile& input, const Body& body, const std::string& name, std::uint8_t side,
          std::vector<std::uint8_t>& sides) {
  const Region& region = *std::find_if(input.regions.begin(), input.regions.end(),
                                       [&](const Region& known) { return known.name == name; });
  const auto group = std::find_if(body.groups.begin(), body.groups.end(), [&](const Group& known) {
    return !region.group.empty() && known.name == region.group;
  });
  if (group != body.groups.end()) {
    for (const Index i : group->particles) sides[i] = side;
    return;
  }
  for (Index i = 0; i < body.particles.size(); ++i) {
    if (body.particles.kind[i] != ParticleKind::solid) continue;
    if (region.contains(body.particles.position(i), on_side * body.lattice.spacing)) {
      sides[i] = side;
    }
  }
}

std::string key_of(const CaseFile& input, std::size_t k, int dim) {
  const bool regions = !input.interfaces[k].between.empty();
  return item_key("interfaces", k, regions ? "between" : dim == 2 ? "points" : "corners");
}

}  // namespace

std::vector<WeakInterface> weak_interfaces(const CaseFile& input, const Body& body) {
  std::vector<WeakInterface> faces;
  if (input.analysis.type == AnalysisType::elastic) return faces;
  for (std::size_t k = 0; k < input.interfaces.size(); ++k) {
    const InterfaceSection& section = input.interfaces[k];
    // Stretches need no energy: any will do.
    const double energy = has_stretches(section.softening) ? 1.0 : section.fracture_energy;
    WeakInterface face{{}, {section.points}, energy, section.softening};
    if (!section.between.empty()) {
      face.side.assign(static_cast<std::size_t>(body.particles.size()), 0);
      mark(input, body, section.between[0], 1, face.side);
      mark(input, body, section.between[1], 2, face.side);
    } else {
      try {
        check_crack(face.face, body.particles.dim);
      } catch (const std::invalid_argument& error) {
        throw InputError(input.where(key_of(input, k, body.particles.dim)), error.what(), "");
      }
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

void refuse_interfaces_without_bonds(const CaseFile& input, const Network& network) {
  for (std::size_t k = 0; k < network.interfaces.size(); ++k) {
    if (network.interfaces[k].count > 0) continue;
    const bool regions = !input.interfaces[k].between.empty();
    throw InputError(
        input.where(key_of(input, k, network.dim())),
        regions ? "names two regions that no bond joins" : "crosses no bond of the body",
        regions ? "name regions that touch; what lies in both belongs to the second"
                : "move the line or plane into the body, or delete it");
  }
}

void refuse_strong_interface(const CaseFile& input, const NetworkInput& network,
                             const TooStrong& error) {
  const auto first = static_cast<Index>(network.materials.size());
  if (error.material < first) return;
  const auto k = static_cast<std::size_t>(error.material - first);
  const double strength = network.interfaces[k].softening.tensile_strength;
  throw InputError(
      input.where(item_key("interfaces", k, "tensile_strength")),
      fmt::format("is {:.6g}, but with a horizon of {:.6g} a bond would hold {:.3g} times the "
                  "energy at this stress that fracture_energy lets it dissipate",
                  strength, network.horizon, 1.0 / error.share),
      fmt::format("take a horizon below {:.4g}, a strength below {:.4g} or a larger "
                  "fracture_energy; brittle bonds have no strength of their own",
                  network.horizon * error.share, strength * std::sqrt(error.share)));
}

}  // namespace perilink
