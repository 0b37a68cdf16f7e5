"""Har, figure 3.1: the intermediate graph of three elements under an equality and an interval, as the strategy builds it."""

import json
import pathlib
import sys

from matplotlib.patches import Circle, FancyArrowPatch
from matplotlib.lines import Line2D

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, caption, letter, sheet  # noqa: E402

METHOD = "intermediate_graph"
#: Three elements as in the thesis's caption; lambda 1 has an interval, lambda 2 an equality.
PROBLEM = {
    "resources": [{"name": "lambda_1"}, {"name": "lambda_2"}],
    "elements": [{"name": "A", "uses": {"lambda_1": 1, "lambda_2": 1}, "back": False},
                 {"name": "B", "uses": {"lambda_1": 0, "lambda_2": 1}, "front": False},
                 {"name": "C", "uses": {"lambda_1": 1, "lambda_2": 2}}],
    "transitions": [{"from": "A", "to": "A", "cost": 2}, {"from": "A", "to": "B", "cost": 1},
                    {"from": "A", "to": "C", "cost": 3}, {"from": "B", "to": "B", "cost": 4},
                    {"from": "B", "to": "A", "cost": 1}, {"from": "B", "to": "C", "cost": 1},
                    {"from": "C", "to": "C", "cost": 2}, {"from": "C", "to": "B", "cost": 3}],
    "bounds": {"lambda_1": [2, 3], "lambda_2": 5}}
COLOURS = {"A": "#8dd3c7", "B": "#ffed8a", "C": "#fb9a8f"}
RIM = {"front": "#1f50c8", "end": "#e07b00", "both": INK}
#: Rows of a level: one for each element, its vectors side by side in it.
ROW, STEP, RADIUS = {"A": 2.4, "B": 0.0, "C": -2.4}, 0.85, 0.27
MANY = 10_000


def places_of(graph):
    """Left to right by level; within a level and an element, one below the other by vector."""
    places, seen = [], {}
    for state in graph["states"]:
        key = state["level"], state["element"]
        number = seen.setdefault(key, [])
        number.append(len(places))
        places.append(key)
    out = [None] * len(places)
    for (level, element), members in seen.items():
        for i, state in enumerate(members):
            out[state] = (1.6 * level, ROW[element] + STEP * ((len(members) - 1) / 2 - i))
    return out


def arrow(axes, start, end, colour, width, style="-", bend=0.06):
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=7, shrinkA=11, shrinkB=11, color=colour,
                                   linewidth=width, linestyle=style, connectionstyle=f"arc3,rad={bend}", zorder=1))


def draw_states(axes, graph, places, only_alive):
    for state, (x, y) in zip(graph["states"], places):
        if only_alive and not state["alive"]:
            continue
        side = "both" if state["from_front"] and state["from_end"] else "front" if state["from_front"] else "end"
        axes.add_patch(Circle((x, y), RADIUS, facecolor=COLOURS[state["element"]] if state["alive"] else "white",
                              edgecolor=INK if only_alive else RIM[side], linewidth=1.6,
                              linestyle="-" if state["alive"] else ":", zorder=3))
        axes.text(x, y + 0.05, state["element"], ha="center", va="center", fontsize=7.5, weight="bold", zorder=4)
        axes.text(x, y - 0.13, "{},{}".format(*state["consumed"]), ha="center", va="center", fontsize=5.2, zorder=4)


def draw_graph(axes, graph, places, only_alive, best=()):
    states = graph["states"]
    shown = [s["alive"] or not only_alive for s in states]
    right = max(x for x, _ in places) + 1.6
    ends = {"s": (-1.4, ROW["A"]), "t": (right, ROW["C"])}
    chosen = set(zip(best, best[1:]))
    for arc in graph["arcs"]:
        if not (shown[arc["from"]] and shown[arc["to"]]):
            continue
        is_alive = states[arc["from"]]["alive"] and states[arc["to"]]["alive"]
        is_best = (arc["from"], arc["to"]) in chosen
        arrow(axes, places[arc["from"]], places[arc["to"]], "#c0392b" if is_best else INK if is_alive else "#bbbbbb",
              2.0 if is_best else 0.7)
        if only_alive:
            (x, y), (u, v) = places[arc["from"]], places[arc["to"]]
            axes.text(0.55 * x + 0.45 * u, 0.55 * y + 0.45 * v, f"{arc['cost']:g}", fontsize=6, color="#555555", zorder=2,
                      bbox={"boxstyle": "circle,pad=0.08", "facecolor": "white", "edgecolor": "none"})
    for i, (state, place) in enumerate(zip(states, places)):
        if state["entry"] and shown[i]:
            arrow(axes, ends["s"], place, "#c0392b" if best and best[0] == i else INK, 2.0 if best and best[0] == i else 0.7)
        if state["exit"] and shown[i]:
            arrow(axes, place, ends["t"], "#c0392b" if best and best[-1] == i else INK, 2.0 if best and best[-1] == i else 0.7)
    draw_states(axes, graph, places, only_alive)
    for name, place in ends.items():
        axes.add_patch(Circle(place, RADIUS, facecolor="#dddddd", edgecolor=INK, zorder=3))
        axes.text(*place, name, ha="center", va="center", fontsize=9, style="italic", zorder=4)
    levels = sorted({s["level"] for s in states})
    for level in levels:
        axes.text(1.6 * level, -4.3, f"l = {level}", ha="center", fontsize=7, color="#777777")
        axes.axvline(1.6 * level, color="#f0f0f0", zorder=0)
    axes.set_xlim(-2.0, right + 0.6)
    axes.set_ylim(-5.4, 4.2)
    axes.set_aspect("equal")
    axes.axis("off")


def paths_of(graph):
    """All sequences from s to t, as lists of states."""
    heads = {}
    for arc in graph["arcs"]:
        heads.setdefault(arc["from"], []).append(arc["to"])
    alive = [s["alive"] for s in graph["states"]]
    found, open_paths = [], [[i] for i, s in enumerate(graph["states"]) if s["entry"] and s["alive"]]
    while open_paths:
        path = open_paths.pop()
        if graph["states"][path[-1]]["exit"]:
            found.append(path)
        open_paths += [path + [head] for head in heads.get(path[-1], []) if alive[head]]
    return found


def breaks_a_bound(graph, path):
    uses = {e["name"]: e["uses"] for e in PROBLEM["elements"]}
    one, two = (sum(uses[graph["states"][i]["element"]][r] for i in path) for r in ("lambda_1", "lambda_2"))
    low, high = PROBLEM["bounds"]["lambda_1"]
    return not low <= one <= high or two != PROBLEM["bounds"]["lambda_2"]


def dead_ends(graph):
    alive = {i for i, s in enumerate(graph["states"]) if s["alive"]}
    arcs = [a for a in graph["arcs"] if a["from"] in alive and a["to"] in alive]
    left, entered = {a["from"] for a in arcs}, {a["to"] for a in arcs}
    return sum(not (i in left or graph["states"][i]["exit"]) or not (i in entered or graph["states"][i]["entry"])
               for i in alive)


def draw(figure):
    problem, dump = figure.path("problem.json"), figure.path("graph.json")
    problem.write_text(json.dumps(PROBLEM), encoding="utf-8")
    said = figure.plat("search", problem, "--method", METHOD, "--k", MANY, "--json", "--graph", dump)
    found = [json.loads(line) for line in said.splitlines()][:-1]
    graph = json.loads(dump.read_text(encoding="utf-8"))
    places, paths = places_of(graph), paths_of(graph)
    cost = {(a["from"], a["to"]): a["cost"] for a in graph["arcs"]}
    best = min(paths, key=lambda path: (sum(cost[step] for step in zip(path, path[1:])), path))

    picture, ((left, right),) = sheet(1, 2, 13.5, 6.2)
    draw_graph(left, graph, places, only_alive=False)
    letter(left, "left", f"grown from both sides: {len(graph['states'])} nodes")
    left.legend(handles=[Line2D([], [], marker="o", linestyle="", markerfacecolor="white", markeredgecolor=RIM[k],
                                markeredgewidth=1.6, label=text) for k, text in
                         (("front", "reached from s"), ("end", "reached from t"), ("both", "from both"))]
                + [Line2D([], [], marker="o", linestyle="", markerfacecolor="white", markeredgecolor="#777777",
                          label="white: dead end")], fontsize=7, loc="lower center", ncol=4)
    draw_graph(right, graph, places, only_alive=True, best=best)
    alive = sum(s["alive"] for s in graph["states"])
    letter(right, "right", f"after pruning: {alive} nodes, {len(paths)} sequences from s to t; the best in red")
    caption(picture, figure, "A node names its element and, below it, what has been consumed of λ1, λ2; l is its level; "
                             "numbers on arcs are transition costs.")
    figure.save(picture)

    figure.measured("feasible", sum(breaks_a_bound(graph, p) for p in paths), f"of {len(paths)} paths")
    figure.measured("complete", abs(len(paths) - len(found)), f"{len(found)} sequences found by plat search")
    figure.measured("acyclic", sum(a["to"] <= a["from"] for a in graph["arcs"]), f"of {len(graph['arcs'])} arcs")
    figure.measured("dead_ends", dead_ends(graph), f"of {alive} nodes")


if __name__ == "__main__":
    sys.exit(make("har/fig03_01", draw))
