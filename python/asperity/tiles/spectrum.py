"""The radial spectrum of a map by tiles: the mean over windowed tiles that overlap (P. D. Welch,
IEEE Trans. Audio Electroacoust. 15, 70 (1967)), with the map coarsened below what they resolve."""

import math
from typing import Any

import numpy as np

from asperity import _core
from asperity.base.arguments import number
from asperity.base.diagnostics import Argument, InvalidInput, must_be, refusal
from asperity.spectrum import TabulatedSpectrum
from asperity.tiles.coarse import Coarse, Columns, block_of, coarsen, few_modes, without_blocks
from asperity.tiles.grid import Grid
from asperity.tiles.share import Workers
from asperity.tiles.source import Piece, Source

_NONE = 2  # the window's number in the core
_PERIODS = (32.0, 20.0, 0.0, 24.0)  # of a wave on a tile where its rows take over: split cosine
# bell, Hann, -, Blackman. Twice those from which a row is reliable
_NEAR_NYQUIST = 2
_ANY_SHARE = 0.999  # the whole has been judged by its points
_COLUMNS = ("wavenumber", "density", "count", "standard_error", "flag", "correlation")
_OF_HEIGHTS = ("skewness", "kurtosis", "curvature_kurtosis", "slope_ratio")


def tiled_spectrum(
    source: Source,
    grid: Grid,
    prepared: tuple[int, int | None],
    max_dropouts: Any,
    workers: Workers,
) -> TabulatedSpectrum:
    """Return the spectrum of a map by tiles; `prepared` are the core's window and trend."""
    window, detrend = prepared
    if window == _NONE:
        allowed = "one that ends at 0, as no tile is periodic"
        raise refusal("window", "none", allowed, text='"none"')
    most = 0.10 if max_dropouts is None else number(max_dropouts, "max_dropouts")
    if not 0 <= most < 1:
        raise refusal("max_dropouts", most, "in [0, 1)", text=f"{most:.6g}")
    how = window, detrend, most
    if len(grid.boxes) == 1:
        return _single(source, grid, how, workers)
    coarse = coarsen(source, block_of(grid.tile, source.pixel_size), grid.tile, workers)
    _check_dropouts(coarse.dropout_fraction, most)
    fine = _mean_rows(source, grid, how, workers)
    spectrum = _of_coarse(coarse, how)
    low = _low_rows(spectrum, coarse, source, grid, fine, window)
    skipped = _edge(grid, source.pixel_size, window)[0]
    return _merged(low, fine, skipped, spectrum, source.pixel_size)


def tile_columns(
    piece: Piece, pixel_size: tuple[float, float], how: tuple[Any, ...]
) -> Columns | None:
    """Return the spectrum of a tile, as columns can be sent; None if it has too many drop-outs."""
    window, detrend, most = how
    heights = piece.read()
    missing = int(np.count_nonzero(np.isnan(heights)))
    if missing == heights.size or missing > most * heights.size:
        return None
    tile = _core.HeightMap(heights, pixel_size)
    if missing:
        tile = tile.fill_dropouts(most)
    spectrum = _core.power_spectrum(tile, window, detrend, 1, 0)
    return {name: getattr(spectrum, name) for name in TabulatedSpectrum._of_core()}


def _single(
    source: Source, grid: Grid, how: tuple[Any, ...], workers: Workers
) -> TabulatedSpectrum:
    piece = source.piece(grid.boxes[0])
    (columns,) = workers.outcomes(tile_columns, [(piece, source.pixel_size, how)])
    if columns is None:
        _check_dropouts(float(np.mean(np.isnan(piece.read()))), how[-1])
        raise InvalidInput(Argument("heights"), ": every point is a drop-out (NaN)")
    return TabulatedSpectrum(**columns)


def _check_dropouts(share: float, most: float) -> None:
    if share == 1:
        raise InvalidInput(Argument("heights"), ": every point is a drop-out (NaN)")
    if share > most:
        allowed = f"at most {100 * most:.4g} %, max_dropouts = {most:.4g}"
        raise must_be("heights", allowed, f" has {100 * share:.4g} % drop-outs")


def _mean_rows(source: Source, grid: Grid, how: tuple[Any, ...], workers: Workers) -> Columns:
    """The mean over the tiles that are whole enough. Their errors are those of independent tiles
    times what the overlap makes of them."""
    window, _, most = how
    works = ((source.piece(box), source.pixel_size, how) for box in grid.boxes)
    used: list[bool] = []
    density, square = np.zeros(1), np.zeros(1)
    same: Columns | None = None  # wavenumber, count and flag do not depend on the heights
    for columns in workers.outcomes(tile_columns, works):
        used.append(columns is not None)
        if columns is not None:
            same = same or columns
            density = density + columns["density"]
            square = square + columns["standard_error"] ** 2
    if same is None:
        problem = f"have more than {100 * most:.4g} % drop-outs each, max_dropouts = {most:.4g}"
        raise InvalidInput(Argument("heights"), f": all {len(used)} tiles {problem}")
    tiles = sum(used)
    alone = _core.tile_covariances(window, grid.tile, source.pixel_size, (0, 0))
    together = grid.covariances(window, source.pixel_size, np.array(used))
    mean, error = density / tiles, np.sqrt(square / tiles * (together[0] / alone[0]))
    return {
        "wavenumber": same["wavenumber"],
        "density": mean,
        "count": same["count"] * (math.prod(source.shape) / math.prod(grid.tile)),
        "standard_error": error,
        "flag": same["flag"] & np.uint8(_NEAR_NYQUIST) | few_modes(mean, error),
        "correlation": np.tile(together[1:] / together[0], (mean.size, 1)),
    }


def _of_coarse(coarse: Coarse, how: tuple[Any, ...]) -> Any:
    window, detrend, _ = how
    heights = _core.HeightMap(coarse.heights, coarse.pixel_size)
    if heights.dropout_fraction:
        heights = heights.fill_dropouts(_ANY_SHARE)
    return _core.power_spectrum(heights, window, detrend, 1, 0)


def _low_rows(
    spectrum: Any, coarse: Coarse, source: Source, grid: Grid, fine: Columns, window: int
) -> Columns:
    below = spectrum.wavenumber < _edge(grid, source.pixel_size, window)[1]
    rows = {name: getattr(spectrum, name)[below] for name in _COLUMNS}
    rows["flag"] = rows["flag"] & ~np.uint8(_NEAR_NYQUIST)
    return without_blocks(rows, coarse, source.pixel_size, fine)


def _edge(grid: Grid, pixel_size: tuple[float, float], window: int) -> tuple[int, float]:
    """How many rings of a tile are too low, and the wavenumber where the first that is kept
    begins."""
    sides = [n * d for n, d in zip(grid.tile, pixel_size, strict=True)]
    first = math.ceil(_PERIODS[window] * max(sides) / min(sides) - 1e-9)
    return first - 1, (first - 0.5) * 2 * math.pi / max(sides)


def _merged(
    low: Columns, fine: Columns, skipped: int, coarse: Any, pixel_size: tuple[float, float]
) -> TabulatedSpectrum:
    """The rows of the coarse map, whose heights are the map's but for short waves, then those of
    the tiles."""
    fine = {name: column[skipped:] for name, column in fine.items()}
    correlations = low.pop("correlation"), fine.pop("correlation")
    count, lags = low["density"].size, max(one.shape[1] for one in correlations)
    correlation = np.zeros((count + fine["density"].size, lags))
    for lag, column in enumerate(correlations[0].T):  # none of a low row with those of the tiles
        last = max(0, count - lag - 1)
        correlation[:last, lag] = column[:last]
    correlation[count:, : correlations[1].shape[1]] = correlations[1]
    columns: Columns = {name: np.concatenate([low[name], fine[name]]) for name in low}
    columns |= {name: getattr(coarse, name) for name in _OF_HEIGHTS}
    q1 = math.pi / max(pixel_size)
    return TabulatedSpectrum(**columns, correlation=correlation, q1=q1)
