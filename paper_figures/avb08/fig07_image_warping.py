"""AVB08, figure 7: from a source parcel with its image to a new parcel, by points that correspond."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import numpy  # noqa: E402
from figure import FigureError, make  # noqa: E402
from drawing import INK, bounds_of, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from imagery import GridPoints, Picture, filled, rendered  # noqa: E402
from places import Place, Window, layer  # noqa: E402

WINDOW = Window("cambridge_ma", 232450.0, 901450.0, 232850.0, 901850.0, "Cambridgeport: lots of many shapes")
LINES, SAMPLES = 9, 6
RED, BLUE = "#d62728", "#1f50c8"


def chosen(rows):
    """The pair to show: upright scan lines, and of those the lot whose contour departs most from its box."""
    shown = rows[(rows["warp"] == "scan_lines") & (rows.geometry.area > 300) & (rows.geometry.area < 1500)]
    if shown.empty:
        raise FigureError("no new parcel is warped by scan lines")
    filling = shown.geometry.area / shown.geometry.apply(lambda g: g.minimum_rotated_rectangle.area)
    return shown.loc[filling.idxmin()]


def draw_parcel(axes, frame, picture, grid, key, text):
    open_map(axes, bounds_of(frame, 0.12))
    if picture is not None:
        picture.draw(axes)
    fill(axes, frame, "none", RED, 1.6)
    if grid is not None:
        lines(axes, grid.scan_lines().to_frame("geometry"), BLUE, 0.9)
        lines(axes, grid.rows().to_frame("geometry"), BLUE, 0.5)
        axes.plot([p.x for p in grid.points.geometry], [p.y for p in grid.points.geometry], "o", color=INK, markersize=2.4)
    letter(axes, key, text)


def draw(figure):
    place = Place(figure, WINDOW)
    generated = place.subdivide("voronoi")
    bounds = layer(generated, "blocks").total_bounds + numpy.array([-60, -60, 60, 60])
    town = figure.path("town.gpkg")
    image = rendered(figure, town, "town", bounds)
    out, report = filled(figure, generated, town, image, "new", "--grid", LINES, SAMPLES, "--ground", "plain")
    rows = layer(report, "imagery")
    pair = chosen(rows)
    target = rows[rows["parcel"] == pair["parcel"]]
    parcels = layer(town, "parcels")
    source = parcels[[str(i + 1) == pair["source_parcel"] for i in range(len(parcels))]]
    new, old = GridPoints(report, "target_grid", pair["parcel"]), GridPoints(report, "source_grid", pair["parcel"])

    picture, grid = sheet(2, 3, 10.5, 7.4)
    before, after = Picture(image), Picture(out)
    draw_parcel(grid[0, 0], source, before, None, "a", "source parcel with image")
    draw_parcel(grid[0, 1], source, None, old, "b", f"{LINES} scan lines, {SAMPLES} samples each")
    draw_parcel(grid[0, 2], source, before, old, "c", "source of the warp")
    draw_parcel(grid[1, 0], target, None, None, "d", "new parcel, blank")
    draw_parcel(grid[1, 1], target, None, new, "e", "corresponding points")
    draw_parcel(grid[1, 2], target, after, None, "f", "image warped to the new parcel")
    caption(picture, figure)
    figure.save(picture)

    folded = sum(int((areas * math.copysign(1.0, areas.sum()) < -1e-9).sum()) for areas in (new.quad_areas(), old.quad_areas()))
    figure.measured("one_to_one", folded, f"of {2 * (LINES - 1) * (SAMPLES - 1)} quadrilaterals")
    figure.measured("similar", max(abs(pair["area_log_difference"]), abs(pair["aspect_log_difference"])),
                    f"area {pair['area_log_difference']:.3f}, aspect ratio {pair['aspect_log_difference']:.3f}")
    inner = [i * SAMPLES + j for i in range(1, LINES - 1) for j in range(1, SAMPLES - 1)]
    seen = after.at(new.points.geometry.iloc[inner]) - before.at(old.points.geometry.iloc[inner])
    figure.measured("warped", float(numpy.median(numpy.abs(seen).mean(axis=1))), f"{len(inner)} points inside")


if __name__ == "__main__":
    sys.exit(make("avb08/fig07", draw))
