"""python3 tell_results.py RUN_DIR: what rcksp_scaling found there, as Markdown."""

import json
import pathlib
import sys

import pandas

LONG_M, FROM_M = 2000.0, 500.0


def milliseconds(seconds):
    return f"{float(f'{1e3 * seconds:.3g}'):,g}"


def cell(cells, study, value, strategy):
    (row,) = cells[(cells.study == study) & (cells.value == value) & (cells.strategy == strategy)].itertuples()
    return row


def goals(cells):
    """(what, bound, measured, holds)"""
    fast = cell(cells, "street", LONG_M, "layered (avx2)")
    yield ("`layered` on AVX2, 2000 m, k = 1", "5 ms", f"{milliseconds(fast.total_s)} ms, least {milliseconds(fast.total_min_s)}, "
           f"of the processor {milliseconds(fast.total_cpu_s)}",
           fast.total_s <= 5e-3)
    graph = cell(cells, "street", LONG_M, "intermediate_graph")
    yield ("`intermediate_graph`, 2000 m, k = 1", "0.5 s, 1 GB", f"{graph.total_s:.3f} s, least {graph.total_min_s:.3f}, "
           f"of the processor {graph.total_cpu_s:.3f}; {graph.peak_mb:.0f} MB, {graph.states_created:,.0f} nodes", graph.total_s <= 0.5 and graph.peak_mb <= 1000)
    for label in ("wall", "processor"):
        of = "" if label == "wall" else "cpu_"
        far = [cell(cells, "street", length, "forward") for length in cells[cells.study == "street"].value.unique()
               if length >= FROM_M]
        text = ", ".join(f"{getattr(r, of + 'ratio'):.0f} ({getattr(r, of + 'ratio_low'):.0f} to {getattr(r, of + 'ratio_high'):.0f})"
                         for r in far)
        yield (f"`forward` / `layered` from {FROM_M:g} m on, {label} time", "at least 50", text,
               all(getattr(r, of + "ratio_low") >= 50 for r in far))
    many = cell(cells, "k_long", 1000, "layered")
    yield ("`layered`, 2000 m: the other 999 of k = 1000", "20 ms", f"{milliseconds(many.rest_s)} ms", many.rest_s <= 20e-3)
    for strategy in ("layered", "intermediate_graph"):
        stream = cell(cells, "k", 1_000_000, strategy)
        if stream.status == "ok":
            yield (f"`{strategy}`, 200 m, k = 10^6", "time stated", f"{stream.total_s:.2f} s, {stream.peak_mb:.0f} MB", True)


def winners(cells):
    """Per study: who was the fastest at each value, of the strategies with options as they come."""
    own = cells[(cells.status == "ok") & (cells.strategy == cells["name"])]
    print("\n| study | the fastest [ms] |\n| --- | --- |")
    for study, rows in own.groupby("study", sort=False):
        best = rows.loc[rows.groupby("value").total_cpu_s.idxmin()]
        print(f"| {study} | " + ", ".join(f"{r.value:g}: `{r.strategy}` {milliseconds(r.total_cpu_s)}" for r in best.itertuples())
              + " |")


def zero_costs(cells):
    """The thesis: where most elements concatenate with zero cost, ranking is often faster than its graph [Har, Sec. 6.4]."""
    print("\n| share of free transitions, 100 m | `intermediate_graph` [ms] | `ranking` | `ranking (no pruning)` |")
    print("| --- | --- | --- | --- |")
    for value in cells[cells.study == "zero_costs"].value.unique():
        times = [cell(cells, "zero_costs", value, s).total_cpu_s for s in ("intermediate_graph", "ranking", "ranking (no pruning)")]
        print(f"| {value:g} | " + " | ".join(milliseconds(t) for t in times) + " |")


def street_table(cells, published):
    own = cells[cells.study == "street"]
    strategies = list(own.strategy.unique())
    print("| street [m] | " + " | ".join(f"`{s}`" for s in strategies) + " | thesis |")
    print("| --- " * (len(strategies) + 2) + "|")
    for value in own.value.unique():
        fields = []
        for strategy in strategies:
            row = cell(cells, "street", value, strategy)
            fields.append(milliseconds(row.total_cpu_s) if row.status == "ok" else row.status.replace("_", " "))
        thesis = {c["quantity"]: dict(zip(c["values"], c["numbers"])) for c in published}
        print(f"| {value:g} | " + " | ".join(fields) + f" | {1e3 * thesis['total_s'][value]:,.0f} |")


def main(arguments):
    if len(arguments) != 1:
        print(__doc__.split("\n", maxsplit=1)[0], file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0])
    cells, exponents = pandas.read_csv(folder / "cells.csv"), pandas.read_csv(folder / "exponents.csv")
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    print(f"{manifest['processor']}, load {manifest['load_before']:.1f} to {manifest['load_after']:.1f}, "
          f"{manifest['duration_s']:.0f} s, commit {manifest['build']['commit'][:10]}.\n")
    print("| to reach | bound | measured | |\n| --- | --- | --- | --- |")
    for what, bound, measured, holds in goals(cells):
        print(f"| {what} | {bound} | {measured} | {'yes' if holds else 'no'} |")
    print("\nMedian processor times in ms, here and below (steadier than the clock on a machine that does other things, and the same else):\n")
    street_table(cells, [c for c in manifest["config"]["published"] if c["study"] == "street"])
    print("\n| exponent of length | total time | processor time | states created |\n| --- | --- | --- | --- |")
    own = exponents[exponents.study == "street"]
    for strategy in own.strategy.unique():
        fields = []
        for quantity in ("total_s", "total_cpu_s", "states"):
            rows = own[(own.strategy == strategy) & (own.quantity == quantity)]
            fields.append(f"{rows.exponent.iloc[0]:.2f} ({rows.low.iloc[0]:.2f} to {rows.high.iloc[0]:.2f}), n = {rows.points.iloc[0]}"
                          if len(rows) else "")
        print(f"| `{strategy}` | " + " | ".join(fields) + " |")
    zero_costs(cells)
    winners(cells)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
