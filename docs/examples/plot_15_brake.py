"""
Braking with an FMU
===================

A quarter of a car brakes from 100 km/h at a slip of 15 %. Sixteen tread blocks pass through the
contact one after the other, each a contact point of an FMU that FMPy steps. A block that enters is
cold (`reset`); it heats up while it slides through. With `memory` off, each is as hot as after
long sliding, and the map without heat inside of the map is what a theory without heat says.
"""

import tempfile
from pathlib import Path

import fmpy
import matplotlib.pyplot as plt
import numpy as np
from fmpy.fmi2 import FMU2Slave

import asperity

# %%
# A road, a tread compound, and the map of its friction at 20 °C, with the heat that it makes.
road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
rubber = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=[4e8, 3e8, 1e8, 3e7, 1e7],
    relaxation_times=[1e-8, 1e-7, 1e-6, 1e-4, 1e-2],
)
hot = asperity.friction_map(
    road,
    rubber,
    pressure=(1e5, 5e5),
    velocity=(1e-2, 10),
    temperature=293.15,
    shift=asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    heating=asperity.Heating(
        density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
    ),
    rtol=1e-3,
    checked=2000,
)

# %%
# The car: load, pressure, speed, slip and length of the contact.
BLOCKS, LENGTH, SLIP, PRESSURE, STEP = 16, 0.12, 0.15, 3e5, 2e-4


def brake(fmap: asperity.FrictionMap, memory: bool | None) -> np.ndarray:
    """Time, speed and mean mu, a row a step, until the car is slow."""
    with tempfile.TemporaryDirectory() as folder:
        asperity.export_fmu(fmap, Path(folder) / "tread.fmu", name="tread", points=BLOCKS)
        described = fmpy.read_model_description(f"{folder}/tread.fmu")
        tread = FMU2Slave(
            guid=described.guid,
            unzipDirectory=fmpy.extract(f"{folder}/tread.fmu", f"{folder}/tread"),
            modelIdentifier="tread",
        )
        number = {variable.name: variable.valueReference for variable in described.modelVariables}
        each = [[number[f"{name}[{i + 1}]"] for i in range(BLOCKS)] for name in ("velocity", "mu")]
        tread.instantiate()
        tread.setupExperiment()
        tread.enterInitializationMode()
        tread.setReal([number[f"pressure[{i + 1}]"] for i in range(BLOCKS)], [PRESSURE] * BLOCKS)
        if memory is not None:
            tread.setBoolean([number["memory"]], [memory])
        tread.exitInitializationMode()
        place = np.arange(BLOCKS) * LENGTH / BLOCKS
        time, speed, rows = 0.0, 100 / 3.6, []
        while speed > 1:
            place += speed * (1 - SLIP) * STEP
            entered = place > LENGTH
            place[entered] -= LENGTH
            if memory:
                resets = [number[f"reset[{i + 1}]"] for i in range(BLOCKS)]
                tread.setBoolean(resets, entered.tolist())
            tread.setReal(each[0], [SLIP * speed] * BLOCKS)
            tread.doStep(time, STEP)
            mu = float(np.mean(tread.getReal(each[1])))
            rows.append((time, speed, mu))
            speed -= mu * 9.81 * STEP
            time += STEP
        tread.terminate()
        tread.freeInstance()
    return np.array(rows)


runs = {
    "without heat": brake(hot.cold, None),
    "blocks heat up": brake(hot, True),
    "blocks always hot": brake(hot, False),
}

# %%
# Heat takes friction away, but for the highest speeds, where the rubber without it is on the glassy
# side of its loss peak. A block is hot after a small part of the way that it slides in the contact,
# so that its memory hardly matters here.
way = LENGTH * SLIP / (1 - SLIP)
print(f"hot after {1e3 * float(hot.sliding_length(1.0)):.2f} mm of {1e3 * way:.0f} mm")

figure, (speeds, coefficients) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
for name, rows in runs.items():
    distance = np.cumsum(rows[:, 1]) * STEP
    dashes = "--" if name == "blocks always hot" else "-"
    speeds.plot(distance, 3.6 * rows[:, 1], dashes, label=f"{name}: {distance[-1]:.1f} m")
    # the mean over one passage of the contact: single blocks enter and leave
    width = 50
    smooth = np.convolve(rows[:, 2], np.ones(width) / width, mode="valid")
    coefficients.plot(3.6 * rows[width - 1 :, 1], smooth, dashes, label=name)
speeds.set(xlabel="Braking distance [m]", ylabel="Speed [km/h]", ylim=(0, None))
speeds.legend()
coefficients.set(xlabel="Speed [km/h]", ylabel="Mean friction coefficient $\\mu$ [-]")
plt.show()
