"""What can be taken away, scene and files, table, picture, map, FMU and report; pictures shown."""

import base64
import os
import tempfile
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

from asperity.app.state import State
from asperity.draw.style import drawn_in
from asperity.fmu.export import fmu_files
from asperity.friction_map.look_up import FrictionMap
from asperity.io.archive import archived
from asperity.plot.friction import friction_figure
from asperity.report.make import report_page
from asperity.scene.mapped import map_of_scene
from asperity.scene.model import Scene, SceneFriction
from asperity.scene.results import Bar, notes_of_all, table_of

# What a download is made of is taken at once; making it may take its time in a thread.
Make = Callable[[], bytes]

_drawing = threading.Lock()  # settings of matplotlib are those of the process
MAP_RTOL = 1e-3
Tell = Callable[[str], object]  # hears how far it is
CHECKED = 10_000  # random points of a map: a million, as by the shell, take minutes


def scene_archive(state: State) -> Make:
    """The scene and the files that it names, as `asperity friction scene.toml` takes them."""
    text, folder = state.text, state.folder.path
    names = [name for name in state.folder.shown if name in text]

    def make() -> bytes:
        files = ((name, (folder / name).read_bytes()) for name in names)
        return archived([("scene.toml", text.encode()), *files])

    return make


def table_csv(scene: Scene, curves: SceneFriction) -> bytes:
    """The table, byte for byte as the shell writes it beside the scene; `curves` have no band."""
    return table_of([_unplaced(scene)], [curves]).csv().encode()


def picture(named: Sequence[tuple[str, Scene]], curves: Sequence[SceneFriction]) -> bytes:
    """The package's own picture of the curves, by the names that they have on the page."""
    scenes = [replace(scene, path=Path(name)) for name, scene in named]
    with _drawing, drawn_in(None, notes_of_all(scenes, curves)):
        return friction_figure(scenes, curves, Path("friction.svg"))


def drawn(draw: Callable[[Path], bytes], style: str) -> str:
    """What is drawn into a file of that name, as an address that a page shows."""
    with _drawing, drawn_in(style):
        content = draw(Path("picture.png"))
    return f"data:image/png;base64,{base64.b64encode(content).decode()}"


def map_of(scene: Scene, tell: Tell) -> FrictionMap:
    """The friction map over a box about the scene's pressure and its velocities."""

    def progress(share: float) -> None:
        tell(f"{100 * share:.0f} %")

    return map_of_scene(_unplaced(scene), MAP_RTOL, checked=CHECKED, progress=progress)


def fmu_of(scene: Scene, tell: Tell) -> bytes:
    return archived(fmu_files(map_of(scene, tell)))


def report_of(state: State, tell: Tell) -> Make:
    """The report of the scene, compared with the variants that were kept."""
    texts = {"scene.toml": state.text}
    for i, variant in enumerate(state.variants, start=1):
        texts[f"variant-{i}.toml"] = state.text_of(variant.tables)
    names = ", ".join(["this scene", *(one.name for one in state.variants)])
    title = "Friction" if len(texts) == 1 else f"Friction of {names}"
    folder, files = state.folder.path, list(state.folder.shown)

    def make() -> bytes:
        with tempfile.TemporaryDirectory(prefix="report-", dir=folder) as name:
            aside = Path(name)  # the session's own scene file may change meanwhile
            for file in files:
                os.link(folder / file, aside / file)
            for file, text in texts.items():
                (aside / file).write_text(text, encoding="utf-8")
            paths = [aside / file for file in texts]
            with _drawing:
                page = report_page(paths, title, _bar(tell), folder=aside)
        return page.encode()

    return make


def _bar(tell: Tell) -> Bar:
    """What a report takes to say how far it is."""

    def told(title: str, chunks: list[slice]) -> Iterator[slice]:
        for i, chunk in enumerate(chunks):
            tell(f"{title}, {100 * i // len(chunks)} %")
            yield chunk

    return lambda title: lambda chunks: nullcontext(told(Path(title).name, chunks))


def _unplaced(scene: Scene) -> Scene:
    """The scene without the folder that it is in here."""
    return replace(scene, path=Path(scene.path.name))
