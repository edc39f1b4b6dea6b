// Diagnostics: sentences in phrases, the fields that they hold, and the errors that carry them.
#include "asperity/errors.hpp"

#include <algorithm>
#include <span>

namespace asperity {

namespace {

const Phrase* first(const Sentence& sentence, Phrase::Kind kind) {
  const auto phrase = std::ranges::find(sentence, kind, &Phrase::kind);
  return phrase == sentence.end() ? nullptr : &*phrase;
}

std::string joined(std::span<const Phrase> sentence) {
  std::string text;
  for (const Phrase& phrase : sentence) text += phrase.text;
  return text;
}

/// Behind ": must be ", up to an advice.
std::string allowed_in(const Sentence& sentence) {
  const auto must = std::ranges::find(sentence, Phrase::Kind::must, &Phrase::kind);
  if (must == sentence.end()) return {};
  return joined({must + 1, std::find_if(must, sentence.end(),
                                        [](const Phrase& phrase) { return phrase.kind == Phrase::Kind::advice; })});
}

Sentence advice_in(const Sentence& sentence) {
  const Phrase* phrase = first(sentence, Phrase::Kind::advice);
  return phrase ? Sentence{*phrase} : Sentence{};
}

}  // namespace

Diagnostic::Diagnostic(std::string code_, Severity severity_, Sentence sentence_, Sentence step)
    : code(std::move(code_)),
      severity(severity_),
      sentence(std::move(sentence_)),
      next_step(step.empty() ? advice_in(sentence) : std::move(step)) {
  if (const Phrase* phrase = first(sentence, Phrase::Kind::argument)) argument = phrase->text;
  allowed = allowed_in(sentence);
  if (const Phrase* phrase = first(sentence, Phrase::Kind::value)) {
    unit = phrase->tag;
    if (phrase->numbers.size() == 1)
      value = phrase->numbers.front();
    else
      value = phrase->text;
  }
}

std::string Diagnostic::text() const {
  return (severity == Severity::fatal ? "fatal: " : "") + joined(where) + joined(sentence);
}

Diagnostic Diagnostic::within(Sentence about) const {
  Diagnostic result = *this;
  result.where.insert(result.where.begin(), about.begin(), about.end());
  return result;
}

Error::Error(Diagnostic diagnostic)
    : std::runtime_error(diagnostic.text()), diagnostic_(std::make_shared<const Diagnostic>(std::move(diagnostic))) {}

Error::Error(std::string sentence) : Error(Diagnostic("error", Severity::error, {std::move(sentence)})) {}

InvalidInput::InvalidInput(Sentence sentence, std::string code)
    : Error(Diagnostic(std::move(code), Severity::error, std::move(sentence))) {}

OutOfRange::OutOfRange(Sentence sentence, std::string code)
    : Error(Diagnostic(std::move(code), Severity::error, std::move(sentence))) {}

NotConverged::NotConverged(Sentence sentence, std::string code)
    : Error(Diagnostic(std::move(code), Severity::error, std::move(sentence))) {}

}  // namespace asperity
