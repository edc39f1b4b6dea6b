"""Friction maps as Functional Mock-up Units, for tire and vehicle simulators."""

from asperity.fmu.export import export_fmu

__all__ = ["export_fmu"]
