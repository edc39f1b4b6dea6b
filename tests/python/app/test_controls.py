"""The page offers what the declarations of parameters say."""

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from typing import Any

import pytest

from asperity.scene.parts import ADHESION, CORRECTIONS, HEATING
from asperity.scene.surface import SURFACE

nicegui = pytest.importorskip("nicegui", reason="the app needs asperity[app]")

from nicegui.element import Element  # noqa: E402
from nicegui.page import page  # noqa: E402

from asperity.app import parts as controls_module  # noqa: E402
from asperity.app.parts import controls  # noqa: E402

GREENWOOD = CORRECTIONS["greenwood-williamson"]
CASES = {
    "heating": (HEATING, {"conductivity_w_m_k": 0.23, "contact_diameter_m": 1e-3}),
    "adhesion": (ADHESION, {"shear_stress_pa": 8e6}),
    "law": (SURFACE, {"rms_height_m": 1e-4, "hurst": 0.8, "q0_per_m": 1e3, "q1_per_m": 1e6}),
    "greenwood-williamson": (GREENWOOD, {"min_distance_m": 1e-4, "q0_per_m": 1e3}),
    "listed peaks": (GREENWOOD, {"heights_m": [1e-4, 2e-4, 3e-4], "q0_per_m": 1e3}),
    **{kind: (CORRECTIONS[kind], {}) for kind in ("s-factor", "scan-contact", "partial-contact")},
}
LABELS = {
    "heating": ["Conductivity [W/(m K)]", "Contact diameter [mm]"],
    "adhesion": ["Shear stress [MPa]", "Reference velocity [mm/s]", "Width"],
    "law": [
        "Rms height [µm]",
        "Hurst exponent H",
        "Ridges, long to wide",
        "Direction of the ridges [°]",
        "q0 [1/m]",
    ],
    "greenwood-williamson": ["q0 of macro-asperities [1/m]", "Least distance of peaks [µm]"],
    "listed peaks": ["q0 of macro-asperities [1/m]"],
    "s-factor": ["Gamma", "Applies to"],
    "scan-contact": ["Tolerance"],
    "partial-contact": [],
}


def shown(
    fields: Mapping[str, Any],
    table: Mapping[str, Any],
    changes: Callable[[str], Callable[[Any], Awaitable[None]]],
) -> list[Element]:
    """The elements of the page, made as a request of a browser would make them."""

    async def make() -> list[Element]:
        nicegui.core.loop = asyncio.get_running_loop()
        with nicegui.Client(page("/controls")), nicegui.ui.element("div") as box:
            controls(fields, table, changes)
        return [*box.descendants()]

    return asyncio.run(make())


@pytest.mark.parametrize("case", CASES)
def test_what_is_declared_is_offered_in_its_unit(case: str) -> None:
    fields, table = CASES[case]
    named = [one for one in shown(fields, table, lambda key: None) if "label" in one.props]
    assert [one.props["label"] for one in named] == LABELS[case]


def test_a_slider_is_logarithmic_over_decades_and_sets_si_units(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    changed: dict[str, Any] = {}
    sliders: dict[str, tuple[Any, ...]] = {}

    def slider(name: str, value: float, ends: Any, change: Any, *, logarithmic: bool) -> None:
        sliders[name] = value, ends, logarithmic
        asyncio.run(change(2 * value))

    def changes(key: str) -> Callable[[Any], Awaitable[None]]:
        async def change(value: Any) -> None:
            changed[key] = value

        return change

    monkeypatch.setattr(controls_module, "Quantity", slider)
    controls(ADHESION, {"shear_stress_pa": 8.3e6}, changes)
    assert sliders["Shear stress [MPa]"] == (8.3, (0.01, 100.0), True)
    assert sliders["Reference velocity [mm/s]"] == (6.0, (0.001, 1000.0), True)
    assert changed["shear_stress_pa"] == 16.6e6
    controls(HEATING, {"conductivity_w_m_k": 0.23}, changes)
    assert sliders["Conductivity [W/(m K)]"] == (0.23, (0.05, 2.0), False)
