"""Every public class is a value: fields read-only, ==, repr, pickle, patterns, documented units."""

import copy
import inspect
import pickle
import re

import numpy as np
import pytest

import asperity

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5, rolloff=2e3)
RUBBER = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
TABLE = {"wavenumber": [1e3, 1e4, 1e5], "density": [1e-12, 1e-16, 1e-20]}
HEIGHTS = np.arange(12.0).reshape(3, 4)
PEAKS = [1e-4, 2e-4, 3e-4]
FIT = {
    "spectrum": ROAD,
    "covariance": np.array([[1e-12, 2e-9, 1e-6], [2e-9, 1e-4, 0.02], [1e-6, 0.02, 100.0]]),
    "residual": 0.1,
    "rows": 17,
}
CURVE = {
    "angular_frequency": [1.0, 1e3, 1e6],
    "storage_modulus": [1e6, 1e7, 1e8],
    "loss_modulus": [1e5, 1e6, 1e7],
}
SWEEP = {
    "angular_frequency": [1.0, 10.0, 100.0, 1000.0],
    "storage_modulus": [1e6, 2e6, 3e6, 4e6],
    "loss_modulus": [1e5, 2e5, 3e5, 4e5],
}
SHIFTS = {
    "reference_temperature": 293.0,
    "temperature": [273.0, 293.0, 313.0],
    "log10_a_T": [2.0, 0.0, -1.5],
}
STRAIN = {
    "temperature": 293.0,
    "angular_frequency": 6.0,
    "strain": [1e-3, 1e-2],
    "storage_modulus": [2e6, 1e6],
    "loss_modulus": [2e5, 2.5e5],
}
FITTED = {
    "equilibrium_modulus": 1e6,
    "moduli": [1e8],
    "relaxation_times": [1e-4],
    "storage_residual": 0.01,
    "loss_residual": 0.02,
    "causal": True,
    "notes": ("a note",),
}
STICKING = {
    "shear_stress": 8e6,
    "reference_velocity": 6e-3,
    "width": 0.1,
    "covariance": [[1e10, 10.0, 0.1], [10.0, 1e-6, 1e-6], [0.1, 1e-6, 1e-4]],
    "residual": 0.05,
    "outliers": [[False, True]],
    "notes": ("a note",),
}
SEPARATION = {"pressure": [1e5, 1e6], "effective_modulus": 1e7, "rms_height": 1e-4, "q0": 1e3}
# class, the arguments it is made from, one argument changed
MADE = [
    ("SelfAffineSpectrum", {"rms_height": 1e-4, "hurst": 0.8, "q0": 1e3, "q1": 1e5}, {"q1": 2e5}),
    ("TabulatedSpectrum", {**TABLE, "count": [4, 8, 12]}, {"count": [4, 8, 13]}),
    ("TabulatedSpectrum", TABLE, {"count": [4, 8, 13]}),
    ("HeightMap", {"heights": HEIGHTS, "pixel_size": (1e-6, 2e-6)}, {"pixel_size": 1e-6}),
    ("HeightMap", {"heights": np.where(HEIGHTS == 5, np.nan, HEIGHTS), "pixel_size": 1.0}, None),
    ("SelfAffineFit", FIT, {"rows": 18}),
    ("PronySeries", {"equilibrium_modulus": 1e6, "moduli": [], "relaxation_times": []}, None),
    (
        "PronySeries",
        {"equilibrium_modulus": 1e6, "moduli": [1e8], "relaxation_times": [1e-4]},
        {"moduli": [2e8]},
    ),
    ("MasterCurve", CURVE, {"extrapolation": "clamp"}),
    (
        "MasterCurve",
        {**CURVE, "shift_factors": asperity.ShiftFactors(**SHIFTS)},
        {"shift_factors": None},
    ),
    ("LineScan", {"heights": HEIGHTS[0], "spacing": 1e-6}, {"spacing": 2e-6}),
    ("LineSpectrum", {**TABLE, "count": [2, 2, 2], "flag": [1, 0, 2]}, {"flag": [0, 0, 2]}),
    ("TabulatedSpectrum", {**TABLE, "standard_error": [1e-13, 1e-17, 1e-21]}, {"flag": [0, 0, 4]}),
    ("Isotherm", {"temperature": 293.0, **SWEEP}, {"temperature": 294.0}),
    ("ShiftFactors", SHIFTS, {"standard_deviation": [0.1, 0, 0.1]}),
    ("StrainSweep", STRAIN, {"angular_frequency": 7.0}),
    ("PronyFit", FITTED, {"causal": False}),
    ("SFactor", {"gamma": 0.4, "applies_to": "both"}, {"applies_to": "area"}),
    ("NayakSFactor", {"friction_gamma": 0.4}, {"friction_gamma": 1.0}),
    ("AffineShift", {"p": 2.0}, {"p": 2.1}),
    ("LocalPeaks", {"heights_or_map": PEAKS}, {"z_max": 4e-4}),
    ("GreenwoodWilliamson", {"z_max": 1e-3, "z_min": -1e-3}, {"peaks": PEAKS}),
    (
        "PeaksThenGreenwoodWilliamson",
        {"heights_or_map": PEAKS, "z_min": -1e-3},
        {"reading": "added"},
    ),
    ("Adhesion", {"shear_stress": 8e6}, {"width": 0.2}),
    ("AdhesionFit", STICKING, {"residual": 0.06}),
    ("AdhesionFit", STICKING, {"outliers": [[True, False]]}),
]
IDS = [f"{name}{i}" for i, (name, _, _) in enumerate(MADE)]
RESULTS = {
    "Friction": asperity.friction(ROAD, RUBBER, pressure=[1e5, 2e5], velocity=0.01),
    "Friction with contributions": asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=0.01, contributions=True
    ),
    "Separation": asperity.separation(**SEPARATION),
    "Separation with states": asperity.separation(**SEPARATION, z_max=1e-3, z_min=-1e-3),
    "WlfFit": asperity.ShiftFactors(
        **{**SHIFTS, "temperature": [263, 283, 293, 303], "log10_a_T": [3.2, 0.9, 0, -0.8]}
    ).fit_wlf(),
    "ArrheniusFit": asperity.ShiftFactors(**SHIFTS).fit_arrhenius(),
    "Anisotropy": asperity.anisotropy(
        asperity.HeightMap(np.random.default_rng(1).normal(size=(80, 80)), pixel_size=1.0)
    ),
    "SpectralDensity": asperity.spectral_density(asperity.HeightMap(HEIGHTS, pixel_size=1.0)),
    "LocalPeaks of a map": asperity.LocalPeaks(
        asperity.synthesize(ROAD, shape=(40, 40), pixel_size=3e-4, seed=1), min_distance=1e-3
    ),
}
VALUES = [getattr(asperity, name)(**arguments) for name, arguments, _ in MADE]
EVERY = dict(zip(IDS, VALUES, strict=True)) | RESULTS


def make(name, arguments):
    return getattr(asperity, name)(**arguments)


@pytest.mark.parametrize(("name", "arguments", "change"), MADE, ids=IDS)
def test_equal_arguments_make_equal_values_and_others_do_not(name, arguments, change):
    assert make(name, arguments) == make(name, arguments)
    assert (make(name, arguments) != make(name, arguments)) is False
    if change is not None:
        assert make(name, arguments) != make(name, arguments | change)
    assert make(name, arguments) != arguments
    assert make(name, arguments) is not None


@pytest.mark.parametrize(("name", "arguments", "change"), MADE, ids=IDS)
def test_constructor_arguments_are_attributes(name, arguments, change):
    value = make(name, arguments)
    for field, given in arguments.items():
        found = getattr(value, field)
        if isinstance(given, list | np.ndarray):
            np.testing.assert_array_equal(found, given)
        elif field == "pixel_size":
            assert found == (given if isinstance(given, tuple) else (given, given))
        else:
            assert found == given


@pytest.mark.parametrize("name", EVERY)
def test_pickle_and_copy_give_the_same_value(name):
    value = EVERY[name]
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(value, protocol)) == value
    assert copy.copy(value) == copy.deepcopy(value) == value


def test_a_pickled_float32_map_stays_float32():
    surface = asperity.HeightMap(HEIGHTS.astype("f4")[::-1], pixel_size=1)
    again = pickle.loads(pickle.dumps(surface))
    assert again.heights.dtype == np.float32
    np.testing.assert_array_equal(again.heights, surface.heights)


@pytest.mark.parametrize("name", EVERY)
def test_repr_names_every_field_and_reads_back(name):
    value = EVERY[name]
    text = repr(value)
    assert text.startswith(type(value).__name__ + "(")
    assert text.endswith(")")
    for field in type(value).__match_args__:
        assert f"{field}=" in text
    if "..." not in text:
        names = vars(asperity) | {"array": np.array, "nan": np.nan, "inf": np.inf} | vars(np)
        assert type(eval(text, dict(names))) is type(value)


@pytest.mark.parametrize("name", EVERY)
def test_fields_match_patterns_and_cannot_be_written(name):
    value = EVERY[name]
    fields = type(value).__match_args__
    assert fields
    for field in fields:
        with pytest.raises(AttributeError):
            setattr(value, field, getattr(value, field))
    with pytest.raises(AttributeError):
        value.something_new = 1
    with pytest.raises(TypeError, match="unhashable"):
        hash(value)


def test_match_statements_take_values_apart():
    match asperity.SFactor(gamma=0.4, applies_to="area"):
        case asperity.SFactor(gamma=gamma, applies_to="area"):
            assert gamma == 0.4
        case _:
            pytest.fail("no match")
    match ROAD:
        case asperity.SelfAffineSpectrum(rms_height, hurst, q0, q1, rolloff):
            assert (rms_height, hurst, q0, q1, rolloff) == (1e-4, 0.8, 1e3, 1e5, 2e3)
        case _:
            pytest.fail("no match")


@pytest.mark.parametrize(  # a result's arrays belong to whoever asked for it
    "value", [*(v for v in VALUES if not isinstance(v, asperity.HeightMap))]
)
def test_writing_into_an_array_that_was_handed_out_changes_no_value(value):
    before = repr(value)
    for field in type(value).__match_args__:
        found = getattr(value, field)
        if isinstance(found, np.ndarray) and found.flags.writeable:
            found *= 2
    assert repr(value) == before


CLASSES = [c for c in vars(asperity).values() if inspect.isclass(c)]
FUNCTIONS = [
    getattr(asperity, name)
    for name in asperity.__all__
    if callable(getattr(asperity, name)) and not inspect.isclass(getattr(asperity, name))
]
UNITLESS = {
    "SFactor",
    "NayakSFactor",
    "SelfAffineFit",
    "Error",
    "InvalidInput",
    "OutOfRange",
    "NotConverged",
}
UNIT = r"\[(K|m|1/m|m\^4|m\^2|Pa|Pa\^2|1/Pa|rad/s|s|m/s|N|-)\]"


@pytest.mark.parametrize("thing", [*CLASSES, *FUNCTIONS], ids=lambda t: t.__name__)
def test_docstring_says_what_it_is_and_in_which_units(thing):
    text = inspect.getdoc(thing)
    assert text is not None
    assert len(text) > 20
    unitless = UNITLESS | {"fit_self_affine", "read_surface"}
    assert thing.__name__ in unitless or re.search(UNIT, text)


@pytest.mark.parametrize("cls", [c for c in CLASSES if not issubclass(c, Exception)])
def test_every_property_and_method_is_documented(cls):
    undocumented = [
        name
        for name, member in vars(cls).items()
        if not name.startswith("_")
        and not inspect.getdoc(member)
        and name not in (cls.__doc__ or "")
    ]
    assert undocumented == []
