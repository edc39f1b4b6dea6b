"""An instance of an FMU by FMPy, whatever standard, and what it is compared with."""

import platform
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from asperity import FrictionMap, friction_map
from asperity.fmu.export import platforms
from helpers.mapped import HEAT, ROAD, WARM_RUBBER, drawn

HEADERS = Path(fmpy.__file__).parent / "c-code"  # of both standards
BOX = {"pressure": (5e4, 1e6), "velocity": (1e-5, 3.0)}
OUTPUTS = {"mu": 8, "mu_hysteresis": 9, "mu_adhesion": 10, "contact_area": 11, "traction": 12}
SLOPES = {"dmu_dlnp": 13, "dmu_dlnv": 14}
INSIDE, A_T, MAX_ERROR, CLAMP = 15, 24, 25, 26
NAN = float("nan")
on_linux = pytest.mark.skipif(
    "x86_64-linux" not in platforms(), reason=f"no FMU binary on {platform.machine()}"
)


class Host:
    """An instance of an FMU, by FMPy, with one interface for both standards."""

    def __init__(self, path, folder, name="one", stop=None, **options):
        self.description = fmpy.read_model_description(str(path))
        self.version = self.description.fmiVersion
        kind = FMU2Slave if self.version == "2.0" else FMU3Slave
        self.folder = fmpy.extract(str(path), str(folder))
        self.unit = kind(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.start(stop, **options)

    def start(self, stop=None, **options):
        self.unit.instantiate(**options)
        times = {"startTime": 0.0, "stopTime": stop}
        if self.version == "2.0":
            self.unit.setupExperiment(**times)
        self.unit.enterInitializationMode(**({} if self.version == "2.0" else times))
        self.unit.exitInitializationMode()

    def set(self, references, values):
        (self.unit.setReal if self.version == "2.0" else self.unit.setFloat64)(references, values)

    def get(self, references, count=None):
        if self.version == "2.0":
            return self.unit.getReal(references)
        return self.unit.getFloat64(references, nValues=count or len(references))

    def inside(self, count=1):
        if self.version == "2.0":
            return self.unit.getInteger([INSIDE])[0]
        return self.unit.getInt32([INSIDE], nValues=count)[0]

    def clamp(self, value):
        self.unit.setBoolean([CLAMP], [value])

    def step(self, at=0.0, size=0.1):
        self.unit.doStep(at, size)

    def at(self, pressure, velocity):
        self.set([1, 2], [pressure, velocity])
        self.step()
        return self.get([*OUTPUTS.values(), *SLOPES.values()])

    def end(self):
        self.unit.terminate()
        self.unit.freeInstance()


def of_map(road, pressure, velocity, **options):
    """The seven outputs of one point from the map itself."""
    parts = [
        getattr(road, name)(pressure, velocity, **options)
        for name in ("mu", "hysteresis", "adhesion", "contact_area", "traction")
    ]
    slopes = road.derivatives(pressure, velocity, **options)
    return [*parts, slopes.dmu_dlnp, slopes.dmu_dlnv]


def same(numbers):
    """Equal to 1e-13: the batch of Python may take other instructions than the FMU."""
    return pytest.approx(np.asarray(numbers).tolist(), rel=1e-13, abs=1e-13)


def points(count, seed=1):
    pressure, velocity, side = drawn(count, BOX, (-1, 1), seed)
    return pressure, velocity * np.sign(side)


def hot_map(temperature: float | tuple[float, float]) -> FrictionMap:
    box = {"pressure": (8e4, 4e5), "velocity": (0.5, 2.0), "temperature": temperature}
    return friction_map(ROAD, WARM_RUBBER, **box, **HEAT, checked=0, rtol=3e-2)
