"""Histograms as in VKW12 (superposed, not normalised), empirical distribution functions, distances in one picture."""

import math

import matplotlib.pyplot as plt
import numpy
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from run_data import OBSERVED, layer_word, plots_word, short_title
from style import (DISTANCES, GENERATED_BLUE, LAYER_COLOURS, LAYER_DASHES, LAYER_MARKERS, OBSERVED_RED,
                   add_bottom_legend, name_of, title_of)

#: Points per curve: as many as a page can show.
ECDF_POINTS = 400


def _grid(count, width=3.5, height=2.6):
    columns = min(3, count)
    rows = math.ceil(count / columns)
    figure, axes = plt.subplots(rows, columns, figsize=(columns * width, rows * height + 0.7), layout="constrained",
                                squeeze=False)
    for spare in list(axes.flat)[count:]:
        spare.set_axis_off()
    return figure, list(axes.flat)[:count]


def bars_of(rows, repetitions):
    """Left edges, widths, heights and whether a bar is an open bin; an open bin is drawn one bin wide."""
    rows = rows.sort_values("bin_low", kind="stable")
    low, high = rows["bin_low"].to_numpy(dtype=float), rows["bin_high"].to_numpy(dtype=float)
    is_open = ~(numpy.isfinite(low) & numpy.isfinite(high))
    width = numpy.min(high[~is_open] - low[~is_open])
    left = numpy.where(numpy.isfinite(low), low, high - width)
    return left, numpy.where(is_open, width, high - low), rows["count"].to_numpy() / repetitions, is_open


def scale_of(histograms, measure):
    """The ends of the closed bins: histograms and distribution functions show the same range."""
    ends = histograms.loc[histograms["measure"] == measure, ["bin_low", "bin_high"]].to_numpy(dtype=float)
    ends = ends[numpy.isfinite(ends)]
    return ends.min(), ends.max()


def draw_superposed(axes, histograms, measure, strategy, repetitions):
    """Observed red, procedural blue, transparent."""
    of = histograms[histograms["measure"] == measure]
    for layer, colour, share in ((OBSERVED, OBSERVED_RED, 1), (strategy, GENERATED_BLUE, repetitions)):
        rows = of[of["layer"] == layer]
        if rows.empty:
            continue
        left, width, height, is_open = bars_of(rows, share)
        closed = ~is_open
        axes.bar(left[closed], height[closed], width[closed], align="edge", color=colour, alpha=0.45, linewidth=0)
        axes.bar(left[is_open], height[is_open], width[is_open], align="edge", color=colour, alpha=0.25, linewidth=0,
                 hatch="////", edgecolor=colour)
    axes.set_xlabel(title_of(measure))
    axes.set_ylabel("parcels")
    axes.margins(x=0.01)


def draw_histograms(figures, run, dataset, strategy):
    histograms = run.of("histograms", dataset)
    figure, panels = _grid(len(run.measures))
    for axes, measure in zip(panels, run.measures):
        draw_superposed(axes, histograms, measure, strategy, run.repetitions)
    add_bottom_legend(figure, [Patch(color=OBSERVED_RED, alpha=0.45, label=plots_word(dataset)),
                               Patch(color=GENERATED_BLUE, alpha=0.45, label=f"procedural ({strategy})"),
                               Patch(facecolor="white", edgecolor="#777777", hatch="////", label="all beyond the scale")])
    figure.suptitle(f"{short_title(dataset)}: {plots_word(dataset)} (red) and {strategy} (blue), "
                    "not normalised")
    name = f"histograms_{strategy}_{dataset['name']}"
    figures.save(figure, name)
    return name


def _curve(values):
    values = numpy.sort(values[numpy.isfinite(values)])
    share = numpy.arange(1, len(values) + 1) / len(values)
    if len(values) > ECDF_POINTS:
        picked = numpy.unique(numpy.linspace(0, len(values) - 1, ECDF_POINTS).round().astype(int))
        values, share = values[picked], share[picked]
    return values, share


def draw_ecdfs(figures, run, dataset):
    parcels = run.of("parcels", dataset)
    layers = [OBSERVED, *run.strategies]
    histograms = run.of("histograms", dataset)
    of_layer = {layer: parcels[parcels["layer"] == layer] for layer in layers}
    figure, panels = _grid(len(run.measures))
    handles = {}
    for axes, measure in zip(panels, run.measures):
        for i, layer in enumerate(layers):
            if of_layer[layer].empty:
                continue
            values, share = _curve(of_layer[layer][measure].to_numpy(dtype=float))
            is_reference = layer == OBSERVED
            handles[layer], = axes.step(
                values, share, where="post", label=layer_word(dataset, layer), linewidth=2.2 if is_reference else 1.3,
                color=OBSERVED_RED if is_reference else LAYER_COLOURS[(i - 1) % len(LAYER_COLOURS)],
                linestyle="-" if is_reference else LAYER_DASHES[(i - 1) % len(LAYER_DASHES)],
                alpha=0.75 if is_reference else 1.0)
        low, high = scale_of(histograms, measure)
        # A measure without spread still needs a scale that can be read.
        margin = 0.05 * max(high - low, 0.02 * abs(high), 1e-3)
        axes.set_xlim(low - margin, high + margin)
        axes.set_ylim(0, 1.02)
        is_count = bool((of_layer[OBSERVED][measure] % 1 == 0).all())
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=is_count))
        axes.ticklabel_format(axis="x", useOffset=False, style="plain")
        axes.set_xlabel(title_of(measure))
        axes.set_ylabel("share of parcels")
    add_bottom_legend(figure, list(handles.values()))
    figure.suptitle(f"{short_title(dataset)}: distribution functions, {plots_word(dataset)} and strategies")
    name = f"ecdf_{dataset['name']}"
    figures.save(figure, name)
    return name


def draw_distances(figures, run, dataset):
    """Every distance in units of its noise floor: left of 1 is as close as one half of the place to the other."""
    rows = run.of("distances", dataset)
    kinds = [k for k in DISTANCES if (rows["distance"] == k).any()]
    step = 0.8 / max(4, len(run.strategies))  # the strategies of a measure take four fifths of its row
    row = 0.42 * max(1.0, len(run.strategies) / 4)
    figure, panels = plt.subplots(1, len(kinds), figsize=(3.6 * len(kinds) + 0.8, row * len(run.measures) + 1.6),
                                  layout="constrained", sharey=True, squeeze=False)
    handles = {}
    for axes, kind in zip(panels.flat, kinds):
        of = rows[(rows["distance"] == kind) & rows["value"].notna() & (rows["noise_mean"] > 0)]
        axes.axvspan(0.0, 1.0, color="#dddddd", zorder=0, linewidth=0)
        for i, strategy in enumerate(run.strategies):
            own = of[of["layer"] == strategy]
            if own.empty:
                continue
            offset = (i - 0.5 * (len(run.strategies) - 1)) * step
            place = own["measure"].map(run.measures.index).to_numpy() + offset
            value = (own["value"] / own["noise_mean"]).to_numpy()
            reach = numpy.array([value - own["ci_low"] / own["noise_mean"], own["ci_high"] / own["noise_mean"] - value])
            reach = numpy.clip(numpy.nan_to_num(reach), 0.0, None)
            handles[strategy] = axes.errorbar(
                value, place, xerr=reach, fmt=LAYER_MARKERS[i % len(LAYER_MARKERS)], markersize=4, linewidth=1.2,
                color=LAYER_COLOURS[i % len(LAYER_COLOURS)], label=strategy)
        axes.set_title(DISTANCES[kind])
        axes.set_xlabel("distance / noise floor")
        axes.set_xlim(left=0)
        axes.set_yticks(range(len(run.measures)), [name_of(m) for m in run.measures])
        axes.grid(axis="x", color="#eeeeee", zorder=-1)
        for border in range(1, len(run.measures)):
            axes.axhline(border - 0.5, color="#dddddd", linewidth=0.6, zorder=-1)
    panels.flat[0].set_ylim(len(run.measures) - 0.4, -0.6)
    add_bottom_legend(figure, list(handles.values()))
    figure.suptitle(f"{short_title(dataset)}: distance from the {plots_word(dataset)}, 95 % intervals "
                    "(grey: noise floor)")
    name = f"distances_{dataset['name']}"
    figures.save(figure, name)
    return name
