"""Files as laboratories have them: what is guessed, left out, converted, and said of them."""

import numpy as np
import pytest

import asperity
from asperity.app.state import State
from asperity.app.words import allowed_velocities
from asperity.base.diagnostics import Advice
from helpers.dropped import dma_bytes, scan_bytes

STRAIN = b"T;f;G';G\"\nC;Hz;MPa;MPa\n20;10;1;0.1\n20;10;0.9;0.2\n"


def take(state: State, *names: str, **changes: object) -> str:
    guess = state.guesses[names[0]]
    chosen = {"columns": guess.columns, "units": guess.units, "modulus": guess.modulus}
    return state.use_dma(list(names), {**chosen, "prony": True, "beyond": True, **changes})()


def test_files_of_one_frequency_are_left_out_and_it_is_said(state: State) -> None:
    sweeps = state.keep_dma("dma.csv", dma_bytes().replace(b"Temperature;Freq", b"T;f"))
    strain = state.keep_dma("strain.csv", STRAIN)
    said = take(state, sweeps, strain)
    assert said == "Left out, as they hold one frequency each: strain.csv."
    assert state.rubbers["your sweeps"]["isotherms"] == [sweeps]
    with pytest.raises(asperity.InvalidInput) as caught:
        take(state, strain)
    assert str(state.said(caught.value)).startswith(
        "strain.csv: holds one frequency: must be sweeps"
    )


@pytest.mark.parametrize("modulus", ["E", "G"])
def test_a_master_curve_in_any_units_is_that_curve(modulus: str, state: State) -> None:
    hertz = np.geomspace(1e-6, 1e12, 60)
    rubber = asperity.PronySeries(
        equilibrium_modulus=3e6,
        moduli=10 ** np.linspace(6, 9, 16),
        relaxation_times=10 ** np.linspace(2, -8, 16),
    )
    e = rubber.modulus(2 * np.pi * hertz)
    share = 1e6 * (3 if modulus == "G" else 1)
    rows = zip(hertz, e.real / share, e.imag / share, strict=True)
    lines = [f"Freq [Hz],{modulus}' [MPa],{modulus}'' [MPa]"]
    lines += [",".join(repr(float(x)) for x in row) for row in rows]
    name = state.keep_dma("curve.csv", "\n".join(lines).encode())
    assert "temperature" not in state.guesses[name].columns
    take(state, name)
    result = state.load().rubber
    assert isinstance(result, asperity.MasterCurve)
    assert result.angular_frequency == pytest.approx(2 * np.pi * hertz, rel=1e-12)
    assert result.storage_modulus == pytest.approx(e.real, rel=1e-12)
    assert result.loss_modulus == pytest.approx(e.imag, rel=1e-12)
    assert "was dropped as curve.csv" in state.text
    assert "temperature" not in state.text
    assert state.load().friction().mu.max() > 0
    state.rubber = "shipped surrogate"
    assert "temperature_c" in state.text


def test_the_shipped_shear_stress_does_not_go_with_other_files(state: State) -> None:
    state.keep_scan("scan.npy", scan_bytes())
    state.use_scan({"pixel_size_m": 5e-6, "unit": "um"})()
    assert "adhesion" not in state.tables
    assert state.adhesion_left
    state.use("adhesion", True)
    assert not state.adhesion_left
    state.adhesion = {**state.adhesion, "shear_stress_pa": 1e6}  # one's own
    take(state, state.keep_dma("dma.csv", dma_bytes()))
    assert state.tables["adhesion"]["shear_stress_pa"] == 1e6
    assert not state.adhesion_left


def test_a_message_on_velocities_offers_those_that_are_known(state: State) -> None:
    offered = Advice("from 3.904e-09 to 0.8187 m/s", (3.904e-9, 0.8187), "allowed-velocities")
    low, high = allowed_velocities(asperity.OutOfRange("velocities ", offered)) or (0, 0)
    assert 3.904e-09 < low < 4e-9
    assert 0.8 < high < 0.8187
    assert allowed_velocities(asperity.OutOfRange("nothing is allowed")) is None
    state.keep_velocities(low, high)
    assert state.velocities == (1e-6, high)
    state.keep_velocities(1, 2)
    assert state.velocities == (1, 2)
