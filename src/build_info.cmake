# What the program tells about itself (perilink --version): its commit and the libraries it is built
# with. Everything here is found when the build is configured.

# perilink_header_version(RESULT HEADER MACRO...): "3.0.14" from the #define lines of a header.
function(perilink_header_version result header)
  set(parts)
  foreach(macro ${ARGN})
    file(STRINGS ${header} line REGEX "^#define[ \t]+${macro}[ \t]+[0-9]+" LIMIT_COUNT 1)
    string(REGEX MATCH "[0-9]+$" part "${line}")
    list(APPEND parts ${part})
  endforeach()
  list(JOIN parts "." version)
  set(${result} ${version} PARENT_SCOPE)
endfunction()

perilink_header_version(PERILINK_CHOLMOD_VERSION ${SUITESPARSE_INCLUDE_DIR}/cholmod_core.h
                        CHOLMOD_MAIN_VERSION CHOLMOD_SUB_VERSION CHOLMOD_SUBSUB_VERSION)
perilink_header_version(PERILINK_METIS_VERSION ${METIS_INCLUDE_DIR}/metis.h
                        METIS_VER_MAJOR METIS_VER_MINOR METIS_VER_SUBMINOR)

# Optional backends. MPI is linked to perilink-mpi alone: it would double the start-up time.
set(PERILINK_MPI_SUMMARY "no")
set(PERILINK_GMSH_SUMMARY "no")
if(PERILINK_HAS_MPI)
  set(PERILINK_MPI_SUMMARY "yes, ${MPI_CXX_VERSION} in perilink-mpi")
endif()
if(PERILINK_HAS_GMSH)
  perilink_header_version(gmsh_version ${GMSH_INCLUDE_DIR}/gmshc.h
                          GMSH_API_VERSION_MAJOR GMSH_API_VERSION_MINOR GMSH_API_VERSION_PATCH)
  set(PERILINK_GMSH_SUMMARY "${gmsh_version}, loaded when a geometry is meshed")
endif()

set(PERILINK_COMMIT "unknown")
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short=12 HEAD
                  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE commit
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(PERILINK_COMMIT ${commit})
  endif()
endif()

set(PERILINK_INSTRUCTIONS "portable")
if(PERILINK_NATIVE)
  set(PERILINK_INSTRUCTIONS "native")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/base/build_config.hpp.in
               ${CMAKE_CURRENT_BINARY_DIR}/base/build_config.hpp @ONLY)
target_include_directories(perilink_base PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
