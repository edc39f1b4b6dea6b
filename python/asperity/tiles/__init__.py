"""Maps that do not fit in memory, read and transformed a tile at a time."""
