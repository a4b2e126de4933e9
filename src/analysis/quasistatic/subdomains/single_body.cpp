#include "analysis/quasistatic/subdomains/single_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lanes.hpp"

namespace perilink {
namespace {

using Row = LongLanes<float, block_width>;

const Row* at(const float* numbers) { return reinterpret_cast<const Row*>(numbers); }
Row* at(float* numbers) { return reinterpret_cast<Row*>(numbers); }

template <int Dim>
constexpr int num_motions = Dim == 2 ? 3 : 6;

/// Number of particles above which threads pay off.
constexpr std::size_t many_particles = 4000;

}  // namespace

SubdomainOrder::SubdomainOrder(const SubdomainMotions& motions, Index particles)
    : place(static_cast<std::size_t>(particles)), subdomain_end{0}, part_subdomain{0} {
  Index next = 0;
  for (Index b = 0; b < motions.num_subdomains(); ++b) {
    for (const Index p : motions.particles(b)) place[p] = next++;
    subdomain_end.push_back(static_cast<std::size_t>(next));
  }
  const std::size_t parts = subdomain_end.back() < many_particles ? 1 : most_parts;
  for (std::size_t k = 1; k <= parts; ++k) {
    const auto subdomain =
        std::ranges::lower_bound(subdomain_end, subdomain_end.back() * k / parts);
    part_subdomain.push_back(static_cast<std::size_t>(subdomain - subdomain_end.begin()));
  }
}

std::vector<std::size_t> SubdomainOrder::part_end() const {
  std::vector<std::size_t> ends;
  for (std::size_t k = 1; k < part_subdomain.size(); ++k)
    ends.push_back(subdomain_end[part_subdomain[k]]);
  return ends;
}

bool SingleBody::is_made_of(const Network& network) {
  return !network.carries_moments() && !network.has_states() && !network.cells;
}

SingleBody::SingleBody(const Network& network, const Unknowns& unknowns,
                       const SubdomainMotions& motions, const SubdomainOrder& order,
                       PackedBonds& bonds, std::span<const double> blocks, const Factor& coarse)
    : network_(network),
      unknowns_(unknowns),
      order_(order),
      bonds_(bonds),
      blocks_(blocks.size()),
      factor_(coarse.in_single(bonds.unit())) {
  const auto dim = static_cast<std::size_t>(network.dim());
  const auto count = static_cast<std::size_t>(motions.num_motions());
  moves_.resize(order_.place.size() * dim * count);
  for (Index p = 0; p < network.particles.size(); ++p) {
    const auto at_place = static_cast<std::size_t>(order_.place[p]);
    for (std::size_t a = 0; a < dim; ++a) {
      const int component = static_cast<int>(a);
      const std::array<double, 6> row = motions.row(p, component);
      std::copy_n(row.begin(), count,
                  moves_.begin() + static_cast<std::ptrdiff_t>((at_place * dim + a) * count));
      if (unknowns.at(p, component) < 0) continue;
      for (std::size_t b = 0; b < dim; ++b) {
        if (unknowns.at(p, static_cast<int>(b)) < 0) continue;
        blocks_[(at_place * dim + a) * dim + b] =
            static_cast<float>(blocks[(p * dim + a) * dim + b] * bonds_.unit());
      }
    }
  }
  coarse_.resize((order_.subdomain_end.size() - 1) * count * block_width);
}

void SingleBody::follow(Secants secants, std::span<const double> ground) {
  bonds_.follow(secants);
  springs_.clear();
  if (ground.empty() && network_.support_stiffness.empty()) return;
  const auto dim = static_cast<std::size_t>(network_.dim());
  springs_.resize(order_.place.size() * dim);
  for (std::size_t slot = 0; slot < springs_.size(); ++slot) {
    const Index unknown = unknowns_.number[slot];
    double spring = 0.0;
    if (!network_.support_stiffness.empty()) spring += network_.support_stiffness[slot];
    if (!ground.empty() && unknown >= 0) spring += ground[unknown];
    springs_[static_cast<std::size_t>(order_.place[slot / dim]) * dim + slot % dim] =
        static_cast<float>(spring / bonds_.unit());
  }
}

void SingleBody::multiply(std::span<const float> motions, std::span<float> forces,
                          const RowsDone& done) const {
  const auto dim = static_cast<std::size_t>(network_.dim());
  bonds_.forces(motions, forces, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * dim; k < end * dim && !springs_.empty(); ++k) {
      if (springs_[k] != 0.0F) at(forces.data())[k] += springs_[k] * at(motions.data())[k];
    }
    done(part, begin * dim, end * dim);
  });
}

template <class Work>
void SingleBody::for_each_part(Work work) const {
  const std::size_t parts = order_.part_subdomain.size() - 1;
#pragma omp parallel for schedule(dynamic) if (parts > 1)
  for (std::size_t part = 0; part < parts; ++part) work(part);
}

template <int Dim>
void SingleBody::restrict_to_subdomains(std::size_t part, const float* residuals) {
  constexpr int count = num_motions<Dim>;
  for (std::size_t b = order_.part_subdomain[part]; b < order_.part_subdomain[part + 1]; ++b) {
    const Row* residual = at(residuals) + order_.subdomain_end[b] * Dim;
    const float* move = moves_.data() + order_.subdomain_end[b] * Dim * count;
    Row sums[count] = {};
    for (const float* end = moves_.data() + order_.subdomain_end[b + 1] * Dim * count; move < end;
         move += count, ++residual) {
      for (int m = 0; m < count; ++m) sums[m] += move[m] * *residual;
    }
    const Index* place = factor_.place.data() + b * count;
    for (int m = 0; m < count; ++m) at(coarse_.data())[place[m]] = sums[m];
  }
}

template <int Dim>
void SingleBody::add_motions(std::size_t part, const float* residuals, float* motions,
                             const RowsDone& done) const {
  constexpr int count = num_motions<Dim>;
  std::size_t place = order_.subdomain_end[order_.part_subdomain[part]];
  const Row* residual = at(residuals) + place * Dim;
  Row* motion = at(motions) + place * Dim;
  const float* move = moves_.data() + place * Dim * count;
  const float* block = blocks_.data() + place * Dim * Dim;
  for (std::size_t b = order_.part_subdomain[part]; b < order_.part_subdomain[part + 1]; ++b) {
    const Index* from = factor_.place.data() + b * count;
    Row values[count];
    for (int m = 0; m < count; ++m) values[m] = at(coarse_.data())[from[m]];
    for (place = order_.subdomain_end[b]; place < order_.subdomain_end[b + 1];
         ++place, residual += Dim) {
      for (int a = 0; a < Dim; ++a, move += count, block += Dim, ++motion) {
        Row sum = block[0] * residual[0];
        for (int c = 1; c < Dim; ++c) sum += block[c] * residual[c];
        for (int m = 0; m < count; ++m) sum += move[m] * values[m];
        *motion = sum;
      }
    }
    done(part, order_.subdomain_end[b] * Dim, place * Dim);
  }
}

void SingleBody::precondition(std::span<const float> residuals, std::span<float> motions,
                              const RowsDone& done) {
  const bool plane = network_.dim() == 2;
  const float* r = residuals.data();
  for_each_part([&](std::size_t part) {
    plane ? restrict_to_subdomains<2>(part, r) : restrict_to_subdomains<3>(part, r);
  });
  factor_.solve(coarse_);
  for_each_part([&](std::size_t part) {
    plane ? add_motions<2>(part, r, motions.data(), done)
          : add_motions<3>(part, r, motions.data(), done);
  });
}

}  // namespace perilink
