"""What computes lets go of the interpreter: other threads of Python run meanwhile."""

import sys
import threading
import time
from functools import partial

import numpy as np
import pytest

import asperity
from helpers.examples import (
    BUILD,
    CURVE,
    FMAP,
    FUNCTIONS,
    ROAD,
    RUBBER,
    SLOW,
    SWEEPS,
    SWEPT,
    large_strain,
)
from helpers.rubbers import tread

V = np.geomspace(1e-3, 0.9, 300)
SCENE = {"pressure": 1e5, "velocity": V}
W = np.geomspace(1.5, 9e5, 100_000)
Q = np.geomspace(1.01e3, 9.9e4, 100_000)
MAP = asperity.synthesize(ROAD, shape=(300, 260), pixel_size=1e-5, seed=1)
LINE = asperity.LineScan(np.sin(np.arange(200_000.0)), spacing=1e-6)
HOLED = asperity.HeightMap(np.where(MAP.heights > 5e-5, np.nan, MAP.heights), pixel_size=1e-5)
LONG = asperity.TabulatedSpectrum(wavenumber=Q, density=Q**-3.6)
LONG_LINE = asperity.LineSpectrum(wavenumber=Q[::100], density=Q[::100] ** -2.6)
STICKING = asperity.Adhesion(shear_stress=8e6)
MU = asperity.friction(ROAD, RUBBER, **SCENE, adhesion=STICKING).mu
TALL = {"z_max": MAP.z_max, "z_min": MAP.z_min}

# Each takes 50 us or more, so that another thread has the time to notice.
COMPUTING = {
    "anisotropy": partial(asperity.anisotropy, MAP),
    "build_master_curve": partial(asperity.build_master_curve, SWEPT, reference_temperature=293.0),
    "contact_area": partial(asperity.contact_area, ROAD, RUBBER, **SCENE),
    "contact_notes": partial(
        asperity.contact_notes, ROAD, SLOW, **SCENE, correction=asperity.GreenwoodWilliamson(**TALL)
    ),
    "correction_factor": partial(
        asperity.correction_factor, ROAD, RUBBER, **SCENE, wavenumber=Q[::5000]
    ),
    "effective_modulus": partial(asperity.effective_modulus, modulus=W, poisson_ratio=0.4),
    "fit_adhesion": partial(asperity.fit_adhesion, ROAD, RUBBER, **SCENE, mu=MU),
    "fit_prony": partial(asperity.fit_prony, BUILD),
    "fit_self_affine": partial(asperity.fit_self_affine, LONG),
    "friction": partial(asperity.friction, ROAD, RUBBER, **SCENE, contributions=True),
    "friction_map": partial(
        asperity.friction_map,
        ROAD,
        RUBBER,
        pressure=(1e5, 2e5),
        velocity=(0.01, 0.1),
        rtol=1e-2,
        checked=100,
    ),
    "heat_kernel": partial(asperity.heat_kernel, Q, 1e4, velocity=1.0, heating=tread()),
    "line_spectrum": partial(asperity.line_spectrum, MAP),
    "mean_pressure": partial(asperity.mean_pressure, ROAD, SLOW, **SCENE),
    "merge_spectra": partial(asperity.merge_spectra, [LONG, LONG], per_decade=10),
    "power_spectrum": partial(asperity.power_spectrum, MAP),
    "pressure_distribution": partial(asperity.pressure_distribution, 1e5, ROAD, RUBBER, **SCENE),
    "separation": partial(
        asperity.separation, pressure=V * 1e5, effective_modulus=1e7, rms_height=1e-4, q0=1e3
    ),
    "spectral_density": partial(asperity.spectral_density, MAP),
    "synthesize": partial(asperity.synthesize, ROAD, shape=(200, 200), pixel_size=1e-5, seed=1),
}
METHODS = {
    "HeightMap": partial(asperity.HeightMap, MAP.heights, pixel_size=1e-5),
    "LineScan": partial(asperity.LineScan, LINE.heights, spacing=1e-6),
    "LocalPeaks": partial(asperity.LocalPeaks, MAP, min_distance=1e-4),
    "MasterCurve": partial(asperity.MasterCurve, **CURVE),
    "affine_shift": partial(MAP.affine_shift, 2.0),
    "angular_integrals": partial(SLOW.angular_integrals, W),
    "angular_integrals, Prony": partial(RUBBER.angular_integrals, W),
    "at": partial(LONG.at, Q[1:-1]),
    "at_strain": partial(large_strain, 0.2, SWEEPS),
    "autocorrelation": partial(ROAD.autocorrelation, np.linspace(0, 1e-2, 50)),
    "cutoff_for_slope": partial(LONG.cutoff_for_slope, 1e-9),
    "detrend": partial(MAP.detrend, "quadratic"),
    "extrapolated_shares": partial(SLOW.extrapolated_shares, W),
    "fill_dropouts": partial(HOLED.fill_dropouts, max_fraction=0.9),
    "height_histogram": MAP.height_histogram,
    "isotropic": LONG_LINE.isotropic,
    "line_density": partial(ROAD.line_density, Q),
    "local_peaks": partial(MAP.local_peaks, min_distance=1e-4),
    "log_binned": LONG.log_binned,
    "mu": partial(FMAP.mu, 1.5e5, np.linspace(0.02, 0.9, 10_000)),
    "modulus": partial(SLOW.modulus, W),
    "modulus, Prony": partial(RUBBER.modulus, W),
    "nayak_parameter": partial(getattr, LONG, "nayak_parameter"),
    "rms_height": partial(type(LONG).rms_height.func, LONG),
    "rms_slope": partial(getattr, MAP, "rms_slope"),
    "rms_slope of a spectrum": partial(type(LONG).rms_slope.func, LONG),
    "scaled": partial(LONG.scaled, 2.0),
    "shift_factor": partial(BUILD.shift_factor, np.linspace(284, 302, 10_000)),
    "shifted": partial(SLOW.shifted, 0.5),
    "skewness": partial(getattr, MAP, "skewness"),
    "truncated": partial(LONG.truncated, q1=5e4),
}
# Done in less than a microsecond, or files that Python reads.
QUICK = {"hertz_penetration", "read_isotherms", "read_shift_factors", "read_strain_sweep"}
QUICK |= {"read_surface", "friction_band", "export_fmu", "sweep", "report"}
QUICK |= {"read_master_curve", "prony_input"}
QUICK |= {"strain_factors"}
QUICK |= {"height_statistics"}  # computed by NumPy
QUICK |= {"read_scene", "fit_scene"}


def another_runs_during(call, seconds):
    """Whether a thread that waits for the interpreter gets it in this time of calls. Python never
    takes it away from the caller here: it has to be given."""
    waiting, ran, interval = threading.Event(), threading.Event(), sys.getswitchinterval()

    def other():
        waiting.wait()
        ran.set()

    thread = threading.Thread(target=other)
    sys.setswitchinterval(1e3)  # [s], before the thread can ask for a turn that comes too soon
    try:
        thread.start()  # runs on until it waits
        waiting.set()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            call()
            if ran.is_set():
                return True
        return False
    finally:
        sys.setswitchinterval(interval)
        waiting.set()
        thread.join()


gil = pytest.mark.skipif(
    not getattr(sys, "_is_gil_enabled", lambda: True)(), reason="this Python has no GIL"
)


@gil
def test_a_call_that_does_not_let_go_shows():
    assert not another_runs_during(lambda: sum(range(1000)), 0.2)
    assert not another_runs_during(lambda: ROAD.rms_height, 0.2)


@gil
def test_other_threads_run_during():
    calls = COMPUTING | METHODS
    assert [name for name, call in calls.items() if not another_runs_during(call, 20)] == []


def test_no_function_is_forgotten():
    assert set(COMPUTING) | QUICK == set(FUNCTIONS)
