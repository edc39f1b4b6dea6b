"""Exact sliding contacts of ridged maps, to fit the edges of PartialContact on and to judge it.

`asperity.validation.slide` of random-phase maps of elliptic spectra (1 cm a side, ridges along y),
means over some maps. The set fit has what the constants of directions were fitted on; judge (axis
ratios to 3) and far (4 and 6) have other seeds, Hurst exponents, bands and loads. Of fine the short
waves alone make ridges, of coarse the long ones alone; rolloff is flat up to twice q0.
"""

import csv
from pathlib import Path

import numpy as np

import asperity
from asperity.validation import slide

SIDE, RMS_HEIGHT, POINTS = 0.01, 1e-4, 256
RUBBERS = {
    "ten": ([9e6], [1e-3]),
    "thirty": ([29e6 / 12] * 12, list(np.geomspace(1e-6, 1, 12))),
    "steep": (list(1e6 * 4.0 ** np.arange(1, 7)), list(10.0 ** -np.arange(1, 7))),
    "three": ([2e6, 5e6, 2e7], [1e-2, 1e-4, 1e-6]),
}
SETS = [
    # name, seeds, Hurst, waves a side, axis ratios, angles, loads p*, velocities of each rubber
    ("fit", (11, 12, 13, 14), 0.8, (4, 32), (1, 2, 3), (0, 30, 60, 90), (0.015, 0.05, 0.15),
     {"ten": (0.005, 0.05, 1.0), "thirty": (1e-3, 0.03, 1.0)}),
    ("judge", (31, 32, 33, 34), 0.6, (6, 24), (1.5, 2.5, 3), (0, 20, 45, 70, 90), (0.03, 0.1),
     {"ten": (0.01, 0.2), "thirty": (0.005, 0.3)}),
    ("judge", (51, 52, 53), 0.9, (4, 48), (2, 3), (0, 20, 45, 70, 90), (0.03, 0.1),
     {"ten": (0.01, 0.2), "thirty": (0.005, 0.3)}),
    ("far", (41, 42, 43, 44), 0.75, (5, 30), (4, 6), (0, 30, 60, 90), (0.03, 0.1),
     {"ten": (0.01, 0.2), "thirty": (0.005, 0.3)}),
    *((name, (61, 62, 63), 0.7, (5, 32), (3,), (20, 45, 70), (0.03, 0.1),
       {"steep": (0.003,), "three": (0.3,)}) for name in ("fine", "coarse", "rolloff")),
]  # fmt: skip
NAMES = [
    *("set", "hurst", "lowest", "highest", "axis_ratio", "angle_deg", "rubber", "pressure"),
    *("velocity", "contact_area", "mu", "lateral", "area_scatter", "mu_scatter"),
]


def series(name):
    """Return a rubber of 1 MPa and some terms."""
    moduli, times = RUBBERS[name]
    return asperity.PronySeries(equilibrium_modulus=1e6, moduli=moduli, relaxation_times=times)


def spectrum(name, hurst, waves, ratio):
    """Return the spectrum of a set, of so many waves a side."""
    q0, q1 = (2 * np.pi * n / SIDE for n in waves)
    law = asperity.SelfAffineSpectrum(
        rms_height=RMS_HEIGHT,
        hurst=hurst,
        q0=q0,
        q1=q1,
        rolloff=2 * q0 if name == "rolloff" else None,
        axis_ratio=ratio,
        lay=np.pi / 2,
    )
    return bent(law, name) if name in ("fine", "coarse") else law


def bent(law, name):
    """Return the same with the axis ratio at one end of the band alone, and 1 at the other."""
    q, phi = np.geomspace(law.q0, law.q1, 40), 2 * np.pi * np.arange(512) / 512
    place = np.linspace(0, 1, q.size) if name == "fine" else np.linspace(1, 0, q.size)
    ratio = law.axis_ratio ** place[:, None]
    shape = (np.cos(phi - law.lay) ** 2 * ratio + np.sin(phi - law.lay) ** 2 / ratio) ** (
        -1 - law.hurst
    )
    waves = np.fft.rfft(shape)[:, : 2 * 8 + 1 : 2]
    harmonics = waves[:, 1:] / waves[:, :1].real
    return asperity.TabulatedSpectrum(
        wavenumber=q, density=law.at(q), cosine=harmonics.real, sine=-harmonics.imag
    )


def contacts(name, seeds, hurst, waves, ratios, angles, loads, velocities):
    """Yield rows of one set; a load is over |E(v sqrt(q0 q1))| / (1 - nu^2) times the rms slope."""
    for ratio in ratios:
        law = spectrum(name, hurst, waves, ratio)
        maps = [
            asperity.synthesize(law, shape=(POINTS, POINTS), pixel_size=SIDE / POINTS, seed=seed)
            for seed in seeds
        ]
        for rubber in velocities:
            for velocity in velocities[rubber]:
                stiff = abs(series(rubber).modulus(velocity * np.sqrt(law.q0 * law.q1))) / 0.75
                for load in loads:
                    for angle in angles if ratio > 1 else (0,):
                        at = {"pressure": load * stiff * law.rms_slope, "velocity": velocity}
                        result = [
                            slide(
                                one,
                                series(rubber),
                                **at,
                                direction=np.radians(angle),
                                periodic=True,
                                rtol=1e-4,
                            )
                            for one in maps
                        ]
                        area, mu, lateral = np.transpose(
                            [(one.contact_area, one.hysteresis, one.lateral) for one in result]
                        )
                        scatter = (x.std(ddof=1) / x.mean() / len(x) ** 0.5 for x in (area, mu))
                        means = (area.mean(), mu.mean(), lateral.mean(), *scatter)
                        yield [
                            name, hurst, *waves, ratio, angle, rubber, f"{at['pressure']:.9g}",
                            velocity, *(f"{x:.6g}" for x in means),
                        ]  # fmt: skip


def main():
    """Write exact_direction.csv."""
    with (Path(__file__).parent / "exact_direction.csv").open("w", encoding="utf-8") as file:
        print(
            "# Means over maps of exact sliding contacts (make_exact_direction.py); scatter:",
            file=file,
        )
        print(
            "# standard error of the mean, relative. lowest and highest: waves a side of 1 cm.",
            file=file,
        )
        print("# Units: pressure Pa, velocity m/s, angle_deg deg, the rest none.", file=file)
        table = csv.writer(file, lineterminator="\n")
        table.writerow(NAMES)
        for one in SETS:
            table.writerows(contacts(*one))
            file.flush()


if __name__ == "__main__":
    main()
