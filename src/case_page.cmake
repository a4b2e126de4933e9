# Headings and tables of docs/case_file.md as a literal, for `perilink schema`.
# cmake -DPAGE=FILE -DOUT=FILE -P this file writes it; the build does that when the page changes.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ "${PAGE}" text)
  string(REGEX REPLACE "\n[^#|\n][^\n]*" "" text "${text}")
  file(WRITE "${OUT}" "namespace perilink {

extern const char* const case_page;
const char* const case_page = R\"page(${text})page\";

}  // namespace perilink
")
  return()
endif()

set(case_page ${CMAKE_CURRENT_BINARY_DIR}/case_page_text.cpp)
add_custom_command(
  OUTPUT ${case_page}
  COMMAND ${CMAKE_COMMAND} "-DPAGE=${PROJECT_SOURCE_DIR}/docs/case_file.md" "-DOUT=${case_page}"
          -P ${CMAKE_CURRENT_SOURCE_DIR}/case_page.cmake
  DEPENDS ${PROJECT_SOURCE_DIR}/docs/case_file.md case_page.cmake
  VERBATIM)
target_sources(perilink_io PRIVATE ${case_page})
set_source_files_properties(${case_page} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
