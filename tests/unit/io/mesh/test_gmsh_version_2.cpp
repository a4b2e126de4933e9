// Nodes and elements of gmsh's format 2, and files as gmsh writes them in every format.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "io/mesh/mesh_file.hpp"
#include "support/gmsh_texts.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using test::square_mesh;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string version_2_message(const std::string& bytes) {
  try {
    parse_mesh(bytes, "body.msh", 2);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The square in version 2.2, with an element for each group of the lower side.
constexpr const char* old_square = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 7 "corner"
1 3 "lower"
1 4 "lower and left"
2 5 "plate"
$EndPhysicalNames
$Nodes
6
10 0 0 0
20 2 0 0
30 2 2 0
40 0 2 0
50 0.5 1 0
60 9 9 0
$EndNodes
$Elements
8
1 15 2 7 1 10
2 1 2 -3 11 10 20
8 1 2 4 11 10 20
3 1 2 4 12 40 10
4 2 2 5 21 10 20 50
5 2 2 5 21 20 30 50
6 2 2 5 21 30 50 40
7 2 2 5 21 40 10 50
$EndElements
)";

void expect_equal(const Mesh& mesh, const Mesh& expected) {
  EXPECT_EQ(mesh.positions, expected.positions);
  EXPECT_EQ(mesh.cells, expected.cells);
  EXPECT_EQ(mesh.facets, expected.facets);
  EXPECT_EQ(mesh.cell_tags, expected.cell_tags);
  ASSERT_EQ(mesh.groups.size(), expected.groups.size());
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    EXPECT_EQ(mesh.groups[g].name, expected.groups[g].name);
    EXPECT_EQ(mesh.groups[g].dim, expected.groups[g].dim);
    EXPECT_EQ(mesh.groups[g].elements, expected.groups[g].elements);
    EXPECT_EQ(mesh.groups[g].points, expected.groups[g].points);
  }
}

TEST(GmshVersion2, ReadsVersion2) {
  expect_equal(parse_mesh(old_square, "m", 2), parse_mesh(square_mesh, "m", 2));
}

TEST(GmshVersion2, RefusesFaultsOfVersion2) {
  const struct {
    const char *from, *to, *message;
  } faults[] = {
      {"$Nodes\n6", "$Nodes\n600000", "body.msh:12: announces 600000 nodes"},
      {"$Nodes\n6", "$Nodes\n-6", "announces -6 nodes"},
      {"$Elements\n8", "$Elements\n9", "body.msh:30: has \"$EndElements\" where an integer"},
      {"$Elements\n8", "$Elements\n7", "\"7\" where $EndElements should be"},
      {"4 2 2 5 21 10", "4 77 2 5 21 10", "gmsh's type 77"},
      {"4 2 2 5 21 10", "4 2 -2 5 21 10", "has an element with -2 tags"},
      {"4 2 2 5 21 10", "4 2 4 5 21 1 2 10", "is partitioned"},
      {"4 2 2 5 21 10", "4 2 2 5 21 11", "node 11, which is not in the file"},
      {"20 2 0 0", "20 2 zero 0", "has \"zero\" where a number should be"}};
  for (const auto& [from, to, message] : faults) {
    EXPECT_THAT(version_2_message(replaced(old_square, from, to)), HasSubstr(message)) << to;
  }
}

const std::string data_folder = PERILINK_SOURCE_DIR "/tests/data/";

/// One plate as gmsh writes it. Its right half is in two groups, so that version 2 repeats cells.
TEST(GmshVersion2, ReadsOnePlateFromEveryFormatOfGmsh) {
  const Mesh expected = load_mesh(data_folder + "plate_41.msh", 2);
  EXPECT_EQ(expected.num_cells(), 2 * 24);
  EXPECT_THAT(expected.notes,
              ElementsAre(HasSubstr("24 quadrilaterals are divided into triangles")));
  const auto sizes_of = [](const Mesh& mesh) {
    std::map<std::string, std::pair<std::size_t, std::size_t>> sizes;
    for (const MeshGroup& group : mesh.groups) {
      sizes[group.name] = {group.elements.size(), group.points.size()};
    }
    return sizes;
  };
  const std::map<std::string, std::pair<std::size_t, std::size_t>> sizes = {
      {"corner", {0, 1}}, {"left", {4, 5}},    {"right", {4, 5}},
      {"crack", {2, 3}},  {"plate", {48, 35}}, {"right half", {24, 20}}};
  for (const char* name :
       {"plate_41.msh", "plate_41_binary.msh", "plate_22.msh", "plate_22_binary.msh"}) {
    const Mesh mesh = load_mesh(data_folder + name, 2);
    EXPECT_EQ(mesh.num_points(), expected.num_points()) << name;
    EXPECT_EQ(mesh.num_cells(), expected.num_cells()) << name;
    EXPECT_EQ(sizes_of(mesh), sizes) << name;
  }
}

/// Cells of every shape, with nodes between their corners, as gmsh writes them.
TEST(GmshVersion2, ReadsTheCornersOfSecondOrder) {
  const Mesh first = load_mesh(data_folder + "block_22.msh", 3);
  const Mesh second = load_mesh(data_folder + "block_order2.msh", 3);
  EXPECT_EQ(second.num_cells(), first.num_cells());
  EXPECT_GT(second.num_points(), first.num_points());
  EXPECT_THAT(second.notes, ::testing::Contains(HasSubstr("cells of second order count as")));
  EXPECT_THAT(first.notes, ::testing::Each(HasSubstr("are divided into tetrahedra")));
}

TEST(GmshVersion2, RefusesPartitionedMeshesOfGmsh) {
  for (const char* name : {"parts_22.msh", "parts_41.msh"}) {
    try {
      load_mesh(data_folder + name, 2);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("is partitioned\n  save the mesh before it is"));
    }
  }
}

TEST(GmshVersion2, RefusesEveryTruncation) {
  const std::string whole = old_square;
  const std::size_t end = whole.rfind("$EndElements");
  for (std::size_t size = 0; size < end + 12; ++size) {
    EXPECT_NE(version_2_message(whole.substr(0, size)), "accepted") << size;
  }
}

}  // namespace
}  // namespace perilink
