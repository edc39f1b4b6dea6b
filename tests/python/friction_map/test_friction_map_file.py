"""Files of friction maps: read by their documentation alone, and refused where they are damaged."""

import os
import pickle
import struct

import numpy as np
import pytest

from asperity import (
    Adhesion,
    FrictionMap,
    GreenwoodWilliamson,
    InvalidInput,
    PronySeries,
    friction_map,
)
from helpers.map_layout import ByLayout
from helpers.mapped import ROAD

RUBBER = PronySeries(equilibrium_modulus=3e6, moduli=[1e9, 1e7], relaxation_times=[1e-8, 1e-4])
BOX = {"pressure": (5e4, 1e6), "velocity": (1e-5, 3.0)}
KINDS = {
    "plain": {"adhesion": Adhesion(shear_stress=8.3e6, width=0.2), "rtol": 1e-3},
    "split": {"correction": GreenwoodWilliamson(z_max=9e-4, z_min=-4e-4), "rtol": 1e-4},
}


@pytest.fixture(scope="module", params=KINDS)
def result(request):
    return friction_map(ROAD, RUBBER, **BOX, checked=1000, text="# µ\n", **KINDS[request.param])


def test_the_documentation_is_enough_to_read_a_file(result):
    read = ByLayout(result.to_bytes())
    # no temperature, no heat
    assert (read.background, read.memory, read.cold, read.m) == ((0, 0), 0, 0, 1)
    assert read.box == (*result.pressure, *result.velocity)
    assert (read.rtol, read.max_error) == (result.rtol, result.max_error)
    assert (read.checked, read.exceeded) == (result.checked, result.exceeded) == (1000, 0)
    assert read.largest == result.largest_checked_error
    assert read.text == result.text
    assert read.text.endswith("# µ\n")
    assert len(read.cells) == result.cells
    draws = np.random.default_rng(3)
    for _ in range(300):
        p, v = (
            np.exp(draws.uniform(*np.log(sides))) for sides in (result.pressure, result.velocity)
        )
        exact = read.look_up(p, v)
        # ln mu is up to 10 in size: its rounding is 1e-15
        for name, value in zip(("hysteresis", "contact_area", "adhesion"), exact, strict=True):
            assert getattr(result, name)(p, v) == pytest.approx(value, rel=2e-14, abs=0)


def test_a_file_comes_back_as_it_was(result, tmp_path):
    path = tmp_path / "röad.fmap"
    result.save(path)
    assert path.read_bytes() == result.to_bytes()
    for same in (
        FrictionMap.load(path),
        FrictionMap.load(str(path)),
        FrictionMap.from_bytes(result.to_bytes()),
        pickle.loads(pickle.dumps(result)),
    ):
        assert same == result
        assert same.mu(2e5, 0.1) == result.mu(2e5, 0.1)
    assert os.listdir(tmp_path) == [path.name]
    # what a link points to is written, and nobody's file is in the way
    bystander = tmp_path / (path.name + ".0.part")
    bystander.write_bytes(b"mine")
    link = tmp_path / "link.fmap"
    link.symlink_to(path)
    result.save(link)
    assert link.is_symlink()
    assert path.read_bytes() == result.to_bytes()
    assert bystander.read_bytes() == b"mine"
    assert len(os.listdir(tmp_path)) == 3


@pytest.mark.parametrize(
    ("at", "written", "words"),
    [
        (12, struct.pack("<I", 1), "layout version 1: must be 4, so the map has to be made again"),
        (12, struct.pack("<I", 5), "layout version 5: must be 4$"),
        (8, struct.pack(">I", 0x01020304), "the other byte order"),
    ],
)
def test_other_versions_and_byte_orders_are_named(result, at, written, words):
    content = bytearray(result.to_bytes())
    content[at : at + 4] = written
    with pytest.raises(InvalidInput, match=words):
        FrictionMap.from_bytes(bytes(content))


def test_files_that_cannot_be_read_or_written_are_named(result, tmp_path):
    with pytest.raises(FileNotFoundError, match=r"none\.fmap"):
        FrictionMap.load(tmp_path / "none.fmap")
    (tmp_path / "other.fmap").write_bytes(b"no map")
    with pytest.raises(InvalidInput, match=r"other\.fmap: is no friction map"):
        FrictionMap.load(tmp_path / "other.fmap")
    for path in (tmp_path / "none" / "road.fmap", tmp_path, "a\0b"):
        with pytest.raises(InvalidInput, match=r"cannot be written: \w"):
            result.save(path)
    assert os.listdir(tmp_path) == ["other.fmap"]
