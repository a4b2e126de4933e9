# What perilink report puts into its pages: src/app/report/*.js and *.css, and dygraphs as the system
# has it. The build makes one source with these texts. Without dygraphs the command refuses to work.
find_file(PERILINK_DYGRAPHS dygraph.min.js
          PATHS /usr/share/javascript/dygraphs /usr/share/nodejs/dygraphs/dist NO_DEFAULT_PATH)
find_file(PERILINK_DYGRAPHS_STYLE dygraph.min.css
          PATHS /usr/share/javascript/dygraphs /usr/share/nodejs/dygraphs/dist NO_DEFAULT_PATH)
find_file(PERILINK_DYGRAPHS_LICENCE copyright
          PATHS /usr/share/doc/libjs-dygraphs /usr/share/doc/node-dygraphs NO_DEFAULT_PATH)
set(dygraphs "${PERILINK_DYGRAPHS}|${PERILINK_DYGRAPHS_STYLE}|${PERILINK_DYGRAPHS_LICENCE}")
if(dygraphs MATCHES "NOTFOUND")
  set(dygraphs "||")
  message(STATUS "perilink report will not work: dygraphs is missing (Debian: libjs-dygraphs)")
endif()
string(REPLACE "|" ";" dygraphs_files "${dygraphs}")

set(report_source ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp)
set(report_folder ${CMAKE_CURRENT_SOURCE_DIR}/app/report)
file(GLOB report_texts CONFIGURE_DEPENDS ${report_folder}/*.js ${report_folder}/*.css)
list(REMOVE_ITEM dygraphs_files "")
add_custom_command(
  OUTPUT ${report_source}
  COMMAND ${CMAKE_COMMAND} "-DFOLDER=${report_folder}" "-DDYGRAPHS=${dygraphs}"
          "-DOUT=${report_source}" -P ${CMAKE_CURRENT_SOURCE_DIR}/write_report_assets.cmake
  DEPENDS ${report_texts} ${dygraphs_files} write_report_assets.cmake
  VERBATIM)
target_sources(perilink_app PRIVATE ${report_source})
set_source_files_properties(${report_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
