#pragma once

#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"

namespace perilink {

/// Search among micropolar bonds. Extension, shear and bending count by their energy. With the
/// deformations of network/frame.hpp the equivalent stretch of a bond is
///
///   s_eq^2 = 2 U / (k xi^2)        (U with kb/k as below)
///          = s^2 + (kb/k) (g/xi)^2 + (kb/k) (|dtheta_bend|^2 + torsion dtheta_twist^2) / 12,
///
/// where s = e/xi is the axial stretch and kb/k = Network::ratio_of_bending(). A bond breaks when
/// s_eq reaches the critical stretch in tension, s > 0; bars yield either way. A bond with its own
/// kb/k then stores k xi^2 s_c^2 / 2, whatever its direction across a crack. The fracture energy
/// thus needs the axial stiffness only. Calibrated bonds are measured with the ratio before
/// calibration and store this energy on average (docs/theory/micropolar.md, section 5). s_eq is
/// proportional to the load factor, which is therefore 1 / ratio, as for trusses. Bonds without
/// bending stiffness (slip springs, bars) and bonds with their own segments in compression have
/// s_eq = s. These segments are inactive at first; set_limits() activates them.
///
/// Bonds of shells add their bending and twisting stiffness in the same way. Bonds of shells and
/// beams are in tension if one of their faces is stretched.
class FrameLimitSearch final : public BreakSearch {
 public:
  /// \param at_loads  see make_break_search()
  explicit FrameLimitSearch(const Network& network, bool at_loads = false);

  Hit find(std::span<const double> displacement, double tolerance, int threads) override;
  std::vector<Hit> list(std::span<const double> displacement, double least) const override;
  void set_limit(Index element, double limit) override;
  void set_limits(Index element, double tension, double compression) override;

 private:
  struct Bond {
    Index first, second;  ///< offsets of the ends (particle times width)
    double n[3];
    double first_arm, second_arm;  ///< distances from the ends to the inflection [length]
    double bending_share;          ///< Network::ratio_of_bending()
    double rotation_share;         ///< kb xi^2 / (12 k)
    double inverse;                ///< 1 / (xi s)^2 for the limit s; zero without a limit
    double compressed;  ///< 1 / (xi s)^2 for the limit s in compression; zero without a limit
  };
  template <int Dim>
  double section_ratio(Index k, const double* u) const;
  double shell_bond_ratio(Index element, const Bond& bond, const double* u) const;
  double over_limit(const Bond& bond, double stretch, double square) const;
  template <int Dim>
  double squared_ratio(const Bond& bond, const double* u) const;
  double inverse_of(Index element, double limit) const;
  template <int Dim>
  Hit find_in(const double* u, double tolerance, int threads);

  const Network& network_;
  int dim_;
  double torsion_;
  bool at_loads_;
  std::vector<Index> elements_;
  std::vector<Bond> bonds_;
  std::vector<double> block_largest_;
};

}  // namespace perilink
