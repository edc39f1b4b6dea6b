"""A report of scenes: one HTML file with pictures, tables, errors, and what they were made of."""
