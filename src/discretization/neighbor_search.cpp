#include "discretization/neighbor_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace perilink {
namespace {

/// Adapter of the points for nanoflann.
struct PointCloud {
  std::span<const double> positions;
  std::size_t dim;

  std::size_t kdtree_get_point_count() const { return positions.size() / dim; }
  double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return positions[point * dim + axis];
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

/// Collects points with numbers above `lowest` and squared distances below `limit`.
class RowCollector {
 public:
  using DistanceType = double;  // names required by nanoflann
  using IndexType = Index;

  RowCollector(std::vector<Index>& found, Index lowest, double limit)
      : found_(found), lowest_(lowest), limit_(limit) {}

  std::size_t size() const { return found_.size(); }
  bool full() const { return true; }
  double worstDist() const { return limit_; }
  bool addPoint(double /*squared_distance*/, Index point) {
    if (point > lowest_) found_.push_back(point);
    return true;
  }

 private:
  std::vector<Index>& found_;
  Index lowest_;
  double limit_;
};

template <int Dim>
using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, PointCloud, double, Index>, PointCloud, Dim, Index>;
const nanoflann::KDTreeSingleIndexAdaptorParams tree_parameters(16);

/// Returns the points within radius_of(q) of every query q in row q. With `upper_only`, only points
/// above q.
template <int Dim, class Radius>
Csr search(std::span<const double> points, std::span<const double> queries, const Radius& radius_of,
           bool upper_only) {
  const auto num_queries = static_cast<Index>(queries.size() / Dim);
  Csr result;
  result.offsets.assign(static_cast<std::size_t>(num_queries) + 1, 0);
  if (points.empty() || num_queries == 0) return result;

  const PointCloud particle_set{points, Dim};
  Tree<Dim> tree(Dim, particle_set, tree_parameters);

  // Chunks are searched in parallel and joined in order, so the result is independent of threads.
  constexpr Index chunk_size = 4096;
  const Index num_chunks = (num_queries + chunk_size - 1) / chunk_size;
  std::vector<std::vector<Index>> chunks(static_cast<std::size_t>(num_chunks));
#pragma omp parallel for schedule(dynamic)
  for (Index chunk = 0; chunk < num_chunks; ++chunk) {
    std::vector<Index> row;
    const Index end = std::min(num_queries, (chunk + 1) * chunk_size);
    for (Index query = chunk * chunk_size; query < end; ++query) {
      row.clear();
      // nanoflann compares squared distances with "<", but points at the radius belong to the row.
      const double radius = radius_of(query);
      const double limit = std::nextafter(radius * radius, std::numeric_limits<double>::infinity());
      RowCollector collector(row, upper_only ? query : no_index, limit);
      tree.findNeighbors(collector, queries.data() + static_cast<std::size_t>(query) * Dim,
                         nanoflann::SearchParams(0, 0.0F, false));
      std::sort(row.begin(), row.end());
      result.offsets[query + 1] = static_cast<Index>(row.size());
      chunks[chunk].insert(chunks[chunk].end(), row.begin(), row.end());
    }
  }

  std::size_t total = 0;
  for (const auto& chunk : chunks) total += chunk.size();
  if (total > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
    throw std::length_error("more than 2^31 - 1 neighbours: choose a smaller horizon");
  }
  for (Index query = 0; query < num_queries; ++query) {
    result.offsets[query + 1] += result.offsets[query];
  }
  result.values.reserve(total);
  for (auto& chunk : chunks) {
    result.values.insert(result.values.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
  return result;
}

[[noreturn]] void refuse_dimension(int dim) {
  throw std::invalid_argument("neighbour search in " + std::to_string(dim) +
                              " dimensions: only 2 and 3 are possible");
}

template <class Radius>
Csr search(std::span<const double> points, std::span<const double> queries, int dim,
           const Radius& radius_of, bool upper_only) {
  if (dim == 2) return search<2>(points, queries, radius_of, upper_only);
  if (dim == 3) return search<3>(points, queries, radius_of, upper_only);
  refuse_dimension(dim);
}

template <int Dim>
std::vector<double> nearest(std::span<const double> positions, int count) {
  const std::size_t size = positions.size() / Dim;
  std::vector<double> distances(size, std::numeric_limits<double>::infinity());
  if (size <= static_cast<std::size_t>(count)) return distances;
  const PointCloud particle_set{positions, Dim};
  Tree<Dim> tree(Dim, particle_set, tree_parameters);
#pragma omp parallel
  {
    const std::size_t wanted = static_cast<std::size_t>(count) + 1;  // including the point itself
    std::vector<Index> found(wanted);
    std::vector<double> squares(wanted);
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < size; ++i) {
      tree.knnSearch(positions.data() + i * Dim, wanted, found.data(), squares.data());
      distances[i] = std::sqrt(squares.back());
    }
  }
  return distances;
}

}  // namespace

Csr find_upper_neighbors(std::span<const double> positions, int dim, double radius) {
  return search(
      positions, positions, dim, [=](Index) { return radius; }, true);
}

Csr find_neighbors(std::span<const double> points, std::span<const double> queries, int dim,
                   double radius) {
  return search(
      points, queries, dim, [=](Index) { return radius; }, false);
}

Csr find_neighbors_within(std::span<const double> points, std::span<const double> queries, int dim,
                          std::span<const double> radii) {
  return search(
      points, queries, dim, [=](Index query) { return radii[query]; }, false);
}

std::vector<double> distances_of_nearest(std::span<const double> positions, int dim, int count) {
  if (dim == 2) return nearest<2>(positions, count);
  if (dim == 3) return nearest<3>(positions, count);
  refuse_dimension(dim);
}

namespace {

/// Points with the tree that finds the nearest of them.
template <int Dim>
struct PointTree {
  explicit PointTree(std::vector<double> of_points) : positions(std::move(of_points)) {}

  std::vector<double> positions;
  PointCloud points{positions, Dim};
  Tree<Dim> tree{Dim, points, tree_parameters};
};

template <int Dim>
auto search_in(std::vector<double> positions) {
  const auto points = std::make_shared<const PointTree<Dim>>(std::move(positions));
  return [points](std::span<const double> place) {
    Index found = no_index;
    double square = 0.0;
    points->tree.knnSearch(place.data(), 1, &found, &square);
    return found;
  };
}

}  // namespace

NearestPoint::NearestPoint(std::vector<double> positions, int dim) {
  if (dim == 2) {
    search_ = search_in<2>(std::move(positions));
  } else if (dim == 3) {
    search_ = search_in<3>(std::move(positions));
  } else {
    refuse_dimension(dim);
  }
}

}  // namespace perilink
