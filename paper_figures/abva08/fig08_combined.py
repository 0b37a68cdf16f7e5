"""ABVA08, figure 8: buildings copied and pasted, and a curved street straightened by two rotations."""

import pathlib
import sys

import numpy
from shapely.geometry import LineString, Point

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, caption, fill, letter, open_map, sheet  # noqa: E402
from reconfigured import Session, done, gone_and_new  # noqa: E402

NEAR = [231720.0, 903500.0]
TILES = 800
#: Two parks, the one "museum", the other "army building", and residential land in the southeast and in the centre.
MUSEUM, ARMY = [231592.0, 903668.0], [231493.0, 903657.0]
SOUTHEAST, CENTRE = [231830.0, 903530.0], [231660.0, 903480.0]
#: Gorham Street: its south end, where it bends, its north end. Tiles along it whose centroid is as near are turned.
BENT = [[231775.0, 903387.0], [231719.0, 903489.0], [231680.0, 903594.0]]
ALONG_M = 22.0
WINDOW = numpy.array([231440.0, 903380.0, 231920.0, 903720.0])
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
    return out, south + north


def street_points(tiles, along):
    """Where links cross the street: between two of the tiles along it, on its two sides."""
    links = tiles.links
    both = links["tile_a"].isin(along) & links["tile_b"].isin(along)
    points = numpy.array([[p.x, p.y] for p in links.loc[both].geometry])
    return points


def sagitta_m(points):
    """How far the street bends off a straight line: of points by the least parabola, against its ends."""
    middle = points.mean(axis=0)
    axis = numpy.linalg.svd(points - middle)[2][0]
    along, across = (points - middle) @ axis, (points - middle) @ numpy.array([-axis[1], axis[0]])
    bend = numpy.polynomial.Polynomial.fit(along, across, 2).convert().coef[2]
    return abs(bend) * ((along.max() - along.min()) / 2) ** 2


def draw_zones(axes, tiles, key, text, marked=()):
    open_map(axes, WINDOW)
    fill(axes, tiles.frame, [ZONES[z or ""] for z in tiles.frame["zone"]], INK, 0.35)
    shown = tiles.frame.loc[tiles.frame.index.isin(list(marked))]
    fill(axes, shown, "none", "#b2182b", 1.2)
    letter(axes, key, text)


def draw(figure):
    session = Session(figure, "cambridge_ma", NEAR, TILES, {"reach_m": 200, "keep_size": 1})
    observed = session.observed()
    script, along = operations(observed)
    edited, rows = session.run("edited", script)
    _, new = gone_and_new(observed, edited)

    picture, ((a, b), (c, d)) = sheet(2, 2, 14.0, 11.6)
    draw_zones(a, observed, "a", "observed; green: parks")
    draw_zones(b, edited, "c", "edited; red: pasted tiles", new)
    corner = numpy.array([min(p[0] for p in BENT) - 60, min(p[1] for p in BENT) - 10,
                          max(p[0] for p in BENT) + 60, max(p[1] for p in BENT) + 10])
    for axes, tiles, key, text in ((c, observed, "b", "a curved street"), (d, edited, "d", "straightened")):
        open_map(axes, corner)
        fill(axes, tiles.frame, [ZONES[z or ""] for z in tiles.frame["zone"]], INK, 0.5)
        points = street_points(tiles, along)
        axes.scatter(points[:, 0], points[:, 1], s=14, color="#b2182b", zorder=5)
        letter(axes, key, f"{text}; dots: middle of the street, bend {sagitta_m(points):.1f} m")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, observed, edited, rows, along)


def measure_claims(figure, observed, edited, rows, along):
    figure.measured("pasted", done(rows, "paste"), "of 3")
    figure.measured("rotations", done(rows, "move"), "of 2")
    before, after = (sagitta_m(street_points(t, along)) for t in (observed, edited))
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
