"""Shift factors and Prony series: ours and pyvisco's, error and time, in one process.

    python tests/benchmarks/rubber.py [--seeds 5] [--runs 7] [--data ../shared/data/dma]

Synthetic: an SBR-like rubber (Cole-Cole glass transition, a slow process), 22 isotherms of 16
frequencies, WLF; 0 and 1 % noise. Error: the worst of log10 a_T [decades], and of E' and E'' of
the fitted series over the measured frequencies [%]; worst of all seeds. Measured: polyisoprene
(RepTate's PI_LINEAR, osc) against the WLF parameters that RepTate publishes for it; b_T = T / T_ref
divides the moduli for both programs.

Time: build_master_curve and fit_prony against pyvisco's get_aT, get_curve, smooth, discretize and
fit_freq (its default of one mode a decade), without reading files or plotting on either side; runs
alternate, the median of the ratios. pyvisco's own optimisation of the number of modes (opt.nprony)
is timed once, aside. pip install pyvisco.
"""

import argparse
import time
import warnings
from collections.abc import Callable
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from pyvisco import master, opt, prony

import asperity

T_REF = 293.15
SWEEP = 2 * np.pi * np.geomspace(0.1, 30, 16)
# log10 a_T = -B1 (T - T_r) / ((B2 + T_r) (B2 + T)), T in C: github.com/jorge-ramirez-upm/RepTate,
# PI in RepTate/tools/CreateMaterialsDatabaseFile.py, the law in RepTate/theories/TheoryWLF.py
B1, B2 = 691.6245, 114.3
Modulus = Callable[[Any], Any]


def true_modulus(w: Any) -> Any:
    """The synthetic rubber, E' + i E'' [Pa]."""
    glass = 2e9 / (1 + (1j * w * 1e-7) ** -0.45)
    return 3e6 + glass + 5e6 / (1 + (1j * w * 1e-2) ** -0.3)


def true_shift(t: Any) -> Any:
    """log10 a_T."""
    return -8.86 * (t - T_REF) / (101.6 + t - T_REF)


def sweeps(noise: float, seed: int) -> list[asperity.Isotherm]:
    """Isotherms of the synthetic rubber."""
    rng = np.random.default_rng(seed)
    result = []
    for t in np.arange(-30, 78, 5) + 273.15:
        modulus = true_modulus(SWEEP * 10 ** true_shift(t))
        scatter = np.exp(noise * rng.standard_normal((2, SWEEP.size)))
        result.append(isotherm(t, SWEEP, modulus.real * scatter[0], modulus.imag * scatter[1]))
    return result


def isotherm(t: float, w: Any, storage: Any, loss: Any) -> asperity.Isotherm:
    """One isotherm."""
    return asperity.Isotherm(
        temperature=t, angular_frequency=w, storage_modulus=storage, loss_modulus=loss
    )


def frame(isotherms: list[asperity.Isotherm]) -> pd.DataFrame:
    """What pyvisco's load.user_raw returns, in Hz, MPa and C."""
    parts = []
    for i, one in enumerate(isotherms):
        columns = {
            "f_set": one.angular_frequency / (2 * np.pi),
            "E_stor": one.storage_modulus / 1e6,
            "E_loss": one.loss_modulus / 1e6,
            "T": one.temperature - 273.15,
            "Set": i,
            "T_round": round(one.temperature - 273.15),
        }
        parts.append(pd.DataFrame(columns))
    result = pd.concat(parts, ignore_index=True)
    result.domain, result.modul = "freq", "E"
    return result


def ours(isotherms: list[asperity.Isotherm], reference: float) -> tuple[Any, Modulus]:
    """log10 a_T and the modulus of the series."""
    build = asperity.build_master_curve(isotherms, reference_temperature=reference)
    return build.log10_a_T, asperity.fit_prony(build).modulus


def theirs(raw: pd.DataFrame, reference: float) -> tuple[Any, Modulus]:
    """The same of pyvisco."""
    curve, shifts = their_curve(raw, reference)
    found = prony.fit_freq(prony.discretize(curve), curve)
    terms = found["df_terms"]
    share, tau = terms["alpha_i"].to_numpy(), terms["tau_i"].to_numpy()

    def modulus(w: Any) -> Any:
        x = 1j * np.asarray(w)[:, None] * tau
        return 1e6 * found["E_0"] * (1 - share.sum() + (share * x / (1 + x)).sum(axis=1))

    return shifts, modulus


def their_curve(raw: pd.DataFrame, reference: float) -> tuple[pd.DataFrame, Any]:
    """pyvisco's master curve and log10 a_T; its shift is the factor of the frequency, as ours."""
    celsius = round(reference - 273.15)
    shifts, _ = master.get_aT(raw, celsius)
    curve = master.smooth(master.get_curve(raw, shifts, celsius), 1)
    return curve, shifts["log_aT"].to_numpy()


def errors(found: tuple[Any, Modulus], isotherms: list[asperity.Isotherm]) -> list[float]:
    """Worst errors: log10 a_T [decades], E' and E'' [%]."""
    shifts, modulus = found
    t = np.array([one.temperature for one in isotherms])
    w = np.geomspace(*(SWEEP[k] * 10 ** true_shift(t[j]) for k, j in ((0, -1), (-1, 0))), 400)
    fitted, truth = modulus(w), true_modulus(w)
    parts = (fitted.real / truth.real - 1, fitted.imag / truth.imag - 1)
    worst = [100 * float(np.abs(part).max()) for part in parts]
    return [float(np.abs(shifts - true_shift(t)).max()), *worst]


def polyisoprene(folder: Path, reference: float) -> list[asperity.Isotherm]:
    """Measured isotherms, moduli over b_T; those at one temperature as one."""
    found = asperity.read_isotherms(
        sorted(folder.glob("*.osc")),
        columns={"frequency": "Freq", "temperature": "Temp", "storage": "G'", "loss": 'G"'},
        units={"frequency": "rad/s", "temperature": "C", "modulus": "Pa"},
        modulus="G",
    )
    groups: dict[int, list[asperity.Isotherm]] = {}
    for one in found:
        groups.setdefault(round(one.temperature), []).append(one)
    result = []
    for group in groups.values():
        b_t = group[0].temperature / reference
        names = ("angular_frequency", "storage_modulus", "loss_modulus")
        w, storage, loss = (np.concatenate([getattr(one, n) for one in group]) for n in names)
        result.append(isotherm(group[0].temperature, w, storage / b_t, loss / b_t))
    return result


def timed(function: Callable[[], object]) -> float:
    """Seconds."""
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def measured_row(folder: Path) -> str:
    """Polyisoprene at 0 C: both against the published WLF."""
    reference = 273.15
    isotherms = polyisoprene(folder, reference)
    t = np.array([one.temperature for one in isotherms]) - 273.15
    published = -B1 * t / (B2 * (B2 + t))
    cells = []
    for shifts in (
        asperity.build_master_curve(isotherms, reference_temperature=reference).log10_a_T,
        their_curve(frame(isotherms), reference)[1],
    ):
        cells.append(f"{np.abs(shifts - published).max():.3f} (published WLF)")
    return f"| polyisoprene, b_T = T / T_ref, 0 C | {cells[0]} | {cells[1]} | - | - | - | - |"


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/dma"))
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    print("| data | log10 a_T, ours | pyvisco | E' %, ours | pyvisco | E'' %, ours | pyvisco |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for noise in (0.0, 0.01):
        worst = np.zeros((2, 3))
        for seed in range(args.seeds if noise else 1):
            isotherms = sweeps(noise, seed)
            for k, found in enumerate((ours(isotherms, T_REF), theirs(frame(isotherms), T_REF))):
                worst[k] = np.maximum(worst[k], errors(found, isotherms))
        cells = " | ".join(f"{worst[k][i]:.2g}" for i in range(3) for k in range(2))
        print(f"| synthetic, {100 * noise:g} % noise | {cells} |")
    folder = args.data / "reptate_pi1000k"
    if folder.exists():
        print(measured_row(folder))
    else:
        print(f"no {folder}: --data")

    isotherms = sweeps(0.01, 0)
    raw = frame(isotherms)
    pairs = []
    for _ in range(args.runs):
        mine = timed(lambda: ours(isotherms, T_REF))
        pairs.append((mine, timed(lambda: theirs(raw, T_REF))))
    mine, other = np.median(pairs, axis=0)
    ratio = np.median([b / a for a, b in pairs])
    print(f"\nours {1e3 * mine:.0f} ms, pyvisco {1e3 * other:.0f} ms: {ratio:.1f} x")
    curve, _ = their_curve(raw, T_REF)
    start = prony.fit_freq(prony.discretize(curve), curve)
    with redirect_stdout(StringIO()):
        aside = timed(lambda: opt.nprony(curve, start))
    print(f"pyvisco's opt.nprony besides: {aside:.1f} s, whole {(other + aside) / mine:.0f} x")


if __name__ == "__main__":
    main()
