"""Pictures and ranks of a store: what they draw, and certainties that are counted by hand."""

import csv
import os

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.plot import sweep as plot
from asperity.sweep.look import choose, notes_of, ranks, with_scenes
from helpers.cases import case
from helpers.sweeps import SCENE

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")
pytest.importorskip("zarr", reason="a store needs asperity[sweep]")
OVER = {
    "surface.hurst": [0.7, 0.8, 0.9],
    "rubbers": {
        "rubber.equilibrium_modulus_pa": [2e6, 5e6],
        "rubber.moduli_pa": [[1e9, 1e8, 1e7]] * 2,
    },
    "correction.kind": ["none", "partial-contact"],
    "conditions.pressure_pa": [1e5, 2e5, 4e5],
}


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    path = tmp_path_factory.mktemp("stored") / "r.zarr"
    asperity.sweep(SCENE, OVER, store=path).close()
    return path


def test_notes_are_those_of_what_was_chosen(swept):
    whole = {note.code for note in notes_of(swept)}
    assert "no-correction" in whole
    for kind, noted in (("none", True), ("partial-contact", False)):
        part = choose(with_scenes(swept), {"correction.kind": kind, "surface.hurst": "0.8"})
        assert ("no-correction" in {note.code for note in notes_of(part)}) == noted


@pytest.fixture
def swept(stored):
    with xarray.open_dataset(stored, engine="zarr") as result:
        yield result


def table(mu, error, band=None, numerical=0.0):
    """A store of three rubbers over two velocities and two roads."""
    along = ("rubber", "road", "conditions.velocity_m_s")
    variables = {
        "mu": (along, np.array(mu, float)),
        "failure": (along, np.zeros(np.shape(mu), int)),
    }
    variables["error_estimate"] = (along, np.full(np.shape(mu), numerical))
    variables["hysteresis"] = variables["mu"]
    variables["model_error"] = (along, np.array(error, float))
    if band is not None:
        variables["mu_low"] = (along, np.array(mu) - band)
        variables["mu_high"] = (along, np.array(mu) + band)
    return xarray.Dataset(
        variables,
        {"rubber": ["A", "B", "C"], "road": ["old", "new"], "conditions.velocity_m_s": [0.1, 1.0]},
    )


MU = [[[1.0, 0.5], [1.0, 0.6]], [[0.8, 0.9], [0.7, 0.59]], [[0.1, 0.1], [0.1, 0.1]]]


def test_ranks_are_those_counted_by_hand():
    result = ranks(table(MU, np.full((3, 2, 2), 0.1)), "rubber")
    assert result["rubber"] == ["A", "B", "C"]
    assert result["mean_mu"] == pytest.approx([3.1 / 4, 2.99 / 4, 0.1])
    assert result["lead"][:2] == pytest.approx([0.11 / 4, 2.59 / 4])
    assert result["best_share"] == [0.75, 0.25, 0]
    # leads 0.2 over 0.18, 0.4 over 0.14, 0.3 over 0.17 and 0.01 over 0.119
    assert result["certain_share"] == [0.5, 0.25, 0]
    assert result["best_at"] == ["road new; velocity_m_s 0.1", "", ""]
    result = ranks(table(MU, np.full((3, 2, 2), 0.11)), "rubber")  # 0.198, 0.154, 0.187, 0.131
    assert result["certain_share"] == [0.5, 0.25, 0]
    result = ranks(table(MU, np.full((3, 2, 2), 0.12)), "rubber")  # 0.216, 0.168, 0.204, 0.143
    assert result["certain_share"] == [0.25, 0.25, 0]  # 0.2 is more than 0.153, and no sum
    none = np.zeros((3, 2, 2))
    result = ranks(table(MU, none, band=0.14), "rubber")  # 0.28 for two
    assert result["certain_share"] == [0.25, 0.25, 0]
    result = ranks(table(MU, none, band=0.14, numerical=0.02), "rubber")  # 0.32
    assert result["certain_share"] == [0, 0.25, 0]
    result = ranks(table(MU, np.full((3, 2, 2), 0.1), band=0.14), "rubber")  # 0.42 with 0.14 of it
    assert result["certain_share"] == [0, 0, 0]
    result = ranks(table(MU, np.full((3, 2, 2), np.nan)), "rubber")
    assert np.isnan(result["certain_share"]).all()


def test_points_without_a_result_are_not_compared():
    mu = np.array(MU)
    mu[2, 0, 0] = np.nan
    result = ranks(table(mu, np.full((3, 2, 2), 0.1)), "rubber")
    assert result["best_share"] == pytest.approx([1 / 3, 2 / 3, 0])
    assert result["rubber"] == ["B", "A", "C"]  # without a place at which A leads by far
    assert result["mean_mu"][:2] == pytest.approx([2.19 / 3, 2.1 / 3])
    with pytest.raises(asperity.InvalidInput, match="no point at which every value"):
        ranks(table(np.full((3, 2, 2), np.nan), mu), "rubber")


def test_the_command_ranks_and_draws(stored, tmp_path, monkeypatch, capsys, undrawn):
    monkeypatch.chdir(tmp_path)
    assert main(["sweep", str(stored), "--rank", "rubbers", "--at", "surface.hurst=0.8"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    assert [row["rank"] for row in rows] == ["1", "2"]
    assert float(rows[0]["mean_mu"]) > float(rows[1]["mean_mu"])
    at = "surface.hurst=0.8,rubbers=2e6"
    assert main(["sweep", str(stored), "--plot", "p.png", "--at", at, "--style", "dark"]) == 0
    assert os.listdir() == ["p.png"]


BAD = {
    "": "is a store: look at it by --plot or --rank",
    "--rank rubber": "--rank rubber: is no axis, did you mean rubbers?",
    "--rank rubbers --at rubbers=2e6": "--rank rubbers: is no axis",
    "--rank rubbers --at surface.hurst=0.75": "is not on the axis, which has 0.7, 0.8, 0.9",
    "--rank rubbers --at hurst=0.7": "--at hurst: is no axis, did you mean surface.hurst?",
    "--plot p.png": "must be at most 3 beside conditions.velocity_m_s: fix the others by --at",
    "--at surface.hurst=0.7": "--at: goes with --plot or --rank",
}


def test_what_cannot_be_shown_is_refused(stored, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for line, said in BAD.items():
        with case(line=line):
            assert main(["sweep", str(stored), *line.split()]) == 2
            err = capsys.readouterr().err
            assert said in err
            assert len(err.splitlines()) == 1
    assert main(["sweep", "gone.zarr", "--rank", "x"]) == 2
    (tmp_path / "mine.nc").write_text("text")
    assert main(["sweep", "mine.nc", "--rank", "x"]) == 2
    assert os.listdir() == ["mine.nc"]


def drawn(dataset, path, monkeypatch, **how):
    """The figure of a dataset, which is not made a file."""
    pytest.importorskip("matplotlib", reason="its pictures need asperity[plot]")
    figures = []
    monkeypatch.setattr(plot, "picture", lambda figure, path: figures.append(figure) or b"")
    plot.sweep_figure(dataset, path, **how)
    return figures[0]


def test_panels_are_two_axes_and_colours_the_third(swept, tmp_path, monkeypatch):
    part = choose(swept, {"correction.kind": "partial-contact"})
    figure = drawn(part, tmp_path / "p.png", monkeypatch)
    assert [len(axes.lines) for axes in figure.axes] == [3] * 6
    titles = [axes.get_title() for axes in figure.axes]
    assert titles[0] == "hurst 0.7, rubbers 2 MPa"
    assert titles[-1] == "hurst 0.9, rubbers 5 MPa"
    line = figure.axes[3].lines[1]
    where = {"surface.hurst": 1, "rubbers": 1, "conditions.pressure_pa": 1}
    assert np.array_equal(line.get_ydata(), part.mu.isel(where))
    assert np.array_equal(line.get_xdata(), part["conditions.velocity_m_s"])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "100 kPa",
        "200 kPa",
        "400 kPa",
    ]
    assert "correction partial-contact" in figure.get_suptitle()
    area = drawn(part, tmp_path / "p.png", monkeypatch, name="contact_area")
    assert area.get_supylabel() == "Real over nominal contact area [-]"
    one = drawn(
        choose(part, {"surface.hurst": "0.8", "rubbers": "2e6"}), tmp_path / "p.png", monkeypatch
    )
    assert len(one.axes) == 1
    assert "rubbers 2 MPa" in one.get_suptitle()


def test_a_band_is_filled(tmp_path, monkeypatch):
    figure = drawn(table(MU, np.zeros((3, 2, 2)), band=0.1), tmp_path / "p.png", monkeypatch)
    assert [len(axes.collections) for axes in figure.axes] == [2, 2, 2]
