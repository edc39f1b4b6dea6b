"""Objects of the rows of reference tables, and how near a number must come to a row."""

from math import radians

from asperity import MasterCurve, PronySeries, SelfAffineSpectrum, TabulatedSpectrum


def self_affine(row):
    names = ("rms_height", "hurst", "q0", "q1", "rolloff", "axis_ratio", "lay_deg")
    given = {name: row[name] for name in names if row.get(name) is not None}
    if "lay_deg" in given:
        given["lay"] = radians(given.pop("lay_deg"))
    return SelfAffineSpectrum(**given)


def tabulated(row):
    return TabulatedSpectrum(wavenumber=row["table_wavenumber"], density=row["table_density"])


def prony(row):
    names = ("equilibrium_modulus", "moduli", "relaxation_times")
    return PronySeries(**{name: row[name] for name in names})


def master_curve(row):
    return MasterCurve(
        angular_frequency=row["table_frequency"],
        storage_modulus=row["table_storage"],
        loss_modulus=row["table_loss"],
        extrapolation=row.get("extrapolation") or None,
    )


def rubber(row):
    """A Prony series, or the master curve where the row has a table."""
    return master_curve(row) if row["table_frequency"].size else prony(row)


def close(row, names, result, scale=None):
    """Every found number within the row's tolerance of its column, relative unless scaled."""
    for name, value in zip(names, result, strict=True):
        expected = row[name]
        allowed = row["rtol"] * (abs(expected) if scale is None else scale)
        assert abs(value - expected) <= allowed, (name, value, expected, abs(value - expected))
