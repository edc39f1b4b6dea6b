// Asperities, corrections for partial contact, and the contact area at every magnification.
#include "asperity/contact.hpp"

#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "arrays.hpp"
#include "asperity/contact_progress.hpp"
#include "topics.hpp"
#include "value.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

using OverWavenumber = std::vector<double> (*)(const Spectrum&, const Rubber&, const ContactModel&,
                                               std::span<const double>, std::span<const double>,
                                               std::span<const double>);

void bind_over_wavenumber(py::module_& m, const char* name, OverWavenumber function) {
  m.def(name, [function](const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model, const Array& p,
                         const Array& v, const Array& q) {
    return computed([&] { return function(spectrum, rubber, model, span_of(p), span_of(v), span_of(q)); });
  });
}

/// (d~, d, states) for pairs of pressure and modulus; states as 0 no contact, 1 partial, 2 full.
py::tuple separations(const Array& pressure, const Array& modulus, double rms_height, double q0, const Array& peaks,
                      Reading reading, std::optional<double> z_max, std::optional<double> z_min) {
  const std::span<const double> p = span_of(pressure), e = span_of(modulus);
  const MacroAsperities asperities{rms_height, q0, span_of(peaks)};
  std::vector<double> effective(p.size()), rigid(p.size());
  std::vector<int> state(p.size());
  released([&] {
    for (std::size_t i = 0; i < p.size(); ++i) {
      heed();
      const Separation d = separation(asperities, p[i], e[i], reading);
      effective[i] = d.effective;
      rigid[i] = d.rigid;
      if (z_max && z_min) state[i] = static_cast<int>(contact_state(d.effective, *z_max, *z_min));
    }
  });
  return py::make_tuple(array_of(std::move(effective)), array_of(std::move(rigid)), array_of(std::move(state)));
}

/// Of a row a contact, in the order of `COLUMNS` in scan_contact.py.
using Solved = SolvedContact;
constexpr std::tuple solved_columns{&Solved::rubber,
                                    &Solved::heat,
                                    &Solved::strain,
                                    &Solved::poisson_ratio,
                                    &Solved::q0,
                                    &Solved::q1,
                                    &Solved::part,
                                    &Solved::coarse,
                                    &Solved::pressure,
                                    &Solved::velocity,
                                    &Solved::direction,
                                    &Solved::contact_area,
                                    &Solved::hysteresis,
                                    &Solved::lateral,
                                    &Solved::rule_area,
                                    &Solved::rule_hysteresis,
                                    &Solved::error,
                                    &Solved::seconds,
                                    &Solved::points_y,
                                    &Solved::points_x,
                                    &Solved::contact_points,
                                    &Solved::interpolation,
                                    &Solved::pixels,
                                    &Solved::scan,
                                    &Solved::joining};
constexpr std::size_t solved_count = std::tuple_size_v<decltype(solved_columns)>;

py::array contact_rows(const ScanContact& scan) {
  const std::vector<Solved> contacts = scan.contacts();
  std::vector<double> rows;
  for (const Solved& c : contacts)
    std::apply([&](auto... column) { (rows.push_back(static_cast<double>(c.*column)), ...); }, solved_columns);
  return array_of(std::move(rows), {static_cast<py::ssize_t>(contacts.size()), solved_count});
}

template <class Member, class Owner>
void set(Solved& contact, Member Owner::*column, double number) {
  contact.*column = static_cast<Member>(number);
}

void add_contacts(ScanContact& scan, const Array& rows) {
  for (const double* number = rows.data(); number != rows.data() + rows.size();) {
    Solved c;
    std::apply([&](auto... column) { (set(c, column, *number++), ...); }, solved_columns);
    scan.add({&c, 1});
  }
}

/// A with statement, in which the scan's contacts are counted for Python.
class WatchedContacts {
 public:
  WatchedContacts(ScanContact scan, py::object tell) : scan_(std::move(scan)), tell_(std::move(tell)) {}
  void enter() {
    progress_.emplace(scan_, [this](std::size_t solved, std::size_t needed) {
      const py::gil_scoped_acquire held;
      tell_(solved, needed);
    });
  }
  void exit() { progress_.reset(); }

 private:
  ScanContact scan_;
  py::object tell_;
  std::optional<ContactProgress> progress_;
};

void bind_corrections(py::module_& m) {
  py::classh<ScanContact>(m, "ScanContact")
      .def(py::init([](const HeightMap& map, Continuation continuation, double tolerance) {
        return released([&] { return ScanContact(map, continuation, tolerance); });
      }))
      .def("contacts", &contact_rows)
      .def("add", &add_contacts);
  py::class_<WatchedContacts>(m, "WatchedContacts")
      .def(py::init<const ScanContact&, py::object>())
      .def("__enter__", &WatchedContacts::enter)
      .def("__exit__",
           [](WatchedContacts& watched, const py::object&, const py::object&, const py::object&) { watched.exit(); });
  bind_value(m, "SFactor", &SFactor::gamma, &SFactor::applies_to);
  bind_value(m, "NayakSFactor", &NayakSFactor::friction_gamma);
  bind_value(m, "ImplicitSFactor", &ImplicitSFactor::gamma);
  bind_value<PartialContact>(m, "PartialContact");
  bind_value(m, "AffineShift", &AffineShift::p);
  bind_value(m, "LocalPeaks", &LocalPeaks::heights, &LocalPeaks::z_max)
      .def("shift_factor", [](const LocalPeaks& peaks) { return shift_factor(peaks); });
  using Model = GreenwoodWilliamson;
  bind_value(m, "GreenwoodWilliamson", &Model::z_max, &Model::z_min, &Model::peaks, &Model::reading, &Model::rms_height,
             &Model::q0);
  using Both = PeaksThenGreenwoodWilliamson;
  bind_value(m, "PeaksThenGreenwoodWilliamson", &Both::peaks, &Both::z_max, &Both::z_min, &Both::reading,
             &Both::rms_height, &Both::q0);
}

}  // namespace

void bind_contact(py::module_& m) {
  bind_corrections(m);
  m.def("hertz_penetration", &hertz_penetration);
  m.def("separation", &separations);
  bind_over_wavenumber(m, "contact_area", &contact_area);
  bind_over_wavenumber(m, "mean_pressure", &mean_pressure);
  bind_over_wavenumber(m, "correction_factor", &correction_factor);
  m.def("contact_notes",
        [](const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model, const Array& p, const Array& v) {
          return tuple_of(released([&] { return contact_notes(spectrum, rubber, model, span_of(p), span_of(v)); }));
        });
  m.def("notes_on_heights", [](const TabulatedSpectrum& measured) {
    const auto& heights = measured.quality().heights;
    const auto note = heights ? note_on_heights(*heights) : std::nullopt;
    return tuple_of(note ? std::vector{*note} : std::vector<Diagnostic>{});
  });
  m.def("pressure_distribution", [](const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                    const Array& stress, const Array& p, const Array& v, double wavenumber) {
    return computed([&] {
      return pressure_distribution(spectrum, rubber, model, span_of(stress), span_of(p), span_of(v), wavenumber);
    });
  });
}

}  // namespace asperity::python
