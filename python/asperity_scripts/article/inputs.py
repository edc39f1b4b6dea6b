"""What the article states, and what stands in for what it does not publish."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from asperity.adhesion import Adhesion
from asperity.contact import contact_area, correction_factor
from asperity.correction import Correction, GreenwoodWilliamson
from asperity.rubber import PronySeries
from asperity.self_affine_fit import synthesize
from asperity.spectrum import SelfAffineSpectrum
from asperity.surface import HeightMap
from asperity_scripts.article.compounds import POISSON_RATIO, T_G, compound, temperature_of
from asperity_scripts.article.readings import READINGS, Array, Implied, Reading, implied
from asperity_scripts.article.statement import UNTUNED

Q0 = 2000.0  # 1/m, of both surfaces (Fig. 7, Table 1)
LAMBDA0 = 2 * math.pi / Q0
MAGNIFICATION = 500.0  # q1 / q0 (Section 5.2)
PRESSURES = (0.1e6, 0.3e6, 0.5e6)  # Pa, of Figs 10 to 12
VELOCITY = 0.1  # m/s, of Figs 10 to 12
ASPHALT_PRESSURE = 81e3  # Pa (Table 1)
ADHESION = Adhesion(shear_stress=8.3e6, reference_velocity=6e-3, width=0.1)  # Table 1

# Square scans of 16 x 16 lambda0. The skewness of the abraded sandpaper is not published: this one
# was chosen knowing the printed p_T, so that z_max and z_min of the scans lie between those that
# either reading asks for. So statements are put to scans without skewness too.
SIDE = 16  # lambda0
PIXELS = 1024
PIXEL_SIZE = SIDE * LAMBDA0 / PIXELS
SKEWNESS = -0.3
SEEDS = (1, 2, 3, 4, 5, 6)


@dataclass(frozen=True, eq=False)
class Model:
    """The sandpaper, compound A, and the improved Greenwood-Williamson model."""

    surface: SelfAffineSpectrum
    rubber: PronySeries
    correction: GreenwoodWilliamson

    def area(self, zeta: Array, correction: Correction | None = None) -> Array:
        """A/A0 at 0.1 m/s, at the three pressures (rows) and at magnifications."""
        return self._over(contact_area, zeta, correction, PRESSURES)

    def cf(
        self, zeta: Array, correction: Correction, pressure: Sequence[float] = PRESSURES
    ) -> Array:
        """CF at 0.1 m/s, at pressures (rows) and at magnifications."""
        return self._over(correction_factor, zeta, correction, pressure)

    def _over(self, of: Callable[..., Any], zeta: Array, correction: Any, pressure: Any) -> Array:
        theory, at = (self.surface, self.rubber), {"pressure": pressure, "velocity": VELOCITY}
        return np.asarray(of(*theory, **at, correction=correction, wavenumber=zeta * Q0))


@dataclass(frozen=True, eq=False)
class Tuned(Model):
    """A moved along the frequency axis until a reading gives the printed p_T, with its heights."""

    implied: Implied
    decades: float  # log10 of the factor on the relaxation times
    temperature: float  # [C] at which the surrogate would be as stiff, by WLF


@dataclass(frozen=True, eq=False)
class Inputs:
    """Surfaces, compounds and readings that all figures and statements share."""

    sandpaper: SelfAffineSpectrum
    asphalt: SelfAffineSpectrum
    scans: Sequence[HeightMap]  # of the sandpaper, one a seed
    gaussian_scans: Sequence[HeightMap]  # the same spectrum without skewness
    asphalt_scans: Sequence[HeightMap]
    compound_a: PronySeries  # at room temperature, not tuned
    compound_b: PronySeries
    tuned: Mapping[str, Tuned]  # by reading
    untuned: Mapping[str, Model]  # by reading; A as it is, heights of the scans without skewness

    @property
    def models(self) -> dict[str, Model]:
        """Tuned and untuned, in either reading."""
        bare = {f"{UNTUNED}, {reading}": model for reading, model in self.untuned.items()}
        return {**self.tuned, **bare}

    @property
    def compounds(self) -> dict[str, Model]:
        """Compound A as tuned to either reading, and untuned, where IGW plays no part."""
        return {**self.tuned, UNTUNED: self.untuned["implicit"]}


def prepare(seeds: Sequence[int] = SEEDS) -> Inputs:
    """Surfaces, a scan a seed of each, and compound A with the model's heights, tuned and not."""
    sandpaper = SelfAffineSpectrum(rms_height=76.572e-6, hurst=0.7, q0=Q0, q1=MAGNIFICATION * Q0)
    asphalt = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=Q0, q1=MAGNIFICATION * Q0)
    compound_a = compound(T_G["A"])
    gaussian_scans = [_scan(sandpaper, seed, 0.0) for seed in seeds]
    return Inputs(
        sandpaper=sandpaper,
        asphalt=asphalt,
        scans=[_scan(sandpaper, seed, SKEWNESS) for seed in seeds],
        gaussian_scans=gaussian_scans,
        asphalt_scans=[_scan(asphalt, seed, 0.0) for seed in seeds],
        compound_a=compound_a,
        compound_b=compound(T_G["B"]),
        tuned={reading: tune(sandpaper, compound_a, reading) for reading in READINGS},
        untuned={
            reading: Model(sandpaper, compound_a, heights_of(gaussian_scans, reading))
            for reading in READINGS
        },
    )


def heights_of(
    scans: Sequence[HeightMap], reading: Reading, rms_height: float | None = None
) -> GreenwoodWilliamson:
    """The model with the mean extremes of scans; the rms height is the spectrum's unless given."""
    return GreenwoodWilliamson(
        z_max=float(np.mean([scan.z_max for scan in scans])),
        z_min=float(np.mean([scan.z_min for scan in scans])),
        reading=reading,
        rms_height=rms_height,
    )


def tune(surface: SelfAffineSpectrum, rubber: PronySeries, reading: Reading) -> Tuned:
    """One factor on all relaxation times, so that E* at q0 and 0.1 m/s is what p_T asks for."""
    wanted = implied(reading, surface.rms_height, surface.q0)
    low, high = -12.0, 12.0
    while high - low > 1e-13:
        middle = (low + high) / 2
        soft = effective_modulus(rubber.shifted(10**middle)) < wanted.effective_modulus
        low, high = (middle, high) if soft else (low, middle)
    return Tuned(
        surface=surface,
        rubber=rubber.shifted(10**low),
        correction=GreenwoodWilliamson(z_max=wanted.z_max, z_min=wanted.z_min, reading=reading),
        implied=wanted,
        decades=low,
        temperature=temperature_of(low, T_G["A"]),
    )


def effective_modulus(rubber: PronySeries, velocity: float = VELOCITY) -> float:
    """E* = |E(q0 v)| / (1 - nu^2) [Pa], of Eqs 16 to 20."""
    return float(abs(rubber.modulus(Q0 * velocity))) / (1 - POISSON_RATIO**2)


def magnifications(count: int) -> Array:
    """q / q0 from 1 to 500, dense at 1: the contact breaks up within a small part of a decade."""
    return np.concatenate([[1.0], 1 + np.geomspace(1e-4, MAGNIFICATION - 1, count - 1)])


def _scan(spectrum: SelfAffineSpectrum, seed: int, skewness: float) -> HeightMap:
    shape = (PIXELS, PIXELS)
    return synthesize(spectrum, shape=shape, pixel_size=PIXEL_SIZE, seed=seed, skewness=skewness)
