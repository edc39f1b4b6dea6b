"""The code base as a subject: one-way dependencies, seams, stubs, versions, checkers."""

import ast
import graphlib
import importlib.util
import inspect
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from asperity import _core

ROOT = Path(__file__).parents[3]
HEADERS = sorted((ROOT / "cpp/include").rglob("*.hpp*"))
SOURCES = sorted((ROOT / "cpp/src").rglob("*.?pp"))
BINDINGS = sorted((ROOT / "python/bindings").rglob("*.?pp"))
PYTHON = sorted((ROOT / "python/asperity").rglob("*.py"))
# The order of the folders of cpp/src: each may include those before it.
CMAKE = (ROOT / "cpp/CMakeLists.txt").read_text(encoding="utf-8")
TOPICS = re.search(r"set\(ASPERITY_TOPICS ([^)]*)\)", CMAKE)[1].split()
# Public headers whose topic's folder has another name.
FOLDER_OF = {"asperities": "contact", "correction": "contact", "build_friction_map": "friction_map"}


def includes(path):
    text = path.read_text(encoding="utf-8")
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text, re.MULTILINE)


def stem(name):
    return Path(name).name.split(".")[0]


def rank(name):
    """Place of an included file, or of a file of the core, in the order of topics."""
    parts = Path(name).parts
    topic = Path(
        FOLDER_OF.get(stem(parts[-1]), stem(parts[-1])) if parts[0] == "asperity" else parts[0]
    )
    return TOPICS.index(str(topic)) if str(topic) in TOPICS else -1


def test_every_folder_of_the_core_has_its_place_in_the_order():
    assert {p.name for p in (ROOT / "cpp/src").iterdir() if p.is_dir()} == {*TOPICS}


@pytest.mark.parametrize("path", [*HEADERS, *SOURCES], ids=lambda p: p.name)
def test_includes_run_one_way(path):
    public = path in HEADERS
    own = path.relative_to(ROOT / ("cpp/include" if public else "cpp/src"))
    for name in includes(path):
        if not name.endswith((".hpp", ".inc", ".cpp")):
            continue
        assert not public or name.startswith("asperity/"), f"{own} includes {name}, not installed"
        assert rank(name) <= rank(own), f"{own} includes {name}, which stands behind it"


@pytest.mark.parametrize("path", HEADERS, ids=lambda p: p.name)
def test_public_headers_need_the_standard_library_alone(path):
    for name in includes(path):
        of_c = path.name == "friction_map.hpp" and name == "stddef.h"
        assert name.startswith("asperity/") or re.fullmatch(r"[a-z_]+", name) or of_c, name


SEAM_OF = {"gsl/": {"adaptive_quadrature.cpp"}, "fftw3": {"fft.cpp"}}


@pytest.mark.parametrize("path", [*HEADERS, *SOURCES], ids=lambda p: p.name)
def test_the_core_knows_neither_python_nor_libraries_outside_their_seams(path):
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"pybind11|Python\.h|\bPy[A-Z_]\w+\(|numpy/", text)
    for library, seam in SEAM_OF.items():
        if any(name.startswith(library) for name in includes(path)):
            assert path.name in seam, f"{path.name} knows {library}"
    if path.name not in {"adaptive_quadrature.cpp"}:
        assert not re.search(r"\bgsl_(?!solver)\w+", text), "GSL is called outside of its seam"
    if path.name not in {"fft.cpp"}:
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
    """Modules of the package that a file imports, at any depth of its code, but for the root."""
    known = {module_of(other) for other in PYTHON}
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}: relative import"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in (
            name.removeprefix("asperity.") for name in names if name.startswith("asperity.")
        ):
            parts = name.split(".")
            longest = [".".join(parts[:n]) for n in (3, 2, 1)]
            found.update([module for module in longest if module in known][:1])
    return found - {module_of(path)}


def test_python_imports_run_one_way():
    """No module, and no folder of modules, imports what imports it."""
    modules = {module_of(path): imported(path) for path in PYTHON}
    folders: dict[str, set[str]] = {}
    for name, used in modules.items():
        folders.setdefault(name.split(".")[0], set()).update(other.split(".")[0] for other in used)
    for graph in (modules, {k: used - {k} for k, used in folders.items()}):
        tuple(graphlib.TopologicalSorter(graph).static_order())  # or a CycleError that names them


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
