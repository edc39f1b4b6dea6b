"""Rows of positions and heights: maps and line scans, or refused by their name."""

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, LineScan, read_surface

HEIGHTS = np.random.default_rng(3).normal(size=(5, 7))
DY, DX = 3.0, 1 / 3  # um; the second is rounded in a file
X, Y = np.meshgrid(np.arange(7) * DX + 40, np.arange(5) * DY - 6)
ROWS = np.column_stack([X.ravel(), Y.ravel(), HEIGHTS.ravel()])


def text(rows, head="", mark="\t"):
    return head + "".join(mark.join(f"{cell:.3f}" for cell in row) + "\n" for row in rows)


@pytest.mark.parametrize("order", ["by rows", "by columns", "shuffled"])
@pytest.mark.parametrize("name", ["map.txt", "map.csv", "map.xyz"])
def test_rows_of_x_y_z_are_a_map(tmp_path, name, order):
    at = np.arange(35).reshape(5, 7)
    places = {
        "by rows": at.ravel(),
        "by columns": at.T.ravel(),
        "shuffled": np.random.default_rng(1).permutation(35),
    }[order]
    (tmp_path / name).write_text(text(ROWS[places], mark="," if name == "map.csv" else " "))
    surface = read_surface(tmp_path / name, unit="um")
    assert isinstance(surface, HeightMap)
    np.testing.assert_allclose(surface.heights, 1e-6 * HEIGHTS, atol=6e-10)
    np.testing.assert_allclose(surface.pixel_size, (DY * 1e-6, DX * 1e-6), rtol=1e-3)


def test_points_that_are_missing_are_dropouts(tmp_path):
    (tmp_path / "map.txt").write_text(text(np.delete(ROWS, [3, 11, 20], axis=0)))
    surface = read_surface(tmp_path / "map.txt", unit="um")
    missing = np.flatnonzero(np.isnan(surface.heights.ravel()))
    np.testing.assert_array_equal(missing, [3, 11, 20])


@pytest.mark.parametrize(
    ("head", "given", "metres"),
    [
        ("x [mm];y [mm];z [µm]\n", {}, (1e-3, 1e-6)),
        ("made by hand\nX (mm);Y (mm);Height (nm)\n\n", {}, (1e-3, 1e-9)),
        ("X;Y;Z\nmm;mm;um\n", {}, (1e-3, 1e-6)),
        ("x;y;z\n", {"unit": "nm"}, (1e-9, 1e-9)),
        ("x;y;z\n", {"unit": "um", "pixel_size": (3e-3, 1e-3 / 3)}, (1e-3, 1e-6)),
    ],
)
def test_units_are_those_of_the_file_or_given(tmp_path, head, given, metres):
    (tmp_path / "map.txt").write_text(text(ROWS, head, ";"), encoding="utf-8")
    surface = read_surface(tmp_path / "map.txt", **given)
    np.testing.assert_allclose(surface.pixel_size[0], DY * metres[0], rtol=1e-3)
    np.testing.assert_allclose(surface.heights, metres[1] * HEIGHTS, atol=6e-4 * metres[1])


def test_rows_of_x_z_are_a_line_scan(tmp_path):
    profile = np.column_stack([np.arange(35) * 0.5, HEIGHTS.ravel()])
    for rows in (profile, profile[::-1]):
        (tmp_path / "line.csv").write_text(text(rows, "pos [um],z [nm]\n", ","))
        scan = read_surface(tmp_path / "line.csv")
        assert isinstance(scan, LineScan)
        assert scan.spacing == pytest.approx(0.5e-6, rel=1e-12, abs=0)
        np.testing.assert_allclose(scan.heights, 1e-9 * HEIGHTS.ravel(), atol=6e-13)


CLOUD = np.random.default_rng(2).normal(size=(40, 3))
HOLED = ROWS * [1, 1, np.nan]


@pytest.mark.parametrize(
    ("rows", "given", "message"),
    [
        (CLOUD, {"unit": "um"}, "rows x, y, z whose points lie on no regular grid"),
        (ROWS, {"unit": "um", "pixel_size": 1e-6}, "pixel_size = 1e-06: must be left out, or the"),
        (ROWS, {}, "unit is missing"),
        (np.vstack([ROWS, ROWS[:1]]), {"unit": "um"}, "two heights at one x and y"),
        (CLOUD[:, :2], {"unit": "um"}, "positions do not increase"),
        (HOLED, {"unit": "um"}, "heights"),
        (np.column_stack([np.arange(30) ** 2, CLOUD[:30, 0]]), {"unit": "um"}, "equally spaced"),
    ],
)
def test_what_is_no_scan_is_refused_by_its_name(tmp_path, rows, given, message):
    (tmp_path / "map.txt").write_text(text(rows))
    with pytest.raises(InvalidInput) as caught:
        read_surface(tmp_path / "map.txt", **given)
    assert str(caught.value).startswith(f"{tmp_path / 'map.txt'}: ")
    assert message in str(caught.value)
