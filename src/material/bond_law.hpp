#pragma once

#include <utility>
#include <vector>

/// \file
/// Laws of a bond as a falling series of secant stiffnesses ("teeth"). On tooth k a bond carries
/// the force a_k s per unit of its intact stiffness and stores a_k s^2 / 2, up to the stretch s_k;
/// there its next event comes and the secant falls to a_(k+1). The tooth is the only state, and the
/// caller owns it.
///
/// A law may have teeth of its own in compression. A bond is on one branch or the other, the one of
/// its first event: teeth below zero are those in compression, -k the k-th.
///
/// Stretches of a law are given over the bond's own critical stretch, so that bonds of one law may
/// differ in strength.

namespace perilink {

/// One secant of a law.
struct Segment {
  double secant;  ///< stiffness as a fraction of the intact one [-]
  double limit;   ///< stretch of the next event over the critical one; infinity: there is none
};

/// Stretches that lead to events.
enum class Sense {
  tension,  ///< elongation
  both,     ///< elongation and shortening alike
  each,     ///< elongation and shortening, by teeth of their own
};

class BondLaw {
 public:
  /// Breaks for good at the critical stretch, in tension (zeroth-order micro-elastic damage,
  /// Gerstle, Sau & Silling 2005, Fig. 2 with s0 = s1).
  static BondLaw brittle();

  /// Elastic and perfectly plastic from the critical stretch s_y on, as a saw-tooth about the
  /// plateau: with the ratio r of neighbouring teeth a_k = r^-k and an event at s_k = s_y sqrt(r)
  /// r^k, so the force moves between sqrt(r) and 1/sqrt(r) times the yield force and every tooth
  /// dissipates exactly the energy of the plateau that it stands for. Yields alike in tension and
  /// compression; unloads along the secant. Ripple of about (r - 1) / 2 either side.
  /// \throws std::invalid_argument unless ratio > 1
  static constexpr double usual_ratio = 1.05;
  static BondLaw plateau(double ratio = usual_ratio);

  /// Given teeth, in tension; a bond that has passed the last one is broken.
  /// \param teeth  the first secant is 1; secants fall and limits rise
  /// \throws std::invalid_argument where they do not
  static BondLaw saw_tooth(std::vector<Segment> segments);

  /// Given teeth in tension and compression alike.
  /// \param teeth  as those of saw_tooth()
  /// \param ratio  above one: behind the last tooth the force stays, by ever more teeth of this
  ///               ratio, as that of a plateau does; zero: the element breaks
  /// \throws std::invalid_argument as saw_tooth() and plateau()
  static BondLaw both_ways(std::vector<Segment> segments, double ratio);

  /// The same law of bonds that close: once damaged they resist compression like intact ones. Shear
  /// and bending stay as they are, or the energy would jump.
  BondLaw closing() const;

  /// The same law of bonds with teeth in compression too, which sleep until a bond at one of their
  /// particles has had its first event in tension (docs/theory/softening.md). Their events come by
  /// the axial stretch alone.
  /// \param teeth        the same rules as for saw_tooth()
  /// \param scale        by which their limits count over the critical stretch
  /// \param keeps_shear  only the stiffness against a change of length falls until the bond breaks
  /// \throws std::invalid_argument as saw_tooth(), unless the scale is positive, for endless laws
  ///         and for those that close
  BondLaw crushing(std::vector<Segment> segments, double scale, bool keeps_shear) const;

  /// \param k  below zero: in compression, of a law without teeth there a broken bond's
  Segment segment(int k) const;
  /// The first tooth in compression, of an intact bond.
  Segment first_in_compression() const;
  /// Where a bond on tooth k goes by an event.
  static int after(int k, bool compressed) {
    return k < 0 || (k == 0 && compressed) ? k - 1 : k + 1;
  }
  Sense sense() const { return sense_; }
  /// Whether there is always another tooth: the bond never breaks.
  bool endless() const { return ratio_ > 0.0; }
  /// An endless law that has stretched its last force so many times is a mechanism.
  static constexpr double most_stretched = 100.0;
  bool is_exhausted(double secant) const {
    return endless() && secant < segments_.back().secant / most_stretched;
  }
  /// Whether the first event, in tension, breaks the bond for good.
  bool is_brittle() const {
    return !endless() && segments_.size() == 1 && !closes_ && sense_ == Sense::tension;
  }
  bool closes() const { return closes_; }
  /// Whether it has teeth in compression of its own.
  bool crushes() const { return sense_ == Sense::each; }
  /// Whether shear and bending stay as they are until the bond breaks.
  bool keeps_shear() const { return keeps_shear_; }

  /// Visits all that a law is made of, in one order, as for another process.
  template <class Law, class Visit>
  static void for_each_member(Law& law, Visit visit) {
    visit(law.sense_);
    visit(law.segments_);
    visit(law.ratio_);
    visit(law.closes_);
    visit(law.crushing_);
    visit(law.keeps_shear_);
  }

 private:
  BondLaw(Sense sense, std::vector<Segment> segments, double ratio)
      : sense_(sense), segments_(std::move(segments)), ratio_(ratio) {}

  Sense sense_;
  std::vector<Segment> segments_;  ///< before the bond breaks
  double ratio_;  ///< between neighbouring teeth behind the last one; 0: the bond breaks
  bool closes_ = false;
  std::vector<Segment> crushing_;  ///< in compression, before the bond breaks
  bool keeps_shear_ = false;
};

}  // namespace perilink
