"""Temperatures in degrees Celsius beside those in K."""

ZERO_CELSIUS = 273.15  # [K]


def temperature_text(kelvin: float, *, celsius: bool) -> str:
    """A temperature as pictures and notes tell it."""
    return f"{kelvin - ZERO_CELSIUS:.4g} °C" if celsius else f"{kelvin:.5g} K"
