#include "io/mesh/gmsh_script.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class GmshScript : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((directory_ / name).parent_path());
    test::write_text(directory_ / name, text);
  }
  std::string answer_of_file(const std::filesystem::path& name) const {
    try {
      refuse_unsafe_geometry((directory_ / name).string());
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  std::string answer(const std::string& script) const {
    write("body.geo", script);
    return answer_of_file("body.geo");
  }

  test::TemporaryDirectory directory_;
};

TEST_F(GmshScript, RefusesWhatRunsCommandsOrWritesFiles) {
  for (const char* script : {
           "SystemCall \"touch x\";",
           "SystemCall(\"touch x\");",
           "/* a */ SystemCall // b\n \"touch x\";",
           "1e5SystemCall \"touch x\";",
           "SystemCall = 1; s = \"touch x\"; SystemCall(s);",
           "If (1) SystemCall 'touch x'; EndIf",
           "Macro Foo SystemCall \"touch x\"; Return Call Foo;",
           "S2N[\"SystemCall\"] \"touch x\";",
           "OnelabRun(\"solver\", \"touch x\");",
           "Printf(\"x\") > \"x\";",
           "Error(\"%g\", 1) >> \"x\";",
           "x = \"x\"; Printf(\"x\")\n>\nx;",
           "Save View[0] \"x.pos\";",
           "Print \"x.png\";",
           "CreateDir \"x\";",
           "Exit 1;",
           "Plugin(NewView).Run;",
           "Field[newf] = ExternalProcess;",
           "General.ErrorFileName = \"x\";",
           "name = \"x\"; General.SessionFileName = name;",
           "Solver.Executable0 = \"x\";",
           "PostProcessing.Plugins = 1;",
           "x = GetEnv(\"HOME\");",
           "Later = 1; Later \"x\";",
           "Later = 1; Later(\"x\");",
           "Later(1) \"x\";",
           "Later = 1; Later Str(\"x\");",
           "Later;",
           "Later{1};",
           "Later 1;",
           "Include StrCat(\"a\", \".geo\");",
           "x = \"a\"; Merge x;",
           "For i In {1:3} x = i; EndFor",
           "For (1:3)\nx = 1;\nEndFor",
           "If (1)\nx = 1;\nEndIf",
           "Macro Foo\nx = 1;\nReturn\n",
           "Function Foo\nReturn\n",
           "Call Foo;",
           "Field[1].FileName = \"../secret\";",
           "ShapeFromFile(\"x.brep\");",
           "MergeWithBoundingBox \"inner.txt\";",
       }) {
    EXPECT_THAT(answer(script + std::string("\n")),
                AllOf(HasSubstr("body.geo:"), HasSubstr("--trust-geometry")))
        << script;
  }
}

TEST_F(GmshScript, NamesLineAndCommand) {
  EXPECT_THAT(answer("Point(1) = {0, 0, 0};\n/* a\nb */\r\nSystemCall \"touch x\";"),
              HasSubstr("body.geo:4: names the command SystemCall, which is not on the list"));
  EXPECT_THAT(answer("\n// c\n/* d\n */ Printf(\"x\") > \"x\";"),
              HasSubstr("body.geo:4: prints to a file"));
  EXPECT_THAT(answer("x = 1;\nMesh 2; RefineMesh;"), HasSubstr("body.geo:2: ends without a line"));
}

/// Each of these ran a command or an unread file with gmsh 4.8, or comes close to one that did.
TEST_F(GmshScript, RefusesTextsAndCommentsThatMayBecomeCommands) {
  for (const std::string& script : {
           std::string("MergeWithBoundingBox\f\"inner.txt\";\n"),
           std::string("SystemCall\v\"x\";\n"),
           std::string(
               "For i In {1:2} Macro\nMergeWithBoundingBox \"inner.txt\";\nReturn\nEndFor\n"),
           std::string("For i In {1:2} x =\n\"inner.txt\";\nEndFor Merge\n\"ok.geo\";\n"),
           std::string(
               "For i In {1:2} If (0)\n> \"../out.txt\";\nEndIf\nEndFor Printf(\"evil\")\n;\n"),
           std::string("x = 1; /*\nFoo 'x';\n*/\n"),
           std::string("// a\rSystemCall \"x\";\n"),
           std::string("// a\0b\n", 7),
           std::string("a = \"") + std::string(2000, 'b') + "\";",
           std::string("a = \"b"),
           std::string("/* a"),
       }) {
    EXPECT_THAT(answer(script), HasSubstr("--trust-geometry")) << script;
  }
}

TEST_F(GmshScript, AcceptsWhatDrawsAndMeshes) {
  for (const char* script : {
           "",
           "// SystemCall \"x\";\n/* Exit; */\nPoint(1) = {0, 0, 0, 1e-1};",
           "Physical Surface(\"SystemCall\") = {1};",
           "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n"
           "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };",
           "lc = 0.1; p[] = {}; p[] += newp; Point(p[0]) = {1, 0, 0, lc};",
           "DefineConstant[ h = {0.1, Name \"Parameters/h\", Min 0.01, Max 1, Step 0.1} ];",
           "a~{1} = 2; b = a~{1} + Sqrt(2) > 1 ? Pi : -1;",
           "n = 10; Transfinite Curve {1} = n Using Progression 1.1; Transfinite Surface {1} Left;",
           "Field[1] = MathEval; Field[1].F = \"0.1 + x\"; Background Field = 1;",
           "Field[2] = Box; Field[2].VIn = 1; Field[3] = Max;",
           "Mesh.MeshSizeMin = 0.1; Geometry.OCCTargetUnit = \"M\"; General.Verbosity = 2;",
           "View \"sizes\" { ST(0, 0, 0, 1, 0, 0, 0, 1, 0){1, 2, 3}; };",
           "Printf(\"%g points\", 3); Mesh 2; Plugin(Crack).Dimension = 1; Plugin(Crack).Run;",
           "Extrude {0, 0, 1} { Surface{1}; Layers{ {8, 2}, {0.5, 1} }; Recombine; }",
           "Physical Curve(\"rim\") = Boundary{ Surface{1}; };\nCoherence;\n",
           "a = Exists(h) ? 1 : 2; // 5 system parts (print)",
       }) {
    EXPECT_EQ(answer(script + std::string("\n")), "accepted") << script;
  }
  for (const auto& entry : std::filesystem::directory_iterator(PERILINK_SOURCE_DIR "/meshes")) {
    if (entry.path().extension() != ".geo") continue;
    EXPECT_EQ(answer_of_file(entry.path()), "accepted");
  }
}

/// Merge takes some files for data, Include runs any file.
TEST_F(GmshScript, LooksIntoFilesOfItsFolder) {
  write("parts/b.geo", "Merge \"c.txt\";\nMerge \"d.step\";\n");
  write("parts/c.txt", "y = x;\nSave \"d.msh\";\n");
  write("parts/d.step", "SystemCall \"touch x\";\n");
  EXPECT_THAT(answer("Include \"parts/b.geo\";\nx = 1;\n"),
              HasSubstr("c.txt:2: names the command"));
  write("parts/c.txt", "y = x; Merge \"b.geo\";\n");
  EXPECT_EQ(answer("Include \"parts/b.geo\";\n"), "accepted") << "circles end";
  EXPECT_THAT(answer("Include \"parts/d.step\";\n"), HasSubstr("d.step:1: names the command"));
  write("parts/e.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  EXPECT_EQ(answer("Merge \"parts/e.msh\";\n"), "accepted");
  EXPECT_THAT(answer("Include \"parts/b.geo\"; x = 1;\n"), HasSubstr("does not end its line"));
  write("body.geo.opt", "Mesh.Algorithm = 6;\nNonBlockingSystemCall \"touch x\";\n");
  EXPECT_THAT(answer("x = 1;\n"), HasSubstr("body.geo.opt:2: names the command NonBlocking"));
}

TEST_F(GmshScript, RefusesFilesElsewhere) {
  write("b.geo", "x = 1;\n");
  for (const char* name : {"../b.geo", "parts/../b.geo", "/b.geo", "\\b.geo", "x:b.geo", "~/b.geo",
                           " b.geo", "b.geo ", "$b.geo", "missing.geo", ""}) {
    for (const std::string word : {"Include", "Merge"}) {
      EXPECT_THAT(answer(word + " \"" + name + "\";\n"),
                  HasSubstr("body.geo:1: has " + word + " of no file in its folder or below"));
    }
  }
}

}  // namespace
}  // namespace perilink
