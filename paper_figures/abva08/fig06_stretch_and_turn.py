"""ABVA08, figure 6: a layout divided, displaced outwards and reassembled with a stretch; parts turned around a square."""

import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from displaced_tiles import Shown, blocks_of, box_aspect, rank_correlation, turns_deg  # noqa: E402
from drawing import INK, PALE, bounds_of, caption, fill, letter, open_map, plt, sheet  # noqa: E402
from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402

CITY = {"dataset": "cambridge_ma", "tiles": 2000, "near_m": [230900.0, 902850.0]}
#: By how much the middles of the parts are displaced outwards, of their distance from the middle of the layout.
STRETCH = 0.1
PARTS, CORE_TILES = 3, 6
KEPT = 0.05
APART = {"name": "apart", "by": "none"}
TOGETHER = {"name": "together", "options": {"rigidity": 100, "keep_size": 1, "street_weight": 0.05}}
SQUARE = [573840.0, 6137085.0]
TURNED_M, FREE_M = 160.0, 600.0
TURNS_DEG = [6.0, 12.0]


def parts_of(bounds):
    """The boxes of a grid over the layout, each with what displaces it."""
    low, high = bounds[:2], bounds[2:]
    side = (high - low) / PARTS
    middle = (low + high) / 2
    for i in range(PARTS):
        for j in range(PARTS):
            corner = low + side * (i, j)
            shift = STRETCH * (corner + side / 2 - middle)
            yield {"where": {"box_m": [corner.tolist(), (corner + side).tolist()]}, "shift_m": shift.tolist()}


def stretched(figure):
    first = Shown(figure, "stretch_original", {"city": CITY})
    pieces = list(parts_of(first.tiles().total_bounds))
    apart = Shown(figure, "stretch_apart", {"city": CITY, "pieces": pieces, "ways": [APART]})
    cores = [{**piece, "held_tiles": CORE_TILES} for piece in pieces]
    return apart, Shown(figure, "stretch_together", {"city": CITY, "pieces": cores, "ways": [TOGETHER]})


def turned(figure, turn_deg):
    city = {"dataset": "montevideo_uy", "tiles": 400, "near_m": SQUARE}
    piece = {"where": {"center_m": SQUARE, "to_m": TURNED_M}, "turn_deg": turn_deg}
    way = {"name": "turned", "options": {"rigidity": 10, "keep_size": 1}}
    return Shown(figure, f"turn_{turn_deg:g}", {"city": city, "pieces": [piece], "ways": [way],
                                                "held": [{"center_m": SQUARE, "from_m": FREE_M}]})


def turned_around(before, after):
    """By how much each tile has gone around the square, degrees."""
    old, new = ((t.geometry.centroid.x - SQUARE[0]) + 1j * (t.geometry.centroid.y - SQUARE[1]) for t in (before, after))
    return numpy.degrees(numpy.angle((new / old).to_numpy()))


def coloured(picture, axes, tiles, values, scale, colours, name, bounds):
    open_map(axes, bounds)
    fill(axes, tiles, plt.get_cmap(colours)(scale(numpy.clip(values, scale.vmin, scale.vmax))), INK, 0.2)
    bar = picture.colorbar(ScalarMappable(scale, plt.get_cmap(colours)), ax=axes, shrink=0.6, aspect=30, pad=0.01, extend="both")
    bar.set_label(name)


def draw(figure):
    apart, together = stretched(figure)
    observed, closed = together.tiles(), together.tiles("together_closed")
    before, after = blocks_of(observed), blocks_of(closed)
    sizes = {b: float(numpy.sqrt(after[b].area / before[b].area)) for b in before}
    aspects = {b: box_aspect(after[b]) / box_aspect(before[b]) for b in before}
    turns = [turned(figure, turn) for turn in TURNS_DEG]

    picture, ((a, b, c), (d, e, f)) = sheet(2, 3, 17.0, 12.6)
    bounds = bounds_of(apart.tiles("apart"), 0.02)
    for axes, key, tiles, text in ((a, "a", observed, f"{len(observed)} tiles"), (b, "b", apart.tiles("apart"), "divided and displaced")):
        open_map(axes, bounds)
        fill(axes, tiles, [PALE[int(i) % len(PALE)] for i in tiles["block"]], INK, 0.2)
        letter(axes, key, text)
    coloured(picture, c, closed, closed["block"].map(sizes), Normalize(0.9, 1.1), "RdBu_r", "size of the block, against before",
             bounds)
    fill(c, closed[closed["role"] == "moved"], "none", "black", 1.0)
    letter(c, "c", "reassembled; black: held")
    square = turns[0].tiles()
    window = bounds_of(square[square["role"] != "held"], 0.05)
    open_map(d, window)
    fill(d, square, [PALE[i % len(PALE)] for i in range(len(square))], INK, 0.3)
    letter(d, "d", f"{len(square)} blocks around a square")
    for axes, key, turn, shown in zip((e, f), "ef", TURNS_DEG, turns):
        tiles = shown.tiles("turned")
        coloured(picture, axes, tiles, turned_around(square, tiles), Normalize(-max(TURNS_DEG), max(TURNS_DEG)), "PuOr",
                 "gone around the square, degrees", window)
        fill(axes, tiles[tiles["role"] == "moved"], "none", "black", 1.0)
        letter(axes, key, f"turned by {turn:g} degrees; black: held")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, observed, closed, together, (sizes, aspects), turns)


def measure_claims(figure, observed, closed, together, changes, turns):
    old, new = (t.total_bounds[2:] - t.total_bounds[:2] for t in (observed, closed))
    errors = together.errors("together")
    figure.measured("stretched", (new / old).min(), f"width {new[0] / old[0]:.3f}, height {new[1] / old[1]:.3f}")
    figure.measured("reassembled", errors["property_gap_m"],
                    f"across streets {errors['street_gap_m']:.2f} m; deformation {errors['deformation']:.4f}")
    for key, values in zip(("size_kept", "aspect_kept"), changes):
        change = numpy.abs(numpy.array(list(values.values())) - 1.0)
        figure.measured(key, (change <= KEPT).mean(), f"{len(change)} blocks, median {numpy.median(change):.3f}, "
                        f"95 % below {numpy.quantile(change, 0.95):.3f}")
    tiles, placed = turns[-1].tiles(), turns[-1].tiles("turned")
    free = (tiles["role"] == "free").to_numpy()
    middles = tiles.geometry.centroid
    away = numpy.hypot(middles.x - SQUARE[0], middles.y - SQUARE[1])[free]
    figure.measured("turned", rank_correlation(turned_around(tiles, placed)[free], away),
                    f"{int(free.sum())} blocks; of their turn about themselves {rank_correlation(turns_deg(placed)[free], away):.2f}")
    figure.measured("turn_deforms_little", turns[-1].errors("turned")["deformation"],
                    f"across streets {turns[-1].errors('turned')['street_gap_m']:.2f} m")


if __name__ == "__main__":
    sys.exit(make("abva08/fig06", draw))
