"""What is no surface is refused in one line that begins with its file."""

import io
import os
import sys
import zipfile

import numpy as np
import pytest

from asperity import InvalidInput, read_surface

HEIGHTS = np.array([[1.0, 2.0, 4.0], [8.0, 16.0, 32.0]])
GWYDDION = "# Channel: Main\n# Width: 8 µm\n# Height: 9 µm\n# Value units: nm\n1 2 3\n4 5 6\n"
DEKTAK = "Scan Parameters\n\nScan Data\n\nLateral um,Raw Micrometer,\n"
PROFILE = DEKTAK + "0.0,1.0,,\n0.2,2.0,,\n0.4,1.0,,\n"


def npy(array):
    out = io.BytesIO()
    np.save(out, np.asarray(array), allow_pickle=True)
    return out.getvalue()


def huge(content):
    """A header that promises 2^64 numbers."""
    return content.replace(b"(2, 3), }" + b" " * 19, b"(4294967296, 4294967296), } ", 1)


def npz(*arrays):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for i, content in enumerate(arrays):
            archive.writestr(f"{i}.npy", content)
    return out.getvalue()


def refused(path, **given):
    with pytest.raises(InvalidInput) as caught:
        read_surface(path, **given)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)
    return caught.value


DAMAGED = {
    "short": ("a.npy", npy(HEIGHTS)[:-8]),
    "empty": ("a.npy", b""),
    "text": ("a.npy", b"1,2\n3,4\n"),
    "words": ("a.npy", npy([["a"]])),
    "complex": ("a.npy", npy(HEIGHTS * 1j)),
    "objects": ("a.npy", npy([[None]])),
    "huge": ("a.npy", huge(npy(HEIGHTS))),
    "a scene": ("a.toml", b"[surface]\n"),
    "no array": ("a.npz", npz(b"hello")),
    "empty archive": ("a.npz", npz()),
    "short array": ("a.npz", npz(npy(HEIGHTS)[:-8])),
    "short archive": ("a.npz", b"PK\x03\x04 and no more"),
    "no archive": ("a.npz", npy(HEIGHTS)),
    "empty text": ("a.csv", b""),
    "comments alone": ("a.csv", b"# nothing but this\n"),
    "a cell less": ("a.csv", b"1,2\n3\n"),
    "a word": ("a.csv", b"1,2\n3,high\n"),
    "an underscore": ("a.csv", b"1_0,2\n3,4\n"),
    "a comma too many": ("a.csv", b"1,5,;2,5\n"),
    "a blank line": ("a.csv", b"1\n\n2\n"),
    "a name": ("a.csv", b"height\n1\n2\n"),
    "two columns": ("a.csv", b"x [um],z [um]\n0,1\n1,2\n"),
}


@pytest.mark.parametrize("case", DAMAGED)
def test_damaged_files(tmp_path, case):
    name, content = DAMAGED[case]
    (tmp_path / name).write_bytes(content)
    error = refused(tmp_path / name, pixel_size=1.0, unit="m")
    assert error.argument == ""


@pytest.mark.parametrize(
    ("argument", "content", "given"),
    [
        ("heights", npy(1.0), {}),
        ("heights", npy(np.zeros((2, 3, 4))), {}),
        ("heights", npy(np.zeros((0, 4))), {}),
        ("heights", npy([[1.0, np.inf], [2.0, 3.0]]), {}),
        ("heights", b"1\ninf\n", {}),
        ("channel", npy(HEIGHTS), {"channel": "0"}),
        ("channel", npy(HEIGHTS), {"channel": 1}),
        ("channel", npz(npy(HEIGHTS), npy(HEIGHTS)), {"channel": 2}),
        ("pixel_size", npy(HEIGHTS), {"pixel_size": 0.0}),
        ("pixel_size", npy(HEIGHTS), {"pixel_size": (1.0, -1.0)}),
        ("pixel_size", npy(HEIGHTS), {"pixel_size": np.nan}),
        ("pixel_size", npy(HEIGHTS), {"pixel_size": None}),
        ("pixel_size", b"1\n2\n", {"pixel_size": (1e-6, 2e-6)}),
        ("pixel_size", b"1\n2\n", {"pixel_size": 0.0}),
        ("pixel_size", b"1\n2\n", {"pixel_size": None}),
        ("unit", npy(HEIGHTS), {"unit": None}),
        ("unit", npy(HEIGHTS), {"unit": "inch"}),
        ("unit", npy(HEIGHTS), {"unit": 1}),
    ],
    ids=lambda one: one if isinstance(one, str) else type(one).__name__,
)
def test_what_is_stated_of_them(tmp_path, argument, content, given):
    kinds = {b"\x93N": "a.npy", b"PK": "a.npz"}
    path = tmp_path / kinds.get(content[:2], "a.csv")
    path.write_bytes(content)
    assert refused(path, **{"pixel_size": 1.0, "unit": "m", **given}).argument == argument


@pytest.mark.parametrize("given", [{"unit": "nm"}, {"pixel_size": 1e-6}, {"channel": 1}])
@pytest.mark.parametrize(("name", "text"), [("a.asc", GWYDDION), ("a.csv", PROFILE)])
def test_what_the_file_of_an_instrument_states_is_not_overridden(tmp_path, name, text, given):
    pytest.importorskip("SurfaceTopography")
    (tmp_path / name).write_text(text, encoding="utf-8")
    error = refused(tmp_path / name, **given)
    assert (error.code, error.argument) == ("invalid-value", *given)


@pytest.mark.parametrize(
    "content", [b"", bytes(300), b"a tale\nof two cities\n", (DEKTAK + "0,1\n0,2\n").encode()]
)
def test_files_of_no_instrument(tmp_path, content):
    pytest.importorskip("SurfaceTopography")
    (tmp_path / "scan.dat").write_bytes(content)
    refused(tmp_path / "scan.dat")


@pytest.mark.parametrize("name", ["missing.npy", "missing.opd", ".", "pipe.csv", "/dev/zero"])
def test_what_is_no_file_is_not_waited_for(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    os.mkfifo("pipe.csv")
    assert "cannot be read: " in str(refused(name, pixel_size=1.0, unit="m"))


def test_no_name_of_a_file():
    with pytest.raises(InvalidInput, match="cannot be read: embedded null"):
        read_surface("a\0b.npy", pixel_size=1.0, unit="m")


@pytest.mark.parametrize(("name", "text"), [("a.opd", "any"), ("a.csv", PROFILE)])
def test_without_surface_topography_it_is_said_what_to_install(tmp_path, monkeypatch, name, text):
    for module in [m for m in sys.modules if m.partition(".")[0] == "SurfaceTopography"]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    (tmp_path / name).write_text(text)
    assert "-m pip install 'asperity[io]'" in str(refused(tmp_path / name))
