"""The rule of PartialContact by brute force, from its definition (tests/reference/partial_rule.py).

Gauss rules of 16 nodes on panels of ln q that end wherever something has a kink: at the rows, a
unit to each side of each, at the rows of a measured modulus. Behind each of those, where I1 and I2
begin as the power 5/2, and from the fronts on, panels grow by factors. Only I1 and I2 of a
frequency are the library's. Two sets of panels agree to 1e-15 on measured scans and moduli.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import erf

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
from partial_rule import TAIL_END, by_kappa, sums
from partial_surface import closed_end, closed_moment, end_window, gauss, nodes_on, roughness

NODES = 16
LONGEST = 0.4
STEEPEST = 3.0  # change of ln c over a panel
FAR = 10.0
AFTER_KNOT = 0.3 * 0.25 ** np.arange(1, 5)


class Surface:
    """Where its panels end, and its roughness."""

    def __init__(self, q: Any, c: Any) -> None:
        self.places = np.log(q)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            self.between = closed_moment(q, c)
            self.roughness, power, straight = roughness(q, c)
            self.last = np.array([closed_end(q, c)])
        first = np.flatnonzero((c[:-1] > 0) | (c[1:] > 0))[0]
        self.start, self.end = self.places[first], self.places[-1]
        lengths = np.diff(self.places)
        pieces = np.where(straight, 4 * lengths, np.abs(4 + power) * lengths / STEEPEST)
        ends = [
            place + length * np.arange(1, count) / count
            for place, length, count in zip(
                self.places, lengths, np.minimum(np.ceil(pieces), 400), strict=False
            )
        ]
        rows = np.concatenate([self.places, *ends])
        # wherever an interval has far more roughness than all before the contact breaks up anew
        upto = self.between(self.places[:1], self.places)
        fronts = np.flatnonzero(np.diff(upto) > FAR * upto[:-1])
        front = self.places[fronts] + lengths[fronts] * 0.5 ** np.arange(1, 44)[:, None]
        front = np.append(front, self.start + (self.end - self.start) * 0.5 ** np.arange(1, 44))
        even = np.arange(self.start, self.end, LONGEST)
        self.edges = np.concatenate([rows, rows - 1, rows + 1, front, even])


class Truth:
    """mu_H and A / A0 of one surface and rubber at a velocity."""

    def __init__(
        self,
        surface: Surface,
        rubber: Any,
        velocity: float,
        poisson_ratio: float = 0.5,
        nodes: int = NODES,
    ):
        self.compliance = 4 * (1 - poisson_ratio**2)
        factor = 2 / self.compliance**2
        measured = isinstance(rubber, asperity.MasterCurve)
        highest = rubber.angular_frequency[-1] if measured else np.inf
        knots = np.log(rubber.angular_frequency / velocity) if measured else np.array([])
        knots = np.concatenate([knots, (knots[:, None] + AFTER_KNOT).ravel()])

        def integrals(w: Any) -> tuple[Any, Any]:
            i1, i2 = rubber.angular_integrals(np.minimum(w, highest).ravel())[:2]
            return i1.reshape(w.shape), i2.reshape(w.shape)

        edges = np.unique(np.concatenate([surface.edges, knots]))
        edges = edges[(edges > surface.start) & (edges < surface.end)]
        edges = np.concatenate([[surface.start], edges, [surface.end]])
        rule = gauss(nodes)
        y, weights, half = nodes_on(edges, rule)
        row = np.searchsorted(surface.places, (edges[:-1] + edges[1:]) / 2, side="right") - 1
        i1, i2 = integrals(velocity * np.exp(y))
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            rate = factor * surface.roughness(y, row[:, None]) * i2
        before = np.cumsum([0.0, *(rate * weights).sum(axis=1)])
        g = before[:-1, None] + half * (rate @ rule[2].T)
        steepness = factor * i2 * np.maximum(0, surface.between(y - 1, y + 1)) / 2

        window = end_window(surface.between, surface.places, surface.last)
        whole = surface.between(surface.places[:1], surface.places[-1:])[0]
        frequency = velocity * np.exp(surface.last)
        i2_at_end = integrals(frequency)[1][0]
        excess = 1 - before[-1] / (factor * whole * i2_at_end)
        self.nodes = (g, rate * weights, steepness, i1 / i2, before[-1], 4 * window / whole, excess)

        length = np.log(TAIL_END)
        held = np.log(highest / frequency)
        edges = np.concatenate([np.linspace(0, length, 20), knots - surface.last, held])
        edges = np.unique(edges[(edges >= 0) & (edges <= length)])
        z, weights, _ = nodes_on(edges, gauss(20))
        i1, i2 = integrals(frequency * np.exp(z))
        part = factor * window * (i2 / i2_at_end) ** 0.25 * weights * np.exp(-3 * z)
        self.tail = (part * i2).sum(), (part * i1).sum()

    def under(self, pressure: float) -> tuple[Any, Any]:
        """Nodes and tail as `sums` takes them."""
        scale = pressure**-2
        g, weights, steepness, ratio, g1, end, excess = self.nodes
        nodes = (g * scale, weights * scale, steepness * scale, ratio, g1 * scale, end, excess)
        return nodes, (self.tail[0] * scale, self.tail[1] * scale)

    def at(self, pressure: float) -> tuple[float, float]:
        nodes, tail = self.under(pressure)
        kappa = by_kappa(nodes, tail)
        friction = self.compliance * pressure * sums(kappa, nodes, tail)[1]
        return friction, float(erf(0.5 / np.sqrt(kappa * nodes[4])))
