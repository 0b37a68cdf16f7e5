"""Maps of parcels: the observed ones beside each strategy's, in the same colours and extent."""

import math

import matplotlib.pyplot as plt
import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PathCollection
from matplotlib.patches import Rectangle
from matplotlib.path import Path

from run_data import OBSERVED, layer_word, plots_word, short_title
from style import Colouring, name_of, title_of

MAP_MEASURES = ("aspect_ratio", "area_m2", "neighbours")
#: Blocks in the zoom: few enough that parcels can be seen.
ZOOM_BLOCKS = 30
ZOOM_SHAPE = 4.0 / 3.0


def _ring_path(ring):
    points = numpy.asarray(ring.coords)[:, :2]
    codes = numpy.full(len(points), Path.LINETO, dtype=Path.code_type)
    codes[0], codes[-1] = Path.MOVETO, Path.CLOSEPOLY
    return points, codes


def path_of(geometry):
    """A (multi)polygon with its holes as one compound path."""
    points, codes = [], []
    for polygon in getattr(geometry, "geoms", [geometry]):
        for ring in (polygon.exterior, *polygon.interiors):
            ring_points, ring_codes = _ring_path(ring)
            points.append(ring_points)
            codes.append(ring_codes)
    return Path(numpy.concatenate(points), numpy.concatenate(codes))


class Layout:
    """The layers of one data set as paths, made once for all maps."""

    def __init__(self, layers):
        self.layers = layers
        self.paths = {name: [path_of(g) for g in frame.geometry] for name, frame in layers.items()}
        self.boxes = {name: numpy.array([p.get_extents().extents for p in paths])
                      for name, paths in self.paths.items()}
        low, high = self.boxes["blocks"][:, :2].min(axis=0), self.boxes["blocks"][:, 2:].max(axis=0)
        self.bounds = numpy.concatenate([low, high])

    def zoom(self):
        """The neighbourhood of ZOOM_BLOCKS blocks with most observed parcels per area."""
        blocks = self.layers["blocks"]
        if len(blocks) <= ZOOM_BLOCKS:
            return None
        # Bounds serve as centres: the order must not hang on how a library finds centroids.
        bounds = self.boxes["blocks"]
        centres = 0.5 * (bounds[:, :2] + bounds[:, 2:])
        counts = self.layers[OBSERVED]["block_id"].value_counts()
        parcels = blocks["block_id"].map(counts).fillna(0).to_numpy()
        best, best_density = None, -1.0
        for centre in centres:
            near = numpy.argsort(((centres - centre) ** 2).sum(axis=1), kind="stable")[:ZOOM_BLOCKS]
            low, high = bounds[near, :2].min(axis=0), bounds[near, 2:].max(axis=0)
            density = parcels[near].sum() / max(1.0, float(numpy.prod(high - low)))
            if density > best_density:
                best, best_density = (low, high), density
        low, high = best
        middle, size = 0.5 * (low + high), high - low
        # The shape of a panel, cut from the neighbourhood rather than padded.
        width = min(size[0], size[1] * ZOOM_SHAPE)
        half = 0.5 * numpy.array([width, width / ZOOM_SHAPE])
        return numpy.concatenate([middle - half, middle + half])

    def draw(self, axes, layer, colouring, bounds, edge_width):
        inside = self._near(layer, bounds)
        paths = [self.paths[layer][i] for i in inside]
        collection = PathCollection(paths, linewidths=edge_width, edgecolors="#333333", rasterized=True)
        collection.set_facecolor(colouring.cmap(colouring.norm(
            self.layers[layer][colouring.measure].to_numpy()[inside].astype(float))))
        self._add(axes, collection, bounds)

    def draw_blocks(self, axes, bounds, width):
        paths = [self.paths["blocks"][i] for i in self._near("blocks", bounds)]
        self._add(axes, PathCollection(paths, linewidths=width, edgecolors="#000000", facecolors="none",
                                       rasterized=True), bounds)

    def _add(self, axes, collection, bounds):
        """Cut at the bounds, so that the strip of the scale bar stays free."""
        # The axes have their limits already; measuring every path for the layout would cost seconds.
        collection.set_in_layout(False)
        axes.add_collection(collection, autolim=False)
        if not numpy.array_equal(bounds, self.bounds):
            collection.set_clip_path(Rectangle(bounds[:2], *(bounds[2:] - bounds[:2]), transform=axes.transData))

    def _near(self, layer, bounds):
        own = self.boxes[layer]
        is_near = ((own[:, 0] <= bounds[2]) & (own[:, 2] >= bounds[0]) &
                   (own[:, 1] <= bounds[3]) & (own[:, 3] >= bounds[1]))
        return numpy.flatnonzero(is_near)


def _room_below(bounds):
    """For the scale bar, also under flat panels."""
    return 0.1 * max(bounds[3] - bounds[1], 0.7 * (bounds[2] - bounds[0]))


def add_scale_bar(axes, bounds):
    """A bar of 1, 2 or 5 times a power of ten, about a fifth of the width."""
    wanted = 0.2 * (bounds[2] - bounds[0])
    power = 10.0 ** math.floor(math.log10(wanted))
    length = max(f * power for f in (1.0, 2.0, 5.0) if f * power <= wanted)
    x, y = bounds[0], bounds[1] - 0.5 * _room_below(bounds)
    axes.plot([x, x + length], [y, y], color="black", linewidth=2.5, solid_capstyle="butt", clip_on=False)
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    axes.text(x + 1.08 * length, y, text, va="center", ha="left", fontsize=8, clip_on=False)


def frame_axes(axes, bounds):
    width, height = bounds[2] - bounds[0], bounds[3] - bounds[1]
    axes.set_xlim(bounds[0] - 0.01 * width, bounds[2] + 0.01 * width)
    axes.set_ylim(bounds[1] - _room_below(bounds), bounds[3] + 0.01 * height)
    axes.set_aspect("equal")
    axes.set_axis_off()


def draw_map(figures, run, dataset, layout, measure, bounds, name, scope):
    """One panel per layer; `scope` says what part is shown."""
    layers = [OBSERVED, *run.strategies]
    columns = 2 if len(layers) <= 4 else 3
    rows = math.ceil(len(layers) / columns)
    shape = (bounds[3] - bounds[1]) / (bounds[2] - bounds[0])
    panel = 5.2 if columns == 2 else 3.9
    height = min(max(panel * shape, 2.2), 7.0)
    figure, grid = plt.subplots(rows, columns, figsize=(columns * panel + 1.0, rows * (height + 0.35) + 0.6),
                                layout="constrained", squeeze=False)
    figure.get_layout_engine().set(w_pad=0.12)
    is_zoom = scope != "all blocks"
    colouring = Colouring(measure, layout.layers[OBSERVED])
    for axes, layer in zip(grid.flat, layers):
        frame_axes(axes, bounds)
        count = len(layout.layers[layer]) if layer in layout.layers else 0
        axes.set_title(f"{layer_word(dataset, layer)} ({count:,} in all)")
        if count:
            layout.draw(axes, layer, colouring, bounds, 0.4 if is_zoom else 0.08)
        else:
            axes.text(0.5, 0.5, "no parcels", transform=axes.transAxes, ha="center", color="#777777")
        layout.draw_blocks(axes, bounds, 0.9 if is_zoom else 0.15)
        add_scale_bar(axes, bounds)
    for axes in list(grid.flat)[len(layers):]:
        axes.set_axis_off()
    mappable = ScalarMappable(colouring.norm, colouring.cmap)
    bar = figure.colorbar(mappable, ax=grid, shrink=0.5, aspect=30, extend=colouring.extend, pad=0.02)
    bar.set_label(title_of(measure))
    label_colour_bar(bar, colouring)
    figure.suptitle(f"{short_title(dataset)}: {name_of(measure)}, {plots_word(dataset)} and strategies, {scope}")
    figures.save(figure, name)


def label_colour_bar(bar, colouring):
    if colouring.measure == "neighbours":
        ticks = [int(b + 0.5) for b in colouring.norm.boundaries[:-1]]
    elif colouring.measure == "area_m2":
        low, high = colouring.norm.vmin, colouring.norm.vmax
        # As few round numbers as label the bar, more of them where its range is short.
        for factors in ((1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 4, 5, 7), [f / 10 for f in range(10, 100, 5)]):
            ticks = [f * 10.0 ** p for p in range(-3, 8) for f in factors if low <= f * 10.0 ** p <= high]
            if len(ticks) >= 3:
                break
    else:
        return
    bar.set_ticks(ticks)
    bar.set_ticklabels([f"{t:,.10g}" for t in ticks])
    bar.minorticks_off()


def draw_maps(figures, run, dataset, layout):
    """Names of the figures, whole place first."""
    names = []
    for scope, key, bounds in (("all blocks", "map", layout.bounds), ("a neighbourhood", "zoom", layout.zoom())):
        if bounds is None:
            continue
        for measure in MAP_MEASURES:
            name = f"{key}_{measure}_{dataset['name']}"
            draw_map(figures, run, dataset, layout, measure, bounds, name, scope)
            names.append(name)
    return names
