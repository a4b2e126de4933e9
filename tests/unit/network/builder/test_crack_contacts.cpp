#include "network/builder/crack_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "discretization/lattices/make_body.hpp"
#include "network/builder/network_builder.hpp"
#include "network/unknowns.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

using Tensor = std::array<std::array<double, 3>, 3>;

/// Body cut in two by a plane through its middle.
struct CutBody {
  std::string name;
  LatticeCase lattice;
  double angle;  ///< of the crack to the first axis, in the plane of the first two [rad]
  bool micropolar = false;

  int dim() const { return is_plane(lattice.pattern) ? 2 : 3; }
  Vector3 normal() const { return {-std::sin(angle), std::cos(angle), 0.0}; }
  Network build() const {
    LatticeInput body = body_input(lattice, dim() == 2 ? 20 : 9);
    body.horizon = 3.0 * body.spacing;
    NetworkInput input = network_input(body);
    input.materials[0].softening.closes = true;
    if (micropolar) {
      input.model = BondModel::micropolar;
      input.materials[0].poissons_ratio = 0.2;
    }
    const double size = dim() == 2 ? 4.0 : 1.8, far = 2.0 * size;
    const Vector3 middle = {0.5 * size + 0.01, 0.5 * size + 0.09, 0.5 * size};
    const auto at = [&](double along, double z) {
      return Vector3{middle[0] + along * std::cos(angle), middle[1] + along * std::sin(angle), z};
    };
    input.cracks.emplace_back();
    input.cracks[0].points = {at(-far, 0.0), at(far, 0.0)};
    if (dim() == 3)
      input.cracks[0].points = {at(-far, -far), at(far, -far), at(far, far), at(-far, far)};
    return build_network(make_body(body), input);
  }
};

/// Returns u = A x, with a slip of the part above the crack along it and no rotation.
std::vector<double> motion_of(const CutBody& body, const Network& network, const Tensor& gradient,
                              const Vector3& slip = {}) {
  const Vector3 n = body.normal();
  const double size = body.dim() == 2 ? 4.0 : 1.8;
  const std::size_t dim = body.dim(), width = network.width();
  std::vector<double> motion(width * network.particles.size(), 0.0);
  for (Index i = 0; i < network.first_embedded_point(); ++i) {
    const auto x = network.particles.position(i);
    const double side = n[0] * (x[0] - 0.5 * size - 0.01) + n[1] * (x[1] - 0.5 * size - 0.09);
    for (std::size_t a = 0; a < dim; ++a) {
      for (std::size_t b = 0; b < dim; ++b) motion[i * width + a] += gradient[a][b] * x[b];
      if (side > 0.0) motion[i * width + a] += slip[a];
    }
  }
  follow_particles(network, motion);
  return motion;
}

double extension_of(const Network& network, std::span<const double> motion, Index e) {
  double extension = 0.0;
  for (int a = 0; a < network.dim(); ++a) {
    extension +=
        network.bonds.direction(e)[a] * (motion[network.bonds.second[e] * network.width() + a] -
                                         motion[network.bonds.first[e] * network.width() + a]);
  }
  return extension;
}

void PrintTo(const CutBody& body, std::ostream* out) { *out << body.name; }

class CrackContacts : public ::testing::TestWithParam<CutBody> {};

TEST_P(CrackContacts, ReplaceTheBondsAcrossTheCrack) {
  const Network network = GetParam().build();
  ASSERT_GT(network.num_contacts, 40);
  EXPECT_EQ(network.first_slip_spring, network.num_elements());
  EXPECT_EQ(network.embedded_points.size(), network.num_contacts);
  for (const Index e : network.contacts()) {
    EXPECT_TRUE(network.is_embedded_point(network.bonds.second[e]));
    EXPECT_TRUE(network.law(e).closes());
    EXPECT_FALSE(network.has_limit(e));
    EXPECT_GT(network.stiffness[e], 0.0);
    EXPECT_GT(network.bonds.length(e), 0.0);
  }
  EXPECT_FALSE(network.law(0).closes() && network.is_contact(0));
}

/// A uniform strain shortens a spring by what gives the stress along the normal: the strain there
/// and lambda / (lambda + 2 mu) times the strain along the crack.
TEST_P(CrackContacts, SeeTheStressAlongTheNormal) {
  const CutBody& body = GetParam();
  const Network network = body.build();
  const Tensor gradient = {{{0.3, -0.7, 0.2}, {0.1, 0.4, -0.5}, {0.6, 0.15, -0.25}}};
  const std::vector<double> motion = motion_of(body, network, gradient);
  const Vector3 n = body.normal();
  double along = 0.0, trace = 0.0;
  for (int a = 0; a < body.dim(); ++a) {
    trace += gradient[a][a];
    for (int b = 0; b < body.dim(); ++b) along += n[a] * gradient[a][b] * n[b];
  }
  const double nu = body.micropolar ? 0.2 : body.dim() == 2 ? 1.0 / 3.0 : 0.25;
  const double ratio = body.dim() == 2 ? nu : nu / (1.0 - nu);
  for (const Index e : network.contacts()) {
    const double expected = network.bonds.length(e) * (along + ratio * (trace - along));
    EXPECT_NEAR(extension_of(network, motion, e), expected, 1e-12) << e;
  }
}

TEST_P(CrackContacts, ResistNeitherSlipNorRotation) {
  const CutBody& body = GetParam();
  const Network network = body.build();
  const Vector3 n = body.normal();
  const Vector3 slip = {n[1], -n[0], body.dim() == 3 ? 0.5 : 0.0};
  const std::vector<double> slipped = motion_of(body, network, {}, slip);
  const std::vector<double> turned =
      motion_of(body, network, {{{0.0, -0.7, 0.2}, {0.7, 0.0, -0.5}, {-0.2, 0.5, 0.0}}});
  for (const Index e : network.contacts()) {
    EXPECT_NEAR(extension_of(network, slipped, e), 0.0, 1e-13) << e;
    EXPECT_NEAR(extension_of(network, turned, e), 0.0, 1e-13) << e;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, CrackContacts,
                         ::testing::Values(CutBody{"rectangular", rectangular, 0.0},
                                           CutBody{"rectangular_oblique", rectangular, 0.6},
                                           CutBody{"hexagonal", hexagonal, 0.0},
                                           CutBody{"cubic", cubic, 0.0},
                                           CutBody{"cubic_oblique", cubic, 0.5},
                                           CutBody{"micropolar", rectangular, 0.3, true}),
                         [](const auto& body) { return body.param.name; });

}  // namespace
}  // namespace perilink
