#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh/mesh_listing.hpp"

namespace perilink {

/// Labels first, first + step, ... up to last; empty where last < first.
struct LabelRange {
  std::int64_t first, last, step;
};

/// Sides of elements in a surface.
struct AbaqusFaces {
  std::string surface;
  std::vector<LabelRange> elements;
  std::string side;  ///< "S1", "S2", ...; shells: "SPOS", "SNEG", "E1", ...; empty: all sides
  int line = 0;      ///< in the file, for messages
};

/// Sets of nodes and elements, and surfaces, of an input file of Abaqus. Names are compared without
/// regard to case.
class AbaqusSets {
 public:
  /// \param listing  nodes and elements, complete at add_groups()
  AbaqusSets(MeshListing& listing, std::string path) : listing_(listing), path_(std::move(path)) {}

  void add_node(const std::string& set, const LabelRange& range);
  void add_element(const std::string& set, const LabelRange& range);
  /// Adds the members of another set, which must come earlier.
  void add_set(bool of_nodes, const std::string& set, const std::string& other);
  /// Adds the corners of the elements of a set.
  void add_nodes_of(const std::string& set, const std::string& elements);
  /// Adds sides of elements to a surface.
  /// \param set  earlier set that gives the elements, or empty
  void add_faces(AbaqusFaces faces, const std::string& set);
  /// Adds an earlier surface, of elements or nodes, to a surface.
  void add_surface(const std::string& surface, const std::string& other);
  /// States that the plane elements of the file are solids, without faces of shells.
  void add_plane_solids() { plane_solids_ = true; }

  /// Adds a group to the listing for every set and dimension, in the order of dimension and name,
  /// and a note on members that are not in the file.
  /// \throws InputError  where two elements have one label, sets have too many members, or elements
  ///                     lack a side of this name
  void add_groups();

 private:
  using Labels = std::vector<std::pair<std::int64_t, Index>>;

  struct Set {
    std::string name;  ///< as first written
    std::vector<LabelRange> labels;
  };

  static Set& find(std::map<std::string, Set>& sets, const std::string& name);
  std::vector<Index> members(const Labels& all, const std::string& set,
                             std::span<const LabelRange> ranges);
  MeshListing::Group& group(int dim, const std::string& name);
  void add(const std::string& name, CellShape shape, std::span<const std::int64_t> corners);
  void check_side(const AbaqusFaces& faces, int dim) const;
  void add_sides(const AbaqusFaces& faces, std::span<const std::size_t> begin);

  MeshListing& listing_;
  std::string path_;
  std::map<std::string, Set> node_sets_, element_sets_;         ///< by name in upper case
  std::map<std::string, std::vector<std::string>> corners_of_;  ///< sets of elements, by nodes
  std::vector<AbaqusFaces> faces_;
  bool plane_solids_ = false;
  Labels elements_;
  std::map<std::pair<int, std::string>, MeshListing::Group> groups_;
  std::set<std::string> incomplete_;  ///< sets with members that are not in the file
  std::size_t members_left_ = 0;
};

}  // namespace perilink
