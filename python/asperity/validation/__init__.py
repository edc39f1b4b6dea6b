"""What each correction is worth: areas and elastic energies held against boundary elements."""
