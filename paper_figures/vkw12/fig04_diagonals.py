"""VKW12, figure 4: alpha-strips, their diagonal edges, and the beta-strips without them."""

import math
import pathlib
import sys

from shapely.geometry import Point

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import GREY, INK, PALE, bounds_of, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from made_blocks import MadeBlock, placed  # noqa: E402
from places import layer, subdivide  # noqa: E402

#: Four streets and two cut corners, each a street of its own: short enough that its strip is handed over whole.
CONTOUR = [(0.0, 0.0), (112.0, -8.0), (118.0, -2.0), (128.0, 62.0), (66.0, 78.0), (10.0, 84.0), (2.0, 78.0)]
STREETS = [(0, 0, 12.0), (1, 1, 12.0), (2, 2, 12.0), (3, 4, 12.0), (5, 5, 12.0), (6, 6, 12.0)]
SETTINGS = {"simplify_m": 0, "corners": "street_length", "area_min_m2": 0, "area_max_m2": 3000, "width_min_m": 14,
            "width_max_m": 18, "irregularity": 0.1, "shallow_share": 0}
TOUCH_M = 0.01


def is_at_corner(line, corners):
    return any(Point(end).distance(corner) < TOUCH_M for end in (line.coords[0], line.coords[-1]) for corner in corners)


def street_corners(shape):
    """Where the contour passes from one street to the next; convex here, all of them."""
    ring = list(shape.exterior.coords)[:-1]
    inner = placed([CONTOUR[4]])[0]
    return [Point(p) for p in ring if Point(p).distance(Point(inner)) > TOUCH_M]


def angle_at_contour(wall, shape):
    """Degrees between a wall that ends on the contour and the edge it ends on; nothing for a wall inside."""
    for a, b in ((wall.coords[0], wall.coords[-1]), (wall.coords[-1], wall.coords[0])):
        if shape.exterior.distance(Point(a)) > TOUCH_M:
            continue
        ring = list(shape.exterior.coords)
        p, q = min(zip(ring, ring[1:]), key=lambda e: type(wall)(e).distance(Point(a)))
        turn = math.atan2(b[1] - a[1], b[0] - a[0]) - math.atan2(q[1] - p[1], q[0] - p[0])
        return math.degrees(math.asin(min(1.0, abs(math.sin(turn)))))
    return None


def draw(figure):
    block = MadeBlock(figure, "block", CONTOUR, STREETS)
    trace = figure.path("trace.gpkg")
    file = subdivide(figure, "skeleton", block.blocks, "skeleton", SETTINGS, streets=block.streets, trace=trace)
    faces, arcs, walls, strips = (layer(trace, key) for key in ("skeleton_faces", "skeleton_arcs", "walls", "beta_strips"))
    parcels, contour = layer(file, "parcels"), layer(block.file, "blocks")
    shape = contour.geometry.iloc[0]
    corners = street_corners(shape)
    between = arcs[arcs["number"] == 1]
    diagonals = between[[is_at_corner(arc, corners) for arc in between.geometry]]

    picture, grid = sheet(2, 3, 12.5, 7.4)
    (a, b, c), (d, e, f) = grid
    bounds = bounds_of(contour, 0.06)
    corner = shape.exterior.coords[3]
    zoom = [corner[0] - 56.0, corner[1] - 34.0, corner[0] + 8.0, corner[1] + 16.0]
    for axes, box in ((a, bounds), (b, bounds), (c, zoom), (d, zoom), (e, zoom), (f, bounds)):
        open_map(axes, box, scale=axes in (a, c))
        axes.set_xlim(box[0], box[2])
    alpha = [PALE[n % len(PALE)] for n in faces["number"]]
    beta = [PALE[(n + 4) % len(PALE)] for n in range(len(strips))]
    for axes in (a, c):
        fill(axes, faces, alpha, "none", 0.0)
        lines(axes, between, INK, 0.8)
        lines(axes, diagonals, "#d62728", 1.8, linestyles="--")
    letter(a, "a", "α-strips of the logical streets, diagonal edges dashed")
    letter(c, "c", "one corner: the diagonal edge")
    for axes in (b, e):
        fill(axes, strips, beta, INK, 0.8)
    lines(b, diagonals, "#d62728", 0.9, linestyles=":")
    letter(b, "b", "β-strips: regions handed over (diagonals dotted)")
    fill(d, faces, alpha, "none", 0.0)
    lines(d, diagonals, "#d62728", 1.0, linestyles=":")
    lines(d, walls, INK, 2.0)
    letter(d, "d", "the cut from the farthest point to the front")
    letter(e, "e", "after the region went to the longer street's strip")
    fill(f, strips, beta, "none", 0.0)
    fill(f, parcels, "none", INK, 0.7)
    letter(f, "f", "parcels split from the β-strips")
    for axes in (a, b, f):
        fill(axes, contour, "none", INK, 1.6)
        lines(axes, layer(block.file, "streets"), GREY, 0.6)
    caption(picture, figure)
    figure.save(picture)

    left = sum(is_at_corner(wall, corners) for wall in walls.geometry)
    figure.measured("no_diagonal", left, f"{len(diagonals)} diagonal edges between α-strips, {len(walls)} walls of β-strips")
    angles = [x for wall in walls.geometry if (x := angle_at_contour(wall, shape)) is not None]
    before = [x for arc in diagonals.geometry if (x := angle_at_contour(arc, shape)) is not None]
    figure.measured("more_orthogonal", (min(angles) - max(before)) if angles and before else float("nan"),
                    f"diagonals meet the contour at {', '.join(f'{x:.0f}°' for x in before)}, walls at "
                    f"{', '.join(f'{x:.0f}°' for x in angles)}")
    figure.measured("zero_strips", strips.area.min() if len(strips) else float("nan"),
                    f"{faces['number'].nunique()} α-strips, {len(strips)} β-strips")
    figure.measured("strips_removed", faces["number"].nunique() - len(strips), "α-strips less β-strips")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig04", draw))
