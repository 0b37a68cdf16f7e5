"""ABVA08, figure 7: a structure replicated by copy and paste, before and after the constraint system is solved again."""

import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, caption, fill, letter, open_map, sheet  # noqa: E402
from places import Window  # noqa: E402
from reconfigured import Session, done, gone_and_new  # noqa: E402

#: Parcels of several sizes around a bent street.
NEAR = [231720.0, 903500.0]
TILES = 800
#: A park of 1,100 m2 with two streets, and three places among residential parcels.
SOURCE = [231592.0, 903668.0]
PLACES = [[231830.0, 903530.0], [231680.0, 903610.0], [231560.0, 903470.0]]
SLIGHT_M = 5.0
WINDOW = Window("cambridge_ma", 231440.0, 903400.0, 231920.0, 903720.0,
                "parcels of several sizes, and a park, around bent streets")
LAND, PASTED = "#f2e6c9", "#7fb77e"


def pasted_one_by_one(session):
    """The city after each number of pastes."""
    states = [session.observed()]
    for count in range(1, len(PLACES) + 1):
        operations = [{"do": "copy", "tiles": {"at": SOURCE}, "as": "structure"}]
        operations += [{"do": "paste", "group": "structure", "to": place} for place in PLACES[:count]]
        state, rows = session.run(f"pasted_{count}", operations)
        states.append(state)
    return states, rows


def unsolved(before, after):
    """Placements right after the paste: those of before, and of what is new."""
    return {t: before.placements.get(t, p) for t, p in after.placements.items()}


def draw_state(axes, tiles, marked, key, text):
    open_map(axes, numpy.array(WINDOW.shape().bounds))
    fill(axes, tiles, [PASTED if t in marked else LAND for t in tiles.index], INK, 0.35)
    letter(axes, key, text)


def draw(figure):
    session = Session(figure, WINDOW.dataset, NEAR, TILES, {"reach_m": 200, "keep_size": 1})
    states, rows = pasted_one_by_one(session)
    first, last = states[0], states[-1]
    _, new = gone_and_new(first, last)
    holds = first.frame.geometry.contains(_point(SOURCE))
    source = first.frame.index[holds][0]

    picture, ((a, b, c),) = sheet(1, 3, 17.0, 5.2)
    draw_state(a, first.frame, {source}, "a", "observed; green: what is copied")
    draw_state(b, last.placed(unsolved(first, last)), {source, *new}, "b", f"{len(new)} copies pasted")
    draw_state(c, last.frame, {source, *new}, "c", "after solving the constraints again")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, states, rows, source)


def _point(at):
    from shapely.geometry import Point
    return Point(*at)


def measure_claims(figure, states, rows, source):
    figure.measured("replicated", done(rows, "paste"), f"of {len(PLACES)}")
    sizes, inherited, connections, before_m, after_m = [], [], [], [], []
    size = states[0].frame["area_m2"][source]
    for before, after in zip(states, states[1:]):
        gone, new = gone_and_new(before, after)
        if not new:
            continue
        sizes.append(size / before.frame["area_m2"][gone].sum())
        old = set().union(*(before.neighbours(t) for t in gone)) - set(gone)
        now = set().union(*(after.neighbours(t) for t in new)) - set(new)
        inherited.append(len(old & now) / len(old))
        connections.append(len(old))
        before_m.extend(after.gaps_m(unsolved(before, after), set(new)))
        after_m.extend(after.gaps_m(after.placements, set(new)))
    ratio = max(max(s, 1 / s) for s in sizes) if sizes else float("nan")
    figure.measured("different_size", ratio, "copy over what it replaced: " + ", ".join(f"{s:.2f}" for s in sizes))
    own = len(states[0].neighbours(source))
    figure.measured("different_connectivity", max((abs(c - own) for c in connections), default=0),
                    f"{own} where it is copied, {connections} where it is pasted")
    figure.measured("inherits", numpy.mean(inherited) if inherited else float("nan"),
                    ", ".join(f"{s:.2f}" for s in inherited))
    figure.measured("gap_minimised", numpy.mean(after_m) / numpy.mean(before_m) if before_m else float("nan"),
                    f"mean gap {numpy.mean(before_m):.2f} and {numpy.mean(after_m):.2f} m, {len(after_m)} joints")
    first, last = states[0].frame, states[-1].frame
    both = first.index.intersection(last.index)
    moved = first.loc[both].centroid.distance(last.loc[both].centroid)
    figure.measured("slightly_perturbed", (moved <= SLIGHT_M).mean(),
                    f"{int((moved > 0.01).sum())} of {len(both)} tiles moved, the farthest {moved.max():.1f} m")


if __name__ == "__main__":
    sys.exit(make("abva08/fig07", draw))
