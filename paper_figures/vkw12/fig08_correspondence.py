"""VKW12, figure 8: which parcel takes the place of which when the streets move."""

import pathlib
import sys

import numpy
from matplotlib.collections import LineCollection

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, PALE, bounds_of, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from made_blocks import edited, made_city  # noqa: E402

STREETS = [[(0, 0), (150, 0)], [(150, 0), (170, 110)], [(170, 110), (10, 120)], [(10, 120), (0, 0)]]
#: No irregularity: the random stream would be spent in another order when the block is turned, which is not the matching.
STYLE = {"area_min_m2": 150, "area_max_m2": 1000, "width_min_m": 16, "width_max_m": 24, "irregularity": 0}
MOVED = [{"edit": "move_node", "node": {"at": (170, 110)}, "to": (205, 138)}]
TURNED = [{"edit": "rotate_nodes", "center": (0, 0), "angle_deg": 90}]


def relative_position(parcel, corners):
    """Distances from a parcel's middle to the block's corners, over their sum [VKW12, Sec. 5.2]."""
    away = numpy.hypot(*(corners - numpy.array(parcel.centroid.coords[0])).T)
    return away / away.sum()


def corners_of(city):
    """Of the one block, starting at the corner that is lowest by number: the order is kept by the edits here."""
    return numpy.asarray(city["blocks"].geometry.iloc[0].exterior.coords)[:-1, :2]


def nearest_before(before, after):
    """For each parcel after the edit, the parcel before it whose relative position is nearest; ids."""
    old_corners, new_corners = corners_of(before), corners_of(after)
    if len(old_corners) != len(new_corners):
        return None
    shift = start_shift(before, after, old_corners, new_corners)
    old = numpy.array([relative_position(p, old_corners) for p in before["parcels"].geometry])
    new = numpy.array([relative_position(p, numpy.roll(new_corners, shift, axis=0)) for p in after["parcels"].geometry])
    distance = numpy.abs(new[:, None, :] - old[None, :, :]).sum(axis=2)
    return before["parcels"]["parcel"].to_numpy()[distance.argmin(axis=1)]


def start_shift(before, after, old_corners, new_corners):
    """How the rings must be turned so that corners of the same street corner face each other."""
    spans = [numpy.abs((numpy.roll(new_corners, k, axis=0) - new_corners.mean(axis=0))
                       - (old_corners - old_corners.mean(axis=0))).sum() for k in range(len(new_corners))]
    return int(numpy.argmin(spans))


def colours(parcels, ids):
    return [PALE[ids.index(i) % len(PALE)] if i in ids else "#ffffff" for i in parcels]


def draw(figure):
    before = made_city(figure, "before", STREETS, "skeleton", STYLE)
    after = edited(figure, "after", before["file"], MOVED)
    turned = edited(figure, "turned", before["file"], TURNED)
    ids = before["parcels"]["parcel"].tolist()
    kept = after["parcels"][after["parcels"]["parcel"].isin(ids)]

    picture, grid = sheet(1, 3, 12.5, 4.4)
    bounds = bounds_of(after["streets"], 0.05)
    for axes, city, by, key, text in ((grid[0][0], before, "parcel", "a", "before the edit"),
                                      (grid[0][1], after, "predecessor", "b", "after: one corner moved")):
        open_map(axes, bounds)
        fill(axes, city["parcels"], colours(city["parcels"][by], ids), INK, 0.6)
        lines(axes, city["streets"], "#d62728", 0.8)
        for parcel, shape in zip(city["parcels"]["parcel"], city["parcels"].geometry):
            axes.text(shape.centroid.x, shape.centroid.y, parcel, fontsize=6.5, ha="center", va="center")
        letter(axes, key, text)
    axes = grid[0][2]
    open_map(axes, bounds)
    fill(axes, before["parcels"], "none", "#1f50c8", 0.6)
    fill(axes, after["parcels"], "none", "#d62728", 0.6)
    old = before["parcels"].set_index("parcel").geometry
    axes.add_collection(LineCollection([[old[i].centroid.coords[0], shape.centroid.coords[0]]
                                        for i, shape in zip(after["parcels"]["predecessor"].astype(int),
                                                             after["parcels"].geometry)], colors=INK, linewidths=1.2))
    letter(axes, "c", "the correspondence: from blue (before) to red (after)")
    caption(picture, figure, "Colours: matched parcels. Numbers: ids, kept one to one.")
    figure.save(picture)

    nearest = nearest_before(before, after)
    same = float("nan") if nearest is None else float((nearest == after["parcels"]["predecessor"].to_numpy()).mean())
    figure.measured("nearest", same, f"{len(before['parcels'])} parcels before, {len(after['parcels'])} after, "
                    f"{len(kept)} kept their id")
    figure.measured("one_to_one", len(kept) - kept["parcel"].nunique(), f"{len(kept)} parcels kept an id")
    stays = turned["parcels"]["parcel"].isin(ids).mean()
    figure.measured("turned", stays, f"{len(turned['parcels'])} parcels after a turn by 90 degrees about the network's origin")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig08", draw))
