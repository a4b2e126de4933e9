#include "io/mesh/other_formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "io/mesh/mesh_file.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OtherFormats, TheAdviceHasTheCommandWithTheNamesOfTheFile) {
  EXPECT_THAT(conversion_of_others("d.b/a.med"),
              AllOf(HasSubstr("gmsh \"d.b/a.med\" -save -format msh41 -o \"d.b/a_41.msh\""),
                    HasSubstr("meshio convert \"d.b/a.med\" \"d.b/a.msh\"")));
}

std::string loading_message(const std::filesystem::path& path) {
  try {
    load_mesh(path.string(), 2);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OtherFormats, FilesOfOtherProgramsAreRefusedWithIt) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "body.vtu", "<?xml version=\"1.0\"?>\n<VTKFile>\n</VTKFile>\n");
  EXPECT_THAT(loading_message(directory / "body.vtu"),
              AllOf(HasSubstr("is no mesh of gmsh"), HasSubstr("meshio convert ")));
}

/// Does what the message about an old mesh says, with the gmsh of the machine.
TEST(OtherFormats, TheCommandOfTheMessageMakesAMeshThatIsRead) {
  if (std::system("command -v gmsh > /dev/null") != 0) GTEST_SKIP() << "no gmsh here";
  const test::TemporaryDirectory directory;
  const std::filesystem::path folder = directory / "a folder";
  std::filesystem::create_directories(folder);
  const std::string here = "cd \"" + folder.string() + "\" && ";
  const std::string made = here + "gmsh \"" PERILINK_SOURCE_DIR
                                  "/tests/data/plate_41.msh\" -save -format msh40 -o old.msh";
  ASSERT_EQ(std::system((made + " > gmsh.log 2>&1").c_str()), 0);
  const std::string message = loading_message(folder / "old.msh"), before = "name the new file: ";
  ASSERT_THAT(message, AllOf(HasSubstr("is in version \"4\""), HasSubstr(before)));
  const std::string command = message.substr(message.find(before) + before.size());
  ASSERT_EQ(std::system((here + "(" + command + ") > gmsh.log 2>&1").c_str()), 0) << command;
  const Mesh mesh = load_mesh((folder / "old_41.msh").string(), 2);
  EXPECT_EQ(mesh.num_cells(), 48);
  EXPECT_EQ(mesh.groups.size(), 6u);
}

}  // namespace
}  // namespace perilink
