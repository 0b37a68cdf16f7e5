"""Har, figure 6.11: the building of figure 6.10 among its neighbours."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, sheet  # noqa: E402
from buildings import merged, open_edges, show  # noqa: E402
from empty_block import EmptyBlock  # noqa: E402
from places import Window  # noqa: E402
from rendering import extruded, looking_at, render  # noqa: E402
from shapely.geometry import MultiPoint  # noqa: E402

WINDOW = Window("prague_bubenec_cz", 0, 0, 1e7, 1e7, "the largest block that streets enclose")
#: Heights of neighbours are not in the data: made up, by number.
LOW_M, STEP_M, STEPS = 12.0, 1.5, 5
GREYS = [(206, 206, 200), (194, 194, 190), (216, 214, 206)]
STREET_M = 9.0


def polygons(shape):
    return getattr(shape, "geoms", [shape])


def draw(figure):
    block = EmptyBlock(figure, WINDOW)
    building = block.build(figure, "palazzo")
    near = block.face.buffer(130)
    neighbours = [extruded(part, LOW_M + STEP_M * (i * 7 % STEPS), GREYS[i % len(GREYS)])
                  for i, (shape, inside) in enumerate(zip(block.footprints, block.inside))
                  if not inside and shape.intersects(near) for part in polygons(shape)]
    roads = [extruded(part, 0.05, (128, 128, 128)) for line in block.streets if line.intersects(near)
             for part in polygons(line.intersection(near).buffer(STREET_M / 2))]
    camera = looking_at([building.model], -50.0, 38.0)
    camera.distance_m *= 1.6
    view = render(figure, "view", [building.model, merged(neighbours + roads)], camera, 1500, 1000)
    picture, ((axes,),) = sheet(1, 1, 10.0, 7.4)
    show(axes, view)
    caption(picture, figure)
    figure.save(picture)

    footprint = MultiPoint([tuple(p) for p in building.model.vertices[:, :2]]).convex_hull
    figure.measured("inside", footprint.difference(block.face).area, "m2 of the convex hull beyond the streets' centrelines")
    figure.measured("neighbours", len(neighbours), "footprints around, their heights made up")
    figure.measured("lengths", building.length_error_m())
    figure.measured("closed", open_edges([building]))


if __name__ == "__main__":
    sys.exit(make("har/fig06_11", draw))
