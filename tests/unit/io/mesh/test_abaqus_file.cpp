#include "io/mesh/abaqus_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "base/error.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "io/mesh/mesh_file.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two squares and a triangle, with what Abaqus/CAE writes around them.
constexpr const char* abaqus_plate = R"(*Heading
 a plate
** a comment
*PREPRINT, ECHO=NO
*Part, name=Plate
*Node, nset=All
 1, 0., 0.
 2, 1., 0., 0.
 3, 2.0D+0, 0.
 4, 0., 1.
 5, +1., 1.
 6, 2., 1.
 7, 3., .5
*Element, type=CPS4R, elset=squares
10, 1, 2, 5, 4
11, 2, 3, 6,
 5
*Element,
 type=CPE3, elset=wedge
20, 3, 7, 6
*Nset, nset=left
1, 4
*Nset, nset=Lower, generate
1, 3, 1
*Elset, elset=body
SQUARES, 20
*Surface, type=ELEMENT, name=top
squares, S3
20, S2
*Surface, type=NODE, name=tip
7
*Solid Section, elset=body, material=steel
*End Part
*Assembly, name=Assembly
*Instance, name=Plate-1, part=Plate
0., 0., 0.
*End Instance
*Node
 1, 5., 5., 0.
*Nset, nset=reference
1
*Nset, nset=corner, instance=Plate-1
1
*Nset, nset=other corner
Plate-1.3
*End Assembly
*Material, name=steel
*Step
*Nset, nset=left
7
)";

std::map<std::string, MeshGroup> abaqus_groups(const Mesh& mesh) {
  std::map<std::string, MeshGroup> groups;
  for (const MeshGroup& group : mesh.groups) groups[group.name] = group;
  return groups;
}

TEST(AbaqusFile, ReadsNodesElementsAndSets) {
  const Mesh mesh = parse_mesh(abaqus_plate, "plate.INP", 2);
  EXPECT_EQ(mesh.num_points(), 7);
  EXPECT_EQ(mesh.num_cells(), 5);
  EXPECT_THAT(mesh.cell_tags, ElementsAre(10, 10, 11, 11, 20));
  auto groups = abaqus_groups(mesh);
  EXPECT_EQ(groups.size(), 10u);
  EXPECT_THAT(groups["body"].elements, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(groups["squares"].elements, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(groups["wedge"].points, ElementsAre(2, 5, 6));
  EXPECT_THAT(groups["left"].points, ElementsAre(0, 3));
  EXPECT_EQ(groups["left"].dim, 0);
  EXPECT_THAT(groups["Lower"].points, ElementsAre(0, 1, 2));
  EXPECT_THAT(groups["All"].points, ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_EQ(groups["top"].dim, 1);
  EXPECT_THAT(groups["top"].points, ElementsAre(3, 4, 5, 6));
  EXPECT_THAT(groups["tip"].points, ElementsAre(6));
  EXPECT_THAT(groups["corner"].points, ElementsAre(0));
  EXPECT_THAT(groups["other corner"].points, ElementsAre(2));
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("plate.INP: skipped *MATERIAL, *NODE of the assembly, "
                                             "*SOLID SECTION, *STEP: only nodes, elements")));
  const Body body = make_mesh_body(mesh, std::vector<Index>(5, 0), 1.0);
  EXPECT_EQ(body.facets.size(), 7);
  for (const Group& group : body.groups) {
    if (group.name == "top") {
      EXPECT_EQ(group.facets.size(), 3u);
    }
    EXPECT_FALSE(group.loose) << group.name;
  }
}

/// A unit cube of each kind beside the last: surfaces by number, all sides, and shell faces.
TEST(AbaqusFile, ReadsSidesOfSolids) {
  const std::string text = R"(*NODE
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
9,.5,0,0
*ELEMENT, TYPE=C3D20R, ELSET=CUBE
1, 1,2,3,4,5,6,7,8,9,9,9,9,9,9,9,
 9,9,9,9,9
*ELEMENT, TYPE=S4, ELSET=SKIN
2, 5,6,7,8
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
3, 1, 2
*ELEMENT, TYPE=T3D2, ELSET=BAR
4, 1, 7
*SURFACE, NAME=LOWER
CUBE, S1
*SURFACE, NAME=EVERY
1,
*SURFACE, NAME=UPPER
SKIN, SPOS
*NSET, NSET=CORNERS, ELSET=SKIN
*ELSET, ELSET=SPRINGS
3
)";
  const Mesh mesh = parse_mesh(text, "cube.inp", 3);
  EXPECT_EQ(mesh.num_cells(), 6);
  auto groups = abaqus_groups(mesh);
  EXPECT_THAT(groups["LOWER"].points, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(groups["LOWER"].elements.size(), 2u);
  EXPECT_EQ(groups["EVERY"].elements.size(), 12u);
  EXPECT_THAT(groups["UPPER"].points, ElementsAre(4, 5, 6, 7));
  EXPECT_EQ(groups["UPPER"].elements, groups["SKIN"].elements);
  EXPECT_THAT(groups["CORNERS"].points, ElementsAre(4, 5, 6, 7));
  EXPECT_THAT(groups["BAR"].points, ElementsAre(0, 6));
  EXPECT_THAT(mesh.lines, ElementsAre(0, 6));
  EXPECT_EQ(groups.count("SPRINGS"), 0u);
  EXPECT_THAT(mesh.notes,
              AllOf(Contains(HasSubstr("skipped elements of type SPRINGA")),
                    Contains(HasSubstr("are among the nodes and elements that are read: SPRINGS")),
                    Contains(HasSubstr("1 hexahedra are divided")),
                    Contains(HasSubstr("cells of second order"))));
  const Body body = make_mesh_body(mesh, std::vector<Index>(6, 0), 1.0);
  EXPECT_EQ(body.particles.size(), 8) << "the node between corners is none";
  for (const Group& group : body.groups) {
    if (group.name == "EVERY") {
      EXPECT_EQ(group.facets.size(), 12u);
    }
  }
}

TEST(AbaqusFile, ReadsWhatGmshWrites) {
  for (const auto& [name, dim] : {std::pair("plate", 2), std::pair("block", 3)}) {
    const std::string path = PERILINK_SOURCE_DIR "/tests/data/" + std::string(name);
    const Mesh mesh = load_mesh(path + ".inp", dim), other = load_mesh(path + "_22.msh", dim);
    EXPECT_EQ(mesh.num_points(), other.num_points());
    EXPECT_EQ(mesh.num_cells(), other.num_cells());
    auto groups = abaqus_groups(mesh);
    for (const MeshGroup& group : other.groups) {
      if (group.dim == 0) continue;  // not written
      const std::string its_name = group.name == "right half" ? "right_half" : group.name;
      EXPECT_EQ(groups[its_name].elements.size(), group.elements.size()) << group.name;
      EXPECT_EQ(groups[its_name].points.size(), group.points.size()) << group.name;
    }
  }
}

std::string abaqus_message(const std::string& text) {
  try {
    parse_mesh(text, "plate.inp", 2);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(AbaqusFile, RefusesWithFileAndLine) {
  const struct {
    const char *from, *to, *message;
  } faults[] = {
      {" 2, 1., 0., 0.", " 2, one", "plate.inp:8: has \"one\" where a number should be"},
      {" 2, 1., 0., 0.", " 2, 1e60", "plate.inp:8: has the coordinate 1e+60"},
      {" 2, 1., 0., 0.", " -2, 1.", "plate.inp:8: has \"-2\" where the number of a node"},
      {" 2, 1., 0., 0.", " 1, 1.", "has two nodes with the tag 1"},
      {"10, 1, 2, 5, 4", "10, 1, 2, 5, 9", "node 9, which is not in the file"},
      {"10, 1, 2, 5, 4", "11, 1, 2, 5, 4", "has two elements with the label 11"},
      {" 5\n*Element,", "*Element,", "plate.inp:17: has an element of type CPS4R with 3 nodes"},
      {" 5\n*Element,", " 5, 7\n*Element,", "CPS4R with 5 nodes instead of 4"},
      {"type=CPS4R", "type=CAX4R", "plate.inp:14: has axisymmetric elements (CAX4R)"},
      {"*Node, nset=All", "*Node, input=all.txt", "plate.inp:6: reads the file \"all.txt\""},
      {"*Node, nset=All", "*Node, system=C", "in cylindrical or spherical coordinates"},
      {"*Nset, nset=left", "*Ngen\n",
       "plate.inp:21: has *NGEN, which reads another file, or moves"},
      {"*Nset, nset=left", "*Nset", "plate.inp:21: has *NSET without a name"},
      {"1, 3, 1", "1", "plate.inp:24: has a range of labels without an end"},
      {"1, 3, 1", "1, 3, 0", "plate.inp:24: has \"0\""},
      {"1, 3, 1", "1, 4, 2", "plate.inp:24: has a range from 1 to 4 in steps of 2, which miss"},
      {"0., 0., 0.\n*End", "0., 1., 0.\n*End", "plate.inp:36: moves the instance of a part"},
      {"*End Instance", "*End Instance\n*Instance, name=b, part=PLATE\n*End Instance",
       "plate.inp:38: has several instances of the part \"PLATE\""},
      {"squares, S3", "squares, E3",
       "plate.inp:28: has the surface \"top\" with \"E3\", which is no face of its elements"},
      {"20, S2", "20, SNEG", "plate.inp:29: has the surface \"top\" with \"SNEG\""},
      {"20, S2", "20, S", "plate.inp:29: has the surface \"top\" with \"S\""},
      {"name=top", "name=top, combine=difference",
       "plate.inp:27: has a surface by COMBINE=DIFFERENCE"},
      {"*Assembly", "*Part, name=b\n*Node\n1, 0.\n*End Part\n*Assembly",
       "has nodes in several parts"}};
  for (const auto& [from, to, message] : faults) {
    EXPECT_THAT(abaqus_message(replaced(abaqus_plate, from, to)), HasSubstr(message)) << to;
  }
  EXPECT_THAT(abaqus_message("nothing of Abaqus\n"), HasSubstr("holds no mesh"));
  EXPECT_THAT(abaqus_message(""), HasSubstr("holds no mesh"));
}

/// Sets that name what is not there are no fault: the case may not use them.
TEST(AbaqusFile, IncompleteSetsHaveANote) {
  const std::string text = replaced(replaced(abaqus_plate, "SQUARES, 20", "SQUARES, nobody, 99"),
                                    "squares, S3", "squares, S5");
  const Mesh mesh = parse_mesh(text, "plate.inp", 2);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("that are read: body, top")));
}

TEST(AbaqusFile, AcceptsWindowsLineEnds) {
  std::string windows;
  for (const char c : std::string(abaqus_plate)) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(parse_mesh(windows, "m.inp", 2).cells, parse_mesh(abaqus_plate, "m.inp", 2).cells);
}

/// A bent and a straight line, in the order of Abaqus and with the middle last or first.
TEST(AbaqusFile, EndsOfThreeNodeLinesAreTheirEnds) {
  const std::string nodes =
      "*NODE\n1,0,0\n2,4,0\n3,4,4\n4,0,4\n5,1.7,0\n6,4.4,2\n*ELEMENT,TYPE=CPS4,ELSET=BODY\n"
      "1,1,2,3,4\n*ELEMENT,ELSET=EDGE,TYPE=";
  for (const char* type : {"T2D3", "T3D3H", "B22", "B32OS"}) {
    for (const char* lines : {"2,1,5,2\n3,2,6,3\n", "2,1,2,5\n3,3,2,6\n", "2,5,2,1\n3,6,3,2\n"}) {
      const Mesh mesh = parse_mesh(nodes + type + "\n" + lines, "m.inp", 2);
      EXPECT_THAT(abaqus_groups(mesh)["EDGE"].points, ElementsAre(0, 1, 2)) << type << lines;
    }
  }
}

/// Sets and surfaces of the plate by all the names that a data line may give them.
TEST(AbaqusFile, FindsSetsByTheirNamesInDataLines) {
  const char* const sets = R"(*Elset, elset="two, of", instance=Plate-1
10, 11
*Nset, nset=of wedge, elset=Plate-1.wedge
*Nset, nset=again
of wedge
*Surface, type=ELEMENT, name=below
"two, of", S1
*Surface, type=ELEMENT, name=right
plate-1.wedge, S1
*Surface, type=NODE, name=corners
"of wedge", 1.
*Surface, name="both of them", combine=union
below, right
*Surface, name=nodes of both, combine=union
corners, tip
*Surface, name=nobody's, combine=union
nothing
*End Assembly)";
  const Mesh mesh = parse_mesh(replaced(abaqus_plate, "*End Assembly", sets), "plate.inp", 2);
  auto groups = abaqus_groups(mesh);
  EXPECT_THAT(groups["two, of"].elements, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(groups["below"].points, ElementsAre(0, 1, 2));
  EXPECT_THAT(groups["right"].points, ElementsAre(2, 6));
  for (const char* name : {"of wedge", "again", "corners", "nodes of both"}) {
    EXPECT_THAT(groups[name].points, ElementsAre(2, 5, 6)) << name;
    EXPECT_EQ(groups[name].dim, 0) << name;
  }
  EXPECT_THAT(groups["both of them"].points, ElementsAre(0, 1, 2, 6));
  EXPECT_EQ(groups["both of them"].elements.size(), 3u);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("that are read: nobody's")));
}

/// Shells have edges and two faces, which solids do not have.
TEST(AbaqusFile, ReadsEdgesOfShells) {
  const std::string text = replaced(replaced(replaced(abaqus_plate, "CPS4R", "S4R"), "CPE3", "S3"),
                                    "squares, S3", "squares, E3");
  auto groups = abaqus_groups(parse_mesh(text, "plate.inp", 2));
  EXPECT_THAT(groups["top"].points, ElementsAre(3, 4, 5, 6));
  EXPECT_EQ(groups["top"].dim, 1);
}

/// A quadrilateral with a corner within: only one diagonal lies inside.
TEST(AbaqusFile, DividesHollowQuadrilateralsInside) {
  const char* const nodes = "*NODE\n1,0,0\n2,2,1\n3,0,2\n4,.5,1\n*ELEMENT,TYPE=CPS4,ELSET=A\n";
  for (const char* element : {"1,1,2,3,4", "1,2,3,4,1", "1,4,3,2,1"}) {
    const Mesh mesh = parse_mesh(std::string(nodes) + element + "\n", "m.inp", 2);
    const Body body = make_mesh_body(mesh, std::vector<Index>(2, 0), 1.0);
    double area = 0.0;
    for (const double volume : body.particles.volumes) area += volume;
    EXPECT_NEAR(area, 1.5, 1e-14) << element;
  }
}

}  // namespace
}  // namespace perilink
