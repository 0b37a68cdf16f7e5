"""The blocks where a strategy comes out worst, beside what is there."""

import matplotlib.pyplot as plt

from maps import frame_axes, path_of
from matplotlib.collections import PathCollection
from run_data import OBSERVED, plots_word
from style import Colouring

WORST = 6
#: A KS statistic of a block with fewer parcels says little.
LEAST_PARCELS = 4


def worst_blocks(run, dataset, strategy):
    """Rows of blocks.csv of the first repetition, largest ks_area first, ties by block id."""
    rows = run.of("blocks", dataset)
    rows = rows[(rows["layer"] == strategy) & (rows["status"] == "ok") & rows["ks_area"].notna()]
    rows = rows[rows["repetition"] == rows["repetition"].min()]
    if "observed_parcels" in rows.columns:
        enough = rows[rows["observed_parcels"] >= LEAST_PARCELS]
        rows = enough if len(enough) else rows
    return rows.sort_values(["ks_area", "block_id"], ascending=[False, True], kind="stable").head(WORST)


def draw_gallery(figures, run, dataset, layout, strategy):
    """The figure's name, or None where there is nothing to show."""
    rows = worst_blocks(run, dataset, strategy)
    if rows.empty or strategy not in layout.layers:
        return None
    colouring = Colouring("aspect_ratio", layout.layers[OBSERVED])
    outlines = layout.layers["blocks"].set_index("block_id").geometry
    # Pairs side by side: observed left, strategy right, two pairs a row.
    pair_rows = (len(rows) + 1) // 2
    figure, grid = plt.subplots(pair_rows, 4, figsize=(11.0, 2.7 * pair_rows + 0.6), layout="constrained",
                                squeeze=False)
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
            word = plots_word(dataset) if side == 0 else strategy
            detail = f"block {row.block_id}" if side == 0 else f"KS of area {row.ks_area:.2f}"
            axes.set_title(f"{word}: {len(own)}\n{detail}", fontsize=8)
    figure.suptitle(f"{dataset['title']}: the {len(rows)} blocks where {strategy} is farthest from the "
                    f"{plots_word(dataset)}")
    name = f"worst_{strategy}_{dataset['name']}"
    figures.save(figure, name)
    return name
