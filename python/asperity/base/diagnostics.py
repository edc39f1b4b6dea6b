"""Errors and notes as data: sentences in phrases, which every edge may say in words of its own.

The library says them as its callers write: arguments by their names, SI units. A scene puts its
keys there, and temperatures as they were given; the app what a reader sees who does not program.
"""

from collections.abc import Callable, Iterable
from functools import partial
from html import escape
from typing import Any, Self

from asperity.base.codes import FATAL, KINDS, NOTE, WARNING, Kind


class Phrase(str):
    """A phrase of a sentence that is more than its text."""

    numbers: tuple[float, ...]  # with all digits
    tag: str

    def __new__(cls, text: str, numbers: tuple[float, ...] = (), tag: str = "") -> Self:
        """Make a phrase of the text as a caller of the library reads it."""
        phrase = super().__new__(cls, text)
        phrase.numbers, phrase.tag = numbers, tag
        return phrase

    def saying(self, text: str) -> Self:
        return type(self)(text, self.numbers, self.tag)


class Argument(Phrase):
    """The name of an argument."""


class Value(Phrase):
    """What was found for the argument before it; the tag is its unit where that matters."""


class Unit(Phrase):
    """The unit behind a value, which is its tag."""


def kelvin(temperature: float) -> tuple[Value, Unit]:
    """Return a temperature as phrases that an edge may say in degrees Celsius."""
    return Value(f"{temperature:.5g}", (float(temperature),), "K"), Unit(" K", (), "K")


class Must(Phrase):
    """Stands before what is allowed."""


class Advice(Phrase):
    """What would help; the tag is its code."""


class File(Phrase):
    """The name of a file."""


MUST_BE = Must(": must be ")
PHRASES: tuple[type, ...] = (str, Argument, Value, Unit, Must, Advice)  # in the order of the core
Sentence = tuple[str, ...]
Words = Callable[[Sentence], Sentence]  # says a sentence in words of an edge


class _Diagnostic:
    """What errors and notes share.

    Attributes
    ----------
    code : str
        Stable, words joined by hyphens.
    argument : str
        What it is about, by its name; empty where it is about none.
    value : float, str or None
        What was found.
    allowed : str
        What must be there instead, empty where the sentence says it otherwise.
    unit : str
        Of the value, empty for the SI unit or none.
    sentence, where, after : tuple of str
        The phrases, those before them that say what it is about, and what else there is to say.
    """

    code: str
    argument: str
    value: float | str | None
    allowed: str
    unit: str
    sentence: Sentence
    where: Sentence
    after: Sentence

    def _tell(self, sentence: Sentence, where: Sentence, after: Sentence) -> None:
        self.sentence, self.where, self.after = sentence, where, after
        kinds = [type(phrase) for phrase in sentence]
        self.argument = str(sentence[kinds.index(Argument)]) if Argument in kinds else ""
        self.value, self.unit = None, ""
        if Value in kinds:
            value: Any = sentence[kinds.index(Value)]
            self.value = value.numbers[0] if len(value.numbers) == 1 else str(value)
            self.unit = value.tag
        start = kinds.index(Must) + 1 if Must in kinds else len(kinds)
        end = kinds.index(Advice, start) if Advice in kinds[start:] else len(kinds)
        self.allowed = "".join(sentence[start:end])

    def _made_of(self, sentence: Sentence, where: Sentence, after: Sentence) -> Self:
        raise NotImplementedError

    @property
    def identity(self) -> tuple[str, str]:
        """What it shares with the same on other numbers."""
        return self.code, self.argument

    def within(self, *where: object) -> Self:
        """Return the same with what it is about before it: phrases, or a file."""
        about = where if isinstance(where[0], str) else where[0]
        return self._made_of(self.sentence, (*_about(about), *self.where), self.after)

    def followed_by(self, *more: str) -> Self:
        return self._made_of(self.sentence, self.where, (*self.after, *more))

    def said(self, words: Words) -> Self:
        """Return the same in words of an edge."""
        return self._made_of(words(self.sentence), words(self.where), words(self.after))


def _about(where: Any) -> Sentence:
    """Return what stands before a sentence: phrases, or those of a file."""
    return where if isinstance(where, tuple) else (File(f"{where}"), ": ")


class Error(_Diagnostic, Exception):
    """Base of all errors of asperity: `code`, `argument`, `value` and `allowed` say what is wrong.

    Its text names the argument, the value found and what is allowed.
    """

    code = "error"

    def __init__(
        self, *sentence: str, code: str = "", where: object = (), after: Sentence = ()
    ) -> None:
        """Take the phrases of the sentence, at least one, and the file that it is about."""
        about = _about(where)
        super().__init__("".join((*about, *sentence, *after)))
        if code:
            self.code = code
        self._tell(sentence, about, after)

    def _made_of(self, sentence: Sentence, where: Sentence, after: Sentence) -> Self:
        return type(self)(*sentence, code=self.code, where=where, after=after)


class InvalidInput(Error, ValueError):
    """An argument that cannot be used; the text names it, the value found and what is allowed."""

    code = "invalid-input"


class OutOfRange(Error):
    """Asked outside of what was measured; nothing is extrapolated silently."""

    code = "out-of-range"


class NotConverged(Error):
    """The tolerance was not reached; the message has the estimate and its error."""

    code = "not-converged"


for _kind in (Error, InvalidInput, OutOfRange, NotConverged):
    _kind.__module__ = "asperity"


_ANY = Kind(NOTE, "any other", "", 0.0)


class Note(_Diagnostic, str):
    """A note on a result: a text, which knows what it is about.

    Attributes
    ----------
    severity : {"fatal", "warning", "note"}
        A fatal one makes the result wrong or empty, a warning may make it so.
    next_step : str
        What to do about it; every fatal one and every warning has it.
    effect : float
        Relative change of mu that it may stand for, as far as is known.
    code, argument, value, allowed, unit
        As those of an error.
    """

    severity: str
    next_step: str
    next_step_phrases: Sentence
    effect: float

    def __new__(
        cls,
        *sentence: str,
        code: str = "note",
        severity: str = "",
        next_step: Sentence | str = (),
        effect: float | None = None,
        where: object = (),
        after: Sentence = (),
    ) -> Self:
        """Take the phrases of the sentence; a fatal one says so in its first word.

        What is left out is that of the code.
        """
        kind = KINDS.get(code, _ANY)
        severity = severity or kind.severity
        about = _about(where)
        text = "".join((*about, *sentence, *after))
        note = super().__new__(cls, f"{FATAL}: {text}" if severity == FATAL else text)
        note.code, note.severity = code, severity
        note.effect = kind.effect if effect is None else effect
        note._tell(sentence, about, after)
        if isinstance(next_step, str):
            next_step = (next_step,) if next_step else ()
        advice = tuple([one for one in sentence if type(one) is Advice][:1])
        usual = (kind.next_step,) if kind.next_step else ()
        note.next_step_phrases = next_step or advice or usual
        note.next_step = "".join(note.next_step_phrases)
        return note

    def _made_of(self, sentence: Sentence, where: Sentence, after: Sentence) -> Self:
        kept: Any = {name: getattr(self, name) for name in ("code", "severity", "effect")}
        kept |= {"next_step": self.next_step_phrases, "where": where, "after": after}
        return type(self)(*sentence, **kept)

    def said(self, words: Words) -> Self:
        """Return the same in words of an edge, what to do too."""
        made = super().said(words)
        made.next_step_phrases = words(self.next_step_phrases)
        made.next_step = "".join(made.next_step_phrases)
        return made

    @property
    def with_step(self) -> str:
        """The text, and what to do about it unless the sentence says it."""
        advice = [one for one in self.next_step_phrases if isinstance(one, Advice)]
        said = any(one in self.sentence for one in advice)
        return f"{self} -> {self.next_step}" if self.next_step and not said else str(self)

    @property
    def label(self) -> str:
        """Severity, code and argument, as files have them beside the text."""
        return " ".join(filter(None, (self.severity, self.code, self.argument)))

    @property
    def line(self) -> str:
        """The note in a line of a file, for `of_line`; behind a tab what to do about it."""
        text = "".join((*self.where, *self.sentence, *self.after)).replace("\t", " ")
        return f"{self.label}: {text}" + (f"\t{self.next_step}" if self.next_step else "")

    @classmethod
    def of_line(cls, line: str) -> Self:
        front, _, next_step = line.partition("\t")
        label, _, text = front.partition(": ")
        return cls.of_label(label, text, next_step)

    @classmethod
    def of_label(cls, label: str, text: str, next_step: str = "") -> Self:
        severity, code, argument = (*label.split(" ", 2), "", "")[:3]
        begin = f"{FATAL}: " * (severity == FATAL)
        note = cls(text.removeprefix(begin), code=code, severity=severity, next_step=next_step)
        note.argument = argument
        return note


_ORDER = (FATAL, WARNING, NOTE)
_INKS = {FATAL: ' style="color: #a30000; font-weight: 600"', WARNING: ' style="color: #704000"'}


def fatal_first(notes: Iterable[Note]) -> list[Note]:
    """Each note once, those that make the result wrong or empty before the others."""
    return sorted(dict.fromkeys(notes), key=lambda note: note.severity != FATAL)


def first_step(notes: Iterable[Note]) -> str:
    """The one thing to do next, empty where there is none: that of the note that makes the result
    wrong, or else of the one with the largest effect on mu."""
    known = [note for note in notes if note.next_step and note.severity != NOTE]
    if not known:
        return ""
    worst = min(known, key=lambda note: (_ORDER.index(note.severity), -note.effect))
    return f"{worst.next_step} ({worst.code})"


def html_items(notes: Iterable[Note]) -> str:
    """The notes as items of an HTML list, fatal ones first and coloured; above them what to do
    first."""
    kept = fatal_first(notes)
    step = first_step(kept)
    items = [f"<li>Next: {escape(step)}</li>"] if step else []
    items += [f"<li{_INKS.get(n.severity, '')}>{escape(n.with_step)}</li>" for n in kept]
    return "".join(items)


def few_lines(notes: Iterable[Note], most: int) -> list[str]:
    """The notes in so many lines, the last of which is the first step: the gravest first, those of
    a code joined, and how many are left out."""
    kinds: dict[str, list[Note]] = {}
    for note in dict.fromkeys(notes):
        kinds.setdefault(note.code, []).append(note)
    order = sorted(kinds.values(), key=lambda one: (_ORDER.index(one[0].severity), -one[0].effect))
    step = first_step(note for one in order for note in one)
    room = most - bool(step)
    shown = order if len(order) <= room else order[: room - 1]
    lines = [
        f"note: {first.with_step}" + f" (and {len(rest)} alike)" * bool(rest)
        for first, *rest in shown
    ]
    hidden = [note for one in order[len(shown) :] for note in one]
    if hidden:
        counts = [(how, sum(note.severity == how for note in hidden)) for how in _ORDER]
        kinds_of = ", ".join(f"{n} {how}" for how, n in counts if n)
        lines.append(f"note: {len(hidden)} more ({kinds_of}): --notes all shows them")
    return [*lines, f"next: {step}"] if step else lines


def brief(value: object) -> str:
    """Return what was found, in one short line."""
    try:
        return " ".join(repr(value)[:60].split())
    except Exception:  # a whole number of more digits than Python writes, or a class's own trouble
        return f"a {type(value).__name__}"


def valued(value: Any, text: str = "") -> Value:
    """Return what was found as a phrase, shown as `text`."""
    several = value if isinstance(value, tuple) else (value,)
    known = all(isinstance(one, int | float) and not isinstance(one, bool) for one in several)
    try:
        return Value(text or brief(value), tuple(map(float, several)) if known else ())
    except OverflowError:
        return Value(text or brief(value))


def refusal(
    argument: str, value: Any, allowed: str, *, text: str = "", where: object = ()
) -> InvalidInput:
    """Return the error "where: argument = value: must be allowed", `value` shown as `text`."""
    about = Argument(argument), " = ", valued(value, text)
    return InvalidInput(*about, MUST_BE, allowed, code="invalid-value", where=where)


def unfit(argument: str, value: Any, problem: str, text: str = "") -> InvalidInput:
    """Return the error "argument = value: problem", `value` shown as `text`."""
    return InvalidInput(Argument(argument), " = ", valued(value, text), f": {problem}")


def must_be(
    argument: str, allowed: str, found: str = "", *, where: object = (), must: Must = MUST_BE
) -> InvalidInput:
    """Return the error "where: argument found: must be allowed"; it need not be about one."""
    sentence = Argument(argument), found, must, allowed
    return InvalidInput(*filter(None, sentence), where=where)


must_have = partial(must_be, must=Must(": must have "))
