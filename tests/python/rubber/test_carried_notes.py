"""Notes on how a rubber was made go with it into all that is computed of it, and through files."""

import warnings

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.io.read_master_curve import read_master_curve
from asperity.validation import slide
from helpers.rubbers import T_REF, built, sweeps

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e4)
POINT = {"pressure": 1e5, "velocity": 0.1}
SIDES = {"pressure": (5e4, 2e5), "velocity": (0.05, 0.2)}


@pytest.fixture(scope="module")
def swapped():
    """A build whose columns were swapped: its moduli are of no one material."""
    build = built(sweeps(change=lambda _, e: e.imag + 1j * e.real))
    assert any(note.severity == "fatal" for note in build.notes)
    return build


def rubbers_of(build):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        fit = asperity.fit_prony(build)
    curve = build.master_curve
    return {
        "the build": build,
        "its curve": curve,
        "another temperature": curve.shifted(10.0),
        "a Prony fit": fit,
        "that elsewhere": fit.shifted(10.0),
    }


RESULTS = {
    "friction": lambda rubber: asperity.friction(ROAD, rubber, **POINT).notes,
    "area": lambda rubber: asperity.contact_notes(ROAD, rubber, **POINT),
    "map": lambda rubber: (
        asperity.friction_map(ROAD, rubber, **SIDES, rtol=0.01, checked=100).notes
    ),
    "adhesion": lambda rubber: (
        asperity.fit_adhesion(
            ROAD,
            rubber,
            pressure=1e5,
            velocity=[0.05, 0.1, 0.2],
            mu=[9.0, 9.1, 9.0],
            fixed={"reference_velocity": 6e-3, "width": 0.1},
        ).notes
    ),
    "slide": lambda rubber: (
        slide(
            asperity.synthesize(ROAD, shape=(32, 32), pixel_size=1e-4, seed=1), rubber, **POINT
        ).notes
    ),
}


@pytest.mark.parametrize("name", ["the build", "its curve", "another temperature", "a Prony fit"])
def test_a_rubber_has_the_notes_of_its_build(swapped, name):
    assert rubbers_of(swapped)[name].notes == swapped.notes


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_has_the_notes_of_its_rubber_fatal_ones_first(swapped, name):
    for rubber in (swapped, rubbers_of(swapped)["a Prony fit"]):
        notes = RESULTS[name](rubber)
        assert set(swapped.notes) <= set(notes)
        assert notes[0].severity == "fatal"
        assert len(set(notes)) == len(notes)


def test_a_band_has_them(swapped):
    band = asperity.friction_band(ROAD, swapped, **POINT, samples=20)
    assert set(swapped.notes) <= set(band.notes)


def test_friction_takes_builds_and_fits_as_bands_do(swapped):
    fit = asperity.fit_self_affine(
        asperity.TabulatedSpectrum(
            wavenumber=np.geomspace(2e3, 2e4, 50), density=ROAD.at(np.geomspace(2e3, 2e4, 50))
        )
    )
    of_parts = asperity.friction(fit.spectrum, swapped.master_curve, **POINT)
    assert asperity.friction(fit, swapped, **POINT) == of_parts
    of_parts = asperity.contact_area(fit.spectrum, swapped.master_curve, **POINT)
    assert asperity.contact_area(fit, swapped, **POINT) == of_parts


def test_a_master_curve_that_was_written_and_read_again_has_them(tmp_path, swapped):
    rows = [
        (t.temperature, w, e1, e2)
        for t in sweeps(change=lambda _, e: e.imag + 1j * e.real)
        for w, e1, e2 in zip(t.angular_frequency, t.storage_modulus, t.loss_modulus, strict=True)
    ]
    text = "".join(",".join(map(repr, map(float, row))) + "\n" for row in rows)
    (tmp_path / "dma.csv").write_text("T,w,E1,E2\n" + text)
    command = ["rubber", f"{tmp_path}/dma.csv", "--output", f"{tmp_path}/master.csv"]
    command += ["--columns", "temperature=T,frequency=w,storage=E1,loss=E2", "--modulus", "E"]
    command += ["--units", "temperature=K,frequency=rad/s,modulus=Pa"]
    assert main([*command, "--reference-temperature", f"{T_REF}"]) == 0
    read = read_master_curve(tmp_path / "master.csv").notes
    assert {note.label for note in swapped.notes} <= {note.label for note in read}
    assert all(note.next_step for note in read if note.severity == "fatal")
