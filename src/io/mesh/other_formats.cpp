#include "io/mesh/other_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "io/case/case_words.hpp"

namespace perilink {
namespace {

std::string quoted_for_shell(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string file_for_shell(const std::string& path) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '/' || c == '.' || c == '_' || c == '-' || c == '+';
  };
  const bool plain = std::all_of(path.begin(), path.end(), is_plain) && !path.starts_with('-');
  return plain ? path : quoted_for_shell(path);
}

std::string renamed(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension().string() + ending;
}

/// How a mesh of another format becomes one of gmsh.
enum class Way { gmsh, gmsh_without_groups, gmsh_with_library, volume, geometry, none };

struct Format {
  std::string_view name;
  std::string_view endings;  ///< of file names, between blanks
  std::string_view begin;    ///< first bytes; empty: not told by them
  Way way;
};

/// gmsh 4.8 was tried on files of each that it reads.
constexpr std::array formats = {
    Format{"I-deas (.unv)", " .unv ", "    -1", Way::gmsh},
    Format{"gmsh, version 1", "", "$NOD", Way::gmsh},
    Format{"MED", " .med .mmed .rmed ", "", Way::gmsh_with_library},
    Format{"CGNS", " .cgns ", "", Way::gmsh_with_library},
    Format{"VTK", " .vtk ", "# vtk", Way::gmsh_without_groups},
    Format{"Nastran", " .bdf .nas ", "BEGIN BULK", Way::gmsh_without_groups},
    Format{"Medit", " .mesh .meshb ", "MeshVersionFormatted", Way::gmsh_without_groups},
    Format{"STL", " .stl ", "solid", Way::volume},
    Format{"STEP", "", "ISO-10303-21", Way::geometry},
    Format{"BREP", "", "DBRep_DrawableShape", Way::geometry},
    Format{"IGES", " .iges .igs ", "", Way::geometry},
    Format{"LS-DYNA", " .k .key ", "*KEYWORD", Way::none},
    Format{"Abaqus or CalculiX", " .inp ", "*", Way::none},
    Format{"Ansys", " .cdb ", "/PREP7", Way::none},
    Format{"Fluent", " .cas ", "(", Way::none},
    Format{"Exodus", " .e .exo .exii ", "CDF", Way::none},
    Format{"COMSOL", " .mphtxt ", "# Created by COMSOL", Way::none},
    Format{"VTK (XML)", " .vtu .vtp .pvtu ", "<VTKFile", Way::none},
    Format{"XDMF", " .xdmf .xmf ", "<?xml", Way::none},
    Format{"HDF5", " .h5 .hdf5 ", "\x89HDF", Way::none},
};

const Format* format_of(std::string_view bytes, const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  ending = " " + ending + " ";
  for (const Format& format : formats) {
    if (ending.size() > 2 && format.endings.find(ending) != std::string_view::npos) return &format;
  }
  for (const Format& format : formats) {
    if (!format.begin.empty() && bytes.starts_with(format.begin)) return &format;
  }
  return nullptr;
}

std::string advice_for(const Format& format, const std::string& path) {
  switch (format.way) {
    case Way::gmsh: return conversion_to_41(path);
    case Way::gmsh_without_groups:
      return "its groups are lost, so give boxes as regions; " + conversion_to_41(path);
    case Way::gmsh_with_library:
      return fmt::format("with a gmsh that was built with {}, ", format.name) +
             conversion_to_41(path);
    case Way::volume:
      return fmt::format(
          "it holds a surface; mesh its inside: write Merge \"{}\"; Surface Loop(1) = "
          "Surface{{:}}; Volume(1) = {{1}}; into a file body.geo beside it, and name body.geo",
          std::filesystem::path(path).filename().string());
    case Way::geometry: return "it is a geometry: give it as a .step or .brep file";
    case Way::none: break;
  }
  return "gmsh does not convert it. Save it as .unv, .med or .bdf, which gmsh converts, in the "
         "program that wrote it, or give the geometry as .step or .geo";
}

}  // namespace

std::string conversion_to_41(const std::string& path) {
  const std::string target = renamed(path, "_41.msh");
  return fmt::format("convert it, and name the new file: gmsh {} -save -format msh41 -o {}",
                     file_for_shell(path), file_for_shell(target));
}

std::string conversion_to_first_order(const std::string& path) {
  if (is_geometry(path)) return "delete Mesh.ElementOrder and SetOrder from the script";
  const std::string script =
      fmt::format("Merge \"{}\"; SetOrder 1; Mesh.MshFileVersion = 4.1; Save \"{}\";", path,
                  renamed(path, "_order1.msh"));
  return fmt::format("convert it, and name the new file: echo {} > order1.geo && gmsh order1.geo -",
                     quoted_for_shell(script));
}

FormatFault other_format(std::string_view bytes, const std::string& path) {
  const Format* format = format_of(bytes, path);
  if (format != nullptr) {
    return {fmt::format("is in the format of {}, not in gmsh's format 4.1", format->name),
            advice_for(*format, path)};
  }
  return {"does not begin with $MeshFormat, so it is no mesh of gmsh",
          "give a mesh of gmsh's format 4.1: gmsh FILE.geo -2 -format msh41 (-3 for solids)"};
}

}  // namespace perilink
