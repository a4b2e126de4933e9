#include "app/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/model_regions.hpp"
#include "app/position_field.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// Formulas for the same displacement, typed in two entries, may differ by round-off.
constexpr double same_value = 1e-9;

std::string name_of_component(const Network& network, int component) {
  const int dim = network.dim();
  if (component < dim) return fmt::format("displacement along {}", "xyz"[component]);
  return dim == 2 ? "rotation" : fmt::format("rotation about {}", "xyz"[component - dim]);
}

/// Component of the motion of a particle that an entry of SupportSection::fix means.
int component_of(const Network& network, int entry) {
  return entry < 3 || network.dim() == 3 ? entry : network.dim();
}

void prescribe(const CaseFile& input, const Model& model, Prescription& prescription,
               const std::string& region, const std::string& key, int component,
               const PositionField& values) {
  for (const Index i : particles_of_region(input, model, region, key + ".region")) {
    const std::size_t slot = static_cast<std::size_t>(i) * model.network.width() + component;
    const std::span<const double> x = model.network.particles.position(i);
    const double value = values.at(x)[0];
    const double before = prescription.value[slot];
    if (prescription.held[slot]) {
      const double largest = std::max(std::abs(value), std::abs(before));
      if (std::abs(value - before) <= same_value * largest) continue;
      throw InputError(
          input.where(key),
          fmt::format("sets the {} of the particle at ({}) to {}, where another entry sets it to {}",
                      name_of_component(model.network, component), fmt::join(x, ", "), value,
                      before),
          "let the regions of [[supports]] and [[displacements]] not overlap");
    }
    prescription.held[slot] = 1;
    prescription.value[slot] = value;
  }
}

}  // namespace

Prescription collect_prescriptions(const CaseFile& input, const Model& model) {
  const int dim = model.network.dim();
  const std::size_t width = model.network.width();
  Prescription prescription;
  prescription.held.assign(width * model.network.particles.size(), 0);
  prescription.value.assign(prescription.held.size(), 0.0);
  for (std::size_t k = 0; k < input.supports.size(); ++k) {
    const Expression zero;
    const PositionField values(input, item_key("supports", k), {&zero, 1});
    for (int entry = 0; entry < 6; ++entry) {
      if (!input.supports[k].fix[entry]) continue;
      prescribe(input, model, prescription, input.supports[k].region, item_key("supports", k),
                component_of(model.network, entry), values);
    }
  }
  for (std::size_t k = 0; k < input.displacements.size(); ++k) {
    for (int a = 0; a < dim; ++a) {
      const auto& value = input.displacements[k].value[a];
      if (!value) continue;
      const PositionField values(input, item_key("displacements", k, std::string(1, "xyz"[a])),
                                 {&*value, 1});
      prescribe(input, model, prescription, input.displacements[k].region,
                item_key("displacements", k), a, values);
    }
  }
  return prescription;
}

}  // namespace perilink
