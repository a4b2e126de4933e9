#include "strip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "bodies.hpp"
#include "discretization/lattices/make_body.hpp"
#include "material/critical_stretch.hpp"
#include "network/lattice_neighbourhoods.hpp"

namespace perilink::verification {
namespace {

/// Whole coordinates of a lattice point, in half steps.
using Point = std::array<int, 3>;

/// The family of a particle inside, spacing 1.
struct Interior {
  Problem problem = Problem::plane_stress;
  Lattice lattice;
  double horizon = 0.0;
  std::vector<Vector3> offsets;
  NeighbourhoodStiffness stiffness;
};

Interior interior_of(const Strip& strip) {
  const bool space = strip.pattern == Pattern::cubic || strip.pattern == Pattern::face_centred;
  LatticeInput lattice;
  lattice.pattern = strip.pattern;
  lattice.surface = Surface::calibrated;
  lattice.spacing = 1.0;
  const double row = strip.pattern == Pattern::hexagonal ? std::sqrt(0.75) : 1.0;
  const double size = strip.pattern == Pattern::face_centred ? 4.0 * std::sqrt(2.0) : 4.0;
  lattice.solid = {{{0.0, 0.0, 0.0}, {size, size * row, space ? size : 0.0}}};
  lattice.material = {0};
  Body body = make_body(lattice);
  for (int a = 0; a < 2; ++a) {
    body.lattice.step[a] *= strip.stretch[a];
    body.lattice.cell_volume *= strip.stretch[a];
  }
  NetworkInput input;
  input.problem = space ? Problem::three_dimensional : Problem::plane_stress;
  input.horizon = strip.horizon_ratio;
  const double r = strip.lame_ratio;
  input.materials = {{1.0, 1.0, space ? 0.5 * r / (1.0 + r) : r / (2.0 + r)}};
  if (r < 1.0) input.model = BondModel::micropolar;
  const LatticeNeighbourhoods neighbourhoods(body, input);
  Interior inside{input.problem, body.lattice, input.horizon, {}, neighbourhoods.stiffness(0)};
  inside.offsets.assign(neighbourhoods.offsets().begin(), neighbourhoods.offsets().end());
  for (std::size_t k = 0; k < inside.offsets.size() && !strip.calibrated; ++k) {
    const Vector3& x = inside.offsets[k];
    inside.stiffness.axial[k] = 1.0 / std::hypot(x[0], x[1], x[2]);
  }
  return inside;
}

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

class StripBuilder {
 public:
  StripBuilder(const Strip& strip, const Interior& inside) : strip_(strip), inside_(inside) {
    const Vector3 period = vector({strip.growth[0], strip.growth[1], 0});
    period_ = std::hypot(period[0], period[1]);
    along_ = {period[0] / period_, period[1] / period_, 0.0};
    normal_ = {-along_[1], along_[0], 0.0};
    front_ = strip.front * (strip.pattern == Pattern::face_centred ? 4 : 2);
    double row = infinity;
    for (const Vector3& x : inside.offsets) {
      const double across = dot(normal_, x);
      if (across > 1e-6) row = std::min(row, across);
    }
    const double half = strip.half_height * inside.horizon;
    beside_ = static_cast<int>(std::ceil(strip.beside * half / period_));
    find_points(0.5 * row, half);
    find_bonds();
  }

  double area_of_period() const {
    return period_ * (inside_.lattice.dim == 3 ? 0.5 * front_ * inside_.lattice.step[2] : 1.0);
  }

  /// Cut from the left end over so many periods of growth.
  LoadedNetwork cut(int periods) const {
    const double tip = (beside_ + periods) * period_ - 1e-6;
    Network network = whole_;
    network.first_slip_spring = network.first_bar_element = network.bonds.size();
    for (std::size_t b = 0; b < crossing_.size(); ++b) {
      if (!(crossing_[b] < tip)) continue;
      network.stiffness[b] = 0.0;
      if (network.carries_moments()) network.bending[b] = 0.0;
      network.critical_stretch[b] = infinity;
    }
    return {std::move(network), unknowns, loads, {true, 1.0}};
  }

  Unknowns unknowns;
  Loads loads;

 private:
  struct Place {
    Vector3 local;  ///< along the crack, above it, along its front
    Point point;
    bool operator<(const Place& other) const { return local < other.local; }
  };

  Vector3 vector(const Point& point) const {
    Vector3 x{};
    for (int a = 0; a < inside_.lattice.dim; ++a) {
      x[a] = 0.5 * point[a] * inside_.lattice.step[a];
    }
    return x;
  }
  bool on_lattice(const Point& p) const {
    if (p[1] % 2 != 0 || p[2] % 2 != 0) return false;
    if (strip_.pattern == Pattern::hexagonal) return (p[0] - p[1] / 2) % 2 == 0;
    if (p[0] % 2 != 0) return false;
    return strip_.pattern != Pattern::face_centred || (p[0] + p[1] + p[2]) / 2 % 2 == 0;
  }
  int periods() const { return 2 * beside_ + strip_.skipped + strip_.counted; }
  void find_points(double above, double half);
  void find_bonds();

  const Strip& strip_;
  const Interior& inside_;
  double period_ = 0.0;
  int beside_ = 0, front_ = 2;
  Vector3 along_{}, normal_{};
  std::vector<Place> places_;
  Network whole_;
  std::vector<double> crossing_;  ///< where each bond crosses the plane, infinity: nowhere
};

void StripBuilder::find_points(double above, double half) {
  const double outer = half + inside_.horizon, length = periods() * period_;
  Point reach{};
  for (int a = 0; a < 2; ++a) {
    reach[a] = static_cast<int>(2.0 * (length + outer) / inside_.lattice.step[a]) + 2;
  }
  const int depth = inside_.lattice.dim == 3 ? front_ : 1;
  for (int x = -reach[0]; x <= reach[0]; ++x) {
    for (int y = -reach[1]; y <= reach[1]; ++y) {
      for (int z = 0; z < depth; ++z) {
        if (!on_lattice({x, y, z})) continue;
        const Vector3 p = vector({x, y, z});
        const Vector3 local = {dot(along_, p), dot(normal_, p) - above, p[2]};
        if (local[0] < -1e-6 || local[0] > length - 1e-6 || std::abs(local[1]) > outer) continue;
        places_.push_back({local, {x, y, z}});
      }
    }
  }
  std::sort(places_.begin(), places_.end());
  const bool frames = !inside_.stiffness.bending.empty();
  const int dim = inside_.lattice.dim, width = !frames ? dim : dim == 2 ? 3 : 6;
  std::vector<std::uint8_t> held;
  std::vector<double> prescribed;
  Particles& particles = whole_.particles;
  particles.dim = whole_.bonds.dim = dim;
  for (const Place& place : places_) {
    const Vector3 x = vector(place.point);
    particles.positions.insert(particles.positions.end(), x.begin(), x.begin() + dim);
    particles.volumes.push_back(inside_.lattice.cell_volume);
    particles.material.push_back(0);
    particles.kind.push_back(ParticleKind::solid);
    const bool clamped = std::abs(place.local[1]) > half;
    for (int a = 0; a < width; ++a) {
      held.push_back(clamped);
      const double opening = place.local[1] > 0.0 ? 1.0 : -1.0;
      prescribed.push_back(clamped && a < dim ? opening * normal_[a] : 0.0);
    }
  }
  unknowns = number_unknowns(width, held, std::move(prescribed));
  loads.forces.assign(held.size(), 0.0);
}

void StripBuilder::find_bonds() {
  std::map<Point, Index> number;
  for (const Place& place : places_) {
    const auto next = static_cast<Index>(number.size());
    number[place.point] = next;
  }
  // The ends of the strip and what is beside its middle are not to break.
  const double reach = 2.0 * inside_.horizon, end = periods() * period_ - inside_.horizon;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vector3& from = places_[i].local;
    for (std::size_t k = 0; k < inside_.offsets.size(); ++k) {
      const Vector3& x = inside_.offsets[k];
      const Vector3 step = {dot(along_, x), dot(normal_, x), x[2]};
      Point shift{}, to = places_[i].point;
      for (int a = 0; a < inside_.lattice.dim; ++a) {
        shift[a] = static_cast<int>(std::lround(2.0 * x[a] / inside_.lattice.step[a]));
        to[a] += shift[a];
      }
      if (shift < Point{}) continue;  // each pair once
      if (inside_.lattice.dim == 3) to[2] = (to[2] % front_ + front_) % front_;
      const auto found = number.find(to);
      if (found == number.end() || found->second == static_cast<Index>(i)) continue;
      const double length = std::hypot(x[0], x[1], x[2]);
      whole_.bonds.first.push_back(static_cast<Index>(i));
      whole_.bonds.second.push_back(found->second);
      whole_.bonds.lengths.push_back(length);
      for (int a = 0; a < inside_.lattice.dim; ++a) {
        whole_.bonds.directions.push_back(x[a] / length);
      }
      whole_.stiffness.push_back(inside_.stiffness.axial[k]);
      if (!inside_.stiffness.bending.empty()) {
        whole_.bending.push_back(inside_.stiffness.bending[k]);
      }
      const bool breaks = std::abs(from[1]) < reach && from[0] + step[0] < end;
      whole_.critical_stretch.push_back(breaks ? 1.0 : infinity);
      const bool crosses = from[1] * (from[1] + step[1]) < 0.0;
      crossing_.push_back(crosses ? from[0] - from[1] / step[1] * step[0] : infinity);
    }
  }
}

}  // namespace

StripCost measure_crack_cost(const Strip& strip) {
  const Interior inside = interior_of(strip);
  const StripBuilder builder(strip, inside);
  const auto stiffness_at = [&](int periods) {
    const LoadedNetwork cut = builder.cut(periods);
    return stiffness_of(*make_event_engine(cut, EquilibriumOptions{}));
  };
  const double begin = stiffness_at(strip.skipped);
  const double end = stiffness_at(strip.skipped + strip.counted);
  const LoadedNetwork whole = builder.cut(0);
  const PathEnergy energy =
      energy_between(*make_event_engine(whole, EquilibriumOptions{}), begin, end);
  // Critical stretches are one: a plane crack would hold half of the fracture sum per area.
  const double sum = fracture_sum_of_neighbourhood(
      inside.problem, inside.offsets, inside.stiffness.axial, inside.lattice.cell_volume);
  const double unit = 0.5 * sum * strip.counted * builder.area_of_period();
  return {energy.dissipated / unit, energy.released / unit, energy.events, builder.unknowns.count};
}

double lame_ratio_of(double poissons_ratio) {
  return 2.0 * poissons_ratio / (1.0 - poissons_ratio);
}

}  // namespace perilink::verification
