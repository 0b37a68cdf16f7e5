"""AVB08, figure 6: a block, the axis of its box, its Voronoi parcels, and their images."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import geopandas  # noqa: E402
import numpy  # noqa: E402
from figure import make  # noqa: E402
from drawing import INK, LAND, bounds_of, caption, fill, letter, lines, open_map, pale_faces, sheet  # noqa: E402
from imagery import Picture, filled, rendered  # noqa: E402
from places import Place, Window, layer  # noqa: E402
from shapely.geometry import LineString  # noqa: E402

WINDOW = Window("cambridge_ma", 232450.0, 901450.0, 232850.0, 901850.0, "Cambridgeport: blocks of two rows of lots")
RED, BLUE = "#d62728", "#1f50c8"
#: What `plat imagery --ground plain` paints where no parcel is.
PLAIN_GROUND = (122, 122, 120)


def main_axis(block):
    """The line through the middle of the block's box, along its longer side."""
    corners = numpy.asarray(block.minimum_rotated_rectangle.exterior.coords)
    sides = [(corners[i], corners[i + 1], corners[(i + 2) % 4], corners[(i + 3) % 4]) for i in range(2)]
    a, b, c, d = min(sides, key=lambda side: numpy.hypot(*(side[1] - side[0])))
    return LineString([(a + b) / 2, (c + d) / 2])


def draw(figure):
    place = Place(figure, WINDOW)
    generated = place.subdivide("voronoi")
    blocks, parcels = layer(generated, "blocks"), layer(generated, "parcels")
    # The block whose parcels are most: two rows show best.
    number = parcels["block_id"].value_counts().sort_index().idxmax()
    block, lots = blocks[blocks["block_id"] == number], parcels[parcels["block_id"] == number]
    shape = block.geometry.iloc[0]
    town = figure.path("town.gpkg")
    image = rendered(figure, town, "town", blocks.total_bounds + numpy.array([-60, -60, 60, 60]))
    out, report = filled(figure, generated, town, image, "new", "--ground", "plain")

    picture, (panels,) = sheet(1, 4, 13.0, 4.6)
    bounds = bounds_of(block, 0.06)
    for axes, key, text in zip(panels, "abcd", ("block of the street network", "box, its main axis, Voronoi cells",
                                                "parcels", "their images, by example")):
        open_map(axes, bounds, scale=key == "a")
        letter(axes, key, text)
    fill(panels[0], block, LAND, INK, 1.4)
    fill(panels[1], block, LAND, INK, 1.4)
    fill(panels[1], lots, "none", BLUE, 0.8)
    box = geopandas.GeoDataFrame(geometry=[shape.minimum_rotated_rectangle])
    fill(panels[1], box, "none", RED, 1.0, linestyles="--")
    lines(panels[1], geopandas.GeoDataFrame(geometry=[main_axis(shape)]), RED, 1.8)
    fill(panels[2], lots, pale_faces(lots), INK, 0.8)
    Picture(out).draw(panels[3])
    fill(panels[3], block, "none", INK, 1.0)
    caption(picture, figure)
    figure.save(picture)

    figure.measured("egress", lots["has_street_access"].mean(), f"{len(lots)} parcels of the block")
    figure.measured("rows", lots.intersects(main_axis(shape).buffer(0.25 * numpy.sqrt(lots.geometry.area.mean()))).mean(),
                    f"{len(lots)} parcels")
    sources = layer(report, "imagery")
    figure.measured("images", len(sources) / len(parcels), f"{len(parcels)} parcels of {len(blocks)} blocks")
    figure.measured("filled", Picture(out).share_of(PLAIN_GROUND, shape.buffer(-0.5)), "of the block shown")


if __name__ == "__main__":
    sys.exit(make("avb08/fig06", draw))
