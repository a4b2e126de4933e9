# Warnings, optimisation and instrumentation shared by every target of the project.
find_package(OpenMP REQUIRED COMPONENTS CXX)

add_library(perilink_options INTERFACE)
add_library(perilink::options ALIAS perilink_options)
target_link_libraries(perilink_options INTERFACE OpenMP::OpenMP_CXX)
target_compile_options(perilink_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlaps in std::string operator+ (PR 105651) and unset registers in its own AVX-512
  # headers (PR 105593) that are not there.
  -Wno-restrict -Wno-maybe-uninitialized
  $<$<BOOL:${PERILINK_WERROR}>:-Werror>
  # The same source gives the same rounding whatever the optimisation decides to fuse: a*b+c is
  # always fused where the processor can.
  -ffp-contract=fast)
if(PERILINK_NATIVE)
  target_compile_options(perilink_options INTERFACE -march=native)
endif()
if(PERILINK_SANITIZE)
  target_compile_options(perilink_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(perilink_options INTERFACE -fsanitize=address,undefined)
endif()
if(PERILINK_COVERAGE)
  target_compile_options(perilink_options INTERFACE --coverage)
  target_link_options(perilink_options INTERFACE --coverage)
endif()

# perilink_module(NAME DEPENDENCIES...): one static library per module, made of all sources of its
# folder, with the modules that it may include (tests/quality checks the includes themselves).
function(perilink_module name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_library(perilink_${name} STATIC ${sources})
  add_library(perilink::${name} ALIAS perilink_${name})
  target_include_directories(perilink_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  foreach(dependency ${ARGN})
    target_link_libraries(perilink_${name} PUBLIC perilink::${dependency})
  endforeach()
  target_link_libraries(perilink_${name} PUBLIC perilink::options)
endfunction()
