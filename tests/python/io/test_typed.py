"""Numbers in messages as they were typed, from options and from scenes."""

import pytest

from asperity import InvalidInput
from asperity.base.diagnostics import Argument, Value
from asperity.io.typed import Typed, TypedWhole, as_typed
from asperity.scene.scene import load_scene
from helpers.scenes import SCENE


@pytest.mark.parametrize(
    ("old", "new", "typed"),
    [
        ("1e9, 1e8, 1e7", "1e9, -7.00e9, 1e7", " = -7.00e9: "),
        ("[81e3, 2e5]", "[1e5, 1_000.0e9]", "[conditions] pressure_pa = 1_000.0e9: "),
        ("8.3e6", "-7.00e-99", "[adhesion] shear_stress_pa = -7.00e-99: "),
    ],
)
def test_scenes(folder, old, new, typed):
    path = folder / "wrong.toml"
    path.write_text(SCENE.replace(old, new))
    with pytest.raises(InvalidInput) as error:
        load_scene(path).friction()
    assert typed in str(error.value)


@pytest.mark.parametrize(
    ("name", "value", "given", "typed"),
    [
        ("--q", 1e6, {"--q": Typed("1000000.0")}, "1000000.0"),
        ("--q-max", 5.0, {"--q": Typed("5.0")}, "shown"),  # another option
        ("--q", 5.0, {"--q": Typed("5.1")}, "shown"),  # another number
        ("--n", 5.0, {"--n": (TypedWhole("05"), TypedWhole("6"))}, "05"),
        ("[a] b", 2.0, {"[a] b": [Typed("1.0"), Typed("2.0")]}, "2.0"),
        ("[a] b", 1.0, {"[a] b": True}, "shown"),
        ("[a] b", 1.0, {"[a] b": 10**400}, "shown"),
    ],
)
def test_numbers_are_as_they_were_typed(name, value, given, typed):
    sentence = (Argument(name), " = ", Value("shown", (value,)), ": no")
    assert "".join(as_typed(sentence, given)) == f"{name} = {typed}: no"
