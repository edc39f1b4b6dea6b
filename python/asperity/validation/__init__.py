"""Exact sliding contact, which the theory is held against."""

from asperity.validation.sliding import SlidingContact, SlidingStep, slide

__all__ = ["SlidingContact", "SlidingStep", "slide"]
