"""Notes on heat: the size of what is left out, laws beyond their fit, rubbers that carry a_T."""

from dataclasses import replace

import pytest

import asperity
from asperity.results.heat_notes import with_size_of_heat
from helpers.cases import case
from helpers.examples import BUILD, ROAD, RUBBER
from helpers.refusals import refused
from helpers.rubbers import tread

LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
FIT = asperity.ShiftFactors(
    reference_temperature=293.0,
    temperature=[263.0, 283.0, 293.0, 303.0],
    log10_a_T=[3.2, 0.9, 0.0, -0.8],
).fit_wlf()
AT = {"pressure": 1e5, "temperature": 290.0, "shift": LAW}


def note_of(result, code):
    return next((note for note in result.notes if note.code == code), None)


def test_the_note_on_heat_says_its_size():
    """That of the fastest point, by the model itself with typical constants."""
    v = [1e-3, 10.0, 0.1]
    heating = tread()
    cold = asperity.friction(ROAD, RUBBER, velocity=v, **AT)
    hot = asperity.friction(ROAD, RUBBER, velocity=v, heating=heating, **AT)
    rise = hot.temperature[1] - 290.0
    assert rise > 1

    def heated_at(i, heat):
        return asperity.friction(ROAD, RUBBER, velocity=v[i], heating=heat, **AT)

    _, note = with_size_of_heat(cold.notes, v, False, heated_at)  # behind that on no correction
    assert f"at 10 m/s it would warm the rubber by {rise:.2g} K from 290 K" in note
    assert f"take mu from {hot.cold.mu[1]:.3g} to {hot.mu[1]:.3g}" in note
    assert note.next_step == note_of(cold, "heat-left-out").next_step
    assert note_of(hot, "heat-left-out") is None


def test_reading_notes_computes_nothing(monkeypatch):
    found = asperity.friction(ROAD, RUBBER, velocity=[1e-3, 10.0], **AT)
    monkeypatch.setattr(asperity._core, "flash_friction", None)
    assert [note.code for note in found.notes] == ["no-correction", "heat-left-out"]
    slow = asperity.friction(ROAD, RUBBER, velocity=1e-3, **AT)
    assert [note.code for note in slow.notes] == ["no-correction"]


@pytest.mark.parametrize("heated", [False, True])
def test_a_fitted_law_beyond_its_temperatures_is_noted(heated):
    given = {"pressure": 1e5, "velocity": 1e-3, "shift": FIT}
    more = {"heating": tread()} if heated else {}
    assert (FIT.lowest_temperature, FIT.highest_temperature) == (263.0, 303.0)
    inside = asperity.friction(ROAD, RUBBER, temperature=280.0, **given, **more)
    assert note_of(inside, "law-beyond-fit") is None
    outside = asperity.friction(ROAD, RUBBER, temperature=[280.0, 310.0], **given, **more)
    assert "it was fitted on 263 K to 303 K" in note_of(outside, "law-beyond-fit")
    if heated:  # from inside of them out, by its own heat
        given["velocity"] = 1.0
        warm = asperity.friction(ROAD, RUBBER, temperature=290.0, **given, **more)
        assert f"from 290 K to {warm.temperature:.5g} K" in note_of(warm, "law-beyond-fit")
        assert note_of(warm.cold, "law-beyond-fit") is None


def test_a_fitted_law_knows_both_ends_or_none():
    constants = {
        "c1": 8.0,
        "c2": 100.0,
        "reference_temperature": 293.0,
        "standard_errors": {"c1": 0.1, "c2": 1.0},
        "residual": 0.01,
    }
    plain = asperity.WlfFit(**constants)
    assert plain.lowest_temperature is None
    cold = asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=1e-3, temperature=250.0, shift=plain
    )
    assert [note.code for note in cold.notes] == ["no-correction"]
    with refused("highest_temperature", "invalid-input"):
        asperity.WlfFit(**constants, lowest_temperature=270.0)
    with refused("lowest_temperature"):
        asperity.WlfFit(**constants, lowest_temperature=300.0, highest_temperature=280.0)


def test_rubbers_of_a_build_carry_its_shift_into_friction():
    road = ROAD.truncated(q1=3e4)
    at = {"pressure": 1e5, "velocity": 2e-3, "temperature": 288.0}
    fit = asperity.fit_prony(BUILD, extrapolation="prony")
    for name, rubber in (("curve", BUILD.master_curve), ("Prony fit", fit)):
        with case(name=name):
            carried = asperity.friction(road, rubber, **at)
            by_hand = asperity.friction(road, rubber, shift=BUILD, **at)
            assert carried == by_hand
            assert carried.mu != asperity.friction(road, rubber, **at | {"temperature": 293.0}).mu
    with refused("temperature", "invalid-input"):
        asperity.friction(road, fit.shifted(2.0), **at)


def test_a_build_with_vertical_shifts_is_no_shift_of_frequencies_alone():
    stiffer = replace(BUILD, b_T=BUILD.temperature / 293.0)
    at = {"pressure": 1e5, "velocity": 2e-3, "temperature": 288.0}
    with refused("shift", "invalid-input"):
        asperity.friction(ROAD, RUBBER, shift=stiffer, **at)
    left_out = asperity.friction(ROAD, RUBBER, shift=stiffer.shift_factors, **at)
    assert left_out.mu == asperity.friction(ROAD, RUBBER, shift=BUILD, **at).mu
