"""The code base as a subject: one-way dependencies, seams, stubs, versions, checkers."""

import ast
import importlib.util
import inspect
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from asperity import _core

ROOT = Path(__file__).parents[2]
HEADERS = sorted((ROOT / "cpp/include").rglob("*.hpp*"))
SOURCES = sorted([*(ROOT / "cpp/src").glob("*.?pp")])
BINDINGS = sorted((ROOT / "python/bindings").glob("*.?pp"))
PYTHON = sorted((ROOT / "python/asperity").rglob("*.py"))

# A topic may include itself and what stands here for it (STYLE part C).
MAY_INCLUDE = {
    "errors": set(),
    "surface": {"errors"},
    "rubber": {"errors"},
    "asperities": {"errors"},
}
MAY_INCLUDE["spectrum"] = {"errors", "surface"}
MAY_INCLUDE["dma"] = {"errors", "rubber"}
MAY_INCLUDE["correction"] = {*MAY_INCLUDE}
MAY_INCLUDE["contact"] = {*MAY_INCLUDE}
MAY_INCLUDE["friction"] = {*MAY_INCLUDE}
MAY_INCLUDE["version"] = set()
MAY_INCLUDE["friction_map"] = set()
MAY_INCLUDE["build_friction_map"] = {*MAY_INCLUDE}
EVERYWHERE = {"export"}
# Files of cpp/src by topic; a file of the topic's own name needs no entry.
TOPIC = {
    "dropouts": "surface",
    "peaks": "surface",
    "trend": "surface",
    "surface_rows": "surface",
    "abel": "spectrum",
    "autocorrelation": "spectrum",
    "fit_self_affine": "spectrum",
    "line_scan": "surface",
    "line_spectrum": "spectrum",
    "log_bins": "spectrum",
    "mode_columns": "spectrum",
    "power_spectrum": "spectrum",
    "preparation": "spectrum",
    "reliability": "spectrum",
    "spectral_density": "spectrum",
    "tabulated_spectrum": "spectrum",
    "segments": "spectrum",
    "synthesize": "spectrum",
    "window": "spectrum",
    "angular_sums": "rubber",
    "angular_table": "rubber",
    "modulus_piece": "rubber",
    "macro_modulus": "correction",
    "map_batch": "build_friction_map",
    "map_builder": "build_friction_map",
    "map_file": "build_friction_map",
    "map_frame": "build_friction_map",
    "map_tree": "build_friction_map",
    "master_curve": "rubber",
    "at_strain": "dma",
    "build_master_curve": "dma",
    "fit_prony": "dma",
    "isotherm": "dma",
    "isotherm_shifts": "dma",
    "master_spline": "dma",
    "shift_table": "dma",
    "prony": "rubber",
    "adhesion_curve": "friction",
    "contact_checks": "contact",
    "partial_contact": "contact",
    "fit_adhesion": "friction",
    "front_integral": "contact",
    "gauss_panels": "contact",
    "gaussian_moment": "asperities",
    "gauss_path": "contact",
    "hysteresis_error": "contact",
    "kernels": "rubber",
    "panel_error": "contact",
    "persson": "contact",
    "solver": "contact",
    "notes": "contact",
}
SEAMS = {
    "checks",
    "integrate",
    "fourier",
    "hermite",
    "interpolate",
    "legendre",
    "minimum",
    "nnls",
    "overloaded",
    "pair",
    "roots",
    "threads",
}
# Modules of the Python package, from the lowest to the highest: an import points down.
LAYERS = ["_core", "kinds", "fields", "table", "directory", "instrument", "read"]
LAYERS += ["read_rubber", "read_dma", "read_friction", "scan", "draws", "uncertainty"]
LAYERS += ["__init__", "demo", "surface", "parts", "rubber", "scene", "plot"]
LAYERS += ["plot_surface", "plot_rubber", "plot_map", "experiment", "plot_fit", "commands"]
LAYERS += ["rubber_command", "fit_command", "map_command", "validation.boundary_elements"]
LAYERS += ["validation.contacts", "validation.predictions", "validation.figures"]
LAYERS += ["validation.summary", "validation.own", "validation.command", "validation"]
LAYERS += ["article", "article.compounds", "article.readings", "article.statement"]
LAYERS += ["article.inputs", "article.page", "article.peaks", "article.surfaces"]
LAYERS += ["article.theory", "article.separation", "article.asperities", "article.factors"]
LAYERS += ["article.tuning", "article.sliding", "article.summary", "article.command"]
LAYERS += ["options", "verbs", "cli", "__main__"]


def includes(path):
    text = path.read_text(encoding="utf-8")
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text, re.MULTILINE)


def stem(name):
    return Path(name).name.split(".")[0]


@pytest.mark.parametrize("path", [*HEADERS, *SOURCES], ids=lambda p: p.name)
def test_includes_run_one_way(path):
    public, own = path in HEADERS, stem(path.name)
    topic = own if public else TOPIC.get(own, own)
    if own == "export":
        assert [name for name in includes(path) if "." in name] == []
        return
    if not public and own in SEAMS:
        allowed = {"errors", *SEAMS}
    else:
        assert topic in MAY_INCLUDE, f"{path.name}: of which topic? Enter it in TOPIC or SEAMS"
        allowed = MAY_INCLUDE[topic] | {topic} | EVERYWHERE
        if not public:
            allowed |= SEAMS
    for name in includes(path):
        if name.startswith("asperity/"):
            assert stem(name) in allowed, f"{path.name} includes {name}"
        elif name.endswith((".hpp", ".cpp")):
            assert not public, f"{path.name} includes {name}, which is not installed"
            below = TOPIC.get(stem(name), stem(name))
            assert below in allowed, f"{path.name} includes {name}"


@pytest.mark.parametrize("path", HEADERS, ids=lambda p: p.name)
def test_public_headers_need_the_standard_library_alone(path):
    for name in includes(path):
        of_c = path.name == "friction_map.hpp" and name == "stddef.h"
        assert name.startswith("asperity/") or re.fullmatch(r"[a-z_]+", name) or of_c, name


SEAM_OF = {"gsl/": {"integrate.cpp"}, "fftw3": {"fourier.cpp"}}


@pytest.mark.parametrize("path", [*HEADERS, *SOURCES], ids=lambda p: p.name)
def test_the_core_knows_neither_python_nor_libraries_outside_their_seams(path):
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"pybind11|Python\.h|\bPy[A-Z_]\w+\(|numpy/", text)
    for library, seam in SEAM_OF.items():
        if any(name.startswith(library) for name in includes(path)):
            assert path.name in seam, f"{path.name} knows {library}"
    if path.name not in {"integrate.cpp"}:
        assert not re.search(r"\bgsl_\w+", text), "GSL is called outside of its seam"
    if path.name not in {"fourier.cpp"}:
        assert not re.search(r"\bfftwf?_\w+", text), "FFTW is called outside of its seam"


@pytest.mark.parametrize("path", BINDINGS, ids=lambda p: p.name)
def test_bindings_use_public_headers_only(path):
    mine = {other.name for other in BINDINGS}
    for name in includes(path):
        if name.endswith((".hpp", ".cpp")):
            assert name in mine or name.startswith("asperity/"), f"{path.name} includes {name}"


def module_of(path):
    """Name of a module inside the package: `demo/__init__.py` is `demo`."""
    relative = path.relative_to(ROOT / "python/asperity").with_suffix("")
    return ".".join(relative.parts).removesuffix(".__init__")


def imported(path):
    """Modules of the package that a file imports, at any depth of its code."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}: relative import"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            parts = name.split(".")
            if parts[0] == "asperity":
                inner = (".".join(parts[1:3]), *parts[1:2], "__init__")
                found.add(next(layer for layer in inner if layer in LAYERS))
    return found


@pytest.mark.parametrize("path", PYTHON, ids=lambda p: str(p.relative_to(ROOT / "python")))
def test_python_imports_run_one_way(path):
    own = module_of(path)
    assert own in LAYERS, f"{own}: where in LAYERS does it stand?"
    for name in imported(path) - {own}:
        assert LAYERS.index(name) < LAYERS.index(own), f"{own} imports {name}"
        assert name != "cli" or own == "__main__"


def test_numpy_is_all_that_the_package_imports_at_once():
    code = "import sys, asperity; print(*{m.partition('.')[0] for m in sys.modules})"
    run = [sys.executable, "-c", code]
    loaded = subprocess.run(run, check=True, capture_output=True, text=True).stdout.split()
    assert "numpy" in loaded
    assert not {"matplotlib", "scipy", "SurfaceTopography", "tqdm", "tamaas"} & set(loaded)


STUB = ast.parse((ROOT / "python/asperity/_core.pyi").read_text(encoding="utf-8"))


def signature(function):
    """Parameter names, keyword-only names and how many have a default, of a `def`."""
    a = function.args
    positional = [x.arg for x in (*a.posonlyargs, *a.args) if x.arg != "self"]
    optional = {x.arg for x in a.args[len(a.args) - len(a.defaults) :]}
    optional |= {x.arg for x, d in zip(a.kwonlyargs, a.kw_defaults, strict=True) if d is not None}
    return positional, [x.arg for x in a.kwonlyargs], optional


def bound(function):
    """The same of a bound function, from the signature that pybind11 writes."""
    line = inspect.getdoc(function).splitlines()[0]
    line = re.sub(r"<[^<>]*>", "None", line)
    return signature(ast.parse(f"def {line}: ...").body[0])


def test_the_stub_has_every_public_name_and_no_other():
    stubbed = {node.name for node in STUB.body if isinstance(node, ast.ClassDef | ast.FunctionDef)}
    real = {name for name in vars(_core) if not name.startswith("_")}
    assert stubbed == real


@pytest.mark.parametrize(
    "node", [n for n in STUB.body if isinstance(n, ast.FunctionDef)], ids=lambda n: n.name
)
def test_the_stub_has_the_arguments_of_every_function(node):
    assert signature(node) == bound(getattr(_core, node.name))


@pytest.mark.parametrize(
    "node",
    [
        n
        for n in STUB.body
        if isinstance(n, ast.ClassDef) and not n.name.endswith(("Error", "Input"))
    ],
    ids=lambda n: n.name,
)
def test_the_stub_has_the_members_and_arguments_of_every_class(node):
    cls = getattr(_core, node.name)
    if issubclass(cls, Exception):
        assert [base.id for base in node.bases] == [base.__name__ for base in cls.__bases__]
        return
    members = {n.name: n for n in node.body if isinstance(n, ast.FunctionDef)}
    assert set(members) - {"__init__"} == {n for n in vars(cls) if not n.startswith("_")}
    for name, member in members.items():
        decorators = {d.id for d in member.decorator_list}
        assert ("property" in decorators) == isinstance(vars(cls).get(name), property)
        if "property" not in decorators:
            assert signature(member) == bound(getattr(cls, name)), name


CHECKS = {
    "ruff": ["check", "--no-cache", "."],
    "ruff format": ["--check", "--no-cache", "."],
    "mypy": ["--strict", "--no-incremental"],
}


@pytest.mark.parametrize("name", CHECKS)
def test_checkers_have_nothing_to_say(name):
    tool = name.split()
    if importlib.util.find_spec(tool[0]) is None:
        pytest.skip(f"{tool[0]} is not installed")
    run = [sys.executable, "-m", *tool, *CHECKS[name]]
    done = subprocess.run(run, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_tracked_file_knows_the_machine_it_was_written_on():
    git = shutil.which("git")
    if git is None or not (ROOT / ".git").exists():
        pytest.skip("not a git repository")
    listed = subprocess.run([git, "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True)
    places = [f"/{name}/" for name in ("home", "Users", "root", "work", "tmp/dev")]
    guilty = []
    for name in filter(None, listed.stdout.decode().split("\0")):
        path = ROOT / name
        if path.is_file():
            text = path.read_bytes().decode("utf-8", errors="replace")
            guilty += [f"{name}: {place}" for place in places if place in text]
    assert guilty == []
