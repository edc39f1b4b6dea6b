"""The code base as a subject: one-way dependencies, seams and thin bindings."""

import ast
import graphlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from helpers.cases import case

ROOT = Path(__file__).parents[3]
HEADERS = sorted((ROOT / "cpp/include").rglob("*.hpp*"))
SOURCES = sorted((ROOT / "cpp/src").rglob("*.?pp"))
BINDINGS = sorted((ROOT / "python/bindings").rglob("*.?pp"))
PYTHON = sorted((ROOT / "python/asperity").rglob("*.py"))
# The order of the folders of cpp/src: each may include those before it.
CMAKE = (ROOT / "cpp/CMakeLists.txt").read_text(encoding="utf-8")
TOPICS = re.search(r"set\(ASPERITY_TOPICS ([^)]*)\)", CMAKE)[1].split()
# Public headers whose topic's folder has another name.
FOLDER_OF = {
    "asperities": "contact",
    "correction": "contact",
    "gradients": "friction",
    "heating": "heat",
    "scan_contact": "sliding",
    "contact_progress": "sliding",
    "tiles": "spectrum",
    "build_friction_map": "friction_map",
}


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


def test_includes_run_one_way():
    for path in [*HEADERS, *SOURCES]:
        with case(file=path.name):
            public = path in HEADERS
            own = path.relative_to(ROOT / ("cpp/include" if public else "cpp/src"))
            for name in includes(path):
                if not name.endswith((".hpp", ".inc", ".cpp")):
                    continue
                assert not public or name.startswith("asperity/"), (
                    f"{own} includes {name}, not installed"
                )
                assert rank(name) <= rank(own), f"{own} includes {name}, which stands behind it"


def test_public_headers_need_the_standard_library_alone():
    for path in HEADERS:
        with case(file=path.name):
            for name in includes(path):
                of_c = path.name == "friction_map.hpp" and name == "stddef.h"
                assert name.startswith("asperity/") or re.fullmatch(r"[a-z_]+", name) or of_c, name


# a library: how its header begins, its functions, and the files that may know it
SEAMS = {
    "GSL": (r"gsl/", r"\bgsl_(?!solver|quadrature\b)\w+", "gsl_quadrature.cpp"),
    "FFTW": (r"fftw3", r"\bfftwf?_\w+", "fft_fftw.cpp"),
    "pocketfft": (r"pocketfft_", r"\bpocketfft::", "pocketfft_loops.inc"),
}


def test_the_core_knows_neither_python_nor_libraries_outside_their_seams():
    for path in [*HEADERS, *SOURCES]:
        with case(file=path.name):
            text = path.read_text(encoding="utf-8")
            assert not re.search(r"pybind11|Python\.h|\bPy[A-Z_]\w+\(|numpy/", text)
            for library, (header, function, seam) in SEAMS.items():
                if path.name == seam:
                    assert any(name.startswith(header) for name in includes(path))
                    continue
                assert not any(name.startswith(header) for name in includes(path)), library
                assert not re.search(function, text), f"{library} is called outside of its seam"


def test_bindings_use_public_headers_only():
    for path in BINDINGS:
        with case(file=path.name):
            mine = {other.name for other in BINDINGS}
            for name in includes(path):
                if name.endswith((".hpp", ".cpp")):
                    assert name in mine or name.startswith("asperity/"), (
                        f"{path.name} includes {name}"
                    )


def module_of(path):
    """Name of a module inside the package: `demo/__init__.py` is `demo`."""
    relative = path.relative_to(ROOT / "python/asperity").with_suffix("")
    return ".".join(relative.parts).removesuffix(".__init__")


def imported(path):
    """Modules of the package that a file imports, at any depth of its code, but for the root."""
    known = {module_of(other) for other in PYTHON}
    result = set()
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
            result.update([module for module in longest if module in known][:1])
    return result - {module_of(path)}


def test_python_imports_run_one_way():
    """No module, and no folder of modules, imports what imports it."""
    modules = {module_of(path): imported(path) for path in PYTHON}
    folders: dict[str, set[str]] = {}
    for name, used in modules.items():
        folders.setdefault(name.split(".")[0], set()).update(other.split(".")[0] for other in used)
    for graph in (modules, {k: used - {k} for k, used in folders.items()}):
        tuple(graphlib.TopologicalSorter(graph).static_order())  # or a CycleError that names them


def test_the_library_needs_none_of_its_scripts():
    """The verbs that run them import them when they are asked for."""
    for path in PYTHON:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"^\s*(from|import) asperity_scripts", text, re.MULTILINE), path.name


def test_numpy_is_all_that_the_package_imports_at_once():
    code = "import sys, asperity; print(*{m.partition('.')[0] for m in sys.modules})"
    run = [sys.executable, "-c", code]
    loaded = subprocess.run(run, check=True, capture_output=True, text=True).stdout.split()
    assert "numpy" in loaded
    others = {"matplotlib", "mpmath", "pandas", "scipy", "SurfaceTopography", "tamaas", "tqdm"}
    assert not (others | {"xarray"}) & set(loaded)


def lines(paths):
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)


def test_bindings_are_thin():
    """Names of arguments, defaults and docstrings are in Python."""
    assert BINDINGS
    for path in BINDINGS:
        text = path.read_text(encoding="utf-8")
        result = re.findall(r"py::arg|py::kw_only|py::doc|_a\b|R\"", text)
        assert not result, f"{path.name}: {result}"
        docstrings = re.findall(r'\.def\w*\(\s*"\w+",[^;]*?,\s*"[^"]*"\s*\)', text)
        assert not docstrings, f"{path.name}: {docstrings}"
    assert lines(BINDINGS) <= 0.2 * lines([*HEADERS, *SOURCES])


def test_no_test_imports_another():
    tests = sorted((ROOT / "tests/python").rglob("*.py"))
    names = {path.stem for path in tests if path.stem.startswith("test_")} | {"conftest"}
    assert len(names) > 50
    for path in tests:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            result = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            result += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            for module in result:
                assert not names & set(module.split(".")), f"{path.name} imports {module}"


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
