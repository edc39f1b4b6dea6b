// Roughness spectra: given, measured from maps and profiles, merged, fitted; and maps made from them.
#include "asperity/spectrum.hpp"

#include "arrays.hpp"
#include "asperity/tiles.hpp"
#include "topics.hpp"
#include "value.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

using Optional = std::optional<double>;
using Guarded = py::call_guard<Released>;

using Trend = std::optional<Detrend>;

py::object object_of(Spectrum spectrum) {
  return std::visit([](auto& one) { return py::cast(std::move(one)); }, spectrum);
}

using Column = std::optional<Array>;
using Flags = std::optional<std::vector<std::uint8_t>>;

RowQuality quality_of(const Column& count, const Column& error, const Flags& flag, const Column& correlation,
                      Optional skewness, Optional kurtosis, Optional curvature_kurtosis, Optional slope_ratio = {}) {
  RowQuality quality;
  if (count) quality.count = vector_of(*count);
  if (error) quality.standard_error = vector_of(*error);
  if (flag) quality.flag = *flag;
  if (correlation) quality.correlation = vector_of(*correlation);
  if (skewness && kurtosis) quality.heights = HeightShape{*skewness, *kurtosis, curvature_kurtosis, slope_ratio};
  return quality;
}

RingHarmonics harmonics_of(std::size_t rows, const Column& cosine, const Column& sine, const Column& error) {
  RingHarmonics harmonics;
  if (cosine) harmonics.cosine = vector_of(*cosine);
  if (sine) harmonics.sine = vector_of(*sine);
  if (error) harmonics.standard_error = vector_of(*error);
  if (rows > 0) harmonics.count = harmonics.cosine.size() / rows;
  return harmonics;
}

/// A getter of what is known of the heights.
template <class S, class Member>
auto heights_number(Member HeightShape::*which) {
  return [which](const S& s) { return s.quality().heights ? Optional((*s.quality().heights).*which) : std::nullopt; };
}

/// A spectrum given row by row; columns that it does not have are None.
template <class S>
py::classh<S> bind_rows(py::module_& m, const char* name) {
  const auto column = [](const auto& values) -> py::object {
    return values.empty() ? py::object(py::none()) : py::object(array_of(std::vector(values)));
  };
  return py::classh<S>(m, name)
      .def(
          py::init([](const Array& q, const Array& density, const Column& count, const Column& error, const Flags& flag,
                      const Column& correlation, Optional skewness, Optional kurtosis, Optional curvature_kurtosis) {
            return S(vector_of(q), vector_of(density),
                     quality_of(count, error, flag, correlation, skewness, kurtosis, curvature_kurtosis));
          }))
      .def_property_readonly("wavenumber", [](const S& s) { return array_of(std::vector(s.wavenumber())); })
      .def_property_readonly("density", [](const S& s) { return array_of(std::vector(s.density())); })
      .def_property_readonly("count", [column](const S& s) { return column(s.quality().count); })
      .def_property_readonly("standard_error", [column](const S& s) { return column(s.quality().standard_error); })
      .def_property_readonly("flag", [column](const S& s) { return column(s.quality().flag); })
      .def_property_readonly("correlation",
                             [](const S& s) -> py::object {
                               const auto lags = static_cast<py::ssize_t>(s.quality().lags());
                               if (lags == 0) return py::none();
                               const auto rows = static_cast<py::ssize_t>(s.wavenumber().size());
                               return array_of(std::vector(s.quality().correlation), {rows, lags});
                             })
      .def_property_readonly("skewness", heights_number<S>(&HeightShape::skewness))
      .def_property_readonly("kurtosis", heights_number<S>(&HeightShape::kurtosis))
      .def_property_readonly("curvature_kurtosis", heights_number<S>(&HeightShape::curvature_kurtosis))
      .def("log_binned", py::overload_cast<const S&, double>(&log_binned), Guarded());
}

/// Harmonics of rows, (n, m), or None.
py::object harmonic_rows(const TabulatedSpectrum& s, std::vector<double> RingHarmonics::*column) {
  const std::vector<double>& values = s.harmonics().*column;
  if (values.empty()) return py::none();
  return array_of(std::vector(values),
                  {static_cast<py::ssize_t>(s.wavenumber().size()), static_cast<py::ssize_t>(s.harmonics().count)});
}

/// What every spectrum of a surface can do.
void bind_moments(py::module_& m) {
  m.def("rms_height", &rms_height, Guarded());
  m.def("rms_slope", &rms_slope, Guarded());
  m.def("nayak_parameter", &nayak_parameter, Guarded());
  m.def("cutoff_for_slope", &cutoff_for_slope, Guarded());
  m.def("cutoff_for_contamination", &cutoff_for_contamination, Guarded());
  m.def("truncated", [](const Spectrum& s, Optional q0, Optional q1) {
    return object_of(released([&] { return truncated(s, q0, q1); }));
  });
  m.def("scaled",
        [](const Spectrum& s, double factor) { return object_of(released([&] { return scaled(s, factor); })); });
  m.def("plane_density", [](const Spectrum& s, const Array& q, const Array& direction) {
    return computed([&] { return density(s, span_of(q), span_of(direction)); });
  });
  m.def("is_directional", &is_directional);
  m.def("directional_table", &directional_table, Guarded());
  m.def("density", [](const Spectrum& s, const Array& q) { return computed([&] { return density(s, span_of(q)); }); });
  m.def("line_density",
        [](const Spectrum& s, const Array& q) { return computed([&] { return line_density(s, span_of(q)); }); });
  m.def("autocorrelation",
        [](const Spectrum& s, const Array& r) { return computed([&] { return autocorrelation(s, span_of(r)); }); });
}

void bind_measured(py::module_& m) {
  m.def("power_spectrum", &power_spectrum, Guarded());
  m.def("directional_spectrum", &directional_spectrum, Guarded());
  m.def("tile_covariances",
        [](Window window, HeightMap::Shape tile, HeightMap::PixelSize pixel_size, HeightMap::Shape shift) {
          return computed([&] { return tile_covariances(window, tile, pixel_size, shift); });
        });
  m.def("spectral_density", [](const HeightMap& map, Window window, Trend detrend) {
    SpectralDensity found = released([&] { return spectral_density(map, window, detrend); });
    const auto ny = static_cast<py::ssize_t>(map.shape()[0]), nx = static_cast<py::ssize_t>(map.shape()[1]);
    return py::make_tuple(array_of(std::move(found.wavenumber_y)), array_of(std::move(found.wavenumber_x)),
                          array_of(std::move(found.density), {ny, nx}));
  });
  m.def("anisotropy", [](const HeightMap& map, Window window, Trend detrend, Optional q_min, Optional q_max) {
    const Anisotropy found = released([&] { return anisotropy(map, window, detrend, q_min, q_max); });
    return py::make_tuple(found.across, found.along, found.direction);
  });
  m.def("line_spectrum", py::overload_cast<const LineScan&, Window, Trend, Part>(&line_spectrum), Guarded());
  m.def("line_spectrum", py::overload_cast<const HeightMap&, Window, Trend, Part>(&line_spectrum), Guarded());
  m.def(
      "merge_spectra",
      [](const std::vector<TabulatedSpectrum>& spectra, Optional per_decade) {
        return merge_spectra(spectra, per_decade);
      },
      Guarded());
}

}  // namespace

void bind_spectrum(py::module_& m) {
  using Law = SelfAffineSpectrum;
  bind_value(m, "SelfAffineSpectrum", &Law::rms_height, &Law::hurst, &Law::q0, &Law::q1, &Law::rolloff,
             &Law::axis_ratio, &Law::lay)
      .def_static("from_article", &SelfAffineSpectrum::from_article)
      .def_readonly("rms_height", &SelfAffineSpectrum::rms_height)
      .def_readonly("hurst", &SelfAffineSpectrum::hurst)
      .def_readonly("q0", &SelfAffineSpectrum::q0)
      .def_readonly("q1", &SelfAffineSpectrum::q1)
      .def_readonly("rolloff", &SelfAffineSpectrum::rolloff)
      .def_readonly("axis_ratio", &SelfAffineSpectrum::axis_ratio)
      .def_readonly("lay", &SelfAffineSpectrum::lay)
      .def("extended", &extended);
  bind_rows<TabulatedSpectrum>(m, "TabulatedSpectrum")
      .def(py::init([](const Array& q, const Array& density, const Column& count, const Column& error,
                       const Flags& flag, const Column& correlation, Optional skewness, Optional kurtosis,
                       Optional curvature_kurtosis, Optional slope_ratio, const Column& cosine, const Column& sine,
                       const Column& harmonic_error, Optional q1) {
        return TabulatedSpectrum(
            vector_of(q), vector_of(density),
            quality_of(count, error, flag, correlation, skewness, kurtosis, curvature_kurtosis, slope_ratio),
            harmonics_of(span_of(q).size(), cosine, sine, harmonic_error), q1);
      }))
      .def_property_readonly("q1", &TabulatedSpectrum::q1)
      .def_property_readonly("slope_ratio", heights_number<TabulatedSpectrum>(&HeightShape::slope_ratio))
      .def_property_readonly("cosine",
                             [](const TabulatedSpectrum& s) { return harmonic_rows(s, &RingHarmonics::cosine); })
      .def_property_readonly("sine", [](const TabulatedSpectrum& s) { return harmonic_rows(s, &RingHarmonics::sine); })
      .def_property_readonly("harmonic_error", [](const TabulatedSpectrum& s) {
        return harmonic_rows(s, &RingHarmonics::standard_error);
      });
  bind_rows<LineSpectrum>(m, "LineSpectrum").def("isotropic", &isotropic, Guarded());
  bind_moments(m);
  bind_measured(m);
  m.def("fit_self_affine", [](const TabulatedSpectrum& spectrum, Optional q_min, Optional q_max, FitMethod method,
                              Rolloff rolloff) {
    const SelfAffineFit fit = released([&] { return fit_self_affine(spectrum, {q_min, q_max, method, rolloff}); });
    std::vector<double> covariance;
    for (const auto& row : fit.covariance) covariance.insert(covariance.end(), row.begin(), row.end());
    return py::make_tuple(fit.spectrum, array_of(std::move(covariance), {3, 3}), fit.residual, fit.rows);
  });
  m.def("synthesize", &synthesize, Guarded());
}

}  // namespace asperity::python
