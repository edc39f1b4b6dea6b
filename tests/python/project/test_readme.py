"""What the README shows works as it stands there."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.scene.scene import load_scene

README = (Path(__file__).parents[3] / "README.md").read_text(encoding="utf-8")


RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Somewhere with the scan that the README speaks of: 0.64 mm wide, heights in micrometres."""
    monkeypatch.chdir(tmp_path)
    spectrum = asperity.SelfAffineSpectrum(rms_height=20e-6, hurst=0.8, q0=1e4, q1=1e6)
    scan = asperity.synthesize(spectrum, shape=(128, 128), pixel_size=5e-6, seed=1)
    np.save("scan.npy", scan.heights * 1e6)
    lines = ["f,T,G1,G2"]
    for celsius in range(0, 61, 10):
        for hertz in np.geomspace(0.1, 30, 12):
            e = RUBBER.modulus(2 * np.pi * hertz * 10 ** (-0.1 * (celsius - 20)))
            lines.append(f"{hertz},{celsius},{e.real / 3e6},{e.imag / 3e6}")
    (tmp_path / "dma.csv").write_text("\n".join(lines))
    road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
    road = road.truncated(q1=road.cutoff_for_slope(1.3))
    test = asperity.friction(
        road,
        RUBBER,
        pressure=81e3,
        velocity=np.geomspace(1e-6, 1e-2, 20),
        correction=asperity.NayakSFactor(),
        adhesion=asperity.Adhesion(shear_stress=8.3e6),
    )
    columns = np.column_stack([test.velocity, test.mu])
    np.savetxt("test.csv", columns, delimiter=",", header="velocity,mu")
    return tmp_path


def test_python(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    names: dict[str, object] = {}
    for block in blocks("python"):
        exec(block, names)
    result = names["result"]
    assert isinstance(result, asperity.Friction)
    assert np.all(result.error_estimate < 1e-6 * result.mu)
    fit = names["fit"]
    assert isinstance(fit, asperity.SelfAffineFit)
    assert 0.6 < fit.hurst < 1
    warm = names["warm"]
    assert isinstance(warm, asperity.PronySeries)
    exact = RUBBER.modulus(10 ** (-0.1 * 20) * 10.0)
    assert warm.modulus(10.0) == pytest.approx(exact, rel=0.02)
    adhesion = names["adhesion"]
    assert isinstance(adhesion, asperity.AdhesionFit)
    # by the hysteresis of the modulus that came out of the sweeps
    assert adhesion.shear_stress == pytest.approx(8.3e6, rel=0.02)
    assert capsys.readouterr().out


def test_scene(folder: Path) -> None:
    (scene,) = blocks("toml")
    (folder / "scene.toml").write_text(scene, encoding="utf-8")
    curves = load_scene(folder / "scene.toml").friction()
    assert curves.mu.shape == (2, 60)
    assert np.all(curves.mu > curves.hysteresis)


@pytest.mark.parametrize(
    "verb", ["demo", "friction", "area", "spectrum", "rubber", "fit", "article", "validate"]
)
def test_verbs(verb: str) -> None:
    assert f"asperity {verb}" in README
    text = subprocess.run(
        [sys.executable, "-m", "asperity", verb, "--help"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert f"asperity {verb}" in text
    assert "xample" in text


def test_equations_named_in_the_readme_are_numbered_once() -> None:
    numbers = [int(n) for n in re.findall(r"^- \((\d+)\)", README, re.MULTILINE)]
    assert numbers == list(range(1, len(numbers) + 1))
