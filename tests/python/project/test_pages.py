"""What the README and the pages of docs show works as it stands there."""

import contextlib
import io
import re
import shlex
import textwrap
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.cli.parser import parser
from asperity.scene.keys import KEYS
from asperity.scene.parts import CORRECTIONS
from asperity.scene.scene import load_scene
from helpers.examples import SWEEPS
from helpers.extensions import extension
from helpers.measured import present

ROOT = Path(__file__).parents[3]
README = (ROOT / "README.md").read_text(encoding="utf-8")
# docs/gallery and what else Sphinx writes is no page of ours
PAGES = {
    path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
    for path in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    if "gallery" not in path.parts
}

RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
ROAD = ROAD.truncated(q1=ROAD.cutoff_for_slope(1.3))


def blocks(page: str, language: str) -> list[str]:
    found = re.findall(rf"^ *```{language}\n(.*?)```", PAGES[page], re.DOTALL | re.MULTILINE)
    return [textwrap.dedent(block) for block in found]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The files that the pages speak of: a scan 0.64 mm wide in micrometres, DMA sweeps, a test."""
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
    test = asperity.friction(
        ROAD,
        RUBBER,
        pressure=81e3,
        velocity=np.geomspace(1e-6, 1e-2, 20),
        correction=asperity.NayakSFactor(),
        adhesion=asperity.Adhesion(shear_stress=8.3e6),
    )
    columns = np.column_stack([test.velocity, test.mu])
    np.savetxt("test.csv", columns, delimiter=",", header="velocity,mu")
    (tmp_path / "scene.toml").write_text(blocks("docs/reference/scene.md", "toml")[0])
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == 0
    assert main(["map", "scene.toml", "--output", "road.fmap", "--checked", "0"]) == 0
    return tmp_path


def names_before() -> dict[str, object]:
    """What a reader of a how-to has by then."""
    sweeps = asperity.read_isotherms(
        "dma.csv",
        columns={"frequency": "f", "temperature": "T", "storage": "G1", "loss": "G2"},
        units={"frequency": "Hz", "temperature": "C", "modulus": "MPa"},
        modulus="G",
    )
    build = asperity.build_master_curve(sweeps, reference_temperature=293.15)
    return {
        "asperity": asperity,
        "np": np,
        "road": ROAD,
        "rubber": asperity.fit_prony(build),
        "build": build,
        "adhesion": asperity.Adhesion(shear_stress=8.3e6),
        "sweeps": SWEEPS,
    }


SHOWN = [name for name in PAGES if blocks(name, "python") and name != "docs/tutorial.md"]


@pytest.mark.parametrize("page", SHOWN)
def test_python_runs(page: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    names = {} if page == "README.md" else names_before()
    for block in blocks(page, "python"):
        exec(block, names)
    if page == "README.md":
        result = names["result"]
        assert isinstance(result, asperity.Friction)
        assert np.all(result.error_estimate < 1e-6 * result.mu)
    elif page.endswith("read_your_instrument.md"):
        fit = names["fit"]
        assert isinstance(fit, asperity.SelfAffineFit)
        assert 0.6 < fit.hurst < 1
    elif page.endswith("temperature.md"):
        warm = names["warm"]
        assert isinstance(warm, asperity.PronySeries)
        exact = RUBBER.modulus(10 ** (-0.1 * 20) * 10.0)
        assert warm.modulus(10.0) == pytest.approx(exact, rel=0.02)
    elif page.endswith("adhesion.md"):
        adhesion = names["adhesion"]
        assert isinstance(adhesion, asperity.AdhesionFit)
        # by the hysteresis of the modulus that came out of the sweeps
        assert adhesion.shear_stress == pytest.approx(8.3e6, rel=0.02)


def test_the_tutorial_prints_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    shown = re.findall(
        r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", PAGES["docs/tutorial.md"], re.DOTALL
    )
    assert sum(bool(text) for _, text in shown) > 8
    for code, text in shown:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(code, names)
        assert printed.getvalue() == text, code
    (tutorial,) = blocks("docs/tutorial.md", "toml")
    (tmp_path / "tutorial.toml").write_text(tutorial, encoding="utf-8")
    mu = load_scene(tmp_path / "tutorial.toml").friction().mu
    result = names["result"]
    assert isinstance(result, asperity.Friction)
    # the tutorial takes the slope of the whole spectrum for its end, the scene that from q0 on
    assert mu[0, [0, -1]] == pytest.approx(result.mu[[0, -1]], rel=0.02)


@pytest.mark.parametrize("page", ["docs/howto/temperature.md", "docs/reference/scene.md"])
def test_a_hot_scene_runs_as_it_stands(page: str, folder: Path) -> None:
    (hot,) = [block for block in blocks(page, "toml") if "[heating]" in block]
    (folder / "hot.toml").write_text(hot, encoding="utf-8")
    curves = load_scene(folder / "hot.toml", for_friction=True).friction()
    assert curves.cold is not None
    assert np.all(curves.mu != curves.cold.mu)


def test_a_scene_with_isotherms_at_another_temperature(folder: Path) -> None:
    isotherms = blocks("docs/howto/temperature.md", "toml")[0]
    road = "[surface]\nrms_height_m = 1e-4\nhurst = 0.8\nq0_per_m = 2e3\nq1_per_m = 2e4\n"
    (folder / "warm.toml").write_text(road + isotherms, encoding="utf-8")
    scene = load_scene(folder / "warm.toml", for_friction=True)
    assert scene.temperature == pytest.approx(313.15)
    assert np.all(scene.friction().mu > 0)
    both = isotherms.replace("[rubber]\n", "[rubber]\ntemperature_c = 40\n")
    (folder / "both.toml").write_text(road + both, encoding="utf-8")
    with pytest.raises(asperity.InvalidInput, match="must be left out where"):
        load_scene(folder / "both.toml")


def test_beyond_the_isotherms_by_their_law(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = PAGES["docs/howto/temperature.md"]
    (command,) = [one for one in commands(page) if "tf_015p" in one]
    words = command.split()[1:]
    words[1] = str(present("dma", "material_a", "tf_015p.csv"))
    assert main([word for word in words if word != "\\"]) == 0
    told = capsys.readouterr().err.splitlines()
    (printed,) = re.findall(r"```text\n(reference.*?)```", page, re.DOTALL)
    assert set(printed.splitlines()) <= set(told)
    (scene,) = [block for block in blocks("docs/howto/temperature.md", "toml") if "60" in block]
    (folder / "warm.toml").write_text(scene, encoding="utf-8")
    assert np.all(load_scene(folder / "warm.toml", for_friction=True).friction().mu > 0)


def test_the_scene_of_the_readme_takes_files_of_ones_own(folder: Path) -> None:
    (scene,) = blocks("README.md", "toml")
    (folder / "own.toml").write_text(scene, encoding="utf-8")
    curves = load_scene(folder / "own.toml").friction()
    assert curves.mu.shape == (2, 31)
    assert np.all(curves.mu > 0)


def commands(text: str) -> list[str]:
    joined = text.replace("\\\n", " ")
    return [line.partition(" #")[0] for line in re.findall(r"^ {4}(asperity .*)$", joined, re.M)]


COMMANDS = sorted({line for text in PAGES.values() for line in commands(text)})


@pytest.mark.parametrize("line", COMMANDS)
def test_commands_are_taken_by_the_parser(line: str) -> None:
    parser().parse_args(shlex.split(line)[1:])


def test_the_page_of_scenes_has_the_tables_of_the_declarations() -> None:
    """python docs/_extensions/scene_tables.py writes them anew."""
    page = PAGES["docs/reference/scene.md"]
    assert page == extension("scene_tables").page(page)
    assert [key for table in KEYS.values() for key in table if f"`{key}`" not in page] == []
    kinds = PAGES["docs/howto/which_correction.md"]
    assert [kind for kind in CORRECTIONS if f"`{kind}`" not in kinds] == []


def test_the_reference_of_python_has_every_name() -> None:
    pages = " ".join(text for name, text in PAGES.items() if "reference/python" in name)
    named = set(re.findall(r":: ([\w.]+)", pages))
    public = set(asperity.__all__) - {"__version__", "validation"}
    assert public - named == set()
    inside = {f"asperity.validation.{name}" for name in asperity.validation.__all__}
    assert inside - named == set()


def test_the_reference_of_cpp_has_every_header() -> None:
    headers = {path.stem for path in (ROOT / "cpp/include/asperity").glob("*.hpp")}
    # what the others include, with nothing to call
    assert headers - {Path(n).stem for n in PAGES if "reference/cpp" in n} == {"export"}
    assert all(
        f"`asperity/{name}.hpp`" in PAGES["docs/reference/cpp/index.md"]
        for name in headers - {"export"}
    )


LINKS = [
    (name, link)
    for name, text in PAGES.items()
    for link in re.findall(
        r"\]\(([^)#:]+)(?:#[^)]*)?\)", re.sub(r"```.*?```", "", text, flags=re.S)
    )
]


def test_links_lead_somewhere() -> None:
    assert len(LINKS) > 40
    lost = [
        (name, link) for name, link in LINKS if not (ROOT / name).parent.joinpath(link).exists()
    ]
    assert lost == []
