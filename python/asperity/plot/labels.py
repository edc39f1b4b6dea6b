"""Names beside curves, and legends where nothing lies below them (matplotlib)."""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from asperity.plot.style import narrow, paper

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

MOST_NAMED = 3  # curves that are named on the picture; more of them have a legend
_PLACES = np.linspace(0.06, 0.94, 45)  # of the width of the axes
_GAP = 4.0  # points between a curve and its name
_SHARES = (1.0, 0.0, 0.5, 0.25, 0.75)  # of the room that a legend has, corners first


@contextmanager
def _any_letters() -> Iterator[None]:
    """Without warnings of file names in a font that lacks their letters."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph ")
        yield


@_any_letters()
def name_curves(axes: "Axes", named: Sequence[tuple["Line2D", str]]) -> bool:
    """Write its name beside each curve, at the place that is farthest from everything else, of
    those where no other curve lies upon it. False, and nothing is written, where a name would touch
    another curve."""
    from matplotlib.patheffects import withStroke

    figure = _settled(axes)
    curves = [line for line in axes.lines if len(line.get_xdata())]  # type: ignore[arg-type]
    drawn = [_points(axes, line) for line in curves]
    halo = [withStroke(linewidth=2.5, foreground=paper())]
    gap = _GAP * figure.dpi / 72
    legend = axes.get_legend()
    boxes = [legend.get_window_extent()] if legend else []
    taken = [np.array([box.x0, box.y0, box.x1, box.y1]) for box in boxes]
    written: list[Any] = []
    for line, name in named:
        text = axes.text(0, 0, name, color=line.get_color(), transform=None, path_effects=halo)
        written.append(text)
        size = text.get_window_extent()
        half = np.array([size.width, size.height]) / 2
        best, middle = -np.inf, np.zeros(2)
        path = _points(axes, line)
        for x in _apart(path, [_points(axes, one) for one in curves if one is not line], axes):
            beside = np.abs(path[:, 0] - x) <= half[0]
            for side in (1, -1):
                edge = path[beside, 1].max() if side > 0 else path[beside, 1].min()
                at = np.array([x, edge + side * (gap + half[1])])
                room = _room(at, half + 1, drawn, taken, axes)
                if room > best + 1e-6:
                    best, middle = room, at
        if best < gap / 2:
            for one in written:
                one.remove()
            return False
        taken.append(np.concatenate([middle - half, middle + half]))
        # in shares of the axes, so that it stays there when the layout moves
        place = axes.transAxes.inverted().transform(middle)
        text.set(transform=axes.transAxes, position=place, ha="center", va="center")
    return True


def _apart(
    path: NDArray[np.float64], others: Sequence[NDArray[np.float64]], axes: "Axes"
) -> NDArray[np.float64]:
    """Places along a curve where it can be told from the others; all of them where it never can."""
    x = axes.bbox.x0 + _PLACES * axes.bbox.width
    x = x[(x >= path[0, 0]) & (x <= path[-1, 0])]
    at = np.column_stack([x, np.interp(x, *path.T)])
    away = np.full(len(x), np.inf)
    for points in others:
        away = np.fmin(away, np.hypot(*(at[:, None] - points).transpose(2, 0, 1)).min(axis=1))
    told = x[away > 2 * _GAP * axes.figure.dpi / 72]
    chosen: NDArray[np.float64] = told if len(told) else x
    return chosen


def legend_beside(figure: "Figure", *entries: Any) -> None:
    """The names of the curves of the first panel: beside the curves where these are few, and the
    rest of the entries in a legend, inside of the panel where there is room.

    Of one curve its kinds (total, hysteresis ...), which are told apart by their dashes, are named
    instead, and its own name is the title. An entry that shows nothing is the legend's title.
    """
    axes = figure.axes[0]
    handles, labels = entries or axes.get_legend_handles_labels()
    told = list(zip(handles, labels, strict=True))
    blank = [one for one in told if _is_line(one[0]) and one[0].get_linestyle() == "None"]
    blank = [one for one in blank if one[0].get_marker() == "None"]
    title = "\n".join(name for _, name in blank) or None
    told = [one for one in told if one not in blank]
    curves = [one for one in told if _is_line(one[0]) and len(one[0].get_xdata())]
    rest = [one for one in told if one not in curves]
    named, alone = curves, ""
    kinds = {h.get_linestyle(): (h, name) for h, name in rest if _is_line(h)}
    if len(curves) == 1 and kinds:
        alone, colour = curves[0][1], curves[0][0].get_color()
        lines = [x for x in axes.lines if len(x.get_xdata()) and x.get_color() == colour]  # type: ignore[arg-type]
        named = [(x, kinds[x.get_linestyle()][1]) for x in lines if x.get_linestyle() in kinds]
        rest = [one for one in rest if one not in kinds.values()]
        if len(named) < len(kinds):
            named = []
    if 0 < len(named) <= MOST_NAMED and (rest or title is None):
        if alone:
            axes.set_title(alone, fontsize="medium")
        before, size = _legends(figure), tuple(figure.get_size_inches())
        if rest or title:
            shown = [one for one, _ in rest], [name for _, name in rest]
            legend_where_room_is(figure, axes, *shown, title=title)
        if name_curves(axes, named):
            return
        for legend in _legends(figure):
            if legend not in before:
                legend.remove()
        figure.set_size_inches(size)
        if alone:
            axes.set_title("")
    legend_where_room_is(figure, axes, *zip(*told, strict=True), title=title)


def _is_line(handle: Any) -> bool:
    return hasattr(handle, "get_linestyle") and hasattr(handle, "get_xdata")


def _legends(figure: "Figure") -> list[Any]:
    inside = [axes.get_legend() for axes in figure.axes]
    return [legend for legend in (*inside, *figure.legends) if legend is not None]


@_any_letters()
def legend_inside(axes: "Axes", *entries: Any, **how: Any) -> bool:
    """A legend where it covers nothing. False, and there is none, where it would."""
    from matplotlib.patches import StepPatch

    figure = _settled(axes)
    drawn = []
    for one in (other for other in figure.axes if other.bbox.bounds == axes.bbox.bounds):  # twins
        drawn += [_points(one, line) for line in one.lines if len(line.get_xdata())]  # type: ignore[arg-type]
        for filled in one.collections:
            drawn += [_dense(one.transData.transform(path.vertices)) for path in filled.get_paths()]
        for steps in one.findobj(StepPatch):
            outline = steps.get_transform().transform_path(steps.get_path()).vertices
            drawn.append(_dense(np.asarray(outline, dtype=float)))
    boxes = [text.get_window_extent() for text in axes.texts]
    taken = [np.array([box.x0, box.y0, box.x1, box.y1]) for box in boxes]
    legend = axes.legend(*entries, loc="center", fontsize="small", **how)
    legend.set_in_layout(False)  # it moves nothing
    _settled(axes)
    size = legend.get_window_extent()
    half = np.array([size.width, size.height]) / 2
    pad = half + _GAP * figure.dpi / 72
    low, high = np.array(axes.bbox.min) + pad, np.array(axes.bbox.max) - pad
    corner = [low + np.array([x, y]) * (high - low) for y in _SHARES for x in _SHARES]
    for middle in corner:
        if _room(middle, half, drawn, taken, axes) > 0:
            place = axes.transAxes.inverted().transform(middle)
            legend.set_bbox_to_anchor((place[0], place[1]), transform=axes.transAxes)
            return True
    legend.remove()
    return False


def legend_with_room(axes: "Axes", **how: Any) -> None:
    """A legend inside of the axes: where it covers nothing, or else at the top, above the curves,
    for which the axis is made longer."""
    if legend_inside(axes, **how):
        return
    for columns in (4, 3, 2, 1):
        legend = axes.legend(loc="upper center", fontsize="small", ncols=columns, **how)
        legend.set_in_layout(False)
        figure = _settled(axes)
        if legend.get_window_extent().width < axes.bbox.width:
            break
    share = (legend.get_window_extent().height + 4 * _GAP * figure.dpi / 72) / axes.bbox.height
    if share < 1:
        scale = axes.yaxis.get_transform()
        low, high = scale.transform(np.array(axes.get_ylim()))
        longer = low + (high - low) / (1 - share)
        axes.set_ylim(top=float(scale.inverted().transform(np.array([longer]))[0]))


def legend_where_room_is(
    figure: "Figure", axes: "Axes", *entries: Any, title: str | None = None
) -> None:
    """A legend inside of the axes, or else beside a single panel, or above several of them."""
    how: dict[str, Any] = {"title": title, "title_fontsize": "small"} if title else {}
    if legend_inside(axes, *entries, **how):
        return
    if not entries:
        entries = axes.get_legend_handles_labels()
    panels = [one for one in figure.axes if one.get_subplotspec() is not None]
    if narrow():
        _legend_above(figure, *entries, loc="outside upper center", ncols=2, **how)
    elif len(panels) > 1:  # above the first, whose curves they are
        if title:
            how["title"] = title.replace("\n", " ")
        _legend_above(figure, *entries, loc="outside upper left", ncols=4, **how)
    else:
        figure.legend(*entries, loc="outside right upper", fontsize="small", **how)


def _legend_above(figure: "Figure", *entries: Any, **how: Any) -> None:
    """A legend above all panels, which keep their size: the figure grows by it."""
    legend = figure.legend(*entries, fontsize="small", alignment="left", **how)
    figure.draw_without_rendering()
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + legend.get_window_extent().height / figure.dpi)


def _settled(axes: "Axes") -> "Figure":
    """The figure, with its layout as it will be drawn."""
    figure: Any = axes.get_figure()
    figure.draw_without_rendering()
    return figure  # type: ignore[no-any-return]


def _points(axes: "Axes", line: "Line2D") -> NDArray[np.float64]:
    """A curve in pixels, from left to right, with a point at each pixel of its width."""
    with np.errstate(all="ignore"):
        corners = np.asarray(line.get_transform().transform(line.get_xydata()), dtype=float)
    corners = corners[np.isfinite(corners).all(axis=1)]
    if len(corners) < 2 or line.get_linestyle() in ("None", "", " "):
        return corners if len(corners) else np.full((1, 2), -1e9)
    dense = _dense(corners)
    return dense[np.argsort(dense[:, 0], kind="stable")]


def _dense(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """A line of points a pixel apart through the corners."""
    if len(corners) < 2:
        return np.full((1, 2), -1e9)
    length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
    along = np.linspace(0, length[-1], max(2, min(int(length[-1]), 4000)))
    return np.column_stack([np.interp(along, length, corners[:, i]) for i in (0, 1)])


def _room(
    middle: NDArray[np.float64],
    half: NDArray[np.float64],
    drawn: Sequence[NDArray[np.float64]],
    taken: Sequence[NDArray[np.float64]],
    axes: "Axes",
) -> float:
    """Distance [pixels] of a box from what is drawn and written, and from the frame; at most zero
    where it touches any of them."""
    low, high = middle - half, middle + half
    frame = axes.bbox
    inside = [low[0] - frame.x0, low[1] - frame.y0, frame.x1 - high[0], frame.y1 - high[1]]
    room = float(min(inside))
    for points in drawn:
        away = np.fmax(np.fmax(low - points, points - high), 0)
        room = min(room, float(np.hypot(*away.T).min()))
    for box in taken:
        away = np.fmax(np.fmax(low - box[2:], box[:2] - high), 0)
        room = min(room, float(np.hypot(*away)))
    return room
