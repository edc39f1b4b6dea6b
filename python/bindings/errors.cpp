// The errors and notes of the core as objects of the package, whose classes are Python's: there they have their fields.
#include "asperity/errors.hpp"

#include <pybind11/gil_safe_call_once.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "arrays.hpp"
#include "topics.hpp"

namespace asperity::python {

namespace py = pybind11;

namespace {

struct Classes {
  py::object error, invalid_input, out_of_range, not_converged, note;
  py::tuple kinds;  // of phrases
};

constexpr std::array<std::string_view, 3> severities{"note", "warning", "fatal"};

const Classes& classes() {
  PYBIND11_CONSTINIT static py::gil_safe_call_once_and_store<Classes> storage;
  return storage
      .call_once_and_store_result([] {
        const py::module_ m = py::module_::import("asperity.base.diagnostics");
        return Classes{m.attr("Error"),        m.attr("InvalidInput"), m.attr("OutOfRange"),
                       m.attr("NotConverged"), m.attr("Note"),         m.attr("PHRASES")};
      })
      .get_stored();
}

py::tuple phrases(const Sentence& sentence) {
  py::tuple result(sentence.size());
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    const Phrase& phrase = sentence[i];
    const py::object kind = classes().kinds[static_cast<std::size_t>(phrase.kind)];
    result[i] = phrase.kind == Phrase::Kind::text ? py::object(py::str(phrase.text))
                                                  : kind(phrase.text, py::tuple(py::cast(phrase.numbers)), phrase.tag);
  }
  return result;
}

py::dict fields(const Diagnostic& d) {
  py::dict named;
  named["code"] = d.code;
  named["where"] = phrases(d.where);
  return named;
}

void raise(const py::object& kind, const Error& error) {
  const Diagnostic& d = error.diagnostic();
  const py::object raised = kind(*phrases(d.sentence), **fields(d));
  PyErr_SetObject(kind.ptr(), raised.ptr());
}

Sentence sentence_of(const py::handle& phrases) {
  Sentence sentence;
  for (const py::handle phrase : phrases) {
    const auto kind = classes().kinds.attr("index")(py::type::of(phrase)).cast<std::size_t>();
    if (kind == 0)
      sentence.emplace_back(phrase.cast<std::string>());
    else
      sentence.emplace_back(static_cast<Phrase::Kind>(kind), phrase.cast<std::string>(),
                            phrase.attr("numbers").cast<std::vector<double>>(), phrase.attr("tag").cast<std::string>());
  }
  return sentence;
}

}  // namespace

py::tuple tuple_of(const std::vector<Diagnostic>& notes) {
  py::tuple result(notes.size());
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const Diagnostic& d = notes[i];
    py::dict named = fields(d);
    named["severity"] = severities[static_cast<std::size_t>(d.severity)];
    named["next_step"] = phrases(d.next_step);
    result[i] = classes().note(*phrases(d.sentence), **named);
  }
  return result;
}

std::vector<Diagnostic> notes_of(const py::iterable& notes) {
  std::vector<Diagnostic> result;
  for (const py::handle note : notes) {
    const auto severity = std::ranges::find(severities, note.attr("severity").cast<std::string_view>());
    result.push_back(Diagnostic(note.attr("code").cast<std::string>(),
                                static_cast<Severity>(severity - severities.begin()),
                                sentence_of(note.attr("sentence")), sentence_of(note.attr("next_step_phrases")))
                         .within(sentence_of(note.attr("where"))));
  }
  return result;
}

void bind_errors(py::module_& m) {
  m.attr("Error") = classes().error;
  m.attr("InvalidInput") = classes().invalid_input;
  m.attr("OutOfRange") = classes().out_of_range;
  m.attr("NotConverged") = classes().not_converged;
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const InvalidInput& error) {
      raise(classes().invalid_input, error);
    } catch (const OutOfRange& error) {
      raise(classes().out_of_range, error);
    } catch (const NotConverged& error) {
      raise(classes().not_converged, error);
    } catch (const Error& error) {
      raise(classes().error, error);
    }
  });
}

}  // namespace asperity::python
