"""Scenes at temperatures, and with the heat of sliding: the same numbers as Python's, columns at
the end of the table, refusals in one line."""

import csv
import io

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.scene.scene import load_scene
from helpers import scenes
from helpers.rubbers import prony, tread
from helpers.scenes import HEATING, LAW, by_python

WLF = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
TREAD = tread()


def scene(temperature="temperature_k = 300", *, law=LAW, more=""):
    conditions = f"{scenes.CONDITIONS}\n{temperature}\n"
    return scenes.SURFACE + scenes.RUBBER + law + conditions + scenes.ADHESION + more


def written(text):
    with open("hot.toml", "w", encoding="utf-8") as file:
        file.write(text)
    return "hot.toml"


def rows(text, capsys):
    assert main(["friction", written(text)]) == 0
    out = capsys.readouterr().out
    lines = [line for line in out.splitlines() if not line.startswith("#")]
    return list(csv.DictReader(io.StringIO("\n".join(lines)))), out


def test_a_list_of_temperatures_is_a_block_of_rows_each(folder, capsys):
    result, out = rows(scene("temperature_c = [10, 26.85]"), capsys)
    assert list(result[0])[-1] == "temperature_k"
    assert "temperature_k [K]" in out
    assert "conditions.temperature_c = [10, 26.85]" in out
    for t, block in ((283.15, result[:10]), (300.0, result[10:])):
        one = load_scene(written(scene(f"temperature_k = {t}")))
        series = prony(2e6, [1e9, 1e8, 1e7], [1e-8, 1e-6, 1e-4])
        expected = by_python(one, rubber=series, temperature=t, shift=WLF)
        np.testing.assert_allclose([float(row["temperature_k"]) for row in block], t)
        np.testing.assert_allclose([float(row["mu"]) for row in block], expected.mu, rtol=1e-12)


def test_heat_adds_its_columns(folder, capsys):
    result, _ = rows(scene(more=HEATING), capsys)
    assert list(result[0])[-3:] == ["temperature_k", "hot_temperature_k", "mu_cold"]
    first = load_scene("hot.toml", for_friction=True)
    cold = first.built_rubber.at_reference
    expected = by_python(first, rubber=cold, temperature=300.0, shift=WLF, heating=TREAD)
    for name, column in (
        ("mu", expected.mu),
        ("hot_temperature_k", expected.temperature),
        ("mu_cold", expected.cold.mu),
    ):
        np.testing.assert_allclose([float(row[name]) for row in result], column, rtol=1e-9)


def test_conditions_and_rubber_may_both_be_the_place_of_one_temperature(folder):
    here = load_scene(written(scene("temperature_k = 300")))
    there = load_scene(written(scene("", law=LAW + "temperature_k = 300\n")))
    assert here.rubber == there.rubber
    assert here.temperature == 300
    assert there.temperature is None


def test_a_file_of_shift_factors_will_do(folder, capsys):
    t = np.linspace(270, 400, 40)
    lines = [f"{a},{b}" for a, b in zip(t, WLF.log10_a_T(t), strict=True)]
    (folder / "shift.csv").write_text("temperature_k,log10_a_t\n" + "\n".join(lines))
    law = '\nshift = "shift.csv"\nreference_temperature_k = 293.15\n'
    by_file, _ = rows(scene(law=law, more=HEATING), capsys)
    by_law, _ = rows(scene(more=HEATING), capsys)
    for one, other in zip(by_file, by_law, strict=True):
        assert float(one["mu"]) == pytest.approx(float(other["mu"]), rel=1e-3)


BOTH, WARM = "temperature_k = 300\ntemperature_c = 20", "temperature_k = 300\n"


@pytest.mark.parametrize(
    ("text", "argument"),
    [
        (scene(BOTH), "[conditions] temperature_c"),
        (scene(law=LAW + WARM), "[rubber] temperature_k"),
        (scene(law=""), "[conditions] temperature_k"),
        (scene(""), "[rubber] temperature_k"),
        (scene("temperature_k = 20"), "[conditions] temperature_k = 20"),
        (scene("temperature_k = 149.0"), "temperature_k = 149.0: must be finite and at least 150"),
        (scene(law=LAW.replace("wlf_c2_k = 101.6", "")), "[rubber] wlf_c2_k: missing"),
        (scene(law=LAW + 'shift = "a.csv"\n'), "[rubber] wlf_c1: must be left out"),
        (scene("", more=HEATING, law=""), "[heating]: needs [conditions]"),
        (scene(more=HEATING.replace("1200", "1.2")), "[heating] density_kg_m3 = 1.2"),
        (scene(more=HEATING + "width = 1\n"), "[heating] width: unknown key"),
        (scene(more=HEATING + '[solver]\nmethod = "qag"\n'), "[solver] method = qag"),
    ],
)
def test_refusals_name_the_field_in_one_line(folder, capsys, text, argument):
    assert main(["friction", written(text), "--output", "refused.csv"]) == 2
    told = capsys.readouterr().err.splitlines()
    assert len(told) == 1
    assert argument in told[0]
    assert not (folder / "refused.csv").exists()


def test_other_commands_refuse_heat_and_several_temperatures(folder, capsys):
    for text in (scene(more=HEATING), scene("temperature_k = [290, 300]")):
        assert main(["area", written(text)]) == 2
        assert "asperity friction and map alone" in capsys.readouterr().err
