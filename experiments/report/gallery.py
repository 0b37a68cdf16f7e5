"""The blocks where a strategy comes out worst, beside what is there."""

import matplotlib.pyplot as plt

from maps import add_scale_bar, frame_axes, path_of
from matplotlib.collections import PathCollection
from run_data import OBSERVED, plots_word, short_title
from style import Colouring

WORST = 6
#: More blocks than this go on to another figure.
PER_FIGURE = 10
#: A KS statistic of a block with fewer parcels says little.
LEAST_PARCELS = 4
PANEL_WIDTH = 2.7


def worst_blocks(run, dataset, strategy, count):
    """At most `count` rows of blocks.csv of the first repetition, largest ks_area first, ties by number of parcels,
    then block id."""
    rows = run.of("blocks", dataset)
    rows = rows[(rows["layer"] == strategy) & (rows["status"] == "ok") & rows["ks_area"].notna()]
    rows = rows[rows["repetition"] == rows["repetition"].min()]
    enough = rows[rows["observed_parcels"] >= LEAST_PARCELS]
    rows = enough if len(enough) else rows
    return rows.sort_values(["ks_area", "observed_parcels", "block_id"], ascending=[False, False, True],
                            kind="stable").head(count)


def _shape_of(outline):
    """Height by width, within what a panel can show."""
    west, south, east, north = outline.bounds
    return min(1.6, max(0.25, (north - south) / max(east - west, 1e-6)))


def draw_gallery(figures, run, dataset, layout, strategy, count=WORST):
    """The names of the figures, none where there is nothing to show."""
    rows = worst_blocks(run, dataset, strategy, count)
    if rows.empty or strategy not in layout.layers:
        return []
    names = []
    for first in range(0, len(rows), PER_FIGURE):
        names.append(f"worst_{strategy}_{dataset['name']}" + (f"_{first // PER_FIGURE + 1}" if first else ""))
        title = (f"{short_title(dataset)}: the {len(rows)} blocks where {strategy} is farthest from the "
                 f"{plots_word(dataset)}" + (f", from {first + 1}" if first else ""))
        figures.save(_draw_pairs(dataset, layout, strategy, rows.iloc[first:first + PER_FIGURE], title), names[-1])
    return names


def _draw_pairs(dataset, layout, strategy, rows, title):
    colouring = Colouring("aspect_ratio", layout.layers[OBSERVED])
    outlines = layout.layers["blocks"].set_index("block_id").geometry
    # Pairs side by side: observed left, strategy right, two pairs a row.
    shapes = [_shape_of(outlines[b]) for b in rows["block_id"]]
    heights = [PANEL_WIDTH * max(shapes[i:i + 2]) + 0.6 for i in range(0, len(shapes), 2)]
    figure, grid = plt.subplots(len(heights), 4, figsize=(4 * PANEL_WIDTH + 0.6, sum(heights) + 0.5),
                                layout="constrained", squeeze=False, gridspec_kw={"height_ratios": heights})
    figure.get_layout_engine().set(w_pad=0.1)
    for axes in grid.flat:
        axes.set_axis_off()
    for i, row in enumerate(rows.itertuples()):
        outline = outlines[row.block_id]
        for side, layer in enumerate((OBSERVED, strategy)):
            axes = grid[i // 2][2 * (i % 2) + side]
            frame = layout.layers[layer]
            own = frame[frame["block_id"] == row.block_id]
            if len(own):
                collection = PathCollection([path_of(g) for g in own.geometry], linewidths=0.5, edgecolors="#333333",
                                            rasterized=True)
                collection.set_facecolor(colouring.cmap(colouring.norm(own["aspect_ratio"].to_numpy(dtype=float))))
                axes.add_collection(collection)
            axes.add_collection(PathCollection([path_of(outline)], linewidths=1.1, edgecolors="black",
                                               facecolors="none", rasterized=True))
            frame_axes(axes, outline.bounds)
            axes.set_anchor("N")
            if side == 0:
                add_scale_bar(axes, outline.bounds)
            word = plots_word(dataset) if side == 0 else strategy
            detail = f"block {row.block_id}" if side == 0 else f"KS of area {row.ks_area:.2f}"
            axes.set_title(f"{word}: {len(own)}\n{detail}", fontsize=8)
    figure.suptitle(title)
    return figure
