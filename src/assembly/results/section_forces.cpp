#include "assembly/results/section_forces.hpp"

#include "network/frame.hpp"

namespace perilink {

SectionForces section_forces(const Network& beam, Secants secants, std::span<const double> motion) {
  const auto count = static_cast<std::size_t>(beam.particles.size());
  SectionForces sums{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0),
                     std::vector<double>(count, 0.0)};
  for (Index e = 0; e < beam.num_elements(); ++e) {
    const Index first = beam.bonds.first[e], last = beam.bonds.second[e];
    const FrameModes<2> modes = frame_modes<2>(beam, e);
    const auto force = [&](int mode) {
      const double left = mode == 0 ? secants.axial(e) : secants[e];
      return left * modes.stiffness[mode] *
             modes.deformation(mode, motion.data() + std::size_t{3} * first,
                               motion.data() + std::size_t{3} * last);
    };
    const double normal = force(0), shear = -force(1), moment = force(2);
    const double middle =
        0.5 * (beam.particles.position(first)[0] + beam.particles.position(last)[0]);
    for (Index i = first; i <= last; ++i) {
      // Inner particles have the bond on both sides. An end particle has it on one, with half
      // weight unless the beam ends there.
      const bool at_end = i == first || i == last;
      const bool outermost = i == 0 || i == beam.particles.size() - 1;
      const double part = at_end && !outermost ? 0.5 : 1.0;
      sums.normal[i] += part * normal;
      sums.shear[i] += part * shear;
      sums.moment[i] += part * (moment + shear * (beam.particles.position(i)[0] - middle));
    }
  }
  return sums;
}

}  // namespace perilink
