"""VKW12, figure 12: real-world parcels, procedural parcels, and recursive splits with a rudimentary orientation."""

import pathlib
import sys

import numpy
from shapely.geometry.polygon import orient

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import bounds_of, caption, fill, letter, open_map, sheet  # noqa: E402
from places import GENERATED, OBSERVED, Place, Window  # noqa: E402

AVON_HILL = Window("cambridge_ma", 230560.0, 903640.0, 231330.0, 904330.0,
                   "an old neighbourhood whose blocks taper and bend: few corners are right angles")
OURS, SPLITS = "skeleton", "parish_mueller"
#: A corner sharper than this makes a spike; a bend drawn with short edges is no corner.
SPIKE_DEG, SIMPLIFY_M = 35.0, 0.5
LARGEST_BLOCK_M2 = 80000.0


def sharpest_corner_deg(shape):
    """The smallest angle inside the parcel: a notch is sharp outside, and no spike."""
    ring = numpy.asarray(orient(shape.simplify(SIMPLIFY_M)).exterior.coords)[:-1, :2]
    before, after = numpy.roll(ring, 1, axis=0) - ring, numpy.roll(ring, -1, axis=0) - ring
    cross = after[:, 0] * before[:, 1] - after[:, 1] * before[:, 0]
    return float((numpy.degrees(numpy.arctan2(cross, (before * after).sum(axis=1))) % 360.0).min())


def is_spike(parcels):
    return numpy.array([min(map(sharpest_corner_deg, getattr(g, "geoms", [g]))) < SPIKE_DEG for g in parcels.geometry])


def draw(figure):
    place = Place(figure, AVON_HILL, keep=lambda block: block.area < LARGEST_BLOCK_M2)
    runs = {name: place.compare(place.subdivide(name), name) for name in (OURS, SPLITS)}
    panels = {"observed": runs[OURS].layers[OBSERVED], OURS: runs[OURS].layers[GENERATED],
              SPLITS: runs[SPLITS].layers[GENERATED]}
    spikes = {name: is_spike(parcels) for name, parcels in panels.items()}

    picture, grid = sheet(1, 3, 14.0, 5.6)
    bounds = bounds_of(place.blocks)
    for axes, (name, parcels), text in zip(grid[0], panels.items(), (
            "real-world parcels", "procedural parcels (skeleton)", "recursive splits (parish_mueller, [PM01])")):
        open_map(axes, bounds)
        fill(axes, parcels, ["#d7191c" if s else "#e6eef5" for s in spikes[name]], "#333333", 0.35)
        fill(axes, runs[OURS].layers["blocks"], "none", "black", 0.9)
        axes.set_title(f"{text}\n{int(spikes[name].sum())} of {len(parcels)} parcels with a corner below {SPIKE_DEG:g}° (red)",
                       fontsize=9, loc="left")
    caption(picture, figure)
    figure.save(picture)

    share = {name: float(s.mean()) for name, s in spikes.items()}
    shares = ", ".join(f"{name} {value:.3f}" for name, value in share.items())
    figure.measured("spikes", share[SPLITS] - share["observed"], f"share of parcels with a spike: {shares}")
    figure.measured("fewer_spikes", share[SPLITS] - share[OURS], f"share of parcels with a spike: {shares}")
    for key, measure in (("area", "area_m2"), ("aspect", "aspect_ratio")):
        ours, theirs = (runs[name].distance(measure)[0] for name in (OURS, SPLITS))
        figure.measured(f"{key}_different", theirs - ours, f"{OURS} {ours:.3f}, {SPLITS} {theirs:.3f}")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig12", draw))
