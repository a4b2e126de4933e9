#!/bin/sh
# Fuzzes the case reader.   tests/fuzz/run.sh [SECONDS] [BUILD_DIR]
#
# Needs clang++ with its runtime (Debian: clang libclang-rt-14-dev). With `replay` in place of the
# seconds it builds with the default compiler and runs the seeds and the malformed cases once.
# New inputs are kept in BUILD_DIR/found; crashes are written to BUILD_DIR.
set -eu
seconds=${1:-300}
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/fuzz}
mkdir -p "$build/found"

sources="$root/tests/fuzz/fuzz_case.cpp $root/src/base/error.cpp"
for source in "$root"/src/io/case_*.cpp "$root"/src/io/toml_*.cpp; do
  sources="$sources $source"
done
flags="-std=c++20 -g -O1 -fno-omit-frame-pointer -I$root/src"
cd "$build"

if [ "$seconds" = replay ]; then
  # shellcheck disable=SC2086
  ${CXX:-g++} $flags -fsanitize=address,undefined -fno-sanitize-recover=all \
    $sources "$root/tests/fuzz/replay.cpp" -lfmt -o replay_case
  exec ./replay_case "$root"/tests/fuzz/corpus/* "$root"/tests/cli/malformed/*.toml \
    "$root"/meshes/*.toml
fi

# shellcheck disable=SC2086
${CLANGXX:-clang++} $flags -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
  $sources -lfmt -o fuzz_case
exec ./fuzz_case -max_total_time="$seconds" -max_len=8192 -timeout=10 -rss_limit_mb=2048 \
  -dict="$root/tests/fuzz/case.dict" -print_final_stats=1 \
  found "$root/tests/fuzz/corpus" "$root/tests/cli/malformed" "$root/meshes"
