"""VKW12, figure 6: the recursion of OBB subdivision, level by level."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, LAND, bounds_of, caption, fill, letter, lines, open_map, pale_faces, sheet  # noqa: E402
from made_blocks import MadeBlock  # noqa: E402
from places import layer, subdivide  # noqa: E402

#: A convex block with no right angle, so that each split cuts one lot in two.
CONTOUR = [(0.0, 0.0), (118.0, 9.0), (131.0, 64.0), (74.0, 91.0), (8.0, 77.0)]
#: Every split across the box: with street access asked for, some would be turned, which is figure 9 b.
ATTRIBUTES = {"area_min_m2": 200, "area_max_m2": 900, "width_min_m": 8, "width_max_m": 16, "irregularity": 0.15,
              "street_access": 0}
PANELS = 6


def angle_to_minor_axis(box, split):
    """Degrees between a split and the shorter side of the box it divides."""
    ring = list(box.exterior.coords)
    sides = sorted(((ring[i + 1][0] - ring[i][0], ring[i + 1][1] - ring[i][1]) for i in range(2)),
                   key=lambda side: math.hypot(*side))
    (ax, ay), (bx, by) = split.coords[0], split.coords[-1]
    turn = math.atan2(by - ay, bx - ax) - math.atan2(sides[0][1], sides[0][0])
    return abs(math.degrees(math.asin(math.sin(turn))))


def draw(figure):
    block = MadeBlock(figure, "block", CONTOUR)
    trace = figure.path("trace.gpkg")
    parcels = layer(subdivide(figure, "obb", block.blocks, "obb", ATTRIBUTES, trace=trace), "parcels")
    splits, boxes = layer(trace, "splits"), layer(trace, "lot_boxes")
    depth = int(splits["number"].max()) + 1

    picture, grid = sheet(2, 3, 10.5, 7.0)
    bounds = bounds_of(boxes, 0.03)
    for panel, axes in enumerate(grid.flat):
        open_map(axes, bounds, scale=panel == 0)
        if panel == PANELS - 1:
            fill(axes, parcels, pale_faces(parcels))
            letter(axes, "f", f"parcels after {depth} levels")
            continue
        fill(axes, layer(block.file, "blocks"), LAND, INK, 1.2)
        if panel > 0:
            lines(axes, splits[splits["number"] < panel - 1], INK, 1.0)
            lines(axes, splits[splits["number"] == panel - 1], "#d62728", 1.8)
            fill(axes, boxes[boxes["number"] == panel - 1], "none", "#1f50c8", 0.8, linestyles="--")
        letter(axes, "abcde"[panel], "block" if panel == 0 else f"splits of level {panel}, and the boxes they divide")
    caption(picture, figure)
    figure.save(picture)

    angles = [angle_to_minor_axis(box, split) for box, split in zip(boxes.geometry, splits.geometry)]
    figure.measured("minor_axis", max(angles), f"largest of {len(angles)} splits")
    figure.measured("two_each", abs(len(parcels) - len(splits) - 1) if len(splits) == len(boxes) else float("nan"),
                    f"{len(splits)} splits, {len(parcels)} parcels")
    is_done = (parcels["area_m2"] < ATTRIBUTES["area_max_m2"]) | (parcels["frontage_m"] < ATTRIBUTES["width_max_m"])
    figure.measured("until_satisfied", is_done.mean(), f"{len(parcels)} parcels, {depth} levels")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig06", draw))
