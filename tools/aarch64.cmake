# Debian's cross compiler for Linux on aarch64, with tests run by qemu. Packages, after `dpkg --add-architecture arm64`:
# crossbuild-essential-arm64 qemu-user libgsl-dev:arm64 libfftw3-dev:arm64 libstdc++6:arm64 libeigen3-dev doctest-dev;
# g++ and libfftw3-dev too, to compare bits with this machine's.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# The packages of arm64 have the loader and all libraries. Those of the cross compiler are older: their loader with the
# C library beside GSL and FFTW spins for ever where a thread starts.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
