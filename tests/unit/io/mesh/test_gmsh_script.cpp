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
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string answer(const std::string& script) {
  try {
    check_gmsh_script(script + "\n", "body.geo");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string answer_of_file(const std::filesystem::path& path) {
  try {
    refuse_unsafe_geometry(path.string());
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GmshScript, RefusesWhatRunsCommandsOrWritesFiles) {
  for (const char* script : {
           "SystemCall \"touch x\";",
           "NonBlockingSystemCall \"touch x\";",
           "System \"touch x\";",
           "SystemCall(\"touch x\");",
           "/* a */ SystemCall // b\n \"touch x\";",
           "1e5SystemCall \"touch x\";",
           "s = \"touch x\"; SystemCall s;",
           "SystemCall StrCat(\"touch\", \" x\");",
           "SystemCall = 1; SystemCall \"touch x\";",
           "If (1) SystemCall 'touch x'; EndIf",
           "Macro Foo SystemCall \"touch x\"; Return Call Foo;",
           "S2N[\"SystemCall\"] \"touch x\";",
           "StringToName[StrCat(\"System\", \"Call\")] \"touch x\";",
           "OnelabRun(\"solver\", \"touch x\");",
           "OnelabRun \"touch x\";",
           "Printf(\"x\") > \"x\";",
           "Printf(\"%g\", 1) >> \"x\";",
           "Error(\"x\") > \"x\";",
           "x = \"x\"; Printf(\"x\")\n>\nx;",
           "Save \"x.msh\";",
           "Save View[0] \"x.pos\";",
           "Print \"x.png\";",
           "CreateDir \"x\";",
           "Exit;",
           "Exit 1;",
           "Plugin(NewView).Run;",
           "Plugin(MathEval).Run;",
           "Field[1] = ExternalProcess;",
           "Field[1] = Unheard;",
           "Field[newf] = ExternalProcess;",
           "General.ErrorFileName = \"x\";",
           "name = \"x\"; General.SessionFileName = name;",
           "Solver.Executable0 = \"x\";",
           "PostProcessing.Plugins = 1;",
           "SendToServer View[0] \"x\";",
           "x = GetEnv(\"HOME\");",
           "Later \"x\";",
           "Later = 1; Later \"x\";",
           "Later = 1; Later(\"x\");",
           "Later = 1; Later Str(\"x\");",
           "Later;",
           "Later{1};",
           "Include StrCat(\"a\", \".geo\");",
           "x = \"a\"; Merge x;",
       }) {
    EXPECT_THAT(answer(script), AllOf(HasSubstr("body.geo:"), HasSubstr("--trust-geometry")))
        << script;
  }
}

TEST(GmshScript, NamesLineAndDeed) {
  EXPECT_THAT(answer("Point(1) = {0, 0, 0};\n\"a\nb\";\nSystemCall \"touch x\";"),
              HasSubstr("body.geo:4: has SystemCall, which runs a command"));
  EXPECT_THAT(answer("\n// c\n/* d\n */ Printf(\"x\") > \"x\";"),
              HasSubstr("body.geo:4: Printf writes a file"));
}

/// gmsh's lexer would go another way than the one that looks at the script.
TEST(GmshScript, RefusesWhatGmshMayCutOtherwise) {
  for (const std::string& script :
       {std::string("// a\rSystemCall \"x\";\n"), std::string("// a\0b\n", 7),
        std::string("a = \"\0\";", 8), std::string("a = \"") + std::string(2000, 'b') + "\";",
        std::string("a = \"b"), std::string("/* a"), std::string("\x01")}) {
    EXPECT_THAT(answer(script), HasSubstr("mend the script"));
  }
  // A branch that is left out is searched for its end by a coarser lexer, which can lose a quote.
  EXPECT_THAT(answer("x = 1; If (0)\n x = \"E\"; y = \" SystemCall 'x'; \";\nEndIf"),
              HasSubstr("SystemCall in a text"));
  EXPECT_THAT(answer("E = 1; If (0)\n E = 2; // SystemCall 'x';\nEndIf"),
              HasSubstr("SystemCall in a text or comment"));
}

/// gmsh 4.8 takes the first statement of such a line only.
TEST(GmshScript, RefusesLastLinesOfSeveralStatementsWithoutAnEnd) {
  for (const char* script :
       {"x = 1;\nMesh 2; RefineMesh;", "Mesh 2; RefineMesh; // twice", "If (1) Mesh 2; EndIf"}) {
    try {
      check_gmsh_script(script, "body.geo");
      ADD_FAILURE() << script;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("ends without a line break"));
    }
    EXPECT_EQ(answer(script), "accepted") << script;
  }
  for (const char* script : {"x = 1; y = 2;\nMesh 2;", "Mesh 2; // twice",
                             "Extrude {0, 0, 1} { Surface{1}; Layers{3}; }", "x = 1; y = 2;\n "}) {
    EXPECT_NO_THROW(check_gmsh_script(script, "body.geo")) << script;
  }
}

/// Each of these ran a command or an unread file with gmsh 4.8, or comes close to one that did.
TEST(GmshScript, RefusesTextsThatMayBecomeCommands) {
  for (const char* script : {
           "If (0)\nx = \"EndIf\nInclude 'b.geo';\nIf (0)\";\nEndIf",
           "If (0)\nx = 'Else Foo ';\nEndIf",
           "If (0)\nx = 'x_ElseIf (1) Foo ';\nEndIf",
           "For i In {1:0}\nx = 'EndFor Foo';\nEndFor",
           "Macro Foo\nx = 'Return Foo';\nReturn",
           "Function Foo\n// Return Foo\nReturn",
           "If (0)\n/* EndIf */\nEndIf",
           "If (1) x = ' Merge y; '; EndIf",
           "If (1) x = ' MergeWithBoundingBox y; '; EndIf",
           "If (1) x = ' Open y; '; EndIf",
           "If (1) x = ' Print y; '; EndIf",
           "If (1) x = ' General.SessionFileName = y; '; EndIf",
           "If (1) x = ' Error (y) > y; '; EndIf",
           "For i In {0:1} x = \"\nFoo 'x';\n\";\nEndFor",
           "For i In {0:1} /*\nFoo 'x';\n*/\nEndFor",
           "Include 'a.geo'; x = \"\nFoo 'x';\n\";",
       }) {
    EXPECT_THAT(answer(script), AllOf(HasSubstr("text or comment"), HasSubstr("gmsh may run")))
        << script;
  }
  for (const char* script : {
           "/* Many\n lines */\nSetFactory(\"OpenCASCADE\"); // Warning: elsewhere\n"
           "For i In {0:1}\n/* more\n lines */\nx = i;\nEndFor // of i",
           "x = 1; /* EndIf\n Merge */",
       }) {
    EXPECT_EQ(answer(script), "accepted") << script;
  }
}

/// gmsh would look for some of these elsewhere: "\\a" and "x:a" are absolute to it.
TEST(GmshScript, RefusesNamesThatGmshMayResolveOtherwise) {
  for (const char* name :
       {"\\evil.geo", "a\\b.geo", "x:evil.geo", "x:/evil.geo", "~/b.geo", "$b.geo", " b.geo",
        "b.geo ", "/b.geo", "b\tc.geo", "b;c.geo", "b.geo.gz", ""}) {
    for (const char* word : {"Include", "Merge"}) {
      EXPECT_THAT(answer(std::string(word) + " \"" + name + "\";"),
                  AllOf(HasSubstr("body.geo:1"), HasSubstr("elsewhere")))
          << name;
    }
    EXPECT_THAT(answer_of_file(name), HasSubstr("elsewhere")) << name;
  }
}

/// The time for these grew with the square of their length: they would not end here.
TEST(GmshScript, LooksAtEachWordOnce) {
  std::string prints = "a = 1;\n";
  std::string chain = "a = 1; b = a";
  std::string closed = "a = 1;\n";
  for (int k = 0; k < 200000; ++k) {
    prints += "Printf(1)\n";
    chain += "[a]";
    closed += "Mesh ).a ";
  }
  EXPECT_EQ(answer(prints), "accepted");
  EXPECT_EQ(answer(chain), "accepted");
  EXPECT_THAT(answer(closed), HasSubstr("sets an option"));
  std::string nested = "a = 1; b = ";
  for (int k = 0; k < 1000; ++k) nested += "a[";
  EXPECT_THAT(answer(nested), HasSubstr("nests more than 100 brackets"));
}

TEST(GmshScript, AcceptsWhatDrawsAndMeshes) {
  for (const char* script : {
           "",
           "// SystemCall \"x\";\n/* Exit; */\nPoint(1) = {0, 0, 0, 1e-1};",
           "Physical Surface(\"SystemCall\") = {1};",
           "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n"
           "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };",
           "lc = 0.1; p[] = {}; For i In {1:3} p[] += newp; Point(p[i - 1]) = {i, 0, 0, lc}; "
           "EndFor",
           "DefineConstant[ h = {0.1, Name \"Parameters/h\", Min 0.01, Max 1, Step 0.1} ];",
           "Macro Foo\n p1 = newp; Point(p1) = {x, 0, 0}; Return\n x = 1; Call Foo;",
           "a~{1} = 2; b = a~{1} + Sqrt(2) > 1 ? Pi : -1;",
           "n = 10; Transfinite Curve {1} = n Using Progression 1.1; Transfinite Surface {1} Left;",
           "Field[1] = MathEval; Field[1].F = \"0.1 + x\"; Background Field = 1;",
           "Field[2] = Box; Field[2].VIn = 1; Field[3] = Max;",
           "Mesh.MeshSizeMin = 0.1; Geometry.OCCTargetUnit = \"M\"; General.Verbosity = 2;",
           "View \"sizes\" { ST(0, 0, 0, 1, 0, 0, 0, 1, 0){1, 2, 3}; };",
           "Printf(\"%g points\", 3); Mesh 2; Plugin(Crack).Dimension = 1; Plugin(Crack).Run;",
           "Extrude {0, 0, 1} { Surface{1}; Layers{ {8, 2}, {0.5, 1} }; Recombine; }",
           "Physical Curve(\"rim\") = Boundary{ Surface{1}; };\nCoherence;\n",
           "If (Exists(h))\n a = 1; // 5 system parts (print)\nElseIf (1 >= 2)\n a = 2;\nElse\n"
           " a = 3;\nEndIf",
       }) {
    EXPECT_EQ(answer(script), "accepted") << script;
  }
}

TEST(GmshScript, NamesTheFilesThatItReads) {
  EXPECT_THAT(check_gmsh_script("Include \"a.geo\"; Merge 'b/c.step';\n", "m.geo"),
              ElementsAre("a.geo", "b/c.step"));
  EXPECT_THAT(check_gmsh_script("ShapeFromFile(\"a.brep\");", "m.geo"), IsEmpty());
}

TEST(GmshScript, AcceptsTheGeometriesOfTheProject) {
  const std::filesystem::path meshes(PERILINK_SOURCE_DIR "/meshes");
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(meshes)) {
    if (entry.path().extension() != ".geo") continue;
    EXPECT_EQ(answer_of_file(entry.path()), "accepted");
    ++count;
  }
  EXPECT_GT(count, 5);
}

class GmshScriptFiles : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((directory_ / name).parent_path());
    test::write_text(directory_ / name, text + "\n");
  }
  std::string answer(const std::string& name) const { return answer_of_file(directory_ / name); }

  test::TemporaryDirectory directory_;
};

TEST_F(GmshScriptFiles, LooksIntoIncludedFiles) {
  write("a.geo", "Include \"parts/b.geo\";\nx = 1;\n");
  write("parts/b.geo", "Merge \"c.txt\";\n");
  write("parts/c.txt", "y = x;\nSave \"d.msh\";\n");
  EXPECT_THAT(answer("a.geo"), HasSubstr("c.txt:2: has Save"));
  write("parts/c.txt", "y = x; Include \"../a.geo\";\n");
  EXPECT_EQ(answer("a.geo"), "accepted") << "names of the other files count, circles end";
  std::filesystem::remove(directory_ / "parts/c.txt");
  EXPECT_THAT(answer("a.geo"), AllOf(HasSubstr("b.geo"), HasSubstr("cannot be read")));
}

/// gmsh 4.8 runs as scripts: "part.Step", "part.BREP", and meshes without their first line.
TEST_F(GmshScriptFiles, TakesForDataWhatGmshDoes) {
  const std::string bad = "SystemCall \"touch x\";\n";
  for (const char* name : {"part.step", "part.STP", "part.brep", "part.stl"}) {
    write(name, bad);
    EXPECT_EQ(answer(name), "accepted") << name;
  }
  for (const char* name : {"part.Step", "part.Stp", "part.BREP"}) {
    write(name, bad);
    EXPECT_THAT(answer(name), AllOf(HasSubstr("reads as a script"), HasSubstr("rename")));
  }
  write("a.geo", "Merge \"b.msh\";");
  write("b.msh", "$MeshFormat\n" + bad);
  EXPECT_EQ(answer("a.geo"), "accepted");
  write("a.geo", "Merge \"b.stl\"; Merge \"b.geo\";");
  write("b.geo", bad);
  std::filesystem::create_symlink("b.geo", directory_ / "b.stl");
  EXPECT_THAT(answer("a.geo"), HasSubstr("b.geo:1: has SystemCall"));
  write("a.geo", "Merge \"b.msh\";");
  write("b.msh", bad);
  EXPECT_THAT(answer("a.geo"), HasSubstr("b.msh:1: has SystemCall"));
}

/// Include runs any file as a script, Merge only some.
TEST_F(GmshScriptFiles, LooksIntoIncludedDataToo) {
  write("a.geo", "Merge \"b.step\"; Include \"b.step\";");
  write("b.step", "SystemCall \"touch x\";\n");
  EXPECT_NE(answer("a.geo"), "accepted");
  write("a.geo", "Include \"b.msh\";");
  write("b.msh", "$MeshFormat\n");
  EXPECT_NE(answer("a.geo"), "accepted");
}

TEST_F(GmshScriptFiles, FollowsLinksOfFoldersBeforeTheFolderAbove) {
  write("a.geo", "Include \"b.geo\"; Include \"link/../b.geo\";");
  write("b.geo", "x = 1;\n");
  write("far/b.geo", "SystemCall \"touch x\";\n");
  std::filesystem::create_directories(directory_ / "far/deep");
  std::filesystem::create_directory_symlink("far/deep", directory_ / "link");
  EXPECT_THAT(answer("a.geo"), HasSubstr("b.geo:1: has SystemCall"));
}

TEST_F(GmshScriptFiles, LooksAtTheOptionsThatGmshReadsBesideAGeometry) {
  write("a.geo", "x = 1;\n");
  write("a.geo.opt", "Mesh.Algorithm = 6;\nNonBlockingSystemCall \"touch x\";\n");
  EXPECT_THAT(answer("a.geo"), HasSubstr("a.geo.opt:2: has NonBlockingSystemCall"));
}

}  // namespace
}  // namespace perilink
