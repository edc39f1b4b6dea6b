"""Bands on mu from what the inputs are uncertain by."""
