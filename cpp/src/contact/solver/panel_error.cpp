#include "contact/solver/panel_error.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

double larger(const double* tail, std::size_t k) { return std::max(std::fabs(tail[k]), std::fabs(tail[k + 1])); }

double beyond_rule(double size, const double* tail, double decay, double growth) {
  const double end = std::max(std::fabs(tail[0]), std::fabs(tail[1]) * decay) * decay;
  const double middle = larger(tail, LegendreRule::tails);
  if (!(end > 0)) return 0;
  if (!(end < size)) return end;
  if (growth == analytic && middle * middle >= size * end) return end * (end / size);
  const double at_n = std::log(size / end), half_way = std::log(size / std::min(size, std::max(middle, end)));
  return size * std::exp(-at_n * std::clamp(half_way > 0 ? at_n / half_way : growth, 1.0, growth));
}

}  // namespace asperity
