"""VKW12, figure 2: the same blocks divided by border Voronoi cells, a minimum-area box, packed cubes, and by skeleton."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import bounds_of, caption, fill, letter, lines, open_map, pale_faces, sheet  # noqa: E402
from places import GENERATED, OBSERVED, Place, Window, layer  # noqa: E402

LARCHWOOD = Window("cambridge_ma", 229130.0, 902830.0, 229500.0, 903330.0,
                   "bent streets, a cul-de-sac and concave blocks, where the approaches differ")
PEERS = {"border_voronoi": "Voronoi cells of points near the border of the street",
         "min_box": "minimum area bounding box [WCP*11]", "cube_packing": "cube packing"}
OURS = "skeleton"
MEASURES = {"area": "area_m2", "aspect": "aspect_ratio"}
#: A block that fills less of its convex hull has a concave part; a parcel that fills less of its box is badly formed.
CONCAVE_BELOW, BADLY_FORMED_BELOW = 0.9, 0.7


def badly_formed(comparison, is_wanted):
    """Share of badly formed procedural parcels in the blocks that `is_wanted`, and their number."""
    blocks = comparison.layers["blocks"]
    chosen = set(blocks.loc[[is_wanted(b) for b in blocks.geometry], "block_id"])
    parcels = comparison.layers[GENERATED]
    parcels = parcels[parcels["block_id"].isin(chosen)]
    return (parcels["rectangularity"] < BADLY_FORMED_BELOW).mean(), len(parcels)


def is_concave(block):
    return block.area / block.convex_hull.area < CONCAVE_BELOW


def draw(figure):
    place = Place(figure, LARCHWOOD)
    runs = {name: place.compare(place.subdivide(name), name) for name in (*PEERS, OURS)}
    streets = layer(figure.path("blocks.gpkg"), "streets")

    picture, grid = sheet(2, 3, 11.5, 9.4)
    bounds = bounds_of(place.blocks)
    panels = list(grid.flat)
    for axes in panels:
        open_map(axes, bounds)
    near = streets.cx[bounds[0]:bounds[2], bounds[1]:bounds[3]]
    fill(panels[0], place.blocks, "#f2efe9", "#999999", 0.6)
    lines(panels[0], near, "#d62728", 1.1)
    letter(panels[0], "a", "street network and blocks")
    for axes, key, (name, text) in zip(panels[1:4], "bcd", PEERS.items()):
        draw_parcels(axes, runs[name].layers[GENERATED], runs[name].layers["blocks"])
        letter(axes, key, text)
    draw_parcels(panels[4], runs[OURS].layers[GENERATED], runs[OURS].layers["blocks"])
    letter(panels[4], "e", "skeleton [VKW12]")
    draw_parcels(panels[5], runs[OURS].layers[OBSERVED], runs[OURS].layers["blocks"])
    letter(panels[5], "–", "observed parcels (not in the paper's figure)")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, runs)


def draw_parcels(axes, parcels, blocks):
    fill(axes, parcels, pale_faces(parcels), "#333333", 0.35)
    fill(axes, blocks, "none", "black", 0.9)


def measure_claims(figure, runs):
    for key, measure in MEASURES.items():
        ours, note = runs[OURS].distance(measure)
        figure.measured(f"ours_{key}_ks", ours, note)
        for peer in PEERS:
            theirs = runs[peer].distance(measure)[0]
            figure.measured(f"{peer}_{key}", ours - theirs, f"skeleton {ours:.3f}, {peer} {theirs:.3f}")
    concave, concave_count = badly_formed(runs["cube_packing"], is_concave)
    convex, convex_count = badly_formed(runs["cube_packing"], lambda block: not is_concave(block))
    ours, ours_count = badly_formed(runs[OURS], is_concave)
    figure.measured("cubes_concave", concave - convex, f"{concave:.3f} of {concave_count} parcels in concave blocks, "
                    f"{convex:.3f} of {convex_count} in the others")
    figure.measured("cubes_worse", concave - ours, f"{ours:.3f} of {ours_count} of skeleton's parcels in concave blocks")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig02", draw))
