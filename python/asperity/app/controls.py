"""Controls for the parameters of a value, as its declaration has them."""

from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from nicegui import ui

from asperity.app.parts import Quantity
from asperity.base.parameters import Parameter
from asperity.io.fields import Field

_FROM = 50.0  # ratio of a slider's ends above which it is logarithmic

Changed = Callable[[Any], Awaitable[None]]


def controls(
    fields: Mapping[str, Field], table: Mapping[str, Any], changes: Callable[[str], Changed]
) -> None:
    """A slider or a menu for each key whose parameter is declared to have one, and has a value.

    `table` is that of the scene; `changes` gives, for a key of it, what is called with its value.
    """
    for key, field in fields.items():
        value, one = table.get(key, field.default), field.declared
        if one is None or not one.usual or value is None:
            continue
        if one.choices:
            _menu(one, value, changes(key))
        else:
            _slider(one, value, changes(key))


def _menu(one: Parameter, value: Any, changed: Changed) -> None:
    async def chosen(event: Any) -> None:
        await changed(event.value)

    menu = ui.select(list(one.usual), value=value, label=_label(one), on_change=chosen)
    menu.props("dense outlined").classes("w-full")


def _slider(one: Parameter, value: float, changed: Changed) -> None:
    factor = 1.0
    if one.quantity is not None and one.shown_unit:
        factor, _ = one.quantity.units[one.shown_unit]
    low, high = (float(f"{end / factor:.12g}") for end in one.usual)

    async def shown(number: float) -> None:
        await changed(float(f"{number * factor:.12g}"))

    logarithmic = low > 0 and high / low > _FROM
    Quantity(_label(one), value / factor, (low, high), shown, logarithmic=logarithmic)


def _label(one: Parameter) -> str:
    """Its name with the unit of the slider: "Contact diameter [mm]"."""
    words = one.name.replace("_", " ")
    name = one.label or (words.capitalize() if len(words) > 2 else words)
    unit = (one.shown_unit or one.si_unit).replace("um", "µm")
    return f"{name} [{unit}]" if unit else name
