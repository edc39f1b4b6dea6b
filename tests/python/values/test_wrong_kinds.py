"""An argument of another kind, for every argument of every call: one line that names it."""

import inspect
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import asperity
from asperity import InvalidInput
from helpers.cases import case
from helpers.examples import (
    ALL,
    AT,
    CALLS,
    CLASSES,
    FMAP,
    FUNCTIONS,
    ROAD,
    ROUGH,
    RUBBER,
    SLOW,
    SWEEPS,
)
from helpers.scenes import SCENE as TOML
from helpers.sweeps import SCENE

# What functions return holds what they computed, and nothing is checked again.
RESULTS = {"Friction", "FrictionBand", "FrictionSlopes", "Separation"}


class Unshown:
    """What cannot even be shown, and is no path either."""

    def __repr__(self):
        raise RuntimeError("no repr")

    def __fspath__(self):
        return b"bytes"


WRONG = [object(), 1j, b"\xff", {"a": 1}, "\udcff" * 200, "é\n" * 200, 10**400, 10**5000, print]
WRONG += [Decimal("sNaN"), Unshown(), np.ma.masked_array([1.0, 2.0], [False, True])]
ROWS = {
    "columns": {"frequency": "f", "storage": "s", "loss": "l", "temperature": "T"},
    "units": {"frequency": "Hz", "modulus": "Pa", "temperature": "K"},
    "modulus": "E",
}
LINES = "f,s,l,T,e\n" + "".join(f"{10**k},2e6,1e6,293,{10**k}\n" for k in range(4))
FACTORS = "temperature_k,log10_a_t\n283,1\n293,0\n303,-1\n"
METHODS = {  # by name: classes that have the method take the same
    "adhesion": AT,
    "affine_shift": {"p": 2.0},
    "angular_integrals": {"angular_frequency": 10.0},
    "at": {"wavenumber": 5e3},
    "at_strain": {"strain": 5e-3, "sweeps": SWEEPS, "shift_factors": SLOW.shift_factors},
    "autocorrelation": {"distance": 1e-4},
    "contact_area": AT,
    "cutoff_for_contamination": {"size": 1e-3},
    "cutoff_for_slope": {"slope": 1.0},
    "derivatives": AT,
    "sliding_length": {"velocity": AT["velocity"]},
    "detrend": {"order": "plane"},
    "extended": {},
    "extrapolated_shares": {"angular_frequency": 10.0},
    "fill_dropouts": {"max_fraction": 0.9},
    "fit_arrhenius": {},
    "fit_wlf": {},
    "from_article": {"h0": 1e-4, "hurst": 0.8, "q0": 1e3, "q1": 1e5},
    "from_bytes": {"content": FMAP.to_bytes()},
    "height_histogram": {"bins": 4},
    "hysteresis": AT,
    "isotropic": {},
    "line_density": {"wavenumber": 5e3},
    "local_peaks": {"min_distance": 1e-3},
    "log10_a_T": {"temperature": 293.0},
    "log10_a_T_slope": {"temperature": 293.0},
    "log_binned": {},
    "modulus": {"angular_frequency": 10.0},
    "mu": AT,
    "mu_at": {"distance": 1e-3},
    "plot": {},
    "progress": {"tell": print},
    "scaled": {"factor": 2.0},
    "shift_factor": {"temperature": 293.0},
    "shifted": {"a_T": 0.5},
    "to_bytes": {},
    "to_dataframe": {},
    "to_xarray": {},
    "traction": AT,
    "truncated": {},
}


@pytest.fixture
def readers(tmp_path):
    """Calls of the functions that read files."""
    table, factors, scan, fmap = (tmp_path / n for n in ("r.csv", "a.csv", "s.npy", "m.bin"))
    table.write_text(LINES)
    factors.write_text(FACTORS)
    np.save(scan, ROUGH.heights)
    FMAP.save(fmap)
    solved = tmp_path / "solved.npz"
    asperity.ScanContact(ROUGH).save(solved)
    scene = tmp_path / "scene.toml"
    scene.write_text(TOML)
    without = {name: column for name, column in ROWS["columns"].items() if name != "temperature"}
    strains = {name: {**ROWS[name], "strain": "e"} for name in ("columns", "units")}
    strains["units"]["strain"] = "%"
    return {
        "read_isotherms": {"paths": table, **ROWS, "columns": without, "temperatures": [293.0]},
        "read_strain_sweep": {"path": table, **ROWS, **strains},
        "read_shift_factors": {"path": factors, "reference_temperature": 293.0},
        "read_surface": {"path": scan, "pixel_size": 1e-4, "unit": "m"},
        "FrictionMap.load": {"path": fmap},
        "FrictionMap.save": {"path": fmap},
        "ScanContact.load": {"path": solved},
        "ScanContact.save": {"path": solved},
        "export_fmu": {"map": FMAP, "path": tmp_path / "m.fmu"},
        "sweep": {"scene": SCENE, "over": {"surface.hurst": [0.7, 0.8]}},
        "report": {"scenes": scene, "path": tmp_path / "report.html"},
    }


def public_methods(value):
    """Methods of an object by name, those of its class too."""
    for name, _ in inspect.getmembers(type(value), callable):
        if not name.startswith("_"):
            yield name, getattr(value, name)


def calls(readers):
    """(name, function, arguments that work) of everything that the package offers."""
    for name, function in FUNCTIONS.items():
        yield name, function, readers[name] if name in readers else CALLS[name]
    for value in {type(v): v for v in ALL.values()}.values():
        cls = type(value)
        if cls.__name__ not in RESULTS:
            yield cls.__name__, cls, value._arguments()
        for name, method in public_methods(value):
            full = f"{cls.__name__}.{name}"
            yield full, method, readers[full] if full in readers else METHODS[name]


def test_every_call_has_a_signature_and_names_what_is_missing_or_unknown(readers):
    for name, function, good in calls(readers):
        with case(name=name):
            parameters = inspect.signature(function).parameters
            assert set(good) <= set(parameters)
            with pytest.raises(TypeError, match="colour") as refused:
                function(**good, colour="red")
            assert len(str(refused.value)) < 300
            for argument, parameter in parameters.items():
                assert parameter.kind in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY)
                if parameter.default is not parameter.empty:
                    continue
                left = {other: good[other] for other in good if other != argument}
                with pytest.raises(TypeError, match=rf"\b{argument}\b") as refused:
                    function(**left)
                assert len(str(refused.value)) < 300


def right(argument, value):
    """Whether an argument may be of this kind."""
    return (
        argument == "ax"  # whatever draws
        or (argument == "heights" and np.ma.isMaskedArray(value))  # drop-outs
        or (isinstance(value, dict) and argument in {"fixed", "paths", "standard_errors"})
        or (
            isinstance(value, str)
            and argument in {"text", "path", "paths", "scene", "scenes", "title"}
        )
        or (callable(value) and argument in {"progress", "tell"})
    )


def test_another_kind_is_refused_in_a_line_that_names_the_argument(readers):
    tried = 0
    for name, function, good in calls(readers):
        for argument in inspect.signature(function).parameters:
            for at, value in enumerate(WRONG):
                if right(argument, value):
                    continue
                with case(name=name, argument=argument, at=at):
                    with pytest.raises(InvalidInput) as refused:
                        function(**{**good, argument: value})
                    message = str(refused.value)
                    assert argument in message
                    assert len(message.splitlines()) == 1
                    assert len(message) < 300
                    message.encode()  # as a log file asks for
                    tried += 1
    assert tried > 2000


def test_a_file_is_named_in_one_line_whatever_its_name(readers, tmp_path):
    for name, function, good in calls(readers):
        for argument in {"path", "paths"} & set(inspect.signature(function).parameters):
            with case(name=name):
                with pytest.raises((InvalidInput, OSError)) as refused:
                    function(**{**good, argument: tmp_path / "no\nsuch" / "\x1b[2J.npy"})
                assert str(refused.value).isprintable()
                with pytest.raises(InvalidInput, match=argument):
                    function(**{**good, argument: np.array(0.3)})


@pytest.mark.filterwarnings("ignore:strain sweeps reach")
def test_what_works_does(readers):
    for name, function, good in calls(readers):
        if name.endswith((".plot", ".to_xarray", ".to_dataframe", ".fit_wlf")):
            continue  # tried elsewhere; a law wants more temperatures
        with case(name=name):
            function(**good)


def test_what_is_a_number_is_taken_as_one():
    values = [3, 3.0, np.float32(3), np.int64(3), np.float64(3), np.array(3.0), Fraction(3), True]
    for value in values:
        with case(value=value):
            assert RUBBER.shifted(value) == RUBBER.shifted(float(value))
            assert asperity.SFactor(gamma=0.5 * bool(value)).gamma == 0.5


def test_a_series_of_pandas_is_an_array_and_no_number():
    series = pytest.importorskip("pandas").Series
    found = asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=series([0.01, 0.1]))
    np.testing.assert_array_equal(
        found.mu, asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=[0.01, 0.1]).mu
    )
    for wrong in (series([0.5]), series([0.5] * 1000)):
        with pytest.raises(InvalidInput, match=r"^gamma = .*: must be a number$"):
            asperity.SFactor(gamma=wrong)
    with pytest.raises(InvalidInput, match=r"^velocity = .*: must be a number or an array"):
        asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=series(["x", "y"]))


def test_a_whole_number_and_a_truth_are_no_other_numbers():
    assert ROUGH.local_peaks(min_distance=1.0, periodic=np.bool_(True)).size == 1
    assert ROUGH.height_histogram(bins=np.int32(4))[1].size == 4
    for wrong in (1.5, "1", None, [1]):
        with pytest.raises(InvalidInput, match=r"^bins = .*: must be a whole number, from 1 to"):
            ROUGH.height_histogram(bins=wrong)
        with pytest.raises(InvalidInput, match=r"^periodic = .*: must be True or False$"):
            ROUGH.local_peaks(min_distance=1.0, periodic=wrong)


def test_options_say_what_there_is():
    for wrong, said in (("Hann", '"Hann"'), ("a\nb", '"a\\nb"'), (3, "3"), (None, "None")):
        with pytest.raises(InvalidInput) as refused:
            asperity.power_spectrum(ROUGH, detrend=wrong) if wrong is not None else (
                asperity.power_spectrum(ROUGH, window=wrong)
            )
        assert f" = {said}: must be one of " in str(refused.value)


def test_every_class_has_been_called():
    assert {cls.__name__ for cls in map(type, ALL.values())} == set(CLASSES)
