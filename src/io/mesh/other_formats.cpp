#include "io/mesh/other_formats.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <filesystem>

#include "io/case/case_words.hpp"

namespace perilink {
namespace {

// Advice: {0} is the conversion by gmsh, {1} the format, {2} the file.
constexpr const char* by_gmsh = "{0}";
constexpr const char* with_library = "with a gmsh that was built with {1}, {0}";
constexpr const char* without_groups = "its groups are lost, so give boxes as regions; {0}";
constexpr const char* inside =
    "it holds a surface; mesh its inside: write Merge \"{2}\"; Surface Loop(1) = Surface{{:}}; "
    "Volume(1) = {{1}}; into a file body.geo beside it, and name body.geo";
constexpr const char* geometry = "it is a geometry: give it as a .step or .brep file";
constexpr const char* not_by_gmsh =
    "gmsh does not convert it. Save it as .unv, .med or .bdf, which gmsh converts, in the program "
    "that wrote it, or give the geometry as .step or .geo";

struct Format {
  std::string_view name;
  std::string_view termination_names;  ///< file names end so; between blanks
  std::string_view begin;              ///< first bytes; empty: not told by them
  const char* advice;
};

constexpr std::array formats = {
    Format{"gmsh, version 1", "", "$NOD", by_gmsh},
    Format{"I-deas (.unv)", " .unv ", "    -1", by_gmsh},
    Format{"MED", " .med .mmed .rmed ", "", with_library},
    Format{"CGNS", " .cgns ", "", with_library},
    Format{"VTK", " .vtk ", "# vtk", without_groups},
    Format{"Nastran", " .bdf .nas ", "BEGIN BULK", without_groups},
    Format{"Medit", " .mesh .meshb ", "MeshVersionFormatted", without_groups},
    Format{"STL", " .stl ", "solid", inside},
    Format{"STEP", "", "ISO-10303-21", geometry},
    Format{"IGES", " .iges .igs ", "", geometry},
    Format{"LS-DYNA", " .k .key ", "*KEYWORD", not_by_gmsh},
    Format{"Abaqus or CalculiX", " .inp ", "*", not_by_gmsh},
    Format{"Ansys", " .cdb ", "/PREP7", not_by_gmsh},
    Format{"Fluent", " .cas ", "(", not_by_gmsh},
    Format{"VTK (XML)", " .vtu .vtp .pvtu ", "<VTKFile", not_by_gmsh},
};

}  // namespace

std::string conversion_to_41(const std::string& path) {
  return fmt::format(
      "convert it, and name the new file: gmsh \"{}\" -save -format msh41 -o \"{}_41.msh\"", path,
      std::filesystem::path(path).replace_extension().string());
}

std::string conversion_to_first_order(const std::string& path) {
  if (is_geometry(path)) return "delete Mesh.ElementOrder and SetOrder from the script";
  return fmt::format(
      "convert it, and name the new file: echo 'Merge \"{}\"; SetOrder 1; Mesh.MshFileVersion = "
      "4.1; Save \"{}_order1.msh\";' > order1.geo && gmsh order1.geo -",
      path, std::filesystem::path(path).replace_extension().string());
}

std::pair<std::string, std::string> other_format(std::string_view bytes, const std::string& path) {
  std::string termination = fmt::format(" {} ", std::filesystem::path(path).extension().string());
  for (char& c : termination) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const Format* found = nullptr;
  for (const Format& format : formats) {
    if (format.termination_names.find(termination) != std::string_view::npos) {
      found = &format;
      break;
    }
    const bool begins = !format.begin.empty() && bytes.starts_with(format.begin);
    if (begins && found == nullptr) found = &format;
  }
  if (found == nullptr) {
    return {"does not begin with $MeshFormat, so it is no mesh of gmsh",
            "give a mesh of gmsh's format 4.1: gmsh FILE.geo -2 -format msh41 (-3 for solids)"};
  }
  const std::string command = conversion_to_41(path),
                    file = std::filesystem::path(path).filename().string();
  return {fmt::format("is in the format of {}, not in gmsh's format 4.1", found->name),
          fmt::vformat(found->advice, fmt::make_format_args(command, found->name, file))};
}

}  // namespace perilink
