"""Random scans and measured moduli: the estimates of PartialContact against brute force.

    python tests/stability/random_partial_tables.py [--scenes 1500] [--seed 1] [--absurd 0]

Tables of a hundred rows, some by equal steps, some not, with noise, drop-outs, rows of nothing, two
slopes, single strong lines, steps; closed forms; master curves with noise, with gaps, with rows
that nearly meet, of sweeps that a shift law moved and that do not fit; Prony series with one term
or many. Each scene has three velocities, three loads that make A/A0 of 1e-4 to 1, and three rtol
from 1e-3 to 1e-9: 27 points. The truth is that of partial_truth.py; mu must be as near to it as
the estimate says, the area within rtol, but for 3e-14. A share of `absurd` has one velocity of
fourteen decades, two loads and rtol of 1e-4 to 1e-9 on the surfaces and rubbers of
partial_scenes.py. Printed: what exceeded or did not converge. Exit status 1 where anything did.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np

import asperity

sys.path.insert(0, str(Path(__file__).parent))
from judge import Held, judged
from options import options
from partial_scenes import draw_parts, power
from partial_truth import Surface, Truth

ROUNDING = 3e-14
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)  # of absurd scenes


def noise(rng: Any, sizes: list[float], n: int) -> Any:
    return np.exp(rng.choice(sizes) * rng.standard_normal(n))


def draw_table(rng: Any) -> tuple[str, Any, Any]:
    """What a table is like, its wavenumbers and its densities but for a factor."""
    kinds = ["uneven", "holes", "few", "two slopes", "lines", "drop-outs", "steps"]
    kind = str(rng.choice(kinds))
    n = int(rng.integers(8, 400))
    steps = 500.0 * (rng.choice([1, 4, 8]) + np.arange(n))
    if kind == "uneven":
        q = 1e3 * np.cumsum(rng.uniform(0.2, 2, n))
        return kind, q, q ** -rng.uniform(2.2, 4.2) * noise(rng, [0.05, 0.5, 2], n)
    if kind == "holes":
        q = np.geomspace(1e2, power(rng, 3, 8), n)
        c = np.where(rng.random(n) < 0.1, 0, 1) * q ** -rng.uniform(2, 5) * noise(rng, [1], n)
        c[0] = max(c[0], q[0] ** -3)
        return kind, q, c
    if kind == "few":
        n = int(rng.integers(8, 60))
        q = 1e3 * np.sort(np.exp(rng.uniform(0, rng.uniform(1, 10), n))) * (1 + 1e-6 * np.arange(n))
        return kind, q, q ** -rng.uniform(2.2, 5) * noise(rng, [0, 0.3, 1], n)
    if kind == "two slopes":
        q = np.geomspace(1e3, power(rng, 3.5, 8), n) if rng.random() < 0.5 else steps
        x = q / (q[0] * (q[-1] / q[0]) ** rng.uniform(0.1, 0.9))
        c = np.where(x < 1, x ** -rng.uniform(0, 3), x ** -rng.uniform(3, 6))
        return kind, q, c * noise(rng, [0, 0.02, 0.3], n)
    if kind == "lines":
        strong = rng.random(n) < rng.choice([0.01, 0.1])
        return kind, steps, steps**-3.6 * np.where(strong, power(rng, 1, 5, n), 1)
    if kind == "drop-outs":
        kept = rng.random(n) > rng.uniform(0.1, 0.7)
        kept[[0, 1, -1]] = True
        q = steps[kept]
        scatter = np.abs(1 + 0.7 * rng.standard_normal(q.size) / np.sqrt(q / 300))
        return kind, q, q**-3.6 * scatter
    level = np.arange(n) // rng.integers(3, 30) % 2
    return kind, steps, steps**-3.6 * np.where(level, power(rng, 1, 4), 1)


def draw_surface(rng: Any) -> tuple[str, Any, Surface]:
    """What a surface is like, the spectrum, what brute force takes of it; rms slope 0.1 to 4."""
    slope = power(rng, -1, 0.6)
    if rng.random() < 0.1:
        q0 = power(rng, 2, 4)
        q1 = q0 * power(rng, 0.3, 4.5)
        hurst, rolloff = rng.uniform(0.05, 1), q0 * (q1 / q0) ** rng.uniform(0.1, 0.9)
        form = asperity.SelfAffineSpectrum(
            rms_height=1e-4, hurst=hurst, q0=q0, q1=q1, rolloff=rolloff
        )
        spectrum: Any = form.scaled((slope / form.rms_slope) ** 2)
        q = np.array([q0, rolloff, q1])
        kind, c = "closed form", np.maximum(q / rolloff, 1) ** (-2 * (hurst + 1))
    else:
        kind, q, c = draw_table(rng)
        table = asperity.TabulatedSpectrum(wavenumber=q, density=c)
        spectrum = table.scaled((slope / table.rms_slope) ** 2)
    same = asperity.TabulatedSpectrum(wavenumber=q, density=c)
    return kind, spectrum, Surface(q, c * (spectrum.rms_slope / same.rms_slope) ** 2)


def draw_series(rng: Any) -> Any:
    n = int(rng.choice([1, rng.integers(2, 25)]))
    return asperity.PronySeries(
        equilibrium_modulus=1e6,
        moduli=1e6 * power(rng, -2, 3.5, n),
        relaxation_times=power(rng, -9, 3, n),
    )


def draw_rubber(rng: Any) -> tuple[str, Any]:
    kind = str(rng.choice(["curve", "gaps", "sweeps", "wild", "series"]))
    series = draw_series(rng)
    if kind == "series":
        return kind, series
    n = int(rng.integers(20, 300))
    if kind == "wild":  # rows at random, some of which nearly meet
        n = int(rng.integers(3, 400))
        w = np.sort(power(rng, -6, 12, n)) * (1 + 1e-9 * np.arange(n))
        rise = 1e6 * (1 + (w / power(rng, -3, 6)) ** rng.uniform(0.05, 0.6))
        storage = rise * np.exp(np.cumsum(rng.standard_normal(n) * rng.choice([0, 0.02, 0.2])))
        loss = rise * rng.uniform(0.05, 1) * noise(rng, [0.05], n)
    elif kind == "sweeps":  # eight frequencies each, a few per cent off
        shift = 10 ** (-8.86 * np.arange(-50.0, 40.0, 5) / (101.6 + np.arange(-50.0, 40.0, 5)))
        w = (np.geomspace(0.6, 200, 8) * shift[:, None]).ravel()
        off = np.repeat(noise(rng, [0.03], shift.size), 8)
        known = (w > 1e-8) & (w < 1e14)
        order = np.argsort(w[known])
        w, off = w[known][order], off[known][order]
        modulus = series.modulus(w)
        storage, loss = modulus.real * off, (modulus.imag + 1e-3 * modulus.real) * off
    else:
        w = np.geomspace(1e-8, 1e14, n)
        kept = np.ones(n, bool)
        if kind == "gaps":
            for _ in range(rng.integers(1, 5)):
                first = rng.integers(1, n - 1)
                kept[first : min(n - 1, first + rng.integers(2, n // 4 + 3))] = False
        modulus = series.modulus(w)
        storage = (modulus.real * noise(rng, [0, 0.01, 0.1], n))[kept]
        loss = ((modulus.imag + 1e-3 * modulus.real) * noise(rng, [0, 0.01, 0.1], n))[kept]
        w = w[kept]
    return kind, asperity.MasterCurve(
        angular_frequency=w, storage_modulus=storage, loss_modulus=loss
    )


def draw_scene(rng: Any) -> tuple[str, Any, Surface, Any, Any]:
    """What a scene is like, spectrum, its rows for brute force, rubber and velocities."""
    surface, spectrum, rows = draw_surface(rng)
    name, rubber = draw_rubber(rng)
    if name == "series":
        velocities = power(rng, -7, 6, 3) / np.sqrt(spectrum.q0 * spectrum.q1)
    else:
        lowest, highest = rubber.angular_frequency[[0, -1]]
        limits = np.log([1.0001 * lowest / spectrum.q0, 0.9999 * highest / spectrum.q1])
        velocities = np.exp(rng.uniform(limits[0], limits[1], 3)) if limits[0] < limits[1] else []
    return f"{surface}, {name}", spectrum, rows, rubber, velocities


def draw_absurd(rng: Any) -> tuple[str, Any, Surface, Any, Any]:
    """The same of partial_scenes.py, at rms slope 1."""
    kind, q, c, rubber, velocity = draw_parts(rng)
    table = asperity.TabulatedSpectrum(wavenumber=q, density=c)
    spectrum = table.scaled(1 / table.rms_slope**2)
    return kind, spectrum, Surface(q, spectrum.density), rubber, [velocity]


def compute(seed: int, scene: int, absurd: bool = False) -> tuple[str, list[tuple[float, float]]]:
    """What a scene is like, and rtol of each of its points with the error over what is allowed."""
    rng = np.random.default_rng([seed, scene])
    kind, spectrum, rows, rubber, velocities = (draw_absurd if absurd else draw_scene)(rng)
    found = []
    for velocity in velocities:
        modulus = abs(rubber.modulus(velocity * spectrum.q1))
        pressure = modulus * spectrum.rms_slope * power(rng, -4, 0.7, 2 if absurd else 3)
        truth = Truth(rows, rubber, velocity)
        mu, area = np.transpose([truth.at(load) for load in pressure])
        for rtol in TOLERANCES if absurd else (1e-6, *power(rng, -9, -3, 2)):
            result = asperity.friction(
                spectrum,
                rubber,
                pressure=pressure,
                velocity=velocity,
                correction=asperity.PartialContact(),
                rtol=rtol,
            )
            off, allowed = np.abs(result.hysteresis - mu), result.error_estimate + ROUNDING * mu
            of_mu = np.divide(off, allowed, where=off > 0, out=np.zeros_like(off))
            of_area = np.abs(result.contact_area / area - 1) / (rtol + ROUNDING)
            found += [(rtol, float(worst)) for worst in np.maximum(of_mu, of_area)]
    return kind, found


def main() -> int:
    asked = options(__doc__, scenes=1500, seed=1, absurd=0.0)

    def held(scene: int) -> list[Held]:
        absurd = (scene * asked.absurd) % 1 < asked.absurd
        kind, found = compute(asked.seed, scene, absurd)
        return [("points", excess, f"{kind}, rtol {rtol:.3g}") for rtol, excess in found]

    return judged(range(asked.scenes), held)


if __name__ == "__main__":
    sys.exit(main())
