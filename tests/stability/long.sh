#!/bin/sh
# The long runs, which .ci/run keeps a subset of: sh tests/stability/long.sh [STEP...], all of them by default.
#   scenes       fifty thousand random scenes against GSL's adaptive integration, most with awkward fronts
#   rings        ten thousand tables of rings, with Prony series and with master curves, against GSL likewise
#   partial      PartialContact: the roots of ten thousand random scenes; estimates against brute force, of seven thousand
#                absurd scenes and on forty thousand points of tables
#   heat         two thousand random scenes that heat themselves, against a tolerance of 1e-11, and a thousand of master curves
#   gradients    slopes of mu on two thousand random scenes, against central differences
#   maps         friction maps of two hundred random scenes, and five checked on a million points each;
#                with heat those of measured scans
#   tests        the tests that take too long for every day: of Python, and a stranger's project that compiles the library
#   properties   the property tests on 2000 drawn examples each
#   isotherms    shift factors of 400 random sets of isotherms
#   coverage     how often bands on mu hold the truth, 200 of each kind of measured input; errors of fits
#   catalogue    every regime in which methods fail
#   files        mutated files of every kind
#   interrupts   Ctrl-C in single calls of 1e8 points and of 8192 x 8192 heights; wants 8 GB
#   fuzz         the reader of friction maps under libFuzzer, ten minutes
#   sanitize     the C++ tests under the address and undefined behaviour sanitizers, on a static and on a shared library
#   threads      the C++ tests under the thread sanitizer
#   memcheck     the C++ tests under valgrind
#   wine         the FMU's library for Windows in a host under Wine; wants wine64 and g++-mingw-w64-x86-64-posix
#   browser      the app, the report and the documentation, if it is built, in Chromium; wants Debian's chromium and asperity[browser]
#   permissive   the build without GSL and FFTW: its C++ tests, its wheel, spectra beside FFTW's; takes pocketfft's header
#                from a wheel that ships it where none is installed
#   aarch64      the C++ tests of a cross-built core under qemu, and which bits differ; not among all, wants Debian's cross compiler
# JOBS at once (1), with the python of PYTHON (.venv/bin/python). What each step ends with is said at the end.
set -u
cd "$(dirname "$0")/../.."
jobs=${JOBS:-1}
python=${PYTHON:-.venv/bin/python}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
failed=

built() { # PRESET [OPTION]: a preset's build, with its log
  { cmake --preset "$1" -DBUILD_SHARED_LIBS=OFF ${2:+"$2"} && cmake --build --preset "$1" -j "$jobs"; } >"$scratch/$1.log" 2>&1 || {
    tail -n 40 "$scratch/$1.log"
    return 1
  }
}

# A stranger's project is built by the usual runs.
ctests() { built "$@" && ctest --preset "$1" -j "$jobs" --exclude-regex 'consumer|install'; }

scenes() {
  "$python" tests/stability/random_scenes.py --scenes 9000 --seed 1 --tables 0 &&
    "$python" tests/stability/random_scenes.py --scenes 1000 --seed 2 --tables 0.5 &&
    "$python" tests/stability/random_scenes.py --scenes 40000 --seed 3 --tables 0.1 --edges 1 &&
    "$python" tests/stability/random_scenes.py --scenes 5000 --seed 4 --tables 0 --rings 1
}

rings() {
  "$python" tests/stability/random_scenes.py --scenes 4000 --seed 5 --tables 0 --rings 1 --curves 0.5 &&
    "$python" tests/stability/random_scenes.py --scenes 3000 --seed 6 --tables 0 --rings 1 --curves 1 &&
    "$python" tests/stability/random_scenes.py --scenes 3000 --seed 7 --tables 1 --rings 1 --curves 0.3
}

partial() {
  "$python" tests/stability/random_roots.py --scenes 10000 &&
    "$python" tests/stability/random_partial_tables.py --scenes 7100 --seed 11 --absurd 1 &&
    "$python" tests/stability/random_partial_tables.py --scenes 1500
}

heat() {
  "$python" tests/stability/random_heat.py --scenes 2000 --rings 0.1 &&
    "$python" tests/stability/random_heat.py --scenes 1000 --seed 3 --rings 0.5 --curves 1
}

gradients() { "$python" tests/stability/random_gradients.py --scenes 2000; }

maps() {
  "$python" tests/stability/random_maps.py --maps 200 &&
    "$python" tests/stability/random_maps.py --maps 5 --points 1000000 --tables 0 --seed 2 &&
    "$python" tests/stability/hot_maps.py
}

tests() {
  "$python" -m pytest -q -p no:cacheprovider -m long && built release && ctest --preset release --label-regex long
}

properties() { ASPERITY_HYPOTHESIS=long "$python" -m pytest -q -p no:cacheprovider tests/python/friction/test_properties.py; }

isotherms() { "$python" tests/stability/random_isotherms.py; }

coverage() {
  "$python" tests/stability/band_coverage.py && "$python" tests/stability/linear_bands.py &&
    "$python" tests/stability/standard_errors.py && "$python" tests/stability/fit_coverage.py
}

catalogue() { "$python" tests/stability/catalogue.py; }

files() { "$python" tests/stability/mutated_files.py; }

interrupts() { "$python" tests/stability/interrupts.py; }

fuzz() { sh tests/fuzz/run.sh build/fuzz; }

sanitize() { ctests sanitize && ctests sanitize -DBUILD_SHARED_LIBS=ON; }

threads() { ctests threads; }

# valgrind does not know AVX-512, which glibc picks for its string functions where the machine has it. It has an operator
# new of its own, and so has test_allocations.
memcheck() {
  built memcheck || return
  GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ
  export GLIBC_TUNABLES
  for test in build/memcheck/tests/test_*; do
    [ -f "$test" ] && [ -x "$test" ] && [ "${test##*/}" != test_allocations ] || continue
    echo "valgrind $test"
    valgrind --quiet --error-exitcode=1 --leak-check=full --errors-for-leak-kinds=definite "$test" || return
  done
}

# The test skips itself where something is missing, this does not.
wine() {
  [ -x /usr/lib/wine/wine64 ] || command -v wine64 >/dev/null || { echo 'wine64 is missing'; return 1; }
  command -v x86_64-w64-mingw32-gcc-posix >/dev/null || { echo 'g++-mingw-w64-x86-64-posix is missing'; return 1; }
  "$python" -c 'import sys; from asperity.fmu.export import platforms; sys.exit("x86_64-windows" not in platforms())' || {
    echo 'this asperity was built without the binary for Windows'
    return 1
  }
  "$python" -m pytest -q -p no:cacheprovider tests/python/fmu/test_hosts.py -k windows
}

browser() {
  [ -x /usr/bin/chromium ] || { echo 'chromium is missing'; return 1; }
  "$python" -c 'import playwright.sync_api, axe_playwright_python, nicegui, matplotlib' || return
  "$python" -m pytest -q -p no:cacheprovider -n0 tests/python/app/test_browser.py tests/python/report/test_report.py || return
  [ -f build/docs/html/index.html ] || { echo 'the documentation is not built: sh docs/build.sh'; return 0; }
  "$python" -m pytest -q -p no:cacheprovider -n0 -m long tests/python/project/test_site.py
}

permissive() {
  if ! printf '#include <pocketfft_hdronly.h>\n' | c++ -E -x c++ - >/dev/null 2>&1; then
    mkdir -p build/pocketfft &&
      "$python" -m pip download -q --no-deps -d "$scratch" mlx-cpu==0.32.4 &&
      "$python" -c 'import sys, zipfile; sys.stdout.buffer.write(
        zipfile.ZipFile(sys.argv[1]).read("mlx/include/mlx/3rdparty/pocketfft.h"))' \
        "$scratch"/mlx_cpu-*.whl >build/pocketfft/pocketfft_hdronly.h || return
    CMAKE_INCLUDE_PATH=$PWD/build/pocketfft
    export CMAKE_INCLUDE_PATH
  fi
  built permissive && ctest --preset permissive -j "$jobs" || return
  rm -rf build/permissive-site
  SKBUILD_BUILD_DIR=build/permissive-py "$python" -m pip install -q --no-deps --no-build-isolation \
    --target build/permissive-site -C cmake.define.ASPERITY_PERMISSIVE=ON . || return
  PYTHONPATH=$PWD/build/permissive-site "$python" -m pytest -q -p no:cacheprovider tests/python/spectrum \
    tests/python/surface tests/python/project/test_licence.py \
    tests/python/friction/test_permissive.py &&
    "$python" tests/stability/permissive.py build/permissive-site
}

aarch64() { JOBS=$jobs sh tests/stability/aarch64.sh; }

[ $# -gt 0 ] || set -- catalogue isotherms coverage scenes rings partial heat gradients maps tests properties files interrupts fuzz \
  sanitize threads memcheck wine browser permissive
for step; do
  case $step in
    catalogue | isotherms | coverage | scenes | rings | partial | heat | gradients | maps | tests | properties | files | interrupts | fuzz) ;;
    sanitize | threads | memcheck | wine | browser | permissive | aarch64) ;;
    *) sed -n '2,28s/^# //p' "$0" >&2; exit 2 ;;
  esac
done
for step; do
  printf '\n== %s\n' "$step"
  "$step" || failed="$failed $step"
done
if [ -n "$failed" ]; then printf '\n== failed:%s\n' "$failed"; else printf '\n== all went well\n'; fi
[ -z "$failed" ]
