// The surface of a table, part by part when first asked for.
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

/// On the first one cells are as long as I1 and I2 of a Prony series allow, with their singularities pi / 2 off the
/// axis of ln q.
constexpr std::array<RingGrid, TableSurface::grids> grids_of_rings{
    {{2, 1}, {2, 2}, {1, 2}, {1, 4}, {0.5, 4}, {0.5, 8}, {0.25, 8}}};
/// Smooth master curves often want both of these: the first one comes from the second.
constexpr std::size_t of_pairs = 2, finer = of_pairs + 1;

}  // namespace

std::span<const Segment> TableSurface::segments(const TabulatedSpectrum& table) {
  std::call_once(segments_made_, [&] { segments_ = segments_of_rows(table); });
  return segments_;
}

double TableSurface::rms_slope(const TabulatedSpectrum& table) {
  std::call_once(slope_made_, [&] { rms_slope_ = rms_slope_of(segments(table)); });
  return rms_slope_;
}

double TableSurface::nayak_parameter(const TabulatedSpectrum& table) {
  std::call_once(nayak_made_,
                 [&] { nayak_parameter_ = asperity::nayak_parameter(segments(table), table.wavenumber().back()); });
  return nayak_parameter_;
}

const RingSurface& TableSurface::rings(const TabulatedSpectrum& table, std::size_t grid) {
  std::call_once(rings_made_[grid], [&] {
    std::call_once(rows_made_, [&] { rows_ = std::make_unique<RingRows>(segments(table)); });
    rings_[grid] =
        std::make_unique<RingSurface>(*rows_, grids_of_rings[grid], grid == of_pairs ? &rings(table, finer) : nullptr);
  });
  return *rings_[grid];
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
