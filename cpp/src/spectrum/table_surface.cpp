// The surface of a table, part by part when first asked for.
#include "spectrum/table_surface.hpp"

namespace asperity {

std::span<const Segment> TableSurface::segments(const TabulatedSpectrum& table) {
  std::call_once(segments_made_, [&] {
    segments_ = segments_of_rows(table);
    while (segments_.back().a >= table.q1()) segments_.pop_back();
    Segment& last = segments_.back();
    if (last.b <= table.q1()) return;
    last.at_b = last.density(table.q1());
    last.b = table.q1();
  });
  return segments_;
}

double TableSurface::rms_slope(const TabulatedSpectrum& table) {
  std::call_once(slope_made_, [&] { rms_slope_ = rms_slope_of(segments(table)); });
  return rms_slope_;
}

double TableSurface::nayak_parameter(const TabulatedSpectrum& table) {
  std::call_once(nayak_made_, [&] { nayak_parameter_ = asperity::nayak_parameter(segments(table), table.q1()); });
  return nayak_parameter_;
}

SurfaceSegments::SurfaceSegments(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    all_ = table->surface().segments(*table);
  } else {
    made_ = segments(spectrum);
    all_ = made_;
  }
}

}  // namespace asperity
