#include "app/model/body/carrier_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/model/from_case/configure.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// A plate of 16 by 8 with particles one apart; its elements are four by four.
Model plate(const std::string& more, const std::string& keys = "",
            const std::string& size = "spacings = 4\n") {
  const std::string text = R"([body]
spacing = 1.0
horizon_ratio = 3
[[regions]]
name = "plate"
x = [0, 16]
y = [0, 8]
[[regions]]
name = "left"
x = [0, 0]
y = [0, 8]
[[regions]]
name = "corner"
x = [13, 16]
y = [0, 2]
[[materials]]
region = "plate"
youngs_modulus = 10.0
fracture_energy = 0.1
[[supports]]
region = "left"
fix = ["x", "y"]
[[point_loads]]
at = [16, 8]
force = [1, 0]
)";
  return build_model(parse_case(text + more + "[elements]\n" + size + keys, "plate.toml"));
}

Index whole(const Model& model) {
  return static_cast<Index>(
      std::count(model.carried->whole.begin(), model.carried->whole.end(), 1));
}

TEST(CarrierModel, WholeEdgesThatAreHeldStayInElements) {
  const Model model = plate("");
  EXPECT_EQ(whole(model), 8);
  // Quadratic elements: a grid of 9 by 5 nodes, the left column held.
  EXPECT_EQ(model.unknowns.count, 2 * (9 * 5 - 5));
  EXPECT_EQ(model.carried->free.count, 2 * (17 * 9 - 9));
  EXPECT_EQ(model.carried->halo, model.horizon);
}

TEST(CarrierModel, RegionsOfParticlesHaveNoElements) {
  EXPECT_EQ(whole(plate("", "particles = [\"corner\"]\n")), 7);
  EXPECT_THROW(plate("", "regions = [\"corner\", \"left\"]\n"), InputError) << "none is whole";
}

TEST(CarrierModel, PreCracksHaveFreeParticlesAroundThem) {
  // From the lower edge up the middle of the second column of elements, one and a half high.
  const Model model = plate("[[cracks]]\npoints = [[6.5, -1], [6.5, 5.5]]\n");
  EXPECT_EQ(whole(model), 6);
}

TEST(CarrierModel, ShortPreCracksAndThoseBesideAPlaneCountToo) {
  EXPECT_EQ(whole(plate("[[cracks]]\npoints = [[6.5, -1], [6.5, 0.5]]\n")), 7);
  // Between the rows y = 3 and y = 4: particles on both sides are free.
  EXPECT_EQ(whole(plate("[[cracks]]\npoints = [[5.2, 3.5], [6.8, 3.5]]\n")), 6);
}

TEST(CarrierModel, ElementsWithTooFewParticlesDoNotCarry) {
  // A single quadratic element of two by two spacings has a particle for every node.
  const Model model = plate("", "", "size = 2.0\n");
  EXPECT_EQ(model.unknowns.count, model.carried->free.count);
}

}  // namespace
}  // namespace perilink
