"""An argument of another kind, for every argument of every call: one line that names it."""

import ast
from functools import partial

import numpy as np
import pytest
from test_codebase import STUB, signature
from test_released import FUNCTIONS, MAP, METHODS

import asperity
from asperity import InvalidInput, _core
from helpers.examples import EVERY, RUBBER


def signatures(body):
    return {node.name: signature(node) for node in body if isinstance(node, ast.FunctionDef)}


SIGNATURES = signatures(STUB.body)
METHODS_OF = {
    node.name: signatures(node.body) for node in STUB.body if isinstance(node, ast.ClassDef)
}


def calls():
    """(name, argument, call with it alone left to give)"""
    for name, call in (FUNCTIONS | METHODS).items():
        function = getattr(call, "func", call)
        owner = type(getattr(function, "__self__", None)).__name__
        known = METHODS_OF.get(owner, SIGNATURES).get(function.__name__)
        if known is None or not isinstance(call, partial):
            continue
        positional, keywords, _ = known
        for place, argument in enumerate(positional):
            before, after = call.args[:place], call.args[place + 1 :]
            yield (
                name,
                argument,
                lambda v, c=call, b=before, a=after: c.func(*b, v, *a, **c.keywords),
            )
        for argument in keywords:
            yield name, argument, lambda v, c=call, a=argument: c(**{a: v})
    for value in {type(v): v for v in EVERY.values()}.values():
        cls = type(value)
        if cls.__module__ == _core.__name__:
            state = {field: getattr(value, field) for field in cls.__match_args__}
            for argument in state:
                yield cls.__name__, argument, lambda v, c=cls, s=state, a=argument: c(**s | {a: v})


CALLS = {f"{name}, {argument}": (argument, call) for name, argument, call in calls()}
WRONG = [object(), 1j, b"\xff", {"a": 1}, "\udcff" * 200, "é" * 200]


@pytest.mark.parametrize("name", CALLS)
def test_another_kind_is_refused_in_a_line_that_names_the_argument(name):
    argument, call = CALLS[name]
    for value in WRONG:
        if isinstance(value, dict) and argument in {"fixed", "standard_errors"}:
            continue  # which are dicts, of other keys
        if isinstance(value, str) and argument in {"state", "text"}:
            continue
        with pytest.raises(InvalidInput) as refused:
            call(value)
        message = str(refused.value)
        assert argument in message
        assert "\n" not in message
        assert len(message) < 1500


@pytest.mark.parametrize(
    "value", [3, 3.0, np.float32(3), np.int64(3), np.float64(3), np.array(3.0), True], ids=repr
)
def test_what_is_a_number_is_taken_as_one(value):
    assert RUBBER.shifted(value) == RUBBER.shifted(float(value))
    assert asperity.SFactor(gamma=0.5 * bool(value)).gamma == 0.5


def test_a_whole_number_and_a_truth_are_no_other_numbers():
    assert MAP.local_peaks(min_distance=1.0, periodic=np.bool_(True)).size == 1
    assert MAP.height_histogram(bins=np.int32(4))[1].size == 4
    for wrong in (1.5, "1", None, [1]):
        with pytest.raises(InvalidInput, match=r"^bins = .*: must be a whole number$"):
            MAP.height_histogram(bins=wrong)
        with pytest.raises(InvalidInput, match=r"^periodic = .*: must be True or False$"):
            MAP.local_peaks(min_distance=1.0, periodic=wrong)


def test_options_say_what_there_is():
    for wrong in ("Hann", 3, None):
        said = '"Hann"' if wrong == "Hann" else str(wrong)
        with pytest.raises(InvalidInput) as refused:
            asperity.power_spectrum(MAP, window=wrong)
        allowed = '"split-cosine-bell", "hann", "none"'
        assert str(refused.value) == f"window = {said}: must be one of {allowed}"
    with pytest.raises(InvalidInput, match=r'^detrend = 3: must be one of "offset", .*, None$'):
        asperity.power_spectrum(MAP, detrend=3)
