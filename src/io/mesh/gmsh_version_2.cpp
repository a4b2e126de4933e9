// Nodes and elements of gmsh's format 2.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>
#include <span>

#include "io/mesh/gmsh_sections.hpp"

namespace perilink {
namespace {

/// Most tags of an element; the first three are physical group, entity and number of partitions.
constexpr int most_tags = 1000;

/// Removes repeated elements. Groups keep the first of each.
void merge_repeated(GmshSections& sections) {
  MeshListing& listing = sections.listing;
  const auto count = static_cast<std::size_t>(listing.num_elements());
  std::vector<std::size_t> begin(1, 0);
  for (const CellShape shape : listing.shapes) {
    begin.push_back(begin.back() + properties_of(shape).corners);
  }
  const auto corners = [&](Index e) {
    return std::span(listing.corners).subspan(begin[e], begin[e + 1] - begin[e]);
  };
  std::vector<Index> order(count), first(count), number(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::ranges::lexicographical_compare(corners(a), corners(b));
  });
  for (std::size_t k = 0; k < count; ++k) {
    const bool again = k > 0 && listing.shapes[order[k]] == listing.shapes[order[k - 1]] &&
                       std::ranges::equal(corners(order[k]), corners(order[k - 1]));
    first[order[k]] = again ? first[order[k - 1]] : order[k];
  }
  MeshListing kept;
  for (std::size_t e = 0; e < count; ++e) {
    number[e] = kept.num_elements();
    if (first[e] != static_cast<Index>(e)) continue;
    kept.shapes.push_back(listing.shapes[e]);
    kept.element_tags.push_back(listing.element_tags[e]);
    const auto own = corners(static_cast<Index>(e));
    kept.corners.insert(kept.corners.end(), own.begin(), own.end());
  }
  listing.shapes = std::move(kept.shapes);
  listing.element_tags = std::move(kept.element_tags);
  listing.corners = std::move(kept.corners);
  for (auto& [key, elements] : sections.elements) {
    for (Index& e : elements) e = number[first[e]];
    std::ranges::sort(elements);
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  }
}

/// Collects elements and their groups.
class ElementReader {
 public:
  ElementReader(GmshCursor& file, GmshSections& sections) : file_(file), sections_(sections) {}

  void read() {
    const auto count = static_cast<Index>(file_.count_line(3, "elements"));
    while (sections_.listing.num_elements() < count) {
      const int number = file_.binary() ? 0 : file_.integer();
      const GmshType type = gmsh_type(file_, file_.integer());
      const int repeats = file_.binary() ? file_.integer() : 1, num_tags = file_.integer();
      if (repeats < 1 || repeats > count - sections_.listing.num_elements()) {
        file_.refuse(fmt::format("has a block of {} elements", repeats), "write the mesh again");
      }
      if (num_tags < 0 || num_tags > most_tags) {
        file_.refuse(fmt::format("has an element with {} tags", num_tags), "write the mesh again");
      }
      for (int k = 0; k < repeats; ++k) {
        add(type, file_.binary() ? file_.integer() : number, num_tags);
      }
    }
    file_.expect_end_of("Elements");
    if (has_shared_entities_) merge_repeated(sections_);
  }

 private:
  void add(const GmshType& type, int number, int num_tags) {
    int physical = 0, entity = 0;
    for (int k = 0; k < num_tags; ++k) {
      const int tag = file_.integer();
      if (k == 0) physical = std::abs(std::max(tag, -INT32_MAX));
      if (k == 1) entity = tag;
      if (k == 2 && tag > 0)
        file_.refuse("is partitioned", "save the mesh before it is partitioned");
    }
    const int dim = properties_of(type.shape).dim;
    if (physical > 0) {
      sections_.elements[{dim, physical}].push_back(sections_.listing.num_elements());
      std::set<int>& groups = groups_of_[{dim, entity}];
      groups.insert(physical);
      has_shared_entities_ = has_shared_entities_ || groups.size() > 1;
    }
    add_gmsh_element(
        type, number, [&] { return std::int64_t{file_.integer()}; }, sections_.listing);
  }

  GmshCursor& file_;
  GmshSections& sections_;
  std::map<GmshKey, std::set<int>> groups_of_;  ///< physical groups, by entity
  bool has_shared_entities_ = false;
};

}  // namespace

void read_nodes_2(GmshCursor& file, GmshSections& sections) {
  for (std::size_t left = file.count_line(4, "nodes"); left > 0; --left) {
    sections.listing.node_tags.push_back(file.integer());
    for (int axis = 0; axis < 3; ++axis) sections.listing.coordinates.push_back(file.number());
  }
  file.expect_end_of("Nodes");
}

void read_elements_2(GmshCursor& file, GmshSections& sections) {
  ElementReader(file, sections).read();
}

}  // namespace perilink
