#include "io/mesh/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "support/gmsh_texts.hpp"
#include "support/replaced.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using test::square_mesh;
using test::tetrahedra_mesh;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string gmsh_message(const std::string& bytes, int dim = 2) {
  try {
    parse_mesh(bytes, "body.msh", dim);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The same mesh as gmsh's binary file: ints of four bytes, counts and tags of eight.
class BinaryWriter {
 public:
  explicit BinaryWriter(const std::string& text) : in_(text) {}

  std::string write() {
    for (std::string header; in_ >> header;) {
      if (header == "$MeshFormat") {
        out_ += "$MeshFormat\n4.1 1 8\n";
        append(std::int32_t{1});
        std::string skipped;
        in_ >> skipped >> skipped >> skipped;
      } else if (header == "$PhysicalNames") {
        out_ += header;
        for (std::string line; std::getline(in_, line) && line != "$EndPhysicalNames";) {
          out_ += line + "\n";
        }
        out_ += "$EndPhysicalNames\n";
        continue;
      } else {
        out_ += header + "\n";
        if (header == "$Entities") entities();
        if (header == "$Nodes") nodes();
        if (header == "$Elements") elements();
      }
      std::string end;
      in_ >> end;
      out_ += "\n" + end + "\n";
    }
    return out_;
  }

 private:
  template <class Value>
  void append(Value value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out_.append(bytes, sizeof value);
  }
  template <class Value>
  Value copy() {
    Value value{};
    in_ >> value;
    append(value);
    return value;
  }
  std::int64_t size() { return copy<std::int64_t>(); }
  std::int32_t integer() { return copy<std::int32_t>(); }

  void entities() {
    std::int64_t counts[4];
    for (auto& count : counts) count = size();
    for (int dim = 0; dim < 4; ++dim) {
      for (std::int64_t i = 0; i < counts[dim]; ++i) {
        integer();
        for (int k = 0; k < (dim == 0 ? 3 : 6); ++k) copy<double>();
        for (int list = 0; list < (dim == 0 ? 1 : 2); ++list) {
          const std::int64_t count = size();
          for (std::int64_t k = 0; k < count; ++k) integer();
        }
      }
    }
  }
  void nodes() {
    const std::int64_t blocks = size();
    for (int k = 0; k < 3; ++k) size();
    for (std::int64_t b = 0; b < blocks; ++b) {
      for (int k = 0; k < 3; ++k) integer();
      const std::int64_t count = size();
      for (std::int64_t k = 0; k < count; ++k) size();
      for (std::int64_t k = 0; k < 3 * count; ++k) copy<double>();
    }
  }
  void elements() {
    const std::int64_t blocks = size();
    for (int k = 0; k < 3; ++k) size();
    for (std::int64_t b = 0; b < blocks; ++b) {
      const int dim = integer();
      for (int k = 0; k < 2; ++k) integer();
      const std::int64_t count = size();
      for (std::int64_t k = 0; k < count * (dim + 2); ++k) size();
    }
  }

  std::istringstream in_;
  std::string out_;
};

TEST(MeshFile, ReadsTrianglesEdgesAndGroups) {
  const Mesh mesh = parse_mesh(square_mesh, "body.msh", 2);
  EXPECT_THAT(mesh.positions, ElementsAre(0, 0, 2, 0, 2, 2, 0, 2, 0.5, 1, 9, 9));
  EXPECT_THAT(mesh.cells, ElementsAre(0, 1, 4, 1, 2, 4, 2, 4, 3, 3, 0, 4));
  EXPECT_THAT(mesh.facets, ElementsAre(0, 1, 3, 0));
  ASSERT_EQ(mesh.groups.size(), 4u);
  EXPECT_EQ(mesh.groups[0].name, "corner");
  EXPECT_EQ(mesh.groups[0].dim, 0);
  EXPECT_THAT(mesh.groups[0].points, ElementsAre(0));
  EXPECT_THAT(mesh.groups[0].elements, ElementsAre());
  EXPECT_EQ(mesh.groups[1].name, "lower");
  EXPECT_THAT(mesh.groups[1].elements, ElementsAre(0));
  EXPECT_EQ(mesh.groups[2].name, "lower and left");
  EXPECT_THAT(mesh.groups[2].elements, ElementsAre(0, 1));
  EXPECT_THAT(mesh.groups[2].points, ElementsAre(0, 1, 3));
  EXPECT_EQ(mesh.groups[3].name, "plate");
  EXPECT_EQ(mesh.groups[3].dim, 2);
  EXPECT_THAT(mesh.groups[3].elements, ElementsAre(0, 1, 2, 3));
}

TEST(MeshFile, ReadsTetrahedraAndTriangles) {
  const Mesh mesh = parse_mesh(tetrahedra_mesh, "body.msh", 3);
  EXPECT_EQ(mesh.num_points(), 5);
  EXPECT_THAT(mesh.cells, ElementsAre(0, 1, 2, 3, 1, 2, 3, 4));
  EXPECT_THAT(mesh.facets, ElementsAre(1, 2, 3, 0, 1, 2));
  ASSERT_EQ(mesh.groups.size(), 4u);
  EXPECT_EQ(mesh.groups[1].name, "floor");
  EXPECT_EQ(mesh.groups[3].name, "large");
  EXPECT_THAT(mesh.groups[3].points, ElementsAre(1, 2, 3, 4));
}

TEST(MeshFile, ReadsLinesInSpace) {
  const Mesh mesh = parse_mesh(replaced(replaced(replaced(tetrahedra_mesh, "0 0 2 2",
                                                          "0 1 2 2\n5 0 0 0 1 1 "
                                                          "1 1 9 0"),
                                                 "4 4 1 4", "5 6 1 6"),
                                        "2 1 2 1", "1 5 1 2\n5 1 5\n6 5 4\n2 1 2 1"),
                               "body.msh", 3);
  EXPECT_THAT(mesh.lines, ElementsAre(0, 4, 4, 3));
  ASSERT_EQ(mesh.groups.size(), 5u);
  EXPECT_EQ(mesh.groups[0].name, "9");
  EXPECT_EQ(mesh.groups[0].dim, 1);
  EXPECT_THAT(mesh.groups[0].elements, ElementsAre(0, 1));
  EXPECT_THAT(mesh.groups[0].points, ElementsAre(0, 3, 4));
}

TEST(MeshFile, BinaryAndTextSayTheSame) {
  const struct {
    const char* text;
    int dim;
  } meshes[] = {{square_mesh, 2}, {tetrahedra_mesh, 3}};
  for (const auto& [text, dim] : meshes) {
    const Mesh expected = parse_mesh(text, "body.msh", dim);
    const Mesh mesh = parse_mesh(BinaryWriter(text).write(), "body.msh", dim);
    EXPECT_EQ(mesh.positions, expected.positions);
    EXPECT_EQ(mesh.cells, expected.cells);
    EXPECT_EQ(mesh.facets, expected.facets);
    ASSERT_EQ(mesh.groups.size(), expected.groups.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      EXPECT_EQ(mesh.groups[g].name, expected.groups[g].name);
      EXPECT_EQ(mesh.groups[g].elements, expected.groups[g].elements);
      EXPECT_EQ(mesh.groups[g].points, expected.groups[g].points);
    }
  }
}

TEST(MeshFile, CallsNamelessGroupsByTheirNumber) {
  const Mesh mesh = parse_mesh(replaced(square_mesh, "2 5 \"plate\"", "2 6 \"plate\""), "m", 2);
  EXPECT_EQ(mesh.groups[3].name, "5");
}

TEST(MeshFile, PassesOverCommentsResultsAndWindowsLineEnds) {
  std::string text = "$Comments\nby hand\n$EndComments\n" + std::string(square_mesh) +
                     "$NodeData\n1\n\"T\"\n$EndNodeData\n";
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(gmsh_message(text), "accepted");
  EXPECT_EQ(parse_mesh(windows, "m", 2).groups[3].name, "plate");
}

TEST(MeshFile, PassesOverTheByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(parse_mesh(mark + square_mesh, "m", 2).positions,
            parse_mesh(square_mesh, "m", 2).positions);
  EXPECT_EQ(gmsh_message(mark + BinaryWriter(square_mesh).write()), "accepted");
  EXPECT_THAT(gmsh_message(mark + replaced(square_mesh, "4.1 0 8", "4 0 8")),
              HasSubstr("body.msh:2: is in version \"4\""));
}

/// The last node of the square belongs to no element, and may belong to one that is not kept.
TEST(MeshFile, NodesOfNoElementOfTheMeshMayLieOffThePlane) {
  const std::string off = replaced(square_mesh, "9 9 0\n", "9 9 5\n");
  EXPECT_EQ(parse_mesh(off, "m", 2).cells, parse_mesh(square_mesh, "m", 2).cells);
  const std::string loose =
      replaced(off, "4 7 1 7\n0 1 15 1\n", "5 8 1 8\n0 99 15 1\n8 60\n0 1 15 1\n");
  EXPECT_EQ(parse_mesh(loose, "m", 2).cells, parse_mesh(square_mesh, "m", 2).cells);
  // A line of a group may be a bar of the body.
  const Mesh bent = parse_mesh(replaced(off, "3 40 10", "3 40 60"), "m", 2);
  EXPECT_FALSE(bent.groups[1].off_plane) << "lower";
  EXPECT_TRUE(bent.groups[2].off_plane) << "lower and left";
}

TEST(MeshFile, GroupsOfOneNameAndDimensionAreOne) {
  const std::string shared =
      replaced(replaced(square_mesh, "\"plate\"", "\"lower\""), "\"lower and left\"", "\"lower\"");
  const Mesh mesh = parse_mesh(shared, "m", 2);
  ASSERT_EQ(mesh.groups.size(), 3u);
  EXPECT_EQ(mesh.groups[1].name, "lower");
  EXPECT_THAT(mesh.groups[1].elements, ElementsAre(0, 1)) << "the first line is in both tags";
  EXPECT_THAT(mesh.groups[1].points, ElementsAre(0, 1, 3));
  EXPECT_EQ(mesh.groups[2].name, "lower");
  EXPECT_EQ(mesh.groups[2].dim, 2);
}

TEST(MeshFile, KeepsCellsOfNoGroupOnly) {
  const std::string text =
      replaced(replaced(square_mesh, "0 1 5 2 11 12", "0 0 2 11 12"), "2 -3 4 2 1 2", "0 2 1 2");
  const Mesh mesh = parse_mesh(text, "m", 2);
  EXPECT_EQ(mesh.num_cells(), 4);
  EXPECT_EQ(mesh.num_facets(), 1);  // the one of "left"
}

struct Fault {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

void PrintTo(const Fault& fault, std::ostream* stream) { *stream << fault.name; }

class MeshFileFault : public ::testing::TestWithParam<Fault> {};

TEST_P(MeshFileFault, IsRefusedWithFileAndReason) {
  const std::string message = gmsh_message(replaced(square_mesh, GetParam().from, GetParam().to));
  EXPECT_THAT(message, HasSubstr("body.msh"));
  EXPECT_THAT(message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Files, MeshFileFault,
    ::testing::Values(
        Fault{"version1", "4.1 0 8", "1 0 8", "body.msh:2: is in version \"1\""},
        Fault{"version4", "4.1 0 8", "4 0 8",
              "new file: gmsh \"body.msh\" -save -format msh41 -o \"body_41.msh\""},
        Fault{"numbersOf4Bytes", "4.1 0 8", "4.1 0 4", "numbers of 4 bytes"},
        Fault{"kind", "4.1 0 8", "4.1 3 8", "neither text nor binary"},
        Fault{"noFormat", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", "",
              "does not begin with $MeshFormat"},
        Fault{"manyNodes", "0 1 0 1\n10", "0 1 0 9999999\n10", "announces 9999999 nodes"},
        Fault{"manyElements", "2 21 2 4", "2 21 2 400000000000", "more than the rest of the file"},
        Fault{"manyBlocks", "3 6 10 60", "123456789 6 10 60", "announces 123456789 blocks"},
        Fault{"negativeCount", "3 6 10 60", "-3 6 10 60", "negative"},
        Fault{"word", "2 0 0\n", "2 zero 0\n", "has \"zero\" where a number should be"},
        Fault{"wordForTag", "4 10 20 50", "4 10 x 50", "has \"x\" where an integer should be"},
        Fault{"tooLarge", "2 0 0\n", "1e400 0 0\n", "body.msh:27: has \"1e400\", a number that"},
        Fault{"tooLargeBelowZero", "2 0 0\n", "-1e400 0 0\n", "double precision does not hold"},
        Fault{"tooSmall", "2 0 0\n", "1e-400 0 0\n", "double precision does not hold"},
        Fault{"notANumber", "2 0 0\n", "2 nan 0\n", "not finite"},
        Fault{"hexadecimal", "2 0 0\n", "0x2 0 0\n", "has \"0x2\" where a number should be"},
        Fault{"beyondAllBodies", "2 0 0\n", "2e200 0 0\n", "not finite"},
        Fault{"infinite", "2 0 0\n", "2 inf 0\n", "not finite"},
        Fault{"unknownNode", "4 10 20 50", "4 10 25 50", "node 25, which is not in the file"},
        Fault{"nodeTwice", "20\n30\n40", "20\n20\n40", "two nodes with the tag 20"},
        Fault{"otherType", "2 21 2 4", "2 21 77 4", "gmsh's type 77"},
        Fault{"typeOfOtherDimension", "2 21 2 4", "2 21 1 4", "lines on an entity of dimension 2"},
        Fault{"dimension", "2 21 2 4", "9 21 2 4", "dimension 9"},
        Fault{"missingNode", "4 7 1 7", "5 7 1 7", "body.msh:"},
        Fault{"noEnd", "$EndNodes", "$EndKnots", "\"$EndKnots\" where $EndNodes should be"},
        Fault{"betweenSections", "$Entities", "Entities", "where a section $... should begin"},
        Fault{"partitioned", "$Entities", "$PartitionedEntities", "is partitioned"},
        Fault{"nameWithoutQuotes", "\"plate\"", "plate", "not between quotes"},
        Fault{"groupOfNoDimension", "2 5 \"plate\"", "5 5 \"plate\"", "impossible dimension"},
        Fault{"notPlane", "2 2 0\n", "2 2 0.1\n", "z is from 0 to 0.1"},
        Fault{"tetrahedra", "2 21 2 4\n4 10 20 50 \n5 20 30 50 \n6 30 50 40 \n7 40 10 50 ",
              "3 21 4 1\n4 10 20 30 50", "holds solid cells"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(MeshFile, RefusesEveryTruncation) {
  for (const std::string& whole :
       {std::string(square_mesh), BinaryWriter(square_mesh).write(), std::string(old_square)}) {
    const std::size_t end = whole.rfind("$EndElements");
    for (std::size_t size = 0; size < end + 12; ++size) {
      EXPECT_NE(gmsh_message(whole.substr(0, size)), "accepted") << size;
    }
  }
}

TEST(MeshFile, RefusesTheWrongDimension) {
  EXPECT_THAT(gmsh_message(square_mesh, 3), HasSubstr("no tetrahedra"));
  EXPECT_THAT(gmsh_message(tetrahedra_mesh, 2), HasSubstr("problem = \"three_dimensional\""));
}

TEST(MeshFile, RefusesMeshesWithoutNodesOrElements) {
  EXPECT_THAT(gmsh_message("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"), HasSubstr("holds no mesh"));
  EXPECT_THAT(gmsh_message(""), HasSubstr("is empty"));
}

TEST(MeshFile, RefusesTheOtherOrderOfBytes) {
  std::string bytes = BinaryWriter(square_mesh).write();
  std::swap(bytes[bytes.find("4.1 1 8\n") + 8], bytes[bytes.find("4.1 1 8\n") + 11]);
  EXPECT_THAT(gmsh_message(bytes), HasSubstr("another order of bytes"));
}

TEST(MeshFile, ReadsFromDiskAndNamesWhatItCannotRead) {
  const test::TemporaryDirectory directory;
  const std::string path = (directory.path() / "body.msh").string();
  test::write_text(path, square_mesh);
  EXPECT_EQ(load_mesh(path, 2).num_cells(), 4);
  EXPECT_THROW(load_mesh(path + "x", 2), FileError);
  EXPECT_THROW(load_mesh(directory.path().string(), 2), FileError);
}

}  // namespace
}  // namespace perilink
