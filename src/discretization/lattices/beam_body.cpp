#include "discretization/lattices/beam_body.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace perilink {
namespace {

double middle_of(const Box& box) { return 0.5 * (box.lower[1] + box.upper[1]); }

/// Returns distinct ends of the boxes along x, ascending.
std::vector<double> ends_of(const LatticeInput& input) {
  std::vector<double> ends;
  for (const Box& box : input.solid) {
    if (!(box.upper[1] > box.lower[1])) {
      throw std::invalid_argument("a region of the beam has no height: give it y = [-h/2, h/2]");
    }
    if (std::abs(middle_of(box) - middle_of(input.solid[0])) >
        input.boundary_tolerance * input.spacing) {
      throw std::invalid_argument("the regions of the beam lie about different axes along x");
    }
    ends.insert(ends.end(), {box.lower[0], box.upper[0]});
  }
  std::sort(ends.begin(), ends.end());
  const auto same = [&](double a, double b) {
    return b - a <= input.boundary_tolerance * input.spacing;
  };
  ends.erase(std::unique(ends.begin(), ends.end(), same), ends.end());
  if (ends.size() < 2) throw std::invalid_argument("the beam has no length along x");
  return ends;
}

/// Returns the last box that covers the point; all covering boxes must have one height.
std::size_t box_at(const LatticeInput& input, double x) {
  std::size_t last = input.solid.size();
  for (std::size_t b = input.solid.size(); b-- > 0;) {
    if (x <= input.solid[b].lower[0] || input.solid[b].upper[0] <= x) continue;
    if (last == input.solid.size()) last = b;
    const double apart = std::abs(input.solid[b].upper[1] - input.solid[last].upper[1]);
    if (apart > input.boundary_tolerance * input.spacing) {
      throw std::invalid_argument(
          "regions of different heights lie over each other: a section has one material");
    }
  }
  if (last < input.solid.size()) return last;
  throw std::invalid_argument("the regions of the beam leave a gap along x");
}

void add_particle(Body& body, double x, double y, Index material) {
  body.particles.positions.insert(body.particles.positions.end(), {x, y});
  body.particles.volumes.push_back(0.0);
  body.particles.material.push_back(material);
  body.particles.kind.push_back(ParticleKind::solid);
}

/// Adds facets at the ends of the beam and between its spans.
void add_facets(const LatticeInput& input, Body& body) {
  const auto face = [&](Index particle, double sign, const BeamSpan& inside, Index outside) {
    body.facets.append({&particle, 1}, {sign * inside.height * input.thickness, 0.0, 0.0},
                       inside.material, outside);
  };
  face(body.spans.front().first, -1.0, body.spans.front(), no_index);
  for (std::size_t k = 0; k + 1 < body.spans.size(); ++k) {
    face(body.spans[k].last, 1.0, body.spans[k], body.spans[k + 1].material);
  }
  face(body.spans.back().last, 1.0, body.spans.back(), no_index);
}

}  // namespace

Body make_beam_body(const LatticeInput& input) {
  const std::vector<double> ends = ends_of(input);
  Body body;
  double longest = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double length = ends[k + 1] - ends[k];
    const std::size_t number = box_at(input, ends[k] + 0.5 * length);
    const Box& box = input.solid[number];
    const double parts = std::max(1.0, std::ceil(length / input.spacing - 1e-6));
    const double step = length / parts;
    const double share = 0.5 * step * (box.upper[1] - box.lower[1]) * input.thickness;
    if (k == 0) add_particle(body, ends[0], middle_of(box), input.material[number]);
    const Index first = body.particles.size() - 1;
    for (double part = 1.0; part <= parts; part += 1.0) {
      const double x = part == parts ? ends[k + 1] : ends[k] + part * step;
      add_particle(body, x, middle_of(box), input.material[number]);
      body.particles.volumes[body.particles.volumes.size() - 2] += share;
      body.particles.volumes.back() += share;
    }
    body.spans.push_back(
        {first, body.particles.size() - 1, input.material[number], box.upper[1] - box.lower[1]});
    longest = std::max(longest, step);
  }
  add_facets(input, body);
  body.lattice.spacing = longest;
  body.lattice.step[0] = body.spans.size() == 1 ? longest : 0.0;
  body.lattice.surface = Surface::calibrated;  // bonds balance forces at the ends too
  body.lattice.cell_volume =
      *std::max_element(body.particles.volumes.begin(), body.particles.volumes.end());
  return body;
}

}  // namespace perilink
