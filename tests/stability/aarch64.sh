#!/bin/sh
# The core for Linux on aarch64, cross-built, its tests under qemu, and which bits differ from those of this machine.
# tools/aarch64.cmake names the packages. JOBS at once (1).
set -eu
cd "$(dirname "$0")/../.."
jobs=${JOBS:-1}
there=build/aarch64
here=build/release
cmake -S . -B $there -G Ninja -DCMAKE_TOOLCHAIN_FILE=tools/aarch64.cmake -DCMAKE_BUILD_TYPE=Release -DASPERITY_TESTS=ON
cmake --build $there -j "$jobs"
# strangers' projects have compilers of their own, and the fuzzer and valgrind's kin know no other processor
ctest --test-dir $there --output-on-failure --no-tests=error -j "$jobs" --exclude-regex 'consumer|install|header|fuzz|symbols'

# Debian installs one libgsl-dev at a time: that of this machine's processor is unpacked where only that of arm64 is
libraries=usr/lib/$(uname -m)-linux-gnu
if [ ! -e "/$libraries/libgsl.a" ]; then
  rm -rf build/gsl && mkdir -p build/gsl
  (cd build/gsl && apt-get download "libgsl-dev:$(dpkg --print-architecture)" && dpkg-deb -x ./*.deb .)
  set -- -DCMAKE_LIBRARY_PATH="$PWD/build/gsl/$libraries"
fi
cmake --preset release -DASPERITY_TESTS=OFF "$@"
cmake --build --preset release -j "$jobs" --target asperity
printed() { # COMPILER BUILD RUNNER...: what tests/stability/bits.cpp prints
  compiler=$1 build=$2
  shift 2
  $compiler -std=c++20 -O2 -Icpp/include -I"$build/cpp/include" tests/stability/bits.cpp \
    "$build/cpp/libasperity.a" -lm -o "$build/bits"
  "$@" "$build/bits"
}
printed aarch64-linux-gnu-g++ $there qemu-aarch64 >$there/bits.txt
printed "${CXX:-c++}" $here env >$here/bits.txt
python3 - $there/bits.txt $here/bits.txt <<'END'
import sys

numbers = []
for path in sys.argv[1:]:
    with open(path) as file:
        numbers.append([float.fromhex(word) for line in file for word in line.split()[2:]])
one, other = numbers
assert len(one) == len(other) > 400
apart = [abs(a / b - 1) if a != b else 0.0 for a, b in zip(one, other)]
differ = sum(a > 0 for a in apart)
print(f"bits: {differ} of {len(one)} numbers differ from this machine's, by {max(apart):.1e} at most")
sys.exit(max(apart) > 1e-12)
END
