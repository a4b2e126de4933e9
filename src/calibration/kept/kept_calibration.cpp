#include "calibration/kept/kept_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

namespace perilink {
namespace {

/// Digest of 128 bits by FNV-1a over words of eight bytes, with the upper half folded into the
/// lower one.
class Digest {
 public:
  template <class Value>
  void add(const Value& value) {
    add(std::span(&value, 1));
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(values.size());
    add(std::span(values));
  }
  template <class Value, std::size_t N>
  void add(const std::array<Value, N>& values) {
    add(std::span(values));
  }
  std::string text() const {
    return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(state_ >> 64),
                       static_cast<std::uint64_t>(state_));
  }

 private:
  __extension__ using Wide = unsigned __int128;

  template <class Value, std::size_t N>
  void add(std::span<Value, N> values) {
    static_assert(std::is_arithmetic_v<std::remove_const_t<Value>> || std::is_enum_v<Value>,
                  "no padding");
    constexpr Wide prime = (Wide{1} << 88) + 0x13b;
    const char* next = reinterpret_cast<const char*>(values.data());
    for (std::size_t left = values.size_bytes(); left > 0;) {
      std::uint64_t word = 0;
      const std::size_t taken = std::min(left, sizeof word);
      std::memcpy(&word, next, taken);
      next += taken;
      left -= taken;
      state_ = (state_ ^ word) * prime;
      state_ ^= state_ >> 64;
    }
  }

  Wide state_ = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
};

/// Returns a digest of everything that a calibration depends on.
std::string key_of(const CalibrationInput& input, const CalibrationOptions& options,
                   const Facets& facets, const BondStiffness& stiffness) {
  Digest digest;
  const auto add = [&](const auto&... values) { (digest.add(values), ...); };
  const Particles& particles = input.particles;
  add(particles.dim, particles.positions, particles.volumes, particles.material, particles.kind);
  const Bonds& bonds = input.bonds;
  add(bonds.first, bonds.second, bonds.lengths, bonds.directions, bonds.kind);
  for (const LameConstants& material : input.materials) add(material.lambda, material.mu);
  add(input.materials.size(), input.free, input.only_alike, input.give_up);
  add(input.box.has_value(), input.step.has_value());
  if (input.box) add(input.box->lower, input.box->step, input.box->count);
  if (input.step) add(*input.step);
  add(options.least_weight, options.tolerance);
  add(facets.corners.offsets, facets.corners.values, facets.shares, facets.area_vectors,
      facets.inside, facets.outside, facets.tied);
  add(stiffness.axial, stiffness.bending, stiffness.inflection);
  return digest.text();
}

}  // namespace

CalibrationReport calibrate_once(CalibrationStore* store, const CalibrationInput& input,
                                 const CalibrationOptions& options, Facets& facets,
                                 BondStiffness& stiffness) {
  if (store == nullptr) return calibrate_bonds(input, options, facets, stiffness);
  const std::string key = key_of(input, options, facets, stiffness);
  if (std::optional<KeptCalibration> kept = store->find(key)) {
    facets.shares = std::move(kept->shares);
    stiffness = std::move(kept->stiffness);
    return kept->report;
  }
  const CalibrationReport report = calibrate_bonds(input, options, facets, stiffness);
  store->keep(key, {report, facets.shares, stiffness});
  return report;
}

}  // namespace perilink
