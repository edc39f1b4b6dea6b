"""Licence of what is built: a wheel contains GSL and FFTW, so that its licence is not the source's.

This module is the build backend, which is scikit-build-core with its settings remembered, and the
provider of dynamic metadata that scikit-build-core asks for the licence. The licences stand in
pyproject.toml.
"""

import functools
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from scikit_build_core import build as backend
from scikit_build_core.build import *  # noqa: F403
from scikit_build_core.settings.skbuild_read_settings import SettingsReader

_ROOT = Path(__file__).parents[1]
# the licence texts of what a build does not contain
_NOT_IN = {"source": [], "binary": ["BSD-3-Clause-pocketfft"], "permissive": ["GPL-3.0-or-later"]}

_settings: Mapping[str, Any] = {}


def _remembering(hook: Callable[..., str]) -> Callable[..., str]:
    @functools.wraps(hook)
    def remembered(
        folder: str, config_settings: Mapping[str, Any] | None = None, *rest: Any, **named: Any
    ) -> str:
        global _settings
        _settings = config_settings or {}
        return hook(folder, config_settings, *rest, **named)

    return remembered


build_wheel = _remembering(backend.build_wheel)
build_editable = _remembering(backend.build_editable)
prepare_metadata_for_build_wheel = _remembering(backend.prepare_metadata_for_build_wheel)
prepare_metadata_for_build_editable = _remembering(backend.prepare_metadata_for_build_editable)


def _is_permissive() -> bool:
    """Whether ASPERITY_PERMISSIVE is on by these settings, pyproject.toml or the environment."""
    reader = SettingsReader.from_file(_ROOT / "pyproject.toml", dict(_settings))
    value = reader.settings.cmake.define.get("ASPERITY_PERMISSIVE", "OFF")
    return str(value).upper() in {"ON", "TRUE", "YES", "Y", "1"}


class LicenceOfBuild:
    """Says `source` in an sdist, `permissive` in a wheel without GSL and FFTW, else `binary`."""

    def build_state(self, build_state: str) -> None:
        self._is_source = build_state == "sdist"

    def dynamic_metadata(
        self, settings: Mapping[str, Any], project: Mapping[str, Any]
    ) -> dict[str, Any]:
        if settings.keys() != _NOT_IN.keys():
            raise ValueError(
                f"licence_of_build has the settings {sorted(settings)}; it needs source, binary "
                "and permissive"
            )
        kind = "source" if self._is_source else "permissive" if _is_permissive() else "binary"
        # for python/CMakeLists.txt, which knows what is really built
        os.environ["ASPERITY_LICENCE_OF_BUILD"] = kind
        texts = sorted((_ROOT / "LICENSES").glob("*.txt"))
        shipped = [f"LICENSES/{path.name}" for path in texts if path.stem not in _NOT_IN[kind]]
        return {"license": settings[kind], "license-files": ["LICENSE", "NOTICE", *shipped]}

    def dynamic_wheel(self, settings: Mapping[str, Any]) -> dict[str, bool]:
        """The sdist marks its licence as one that may differ in a wheel."""
        return {"license": True, "license-files": True}
