"""Files of instruments, made, or measured and not in the repository; what is built of them."""

import os
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from asperity import build_master_curve, read_isotherms
from helpers import made_files
from helpers.made_sweeps import B1, B2

COLUMNS = {"frequency": "freq_hz", "temperature": "temperature_C"}
COLUMNS |= {"storage": "G_storage_pa", "loss": "G_loss_pa"}
UNITS = {"frequency": "Hz", "temperature": "C", "modulus": "Pa"}
POLYISOPRENE = {
    "columns": {"frequency": "Freq", "temperature": "Temp", "storage": "G'", "loss": 'G"'},
    "units": {"frequency": "rad/s", "temperature": "C", "modulus": "Pa"},
    "modulus": "G",
}


# measured files go through the same tests as made ones, where there are any
SOURCES = ("made", "measured") if os.environ.get("ASPERITY_DATA") else ("made",)


_folders = [None]


def scans_of(measured):
    """Pairs of a source and a name, for tests that all scans go through."""
    pairs = [("made", name) for name in made_files.FILES]
    return pairs + [("measured", name) for name in measured if "measured" in SOURCES]


@contextmanager
def files_from(folder):
    """Let `present` look into a folder of made files, or into ASPERITY_DATA where it is None."""
    _folders.append(folder)
    try:
        yield
    finally:
        _folders.pop()


def present(*parts):
    """A file or folder of a source; the test skips where it is absent."""
    name, folder = "/".join(parts), _folders[-1] or os.environ.get("ASPERITY_DATA")
    if not folder or not Path(folder, name).exists():
        pytest.skip(f"set ASPERITY_DATA to a folder with {name}")
    return Path(folder, name).resolve()


def shear(name, **options):
    file = present("dma", name, "tf_015p.csv")
    isotherms = read_isotherms(file, columns=COLUMNS, units=UNITS, modulus="G")
    return build_master_curve(isotherms, reference_temperature=293.15, **options)


def polyisoprene(reference_temperature=273.15, **options):
    files = sorted(present("dma", "reptate_pi1000k").glob("*.osc"))
    isotherms = read_isotherms(files, **POLYISOPRENE)
    return build_master_curve(isotherms, reference_temperature=reference_temperature, **options)


def published(build):
    t, reference = build.temperature - 273.15, build.reference_temperature - 273.15
    result = -B1 * (t - reference) / ((B2 + reference) * (B2 + t))
    assert np.ptp(result) > 4
    return result
