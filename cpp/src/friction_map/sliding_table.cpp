// ln s0 on a grid; between columns Steffen's cubics, which do not overshoot where s0 jumps: mu over the distance need
// not fall steadily, and where the friction with and without heat cross, s0 says little and matters as little. About
// these places s0 is steep, so that the grid is halved until they matter no more, and s0 computed there alone.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "friction_map/format.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/random.hpp"

namespace asperity {

namespace {

constexpr double step_x = 0.25, step_T = 2.5;  // longest of the grid that is computed throughout, of ln v and in K
constexpr double most_columns = 65, most_rows = 25;
constexpr std::size_t most_nodes = 20'000, most_in_row = 1'025;  // which halving may make
constexpr double allowed = 0.01;                                 // of mu while the rubber heats up
constexpr std::size_t tested = 460;                              // random points: 0.99^460 is less than 1 %
constexpr double longest = 3;                                    // distance slid there, over s0

std::size_t points(double range, double step, double most) {
  return static_cast<std::size_t>(std::clamp(std::ceil(range / step) + 1, 2.0, most));
}

/// By how much the heat changes mu at a point, over the smaller of both.
double changed(const FlashFriction& f, std::size_t i) {
  const double hot = f.hot.mu[i], cold = f.cold.mu[i];
  return std::fabs(cold - hot) / std::fmin(cold, hot);
}

/// What is solved for a table, at points of its box.
struct Scene {
  const Spectrum& spectrum;
  const Rubber& rubber;
  const ContactModel& model;
  const MapHeat& heat;
  const MapRequest& request;
  unsigned threads;
  const std::function<void(double)>& progress;
  double done = 0;  // of the progress

  [[nodiscard]] double range_x() const { return std::log(request.velocity[1] / request.velocity[0]); }
  void add(MapPoints& to, double share_p, double share_x, double share_T) const {
    const auto [lowest, highest] = heat.range;
    to.add(between(request.pressure, share_p), between(request.velocity, share_x),
           std::fmin(highest, lowest + share_T * (highest - lowest)));
  }

  /// Before so many others that are known of: halvings of the grid, which nobody foresees, share what is left of the
  /// progress with the test that is to come.
  std::vector<double> lengths(const MapPoints& at, std::size_t others) {
    constexpr std::size_t together = 4;  // a tenth of a second and more on a scan
    const std::size_t n = at.velocity.size(), left = n + others;
    std::vector<double> result(n);
    const double from = done;
    done = left == 0 ? 1 : from + (1 - from) * static_cast<double>(n) / static_cast<double>(left);
    const auto tell = [&](double share) {
      if (progress) progress(from + share * (done - from));
    };
    in_blocks(threads, n, together, [&](unsigned thread, std::size_t begin, std::size_t end) {
      const auto part = [&](const std::vector<double>& all) { return std::span(all).subspan(begin, end - begin); };
      std::ranges::copy(sliding_length(spectrum, rubber, *heat.shift, *heat.heating, model, heat.adhesion,
                                       part(at.pressure), part(at.velocity), part(at.temperature)),
                        result.begin() + static_cast<std::ptrdiff_t>(begin));
      // from this thread alone: blocks are taken in their order
      if (thread + 1 == threads) tell(static_cast<double>(end) / static_cast<double>(n));
    });
    tell(1);
    return result;
  }

  [[nodiscard]] FlashFriction heated(const MapPoints& at) const {
    return friction(spectrum, rubber, *heat.shift, *heat.heating, model, heat.adhesion, at.pressure, at.velocity,
                    at.temperature, Branch::coldest, false, threads);
  }
};

/// ln s0 as a look-up finds it.
double found_at(const SlidingTable& table, double share_x, double share_T, double range_x) {
  const auto interval = [](double at, std::size_t nodes) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(nodes - 2)));
  };
  const double x = share_x * static_cast<double>(table.columns - 1),
               h = range_x / static_cast<double>(table.columns - 1);
  const std::size_t i = interval(x, table.columns);
  const auto in_row = [&](std::size_t row) {
    const double* const s = &table.values[2 * (row * table.columns + i)];
    return hermite(s[0], s[1], s[2], s[3], h, x - static_cast<double>(i)).value;
  };
  if (table.rows == 1) return in_row(0);
  const double row = share_T * static_cast<double>(table.rows - 1);
  const std::size_t j = interval(row, table.rows);
  const double t = row - static_cast<double>(j);
  return (1 - t) * in_row(j) + t * in_row(j + 1);
}

/// The largest error of mu at random points. 99 % of all keep it, with a confidence of 99 %: were more than 1 % beyond,
/// one of these would be but for a chance of 0.99^460. No point is off by more than the heat changes mu, as
/// exp(-s / s0) is between 0 and 1 whatever s0 is: where that is a small part of rtol it is the error, and s0 is not
/// computed there.
double error_of(const SlidingTable& table, Scene& scene) {
  Random random(20261124);
  MapPoints at;
  std::vector<double> ln_length, slid;
  for (std::size_t i = 0; i < tested; ++i) {
    const double share_x = random(), share_T = random();
    scene.add(at, random(), share_x, share_T);
    ln_length.push_back(found_at(table, share_x, share_T, scene.range_x()));
    slid.push_back(longest * random());
  }
  const FlashFriction f = scene.heated(at);
  double largest = 0;
  std::vector<std::size_t> wanted;
  MapPoints of_wanted;
  for (std::size_t i = 0; i < tested; ++i) {
    const double change = changed(f, i);
    if (change <= 2 * step_share * scene.request.rtol) {
      largest = std::fmax(largest, change);
      continue;
    }
    wanted.push_back(i);
    of_wanted.add(at.pressure[i], at.velocity[i], at.temperature[i]);
  }
  const std::vector<double> length = scene.lengths(of_wanted, 0);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const std::size_t i = wanted[k];
    const double distance = slid[i] * length[k], hot = f.hot.mu[i], apart = f.cold.mu[i] - hot;
    const double mu = hot + apart * std::exp(-slid[i]);
    const double found = hot + apart * std::exp(-distance * std::exp(-ln_length[i]));
    largest = std::fmax(largest, std::fabs(found / mu - 1));
  }
  return largest;
}

/// ln s0 over equal steps of ln v and of the temperature, at the middle of the pressures.
class Grid {
 public:
  explicit Grid(Scene& scene) : scene_(scene) {
    const auto [lowest, highest] = scene.heat.range;
    columns_ = points(scene.range_x(), step_x, most_columns);
    rows_ = lowest == highest ? 1 : points(highest - lowest, step_T, most_rows);
    nodes_.resize(columns_ * rows_);
    std::vector<std::size_t> all(nodes_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    compute(all);
    // what the coarser grid of every other node would have missed tells where this one misses something
    const auto compare = [&](Node& node, std::size_t at, std::size_t nodes, std::size_t stride) {
      if (at > 0 && at + 1 < nodes)
        node.miss =
            std::fmax(node.miss, missed(node, ((&node - stride)->log_length + (&node + stride)->log_length) / 2));
    };
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      compare(nodes_[k], k % columns_, columns_, 1);
      compare(nodes_[k], k / columns_, rows_, columns_);
    }
  }

  [[nodiscard]] bool is_too_coarse() const {
    const std::size_t columns = 2 * columns_ - 1, rows = rows_ == 1 ? 1 : 2 * rows_ - 1;
    return columns <= most_in_row && columns * rows <= most_nodes &&
           std::ranges::any_of(nodes_, [](const Node& node) { return node.miss > allowed; });
  }

  void halve() {
    const std::size_t columns = columns_, rows = rows_;
    const std::vector<Node> before = std::move(nodes_);
    columns_ = 2 * columns - 1;
    rows_ = rows == 1 ? 1 : 2 * rows - 1;
    const std::size_t row_step = rows == 1 ? 1 : 2;
    nodes_.assign(columns_ * rows_, Node{});
    std::vector<std::size_t> wanted;
    for (std::size_t j = 0; j < rows_; ++j)
      for (std::size_t i = 0; i < columns_; ++i) {
        Node& node = nodes_[j * columns_ + i];
        const std::size_t lower = j / row_step, upper = (j + row_step - 1) / row_step;
        double sum = 0;
        for (const std::size_t row : {lower, upper})
          for (const std::size_t column : {i / 2, (i + 1) / 2}) {
            const Node& near = before[row * columns + column];
            sum += near.log_length / 4;
            node.miss = std::fmax(node.miss, near.miss);
          }
        const bool is_old = i % 2 == 0 && j % row_step == 0;
        if (is_old) node = before[lower * columns + i / 2];
        if (!is_old && node.miss > allowed) wanted.push_back(j * columns_ + i);
        if (is_old || node.miss <= allowed) node.miss = 0;
        if (!is_old) node.log_length = sum;
      }
    std::vector<double> guessed;
    for (const std::size_t k : wanted) guessed.push_back(nodes_[k].log_length);
    compute(wanted);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      Node& node = nodes_[wanted[k]];
      node.miss = missed(node, guessed[k]);
    }
  }

  [[nodiscard]] SlidingTable table() const {
    SlidingTable table;
    table.columns = columns_;
    table.rows = rows_;
    std::vector<double> x(columns_), y(columns_);
    for (std::size_t i = 0; i < columns_; ++i) x[i] = scene_.range_x() * share(i, columns_);
    for (std::size_t j = 0; j < rows_; ++j) {
      for (std::size_t i = 0; i < columns_; ++i) y[i] = nodes_[j * columns_ + i].log_length;
      const Steffen through(x, y);
      for (std::size_t i = 0; i < columns_; ++i) table.values.insert(table.values.end(), {y[i], through.slope(i)});
    }
    return table;
  }

 private:
  struct Node {
    double log_length = 0;
    double change = 0;  // of mu by the heat, over the smaller of both
    double miss = 0;    // of mu, by what nodes about it tell
  };

  static double share(std::size_t i, std::size_t nodes) {
    return nodes == 1 ? 0 : static_cast<double>(i) / static_cast<double>(nodes - 1);
  }

  /// Where s0 is d in its logarithm off, exp(-s / s0) is by d / e at most, and by 1.
  static double missed(const Node& node, double guess) {
    return node.change * std::fmin(1, std::fabs(node.log_length - guess) / std::numbers::e);
  }

  void compute(const std::vector<std::size_t>& wanted) {
    MapPoints at;
    for (const std::size_t k : wanted) scene_.add(at, 0.5, share(k % columns_, columns_), share(k / columns_, rows_));
    const std::vector<double> length = scene_.lengths(at, tested);
    const FlashFriction f = scene_.heated(at);
    for (std::size_t k = 0; k < wanted.size(); ++k) nodes_[wanted[k]] = {std::log(length[k]), changed(f, k), 0};
  }

  Scene& scene_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Node> nodes_;  // row by row
};

}  // namespace

SlidingTable sliding_table(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                           const MapHeat& heat, const MapRequest& request, unsigned threads,
                           const std::function<void(double)>& progress) {
  Scene scene{spectrum, rubber, model, heat, request, threads, progress};
  Grid grid(scene);
  while (grid.is_too_coarse()) grid.halve();
  SlidingTable table = grid.table();
  table.error = error_of(table, scene);
  return table;
}

}  // namespace asperity
