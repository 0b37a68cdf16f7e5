"""VKW12, figure 9: one attribute at a time, on one block; measured on all blocks of its neighbourhood."""

import pathlib
import sys

import geopandas
import numpy
from shapely.geometry import Point

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, bounds_of, caption, fill, letter, open_map, sheet  # noqa: E402
from places import Place, Window, layer, subdivide  # noqa: E402

HURON = Window("cambridge_ma", 229290.0, 902930.0, 230080.0, 903700.0,
               "blocks of many sizes, most with four sides, so that one attribute meets many shapes")
#: The block that is drawn: nearly rectangular, and wide enough for an interior, by a point in it.
DRAWN = (229910.0, 903350.0)
LARGEST_BLOCK_M2 = 80000.0
SEEDS = 8
LONG_WIDTH_M, SHORT_WIDTH_M = 24.0, 8.0

OBB = {"area_min_m2": 500, "area_max_m2": 900, "width_min_m": 6, "width_max_m": 8, "irregularity": 0.1}
SKELETON = {"area_min_m2": 200, "area_max_m2": 2000, "width_min_m": 16, "width_max_m": 24, "irregularity": 0.1,
            "corners": "street_length"}
#: Panel -> strategy and what differs from the settings above; pairs belong together.
VARIATIONS = {
    "a1": ("obb", {"area_min_m2": 650, "area_max_m2": 750, "irregularity": 0.6}, "(a) 650 < A < 750 m²"),
    "a2": ("obb", {"area_min_m2": 100, "area_max_m2": 1300, "irregularity": 0.6}, "(a) 100 < A < 1300 m²"),
    "b1": ("obb", {"street_access": 0}, "(b) ξ = 0"),
    "b2": ("obb", {"street_access": 1}, "(b) ξ = 1"),
    "c1": ("skeleton", {"width_min_m": 8, "width_max_m": 12, "area_min_m2": 50, "area_max_m2": 1000}, "(c) lots 10 m wide"),
    "c2": ("skeleton", {"width_min_m": 28, "width_max_m": 32}, "(c) lots 30 m wide"),
    "d1": ("skeleton", {"corners": "street_width"}, "(d) long sides' streets wide"),
    "d2": ("skeleton", {"corners": "street_width"}, "(d) short sides' streets wide"),
    "e1": ("skeleton", {"area_min_m2": 0}, "(e) A_min = 0"),
    "e2": ("skeleton", {"area_min_m2": 800, "area_max_m2": 4000}, "(e) A_min = 800 m²"),
    "f1": ("skeleton", {"offset_m": "none"}, "(f) d_offset = ∞"),
    "f2": ("skeleton", {"offset_m": 28}, "(f) d_offset = 28 m"),
    "g1": ("skeleton", {"irregularity": 0}, "(g) ω = 0"),
    "g2": ("skeleton", {"irregularity": 1}, "(g) ω = 1"),
    "g3": ("skeleton", {"offset_m": 28, "inner": "obb"}, "(g) patio by OBB"),
    "g4": ("skeleton", {"offset_m": 28, "inner": "skeleton"}, "(g) patio by skeleton"),
}


def side_of(line, block):
    """Whether a line runs along the longer sides of a block's rectangle."""
    ring = numpy.asarray(block.minimum_rotated_rectangle.exterior.coords)[:3, :2]
    sides = numpy.diff(ring, axis=0)
    longer = sides[numpy.linalg.norm(sides, axis=1).argmax()]
    (ax, ay), (bx, by) = line.coords[0][:2], line.coords[-1][:2]
    way = numpy.array([bx - ax, by - ay])
    return abs(way @ longer) > 0.7071 * numpy.linalg.norm(way) * numpy.linalg.norm(longer)


def street_layer(figure, block, long_width, short_width, name):
    """The streets with widths set by hand: the user's edit of figure 9 d."""
    streets = layer(figure.path("blocks.gpkg"), "streets")
    widths = [long_width if side_of(line, block) else short_width for line in streets.geometry]
    out = figure.path(f"{name}.gpkg")
    geopandas.GeoDataFrame({"name": streets["name"], "width": widths}, geometry=streets.geometry,
                           crs=streets.crs).to_file(out, layer="streets", driver="GPKG")
    return f"{out}:streets"


def frontage_on_short_sides(parcels, block):
    """Number of parcels whose longer front lies on a short side of the block."""
    count = 0
    for parcel in parcels.geometry:
        front = parcel.boundary.intersection(block.boundary.buffer(0.05))
        lengths = {True: 0.0, False: 0.0}
        for part in getattr(front, "geoms", [front]):
            points = list(part.coords) if part.geom_type == "LineString" else []
            for a, b in zip(points, points[1:]):
                edge = type(part)([a, b])
                lengths[bool(side_of(edge, block))] += edge.length
        count += lengths[False] > lengths[True]
    return count


def draw(figure):
    place = Place(figure, HURON, keep=lambda block: block.area < LARGEST_BLOCK_M2)
    block = next(b for b in place.blocks.geometry if b.contains(Point(DRAWN)))
    files = {}
    for key, (strategy, changed, _) in VARIATIONS.items():
        streets = place.streets
        if key in ("d1", "d2"):
            widths = (LONG_WIDTH_M, SHORT_WIDTH_M) if key == "d1" else (SHORT_WIDTH_M, LONG_WIDTH_M)
            streets = street_layer(figure, block, *widths, f"streets_{key}")
        settings = {**(OBB if strategy == "obb" else SKELETON), **changed}
        files[key] = subdivide(figure, key, f"{place.file}:blocks", strategy, settings, streets=streets)
    parcels = {key: layer(file, "parcels") for key, file in files.items()}
    on_block = {key: frame[frame.representative_point().within(block)] for key, frame in parcels.items()}

    picture, grid = sheet(2, 8, 17.0, 8.2)
    bounds = bounds_of(geopandas.GeoSeries([block]), 0.02)
    for axes, (key, (_, _, text)) in zip(grid.flat, VARIATIONS.items()):
        open_map(axes, bounds, scale=key == "a1")
        frame = on_block[key]
        inner = (frame["has_street_access"] == 0).to_numpy()
        fill(axes, frame, ["#f7c59f" if i else "#dfe9d5" for i in inner], INK, 0.6)
        fill(axes, geopandas.GeoDataFrame(geometry=[block]), "none", "black", 1.3)
        axes.set_title(f"{text}\n{len(frame)} parcels", loc="left", fontsize=8.5)
    caption(picture, figure, "Orange: no street access. Counts are of the block drawn; claims are measured on all "
            f"{len(place.blocks)} blocks around it, (d) on the block drawn.")
    figure.save(picture)
    # "Generally" is a word about many divisions: omega spreads lots of 20 m by 1.7 m, less than two corner lots differ.
    repeated = {key: [layer(place.subdivide("skeleton", f"{key}_{seed}", fit=False, seed=seed,
                                            **{**SKELETON, **VARIATIONS[key][1]}), "parcels")
                      for seed in range(1, SEEDS + 1)] for key in ("g1", "g2")}
    measure_claims(figure, parcels, repeated, on_block, block)


def relative_variance(frame):
    """Of the areas in a block, as a share of the squared mean, and the mean of that over blocks."""
    areas = frame.groupby("block_id")["area_m2"]
    return float(((areas.std() / areas.mean()) ** 2).mean())


def measure_claims(figure, parcels, repeated, on_block, block):
    a1, a2 = (relative_variance(parcels[k]) for k in ("a1", "a2"))
    figure.measured("area_bounds", a2 / a1, f"relative variance of areas {a1:.3f} between close bounds, {a2:.3f} between far ones")
    access = {k: parcels[k]["has_street_access"].mean() for k in VARIATIONS}
    figure.measured("access_enforced", access["b2"], f"{len(parcels['b2'])} parcels")
    figure.measured("access_free", access["b1"], f"{len(parcels['b1'])} parcels")
    c1, c2 = (parcels[k]["frontage_m"].median() for k in ("c1", "c2"))
    figure.measured("lot_width", c2 / c1, f"median frontage {c1:.1f} and {c2:.1f} m")
    d1, d2 = (frontage_on_short_sides(on_block[k], block) for k in ("d1", "d2"))
    figure.measured("street_width", d2 - d1, f"{d1} and {d2} parcels front the short sides of the block")
    e1, e2 = (parcels[k]["area_m2"] for k in ("e1", "e2"))
    limit = VARIATIONS["e2"][1]["area_min_m2"]
    figure.measured("small_removed", (e2 < limit).mean() - (e1 < limit).mean(),
                    f"{int((e1 < limit).sum())} of {len(e1)} parcels below {limit} m² before, {int((e2 < limit).sum())} of "
                    f"{len(e2)} after")
    figure.measured("infinite_offset", access["f1"], f"{len(parcels['f1'])} parcels")
    figure.measured("low_offset", int((parcels["f2"]["has_street_access"] == 0).sum()), f"{len(parcels['f2'])} parcels")
    g1, g2 = (sum(map(relative_variance, repeated[k])) / len(repeated[k]) for k in ("g1", "g2"))
    figure.measured("irregularity", g2 / g1, f"relative variance of areas {g1:.4f} with ω = 0, {g2:.4f} with ω = 1, mean of {SEEDS} seeds")
    patios = [int((on_block[k]["has_street_access"] == 0).sum()) for k in ("f2", "g3", "g4")]
    figure.measured("patio_styles", len(set(patios)), "parcels without access in the block drawn: kept whole "
                    f"{patios[0]}, by OBB {patios[1]}, by skeleton {patios[2]}")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig09", draw))
