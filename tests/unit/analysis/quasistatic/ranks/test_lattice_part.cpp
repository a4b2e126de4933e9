#include "analysis/quasistatic/ranks/lattice_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/process/serve.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"
#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

using namespace test;

struct PartCase {
  std::string name;
  LatticeCase lattice;
  bool driven;
  Vector3 size;  // in spacings
  bool micropolar = false;
  std::vector<Crack> cracks = {};
};

std::ostream& operator<<(std::ostream& out, const PartCase& own) { return out << own.name; }

LatticeInput bar_input(const PartCase& own) {
  LatticeInput input = body_input(own.lattice, 4);
  for (int a = 0; a < 3; ++a) input.solid[0].upper[a] = own.size[a] * input.spacing;
  input.horizon = 2.0 * input.spacing;
  return input;
}

/// Held at one end, pulled at or driven from the other, with a few springs.
AnalysisBody held_bar(const PartCase& own, Network network) {
  AnalysisBody body = free_body(std::move(network));
  const Particles& particles = body.network.particles;
  const double end = own.size[0] * 0.2;
  const auto is_at = [&](Index i, double x) {
    return std::abs(particles.position(i)[0] - x) < 1e-9;
  };
  body.network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
  for (Index i = 0; i < particles.size(); ++i) {
    if (i % 7 == 0) body.network.support_stiffness[slot(body, i, 1)] = 0.5;
    if (!is_at(i, end)) continue;
    const std::size_t at = slot(body, i, 0);
    (own.driven ? body.unknowns.prescribed : body.loads.forces)[at] = 1.0;
    body.loads.forces[at + 1] = 0.2;
  }
  number(body, [&](Index i, int axis) {
    return is_at(i, 0.0) || (own.driven && axis == 0 && is_at(i, end));
  });
  return body;
}

/// The same body as it is alone, and of particles and a pattern for ranks.
struct TwoBodies {
  AnalysisBody whole, places;
};

TwoBodies make_two_bodies(const PartCase& own) {
  const LatticeInput input = bar_input(own);
  NetworkInput constants = network_input(input);
  if (own.micropolar) {
    constants.model = BondModel::micropolar;
    constants.materials[0].poissons_ratio = 0.1;
  }
  const NetworkInput uncracked = constants;
  constants.cracks = own.cracks;
  const Body body = make_body(input);
  Network particles;
  particles.particles = body.particles;
  particles.all_turn = own.micropolar;
  TwoBodies bodies{held_bar(own, build_network(body, constants)),
                   held_bar(own, std::move(particles))};
  LatticePattern& pattern =
      bodies.places.pattern.emplace(pattern_of(*grid_of(body), constants.horizon));
  pattern.sample = build_network(body_of(pattern.small, body.lattice, input.thickness), uncracked);
  std::vector<Index> by_crack;
  EXPECT_TRUE(cut_bonds(pattern, own.cracks, by_crack));
  return bodies;
}

class LatticeParts : public testing::TestWithParam<std::tuple<PartCase, int>> {};

/// Both searches end at 1e-12 in the norm of energy; stiffnesses are the same to 1e-12 or so.
TEST_P(LatticeParts, HaveTheAnswerOfTheWholeBody) {
  const auto& [own, count] = GetParam();
  const TwoBodies bodies = make_two_bodies(own);
  ElasticOptions options;
  options.solver = LinearSolver::iterative;
  options.subdomains = {.tolerance = 1e-12, .edge = 3};
  const ElasticResult alone = run_elastic_analysis(bodies.whole, options);
  with_thread_ranks(
      count,
      [&](Ranks& ranks) {
        options.subdomains.ranks = &ranks;
        const ElasticResult shared = run_elastic_analysis(bodies.places, options);
        dismiss(ranks);
        ASSERT_TRUE(shared.team);
        EXPECT_EQ(shared.factor.ranks, count);
        EXPECT_GE(shared.subdomains, count);
        EXPECT_LT(difference_of(alone.displacement, shared.displacement), 1e-10);
        EXPECT_LT(difference_of(alone.forces, shared.forces), 1e-10);
        EXPECT_NEAR(shared.strain_energy, alone.strain_energy, 1e-11 * alone.strain_energy);
        EXPECT_NEAR(shared.work, alone.work, 1e-10 * alone.work);
        EXPECT_LT(shared.residual, 1e-9);
      },
      serve);
}

const LatticeCase calibrated{"cubic", Pattern::cubic, Surface::calibrated};
const LatticeCase face_centred{"face_centred", Pattern::face_centred, Surface::none};
const LatticeCase square{"square", Pattern::rectangular, Surface::energy};
const Crack across{{{1.7, -1, -1}, {1.9, -1, 2}, {1.9, 0.35, 2}, {1.7, 0.35, -1}}};
const Crack along{{{-1, 0.93, 0}, {3.21, 0.93, 0}}};

INSTANTIATE_TEST_SUITE_P(
    Bodies, LatticeParts,
    testing::Combine(testing::Values(PartCase{"Pulled", calibrated, false, {18, 4, 5}},
                                     PartCase{"Driven", calibrated, true, {4, 3, 17}},
                                     PartCase{"FaceCentred", face_centred, true, {12, 3, 4}},
                                     PartCase{"Plane", square, false, {30, 9, 0}},
                                     PartCase{
                                         "Notched", calibrated, false, {18, 4, 5}, false, {across}},
                                     PartCase{"Cracked", square, true, {30, 9, 0}, true, {along}},
                                     PartCase{"Frames", calibrated, false, {16, 4, 5}, true}),
                     testing::Values(2, 3, 4)),
    [](const auto& instance) {
      return std::get<0>(instance.param).name + "By" + std::to_string(std::get<1>(instance.param));
    });

TEST(LatticePart, KeepsItsBondsAndThoseAcrossItsFaces) {
  const PartCase own{"", {"cubic", Pattern::cubic, Surface::none}, false, {5, 3, 3}};
  const TwoBodies bodies = make_two_bodies(own);
  const std::vector<GridWindow> windows = split_grid(bodies.places.pattern->grid, 2);
  const auto share = [&](int rank) {
    Parcel parcel;
    share_of(*bodies.places.pattern, windows, bodies.places.network, bodies.places.unknowns, 27,
             rank)
        .pack(parcel);
    return PatternShare::unpack(parcel);
  };
  const auto check = [&](Ranks& ranks) {
    const BodyPart part = make_part(ranks, share(ranks.own()));
    EXPECT_EQ(part.owned(), 48);
    EXPECT_EQ(part.network.particles.size(),
              part.owned() + static_cast<Index>(part.ghosts.owners.size()));
    // With a horizon of two spacings two of three layers beyond are known.
    EXPECT_EQ(part.ghosts.owners, std::vector<int>(32, 1 - ranks.own()));
    std::size_t others = 0;
    for (Index e = 0; e < part.network.num_elements(); ++e) {
      const bool is_own = part.network.bonds.first[e] < part.owned();
      EXPECT_TRUE(is_own || part.network.bonds.second[e] < part.owned());
      others += is_own ? 0 : 1;
    }
    EXPECT_EQ(part.others_elements.size(), others);
    double bonds = part.network.num_elements() - static_cast<double>(others);
    ranks.sum({&bonds, 1});
    EXPECT_EQ(bonds, bodies.whole.network.num_elements());
  };
  with_thread_ranks(2, check, check);
}

TEST(LatticePart, OfABodyThatNothingHoldsIsRefusedByAllRanks) {
  TwoBodies bodies = make_two_bodies({"", calibrated, false, {6, 4, 4}});
  bodies.places.network.support_stiffness.clear();
  number(bodies.places, [](Index, int) { return false; });
  with_thread_ranks(
      2,
      [&](Ranks& ranks) {
        ElasticOptions options;
        options.subdomains.ranks = &ranks;
        EXPECT_THROW(run_elastic_analysis(bodies.places, options), SolverError);
        dismiss(ranks);
      },
      serve);
}

}  // namespace
}  // namespace perilink
