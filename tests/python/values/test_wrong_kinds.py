"""An argument of another kind, for every argument of every call: one line that names it."""

import inspect
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import asperity
from asperity import InvalidInput
from helpers.calls import EVERY_CALL
from helpers.examples import FMAP, MEASURED, ROAD, ROUGH, RUBBER
from helpers.scenes import SCENE as TOML
from helpers.sweeps import SCENE


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
CURVE = ["angular_frequency_rad_s", "storage_modulus_pa", "loss_modulus_pa"]
FACTORS = "temperature_k,log10_a_t\n283,1\n293,0\n303,-1\n"


@pytest.fixture(scope="module")
def readers(tmp_path_factory):
    """Arguments of what reads and writes files."""
    tmp_path = tmp_path_factory.mktemp("readers")
    table, factors, scan, fmap = (tmp_path / n for n in ("r.csv", "a.csv", "s.npy", "m.bin"))
    table.write_text(LINES)
    factors.write_text(FACTORS)
    np.save(scan, ROUGH.heights)
    FMAP.save(fmap)
    solved = tmp_path / "solved.npz"
    asperity.ScanContact(ROUGH).save(solved)
    curve = tmp_path / "curve.csv"
    curve.write_text(f"{', '.join(CURVE)}\n1,1e6,1e5\n1e3,2e6,2e5\n")
    scene = tmp_path / "scene.toml"
    scene.write_text(TOML)
    without = {name: column for name, column in ROWS["columns"].items() if name != "temperature"}
    strains = {name: {**ROWS[name], "strain": "e"} for name in ("columns", "units")}
    strains["units"]["strain"] = "%"
    return {
        "read_isotherms": {"paths": table, **ROWS, "columns": without, "temperatures": [293.0]},
        "read_master_curve": {"path": curve},
        "read_strain_sweep": {"path": table, **ROWS, **strains},
        "read_shift_factors": {"path": factors, "reference_temperature": 293.0},
        "read_surface": {"path": scan, "pixel_size": 1e-4, "unit": "m"},
        "FrictionMap.load": {"path": fmap},
        "FrictionMap.save": {"path": fmap},
        "ScanContact.load": {"path": solved},
        "ScanContact.save": {"path": solved},
        "export_fmu": {"map": FMAP, "path": tmp_path / "m.fmu"},
        "sweep": {"scene": SCENE, "over": {"surface.hurst": [0.7, 0.8]}},
        "fit_scene": {"scene": SCENE, "measured": MEASURED},
        "report": {"scenes": scene, "path": tmp_path / "report.html"},
        "read_scene": {"path": scene},
    }


@pytest.fixture(params=EVERY_CALL)
def call(request, readers):
    """A function and arguments that work."""
    function, good = EVERY_CALL[request.param]
    return function, readers[request.param] if good is None else good


def test_it_has_a_signature_and_names_what_is_missing_or_unknown(call):
    function, good = call
    parameters = inspect.signature(function).parameters
    assert set(good) <= set(parameters)
    with pytest.raises(TypeError, match="colour") as refused:
        function(**good, colour="red")
    assert len(str(refused.value)) < 300
    for argument, parameter in parameters.items():
        assert parameter.kind in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY)
        if parameter.default is parameter.empty:
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
            and argument
            in {"text", "path", "paths", "measured", "scene", "scenes", "title", "preparation"}
        )
        or (callable(value) and argument in {"progress", "tell"})
    )


def test_another_kind_is_refused_in_a_line_that_names_the_argument(call):
    function, good = call
    for argument in inspect.signature(function).parameters:
        for value in WRONG:
            if right(argument, value):
                continue
            with pytest.raises(InvalidInput) as refused:
                function(**{**good, argument: value})
            message = str(refused.value)
            assert argument in message
            assert len(message.splitlines()) == 1
            assert len(message) < 300
            message.encode()  # as a log file asks for


def test_a_file_is_named_in_one_line_whatever_its_name(call, tmp_path):
    function, good = call
    for argument in {"path", "paths"} & set(inspect.signature(function).parameters):
        with pytest.raises((InvalidInput, OSError)) as refused:
            function(**{**good, argument: tmp_path / "no\nsuch" / "\x1b[2J.npy"})
        assert str(refused.value).isprintable()
        with pytest.raises(InvalidInput, match=argument):
            function(**{**good, argument: np.array(0.3)})


# slow, or wants more than these arguments: tried in tests of its own
ELSEWHERE = {"plot", "to_xarray", "to_dataframe", "fit_wlf", "report", "sweep"}


@pytest.mark.filterwarnings("ignore:strain sweeps reach")
def test_what_works_does(call):
    function, good = call
    if function.__name__ not in ELSEWHERE:
        function(**good)


@pytest.mark.parametrize(
    "value", [3, 3.0, np.float32(3), np.int64(3), np.array(3.0), Fraction(3), True]
)
def test_what_is_a_number_is_taken_as_one(value):
    assert RUBBER.shifted(value) == RUBBER.shifted(float(value))
    assert asperity.SFactor(gamma=0.5 * bool(value)).gamma == 0.5


def test_a_series_of_pandas_is_an_array_and_no_number():
    series = pytest.importorskip("pandas").Series
    result = asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=series([0.01, 0.1]))
    np.testing.assert_array_equal(
        result.mu, asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=[0.01, 0.1]).mu
    )
    for wrong in (series([0.5]), series([0.5] * 1000)):
        with pytest.raises(InvalidInput) as refused:
            asperity.SFactor(gamma=wrong)
        assert (refused.value.argument, refused.value.allowed) == ("gamma", "a number")


def test_a_whole_number_and_a_truth_are_no_other_numbers():
    assert ROUGH.local_peaks(min_distance=1.0, periodic=np.bool_(True)).size == 1
    assert ROUGH.height_histogram(bins=np.int32(4))[1].size == 4
    for wrong in (1.5, "1", None, [1]):
        with pytest.raises(InvalidInput) as refused:
            ROUGH.height_histogram(bins=wrong)
        assert refused.value.argument == "bins"
        with pytest.raises(InvalidInput) as refused:
            ROUGH.local_peaks(min_distance=1.0, periodic=wrong)
        assert refused.value.argument == "periodic"
