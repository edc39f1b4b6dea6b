"""Contact area and hysteretic friction of tabulated moduli on self-affine surfaces.

As make_friction.py, with the modulus of steffen.py. v q stays inside the table. Method one takes
the angular integrals by Gauss rules in z, cos(phi) = sech(z), method two by Gauss rules in phi;
both split where w cos(phi) passes a knot.
"""

import numpy as np
import tables
from friction_scene import columns, solve
from make_friction import ASPHALT, SANDPAPER, SBR, USUAL
from steffen import Table

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def sampled(low, high, per_decade):
    """Return a table of the SBR-like rubber between 10^low and 10^high rad/s."""
    count = round((high - low) * per_decade) + 1
    frequency = [10.0 ** (low + k / per_decade) for k in range(count)]
    pairs = [tables.prony(w, *SBR.values()) for w in frequency]
    columns = [frequency, [p[0] for p in pairs], [p[1] for p in pairs]]
    return [[float(f"{value:.8g}") for value in column] for column in columns]


KINKY = [
    [1.0, 30.0, 40.0, 2e3, 1e4, 7e4, 1e5, 3e7],
    [3e6, 5e6, 4.5e6, 2e7, 1.8e7, 9e7, 4e8, 1.2e9],
    [2e5, 1e6, 2e6, 1.5e6, 1e7, 4e7, 9e7, 3e7],
]

SCENES = {
    "dense asphalt slow": {"table": sampled(-4, 10, 5), "velocity": 1e-4},
    "dense asphalt fast": {"table": sampled(-4, 10, 5), "velocity": 1.0},
    "coarse sandpaper": {**SANDPAPER, "table": sampled(0, 8, 2), "velocity": 1e-2},
    "kinky with rolloff": {"table": KINKY, "velocity": 1e-2, "rolloff": 7e3, "gamma": 0.4},
    "low end of the table": {"table": sampled(1, 9, 3), "velocity": 0.0051, "gamma": 0.0},
    "two rows wide front": {
        **ASPHALT,
        "table": [[1.0, 1e6], [1e7, 1e9], [3e6, 2e8]],
        "rms_height": 3e-6,
        "velocity": 1e-2,
        "pressure": 1e6,
        "q1": 1e5,
        "form": "interpolated",
    },
}


def angular_integrals(table):
    """Return w -> (I1, I2) by Gauss rules in z, and in phi."""
    exact = Table(*table)
    knots, x = np.array(table[0]), np.array([float(v) for v in exact.x])
    cubics = [np.array([[float(v) for v in piece] for piece in c]) for c in exact.cubics]
    storage0, loss0 = table[1][0], table[2][0]
    every = np.arange(len(knots) - 1)
    parts = np.ceil(np.diff(x)).astype(int)  # the rules in phi need shorter pieces
    numbers = np.repeat(every, parts)
    cuts = [np.geomspace(*knots[i : i + 2], parts[i] + 1)[:-1] for i in every]
    cuts = np.concatenate([*cuts, knots[-1:]])

    def piece(log_w, i):
        """Return E' and E'' at log_w[frequency, interval, node], i the intervals' numbers."""
        t = np.clip(log_w - x[i, None], 0, np.diff(x)[i, None])  # harmless where not used
        return [np.exp(sum(c[i, k, None] * t**k for k in range(4))) for c in cubics]

    def in_z(w):
        edges = np.arccosh(np.maximum(w[:, None] / knots, 1.0))
        half = (edges[:, :-1, None] - edges[:, 1:, None]) / 2
        z = edges[:, 1:, None] + half * (1 + NODES)
        c = 1 / np.cosh(z)
        storage, loss = piece(np.log(w)[:, None, None] - np.log(np.cosh(z)), every)
        weight = 4 * half * WEIGHTS * c
        i1 = np.sum(weight * c * loss, axis=(1, 2))
        i2 = np.sum(weight * (storage**2 + loss**2), axis=(1, 2))
        s = np.arange(0.05, 40, 0.1)  # the tail by Gauss panels in z
        z = edges[:, :1, None] + s[:, None] + 0.05 * NODES
        c = 1 / np.cosh(z)
        loss = loss0 * c * (w / knots[0])[:, None, None]
        weight = 0.2 * WEIGHTS * c
        i1 += np.sum(weight * c * loss, axis=(1, 2))
        i2 += np.sum(weight * (storage0**2 + loss**2), axis=(1, 2))
        return i1, i2

    def in_phi(w):
        edges = np.arccos(np.minimum(cuts / w[:, None], 1.0))
        half = (edges[:, :-1, None] - edges[:, 1:, None]) / 2
        phi = edges[:, 1:, None] + half * (1 + NODES)
        c = np.cos(phi)
        storage, loss = piece(np.log(w[:, None, None] * c), numbers)
        weight = 4 * half * WEIGHTS
        i1 = np.sum(weight * c * loss, axis=(1, 2))
        i2 = np.sum(weight * (storage**2 + loss**2), axis=(1, 2))
        ratio = knots[0] / w
        rest = np.arcsin(ratio)
        cosines = rest - ratio * np.sqrt(1 - ratio**2)
        i1 += 2 * loss0 / ratio * cosines
        i2 += 4 * storage0**2 * rest + 2 * (loss0 / ratio) ** 2 * cosines
        return i1, i2

    def in_blocks(w):
        parts = [in_z(block) for block in np.array_split(w, max(1, w.size // 256))]
        return [np.concatenate(column) for column in zip(*parts, strict=True)]

    return in_blocks, in_phi


def row(case, changes):
    """Return one row, both methods compared."""
    scene = {"case": case, **USUAL, **changes}
    frequency, storage, loss = scene["table"]
    assert frequency[0] <= scene["velocity"] * scene["q0"]
    assert scene["velocity"] * scene["q1"] <= frequency[-1]
    knots = [w / scene["velocity"] for w in frequency]
    first, second = solve(scene, *angular_integrals(scene["table"]), knots)
    for a, b in zip(first, second, strict=True):
        tables.agree("friction_tabulated", a, b, 1e-8)
    print(f"{case:24s}", " ".join(f"{x:.10g}" for x in first))
    keys = ["pressure", "velocity", "poisson_ratio", "shift_factor", "gamma", "form"]
    return (
        {key: scene[key] for key in ["case", "rms_height", "hurst", "q0", "q1", "rolloff"]}
        | {"table_frequency": frequency, "table_storage": storage, "table_loss": loss}
        | {key: scene[key] for key in keys}
        | columns(first)
    )


def main():
    """Write friction_tabulated.csv."""
    rows = [row(case, changes) for case, changes in SCENES.items()]
    comments = [
        "Contact area and hysteretic friction with tabulated moduli (see friction.csv for the",
        "columns, master_curve.csv for the interpolant): article Eqs 5-8 and 22, THEORY.md 2 to 5.",
        "Generated by make_friction_tabulated.py in double precision, two methods within 1e-8.",
        "v q0 and v q1 lie inside the table.",
        "Units: rms_height m; q0, q1, rolloff 1/m; table_frequency rad/s; table_storage,",
        "table_loss, pressure Pa; velocity m/s; the rest none.",
    ]
    tables.write("friction_tabulated", comments, rows)


if __name__ == "__main__":
    main()
