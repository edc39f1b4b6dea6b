"""Draws docs/howto/strain.png and prints the table beside it: two measured rubbers on a road, with
and without the strain of each magnification.

python docs/strain.py FOLDER      with dma/material_a and dma/epdm_70 of the measured data
"""

import sys
import warnings
from pathlib import Path

import matplotlib as mpl
import numpy as np

import asperity

HERE = Path(__file__).parent
COLUMNS = {
    "frequency": "freq_hz",
    "temperature": "temperature_C",
    "storage": "G_storage_pa",
    "loss": "G_loss_pa",
}
UNITS = {"frequency": "Hz", "temperature": "C", "modulus": "Pa"}
OF_STRAIN = {"columns": COLUMNS | {"strain": "strain_dyn_pct"}, "units": UNITS | {"strain": "%"}}
ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
SMALL = 0.0015  # the strain of the isotherms
RUBBERS = {"material_a": "C0", "epdm_70": "C1"}
TOLD = (1e-5, 1e-4, 1e-3)  # velocities of the table
VELOCITY = np.union1d(np.geomspace(1e-6, 1e-2, 41), TOLD)
PRESSURE = 2e5


def factors_and_curve(folder: Path) -> tuple[asperity.StrainFactors, asperity.MasterCurve, object]:
    sweeps = [
        asperity.read_strain_sweep(folder / f"sd_{hertz}hz.csv", modulus="G", **OF_STRAIN)
        for hertz in (10, 100)
    ]
    isotherms = asperity.read_isotherms(
        folder / "tf_015p.csv", columns=COLUMNS, units=UNITS, modulus="G"
    )
    build = asperity.build_master_curve(
        isotherms, reference_temperature=295.15, smooth=True, extrapolation="power-law"
    )
    return asperity.strain_factors(sweeps, reference_strain=SMALL), build.master_curve, sweeps


def main(folder: Path) -> None:
    from matplotlib import pyplot as plt

    road = ROAD.truncated(q1=ROAD.cutoff_for_slope())
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10, 3.3), layout="constrained")
    print("rubber, v, mu, with strain, at_strain 0.9 %, A/A0, with strain")
    for name, color in RUBBERS.items():
        factors, curve, sweeps = factors_and_curve(folder / "dma" / name)
        left.plot(100 * factors.strain, factors.storage, "-", color=color, label=f"{name} $f$")
        left.plot(100 * factors.strain, factors.loss, ":", color=color, label=f"{name} $g$")
        at = {"pressure": PRESSURE, "velocity": VELOCITY, "correction": asperity.PartialContact()}
        known = [
            curve.angular_frequency[0] / 10 / road.q0,
            curve.angular_frequency[-1] * 10 / road.q1,
        ]
        at["velocity"] = VELOCITY[(known[0] < VELOCITY) & (known[1] > VELOCITY)]
        plain = asperity.friction(road, curve, **at)
        soft = asperity.friction(road, curve, **at, strain_factors=factors)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            one = asperity.friction(road, curve.at_strain(0.009, sweeps), **at)
        middle.semilogx(plain.velocity, plain.mu, "-", color=color, label=name)
        middle.semilogx(soft.velocity, soft.mu, "--", color=color, label="by magnification")
        right.loglog(plain.velocity, plain.contact_area, "-", color=color)
        right.loglog(soft.velocity, soft.contact_area, "--", color=color)
        for i, v in enumerate(at["velocity"]):
            if v in TOLD:
                print(
                    f"{name} {v:.0e} {plain.mu[i]:.3f} {soft.mu[i]:.3f} {one.mu[i]:.3f}"
                    f" {plain.contact_area[i]:.4f} {soft.contact_area[i]:.4f}"
                )
        print(*soft.notes, sep="\n")
        print(*factors.notes, sep="\n")
    left.set(xlabel="Strain amplitude [%]", ylabel="Over that at 0.15 %")
    middle.set(xlabel="Velocity [m/s]", ylabel="Friction coefficient")
    right.set(xlabel="Velocity [m/s]", ylabel="$A/A_0$")
    right.set_yticks([0.02, 0.03, 0.05, 0.08], ["0.02", "0.03", "0.05", "0.08"])
    right.minorticks_off()
    left.legend(fontsize="small")
    middle.legend(fontsize="small")
    figure.savefig(HERE / "howto/strain.png", dpi=150, metadata={"Software": None})


if __name__ == "__main__":
    mpl.use("agg")
    main(Path(sys.argv[1]))
