"""What clones of others' repositories hold, as objects of asperity. Nothing of it is stored here.

`k100kan35-dotcom/psfinal_hysteresis_redesign` has a road's C(q), master curves, shift factors and
strain factors of compounds, their dry mu, and numbers of the field's commercial program.
"""

import json
import subprocess
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

import asperity

Array = np.ndarray
Q1 = 1.05129e5  # 1/m, preset_data/surface_q1/IDIADA.txt
PRESSURE, TEMPERATURE = 0.3e6, 293.15  # preset_data/dataset


def given(address: str, needed: str) -> Path:
    """The clone that the command line names; without one the script ends, with nothing done."""
    if len(sys.argv) < 2 or not (Path(sys.argv[1]) / needed).exists():
        raise SystemExit(f"skipped: name a clone of https://github.com/{address}, with {needed}")
    root = Path(sys.argv[1])
    commit = subprocess.run(
        ["git", "-C", root, "log", "-1", "--format=%H of %cs"], capture_output=True, text=True
    )
    print(f"# {address} {commit.stdout.strip() or '(no git directory)'}\n")
    return root


@dataclass(frozen=True)
class Compound:
    """Files of one rubber below preset_data; its master curve is that of `reference` [C]."""

    master_curve: str
    shift: str
    mu: str
    strain: str
    reference: float


ONE_FOR_ALL = "fg_curve/R00"  # f and g; those of S100 by verify_fg_correct.py
COMPOUNDS = {
    "S100": Compound(
        "S100_master_final", "S100_at_final", "S100_total_mu_exp", "strain_sweep/S100_Y1_final", 40
    ),
    "S120": Compound(
        "S120_master_final", "S120_at_final", "S120_total_mu_exp", "strain_sweep/S120", 40
    ),
    "S140": Compound(
        "S140_master_final", "S140_at_final", "S140_dry_exp", "strain_sweep/S140Y1", 40
    ),
    "R20": Compound("R20", "R20_at", "R20", ONE_FOR_ALL, 20),  # its own is not there
    "R40": Compound("R40", "R40", "R40", ONE_FOR_ALL, 20),
}


@dataclass(frozen=True)
class Presets:
    root: Path

    def table(self, name: str) -> Array:
        return np.loadtxt(self.root / "preset_data" / f"{name}.txt", encoding="latin1").T

    def road(self, q1: float = Q1) -> asperity.TabulatedSpectrum:
        wavenumber, density = self.table("psd/IDIADA_PSD")
        return asperity.TabulatedSpectrum(wavenumber=wavenumber, density=density, q1=q1)

    def rubber(self, compound: str) -> asperity.MasterCurve:
        frequency, storage, loss = self.table(f"mastercurve/{COMPOUNDS[compound].master_curve}")
        order = np.argsort(frequency)
        return asperity.MasterCurve(
            angular_frequency=2 * np.pi * frequency[order],
            storage_modulus=storage[order],
            loss_modulus=loss[order],
            extrapolation="clamp",
        )

    def shift(self, compound: str) -> asperity.ShiftFactors:
        celsius, a_t = self.table(f"aT/{COMPOUNDS[compound].shift}")
        return asperity.ShiftFactors(
            reference_temperature=COMPOUNDS[compound].reference + 273.15,
            temperature=celsius + 273.15,
            log10_a_T=np.log10(a_t),
        )

    def factors(self, file: str) -> asperity.StrainFactors:
        """Of a table of f and g, or of the sweeps at 30 and 50 C and 1 Hz."""
        if file == ONE_FOR_ALL:
            strain, f, g = self.table(file)
            return asperity.StrainFactors(strain=strain, storage=f, loss=g)
        rows = self.table(file).T
        return asperity.strain_factors([_sweep(rows, at) for at in np.unique(rows[:, 0])[-2:]])

    def measured(self, compound: str) -> tuple[Array, Array]:
        """v [m/s] as the file has it, and dry mu."""
        log_v, mu = self.table(f"mu_dry/{COMPOUNDS[compound].mu}")
        return 10**log_v, mu

    @cached_property
    def _datasets(self) -> dict[str, dict[str, list[float]]]:
        result = json.loads((self.root / "reference_datasets.json").read_text(encoding="utf-8"))
        assert isinstance(result, dict)
        return result

    def program(self, name: str) -> tuple[Array, Array, Array]:
        """v, mu and A/A0 of the commercial program."""
        if name == "linear":
            files = ("persson_ref_mu_visc_linear", "persson_ref_contact_area_linear")
            columns = [
                np.loadtxt(self.root / f"reference_data/{file}.txt", encoding="utf-8").T
                for file in files
            ]
            return 10 ** columns[0][0], columns[0][1], columns[1][1]
        rows = self._datasets[name]
        velocity, mu, area = (np.array(rows[key]) for key in ("mu_log_v", "mu_vals", "area_vals"))
        return 10**velocity, mu, area


def _sweep(rows: Array, celsius: float) -> asperity.StrainSweep:
    rows = rows[rows[:, 0] == celsius]
    rows = rows[np.argsort(rows[:, 2])]
    rows = rows[np.r_[True, np.diff(rows[:, 2]) > 1e-5]]
    return asperity.StrainSweep(
        temperature=celsius + 273.15,
        angular_frequency=2 * np.pi,
        strain=rows[:, 2] / 100,
        storage_modulus=rows[:, 3] * 1e6,
        loss_modulus=rows[:, 4] * 1e6,
    )
