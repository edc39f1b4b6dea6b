"""Shared helpers of the reference scripts: table writing, Prony modulus, agreement tests."""

import csv
from pathlib import Path

import mpmath

HERE = Path(__file__).resolve().parent
WORST = {}


def cell(value):
    """Return `value` as text: the shortest one (at most 17 digits) that reads back exactly.

    Lists are joined by ';', None is empty.
    """
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)):
        return ";".join(cell(item) for item in value)
    return repr(float(value))


def write(name, comments, rows):
    """Write rows (dicts with equal keys, `case` first and `rtol` last) to <name>.csv."""
    header = list(rows[0])
    assert (header[0], header[-1]) == ("case", "rtol")
    assert all(list(row) == header for row in rows)
    assert len({row["case"] for row in rows}) == len(rows)
    with open(HERE / f"{name}.csv", "w", newline="", encoding="ascii") as file:
        file.writelines(f"# {line}\n" for line in comments)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([cell(value) for value in row.values()] for row in rows)
    print(f"{name}: {len(rows)} rows, worst disagreement {float(WORST.get(name, 0)):.1e}")


def table_columns(table):
    """Return the columns of a tabulated modulus, empty where there is none."""
    names = ("table_frequency", "table_storage", "table_loss")
    return dict(zip(names, table or (None, None, None), strict=True))


def agree(name, first, second, bound, scale=None):
    """Assert |first - second| <= bound * scale and remember the worst ratio.

    The default scale is the smaller of the two magnitudes.
    """
    if first == second:
        return
    scale = min(abs(first), abs(second)) if scale is None else abs(scale)
    error = abs(first - second) / scale if scale else mpmath.inf
    assert error <= bound, (name, float(first), float(second), float(error))
    WORST[name] = max(WORST.get(name, 0), error)


def prony(frequency, equilibrium_modulus, moduli, relaxation_times):
    """Return (E', E'') of E = E_inf + sum_k E_k i w tau_k / (1 + i w tau_k).

    Works on floats, arrays and mpmath numbers; w may be large or tiny without overflow.
    """
    storage = equilibrium_modulus + 0 * frequency
    loss = 0 * frequency
    for modulus, time in zip(moduli, relaxation_times, strict=True):
        x = frequency * time
        loss = loss + modulus * x / (1 + x * x)
        storage = storage + modulus * x * x / (1 + x * x)
    return storage, loss


def prony_integrals(frequency, equilibrium_modulus, moduli, relaxation_times, sqrt=mpmath.sqrt):
    """Return the closed forms of I1 and I2 (THEORY.md section 2), used as the second evaluation."""
    pi = mpmath.pi if sqrt is mpmath.sqrt else float(mpmath.pi)
    first = 0 * frequency
    second = equilibrium_modulus**2 + 0 * frequency
    for modulus, time in zip(moduli, relaxation_times, strict=True):
        x = frequency * time
        r = sqrt(1 + x * x)
        first = first + modulus * x / (r * (r + 1))
        pairs = zip(moduli, relaxation_times, strict=True)
        coupling = sum(e * t / (time + t) for e, t in pairs)
        weight = 2 * modulus * (equilibrium_modulus + coupling)
        second = second + weight * x * x / (r * (r + 1))
    return 2 * pi * first, 2 * pi * second
