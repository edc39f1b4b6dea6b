"""One file for each isotherm, its temperature said beside it."""

import numpy as np
import pytest

import asperity
from asperity.scene.scene import load_scene
from helpers.scenes import CONDITIONS, SURFACE

COLUMNS = {"frequency": "f", "storage": "a", "loss": "b"}
UNITS = {"frequency": "rad/s", "temperature": "C", "modulus": "MPa"}
RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
CELSIUS = [30.0, 10.0, 20.0]


@pytest.fixture
def files(tmp_path):
    """Sweeps at CELSIUS of a rubber whose shift is 0.1 decade a kelvin, none at 20 C."""
    paths = []
    for celsius in CELSIUS:
        lines = ["f;a;b"]
        for w in np.geomspace(0.1, 100, 12):
            e = RUBBER.modulus(w * 10 ** (-0.1 * (celsius - 20))) / 1e6
            lines.append(f"{w:.12g};{e.real:.12g};{e.imag:.12g}".replace(".", ","))
        paths.append(tmp_path / f"{celsius:g}.txt")
        paths[-1].write_text("\n".join(lines))
    return paths


def test_temperatures_go_with_their_files(files):
    sweeps = asperity.read_isotherms(
        files, columns=COLUMNS, units=UNITS, modulus="E", temperatures=CELSIUS
    )
    assert [round(sweep.temperature, 2) for sweep in sweeps] == [283.15, 293.15, 303.15]
    build = asperity.build_master_curve(sweeps, reference_temperature=293.15)
    np.testing.assert_allclose(build.log10_a_T, [1, 0, -1], atol=1e-3)


SCENE = """
[rubber]
isotherms = ["30.txt", "10.txt", "20.txt"]
temperatures = [30, 10, 20]
temperature_k = 293.15
modulus = "E"
columns = {frequency = "f", storage = "a", loss = "b"}
units = {frequency = "rad/s", temperature = "C", modulus = "MPa"}
"""


def test_a_scene_takes_them_and_a_prony_series_through_them(files):
    path = files[0].parent / "scene.toml"
    rubber = {}
    for more in ("", "prony = true\n"):
        path.write_text(SURFACE + SCENE + more + CONDITIONS)
        rubber[more] = load_scene(path).rubber
    curve, series = rubber.values()
    assert isinstance(curve, asperity.MasterCurve)
    assert isinstance(series, asperity.PronyFit)
    w = np.geomspace(0.1, 100, 9)
    # read to 12 digits, smoothed and fitted: 0.0027 off
    np.testing.assert_allclose(series.modulus(w), RUBBER.modulus(w), rtol=0.01)


def test_a_scene_goes_beyond_the_fitted_frequencies_when_asked_by_name(files):
    path = files[0].parent / "scene.toml"

    def compute(*keys):
        path.write_text(SURFACE + SCENE + "\n".join((*keys, CONDITIONS)))
        return load_scene(path).friction()

    with pytest.raises(asperity.OutOfRange, match=r'extrapolation.*"prony"'):
        compute("prony = true")
    result = compute("prony = true", 'extrapolation = "prony"')
    assert any("outside of the measured ones" in note for note in result.notes)
    assert any("beyond the frequencies that it was fitted on" in note for note in result.notes)
    for extrapolation in ("power-law", "clamp"):
        with pytest.raises(
            asperity.InvalidInput, match=rf'extrapolation = {extrapolation}: .*"prony"'
        ):
            compute("prony = true", f'extrapolation = "{extrapolation}"')
    with pytest.raises(asperity.InvalidInput, match=r'"prony" needs prony = true'):
        compute('extrapolation = "prony"')
