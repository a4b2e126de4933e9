# Warnings, optimisation and instrumentation shared by every target of the project.
find_package(OpenMP REQUIRED COMPONENTS CXX)
include(GNUInstallDirs)

set(PERILINK_WARNINGS_ARE_ERRORS ${PERILINK_WERROR})
if(PERILINK_WERROR STREQUAL "AUTO")  # other compilers have warnings of their own
  string(REGEX MATCH "^GNU12[.]" PERILINK_WARNINGS_ARE_ERRORS
         "${CMAKE_CXX_COMPILER_ID}${CMAKE_CXX_COMPILER_VERSION}")
endif()

add_library(perilink_options INTERFACE)
add_library(perilink::options ALIAS perilink_options)
target_link_libraries(perilink_options INTERFACE OpenMP::OpenMP_CXX)
# Sums of matrices are to be those of one thread (docs/decisions/0004).
target_compile_definitions(perilink_options INTERFACE EIGEN_DONT_PARALLELIZE)
# Projects that use the installed library choose their own warnings.
set(warnings
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
  # In files that are compiled as one, helpers of others would count as shadowed by local names.
  $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,-Wshadow=local,-Wshadow>
  # GCC 12 sees overlaps and overflows in std::string operator+ that are not there (PR 105651).
  -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow
  -Wno-psabi     # wide vectors without AVX-512 (docs/decisions/0005)
  $<$<BOOL:${PERILINK_WARNINGS_ARE_ERRORS}>:-Werror>)
target_compile_options(perilink_options INTERFACE "$<BUILD_INTERFACE:${warnings}>"
  # The same source gives the same rounding whatever the optimisation decides to fuse: a*b+c is
  # always fused where the processor can.
  -ffp-contract=fast
  # GCC collects garbage from 800 MB on, not from 260 MB: a tenth less time to compile.
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=400000>>
  # No other library replaces a function of ours: position-independent code inlines as the program.
  -fno-semantic-interposition -fvisibility-inlines-hidden)
target_compile_features(perilink_options INTERFACE cxx_std_20)
if(PERILINK_SANITIZE)
  # Together with the checks of the standard library and of Eigen: an element past the end of a vector
  # is no error to the sanitizers where the memory behind it is the vector's own.
  target_compile_options(perilink_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g
    -D_GLIBCXX_ASSERTIONS -UNDEBUG)
  target_link_options(perilink_options INTERFACE -fsanitize=address,undefined)
endif()
if(PERILINK_COVERAGE)
  target_compile_options(perilink_options INTERFACE --coverage)
  target_link_options(perilink_options INTERFACE --coverage)
endif()

# perilink_module(NAME DEPENDENCIES...): one static library per module, made of all sources below its
# folder, with the modules that it may include (tests/quality checks the includes themselves).
function(perilink_module name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_library(perilink_${name} STATIC ${sources})
  add_library(perilink::${name} ALIAS perilink_${name})
  # It also goes into shared libraries, as that of Python.
  set_target_properties(perilink_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(perilink_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/perilink>)
  set_property(GLOBAL APPEND PROPERTY PERILINK_MODULES ${name})
  foreach(dependency ${ARGN})
    target_link_libraries(perilink_${name} PUBLIC perilink::${dependency})
  endforeach()
  target_link_libraries(perilink_${name} PUBLIC perilink::options)
endfunction()

# perilink_hot_sources(FILES...): the few files whose loops decide the run time get every instruction
# of this machine. Not the whole program: GCC 12.2 with AVX-512 miscompiles copies of constant tables
# ({1, 1, 1, 0, 0, 1} arrives as 1 1 1 1 0 1), and -mstore-max=128 is what keeps it from that here.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag("-march=native -mstore-max=128" PERILINK_HAS_STORE_MAX)
function(perilink_hot_sources)
  # Each is compiled by itself, with these instructions or without.
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                              SKIP_PRECOMPILE_HEADERS ON)
  if(NOT PERILINK_NATIVE)
    return()
  endif()
  set(options -march=native)
  if(PERILINK_HAS_STORE_MAX)
    list(APPEND options -mstore-max=128)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()

# perilink_reuse_headers(NAME OPTIONS TARGETS...): reads the headers of the libraries that most files
# include from one precompiled file NAME. Parsing them takes three seconds of CPU, a third of the time
# of a file. GCC takes the optimisation of that file, whatever a target's own options say, so its
# OPTIONS are those of the targets.
function(perilink_reuse_headers name options)
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${name} PRIVATE perilink::options fmt::fmt Eigen3::Eigen)
  target_compile_options(${name} PRIVATE ${options})
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string>
    <string_view> <vector> <Eigen/Dense> <Eigen/SparseCore> <fmt/format.h>)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM ${name})
    target_compile_options(${target} PRIVATE ${options})
  endforeach()
endfunction()
