"""The order of notes, and how one tells what it is about. A fatal one says so in its first word."""

from collections.abc import Iterable

FATAL = "fatal: "


def fatal_first(notes: Iterable[str]) -> list[str]:
    """Each note once, those that make the result wrong or empty before the others."""
    return sorted(dict.fromkeys(notes), key=lambda note: not note.startswith(FATAL))


def note_about(subject: str, note: str) -> str:
    """A note with the name of what it is about, which stays behind the word that it is fatal."""
    if note.startswith(FATAL):
        return f"{FATAL}{subject}: {note.removeprefix(FATAL)}"
    return f"{subject}: {note}"
