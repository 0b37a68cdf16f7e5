"""Panels that several figures share: maps in the paper's colours, histograms, lettering, captions."""

import textwrap

import numpy
from figure import REPORT  # noqa: F401  (puts the report's folder on the path)

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.collections import LineCollection, PathCollection  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

from distributions import draw_superposed  # noqa: E402
from maps import Layout, add_scale_bar, frame_axes, label_colour_bar, path_of  # noqa: E402
from places import GENERATED, OBSERVED  # noqa: E402
from style import GENERATED_BLUE, OBSERVED_RED, Colouring, title_of  # noqa: E402

#: Parcels one can tell apart without a meaning: pale, so that lines stay readable (fig. 4, 5, 7).
PALE = ["#8dd3c7", "#ffed8a", "#bebada", "#fb9a8f", "#80b1d3", "#fdb462", "#b3de69", "#fccde5", "#bc80bd", "#ccebc5"]
LAND, INK, GREY = "#f2efe9", "#222222", "#777777"
CAPTION_INCHES = 0.145


def sheet(rows, columns, width, height, **how):
    """A figure whose foot is left free for the caption."""
    return plt.subplots(rows, columns, figsize=(width, height), layout="constrained", squeeze=False, **how)


def caption(picture, figure, extra=""):
    """Under the panels: the paper's figure, what stands in for what, whose data."""
    width, height = picture.get_size_inches()
    entry = figure.entry
    text = (f"After {entry['paper']}, figure {entry['figure']}. {entry['caption']} {entry['stands_in']} {extra}").strip()
    lines = textwrap.wrap(text, int(width * 17.5))
    if figure.sources:
        lines += textwrap.wrap("Data: " + figure.attribution(), int(width * 17.5))
    room = (len(lines) * CAPTION_INCHES + 0.1) / height
    picture.get_layout_engine().set(rect=(0.0, room, 1.0, 1.0 - room))
    picture.text(0.012, 0.06 / height, "\n".join(lines), fontsize=7.2, color="#333333", va="bottom", linespacing=1.25)


def letter(axes, key, text):
    axes.set_title(f"({key}) {text}", loc="left", fontsize=9)


def bounds_of(frame, margin=0.01):
    low_x, low_y, high_x, high_y = frame.total_bounds
    pad = margin * max(high_x - low_x, high_y - low_y)
    return numpy.array([low_x - pad, low_y - pad, high_x + pad, high_y + pad])


def open_map(axes, bounds, scale=True):
    frame_axes(axes, bounds)
    if scale:
        add_scale_bar(axes, bounds)


def fill(axes, frame, faces="none", edges=INK, width=0.4, **how):
    """Polygons of a frame. `faces` is one colour or one per feature."""
    paths = [path_of(g) for g in frame.geometry]
    collection = PathCollection(paths, linewidths=width, edgecolors=edges, facecolors=faces, **how)
    collection.set_in_layout(False)
    axes.add_collection(collection, autolim=False)
    return collection


def lines(axes, frame, colour, width=1.0, **how):
    """Line features of a frame."""
    parts = [numpy.asarray(part.coords)[:, :2] for g in frame.geometry for part in getattr(g, "geoms", [g])]
    collection = LineCollection(parts, colors=colour, linewidths=width, **how)
    collection.set_in_layout(False)
    axes.add_collection(collection, autolim=False)


def pale_faces(frame):
    """A colour per parcel, by its number."""
    return [PALE[i % len(PALE)] for i in range(len(frame))]


class MeasureMaps:
    """The observed and the procedural parcels of a comparison by one measure, in the same colours."""

    def __init__(self, comparison, measure):
        self.measure = measure
        self.layout = Layout(comparison.layers)
        self.colouring = Colouring(measure, comparison.layers[OBSERVED])
        self.bounds = self.layout.bounds

    def draw(self, axes, layer, scale=True, width=0.35):
        open_map(axes, self.bounds, scale)
        self.layout.draw(axes, layer, self.colouring, self.bounds, width)
        self.layout.draw_blocks(axes, self.bounds, 0.8)

    def colour_bar(self, picture, axes, **how):
        how = {"shrink": 0.7, "aspect": 30, "pad": 0.02, **how}
        bar = picture.colorbar(ScalarMappable(self.colouring.norm, self.colouring.cmap), ax=axes,
                               extend=self.colouring.extend, **how)
        bar.set_label(title_of(self.measure))
        label_colour_bar(bar, self.colouring)


def draw_statistics_map(axes, comparison, layer=OBSERVED, font=6.0):
    """Black and white; on each block the four statistics that its options are fitted to [VKW12, Sec. 6 (ii)]."""
    blocks = comparison.layers["blocks"]
    open_map(axes, bounds_of(blocks))
    fill(axes, comparison.layers[layer], "white", "#999999", 0.3)
    fill(axes, blocks, "none", "black", 0.8)
    of_block = comparison.layers[layer].groupby("block_id")
    area, width = of_block["area_m2"], of_block["width_m"]
    table = {b: (area.mean()[b], area.std()[b], width.mean()[b], width.std()[b]) for b in of_block.groups}
    for block, shape in zip(blocks["block_id"], blocks.geometry):
        if block not in table:
            continue
        values = ["–" if numpy.isnan(v) else f"{v:.0f}" if i < 2 else f"{v:.1f}" for i, v in enumerate(table[block])]
        at = shape.representative_point()
        axes.text(at.x, at.y, "{}±{}\n{}±{}".format(*values), fontsize=font, ha="center", va="center", linespacing=1.0,
                  bbox={"boxstyle": "square,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.8})


def draw_histogram(axes, comparison, measure):
    """Observed red, procedural blue, superposed, not normalised."""
    draw_superposed(axes, comparison.histograms, measure, GENERATED, 1)


def histogram_legend(axes):
    axes.legend(handles=[Patch(color=OBSERVED_RED, alpha=0.45, label="observed"),
                         Patch(color=GENERATED_BLUE, alpha=0.45, label="procedural")], fontsize=7.5, loc="upper right")
