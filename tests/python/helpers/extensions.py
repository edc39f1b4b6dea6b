"""Modules of the documentation's extensions, which are no package."""

import importlib.util
from pathlib import Path
from types import ModuleType


def extension(name: str) -> ModuleType:
    """The module of a file of docs/_extensions."""
    code = Path(__file__).parents[3] / f"docs/_extensions/{name}.py"
    spec = importlib.util.spec_from_file_location(name, code)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
