"""What each correction is worth, held against exact contact: elastic and sliding."""

from asperity.validation.sliding import SlidingContact, SlidingStep, slide

__all__ = ["SlidingContact", "SlidingStep", "slide"]
