"""VKW12, figure 7: a street network edited in six ways, and where the parcel of one house goes."""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import GREY, INK, bounds_of, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from made_blocks import edited, made_city  # noqa: E402

#: Streets of the made network; the one that ends at (215, 145) encloses nothing yet.
STREETS = [[(0, 0), (140, 0)], [(140, 0), (300, 10)], [(0, 100), (140, 95)], [(140, 95), (290, 110)],
           [(0, 205), (140, 210)], [(140, 210), (215, 212)], [(215, 212), (305, 205)], [(0, 0), (0, 100)],
           [(0, 100), (0, 205)], [(140, 0), (140, 95)], [(140, 95), (140, 210)], [(300, 10), (290, 110)],
           [(290, 110), (305, 205)], [(215, 212), (215, 145)]]
STYLE = {"area_min_m2": 150, "area_max_m2": 900, "width_min_m": 14, "width_max_m": 22}
HOUSE = (156.0, 150.0)
#: The six edits of the caption, each from the network as it was.
EDITS = {
    "a": ("a vertex moved to enclose a block",
          [{"edit": "move_node", "node": {"at": (215, 145)}, "to": (215, 103), "snap_m": 5}]),
    "b": ("an edge moved", [{"edit": "move_street", "street": {"at": (140, 150)}, "by": (14, 4)}]),
    "c": ("the curves of two edges edited",
          [{"edit": "bend_street", "street": {"at": (140, 150)}, "controls": [(122, 130), (124, 180)]},
           {"edit": "bend_street", "street": {"at": (215, 103)}, "controls": [(190, 78), (245, 82)]}]),
    "d": ("the width of a street changed", [{"edit": "set_street_width", "street": {"at": (140, 150)}, "width_m": 26}]),
    "e": ("the subdivision style changed",
          [{"edit": "set_block_style", "strategy": "obb", "options": {"area_max_m2": 700, "width_max_m": 12}}]),
    "f": ("the network scaled", [{"edit": "scale_nodes", "center": (0, 0), "factor": 1.3}]),
}


def with_house(parcels):
    """The parcels that carry the house: where one is cut up, its successors may share what it carried."""
    return parcels[[bool(json.loads(a).get("house")) if isinstance(a, str) else False for a in parcels["attributes"]]]


def house_of(parcels, identifier):
    """The given parcel, if it still carries the house."""
    house = with_house(parcels)
    return house[house["parcel"] == identifier]


def relative_place(city, identifier):
    """Of the house in its block's bounding box, 0 to 1 in each direction; nothing where it is lost."""
    house = house_of(city["parcels"], identifier)
    if len(house) != 1:
        return None
    block = city["blocks"].loc[city["blocks"]["block"] == house["block"].iloc[0]].geometry.iloc[0]
    at, (low_x, low_y, high_x, high_y) = house.geometry.iloc[0].centroid, block.bounds
    return (at.x - low_x) / (high_x - low_x), (at.y - low_y) / (high_y - low_y)


def draw_city(axes, city, identifier, key, text):
    open_map(axes, bounds_of(city["streets"], 0.04))
    fill(axes, city["parcels"], "#eef1e6", GREY, 0.4)
    fill(axes, city["blocks"], "none", INK, 1.0)
    fill(axes, house_of(city["parcels"], identifier), "#1f50c8", INK, 0.8)
    lines(axes, city["streets"], "#d62728", 0.9)
    letter(axes, key, text)


def draw(figure):
    start = made_city(figure, "start", STREETS, "skeleton", STYLE,
                      [{"edit": "set_parcel_attribute", "parcel": {"at": HOUSE}, "key": "house", "value": "blue"}])
    identifier = with_house(start["parcels"])["parcel"].iloc[0]
    cities = {key: edited(figure, key, start["file"], edits) for key, (_, edits) in EDITS.items()}

    picture, grid = sheet(2, 4, 14.0, 6.4)
    for axes, (key, (text, _)) in zip([*grid[0], *grid[1][1:3]], EDITS.items()):
        draw_city(axes, cities[key], identifier, key, text)
    draw_city(grid[1][0], start, identifier, "–", "the network before each edit")
    grid[1][3].set_axis_off()
    caption(picture, figure, "Blue: the parcel of the house. Red: the street graph.")
    figure.save(picture)

    counts = {key: len(house_of(city["parcels"], identifier)) for key, city in cities.items()}
    carriers = {key: len(with_house(city["parcels"])) for key, city in cities.items()}
    figure.measured("house_stays", sum(count == 1 for count in counts.values()),
                    "parcels that carry the house: " + ", ".join(f"{key} {count}" for key, count in carriers.items()))
    before = relative_place(start, identifier)
    for key, city in cities.items():
        after = relative_place(city, identifier)
        shift = float("nan") if after is None or before is None else max(abs(a - b) for a, b in zip(after, before))
        figure.measured(f"place_{key}", shift, EDITS[key][0])
    split = len(cities["a"]["blocks"]) - len(start["blocks"])
    figure.measured("encloses", split, f"{len(start['blocks'])} blocks before, {len(cities['a']['blocks'])} after")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig07", draw))
