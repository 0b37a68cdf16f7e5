"""Tables of the report, as HTML."""

import html

import pandas

from run_data import OBSERVED, layer_word, plots_word, short_title
from style import DISTANCES, name_of, unit_of
from verdict import ALPHA, number


def escape(text):
    return html.escape(str(text))


def table(caption, header, rows):
    """`rows` hold text or (text, css class)."""
    out = [f"<table><caption>{escape(caption)}</caption><thead><tr>"]
    out += [f"<th>{escape(h)}</th>" for h in header]
    out.append("</tr></thead><tbody>")
    for row in rows:
        cells = (c if isinstance(c, tuple) else (c, "") for c in row)
        out.append("<tr>" + "".join(f"<td{f' class={k!r}' if k else ''}>{escape(t)}</td>" for t, k in cells) + "</tr>")
    out.append("</tbody></table>")
    return "\n".join(out)


def interval(low, high):
    return "–" if pandas.isna(low) else f"{number(low)} … {number(high)}"


def overview_table(run, dataset):
    parcels = run.of("parcels", dataset)
    blocks = run.of("blocks", dataset)
    rows = []
    for layer in (OBSERVED, *run.strategies):
        own = parcels[parcels["layer"] == layer]
        per_block = blocks[blocks["layer"] == layer]
        failed = "–" if layer == OBSERVED else f"{int((per_block['status'] != 'ok').sum())} of {len(per_block)}"
        medians = [number(own[m].median()) if len(own) else "–"
                   for m in ("area_m2", "width_m", "aspect_ratio", "frontage_m") if m in parcels.columns]
        access = f"{100 * own['has_street_access'].mean():.1f} %" if len(own) and "has_street_access" in own else "–"
        count = len(own) / (1 if layer == OBSERVED else run.repetitions)
        rows.append([layer_word(dataset, layer), f"{count:,.0f}", *medians, access, failed])
    return table(f"{short_title(dataset)}: {plots_word(dataset)} and strategies",
                 ["layer", "parcels", "median area [m²]", "median width [m]", "median aspect ratio",
                  "median frontage [m]", "with street access", "blocks undivided"], rows)


def distance_tables(run, dataset):
    """One table per distance, each measure's strategies sorted by distance."""
    out = []
    everything = run.of("distances", dataset)
    for kind, title in DISTANCES.items():
        rows = []
        for measure in run.measures:
            of = everything[(everything["distance"] == kind) & (everything["measure"] == measure)]
            of = of.sort_values(["value", "layer"], kind="stable", na_position="last")
            unit = unit_of(measure) if kind == "wasserstein" else ""
            for i, row in enumerate(of.itertuples()):
                is_near = pandas.notna(row.value) and pandas.notna(row.noise_high) and row.value <= row.noise_high
                ratio = ("–" if pandas.isna(row.value) or pandas.isna(row.noise_mean) or row.noise_mean == 0
                         else number(row.value / row.noise_mean, 2))
                rows.append([name_of(measure) + (f" [{unit}]" if unit else "") if i == 0 else "", row.layer,
                             (number(row.value), "best" if i == 0 else ""), interval(row.ci_low, row.ci_high),
                             number(row.noise_mean), interval(row.noise_low, row.noise_high),
                             (ratio, "near" if is_near else ""), f"{row.n_blocks:,}", f"{row.n_generated:,}"])
        out.append(table(
            f"{short_title(dataset)}: {title} distance from the {plots_word(dataset)}, nearest first",
            ["measure", "strategy", "distance", "95 % interval", "noise floor", "its 95 % range", "ratio", "blocks",
             "parcels"], rows))
    return out


def difference_table(run, dataset, kind):
    rows = run.of("differences", dataset)
    rows = rows[rows["distance"] == kind]
    order = {m: i for i, m in enumerate(run.measures)}
    rows = rows.assign(order=rows["measure"].map(order), size=rows["effect_size"].abs())
    rows = rows.sort_values(["order", "layer_a", "layer_b"], kind="stable")
    body = []
    for row in rows.itertuples():
        is_significant = row.p_holm <= ALPHA
        nearer = row.layer_a if row.difference < 0 else row.layer_b
        body.append([name_of(row.measure), f"{row.layer_a} − {row.layer_b}", number(row.difference),
                     interval(row.ci_low, row.ci_high), number(row.p_value, 2),
                     (number(row.p_holm, 2), "best" if is_significant else ""), f"{row.effect_size:+.2f}",
                     nearer if is_significant else "not decided"])
    if not body:
        return ""
    return table(f"{short_title(dataset)}: {DISTANCES[kind]}, paired differences on the same blocks against "
                 f"{plots_word(dataset)}",
                 ["measure", "pair", "difference", "95 % interval", "p", "p (Holm)", "effect size", "closer"], body)


def search_table(run, dataset):
    """The options that were found, a row per strategy and fold."""
    if run.search is None or run.of("search", dataset).empty:
        return ""
    rows = []
    for (layer, fold), points in run.of("search", dataset).groupby(["layer", "fold"], sort=False):
        chosen = points[points["is_chosen"] == 1].iloc[0]
        rows.append([layer, f"{fold + 1}", chosen["options"].replace(";", ", "), number(chosen["score"]),
                     number(points["score"].max()), f"{points['options'].nunique():,}", f"{chosen['blocks']:,}",
                     ", ".join(name_of(m) for m in points["measure"].unique())])
    return table(f"{short_title(dataset)}: options found by search, per part of the blocks",
                 ["strategy", "part", "options", "score", "worst score", "points", "blocks searched", "score of"], rows)


def failure_table(run, dataset):
    blocks = run.of("blocks", dataset)
    failed = blocks[(blocks["status"] != "ok") & (blocks["layer"] != OBSERVED)]
    if failed.empty:
        return ""
    rows = []
    for (layer, status), group in failed.groupby(["layer", "status"], sort=True):
        ids = ", ".join(str(b) for b in sorted(group["block_id"].unique())[:8])
        if group["block_id"].nunique() > 8:
            ids += ", …"
        rows.append([layer, status, len(group), ids, group["message"].iloc[0]])
    return table(f"{short_title(dataset)}: blocks left undivided ({plots_word(dataset)} are there)",
                 ["strategy", "code", "blocks", "which", "first message"], rows)
