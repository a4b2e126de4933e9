#include "io/mesh/other_formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "io/mesh/gmsh_file.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OtherFormats, TheAdviceHasTheCommandWithTheNamesOfTheFile) {
  EXPECT_THAT(conversion_of_others("d.b/a.unv"),
              AllOf(HasSubstr("gmsh FILE.geo -2 -format msh41"), HasSubstr(".unv, .med or .bdf"),
                    HasSubstr("gmsh \"d.b/a.unv\" -save -format msh41 -o \"d.b/a_41.msh\"")));
}

TEST(OtherFormats, GeometriesAreNotConverted) {
  EXPECT_EQ(conversion_to_first_order("a.geo"),
            "delete Mesh.ElementOrder and SetOrder from the script");
}

constexpr const char* names =
    "$PhysicalNames\n2\n1 3 \"lower\"\n2 5 \"plate\"\n$EndPhysicalNames\n";

const std::string version_2 = std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n") + names +
                              "$Nodes\n4\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n$EndNodes\n"
                              "$Elements\n3\n1 1 2 3 11 1 2\n2 2 2 5 21 1 2 3\n3 2 2 5 21 1 3 4\n"
                              "$EndElements\n";

const std::string second_order =
    std::string("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n") + names +
    "$Entities\n0 1 1 0\n11 0 0 0 2 0 0 1 3 0\n21 0 0 0 2 2 0 1 5 0\n$EndEntities\n"
    "$Nodes\n1 9 1 9\n2 21 0 9\n1\n2\n3\n4\n5\n6\n7\n8\n9\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 0 0\n"
    "2 1 0\n1 1 0\n1 2 0\n0 1 0\n$EndNodes\n"
    "$Elements\n2 3 1 3\n1 11 8 1\n1 1 2 5\n2 21 9 2\n2 1 2 3 5 6 7\n3 1 3 4 7 8 9\n$EndElements\n";

/// Does what the message about a mesh says, with the gmsh of the machine, and reads the new mesh.
TEST(OtherFormats, TheCommandsOfTheMessagesMakeMeshesThatAreRead) {
  if (std::system("command -v gmsh > /dev/null") != 0) GTEST_SKIP() << "no gmsh here";
  const test::TemporaryDirectory directory;
  const std::filesystem::path folder = directory / "a folder";
  std::filesystem::create_directories(folder);
  const struct {
    const std::string &text, made;
  } meshes[] = {{version_2, "old_41.msh"}, {second_order, "old_order1.msh"}};
  for (const auto& [text, made] : meshes) {
    test::write_text(folder / "old.msh", text);
    std::string message;
    try {
      read_gmsh_file((folder / "old.msh").string(), 2);
    } catch (const InputError& error) {
      message = error.what();
    }
    const std::string before = "name the new file: ";
    ASSERT_THAT(message, HasSubstr(before));
    const std::string command = message.substr(message.find(before) + before.size());
    const std::string here = "cd " + directory.path().string() + " && ";
    ASSERT_EQ(std::system((here + "(" + command + ") > gmsh.log 2>&1").c_str()), 0) << command;
    const Mesh mesh = read_gmsh_file((folder / made).string(), 2);
    EXPECT_EQ(mesh.num_points(), 4);
    EXPECT_EQ(mesh.num_cells(), 2);
    ASSERT_EQ(mesh.groups.size(), 2u);
    EXPECT_EQ(mesh.groups[0].name, "lower");
    EXPECT_EQ(mesh.groups[0].elements.size(), 1u);
    EXPECT_EQ(mesh.groups[1].name, "plate");
    EXPECT_EQ(mesh.groups[1].elements.size(), 2u);
  }
}

}  // namespace
}  // namespace perilink
