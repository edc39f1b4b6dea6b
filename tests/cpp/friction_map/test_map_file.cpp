// The friction map's reader: what is a map is read, what is not is refused, and nothing crashes.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <random>
#include <string>

#include "../fuzz/mutate.hpp"
#include "../fuzz/probe.hpp"
#include "../fuzz/small_map.hpp"
#include "asperity/build_friction_map.hpp"

using namespace asperity;

namespace {

using small_map::Bytes;

std::uint64_t number(double x) { return std::bit_cast<std::uint64_t>(x); }

/// The reason why bytes are refused, or nothing.
std::string refusal(const Bytes& bytes) {
  FrictionMap map;
  std::string why;
  const bool read = map.read(bytes.data(), bytes.size(), why);
  CHECK(read == why.empty());
  CHECK((map.info().cells > 0) == read);
  return why;
}

bool says(const Bytes& bytes, const char* what) {
  const std::string why = refusal(bytes);
  CAPTURE(why);
  return why.find(what) != std::string::npos;
}

/// What a fuzzer does with bytes whose checksum has been made right: true where they are a map.
bool stands(Bytes bytes) {
  small_map::repair(bytes);
  FrictionMap map;
  std::string why;
  const bool read = map.read(bytes.data(), bytes.size(), why);
  if (!read) {
    probe::require(!why.empty() && map.info().cells == 0, "refused with a reason, the map as it was");
    return false;
  }
  probe::points(map);
  const auto [p, v] = std::pair{map.info().pressure, map.info().velocity};
  const double pressure[] = {p[0], p[1], std::sqrt(p[0]) * std::sqrt(p[1])};
  const double velocity[] = {v[1], v[0], -std::sqrt(v[0]) * std::sqrt(v[1])}, a_T[] = {1};
  const double background[] = {map.info().temperature[1]};
  double mu[3];
  MapColumns columns{pressure, velocity, a_T};
  if (map.info().heat) columns.background = background;
  look_up(map, columns, FrictionMap::Outside::nan, false, mu);
  for (const double one : mu) probe::require(probe::finite(one) && one >= 0, "mu of an array");
  return true;
}

/// A map of one band whose grids lie one in another, each with a cell in its first entry, the next grid in its second.
Bytes chain(std::uint32_t grids) {
  const Bytes plain = small_map::make({});
  constexpr std::size_t head = small_map::head, grid = head + 16, entries = grid + 48, cells = entries + 16;
  const auto part = [&](std::size_t begin, std::size_t end) {
    return Bytes(plain.begin() + static_cast<std::ptrdiff_t>(begin), plain.begin() + static_cast<std::ptrdiff_t>(end));
  };
  const auto append = [](Bytes& to, const Bytes& from) { to.insert(to.end(), from.begin(), from.end()); };
  Bytes result = part(0, grid), table;
  small_map::overwrite(result, small_map::grids_at, grids, 4);
  small_map::overwrite(result, small_map::grids_at + 4, 2 * grids, 4);
  for (std::uint32_t k = 0; k < grids; ++k) {
    Bytes one = part(grid, entries);
    small_map::overwrite(one, 36, 1, 4);  // rows
    small_map::overwrite(one, 40, 2 * k, 4);
    append(result, one);
    small_map::put(table, 0, 4);
    small_map::put(table, k + 1 < grids ? static_cast<std::uint64_t>(-2 - std::int64_t{k}) : 1, 4);
  }
  append(result, table);
  append(result, part(cells, plain.size()));
  small_map::repair(result);
  return result;
}

/// The reason why a file is refused, or nothing.
std::string load_refusal(const char* path) {
  FrictionMap map;
  std::string why;
  const bool loaded = map.load(path, why);
  CHECK(loaded == why.empty());
  return why;
}

/// A built map with a boundary between states and a shift that depends on the velocity.
Bytes built() {
  const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e5};
  const PronySeries rubber(3e6, {1e7, 1e8, 1e9}, {1e-2, 1e-4, 1e-6});
  const ContactModel model{.correction = GreenwoodWilliamson{.z_max = 6e-4, .z_min = -1e-3}};
  return build_friction_map(road, rubber, model, Adhesion{.shear_stress = 5e6},
                            {.pressure = {5e4, 5e5}, .velocity = {1e-3, 1}, .rtol = 0.03, .checked = 0, .text = "{}"});
}

}  // namespace

TEST_CASE("a map without heat inside of one with it must be one") {
  const Bytes good = small_map::make({.temperatures = 4});
  const auto altered = [&](std::size_t at, std::uint64_t value, int size) {
    Bytes bytes = good;
    small_map::overwrite(bytes, at, value, size);
    small_map::repair(bytes);
    return bytes;
  };
  const std::size_t cold = good.size() - 8 - small_map::make({}).size();  // there is no text
  CHECK(says(altered(cold + 12, 1, 4), "its map without heat has layout version 1: must be 4, so the map has to be"));
  CHECK(says(altered(cold + 300, 1, 1), "its map without heat is damaged: its checksum"));
  CHECK(says(altered(144, 0, 8), "its head contradicts itself"));                      // none inside
  CHECK(says(altered(small_map::nodes_at, 1, 4), "its head contradicts itself"));      // one temperature of a range
  CHECK(says(altered(small_map::nodes_at + 8, 1, 4), "its head contradicts itself"));  // one row of s0
  CHECK(says(altered(small_map::coldest_at, number(400.0), 8), "its head contradicts itself"));
  CHECK(says(altered(small_map::head, number(probe::nan()), 8), "its tables contradict each other"));
  // one with heat instead: it would lead to another one, and that to the next
  const Bytes warm = small_map::make({.temperatures = 1});
  Bytes nested(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(cold));
  nested.insert(nested.end(), warm.begin(), warm.end());
  nested.resize(nested.size() + 8);
  small_map::overwrite(nested, 144, warm.size(), 8);
  small_map::repair(nested);
  CHECK(says(nested, "its map without heat has one too"));
}

TEST_CASE("a slanted map without a_T, with a pole in it or of one temperature is refused") {
  const Bytes good = small_map::make({.bands = 3, .temperatures = 4, .slanted = true});
  CHECK(refusal(good).empty());
  constexpr std::size_t law = small_map::head;
  const auto altered = [&](std::size_t at, std::uint64_t value, int size) {
    Bytes bytes = good;
    small_map::overwrite(bytes, at, value, size);
    small_map::repair(bytes);
    return bytes;
  };
  for (const double a : {probe::nan(), probe::infinity(), 1e3, -1e3})  // the last would be e^10000
    CHECK(says(altered(law, number(a), 8), "its tables contradict each other"));
  for (const double b : {probe::nan(), -1 / 60.0, -1.0, 1e4})
    CHECK(says(altered(law + 8, number(b), 8), "its tables contradict each other"));
  CHECK(says(small_map::make({.bands = 2, .temperatures = 4, .slanted = true}), "its head contradicts itself"));
  CHECK(says(altered(152, 1, 4), "its head contradicts itself"));  // not slanted it would have more numbers
  CHECK(says(altered(small_map::nodes_at, 1, 4), "its head contradicts itself"));
  CHECK(says(altered(small_map::coldest_at + 8, number(small_map::coldest), 8), "its head contradicts itself"));
  for (std::size_t n = 8; n < 64; n += 8) {  // cut within the head and the law
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(law - 48 + n));
    small_map::repair(bytes);
    CHECK_FALSE(refusal(bytes).empty());
  }
}

TEST_CASE("what is wrong with a file is named") {
  const Bytes good = small_map::make({});
  CHECK(refusal(good).empty());
  CHECK(says({}, "begins otherwise"));
  Bytes bytes = good;
  small_map::overwrite(bytes, 8, 0x04030201, 4);
  CHECK(says(bytes, "the other byte order"));
  bytes = good;
  small_map::overwrite(bytes, 12, 5, 4);
  CHECK(refusal(bytes) == "has layout version 5: must be 4");
  for (const std::uint64_t old : {1, 2, 3}) {
    small_map::overwrite(bytes, 12, old, 4);
    CHECK(refusal(bytes) ==
          "has layout version " + std::to_string(old) + ": must be 4, so the map has to be made again");
  }
  bytes = good;
  bytes.resize(good.size() - 100);
  CHECK(says(bytes, "is truncated: "));
  bytes.resize(good.size() + 1);
  CHECK(says(bytes, "is too long: "));
  bytes = good;
  bytes[300] ^= 1;
  CHECK(says(bytes, "its checksum"));
  bytes = good;
  small_map::overwrite(bytes, small_map::grids_at + 8, 5, 4);  // cells, of which there are four
  small_map::repair(bytes);
  CHECK(says(bytes, "its head contradicts itself"));

  // Of tables: after the head two cuts, two grids of 48 bytes, eight entries, seven cells.
  constexpr std::size_t head = small_map::head, grids = head + 16, entries = grids + 2 * 48, cells = entries + 32;
  const auto altered = [](std::initializer_list<std::pair<std::size_t, double>> numbers) {
    Bytes result = small_map::make({.nested = true});
    for (const auto& [at, number] : numbers) small_map::overwrite(result, at, std::bit_cast<std::uint64_t>(number), 8);
    small_map::repair(result);
    return result;
  };
  CHECK(refusal(altered({})).empty());
  CHECK(says(altered({{24, 1e4}, {32, std::nextafter(1e4, 1e5)}}), "its head contradicts itself"));
  for (const double number : {probe::nan(), probe::infinity(), -1e13})
    for (const std::size_t at : {head, grids, grids + 8, grids + 16, grids + 24, cells, cells + 8})
      CHECK(says(altered({{at, number}}), "its tables contradict each other"));
  CHECK(says(altered({{cells + 16, probe::nan()}}), "its tables contradict each other"));
  for (const std::size_t at : {grids, grids + 8})  // steps that no integer holds
    CHECK(says(altered({{at, 1e11}, {at + 16, 1e11}}), "its tables contradict each other"));
  bytes = altered({});
  small_map::overwrite(bytes, entries, static_cast<std::uint64_t>(-1), 4);  // from grid 0 to grid 0
  small_map::repair(bytes);
  CHECK(says(bytes, "its tables contradict each other"));
  bytes = altered({});
  small_map::overwrite(bytes, grids + 48 + 40, 0, 4);  // grid 1 has the entries of grid 0
  small_map::repair(bytes);
  CHECK(says(bytes, "its tables contradict each other"));
}

TEST_CASE("what a look-up goes through is bounded") {
  CHECK(refusal(chain(1)).empty());
  CHECK(refusal(chain(64)).empty());
  CHECK(stands(chain(64)));
  CHECK(says(chain(65), "its tables contradict each other"));
  CHECK(says(chain(100'000), "its tables contradict each other"));
  CHECK(refusal(small_map::make({.bands = 64})).empty());
  CHECK(says(small_map::make({.bands = 65}), "its head contradicts itself"));
}

TEST_CASE("what is no regular file is refused, not waited for and not read without end") {
  CHECK(load_refusal("no such file").starts_with("no such file: cannot be read: "));
  CHECK(load_refusal("/dev/zero") == "/dev/zero: cannot be read: is no regular file");
  CHECK(load_refusal("/") == "/: cannot be read: is no regular file");
  const std::string pipe = "pipe." + std::to_string(::getpid());
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(load_refusal(pipe.c_str()) == pipe + ": cannot be read: is no regular file");
  ::unlink(pipe.c_str());
  const std::string loop = "loop." + std::to_string(::getpid());
  REQUIRE(::symlink(loop.c_str(), loop.c_str()) == 0);
  CHECK(load_refusal(loop.c_str()).starts_with(loop + ": cannot be read: "));
  ::unlink(loop.c_str());
}

TEST_CASE("a long file that is no map is refused by its beginning") {
  const std::string path = "long." + std::to_string(::getpid());
  std::FILE* const file = std::fopen(path.c_str(), "wbx");
  REQUIRE(file != nullptr);
  REQUIRE(::ftruncate(::fileno(file), off_t{1} << 40) == 0);  // a terabyte of nothing
  std::fclose(file);
  CHECK(load_refusal(path.c_str()) == path + ": is no friction map: it begins otherwise");
  ::unlink(path.c_str());
}

TEST_CASE("a file altered in any byte or cut at any length is refused") {
  for (const small_map::Kind& kind : small_map::kinds()) {
    const Bytes good = small_map::make(kind);
    for (std::size_t i = 0; i < good.size(); ++i) {
      Bytes bytes = good;
      for (const int flip : {1, 0x80, 0xff}) {
        bytes[i] = static_cast<unsigned char>(good[i] ^ flip);
        FrictionMap map;
        std::string why;
        if (map.read(bytes.data(), bytes.size(), why)) FAIL_CHECK("byte ", i, " altered by ", flip);
      }
      bytes.assign(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i));
      FrictionMap map;
      std::string why;
      if (map.read(bytes.data(), bytes.size(), why)) FAIL_CHECK("cut at ", i);
    }
  }
}

TEST_CASE("altered where the checksum was made right, it is refused or answers") {
  int accepted = 0, refused = 0;
  const auto count = [&](const Bytes& bytes) { ++(stands(bytes) ? accepted : refused); };
  for (const small_map::Kind& kind : small_map::kinds()) {
    const Bytes good = small_map::make(kind);
    const std::size_t tables = std::min<std::size_t>(good.size() - 8, 1000);  // of the cells the first ones will do
    for (std::size_t i = 24; i < tables; ++i) {
      Bytes bytes = good;
      bytes[i] ^= 0x80;
      count(bytes);
      bytes.assign(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i));
      count(bytes);
    }
    for (std::size_t i = 24; i < tables / 8 * 8; i += 8) {
      double old = 0;
      std::memcpy(&old, &good[i], sizeof old);
      for (std::size_t k = 0; k < hard_numbers; ++k) {
        Bytes bytes = good;
        const double hard = hard_number(old, k);
        std::memcpy(&bytes[i], &hard, sizeof hard);
        count(bytes);
      }
      for (const std::uint32_t word : hard_words)
        for (const std::size_t half : {i, i + 4}) {
          Bytes bytes = good;
          small_map::overwrite(bytes, half, word, 4);
          count(bytes);
        }
    }
  }
  // both happen: coefficients may be anything, counts may not
  CHECK(accepted > 1000);
  CHECK(refused > 5000);
}

TEST_CASE("several numbers altered at once, in small maps and in a built one") {
  std::minstd_rand random(7);
  std::vector<Bytes> maps{built()};
  for (const small_map::Kind& kind : small_map::kinds()) maps.push_back(small_map::make(kind));
  FrictionMap whole;
  std::string why;
  REQUIRE_MESSAGE(whole.read(maps[0].data(), maps[0].size(), why), why);
  probe::points(whole);
  int accepted = 0;
  for (int k = 0; k < 5000; ++k) {
    Bytes bytes = maps[static_cast<std::size_t>(k) % maps.size()];
    for (auto n = 2 + random() % 4; n > 0; --n) mutate(bytes.data(), bytes.size(), random);
    std::memcpy(bytes.data(), maps[0].data(), 16);  // these are checked before the checksum
    accepted += stands(bytes);
  }
  CHECK(accepted > 100);
  CHECK(accepted < 4900);
}

TEST_CASE("a map that holds nothing answers NaN") {
  const FrictionMap map;
  probe::points(map);
  CHECK(std::isnan(map.mu(0, 0)));
  CHECK(std::isnan(map.mu(0, 0, FrictionMap::Outside::clamp)));
}
