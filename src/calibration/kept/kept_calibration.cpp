#include "calibration/kept/kept_calibration.hpp"

#include <cstring>
#include <type_traits>
#include <vector>

namespace perilink {
namespace {

template <class Value>
void add(std::string& bytes, const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Adds the number of values, then the values. They must have no padding.
template <class Value>
void add(std::string& bytes, const std::vector<Value>& values) {
  add(bytes, values.size());
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

/// Returns everything that a calibration depends on.
std::string bytes_of(const CalibrationInput& input, const CalibrationOptions& options,
                     const Facets& facets, const BondStiffness& stiffness) {
  std::string bytes;
  const auto add_all = [&](const auto&... values) { (add(bytes, values), ...); };
  const Particles& particles = input.particles;
  add_all(particles.dim, particles.positions, particles.volumes, particles.material,
          particles.kind);
  const Bonds& bonds = input.bonds;
  add_all(bonds.first, bonds.second, bonds.lengths, bonds.directions, bonds.kind);
  add_all(input.materials, input.free, input.only_alike, input.give_up);
  add_all(input.box.has_value(), input.step.has_value());
  if (input.box) add_all(input.box->lower, input.box->step, input.box->count);
  if (input.step) add_all(*input.step);
  add_all(options.least_weight, options.tolerance);
  add_all(facets.corners.offsets, facets.corners.values, facets.shares, facets.area_vectors,
          facets.inside, facets.outside, facets.tied);
  add_all(stiffness.axial, stiffness.bending, stiffness.inflection);
  return bytes;
}

/// Takes values of add() from the front of some bytes.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : next_(bytes.data()) {}

  template <class Value>
  void take(Value& value) {
    copy(&value, sizeof value);
  }
  template <class Value>
  void take(std::vector<Value>& values) {
    std::size_t size = 0;
    take(size);
    values.resize(size);
    copy(values.data(), size * sizeof(Value));
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, next_, size);
    next_ += size;
  }
  const char* next_;
};

}  // namespace

CalibrationReport calibrate_once(CalibrationStore* store, const CalibrationInput& input,
                                 const CalibrationOptions& options, Facets& facets,
                                 BondStiffness& stiffness) {
  if (store == nullptr) return calibrate_bonds(input, options, facets, stiffness);
  const std::string key = bytes_of(input, options, facets, stiffness);
  CalibrationReport report;
  std::string result = store->find(key);
  if (!result.empty()) {
    Reader reader(result);
    reader.take(report);
    reader.take(facets.shares);
    reader.take(stiffness.axial);
    reader.take(stiffness.bending);
    reader.take(stiffness.inflection);
    return report;
  }
  report = calibrate_bonds(input, options, facets, stiffness);
  add(result, report);
  add(result, facets.shares);
  add(result, stiffness.axial);
  add(result, stiffness.bending);
  add(result, stiffness.inflection);
  store->keep(key, result);
  return report;
}

}  // namespace perilink
