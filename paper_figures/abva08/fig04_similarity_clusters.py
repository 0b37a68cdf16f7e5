"""ABVA08, figure 4: the tiles of a part of a city in clusters mostly by area, and mostly by shape."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import numpy  # noqa: E402
from figure import make  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402
from drawing import INK, bounds_of, caption, fill, letter, open_map, sheet  # noqa: E402
from places import Place, Window, layer  # noqa: E402

WINDOW = Window("cambridge_ma", 232200.0, 901200.0, 233000.0, 902000.0, "Cambridgeport: small lots and large plots side by side")
#: Clusters, per cent of the tiles: about ten, so that colours can be told apart.
PERCENT = 1.0
#: One weight far above the others. A weight is per unit: log area, corner, radian.
MOSTLY = {"area": {"area_weight": 3.0, "corner_count_weight": 0.05, "mean_angle_weight": 0.2, "angle_deviation_weight": 0.2},
          "shape": {"area_weight": 0.1, "corner_count_weight": 0.5, "mean_angle_weight": 2.0, "angle_deviation_weight": 4.0}}
#: What turns by less is no corner, as in docs/measures.md.
CORNER_TURN_DEG = 10.0
COLOURS = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725", "#f98e09", "#d8576b", "#8f0da4", "#b5cde3", "#8c564b",
           "#777777", "#17becf"]


def angles_of(shape):
    """Interior angles at the corners of a polygon's outline, radians."""
    ring = numpy.asarray(shape.exterior.coords)[:-1]
    if shape.exterior.is_ccw is False:
        ring = ring[::-1]
    before, after = ring - numpy.roll(ring, 1, axis=0), numpy.roll(ring, -1, axis=0) - ring
    turn = numpy.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
    return numpy.pi - turn[numpy.abs(turn) > numpy.radians(CORNER_TURN_DEG)]


def explained(values, clusters):
    """Share of the variance of a measure that lies between clusters (eta squared)."""
    values = numpy.asarray(values, dtype=float)
    within = sum(((values[clusters == k] - values[clusters == k].mean()) ** 2).sum() for k in numpy.unique(clusters))
    return 1.0 - within / ((values - values.mean()) ** 2).sum()


def clustered(figure, place, name):
    """The tiles as `plat similarity` put them into clusters."""
    out = figure.path(f"{name}.gpkg")
    weights = [word for key, value in MOSTLY[name].items() for word in ("--clusters", f"{key}={value}")]
    figure.plat("similarity", "--tiles", place.file, "--clusters", f"percent={PERCENT}", "--clusters", "zone_weight=0", *weights,
                "--measure", "affine_vertex", "--nearest", 1, "--out", out)
    return out


def polygons(frame):
    """The larger part of what is a multi-polygon."""
    return [max(getattr(g, "geoms", [g]), key=lambda part: part.area) for g in frame.geometry]


def draw(figure):
    place = Place(figure, WINDOW)
    picture, (panels,) = sheet(1, 2, 13.0, 7.4)
    found = {}
    pairs = same = 0
    for axes, key, name in zip(panels, "ab", ("area", "shape")):
        out = clustered(figure, place, name)
        tiles = layer(out, "tiles")
        angles = [angles_of(g) for g in polygons(tiles)]
        measures = {"area": numpy.log(tiles.geometry.area), "corners": numpy.array([len(a) for a in angles]),
                    "deviation": numpy.array([a.std() if len(a) else 0.0 for a in angles])}
        clusters = tiles["cluster"].to_numpy()
        share = {m: explained(v, clusters) for m, v in measures.items()}
        found[name] = {"area": share["area"], "shape": 0.5 * (share["corners"] + share["deviation"])}
        # Colours run with what the clusters are by.
        by = measures["area" if name == "area" else "deviation"]
        order = sorted(numpy.unique(clusters), key=lambda k: by[clusters == k].mean())
        colour = {k: COLOURS[i * len(COLOURS) // len(order)] if len(order) > len(COLOURS) else COLOURS[i]
                  for i, k in enumerate(order)}
        open_map(axes, bounds_of(tiles, 0.02), scale=key == "a")
        letter(axes, key, f"{len(order)} clusters mostly by {name}")
        fill(axes, tiles, [colour[k] for k in clusters], INK, 0.25)
        text = "{:.0f} m²" if name == "area" else "{:.2f} rad"
        typical = [numpy.exp(by[clusters == k].mean()) if name == "area" else by[clusters == k].mean() for k in order]
        axes.legend(handles=[Patch(color=colour[k], label=f"{text.format(v)} ({(clusters == k).sum()})")
                             for k, v in zip(order, typical)], fontsize=7, ncols=5, loc="upper center",
                    bbox_to_anchor=(0.5, 0.0), title_fontsize=7.5,
                    title="mean area (tiles)" if name == "area" else "mean deviation of interior angles (tiles)")
        of = dict(zip(tiles["source_id"], tiles["cluster"]))
        for own, nearest in zip(tiles["cluster"], tiles["nearest_1"]):
            if isinstance(nearest, str):
                pairs, same = pairs + 1, same + (of[nearest] == own)
    caption(picture, figure)
    figure.save(picture)
    note = f"{len(tiles)} tiles"
    figure.measured("by_area", found["area"]["area"], note)
    figure.measured("area_before_shape", found["area"]["area"] - found["area"]["shape"], f"shape {found['area']['shape']:.3f}")
    figure.measured("by_shape", found["shape"]["shape"], note)
    figure.measured("shape_before_area", found["shape"]["shape"] - found["shape"]["area"], f"area {found['shape']['area']:.3f}")
    figure.measured("within", same / pairs, f"{pairs} tiles and their nearest")


if __name__ == "__main__":
    sys.exit(make("abva08/fig04", draw))
