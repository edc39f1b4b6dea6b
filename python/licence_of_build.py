"""Licence of what is built: a wheel contains GSL and FFTW, so that its licence is not the source's.

scikit-build-core asks this provider of dynamic metadata; both licences stand in pyproject.toml.
"""

from collections.abc import Mapping
from typing import Any


class LicenceOfBuild:
    """Says `source` in an sdist and `binary` in every wheel, editable ones among them."""

    def build_state(self, build_state: str) -> None:
        self._kind = "source" if build_state == "sdist" else "binary"

    def dynamic_metadata(
        self, settings: Mapping[str, Any], project: Mapping[str, Any]
    ) -> dict[str, str]:
        if settings.keys() != {"source", "binary"}:
            raise ValueError(
                f"licence_of_build has the settings {sorted(settings)}; it needs source and binary"
            )
        return {"license": settings[self._kind]}

    def dynamic_wheel(self, settings: Mapping[str, Any]) -> dict[str, bool]:
        """The sdist marks its licence as one that may differ in a wheel."""
        return {"license": True}
