# cmake -DFOLDER=src/app/report -DDYGRAPHS=program|style|licence -DOUT=FILE -P this file: writes the
# source that holds the texts of reports as literals.

cmake_minimum_required(VERSION 3.25)  # empty elements of lists count

# embed(RESULT FILES...): a literal of the files, one after the other; without files an empty one.
function(embed result)
  set(literal)
  foreach(file ${ARGN})
    file(READ "${file}" text)
    # The map of the minified program is not in the page, and browsers would look for it.
    string(REGEX REPLACE "(//# |/\\*# )sourceMappingURL=[^\n]*" "" text "${text}")
    string(APPEND literal "${text}\n")
  endforeach()
  set(${result} "R\"embedded(${literal})embedded\"" PARENT_SCOPE)
endfunction()

string(REPLACE "|" ";" dygraphs "${DYGRAPHS}")
list(GET dygraphs 0 library)
list(GET dygraphs 1 library_style)
list(GET dygraphs 2 licence)
embed(library ${library})
embed(library_style ${library_style})
embed(licence ${licence})
embed(style ${FOLDER}/report.css)
embed(script ${FOLDER}/data.js ${FOLDER}/curves.js ${FOLDER}/colors.js ${FOLDER}/plane.js
      ${FOLDER}/space.js ${FOLDER}/body.js ${FOLDER}/page.js)
file(WRITE "${OUT}" "// Made by src/write_report_assets.cmake.
#include \"app/report/report_assets.hpp\"

namespace perilink {

const ReportAssets& report_assets() {
  static const ReportAssets assets{
      ${style},
      ${script},
      ${library},
      ${library_style},
      ${licence}};
  return assets;
}

}  // namespace perilink
")
