"""A task as a worker does it: computed, and written where the worker sees the store."""

from collections.abc import Sequence
from pathlib import Path

from asperity._core import Error
from asperity.sweep import chunks
from asperity.sweep.chunks import Place
from asperity.sweep.outcome import Outcome
from asperity.sweep.task import Task, compute

TOKEN = "_sweep/token"  # a text that no other store has, by which a worker knows this one


def work(task: Task) -> Outcome:
    """Compute a task. What is for a store is written if this process sees it, else it goes back."""
    outcome = compute(task)
    if task.store is not None:
        outcome.contents = chunks.encoded(outcome, task.variables, task.store.cut)
        outcome.sums = chunks.checksums(outcome.contents)
        outcome.values, outcome.failure = {}, None
        if _sees(task.store):
            write_box(task.store, task.variables, outcome)
    return outcome


def write_box(store: Place, variables: Sequence[str], outcome: Outcome) -> None:
    """Write the files of a box, each whole or not at all."""
    try:
        chunks.write(store.files(outcome.start, variables), outcome.contents or [])
    except OSError as error:
        reason = error.strerror or error
        raise Error(f"{store.path}: cannot be written: {reason}; --resume goes on") from error
    outcome.contents = None


def token_of(path: Path) -> str | None:
    """The text that is in a store's token; None where it cannot be read."""
    try:
        return (path / TOKEN).read_text()
    except (OSError, ValueError):
        return None


def _sees(store: Place) -> bool:
    return token_of(Path(store.path)) == store.token
