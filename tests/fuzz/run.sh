#!/bin/sh
# Fuzzes the reader of friction maps with libFuzzer, in a directory where program, seeds and corpus stay:
#
#   sh tests/fuzz/run.sh DIRECTORY [libFuzzer's options; -max_total_time=600, ten minutes, where there is none]
#
# or `cmake --build build/dev --target fuzz`. CLANG names another clang++. Exit 77: there is none with libFuzzer.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
directory=$1
shift
clang=${CLANG:-clang++}
mkdir -p "$directory/seeds" "$directory/corpus"
cd "$directory"

command -v "$clang" >/dev/null || {
  echo "skipped: no $clang"
  exit 77
}
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' >probe.cpp
"$clang" -fsanitize=fuzzer,address,undefined probe.cpp -o probe 2>/dev/null || {
  echo "skipped: $clang has no libFuzzer"
  exit 77
}

build() {
  "$clang" -std=c++17 -g -O2 -fno-sanitize-recover=all -Wall -Wextra -Wpedantic -Werror \
    -I "$here/../../cpp/include" "$here/fuzz_friction_map.cpp" "$@"
}
build -DSEEDS -o seed
./seed seeds
build -fsanitize=fuzzer,address,undefined,float-cast-overflow -o fuzz
[ $# -gt 0 ] || set -- -max_total_time=600
exec ./fuzz -print_final_stats=1 -verbosity=1 "$@" corpus seeds
