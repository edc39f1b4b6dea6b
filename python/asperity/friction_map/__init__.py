"""Friction maps for simulators."""
