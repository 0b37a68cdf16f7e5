"""Har, figure 6.10: the contour of an empty block and the offset polygon that a building will follow."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import geopandas  # noqa: E402
from figure import make  # noqa: E402
from drawing import GREY, bounds_of, caption, fill, lines, open_map, sheet  # noqa: E402
from empty_block import OFFSET_M, EmptyBlock  # noqa: E402
from places import Window  # noqa: E402

WINDOW = Window("prague_bubenec_cz", 0, 0, 1e7, 1e7, "the largest block that streets enclose")


def draw(figure):
    block = EmptyBlock(figure, WINDOW)
    axis = block.axis(block.build(figure, "palazzo"))
    picture, ((axes,),) = sheet(1, 1, 7.0, 6.4)
    face = geopandas.GeoDataFrame(geometry=[block.face])
    open_map(axes, bounds_of(face, 0.45))
    fill(axes, geopandas.GeoDataFrame(geometry=block.footprints[~block.inside]), "#dddddd", GREY, 0.4)
    lines(axes, geopandas.GeoDataFrame(geometry=block.streets), "#999999", 1.2)
    fill(axes, face, "none", "#1a9641", 2.2)
    fill(axes, geopandas.GeoDataFrame(geometry=[axis]), "none", "#d62728", 2.0)
    caption(picture, figure, f"Green: the block, described by the streets' centrelines. Red: its offset by {OFFSET_M:.0f} m.")
    figure.save(picture)

    figure.measured("inside", 0 if block.face.buffer(-OFFSET_M + 0.5).buffer(0.0).contains(axis.representative_point())
                    and block.face.contains(axis) else 1, f"{len(axis.exterior.coords) - 1} corners")
    clear = axis.exterior.distance(block.face.exterior)
    figure.measured("offset", abs(clear - OFFSET_M), f"nearest {clear:.2f} m")


if __name__ == "__main__":
    sys.exit(make("har/fig06_10", draw))
