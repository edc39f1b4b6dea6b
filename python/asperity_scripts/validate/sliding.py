"""`validate --sliding`: mu(v) of a map by exact sliding contact, beside the theory's."""

from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from asperity.base import quantities
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import Note
from asperity.cli.friction_commands import progress
from asperity.cli.options import typed_options
from asperity.cli.streams import print_stdout, tell_notes
from asperity.demo import input_files
from asperity.draw.figure import check_plot
from asperity.draw.style import drawn_in
from asperity.io import plausible
from asperity.io.files import check_directory, refuse_overwrite, write_files
from asperity.io.table import Table
from asperity.scene.model import Scene
from asperity.scene.scene import load_scene
from asperity.self_affine_fit import synthesize
from asperity.spectrum import SelfAffineSpectrum
from asperity.surface import HeightMap
from asperity_scripts.validate.compared import compare

FILES = ("sliding.md", "sliding.csv", "sliding.png")
_MOST_VELOCITIES = 9  # of a scene; each takes seconds to minutes


def own_map() -> HeightMap:
    """The map where none is given: Table 1's asphalt, four longest waves to a side, q1/q0 = 8."""
    asphalt = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000.0, q1=16_000.0)
    side = 4 * 2 * np.pi / asphalt.q0
    return synthesize(asphalt, shape=(256, 256), pixel_size=side / 256, seed=1)


def validate_sliding(args: Namespace, surface: HeightMap | None, facts: dict[str, object]) -> None:
    directory = FilePath(args.output)
    check_plot(directory / FILES[2])
    check_directory(directory, FILES, force=args.force)
    with plausible.collected(typed_options(args)) as unusual:
        plausible.check("--velocities", args.velocities or [], quantities.VELOCITY)
    scene, notes = _scene(args)
    notes += unusual
    inputs = [FilePath(name) for name in (args.surface, args.rubber) if name is not None]
    refuse_overwrite([directory / name for name in FILES], inputs)
    velocity = np.array(args.velocities) if args.velocities else scene.velocity
    if velocity.size > _MOST_VELOCITIES and not args.velocities:
        kept = np.linspace(0, velocity.size - 1, _MOST_VELOCITIES).round().astype(int)
        text = f"{kept.size} of the scene's {velocity.size} velocities; see --velocities"
        notes.append(Note(text, code="fewer-velocities"))
        velocity = velocity[kept]
    comparison = compare(
        own_map() if surface is None else surface,
        scene.rubber,
        pressure=scene.pressure.tolist(),
        velocity=velocity.tolist(),
        poisson_ratio=scene.options.get("poisson_ratio", 0.5),
        periodic=surface is None or args.periodic,
        progress=progress("sliding contacts"),
    )
    notes += comparison.notes
    rubber = args.rubber or "scene.toml, shipped"
    table = Table("validate --sliding", [{"rubber": rubber, **facts}], notes, comparison.columns())
    with drawn_in(args.style):
        picture = comparison.figure(Path(FILES[2]))
    contents = (comparison.summary().encode(), table.csv().encode(), picture)
    write_files({directory / n: data for n, data in zip(FILES, contents, strict=True)})
    tell_notes(notes, args.notes)
    print_stdout(f"{comparison.summary()}\nfiles: {directory}: {', '.join(FILES)}\n")


def _scene(args: Namespace) -> tuple[Scene, list[Note]]:
    """The scene whose rubber, pressures and velocities are taken; the shipped one unless named."""
    if args.rubber is not None:
        scene = load_scene(FilePath(args.rubber))
        return scene, list(scene.built_rubber.notes)
    with TemporaryDirectory() as aside:
        write_files({FilePath(aside) / name: data for name, data in input_files().items()})
        scene = load_scene(FilePath(aside) / "scene.toml")
    return replace(scene, path=Path("scene.toml")), []
