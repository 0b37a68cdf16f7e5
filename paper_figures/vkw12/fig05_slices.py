"""VKW12, figure 5: rays from the supporting edges slice a strip, and follow the skeleton's arcs where they meet them."""

import math
import pathlib
import sys

from shapely.geometry import LineString, Point
from shapely.ops import unary_union

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, PALE, bounds_of, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from made_blocks import MadeBlock  # noqa: E402
from places import layer, subdivide  # noqa: E402

#: A bend of the street: rays of both its arms meet the arc between their faces.
CONTOUR = [(0.0, 0.0), (70.0, 0.0), (120.0, 26.0), (158.0, 70.0), (120.0, 104.0), (86.0, 66.0), (52.0, 52.0), (0.0, 52.0)]
STREETS = [(0, 2, 12.0), (3, 3, 12.0), (4, 6, 12.0), (7, 7, 12.0)]
SETTINGS = {"simplify_m": 0, "corners": "street_length", "area_min_m2": 0, "area_max_m2": 5000, "width_min_m": 9,
            "width_max_m": 11, "irregularity": 0.15}
TOUCH_M = 0.02
DARK_BLUE = "#17357a"


def degrees_off_square(ray, shape):
    """How far a ray that starts on the contour is from perpendicular to the edge it starts on; nothing for others."""
    ends = [Point(ray.coords[0]), Point(ray.coords[-1])]
    start = min(ends, key=shape.exterior.distance)
    if shape.exterior.distance(start) > TOUCH_M:
        return None
    ring = list(shape.exterior.coords)
    edge = min((LineString(e) for e in zip(ring, ring[1:])), key=lambda e: e.distance(start))
    (ax, ay), (bx, by) = ray.coords[0], ray.coords[-1]
    (px, py), (qx, qy) = edge.coords
    turn = math.atan2(by - ay, bx - ax) - math.atan2(qy - py, qx - px)
    return abs(math.degrees(math.asin(max(-1.0, min(1.0, math.cos(turn))))))


def draw(figure):
    block = MadeBlock(figure, "block", CONTOUR, STREETS)
    trace = figure.path("trace.gpkg")
    file = subdivide(figure, "skeleton", block.blocks, "skeleton", SETTINGS, streets=block.streets, trace=trace)
    arcs, walls, strips, slices = (layer(trace, key) for key in ("skeleton_arcs", "walls", "beta_strips", "slices"))
    contour, parcels = layer(block.file, "blocks"), layer(file, "parcels")
    shape = contour.geometry.iloc[0]
    on_arc = [unary_union(arcs.geometry.tolist()).buffer(TOUCH_M).contains(line) for line in slices.geometry]
    rays, guided = slices[[not o for o in on_arc]], slices[on_arc]

    picture, grid = sheet(1, 2, 12.0, 6.0)
    for axes, box, key, text in ((grid[0][0], bounds_of(contour, 0.03), "a", "rays (dashed) from the supporting edges (bold)"),
                                 (grid[0][1], detail_of(guided, contour), "b", "rays that meet an arc (blue) follow it")):
        open_map(axes, box)
        axes.set_xlim(box[0], box[2])
        fill(axes, strips, [PALE[i % len(PALE)] for i in range(len(strips))], "none", 0.0, alpha=0.8)
        lines(axes, arcs, DARK_BLUE, 0.6 if key == "a" else 1.0)
        lines(axes, walls, INK, 1.2)
        lines(axes, rays, INK, 0.9, linestyles="--")
        lines(axes, guided, "#d62728", 2.0)
        fill(axes, contour, "none", INK, 2.4)
        letter(axes, key, text)
    caption(picture, figure, "Red: where a slice follows an arc.")
    figure.save(picture)

    off = [x for ray in rays.geometry if (x := degrees_off_square(ray, shape)) is not None]
    figure.measured("perpendicular", max(off, default=float("nan")), f"largest of {len(off)} rays that start on the contour")
    figure.measured("follows_arcs", len(guided), f"of {len(slices)} pieces of slices; {len(parcels)} parcels")


def detail_of(guided, contour):
    """Around the first place where a slice follows an arc."""
    if guided.empty:
        return bounds_of(contour, 0.03)
    at = guided.geometry.iloc[0].centroid
    return [at.x - 30.0, at.y - 26.0, at.x + 30.0, at.y + 26.0]


if __name__ == "__main__":
    sys.exit(make("vkw12/fig05", draw))
