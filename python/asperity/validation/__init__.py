"""What each correction is worth, held against exact contact: elastic and sliding."""

from asperity.validation.sliding import SlidingContact, slide

__all__ = ["SlidingContact", "slide"]
