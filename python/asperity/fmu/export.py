"""`export_fmu`: a friction map, the code that reads it and its description in one file."""

import hashlib
import os
import re
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from asperity.base.arguments import choice, path_of, whole
from asperity.base.diagnostics import refusal
from asperity.fmu.description import build_description, description
from asperity.fmu.variables import variables
from asperity.friction_map.look_up import FrictionMap
from asperity.io.archive import archived
from asperity.io.files import write_whole

_MOST_POINTS = 1000000
# the folder of a binary in the package and in FMI 3.0, that in FMI 2.0, and the end of its name
PLATFORMS = {"x86_64-linux": ("linux64", ".so"), "x86_64-windows": ("win64", ".dll")}
_FILES = Path(__file__).parent


def export_fmu(
    map: FrictionMap,
    path: str | os.PathLike[str],
    *,
    name: str = "friction",
    fmi: Literal["2.0", "3.0"] = "2.0",
    points: int | None = None,
) -> None:
    """Write a friction map as a Functional Mock-up Unit for co-simulation.

    Inputs are `pressure` [Pa] and `velocity` [m/s] of either sign; outputs `mu`, `mu_hysteresis`,
    `mu_adhesion`, `contact_area`, `traction` [Pa], `dmu_dlnp`, `dmu_dlnv` and `inside`, which is 0
    outside of the map's box. Outside, the parameter `clamp` chooses between the value at the
    nearest point of the box (true) and NaN, and the status is a warning. `max_error` is what the
    map was certified for, and the parameter `a_T` leads to another temperature.

    A map with heat takes `temperature` [K] where it covers several, and keeps `slid_distance` [m]:
    friction is cold when sliding begins, after a `reset`, at rest and when the velocity changes
    its sign, and heats up over the map's sliding length. The parameter `memory` switches that off.

    The map lies in `resources`, and the source of the binaries in `sources`.

    Parameters
    ----------
    map : FrictionMap
        What is looked up.
    path : str or path-like
        Where the FMU is written, whole or not at all.
    name : str
        The model's name, an identifier of C.
    fmi : {"2.0", "3.0"}
        The version of the standard.
    points : int, optional
        Number of contact points that the FMU looks up at once: arrays in FMI 3.0, variables
        `pressure[1]` to `pressure[n]` in 2.0. None is one point, and plain names.

    Raises
    ------
    InvalidInput
        `name` is no identifier, `fmi` is unknown, `points` is not from 1 to 1000000, or the file
        cannot be written.

    References
    ----------
    Modelica Association, Functional Mock-up Interface, versions 2.0.4 and 3.0.1,
    https://fmi-standard.org.
    """
    if not isinstance(map, FrictionMap):
        raise refusal("map", map, "a FrictionMap")
    target = path_of(path, "path")
    if not (isinstance(name, str) and re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", name)):
        raise refusal("name", name, "an identifier of C, such as friction")
    choice(fmi, "fmi", ("2.0", "3.0"))
    if points is not None:
        points = whole(points, "points", lowest=1, highest=_MOST_POINTS)
    write_whole(target, archived(fmu_files(map, name, fmi, points)))


def platforms() -> tuple[str, ...]:
    return tuple(one for one, (_, end) in PLATFORMS.items() if _binary(one, end).exists())


def _binary(platform: str, end: str) -> Path:
    return _FILES / "binaries" / platform / f"friction{end}"


def fmu_files(
    friction_map: FrictionMap, name: str = "friction", fmi: str = "2.0", points: int | None = None
) -> Iterator[tuple[str, bytes]]:
    listed = variables(friction_map)
    content = friction_map.to_bytes()
    digest = hashlib.sha256(f"{name} {fmi} {points} ".encode() + content).hexdigest()
    drawn = uuid.uuid5(uuid.NAMESPACE_OID, digest).int >> 32 << 32
    token = f"{{{uuid.UUID(int=drawn + (points or 1))}}}"  # the FMU reads the points of it
    yield "modelDescription.xml", description(fmi, name, token, listed, points, platforms())
    yield "resources/friction.fmap", content
    yield "resources/token.txt", f"{token}\n".encode()  # which a host must name
    yield "resources/points.txt", f"{points or 1}\n".encode()
    for platform in platforms():
        old, end = PLATFORMS[platform]
        folder = old if fmi == "2.0" else platform
        yield f"binaries/{folder}/{name}{end}", _binary(platform, end).read_bytes()
    if fmi == "3.0":
        yield "sources/buildDescription.xml", build_description(name)
    for source in sorted((_FILES / "sources").rglob("*")):
        if source.is_file():
            place = source.relative_to(_FILES / "sources").as_posix()
            yield f"sources/{place}", source.read_bytes()
    yield "documentation/licenses/license.txt", (_FILES / "license.txt").read_bytes()
