"""Shift factors as other programs write them, and what `asperity rubber` writes."""

import re
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, prony_input, read_shift_factors
from asperity.cli.main import main
from asperity.io import plausible
from helpers.rubbers import prony

LIQUID = asperity.PronySeries(equilibrium_modulus=0, moduli=[1e6], relaxation_times=[1.0])
CELSIUS = np.array([60.0, 40, 20, 0, -20])
SHIFTS = np.array([-2.0, -1.25, 0, 2, 5.5])
RUBBER = prony(3e6, 10 ** np.linspace(6, 9, 8), 10 ** np.linspace(2, -8, 8))


@pytest.mark.parametrize(
    ("head", "kelvin", "shown"),
    [
        ("temperature_k,log10_a_t", 273.15, SHIFTS),
        ("T,log_aT\nC,-", 0, SHIFTS),
        ("\ufeffT, log_aT\nK, -", 273.15, SHIFTS),
        ("Temp,aT", 0, SHIFTS),
        ("Temp.,Shift", 0, SHIFTS),
        ("T [°C],ln(aT)", 0, SHIFTS * np.log(10)),
        ("Temperature (K),a_T", 273.15, 10**SHIFTS),
    ],
)
def test_names_and_units_of_other_programs(tmp_path, head, kelvin, shown):
    rows = [f"{t + kelvin},{a:.17g}" for t, a in zip(CELSIUS, shown, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]), encoding="utf-8")
    result = read_shift_factors(tmp_path / "a.csv", reference_temperature=293.15)
    np.testing.assert_allclose(result.temperature, CELSIUS[::-1] + 273.15, rtol=1e-12)
    np.testing.assert_allclose(result.log10_a_T, SHIFTS[::-1], atol=1e-12)


def test_a_table_of_another_reference_is_taken_relative_to_it(tmp_path):
    rows = [f"{t},{a}" for t, a in zip(CELSIUS, SHIFTS, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(["T,log_aT", "C,-", *rows]))
    with plausible.collected() as notes:
        result = read_shift_factors(tmp_path / "a.csv", reference_temperature=273.15)
    np.testing.assert_allclose(result.log10_a_T, SHIFTS[::-1] - 2, atol=1e-12)
    assert [note.code for note in notes] == ["shifts-relative"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("T,log_aT\n300,1\n310,0\n", "'T' is in K or C"),
        ("T,log_aT\nF,-\n300,1\n310,0\n", "'T' is in F: must be in K or C"),
        ("T,tan_delta\n300,1\n", "no line names the columns"),
    ],
)
def test_what_is_not_known_is_asked_for(tmp_path, text, message):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(InvalidInput, match=message):
        read_shift_factors(tmp_path / "a.csv", reference_temperature=300.0)


@pytest.fixture
def sweeps(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lines = ["f,T,E1,E2"]
    for celsius in range(0, 41, 10):
        for hertz in np.geomspace(0.1, 30, 12):
            e = RUBBER.modulus(2 * np.pi * hertz * 10 ** (-0.1 * (celsius - 20)))
            lines.append(f"{hertz},{celsius},{e.real / 1e6},{e.imag / 1e6}")
    Path("dma.csv").write_text("\n".join(lines))
    columns = ["--columns", "frequency=f,temperature=T,storage=E1,loss=E2"]
    units = ["--units", "frequency=Hz,temperature=C,modulus=MPa", "--modulus", "E"]
    return ["rubber", "dma.csv", *columns, *units]


def test_whatever_the_verb_writes_is_read_as_shifts(sweeps, capsys):
    assert main([*sweeps, "--output", "a.csv", "--write-shift", "b.csv"]) == 0
    assert main([*sweeps, "--output", "a.json", "--json"]) == 0
    for name in ("a.csv", "a.json"):  # as other programs save them again
        Path(f"16-{name}").write_text(Path(name).read_text("utf-8"), encoding="utf-16")
        Path(f"bom-{name}").write_text(Path(name).read_text("utf-8"), encoding="utf-8-sig")
    names = ["a.csv", "b.csv", "a.json", "16-a.csv", "16-a.json", "bom-a.csv", "bom-a.json"]
    read = [read_shift_factors(name, reference_temperature=293.15) for name in names]
    for one in read:
        np.testing.assert_allclose(one.log10_a_T, [2, 1, 0, -1, -2], atol=0.02)
        assert one == read[0]
        assert main([*sweeps, "--shift", "b.csv", "--output", "c.csv"]) == 0
    capsys.readouterr()
    assert main([*sweeps, "--output", "a.csv", "--write-shift", "a.csv"]) == 2
    assert "--output and --write-shift must be different files" in capsys.readouterr().err
    assert main([*sweeps, "--write-shift", "d.csv", "--write-prony", "d.csv"]) == 2
    assert "--write-shift and --write-prony must be different files" in capsys.readouterr().err


def modulus(instantaneous, pairs, w):
    """E(w) from relative moduli, by definition."""
    relaxed = sum(g / (1 + 1j * w * tau) for g, tau in pairs)
    return instantaneous * (1 - relaxed)


def test_prony_terms_are_written_for_other_programs(sweeps):
    for name, ratio in (("p.csv", "0.5"), ("p.inp", "0.49"), ("p.mac", "0.49")):
        output = ["--output", "a.csv", "--write-prony", name]
        assert main([*sweeps, *output, "--poisson-ratio", ratio]) == 0
    rows = [
        line.split(",")
        for line in Path("p.csv").read_text().splitlines()
        if line[0] in "0123456789"
    ]
    series = [(float(e), float(tau)) for tau, e in rows]
    (relaxed,) = re.findall(r"# equilibrium_modulus_pa = (\S+)", Path("p.csv").read_text())
    whole = float(relaxed) + sum(e for e, _ in series)
    lines = Path("p.inp").read_text().splitlines()
    assert lines[1] == "*Material, name=RUBBER"
    assert lines[2] == "*Elastic, moduli=INSTANTANEOUS"
    assert lines[4] == "*Viscoelastic, time=PRONY"
    instantaneous, ratio = map(float, lines[3].split(","))
    terms = [tuple(map(float, line.split(","))) for line in lines[5:]]
    assert ratio == 0.49
    assert all(g == k for g, k, _ in terms)
    ansys = Path("p.mac").read_text()
    (shear,) = re.findall(rf"TB,PRONY,1,1,{len(series)},SHEAR\n(.*)TB,PRONY,1,1", ansys, re.DOTALL)
    data = [cell for line in shear.splitlines() for cell in line.split(",")[2:]]
    assert max(line.count(",") for line in shear.splitlines()) <= 7  # six numbers a line
    pairs = list(zip(map(float, data[::2]), map(float, data[1::2]), strict=True))
    for w in (1e-2, 1e2, 1e6):
        direct = complex(float(relaxed)) + sum(e * 1j * w * t / (1 + 1j * w * t) for e, t in series)
        for result in (
            modulus(instantaneous, [(g, tau) for g, _, tau in terms], w),
            modulus(whole, pairs, w),
        ):
            np.testing.assert_allclose(result, direct, rtol=1e-6)


@pytest.mark.parametrize(
    ("series", "program", "ratio", "argument"),
    [
        (RUBBER, "nastran", 0.5, "program"),
        (RUBBER, "ansys", 0.5, "poisson_ratio"),
        (RUBBER, "abaqus", 0.6, "poisson_ratio"),
        (LIQUID, "abaqus", 0.5, "series"),
    ],
)
def test_what_a_program_cannot_take(series, program, ratio, argument):
    with pytest.raises(InvalidInput) as caught:
        prony_input(series, program, poisson_ratio=ratio)
    assert caught.value.argument == argument
