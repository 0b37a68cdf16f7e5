"""AVB08, figure 2: streets and intersection points of a fragment, and the attributes that the points carry."""

import collections
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import GREY, INK, caption, letter, lines, open_map, sheet  # noqa: E402
from exemplars import Exemplar, level_style  # noqa: E402
from places import Window  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patches import Wedge  # noqa: E402

FRAGMENT = Window("cambridge_ma", 232450.0, 901450.0, 233250.0, 902250.0,
                  "Cambridgeport: main streets, a fairly regular grid and streets that end, in one fragment")
YELLOW, BLUE = "#f2c230", "#1f4e9c"
#: Radius of a point's disc for parcels of 100 m2, metres; its area grows with theirs.
RADIUS_M = 5.0


def discs(axes, points):
    """Each point as two half discs, streets a and b, in their levels' colours; as large as the parcels nearby."""
    for row in points.itertuples():
        area = row.parcel_area_m2 if not math.isnan(row.parcel_area_m2) else 100.0
        radius = RADIUS_M * math.sqrt(min(area, 2000.0) / 100.0)
        at = (row.geometry.x, row.geometry.y)
        axes.add_patch(Wedge(at, radius, 90, 270, facecolor=level_style(row.a_hierarchy)[0], edgecolor=INK, linewidth=0.4))
        face = "white" if math.isnan(row.b_hierarchy) else level_style(row.b_hierarchy)[0]
        axes.add_patch(Wedge(at, radius, -90, 90, facecolor=face, edgecolor=INK, linewidth=0.4))


def annotate(axes, row, foot):
    """What one point knows, written under the map at the share `foot` of its width."""
    text = "\n".join(f"{s}: $h_{int(row[s + '_hierarchy'])}$, $t$ {row[s + '_tortuosity']:.2f}, "
                     f"$\\mu_d$ {row[s + '_distance_mean_m']:.0f}±{math.sqrt(row[s + '_distance_variance_m2']):.0f} m, "
                     f"$\\mu_\\alpha$ {math.degrees(row[s + '_angle_mean_rad']):.0f}±"
                     f"{math.degrees(math.sqrt(row[s + '_angle_variance_rad2'])):.0f}°"
                     for s in ("a", "b"))
    axes.annotate(f"{text}\nparcels {row['parcel_area_m2']:.0f} m²", (row.geometry.x, row.geometry.y), (foot, -0.065),
                  textcoords="axes fraction", fontsize=7.5, va="center", ha="center", zorder=30, annotation_clip=False,
                  bbox={"boxstyle": "round,pad=0.3", "facecolor": "white", "edgecolor": GREY},
                  arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.8, "shrinkB": 4.0})


def draw(figure):
    city = Exemplar(figure, FRAGMENT.dataset)
    shape = FRAGMENT.shape()
    points = city.points[city.points.within(shape)]
    pieces = city.pieces[city.pieces.intersects(shape)]
    bounds = list(shape.bounds)

    picture, ((left, right),) = sheet(1, 2, 13.5, 7.4)
    for axes in (left, right):
        open_map(axes, bounds)
        axes.set_xlim(bounds[0], bounds[2])
        axes.set_ylim(bounds[1], bounds[3])
    lines(left, pieces, YELLOW, 2.2)
    left.scatter(points.geometry.x, points.geometry.y, s=22, color=BLUE, zorder=5)
    letter(left, "left", "streets (yellow) and their intersection points (blue)")
    discs(right, points)
    both = points[points["b_hierarchy"].notna() & points["parcel_area_m2"].notna()]
    for x, y, foot in ((0.38, 0.08, 0.4), (0.87, 0.07, 0.8)):
        at = (bounds[0] + x * (bounds[2] - bounds[0]), bounds[1] + y * (bounds[3] - bounds[1]))
        nearest = both.iloc[((both.geometry.x - at[0]) ** 2 + (both.geometry.y - at[1]) ** 2).argmin()]
        annotate(right, nearest, foot)
    levels = sorted(set(points["a_hierarchy"]) | {int(h) for h in points["b_hierarchy"].dropna()})
    right.legend(handles=[Line2D([], [], marker="o", linestyle="", color=level_style(h)[0], label=f"$h_{h}$") for h in levels],
                 fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0), title="level of a | b", title_fontsize=8)
    letter(right, "right", "what the points know: half discs a | b by level, disc area by parcels' area")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, city)


def measure_claims(figure, city):
    """On the whole city: ends of pieces per place against the points there."""
    ends = collections.Counter()
    for line in city.pieces.geometry:
        for end in (line.coords[0], line.coords[-1]):
            ends[tuple(end[:2])] += 1
    slots = collections.Counter()
    for row in city.points.itertuples():
        of_b = 0 if math.isnan(row.b_connections) else int(row.b_connections)
        slots[(row.geometry.x, row.geometry.y)] += row.a_connections + of_b
    missing = [place for place, degree in ends.items() if degree != 2 and place not in slots]
    figure.measured("every_place", len(missing), f"{len(slots)} places of {len(city.points)} points")
    figure.measured("every_segment", max(abs(ends[place] - n) for place, n in slots.items()),
                    f"{sum(slots.values())} segment ends")
    vertices = sum(len(line.coords) for line in city.pieces.geometry)
    figure.measured("compact", len(city.points) / vertices, f"{vertices} vertices of centrelines")


if __name__ == "__main__":
    sys.exit(make("avb08/fig02", draw))
