#!/bin/sh
# Installs what is missing and runs the demo or all tests. Everything but the system's packages stays in this folder.
set -eu

usage() {
  cat >&2 <<'END'
usage: sh bootstrap.sh demo    friction of a rubber on a shipped asphalt scan: a table and a picture
       sh bootstrap.sh test    the C++ tests, the Python tests and the checkers
exit:  0 all went well, 1 something failed, 2 wrong usage, 3 packages are missing and cannot be installed
END
  exit 2
}

say() { printf '\n== %s\n' "$*"; }

compiler=${CXX:-c++}
python=python3

# --- what is there, asked of the tools themselves: a library need not come from a package ---

has_python() { "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; }

has_venv() { "$python" -c 'import ensurepip, venv' 2>/dev/null; }

has_python_header() {
  "$python" -c '
import os, sys, sysconfig
sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))' 2>/dev/null
}

has_cmake() {
  cmake --version 2>/dev/null | awk '
    NR == 1 { split($3, v, "."); found = v[1] > 3 || (v[1] == 3 && v[2] >= 25) } END { exit !found }'
}

has_compiler() { printf 'int main() {}\n' | "$compiler" -std=c++20 -x c++ -o /dev/null - 2>/dev/null; }

# has_library HEADER [ARCHIVE...]: the header is found, and the static libraries can be linked.
has_library() (
  printf '#if !__has_include(<%s>)\n#error missing\n#endif\nint main() {}\n' "$1" >"$scratch/probe.cpp"
  shift
  for archive; do
    set -- "$@" "-l:$archive"
    shift
  done
  "$compiler" -std=c++20 -I/usr/include/eigen3 -I/usr/local/include/eigen3 \
    -o "$scratch/probe" "$scratch/probe.cpp" "$@" 2>/dev/null
)

# Debian's names of what `verb` needs and is not there.
missing_packages() {
  has_python || echo python3
  has_venv || echo python3-venv
  has_python_header || echo python3-dev
  has_compiler || echo g++
  has_cmake || echo cmake
  command -v ninja >/dev/null || echo ninja-build
  has_library Eigen/Core || echo libeigen3-dev
  has_library gsl/gsl_integration.h libgsl.a libgslcblas.a || echo libgsl-dev
  has_library fftw3.h libfftw3.a || echo libfftw3-dev
  [ "$verb" = demo ] || has_library doctest/doctest.h || echo doctest-dev
}

# --- installing it ---

may_be_root() {
  [ "$(id -u)" = 0 ] && return
  command -v sudo >/dev/null || return
  sudo -n true 2>/dev/null && return
  [ -t 0 ] && sudo -v
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

refuse() {
  {
    printf '\n%s These packages (by their names on Debian) are needed and were not found:\n\n' "$1"
    echo "$missing" | sed 's/^/  /'
    printf '\nAsk an administrator for:\n\n  apt-get install %s\n\n' "$(echo "$missing" | paste -sd ' ' -)"
  } >&2
  exit 3
}

install_packages() {
  missing=$(missing_packages)
  [ -n "$missing" ] || return 0
  command -v apt-get >/dev/null || refuse 'There is no apt here.'
  may_be_root || refuse 'This user may not install packages.'
  # shellcheck disable=SC2086 # a list of words
  say "installing" $missing
  # A list that could not be refreshed may still be good enough: the next line tells.
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q || true
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends $missing </dev/null ||
    refuse 'apt-get failed.'
  missing=$(missing_packages)
  [ -z "$missing" ] || refuse 'They are installed, but not where this python3 and this compiler look.'
}

# Untried. Homebrew has archives of GSL and FFTW too; asperity itself is a shared library there.
install_on_macos() {
  command -v brew >/dev/null || {
    echo 'Homebrew is needed: https://brew.sh' >&2
    exit 3
  }
  for formula in cmake ninja eigen gsl fftw doctest; do
    brew list --versions "$formula" >/dev/null || brew install "$formula"
  done
  has_python || brew install python
  CMAKE_ARGS="${CMAKE_ARGS:-} -DBUILD_SHARED_LIBS=ON" # read by the Python build
  export CMAKE_ARGS
}

# --- the Python package ---

# Into .venv, with the build's own needs beside it: a build folder that stays makes the second run quick.
install_package() { # EXTRA [PIP OPTION...]
  extra=$1
  shift
  say "Python package: .venv"
  .venv/bin/python -m pip --version >/dev/null 2>&1 || "$python" -m venv --clear .venv
  .venv/bin/python -c '
import tomllib
with open("pyproject.toml", "rb") as file:
    print(*tomllib.load(file)["build-system"]["requires"], sep="\n")' >"$scratch/requires.txt"
  .venv/bin/python -m pip install -q -r "$scratch/requires.txt"
  files=$(find cpp/src python/bindings -name '*.cpp' | wc -l)
  say "compiling $files files: a minute and a half on two cores the first time"
  tell_progress "$files" &
  teller=$!
  SKBUILD_BUILD_DIR='build/{wheel_tag}' CMAKE_BUILD_PARALLEL_LEVEL=$jobs \
    .venv/bin/python -m pip install -q --no-build-isolation "$@" ".[$extra]"
  stop_telling
}

# How many of so many files have been compiled since this began: pip keeps the compiler's own words to itself. A terminal
# has one line that changes, a file a line every ten files.
tell_progress() { # FILES
  trap - EXIT
  told=0
  while sleep 1; do
    compiled=$(find build -name '*.cpp.o' -newer "$scratch/requires.txt" 2>/dev/null | wc -l)
    if [ -t 1 ]; then
      [ "$compiled" = "$told" ] || printf '\r   %s of %s' "$compiled" "$1"
      told=$compiled
    elif [ "$compiled" -ge $((told + 10)) ]; then
      printf '   %s of %s\n' "$compiled" "$1"
      told=$compiled
    fi
  done
}

stop_telling() {
  [ -z "$teller" ] || kill "$teller" 2>/dev/null || true
  [ ! -t 1 ] || [ -z "$teller" ] || printf '\n'
  teller=
}

demo() {
  install_package plot
  say "asperity demo"
  .venv/bin/asperity demo --force --output "$PWD/asperity-demo"
  echo 'next:    .venv/bin/asperity friction asperity-demo/scene.toml --plot mine.png'
}

# --- the tests ---

# keep LOG COMMAND...: runs it, shows what it prints and keeps that too.
keep() {
  log=$1
  shift
  { "$@" 2>&1 && echo 0 >"$log.status" || echo "$?" >"$log.status"; } | tee "$log"
  return "$(cat "$log.status")"
}

# check NAME COMMAND...: runs it; a failure is remembered and the next check still done.
check() {
  name=$1
  shift
  say "$name"
  "$@" || failed="$failed $name"
}

format_check() { find cpp python tests \( -name '*.[ch]pp' -o -name '*.inc' \) -exec clang-format --dry-run --Werror {} +; }

tests() {
  failed=
  # The core is compiled once: the C++ tests link what is installed.
  install_package test -C cmake.define.ASPERITY_TESTS=ON -C 'build.targets=_core;asperity_fmu;all'
  built=$(ls -t build/cp*/CMakeInit.txt | head -n 1)
  check ctest keep "$scratch/ctest.log" ctest --test-dir "${built%/*}" --output-on-failure --label-exclude long -j "$jobs"
  check ruff .venv/bin/ruff check
  check "ruff's layout" .venv/bin/ruff format --check
  check mypy .venv/bin/mypy
  if command -v clang-format >/dev/null; then
    check clang-format format_check
  fi
  check pytest keep "$scratch/pytest.log" .venv/bin/pytest --numprocesses auto
  say "${failed:+failed:$failed; }ctest and pytest ended with"
  grep 'tests passed,.* out of' "$scratch/ctest.log" || echo 'no C++ test was run'
  tail -n 1 "$scratch/pytest.log"
  [ -z "$failed" ]
}

[ $# = 1 ] || usage
verb=$1
case $verb in demo | test) ;; *) usage ;; esac

cd "$(dirname "$0")"
scratch=$(mktemp -d)
teller=
trap 'stop_telling; rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
if [ "$(uname)" = Darwin ]; then install_on_macos; else install_packages; fi
case $verb in demo) demo ;; test) tests ;; esac
