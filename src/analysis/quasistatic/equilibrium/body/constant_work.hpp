#pragma once

namespace perilink {

/// Contribution of permanent loads to a product that would grow with the square of the load factor.
/// With u = u_c + lambda u_p the product is `square` lambda^2 + linear lambda + constant.
struct Beside {
  double linear = 0.0, constant = 0.0;
  double at(double load_factor) const { return linear * load_factor + constant; }
  void operator+=(const Beside& other) {
    linear += other.linear;
    constant += other.constant;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(linear, constant);
  }
};

/// Work products at load factor 1 [force length]. Constant loads f_c, d_c cause displacements u_c
/// and reactions R_c at prescribed displacements. Growing loads f_p, d_p cause u_p.
struct ConstantWork {
  double forces = 0.0;            ///< f_c'u_c
  double forces_on_motion = 0.0;  ///< f_c'u_p
  double supports = 0.0;          ///< R_c'd_c
  double growing_forces = 0.0;    ///< f_p'u_c
  double growing_supports = 0.0;  ///< R_c'd_p
  double forces_on_clamps = 0.0;  ///< f_c'd_p: part of the reactions' work that f_c does

  template <class Archive>
  void serialize(Archive& archive) {
    archive(forces, forces_on_motion, supports, growing_forces, growing_supports, forces_on_clamps);
  }
};

/// Returns the contribution of permanent loads to the growth of f'u - R'd. By Betti's theorem the
/// two mixed products add up to 2 (f_p'u_c - R_c'd_p).
inline Beside permanent_growth(const ConstantWork& before, const ConstantWork& after) {
  const auto mixed = [](const ConstantWork& work) {
    return 2.0 * (work.growing_forces - work.growing_supports);
  };
  return {mixed(after) - mixed(before),
          (after.forces - after.supports) - (before.forces - before.supports)};
}

}  // namespace perilink
