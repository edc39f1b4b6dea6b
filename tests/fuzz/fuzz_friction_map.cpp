// libFuzzer's way into the reader of friction maps: the bytes as they come, and once more with their size and checksum
// made right, so that the checks behind those are reached too. Also a program of its own, which writes its seeds:
//   seeds DIRECTORY
#include <cstdio>

#include "mutate.hpp"
#include "probe.hpp"
#include "small_map.hpp"

namespace {

void feed(const small_map::Bytes& bytes) {
  asperity::FrictionMap map;
  std::string why;
  if (map.read(bytes.data(), bytes.size(), why)) {
    probe::require(why.empty() && map.info().cells > 0, "an accepted map has cells and no complaint");
    probe::points(map);
  } else {
    probe::require(!why.empty() && map.info().cells == 0, "a refused one a reason and leaves the map as it was");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  small_map::Bytes bytes(data, data + size);
  feed(bytes);
  small_map::repair(bytes);
  feed(bytes);
  return 0;
}

#ifndef SEEDS

extern "C" std::size_t LLVMFuzzerMutate(unsigned char* data, std::size_t size, std::size_t most);

/// Half of the time what libFuzzer would do, else one number made another.
extern "C" std::size_t LLVMFuzzerCustomMutator(unsigned char* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  std::minstd_rand random(seed);
  random.discard(2);
  if (size < 24 || random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  mutate(data, size, random);
  return size;
}

#else

/// Writes the seeds.
int main(int count, char** arguments) {
  if (count != 2) return 2;
  int written = 0;
  for (const small_map::Kind& kind : small_map::kinds()) {
    const std::string path = std::string(arguments[1]) + "/" + std::to_string(written++) + ".fmap";
    const small_map::Bytes bytes = small_map::make(kind);
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    if (file == nullptr || std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) return 1;
    std::fclose(file);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  return 0;
}
#endif
