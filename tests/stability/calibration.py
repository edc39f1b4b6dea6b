"""Numbers of scenes from friction whose truth is known: do they come back, and do intervals hold?

    python tests/stability/calibration.py [--trials 200] [--seed 1] [--points 8]

A law and a Prony series, three numbers free, started a factor of 1.5 to 2 off; and where
ASPERITY_DATA is set the scan opd-1 with the isotherms of epdm_70, two numbers free, and the same
scene with nothing free held against points that a scan and a rubber made that were drawn from the
errors of these. Points scatter by 5 %, at two pressures and `--points` velocities. Printed as
tables: the share of 95 % intervals that hold the truth, mean of ln(found / true) in standard
errors, the standard error, and rms of points, of points left out and of the same mu everywhere. A
tenth of the trials goes to the measured scene, with each of six seeds.
"""

import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
from options import options

import asperity

NOISE = 0.05
MADE = {
    "surface": {"rms_height_m": 265e-6, "hurst": 0.87, "q0_per_m": 300.0, "q1_per_m": 2e5},
    "rubber": {
        "equilibrium_modulus_pa": 3e6,
        "moduli_pa": [1e7, 1e8, 5e8],
        "relaxation_times_s": [1e-3, 1e-5, 1e-7],
    },
    "conditions": {"pressure_pa": 2e5, "velocity_m_s": 0.1},
    "correction": {"kind": "partial-contact"},
    "adhesion": {"shear_stress_pa": 1e6},
}
COLUMNS = {"frequency": "freq_hz", "temperature": "temperature_C"}
COLUMNS |= {"storage": "G_storage_pa", "loss": "G_loss_pa"}


def measured(folder: Path) -> dict[str, Any]:
    """A scene of measured files, whose band the isotherms cover at the velocities below."""
    return {
        "surface": {"file": str(folder / "topography/opd-1.opd"), "q1_per_m": 1e7},
        "rubber": {
            "isotherms": [str(folder / "dma/epdm_70/tf_015p.csv")],
            "columns": COLUMNS,
            "units": {"frequency": "Hz", "temperature": "C", "modulus": "Pa"},
            "modulus": "G",
        },
        "conditions": {"pressure_pa": 2e5, "velocity_m_s": 1e-4, "temperature_c": 20.0},
        "correction": {"kind": "partial-contact"},
        "adhesion": {"shear_stress_pa": 2e5},
        "uncertainty": {"samples": 100},
    }


def changed(tables: dict[str, Any], numbers: dict[str, float]) -> dict[str, Any]:
    result = {name: dict(table) for name, table in tables.items()}
    for key, value in numbers.items():
        table, _, field = key.partition(".")
        result[table][field] = value
    return result


def truth_of(tables: dict[str, Any], velocity: Any) -> tuple[Any, Any, Any]:
    """mu without scatter, with the pressures and velocities."""
    p, v = np.repeat([1e5, 4e5], velocity.size), np.tile(velocity, 2)
    points = {"mu": np.ones(p.size), "velocity": v, "pressure": p}
    return asperity.fit_scene(tables, points).mu, p, v


def recovered(name: str, tables: Any, start: Any, velocity: Any, trials: int, seed: int) -> None:
    mu, p, v = truth_of(tables, velocity)
    keys = [*start]
    true = np.array([tables[key.partition(".")[0]][key.partition(".")[2]] for key in keys])
    held, off, errors, rms = [], [], [], []
    for k in range(trials):
        rng = np.random.default_rng([seed, k])
        points = {"mu": mu * np.exp(NOISE * rng.normal(size=p.size)), "velocity": v, "pressure": p}
        fit = asperity.fit_scene(changed(tables, start), points, free=keys)
        value, low, high = (
            np.array([one[key] for key in keys]) for one in (fit.value, fit.lower, fit.upper)
        )
        error = np.sqrt(np.diag(fit.covariance))
        held.append((low < true) & (true < high))
        off.append(np.log(value / true) / error)
        errors.append(error)
        rms.append([fit.rms, fit.rms_left_out, fit.rms_same_mu])
    for k, key in enumerate(keys):
        share, mean = 100 * np.mean(held, axis=0)[k], np.mean(off, axis=0)[k]
        size = 100 * np.median(errors, axis=0)[k]
        print(f"| {name} | {key} | {share:.1f} | {mean:+.2f} | {size:.1f} |", flush=True)
    of_fit, left_out, same = 100 * np.median(rms, axis=0)
    print(f"  rms {of_fit:.1f} %, left out {left_out:.1f} %, the same mu {same:.0f} %", flush=True)


def compared(tables: dict[str, Any], velocity: Any, trials: int, seed: int) -> None:
    """Points of a scan and a rubber that are as far off as their errors say."""
    path = Path("scene.toml")
    scene = asperity.scene.scene.scene_of(path, tables, for_friction=True)
    _, p, v = truth_of(tables, velocity)
    inside, sentence = [], ""
    for k in range(trials):
        rng = np.random.default_rng([seed, k, 1])
        with np.errstate(all="ignore"):
            mu = asperity.friction(
                scene.surface.drawn(rng),
                scene.built_rubber.drawn(rng).rubber,
                pressure=p,
                velocity=v,
                correction=scene.correction,
                adhesion=scene.adhesion,
            ).mu
        mu = mu * np.exp(NOISE * rng.normal(size=p.size))
        points = {"mu": mu, "velocity": v, "pressure": p}
        fit = asperity.fit_scene(tables, points, scatter=NOISE)
        inside.append(fit.inside)
        sentence = sentence or fit.sentence
    print(f"nothing free, inputs drawn: {100 * np.mean(inside):.1f} % of points inside; {sentence}")


def main() -> int:
    asked = options(__doc__, trials=200, seed=1, points=8)
    how = asked.trials, asked.seed
    print("| scene | number | intervals that hold it [%] | off [errors] | error [%] |")
    print("| --- | --- | --- | --- | --- |")
    start = {"adhesion.shear_stress_pa": 5e5, "rubber.equilibrium_modulus_pa": 4.5e6}
    start["surface.q1_per_m"] = 3e5
    recovered("law, series", MADE, start, np.geomspace(1e-5, 1, asked.points), *how)
    if (data := os.environ.get("ASPERITY_DATA")) is None:
        return 0
    tables, velocity = measured(Path(data)), np.geomspace(1e-6, 1e-2, asked.points)
    start = {"adhesion.shear_stress_pa": 4e5, "surface.q1_per_m": 7e6}
    fewer = max(asked.trials // 10, 1)  # they take ten times as long
    for seed in range(asked.seed, asked.seed + 6):
        recovered(f"opd-1, epdm_70, seed {seed}", tables, start, velocity, fewer, seed)
        compared(tables, velocity, fewer, seed)
    return 0


if __name__ == "__main__":
    sys.exit(main())
