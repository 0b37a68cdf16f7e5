"""Says in words what the tables say, and no more."""

import pandas

from run_data import plots_word
from style import DISTANCES, name_of, unit_of

ALPHA = 0.05


def number(value, digits=3):
    """A number for reading: three digits that count."""
    if value is None or pandas.isna(value):
        return "–"
    value = float(value)
    if value == 0.0:
        return "0"
    if abs(value) >= 1000:
        return f"{value:,.0f}"
    text = f"{value:.{digits}g}"
    return f"{value:.{digits + 3}f}".rstrip("0") if "e" in text else text


def join(words):
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def _ranking(run, dataset, measure, kind):
    rows = run.of("distances", dataset)
    rows = rows[(rows["measure"] == measure) & (rows["distance"] == kind) & rows["value"].notna()]
    return rows.sort_values(["value", "layer"], kind="stable")


def _holm(run, dataset, measure, kind, a, b):
    rows = run.of("differences", dataset)
    rows = rows[(rows["measure"] == measure) & (rows["distance"] == kind)]
    for one, other in ((a, b), (b, a)):
        hit = rows[(rows["layer_a"] == one) & (rows["layer_b"] == other)]
        if len(hit):
            return float(hit["p_holm"].iloc[0])
    return None


def closest_with_evidence(run, dataset, measure, kind="ks"):
    """(layers that lead, whether the lead over every other is significant). Layers whose difference from the nearest
    is not significant share the lead."""
    rows = _ranking(run, dataset, measure, kind)
    if rows.empty:
        return [], False
    best = rows["layer"].iloc[0]
    tied = [best]
    for other in rows["layer"].iloc[1:]:
        p = _holm(run, dataset, measure, kind, best, other)
        if p is None or p > ALPHA:
            tied.append(other)
    return tied, len(tied) == 1


def measure_sentence(run, dataset, measure):
    rows = _ranking(run, dataset, measure, "ks")
    if rows.empty:
        return f"On {name_of(measure)} no strategy has parcels to compare."
    best = rows.iloc[0]
    leaders, is_clear = closest_with_evidence(run, dataset, measure)
    text = f"On {name_of(measure)}, {best['layer']} is closest (KS {number(best['value'])}"
    if pandas.notna(best["ci_low"]):
        text += f", 95 % {number(best['ci_low'])} to {number(best['ci_high'])}"
    text += ")"
    if len(rows) > 1:
        if is_clear:
            text += ", and the difference from every other strategy is significant"
        else:
            text += f", but not significantly closer than {join(leaders[1:])}"
    if pandas.notna(best["noise_mean"]):
        if best["value"] <= best["noise_high"]:
            text += (f"; within the noise floor (mean {number(best['noise_mean'])}, up to "
                     f"{number(best['noise_high'])})")
        else:
            text += f"; {number(best['value'] / best['noise_mean'], 2)} times the noise floor"
    others = []
    for kind in ("wasserstein", "jensen_shannon"):
        ranked = _ranking(run, dataset, measure, kind)
        if len(ranked) and ranked["layer"].iloc[0] != best["layer"]:
            first = ranked.iloc[0]
            unit = f" {unit_of(measure)}" if kind == "wasserstein" and unit_of(measure) else ""
            others.append(f"{DISTANCES[kind]} names {first['layer']} ({number(first['value'])}{unit}) instead")
    return text + ("" if not others else "; " + join(others)) + "."


def summary_sentences(run, dataset):
    """The paragraph at the top of a data set."""
    leads = {s: [] for s in run.strategies}
    shared, reached = [], 0
    for measure in run.measures:
        leaders, is_clear = closest_with_evidence(run, dataset, measure)
        if not leaders:
            continue
        if is_clear:
            leads[leaders[0]].append(name_of(measure))
        else:
            shared.append(f"{name_of(measure)} ({', '.join(leaders)})")
        best = _ranking(run, dataset, measure, "ks").iloc[0]
        if pandas.notna(best["noise_high"]) and best["value"] <= best["noise_high"]:
            reached += 1
    out = []
    clear = {s: names for s, names in leads.items() if names}
    if len(run.strategies) > 1:
        for s, names in sorted(clear.items(), key=lambda item: (-len(item[1]), item[0])):
            out.append(f"{s} is closest to the {plots_word(dataset)} on {join(names)}.")
        if shared:
            out.append(f"No significant first place on {join(shared)}.")
    out.append(f"On {reached} of {len(run.measures)} measures the nearest strategy lies within the noise floor, that "
               "is, as near as one random half of the blocks to the other"
               + ("." if reached else ": none of the strategies reproduces this place fully."))
    blocks = run.of("blocks", dataset)
    for s in run.strategies:
        own = blocks[blocks["layer"] == s]
        failed = int((own["status"] != "ok").sum())
        if len(own) == 0 or failed == len(own):
            out.append(f"{s} divided no block.")
        elif failed:
            out.append(f"{s} left {failed} of {len(own)} blocks undivided ({100.0 * failed / len(own):.1f} %).")
    if dataset.get("plots") == "tessellated":
        out.append("There is no cadastre here: the reference is tessellated plots, cells of an enclosed tessellation "
                   "of the building footprints, so closeness says how well a strategy follows the buildings, not "
                   "property lines.")
    return out
