"""`report`, as Python calls it."""

import os
from collections.abc import Iterable

from asperity.base.arguments import path_of
from asperity.base.diagnostics import refusal

Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]


def report(scenes: Paths, path: str | os.PathLike[str], *, title: str | None = None) -> None:
    """Write a report of scenes as one HTML file: open it in any browser, print it, send it.

    The file holds pictures of mu(v), of the surface and of the rubber, tables, the errors of mu by
    the numbers, the inputs and the model, notes, the inputs with the digests of the files that they
    came from, versions, and the text of each scene. It loads nothing and runs nothing. Of several
    scenes each is compared with the first, and the points are told whose difference is larger than
    the errors. Needs matplotlib and Jinja2, `pip install asperity[plot]`.

    Parameters
    ----------
    scenes : path-like or iterable of path-like
        Scene files, at most 20.
    path : path-like
        Where to write, replaced whole if it is there; it must not be one of the inputs.
    title : str, optional
        The heading, by default the names of the scenes.

    Raises
    ------
    InvalidInput, OutOfRange, NotConverged
        A scene that cannot be read or computed, as the shell command says it.

    Examples
    --------
    >>> asperity.report(["dry.toml", "wet.toml"], "report.html")  # doctest: +SKIP
    """
    from asperity.report.make import write_report  # here: `import asperity` is to be quick

    output = path_of(path, "path")
    if title is not None and not isinstance(title, str):
        raise refusal("title", title, "a text")
    try:
        if isinstance(scenes, dict):
            raise TypeError
        names = [scenes] if isinstance(scenes, str | os.PathLike) else list(scenes)
    except TypeError:
        raise refusal("scenes", scenes, "paths of scene files") from None
    write_report([path_of(one, f"scenes[{i}]") for i, one in enumerate(names)], output, title)
