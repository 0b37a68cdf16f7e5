"""ABVA08, figure 8: buildings copied and pasted, and a curved street straightened by two rotations."""

import pathlib
import sys

import geopandas
import numpy
from shapely.geometry import LineString, Point

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, caption, fill, letter, open_map, sheet  # noqa: E402
from places import Window  # noqa: E402
from reconfigured import Session, done, gone_and_new  # noqa: E402

NEAR = [231720.0, 903500.0]
TILES = 800
#: Two parks, the one "museum", the other "army building", and residential land in the southeast and in the centre.
MUSEUM, ARMY = [231592.0, 903668.0], [231493.0, 903657.0]
SOUTHEAST, CENTRE = [231830.0, 903530.0], [231560.0, 903470.0]
#: A bent street: its south end at a crossing, where it bends, its north end. Tiles along it whose centroid is as near are turned.
BENT = [[231746.0, 903435.0], [231719.0, 903489.0], [231680.0, 903594.0]]
NEAR_STREET_M = 6.0
ALONG_M = 22.0
WINDOW = Window("cambridge_ma", 231440.0, 903380.0, 231920.0, 903720.0,
                "parks among residential parcels, and a bent street")
ZONES = {"park": "#7fb77e", "residential": "#f2e6c9", "commercial": "#c9a0dc", "industrial": "#9db7d5", "other": "#bbbbbb",
         "": "#f7f1e3"}


def turn_deg():
    """By which each half has to turn about its end to lie on the chord."""
    a, m, b = (numpy.array(p) for p in BENT)
    angle = lambda v: numpy.degrees(numpy.arctan2(v[1], v[0]))  # noqa: E731
    return angle(b - a) - angle(m - a), angle(a - b) - angle(m - b)


def half(tiles, start, end, taken):
    """Tiles along a half of the street, by their ids."""
    strip = LineString([start, end]).buffer(ALONG_M, cap_style=2)
    return [int(t) for t, c in tiles.frame.centroid.items() if strip.contains(c) and t not in taken]


def operations(observed):
    paste = lambda group, to: {"do": "paste", "group": group, "to": to}  # noqa: E731
    out = [{"do": "copy", "tiles": {"at": MUSEUM}, "as": "museum"}, {"do": "copy", "tiles": {"at": ARMY}, "as": "army"},
           paste("museum", SOUTHEAST), paste("army", MUSEUM), paste("army", CENTRE)]
    south = half(observed, BENT[0], BENT[1], set())
    north = half(observed, BENT[1], BENT[2], set(south))
    for tiles, about, angle in zip((south, north), (BENT[0], BENT[2]), turn_deg()):
        out.append({"do": "move", "tiles": {"ids": tiles}, "angle_deg": float(angle), "about": about})
    return out


def bent_street(figure):
    """The street's pieces in the observed city, by their ids."""
    streets = geopandas.read_file(figure.path("observed.gpkg"), layer="streets").set_index("street")
    near = LineString(BENT).buffer(NEAR_STREET_M)
    return [i for i, g in streets.geometry.items() if near.contains(g)]


def street_points(figure, name, pieces):
    """Where the street's nodes are, from its south end to its north end: its lines follow the tiles."""
    streets = geopandas.read_file(figure.path(f"{name}.gpkg"), layer="streets").set_index("street")
    points = {p for i in pieces for p in streets.geometry[i].coords}
    return numpy.array(sorted(points, key=lambda p: p[1]))


def bend_m(points):
    """How far the street is off the straight line between its ends."""
    chord = points[-1] - points[0]
    return numpy.abs(numpy.cross(chord / numpy.hypot(*chord), points - points[0])).max()


def draw_zones(axes, tiles, key, text, marked=()):
    open_map(axes, numpy.array(WINDOW.shape().bounds))
    fill(axes, tiles.frame, [ZONES[z or ""] for z in tiles.frame["zone"]], INK, 0.35)
    shown = tiles.frame.loc[tiles.frame.index.isin(list(marked))]
    fill(axes, shown, "none", "#b2182b", 1.2)
    letter(axes, key, text)


def draw(figure):
    session = Session(figure, WINDOW.dataset, NEAR, TILES, {"reach_m": 200, "keep_size": 1})
    observed = session.observed()
    script = operations(observed)
    edited, rows = session.run("edited", script)
    _, new = gone_and_new(observed, edited)
    pieces = bent_street(figure)
    centre = {name: street_points(figure, name, pieces) for name in ("observed", "edited")}

    picture, ((a, c), (b, d)) = sheet(2, 2, 14.0, 11.6)
    draw_zones(a, observed, "a", "observed; green: parks")
    draw_zones(c, edited, "c", "edited; red: pasted tiles", new)
    corner = numpy.array([min(p[0] for p in BENT) - 60, min(p[1] for p in BENT) - 10,
                          max(p[0] for p in BENT) + 60, max(p[1] for p in BENT) + 10])
    for axes, tiles, key, text in ((b, observed, "b", "a curved street"), (d, edited, "d", "straightened")):
        open_map(axes, corner)
        fill(axes, tiles.frame, [ZONES[z or ""] for z in tiles.frame["zone"]], INK, 0.5)
        points = centre["observed" if tiles is observed else "edited"]
        axes.plot(points[:, 0], points[:, 1], "o-", markersize=3, color="#b2182b", zorder=5)
        axes.plot(points[[0, -1], 0], points[[0, -1], 1], "--", linewidth=0.8, color=INK, zorder=4)
        letter(axes, key, f"{text}; red: its centre line, {bend_m(points):.1f} m off the straight line")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, observed, edited, rows, centre)


def measure_claims(figure, observed, edited, rows, centre):
    figure.measured("pasted", done(rows, "paste"), "of 3")
    figure.measured("rotations", done(rows, "move"), "of 2")
    before, after = (bend_m(centre[name]) for name in ("observed", "edited"))
    figure.measured("straightened", after / before, f"bend {before:.2f} and {after:.2f} m")
    _, new = gone_and_new(observed, edited)
    zones, now = observed.frame["zone"].fillna(""), edited.frame["zone"].fillna("")
    parks = [t for t in observed.frame.index if observed.frame.geometry[t].contains(Point(*MUSEUM))
             or observed.frame.geometry[t].contains(Point(*ARMY))]
    expected = {zones[t] for t in parks}
    same = [now[t] == zones[t] for t in now.index if t in zones.index] + [now[t] in expected for t in new]
    figure.measured("zones", numpy.mean(same), f"{len(same)} tiles")
    figure.measured("replaced_residential", (sum(zones[t] != "park" for t in gone_and_new(observed, edited)[0])),
                    f"{len(gone_and_new(observed, edited)[0])} tiles gone")
    figure.measured("connected", edited.parts(), f"{observed.parts()} before")
    shapes = numpy.array([numpy.linalg.svd(p[:, :2])[1] for p in edited.placements.values()])
    deformation = shapes[:, 0] - shapes[:, 1]
    figure.measured("deformation", deformation.mean(), f"at most {deformation.max():.2f}")


if __name__ == "__main__":
    sys.exit(make("abva08/fig08", draw))
