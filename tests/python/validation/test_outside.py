"""What the scripts of tests/benchmarks/outside find in clones of others' repositories.

The clones are in the folder that ASPERITY_OUTSIDE names, each by the name of its repository; tests
that need one are skipped without it. The figures are those of docs/notes/outside.md.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks" / "outside"))
import clone
import measured_mu
import program
import road_profile

SCRIPTS = Path(road_profile.__file__).parent


def cloned(name: str) -> Path:
    folder = Path(os.environ.get("ASPERITY_OUTSIDE", "nowhere")) / name
    if not folder.is_dir():
        pytest.skip(f"needs a clone of {name} in the folder ASPERITY_OUTSIDE")
    return folder


@pytest.fixture(scope="module")
def presets() -> clone.Presets:
    return clone.Presets(cloned("psfinal_hysteresis_redesign"))


@pytest.mark.parametrize("script", ["program", "measured_mu", "road_profile", "elastic"])
def test_without_a_clone_a_script_does_nothing(script: str, tmp_path: Path) -> None:
    command = [sys.executable, SCRIPTS / f"{script}.py", tmp_path]
    ended = subprocess.run(command, capture_output=True, text=True)
    assert ended.returncode != 0
    assert ended.stderr.startswith("skipped: name a clone of https://github.com/")
    assert ended.stdout == ""


def test_the_scheme_with_one_number_is_that_of_the_commercial_program(
    presets: clone.Presets,
) -> None:
    result = program.compare(presets)
    plain = result["S100, small strain, $q_1$ 1.05e6"]["S twice, 0.50"]
    softened = result["S100, 0.3 MPa"]["S twice, 0.60"]
    for (_, _, mu, area), of_mu, of_area in ((plain, 0.02, 0.04), (softened, 0.09, 0.02)):
        assert abs(mu.mean()) < of_mu
        assert abs(area.mean()) < of_area
        assert abs(mu).max() < 0.17
        assert abs(area).max() < 0.17


def test_heat_takes_as_much_friction_as_in_the_commercial_program(presets: clone.Presets) -> None:
    hot = program.heat(presets)
    slow = hot["velocity"] < 3
    for n in (0, 1):
        assert abs(hot["own"][n] / hot["program"][n] - 1)[slow].max() < 0.06


def test_an_adhesion_fitted_to_other_compounds_tells_no_more_than_their_mean(
    presets: clone.Presets,
) -> None:
    rows = measured_mu.points(presets, measured_mu.CORRECTIONS["`PartialContact`"])
    theory, baseline = measured_mu.errors(rows, measured_mu.GROUPS["all five"])
    assert theory.size == 29
    assert np.mean(theory**2) > np.mean(baseline**2)
    assert np.sqrt(np.mean(baseline**2)) == pytest.approx(0.083, abs=0.001)


def test_the_programs_spectrum_is_that_of_the_tops_not_divided(presets: clone.Presets) -> None:
    result = road_profile.spectra(cloned("psd"), presets)
    q = np.geomspace(5e3, 1e5, 20)
    ratio = result["commercial program"].at(q) / result["top, not divided"].at(q)
    assert abs(np.log(ratio).mean()) < 0.15
    full = result["commercial program"].at(q) / result["full"].at(q)
    assert np.exp(np.log(full).mean()) == pytest.approx(0.24, abs=0.03)
