// What the library has to say of its input: errors, and the notes on a result. Both are data that a caller can act on,
// or tell in words and units of its own; what() and Diagnostic::text() are the sentence in ours.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "asperity/export.hpp"

namespace asperity {

/// A phrase of a sentence. Whoever knows an argument by another name, a temperature in another unit or another way to
/// follow an advice puts its own words in the place of `text`. Behind ": must be " stands what is allowed.
struct Phrase {
  enum class Kind { text, argument, value, unit, must, advice };
  Kind kind = Kind::text;
  std::string text;
  std::vector<double> numbers = {};  // of a value, with all digits; what an advice takes
  std::string tag = {};              // the unit of a value; the code of an advice

  Phrase(const char* words) : text(words) {}
  Phrase(std::string words) : text(std::move(words)) {}
  Phrase(Kind of, std::string words, std::vector<double> known = {}, std::string about = {})
      : kind(of), text(std::move(words)), numbers(std::move(known)), tag(std::move(about)) {}
};

using Sentence = std::vector<Phrase>;

/// A fatal note makes the result wrong or empty, a warning may make it so, a note is for information.
enum class Severity { note, warning, fatal, error };

struct ASPERITY_EXPORT Diagnostic {
  /// The fields are those of the phrases: the first argument, the first value, what is allowed. `step` is what to do
  /// about it, by default the advice in the sentence.
  Diagnostic(std::string code_, Severity severity_, Sentence sentence_, Sentence step = {});

  std::string code;  // stable: words of lower case, joined by hyphens
  Severity severity;
  std::string argument;                                     // empty: of none
  std::variant<std::monostate, double, std::string> value;  // as it was found
  std::string allowed;
  std::string unit;  // of the value, empty: the SI unit, or none
  Sentence where;    // before the sentence: at which point of many it is
  Sentence sentence;
  Sentence next_step;

  /// The sentence; a fatal one says so first.
  [[nodiscard]] std::string text() const;
  /// The same with what it is about before it.
  [[nodiscard]] Diagnostic within(Sentence about) const;
};

/// Base of all errors thrown by this library. what() names the argument, the value and what is allowed.
class ASPERITY_EXPORT Error : public std::runtime_error {
 public:
  explicit Error(Diagnostic diagnostic);
  explicit Error(std::string sentence);
  [[nodiscard]] const Diagnostic& diagnostic() const { return *diagnostic_; }
  [[nodiscard]] const std::string& code() const { return diagnostic_->code; }
  [[nodiscard]] const std::string& argument() const { return diagnostic_->argument; }
  [[nodiscard]] const auto& value() const { return diagnostic_->value; }
  [[nodiscard]] const std::string& allowed() const { return diagnostic_->allowed; }

 private:
  std::shared_ptr<const Diagnostic> diagnostic_;  // copies of an exception must not throw
};

/// An argument that cannot be used: wrong sign, shape, order, name.
class ASPERITY_EXPORT InvalidInput : public Error {
 public:
  using Error::Error;
  explicit InvalidInput(Sentence sentence, std::string code = "invalid-input");
  explicit InvalidInput(std::string sentence) : InvalidInput(Sentence{std::move(sentence)}) {}
};

/// Asked outside of what was measured; nothing is extrapolated silently.
class ASPERITY_EXPORT OutOfRange : public Error {
 public:
  using Error::Error;
  explicit OutOfRange(Sentence sentence, std::string code = "out-of-range");
  explicit OutOfRange(std::string sentence) : OutOfRange(Sentence{std::move(sentence)}) {}
};

/// The tolerance was not reached; the message has the estimate and its error.
class ASPERITY_EXPORT NotConverged : public Error {
 public:
  using Error::Error;
  explicit NotConverged(Sentence sentence, std::string code = "not-converged");
  explicit NotConverged(std::string sentence) : NotConverged(Sentence{std::move(sentence)}) {}
};

}  // namespace asperity
