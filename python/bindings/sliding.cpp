// Exact steady sliding contact.
#include "asperity/sliding.hpp"

#include "arrays.hpp"
#include "topics.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

/// ((dy, dx), areas, friction by both ways, energy, error, pressure, gap, notes).
py::tuple slide_of(const HeightMap& map, const Rubber& rubber, double pressure, double velocity, double poisson_ratio,
                   Continuation continuation, double rtol, double time_limit, double direction,
                   const py::object& told) {
  SlidingModel model{poisson_ratio, continuation, rtol, time_limit, direction};
  if (!told.is_none())
    model.progress = [&told](const SlidingStep& at) {
      const py::gil_scoped_acquire held;
      told(at.shape[0], at.shape[1], at.step, at.error);
    };
  SlidingContact c = released([&] { return slide(map, rubber, pressure, velocity, model); });
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(c.shape[0]), static_cast<py::ssize_t>(c.shape[1])};
  return py::make_tuple(py::make_tuple(c.pixel_size[0], c.pixel_size[1]), c.contact_area, c.contact_area_raw,
                        c.hysteresis, c.work_of_slopes, c.lateral, c.elastic_energy, c.error,
                        array_of(std::move(c.pressure), shape), array_of(std::move(c.gap), shape), tuple_of(c.notes));
}

}  // namespace

void bind_sliding(py::module_& m) {
  m.def("slide", &slide_of);
  m.def("continued", [](const HeightMap& map, Continuation continuation) {
    return released([&] { return continued(map, continuation); });
  });
}

}  // namespace asperity::python
