"""Errors and notes as the page says them: no names of Python, few digits."""

from asperity.base.diagnostics import Advice, Argument, Error, Sentence, Value
from asperity.io.fields import inside

_ARGUMENTS = {"slope_cutoff": "the wanted rms slope"}
_ADVICE = {
    "see-branches": "as its branches show",
    "give-macro-wavenumber": "the page sets none",
}


def in_words(sentence: Sentence) -> Sentence:
    """The same for a reader who does not program."""
    said: list[str] = []
    for phrase in sentence:
        if isinstance(phrase, Argument):
            phrase = phrase.saying(_ARGUMENTS.get(phrase, phrase))
        elif isinstance(phrase, Advice) and phrase.tag == "allowed-velocities":
            phrase = phrase.saying("from {:g} to {:g} m/s".format(*inside(phrase)))
        elif isinstance(phrase, Advice):
            phrase = phrase.saying(_ADVICE.get(phrase.tag, phrase))
        elif isinstance(phrase, Value) and len(phrase.numbers) == 1:
            phrase = phrase.saying(min(phrase, f"{phrase.numbers[0]:.4g}", key=len))
        said.append(phrase)
    return tuple(said)


def in_one_line(error: Error) -> str:
    """The text of an error, whatever a library put into it."""
    return " ".join(str(error).split())


def allowed_velocities(error: Error) -> tuple[float, float] | None:
    """Velocities [m/s] that an error offers, both within what it allows."""
    for phrase in error.sentence:
        if isinstance(phrase, Advice) and phrase.tag == "allowed-velocities":
            return inside(phrase)
    return None
