"""Elastic contacts of a scan as factors of PartialContact's rule, for every rubber at once.

    python tests/benchmarks/scan_elastic.py

Thirteen elastic contacts of a map, sigma0 / (E* h') from 0.003 to 3, give the stress of exact
contact over the rule's in eight bands of the wavenumber, and the area. A rubber's contact, whose
load counts as 1 / sqrt(8 G(q1)), takes the factors of the elastic one at that load. Judged on the
maps, rubbers and scenes of scan_contact.py. Prints Markdown.
"""

import time
from collections.abc import Iterator

import numpy as np
import scan_contact as maps
from scipy.special import erfinv

import asperity
from asperity.validation import slide

BANDS, NU = 8, 0.5
LOADS = np.geomspace(0.003, 3, 13)
SEEDS = (11000, 12000)
TIMES = 10.0 ** np.arange(-12, 6)
# elastic but for a loss tangent of 1e-4, by which friction tells the stress of each wave
ELASTIC = asperity.PronySeries(
    equilibrium_modulus=1e6, moduli=np.full(TIMES.size, 200.0), relaxation_times=TIMES
)
VELOCITY = 1.0  # [m/s], of the elastic contacts
Q0, Q1 = 2 * np.pi * np.array([maps.LONGEST, maps.SHORTEST]) / maps.LENGTH
EDGES = Q0 * (Q1 / Q0) ** np.linspace(0, 1, BANDS + 1)
Array = np.ndarray


def exact_friction(contact: asperity.validation.SlidingContact, pressure: float) -> Array:
    """mu of each band of an elastic contact, the last one with all shorter waves."""
    k = 2 * np.pi * np.fft.fftfreq(maps.POINTS, maps.LENGTH / maps.POINTS)
    q = np.hypot(k, k[:, None])
    stress = np.abs(np.fft.fft2(contact.pressure) / q.size) ** 2
    w = 1j * VELOCITY * np.abs(k)[:, None] * TIMES
    modulus = 1e6 + 200.0 * (w / (1 + w)).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.where(q > 0, np.abs(k) / q, 0)
    mu = 2 * (1 - NU**2) * along * (1 / np.conj(modulus)).imag * stress / pressure
    band = np.clip(np.searchsorted(EDGES, q, side="right") - 1, 0, BANDS - 1)
    return np.bincount(band.ravel(), mu.ravel(), BANDS)


def rule_friction(
    spectrum: asperity.TabulatedSpectrum, rubber: asperity.PronySeries, scene: dict[str, float]
) -> tuple[Array, float]:
    """mu of each band by the rule, and its area."""
    found = asperity.friction(
        spectrum, rubber, correction=asperity.PartialContact(), contributions=True, **scene
    )
    y = np.linspace(np.log(Q0), np.log(Q1), 200 * BANDS + 1)
    density = np.interp(y, np.log(found.wavenumber), found.dmu_dlnq)
    steps = (density[1:] + density[:-1]) / 2 * np.diff(y)
    bands = steps.reshape(BANDS, -1).sum(axis=1)
    bands[-1] += found.hysteresis - bands.sum()
    return bands, found.contact_area


def factors(
    surface: asperity.HeightMap, spectrum: asperity.TabulatedSpectrum
) -> tuple[Array, Array]:
    """ln of exact over rule of the bands' friction and of the area, a row a load."""
    mu, area = [], []
    for load in LOADS:
        pressure = load * 1e6 / (1 - NU**2) * spectrum.rms_slope
        scene = {"pressure": pressure, "velocity": VELOCITY}
        contact = slide(surface, ELASTIC, periodic=True, rtol=1e-4, **scene)
        bands, share = rule_friction(spectrum, ELASTIC, scene)
        mu.append(np.log(exact_friction(contact, pressure) / bands))
        area.append(np.log(contact.contact_area / share))
    return np.array(mu), np.array(area)


def cases() -> Iterator[tuple[str, float, Array]]:
    """(kind, A, errors of mu and A by the rule and by the elastic contacts)."""
    for kind in maps.KINDS:
        for seed in SEEDS:
            surface = maps.height_map(kind, seed)
            spectrum = asperity.power_spectrum(surface, window="none", detrend=None)
            spectrum = spectrum.truncated(q0=Q0, q1=Q1)
            begin = time.process_time()
            of_mu, of_area = factors(surface, spectrum)
            seconds = time.process_time() - begin
            for rubber in maps.RUBBERS.values():
                for pressure in maps.PRESSURES:
                    for velocity in maps.VELOCITIES[::3]:
                        scene = {"pressure": pressure, "velocity": velocity}
                        exact = slide(surface, rubber, periodic=True, rtol=1e-4, **scene)
                        bands, area = rule_friction(spectrum, rubber, scene)
                        persson = asperity.contact_area(spectrum, rubber, **scene)
                        load = erfinv(min(persson, 1 - 1e-15)) / np.sqrt(2)
                        at = [np.interp(np.log(load), np.log(LOADS), row) for row in of_mu.T]
                        more = np.interp(np.log(load), np.log(LOADS), of_area)
                        ratios = [
                            [bands.sum(), bands @ np.exp(at)] / np.array(exact.hysteresis),
                            [area, min(1.0, area * np.exp(more))] / np.array(exact.contact_area),
                        ]
                        yield kind, exact.contact_area, np.array([*ratios, [seconds] * 2]) - 1


def main() -> None:
    found = [*cases()]
    print("| heights | A/A0 | mu, rule | mu, elastic | A, rule | A, elastic |")
    print("| --- |" + " --- |" * 5)
    for few in (False, True):
        for kind in (*maps.KINDS, "all"):
            errors = [e for k, area, e in found if kind in (k, "all") and (area < 0.02) == few]
            (mu, mu_elastic), (area, area_elastic) = np.array(errors)[:, :2].transpose(1, 2, 0)
            shown = " | ".join(map(maps.shown, (mu, mu_elastic, area, area_elastic)))
            print(f"| {kind} | {'below' if few else 'above'} 0.02 | {shown} |")
    print(f"\n{np.median([e[2, 0] + 1 for _, _, e in found]):.2f} s of processor time a map")


if __name__ == "__main__":
    main()
