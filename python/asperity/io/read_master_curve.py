"""Rubber from files."""

from pathlib import Path
from typing import Literal

import numpy as np

from asperity._core import InvalidInput
from asperity.base import quantities
from asperity.base.diagnostics import MUST_BE, Argument
from asperity.io import plausible
from asperity.io.instrument import brief
from asperity.io.read_surface import cell, filled_lines
from asperity.rubber import MasterCurve

_MASTER_CURVE = ["angular_frequency_rad_s", "storage_modulus_pa", "loss_modulus_pa"]


def read_master_curve(
    path: Path, extrapolation: Literal["power-law", "clamp"] | None
) -> MasterCurve:
    """Master curve from a CSV file with a header line that names its three columns."""
    table = filled_lines(path)
    header = ",".join(_MASTER_CURVE)
    if not table or [name.strip() for name in table[0][1]] != _MASTER_CURVE:
        found = brief(",".join(table[0][1])) if table else "nothing"
        raise InvalidInput(Argument("header"), f" is {found!r}", MUST_BE, f"{header!r}", where=path)
    rows = []
    for number, cells in table[1:]:
        if len(cells) != len(_MASTER_CURVE):
            raise InvalidInput(
                f"line {number} has {len(cells)} cells", MUST_BE, f"3 ({header})", where=path
            )
        try:
            rows.append([cell(text) for text in cells])
        except ValueError as error:
            raise InvalidInput(f"line {number}: {error}", where=path) from error
    columns = np.array(rows).reshape(-1, 3).T
    try:
        curve = MasterCurve(
            angular_frequency=columns[0],
            storage_modulus=columns[1],
            loss_modulus=columns[2],
            extrapolation=extrapolation,
        )
    except InvalidInput as error:
        raise error.within(path) from error
    largest = np.max(np.hypot(curve.storage_modulus, curve.loss_modulus))
    plausible.check("largest |E|", largest, quantities.MODULUS, path=path)
    return curve
