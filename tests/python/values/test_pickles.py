"""Every public object survives pickle and copy, bit by bit, also into another process."""

import copy
import inspect
import multiprocessing
import pickle
import warnings
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, _core
from helpers.examples import BUILD, CURVE, EVERY, FMAP, ROAD, RUBBER, SHIFTS, SWEPT

PROTOCOLS = range(2, pickle.HIGHEST_PROTOCOL + 1)
ROUGH = asperity.synthesize(ROAD, shape=(48, 40), pixel_size=1e-4, seed=2)
STRIDED = asperity.HeightMap(ROUGH.heights.astype("f4")[::-1, ::2], pixel_size=(1e-4, 2e-4))
HOLED = asperity.HeightMap(
    np.where(np.abs(ROUGH.heights) > 2e-4, np.nan, ROUGH.heights), pixel_size=1e-4
)
SCANNED = asperity.power_spectrum(ROUGH)
SLOW = asperity.MasterCurve(
    **CURVE, shift_factors=asperity.ShiftFactors(**SHIFTS, standard_deviation=[0.1, 0, 0.2])
)
SWEEPS = [
    asperity.StrainSweep(
        temperature=t,
        angular_frequency=6.0,
        strain=[1e-3, 5e-3, 0.3],
        storage_modulus=[2e6, 1.9e6, 1e6],
        loss_modulus=[2e5, 2.5e5, 2e5],
    )
    for t in (273.0, 293.0, 313.0)
]


def large_strain(strain, sweeps):
    with warnings.catch_warnings():  # the sweeps do not span the curve
        warnings.simplefilter("ignore")
        return SLOW.at_strain(strain, sweeps)


def crowded():
    """Points whose means lie within 1 % of the next point: averaged twice they would be others."""
    w = [1.0, 1.009, 1.0111, 2.0, 3.0, 4.0]
    return asperity.Isotherm(
        temperature=293.0,
        angular_frequency=w,
        storage_modulus=np.multiply(w, 1e6),
        loss_modulus=np.multiply(w, 1e5),
    )


# States that no constructor's argument gives: what methods and fits made of them.
DERIVED = {
    "an isotherm with averaged rows": crowded(),
    "a strided float32 map": STRIDED,
    "a map with drop-outs": HOLED,
    "a map that was filled": HOLED.fill_dropouts(),
    "a detrended map": STRIDED.detrend("quadratic"),
    "a shifted map": ROUGH.affine_shift(2.0),
    "a strided line scan": asperity.LineScan(ROUGH.heights[3, ::-2], spacing=2e-4),
    "a measured spectrum": SCANNED,
    "a spectrum cut between its rows": SCANNED.truncated(q0=2000.0, q1=1e4),
    "a spectrum in bins": SCANNED.log_binned(per_decade=5),
    "a merged spectrum": asperity.merge_spectra([SCANNED, SCANNED.scaled(1.1)]),
    "a line spectrum": asperity.line_spectrum(STRIDED),
    "its isotropic surface": asperity.line_spectrum(ROUGH).log_binned(per_decade=6),
    "a cut self-affine spectrum": ROAD.truncated(q0=1234.5, q1=5e4),
    "the article's spectrum": asperity.SelfAffineSpectrum.from_article(
        h0=1e-4, hurst=0.8, q0=1e3, q1=1e5
    ),
    "a fit of the slope": asperity.fit_self_affine(SCANNED, q_min=2e3, q_max=2e4, method="slope"),
    "a warm series": RUBBER.shifted(0.3),
    "a warm master curve": SLOW.shifted(0.3),
    "a curve at large strain": large_strain(0.2, SWEEPS),
    "a smooth build": asperity.build_master_curve(
        SWEPT, reference_temperature=290.0, smooth=True, extrapolation="clamp"
    ),
    "its rubber": asperity.fit_prony(BUILD),
    "peaks of a strided map": asperity.LocalPeaks(STRIDED, min_distance=5e-4),
    "peaks and more of a map": asperity.PeaksThenGreenwoodWilliamson(ROUGH, min_distance=5e-4),
    "no friction": asperity.friction(
        ROAD,
        RUBBER,
        pressure=1.0,
        velocity=0.01,
        correction=asperity.GreenwoodWilliamson(z_max=1e-5, z_min=-1e-3),
    ),
}
ALL = EVERY | DERIVED | {"FrictionMap": FMAP}


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
    if type(value).__module__.startswith("asperity"):
        shown = {
            name
            for cls in type(value).__mro__
            for name, member in vars(cls).items()
            if isinstance(member, property)
        } | set(getattr(type(value), "__match_args__", ()))
        return type(value), {name: bits(getattr(value, name)) for name in sorted(shown)}
    assert isinstance(value, str | bytes | int | None), type(value)
    return value


def test_every_public_class_has_an_example():
    public = {name for name in asperity.__all__ if inspect.isclass(getattr(asperity, name))}
    values = {name for name in public if not issubclass(getattr(asperity, name), Exception)}
    assert {type(value).__name__ for value in ALL.values()} == values
    bound = {name for name, member in vars(_core).items() if inspect.isclass(member)}
    assert {name for name in bound if not name.startswith("_")} <= public


@pytest.mark.parametrize("name", ALL)
def test_a_copy_is_equal_and_has_the_same_bits(name):
    value = ALL[name]
    copies = [pickle.loads(pickle.dumps(value, protocol)) for protocol in PROTOCOLS]
    copies += [copy.copy(value), copy.deepcopy(value), copy.deepcopy([value, value])[1]]
    for again in copies:
        assert again is not value
        assert type(again) is type(value)
        assert again == value
        assert bits(again) == bits(value)
    assert bits(pickle.loads(pickle.dumps(copies[0]))) == bits(value)


SLIDING = {"pressure": [1e5, 3e6], "velocity": [0.01, 0.3], "rtol": 1e-8}
CORRECTIONS = (
    asperity.SFactor,
    asperity.NayakSFactor,
    asperity.AffineShift,
    asperity.LocalPeaks,
    asperity.GreenwoodWilliamson,
    asperity.PeaksThenGreenwoodWilliamson,
)


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
            return (
                value.fit_arrhenius(),
                value.shift_factor([285.0, 301.0]),
                value.master_curve.modulus(value.points.angular_frequency[3:-3]),
                asperity.fit_prony(value),
            )
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
        case asperity.StrainSweep():
            return large_strain(5e-3, [value])
        case asperity.FrictionMap():
            return value.mu([1.2e5, 1.9e5], [0.02, 0.9]), value.to_bytes()
        case _ if isinstance(value, CORRECTIONS):
            return asperity.friction(ROAD, RUBBER, **SLIDING, correction=value)
        case _:
            return None


RESULTS = {"Friction", "Separation", "WlfFit", "ArrheniusFit", "Anisotropy", "SpectralDensity"}
RESULTS |= {"MasterPoints", "FrictionBand", "FrictionSlopes"}


@pytest.mark.parametrize("name", ALL)
def test_a_copy_computes_the_same_bits(name):
    value = ALL[name]
    result = used(value)
    assert (result is None) == (type(value).__name__ in RESULTS)
    for again in (pickle.loads(pickle.dumps(value)), copy.deepcopy(value)):
        assert bits(used(again)) == bits(result)


def test_a_copy_shares_nothing_that_can_change():
    fit = EVERY["ArrheniusFit"]
    before = bits(fit)
    for again in (fit, copy.copy(fit)):
        again.standard_errors["activation_energy"] = 0.0
    assert bits(fit) == before


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("kind", ["Error", "InvalidInput", "OutOfRange", "NotConverged"])
def test_errors_survive_pickle(kind, protocol):
    made = getattr(asperity, kind)("velocity = -1: must be positive", 3)
    again = pickle.loads(pickle.dumps(made, protocol))
    assert type(again) is type(made)
    assert again.args == made.args
    with pytest.raises(InvalidInput) as raised:
        asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=-1)
    again = pickle.loads(pickle.dumps(raised.value, protocol))
    assert (type(again), str(again)) == (InvalidInput, str(raised.value))


FUNCTIONS = [n for n in asperity.__all__ if inspect.isroutine(getattr(asperity, n))]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_survive_pickle(name):
    function = getattr(asperity, name)
    for protocol in PROTOCOLS:
        assert pickle.loads(pickle.dumps(function, protocol)) is function
    assert copy.deepcopy(function) is function


def test_bound_methods_survive_pickle():
    w = np.geomspace(1, 1e6, 7)
    for protocol in PROTOCOLS:
        again = pickle.loads(pickle.dumps(RUBBER.angular_integrals, protocol))
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
    calls.append(partial(asperity.friction, ROAD, RUBBER, **SLIDING))
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=spawn) as pool:
        sent = [pool.submit(call) for call in calls]
        wrong = pool.submit(asperity.friction, ROAD, RUBBER, pressure=1e5, velocity=-1.0)
        for call, future in zip(calls, sent, strict=True):
            assert bits(future.result(timeout=120)) == bits(call())
        with pytest.raises(InvalidInput, match=r"^velocity = -1: must be positive"):
            wrong.result(timeout=120)


class Forged:
    """Pickles into a call of whatever it was given."""

    def __init__(self, function, *arguments):
        self.call = function, arguments

    def __reduce__(self):
        return self.call


FORGED_CLASSES = {type(value) for value in ALL.values()} - {asperity.FrictionBand}


def forgeries():
    """(name, pickle): states that no object has, of one object of each class."""
    for value in {type(value): value for value in EVERY.values()}.values():
        cls = type(value)
        if cls is asperity.FrictionBand:  # a dataclass of Python's own
            continue
        rebuild, (_, state) = value.__reduce__()[:2]
        first = cls.__match_args__[0]
        bad = {
            "no state": {},
            "a field too many": {**state, "colour": 1},
            "a field too few": {name: state[name] for name in state if name != first},
            "a name that is none": {**state, 7: 1},
            "no dict": [1, 2],
            **{f"{field} an object": {**state, field: object} for field in state},
            **{f"{field} a complex": {**state, field: 1j} for field in state},
            **{f"{field} of bytes": {**state, field: b"\xff" * 300} for field in state},
        }
        for what, forged in bad.items():
            yield f"{cls.__name__}: {what}", Forged(rebuild, cls, forged)
    whole = FMAP.to_bytes()
    for what, forged in {"cut": whole[:-9], "altered": whole[:200] + b"\x01" + whole[201:]}.items():
        yield f"FrictionMap: {what}", Forged(FMAP.__reduce__()[0], forged)
    yield "no class", Forged(rebuild, 3, {})
    yield "another class", Forged(rebuild, int, {})


FORGED = dict(forgeries())


@pytest.mark.parametrize("name", FORGED)
def test_a_forged_pickle_is_refused_in_a_line(name):
    stream = pickle.dumps(FORGED[name])
    with pytest.raises(InvalidInput) as refused:
        pickle.loads(stream)
    message = str(refused.value)
    assert "\n" not in message
    assert len(message) < 400


@pytest.mark.parametrize("cls", sorted(FORGED_CLASSES, key=lambda c: c.__name__))
def test_no_object_without_its_constructor(cls):
    by_hand = f"\x80\x02c{cls.__module__}\n{cls.__name__}\n)\x81."  # cls.__new__(cls), no more
    with pytest.raises(TypeError, match=f"{cls.__name__}: is made by calling it"):
        pickle.loads(by_hand.encode("latin-1"))
    for make in (cls.__new__, object.__new__):
        with pytest.raises(TypeError, match="__new__"):
            make(cls)
