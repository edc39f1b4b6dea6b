"""Every public value survives pickle and copy, bit by bit, also into another process."""

import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np
import pytest

import asperity
from asperity import InvalidInput
from asperity.base.diagnostics import Note
from helpers.examples import (
    ALL,
    CLASSES,
    DERIVED,
    EVERY,
    FMAP,
    FUNCTIONS,
    ROAD,
    RUBBER,
    SCANNED,
    SLOW,
    large_strain,
)

SLIDING = {"pressure": [1e5, 3e6], "velocity": [0.01, 0.3], "rtol": 1e-8}


def copies(value):
    """The value as each way of copying gives it."""
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        yield pickle.loads(pickle.dumps(value, protocol))
    yield copy.copy(value)
    yield copy.deepcopy(value)
    yield pickle.loads(pickle.dumps(copy.copy(value)))


def bits(value):
    """The value down to its bits: of an object, everything that it shows."""
    if isinstance(value, np.ndarray | np.generic):
        return type(value), value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, tuple | list):
        return [bits(one) for one in value]
    if isinstance(value, dict):
        return {key: bits(one) for key, one in value.items()}
    if isinstance(value, Note):
        return value.line, {name: bits(one) for name, one in vars(value).items()}
    if isinstance(value, str):  # phrases too
        return str(value)
    if type(value).__module__.startswith("asperity"):
        return type(value), {name: bits(getattr(value, name)) for name in attributes(value)}
    assert isinstance(value, str | bytes | int | None), type(value)
    return value


def attributes(value):
    """Names of the fields and properties of an object."""
    members = {name: one for cls in type(value).__mro__ for name, one in vars(cls).items()}
    shown = {name for name, one in members.items() if isinstance(one, property)}
    return sorted(shown | set(type(value).__match_args__))


def arrays(value):
    """Every array of an object, those of the objects that it holds too."""
    for name in attributes(value):
        found = getattr(value, name)
        if isinstance(found, np.ndarray):
            yield name, found
        elif hasattr(type(found), "__match_args__"):
            yield from arrays(found)


def test_every_public_class_has_an_example():
    assert {type(value) for value in ALL.values()} == set(CLASSES.values())


@pytest.mark.parametrize("name", ALL)
def test_copies_are_equal_and_share_nothing_that_can_change(name):
    value = ALL[name]
    for again in copies(value):
        assert again is not value
        assert type(again) is type(value)
        assert again == value
        assert bits(again) == bits(value)
        assert not any(array.flags.writeable for _, array in arrays(again))
    assert not any(array.flags.writeable for _, array in arrays(value))
    for (attribute, mine), (_, copied) in zip(
        arrays(value), arrays(copy.deepcopy(value)), strict=True
    ):
        assert not (mine.size and np.shares_memory(mine, copied)), attribute


def test_errors_of_a_law_are_the_readers_own():
    fit = EVERY["ArrheniusFit"]
    before = bits(fit)
    for again in (fit, copy.copy(fit)):
        again.standard_errors["activation_energy"] = 0.0
    assert bits(fit) == before


def used(value):
    """What is computed with the value; None of a result, which nothing is computed with."""
    match value:
        case asperity.SelfAffineSpectrum() | asperity.TabulatedSpectrum():
            return asperity.friction(value, RUBBER, **SLIDING, contributions=True)
        case asperity.PronySeries() | asperity.MasterCurve():
            return asperity.friction(ROAD, value, **SLIDING)
        case asperity.Adhesion():
            return asperity.friction(ROAD, RUBBER, **SLIDING, adhesion=value)
        case asperity.SelfAffineFit():
            return asperity.friction_band(value, RUBBER, pressure=1e5, velocity=0.1, samples=20)
        case asperity.MasterCurveBuild():
            return value.fit_arrhenius(), value.shift_factor([285.0, 301.0])
        case asperity.HeightMap() if value.heights.size > 100:
            filled = value.fill_dropouts(max_fraction=0.9)
            return asperity.power_spectrum(filled), filled.local_peaks(min_distance=3e-4)
        case asperity.HeightMap() | asperity.LineScan():
            return value.rms_slope, value.height_histogram(bins=5)
        case asperity.LineSpectrum():
            return value.log_binned(per_decade=3)
        case asperity.Isotherm():
            rows = {name: getattr(value, name) for name in value.__match_args__}
            colder = asperity.Isotherm(
                **rows | {"temperature": 283.0, "angular_frequency": rows["angular_frequency"] / 3}
            )
            return asperity.build_master_curve([value, colder], reference_temperature=290.0)
        case asperity.ShiftFactors():
            return value.shift_factor([275.0, 300.0]), value.fit_arrhenius()
        case asperity.WLF() | asperity.WlfFit() | asperity.ArrheniusFit():
            return value.log10_a_T([275.0, 300.0]), value.log10_a_T_slope(300.0)
        case asperity.Heating():
            return asperity.heat_kernel(1e3, [1e3, 2e4], velocity=0.3, heating=value)
        case asperity.StrainSweep():
            return large_strain(5e-3, [value])
        case asperity.StrainFactors():
            return asperity.friction(ROAD, RUBBER, **SLIDING, strain_factors=value)
        case asperity.FrictionMap():
            return value.mu([1.2e5, 1.9e5], [0.02, 0.9]), value.to_bytes()
        case _ if type(value).__name__ in asperity.correction.__all__:
            return asperity.friction(ROAD, RUBBER, **SLIDING, correction=value)
        case _:
            return None


RESULTS = {"Friction", "Separation", "Anisotropy", "SpectralDensity", "HeightStatistics"}
RESULTS |= {"Gradients", "MasterPoints", "FrictionBand", "FrictionSlopes", "SceneFit"}


@pytest.mark.parametrize("name", ALL)
def test_copies_compute_the_same_bits(name):
    value = ALL[name]
    result = bits(used(value))
    assert (result is None) == (type(value).__name__ in RESULTS)
    assert bits(used(pickle.loads(pickle.dumps(value)))) == result


def test_functions_and_bound_methods_survive_pickle():
    for function in FUNCTIONS.values():
        assert pickle.loads(pickle.dumps(function)) is function
    w = np.geomspace(1, 1e6, 7)
    again = pickle.loads(pickle.dumps(RUBBER.angular_integrals))
    assert bits(again(w)) == bits(RUBBER.angular_integrals(w))


def test_another_process_computes_the_same_bits():
    sticking = asperity.Adhesion(shear_stress=8e6)
    scenes = [
        (SCANNED.truncated(q1=1e4), SLOW, DERIVED["peaks of a strided map"], sticking),
        (ROAD, EVERY["PronyFit of a build"], asperity.NayakSFactor(), None),
        (DERIVED["the article's spectrum"], RUBBER, EVERY["GreenwoodWilliamson21"], sticking),
    ]
    # functions of the package alone: a process that is spawned need not find this file
    calls = [
        partial(asperity.friction, *parts, **SLIDING, correction=correction, adhesion=adhesion)
        for *parts, correction, adhesion in scenes
    ]
    calls.append(partial(FMAP.mu, [1.2e5, 1.9e5], 0.02))
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=spawn) as pool:
        sent = [pool.submit(call) for call in calls]
        back = [pool.submit(copy.copy, value) for value in ALL.values()]
        wrong = pool.submit(asperity.friction, ROAD, RUBBER, pressure=1e5, velocity=-1.0)
        for call, future in zip(calls, sent, strict=True):
            assert bits(future.result(timeout=120)) == bits(call())
        for (name, value), future in zip(ALL.items(), back, strict=True):
            assert bits(future.result(timeout=120)) == bits(value), name
        with pytest.raises(InvalidInput) as refused:
            wrong.result(timeout=120)
        assert (refused.value.argument, refused.value.value) == ("velocity", -1)
