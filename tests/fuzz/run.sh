#!/bin/sh
# Fuzzes the readers of cases and meshes.   tests/fuzz/run.sh [SECONDS] [BUILD_DIR] [case|mesh]
#
# Needs clang++ with its runtime (Debian: clang libclang-rt-14-dev). With `replay` in place of the
# seconds it builds with the default compiler and runs the seeds and the malformed cases once.
# New inputs are kept in BUILD_DIR/found_TARGET; crashes are written to BUILD_DIR.
set -eu
seconds=${1:-300}
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/fuzz}
target=${3:-case}
libraries=-lfmt
mkdir -p "$build/found_$target"
build=$(cd "$build" && pwd)

src=$root/src
case $target in
  case)
    sources=$(ls "$src"/io/case/case_*.cpp "$src"/io/case/sections/*.cpp "$src"/io/text/toml_*.cpp \
                 "$src"/io/text/formula.cpp "$src"/io/text/input_text.cpp)
    libraries="-lfmt -lmuparser"
    ${CXX:-g++} -std=c++20 -I"$root/tests" -DPERILINK_SOURCE_DIR="\"$root\"" \
      "$root/tests/fuzz/expand_cases.cpp" -o "$build/expand_cases"
    rm -rf "$build/malformed"
    "$build/expand_cases" "$build/malformed"
    bases=$root/tests/cli/malformed/bases
    seeds="$root/tests/fuzz/corpus $build/malformed $bases $root/meshes"
    replayed="$root/tests/fuzz/corpus/* $build/malformed/* $bases/* $root/meshes/*.toml"
    options="-max_len=8192 -dict=$root/tests/fuzz/case.dict" ;;
  mesh)
    sources="$(ls "$src"/io/text/toml_*.cpp "$src"/discretization/meshes/mesh_*.cpp)
             $(ls "$src"/io/mesh/*.cpp | grep -v gmsh_mesher)"
    for name in mesh_faces facet_geometry facets region neighbor_search; do
      sources="$sources $src/discretization/$name.cpp"
    done
    seeds=$root/tests/fuzz/corpus_mesh
    replayed="$root/tests/fuzz/corpus_mesh/* $root/meshes/*.msh"
    options="-max_len=4096" ;;
  *) echo "the target is case or mesh, not $target" >&2; exit 2 ;;
esac
for name in error files memory plain_text; do
  sources="$src/base/$name.cpp $sources"
done
sources="$root/tests/fuzz/fuzz_$target.cpp $sources"
flags="-std=c++20 -g -O1 -fno-omit-frame-pointer -I$src"
cd "$build"

# shellcheck disable=SC2086
if [ "$seconds" = replay ]; then
  ${CXX:-g++} $flags -fsanitize=address,undefined -fno-sanitize-recover=all \
    $sources "$root/tests/fuzz/replay.cpp" $libraries -o "replay_$target"
  exec "./replay_$target" $replayed
fi

# shellcheck disable=SC2086
${CLANGXX:-clang++} $flags -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
  $sources $libraries -o "fuzz_$target"
# shellcheck disable=SC2086
exec "./fuzz_$target" -max_total_time="$seconds" $options -timeout=10 -rss_limit_mb=2048 \
  -print_final_stats=1 "found_$target" $seeds
