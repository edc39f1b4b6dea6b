"""What asperity/friction_map.hpp says of a map's file, and nothing else."""

import struct
import zlib

import numpy as np


class ByLayout:
    """A file's head and tables, and its look-up, of a plain map or a slanted one."""

    def __init__(self, content):
        assert content[:8] == b"ASPERMAP"
        order, version, size = struct.unpack_from("<IIQ", content, 8)
        assert (order, version, size) == (0x01020304, 4, len(content))
        assert struct.unpack_from("<II", content, size - 8) == (zlib.crc32(content[:-8]), 0)
        sides = struct.unpack_from("<6d", content, 24)
        self.box, self.background = sides[:4], sides[4:]
        errors = struct.unpack_from("<4d", content, 72)
        self.rtol, self.max_error, self.largest, self.memory = errors
        self.tau, self.v0, self.width = struct.unpack_from("<3d", content, 104)
        self.checked, self.exceeded, self.cold = struct.unpack_from("<3Q", content, 128)
        counts = struct.unpack_from("<10I", content, 152)
        self.flags, bands, nodes, self.m, columns, rows, grids, entries, cells, text = counts
        self.slanted = self.flags == 3
        at = 192

        def take(kind, count):
            nonlocal at
            values = np.frombuffer(content, kind, count, at)
            at += values.nbytes
            return values

        self.law = take("<f8", 2) if self.slanted else None
        self.lengths = take("<f8", 2 * columns * rows)
        self.cuts = take("<f8", bands + 1)
        self.shear = take("<f8", 2 * nodes).reshape(-1, 2)
        self.grids = []
        for _ in range(grids):
            place, (columns, rows, first, zero) = take("<f8", 4), take("<u4", 4)
            assert zero == 0
            self.grids.append((*place, int(columns), int(rows), int(first)))
        self.entries = take("<i4", entries)
        at = -(-at // 8) * 8
        numbers = 2 + (128 * (self.m - 1) if self.slanted else 32)
        self.cells = take("<f8", numbers * cells).reshape(-1, numbers)
        if self.cold == 0:
            self.text = bytes(take("u1", text)).decode()
            assert -(-at // 8) * 8 + 8 == size

    def cell(self, x, y, k):
        """Numbers of the cell at two coordinates, down from the grid of a band."""
        while True:
            gx, gy, per_x, per_y, columns, rows, first = self.grids[k]
            i = min(max(int((x - gx) * per_x), 0), columns - 1)
            j = min(max(int((y - gy) * per_y), 0), rows - 1)
            entry = int(self.entries[first + i * rows + j])
            if entry >= 0:
                return self.cells[entry]
            assert -1 - entry > k
            k = -1 - entry

    def shear_at(self, x):
        if self.shear.size == 0:
            return 0.0
        lo, hi = np.log(self.box[2:])
        h = (hi - lo) / (len(self.shear) - 1)
        i = min(int((x - lo) / h), len(self.shear) - 2)
        (a, da), (b, db) = self.shear[i : i + 2]
        t = (x - lo) / h - i
        rise = da * h * t * (1 - t) ** 2 - db * h * t**2 * (1 - t)
        return a * (1 + 2 * t) * (1 - t) ** 2 + b * t**2 * (3 - 2 * t) + rise

    def look_up(self, pressure, velocity):
        """Hysteresis, area and adhesion of a plain map."""
        x = np.log(velocity)
        z = np.log(pressure) - self.shear_at(x)
        band = int(np.searchsorted(self.cuts[1:-1], z, side="right"))
        x0, z0, *c = self.cell(x, z, band)
        powers = [(x - x0) ** i * (z - z0) ** j for j in range(4) for i in range(4)]
        hysteresis = np.exp(np.dot(c[0::2], powers)) if self.flags else 0.0
        area = np.exp(np.dot(c[1::2], powers))
        falling = np.exp(-self.width * np.log10(velocity / self.v0) ** 2)
        return hysteresis, area, self.tau / pressure * area * falling

    def slanted_look_up(self, pressure, velocity, temperature):
        """Hysteresis and area of long ago of a slanted map."""
        (a, b), (coldest, warmest) = self.law, self.background

        def shift(t):
            return a * t / (1 + b * t)

        y, g = np.log(pressure), shift(temperature - coldest)
        least, most = sorted((0.0, shift(warmest - coldest)))
        above = min(g - least, np.log(self.box[3] / velocity))
        below = min(most - g, np.log(velocity / self.box[2]))
        share, z = above / max(above + below, 1e-300), np.log(velocity) + g
        band = int(np.searchsorted(self.cuts[1:-1], z, side="right"))
        y0, z0, *numbers = self.cell(y, z, band)
        step = min(int(share * (self.m - 1)), self.m - 2)
        power = np.array(numbers).reshape(self.m - 1, 4, 4, 4, 2)[step]  # of share, z, y
        d = share - step / (self.m - 1)
        by = (np.power(x, range(4)) for x in (d, z - z0, y - y0))
        return np.exp(np.einsum("tjik,t,j,i->k", power, *by))
