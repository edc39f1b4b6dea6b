"""From scans to spectra: of maps, along lines, and several merged into one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal, get_args

from asperity import _core
from asperity.base.arguments import choice, flag, number_or_none, of_kind, whole
from asperity.base.diagnostics import Argument, InvalidInput, must_be, refusal
from asperity.base.value import around
from asperity.io.objects import surface_from
from asperity.spectrum import LineSpectrum, TabulatedSpectrum
from asperity.surface import DETRENDS, Detrend, HeightMap, LineScan, PixelSize
from asperity.tiles.grid import TileSides, grid_of
from asperity.tiles.share import Workers
from asperity.tiles.source import source_of
from asperity.tiles.spectrum import tiled_spectrum

Window = Literal["split-cosine-bell", "hann", "none", "blackman"]
Part = Literal["all", "top", "bottom"]
# each in the order of the core's enumeration
WINDOWS = get_args(Window)


NO_DIRECTIONS = " = True: a line scan knows no directions"


def prepared(window: Window, detrend: Detrend | None) -> tuple[int, int | None]:
    """Return the numbers of a window and of a trend in the core."""
    trend = choice(detrend, "detrend", (*DETRENDS, None))
    return choice(window, "window", Window), None if detrend is None else trend


def core_map(surface: Any) -> Any:
    if isinstance(surface, LineScan):
        raise must_be("surface", "a HeightMap; line_spectrum takes line scans", " = a LineScan")
    return of_kind(surface, "surface", HeightMap)._core


def power_spectrum(
    surface: HeightMap | Any,
    *,
    window: Window = "split-cosine-bell",
    detrend: Detrend | None = "plane",
    threads: int = 1,
    part: Part = "all",
    directional: bool = False,
    pixel_size: PixelSize | None = None,
    tiles: TileSides | None = None,
    overlap: float | None = None,
    max_dropouts: float | None = None,
    executor: Any = None,
) -> TabulatedSpectrum:
    """Return the radially averaged roughness spectrum of a map (the article's Eqs 25-27).

    The map is detrended, windowed and transformed; |h(q)|^2 is averaged over rings round(|q| / dq),
    dq = 2 pi / longest side, out to the corner of the plane. The mean square of the window is
    divided out. float32 maps are transformed in single precision, whose noise lies some 14 decades
    below the highest density.

    A map that does not fit in memory is given as an array that is read as it is sliced: a
    `numpy.memmap`, a Zarr or Dask array. Tiles of it are detrended, windowed and transformed, and
    their rings are averaged (P. D. Welch, IEEE Trans. Audio Electroacoust. 15, 70 (1967)). Rows of
    fewer than 32 periods on a tile (Hann 20, Blackman 24) come from the map coarsened to pixels of
    1/256 of a tile. Any map may be given so: see `docs/howto/large_scans.md`.

    Parameters
    ----------
    surface : HeightMap, or array of shape (ny, nx)
        A map without drop-outs; by tiles it may have some. An array holds heights [m], NaN where
        there is none, and is always taken by tiles. A Topography of SurfaceTopography, a DataArray
        with coordinates or a DataFrame is what `read_surface` makes of it.
    window : {"split-cosine-bell", "hann", "none", "blackman"}
        "none" is right for periodic maps only, and then with detrend=None: a plane subtracted from
        a periodic map leaves a saw-tooth.
    detrend : {"plane", "quadratic", "offset", None}
        The least-squares surface that is subtracted first.
    threads : int
        Threads that the call starts for itself, from 1 to 1024. Sums then differ in rounding.
    part : {"all", "top", "bottom"}
        "top" gives the spectrum of max(h, 0), h being the height above the mean plane, divided by
        the share of points above it (B. N. J. Persson et al., J. Phys.: Condens. Matter 17, R1
        (2005)); "bottom" that of min(h, 0) likewise. They agree with the whole at large q where
        heights are Gaussian; on worn tracks the rubber meets the top. Not by tiles.
    directional : bool
        Keep the harmonics of each ring over the direction of q, `cosine` and `sine`, with their
        standard errors: as many as the scan supports, up to the last that differs from 0 by more
        than four standard errors in the mean over reliable rings, from 1 to 16. Not by tiles, and
        not with a `part`.
    pixel_size : float or (float, float), optional
        Spacing of the points of an array [m], or (dy, dx).
    tiles : int or (int, int), optional
        Points of a tile along y and x, 512 or more; an array's are 4096 a side unless given, or the
        whole of a shorter side. The tiles are spread evenly, so that they reach all edges.
    overlap : float, optional
        Smallest share of a tile, along either side, that the next one covers again, from 0 to 0.75;
        0.5 by default. The errors know how alike it makes the tiles.
    max_dropouts : float, optional
        Largest share of drop-outs [-], 0.10 by default: a tile with more is left out, a map with
        more is refused. Those that tiles have are filled as by `HeightMap.fill_dropouts`.
    executor : optional
        Anything with the `submit` of `concurrent.futures` (a pool, a Dask client) to share the
        tiles. By tiles the numbers are the same for any executor and any number of threads. A map
        that is one tile is the work of one thread or one worker, and no overlap changes it.

    Returns
    -------
    TabulatedSpectrum
        `wavenumber` is the mean |q| of a ring's modes [1/m], `density` C [m^4], `count` the number
        of modes of the full plane in the ring: sum(density * count) (2 pi)^2 / area is the mean
        square height (Parseval); by tiles, of the modes of the whole map that the row stands for.
        `standard_error` holds for Gaussian heights, whose |h(q)|^2
        scatter as much as their mean. `flag` says which rows not to trust; by tiles 4 also stands
        for rows of the coarsened map of which roughness that is folded back leaves no more than 4
        times the error, down to a density of 0. `skewness` and `kurtosis` are of the heights about
        the trend, from some 512 rows of a larger map (by tiles of the coarsened map's, for a part
        of the heights None). Rings beyond the Nyquist wavenumber pi / pixel are incomplete: the
        band ends there (`.q1`, of the coarser pixel), and `truncated(q1=...)` takes more of them.

    Raises
    ------
    InvalidInput
        The surface is a LineScan, has drop-outs or fewer than 2 x 2 points. By tiles: they are
        larger than the map or too small, all have too many drop-outs, or the file of a memory map
        is changed or cut short while it is read.
    """
    how = prepared(window, detrend)
    several = whole(threads, "threads", lowest=1, highest=1024)
    side = choice(part, "part", Part)
    if pixel_size is None and not isinstance(surface, HeightMap | LineScan):
        surface = surface_from(surface) or surface
    by_tiles = tiles is not None or not isinstance(surface, HeightMap | LineScan)
    of_tiles = {"pixel_size": pixel_size, "overlap": overlap, "max_dropouts": max_dropouts}
    for name, unused in ({} if by_tiles else {**of_tiles, "executor": executor}).items():
        if unused is not None:
            raise InvalidInput(
                Argument(name), ": goes with tiles, or with an array instead of a HeightMap"
            )
    if flag(directional, "directional"):
        if isinstance(surface, LineScan):
            raise must_be("directional", "False", NO_DIRECTIONS)
        if by_tiles or part != "all":
            raise must_be("directional", "False by tiles and with a part", " = True")
        core = _core.directional_spectrum(core_map(surface), *how, several)
    elif not by_tiles:
        core = _core.power_spectrum(core_map(surface), *how, several, side)
    else:
        if part != "all":
            raise must_be("part", '"all" by tiles', f' = "{part}"')
        source = source_of(surface, pixel_size)
        grid = grid_of(source, tiles, overlap)
        core = tiled_spectrum(source, grid, how, max_dropouts, Workers(threads, executor))._core
    # as a scene's [surface] says it
    preparation = f'window = "{window}", detrend = "{detrend or "none"}"'
    return around(TabulatedSpectrum, core, preparation=preparation)


def line_spectrum(
    surface: LineScan | HeightMap,
    *,
    window: Window = "split-cosine-bell",
    detrend: Detrend | None = "plane",
    part: Part = "all",
) -> LineSpectrum:
    """Return the one-dimensional spectrum C1D [m^3] of a line scan, or the mean over a map's rows.

    Each row is detrended (offset, straight line, parabola) and windowed as a scan of its own.

    Parameters
    ----------
    surface : LineScan or HeightMap
        A scan without drop-outs.
    window, detrend
        As in `power_spectrum`.
    part : {"all", "top", "bottom"}
        As in `power_spectrum`, over the share of points too; above and below the mean of each row.

    Returns
    -------
    LineSpectrum
        Two-sided, at positive wavenumbers [1/m]: sum(density * count) / rows times 2 pi / length
        is the mean square height. `standard_error` counts rows nearer than half a wavelength as
        one.

    Raises
    ------
    InvalidInput
        The surface has drop-outs or fewer than 4 points along x.
    """
    how = (*prepared(window, detrend), choice(part, "part", Part))
    scan = of_kind(surface, "surface", LineScan, HeightMap)
    return around(LineSpectrum, _core.line_spectrum(scan._core, *how))


def merge_spectra(
    spectra: Iterable[TabulatedSpectrum], *, per_decade: float | None = None
) -> TabulatedSpectrum:
    """Return one spectrum of several scans of a surface, at one or several magnifications.

    Parameters
    ----------
    spectra : iterable of TabulatedSpectrum
        The spectra of the scans.
    per_decade : float, optional
        Logarithmic bins in a factor 10 of the wavenumber [1/m], as in `log_binned`, in which rows
        of all spectra meet; rows that are flagged for the window or Nyquist are left out of bins
        that have others. Without it all spectra must have the same wavenumbers, and are averaged
        row by row.

    Returns
    -------
    TabulatedSpectrum
        The mean, weighted by `count` where the spectra have it.

    Raises
    ------
    InvalidInput
        There is nothing to merge, wavenumbers differ without `per_decade`, or some of the spectra
        have counts and others have none.
    """
    if not isinstance(spectra, Iterable):
        raise refusal("spectra", spectra, "an iterable of TabulatedSpectrum")
    cores = [of_kind(s, f"spectra[{i}]", TabulatedSpectrum)._core for i, s in enumerate(spectra)]
    merged = _core.merge_spectra(cores, number_or_none(per_decade, "per_decade"))
    return around(TabulatedSpectrum, merged)
