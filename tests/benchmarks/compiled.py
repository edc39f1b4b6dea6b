"""C++ beside the benchmarks, compiled as a module of Python."""

import importlib.util
import subprocess
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]


def module(name: str, *flags: str, libraries: tuple[Path, ...] = ()) -> Any:
    """NAME.cpp in this folder, which defines the module NAME_timing."""
    import pybind11

    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder) / f"{name}_timing{sysconfig.get_config_var('EXT_SUFFIX')}"
        headers = (ROOT / "cpp/include", pybind11.get_include(), sysconfig.get_path("include"))
        command = ["c++", *flags, "-shared", "-fPIC", "-fvisibility=hidden"]
        command += [f"-I{path}" for path in headers]
        source = Path(__file__).with_name(f"{name}.cpp")
        subprocess.run([*command, source, *libraries, "-o", built], check=True)
        spec = importlib.util.spec_from_file_location(f"{name}_timing", built)
        if spec is None or spec.loader is None:
            raise SystemExit(f"{built}: cannot be loaded")
        loaded = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(loaded)
        return loaded
