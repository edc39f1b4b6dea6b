"""Measured files that are not in the repository, and what is made of them."""

import os
from pathlib import Path

import numpy as np
import pytest

from asperity import build_master_curve, read_isotherms
from helpers import made_files

COLUMNS = {"frequency": "freq_hz", "temperature": "temperature_C"}
COLUMNS |= {"storage": "G_storage_pa", "loss": "G_loss_pa"}
UNITS = {"frequency": "Hz", "temperature": "C", "modulus": "Pa"}
POLYISOPRENE = {
    "columns": {"frequency": "Freq", "temperature": "Temp", "storage": "G'", "loss": 'G"'},
    "units": {"frequency": "rad/s", "temperature": "C", "modulus": "Pa"},
    "modulus": "G",
}
# log10 a_T = -B1 (T - T_r) / ((B2 + T_r) (B2 + T)), T in C: RepTate (jorge-ramirez-upm/RepTate),
# polyisoprene of RepTate/tools/CreateMaterialsDatabaseFile.py, the law in theories/TheoryWLF.py;
# b_T has the density, proportional to 1 / (1 + alpha T)
B1, B2, ALPHA = 691.6245, 114.3, 10**-3.2147


# measured files go through the same tests as made ones, where there are any
SOURCES = ("made", "measured") if os.environ.get("ASPERITY_DATA") else ("made",)


def scans_of(measured):
    """Pairs of a source and a name, for tests that all scans go through."""
    pairs = [("made", name) for name in made_files.FILES]
    return pairs + [("measured", name) for name in measured if "measured" in SOURCES]


def present(*parts):
    """A measured file or folder of ASPERITY_DATA; the test skips where it is absent."""
    name, folder = "/".join(parts), os.environ.get("ASPERITY_DATA")
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
