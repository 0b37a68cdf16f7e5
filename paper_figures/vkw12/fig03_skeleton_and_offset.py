"""VKW12, figure 3: the straight skeleton of a polygon, and its partial application: the offset contour."""

import pathlib
import sys

from shapely.ops import polygonize

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, LAND, bounds_of, caption, fill, letter, lines, open_map, pale_faces, sheet  # noqa: E402
from made_blocks import MadeBlock  # noqa: E402
from places import layer, subdivide  # noqa: E402

#: Two wide halls and a narrow neck: not convex, so that the offset falls into two.
CONTOUR = [(0.0, 0.0), (62.0, 4.0), (70.0, 26.0), (96.0, 24.0), (104.0, -6.0), (168.0, 8.0), (160.0, 92.0), (98.0, 84.0),
           (90.0, 58.0), (66.0, 60.0), (56.0, 88.0), (-6.0, 78.0)]
OFFSET_M = 20.0
#: The working grid is 2^-10 m; nodes of the skeleton are rounded to it.
TOUCH_M = 0.01
DARK_BLUE = "#17357a"


def traced(figure, block, name, **settings):
    trace = figure.path(f"trace_{name}.gpkg")
    file = subdivide(figure, name, block.blocks, "skeleton", {"simplify_m": 0, **settings}, trace=trace)
    return {key: layer(trace, key) for key in ("skeleton_faces", "skeleton_arcs", "offset_contour")}, layer(file, "parcels")


def draw(figure):
    block = MadeBlock(figure, "block", CONTOUR)
    whole, _ = traced(figure, block, "whole")
    part, parcels = traced(figure, block, "offset", offset_m=OFFSET_M, inner="keep")
    contour = layer(block.file, "blocks")
    rim = part["offset_contour"]
    loops = list(polygonize(rim.geometry.tolist()))

    picture, grid = sheet(1, 2, 11.0, 4.9)
    bounds = bounds_of(contour, 0.03)
    left, right = grid[0]
    for axes in (left, right):
        open_map(axes, bounds)
    fill(left, whole["skeleton_faces"], pale_faces(whole["skeleton_faces"]), "none", 0.0, alpha=0.55)
    lines(left, whole["skeleton_arcs"], DARK_BLUE, 1.3)
    fill(left, contour, "none", INK, 2.0)
    letter(left, "left", "straight skeleton: arcs and the face of each edge")
    fill(right, contour, LAND, "none", 0.0)
    lines(right, part["skeleton_arcs"], DARK_BLUE, 1.3)
    lines(right, rim, INK, 1.4, linestyles="--")
    fill(right, contour, "none", INK, 2.0)
    for name, loop in zip("abcdefgh", sorted(loops, key=lambda shape: shape.centroid.x)):
        right.text(loop.centroid.x, loop.centroid.y, name, ha="center", va="center", fontsize=12, style="italic")
    letter(right, "right", f"offset contour C'(B) at {OFFSET_M:g} m (dashed)")
    caption(picture, figure)
    figure.save(picture)

    shape = contour.geometry.iloc[0]
    edges = len(shape.exterior.coords) - 1
    faces = whole["skeleton_faces"]
    touching = sum(face.boundary.buffer(TOUCH_M).intersection(shape.boundary).length > 1.0 for face in faces.geometry)
    figure.measured("face_per_edge", abs(edges - len(faces)) + abs(edges - touching), f"{edges} edges, {len(faces)} faces")
    figure.measured("faces_fill", abs(faces.area.sum() / shape.area - 1.0), f"{shape.area:.1f} m²")
    figure.measured("several_portions", len(loops), "closed loops of the offset contour")
    nearest = min((loop.boundary.distance(shape.boundary) for loop in loops), default=float("nan"))
    figure.measured("at_distance", abs(nearest - OFFSET_M), f"nearest point of the offset contour at {nearest:.4f} m")
    inner = parcels[parcels["has_street_access"] == 0]
    figure.measured("no_access", len(inner), f"parcels without street access, of {sorted(inner['area_m2'].round(0))} m²")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig03", draw))
