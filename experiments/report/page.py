"""Puts figures and tables on one page that needs nothing from outside."""

import base64

from run_data import plots_word
from tables import difference_table, distance_tables, escape, failure_table, overview_table, search_table
from verdict import measure_sentence, summary_sentences

CSS = """
body { font: 15px/1.45 system-ui, sans-serif; max-width: 1120px; margin: 2em auto; padding: 0 1em; color: #222; }
h1 { font-size: 1.6em; } h2 { border-bottom: 2px solid #222; margin-top: 2em; } h3 { margin-top: 1.6em; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: 0.3em 0; }
th, td { text-align: right; padding: 0.15em 0.7em; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2) { text-align: left; }
td.best { font-weight: 700; } td.near { background: #e3f1e3; }
figure { margin: 1em 0; } figure img { max-width: 100%; } figcaption { color: #555; font-size: 13px; }
.verdict { background: #f4f4ee; padding: 0.8em 1.2em; border-left: 4px solid #222; }
.warning { background: #fff3d6; padding: 0.5em 1.2em; border-left: 4px solid #c80; }
dl { display: grid; grid-template-columns: max-content auto; gap: 0.1em 1em; font-size: 13px; }
dt { font-weight: 600; } dd { margin: 0; } details { margin: 0.6em 0; }
"""

CAPTIONS = {
    "map_aspect_ratio": "1 is red, elongated is green, as in VKW12 fig. 1b. Red and green are hard to tell apart for "
                        "some readers: the same numbers are in the histograms.",
    "map_area_m2": "Logarithmic scale from the 2nd to the 98th percentile of the reference.",
    "map_neighbours": "Parcels of the same block with a common boundary of at least 0.5 m.",
    "histograms": "Superposed, not normalised, same bins, as in VKW12 fig. 1d and e; counts are per repetition. "
                  "Hatched: everything beyond the scale, which the reference sets.",
    "ecdf": "The same scale as the histograms.",
    "distances": "Each distance divided by its noise floor, the mean distance between random halves of the blocks of "
                 "the reference. In the grey band a strategy is as near as one half of the place to the other.",
    "worst": "Largest KS statistic of area within the block; among equals, most parcels. Colours: aspect ratio.",
}


def caption_of(name):
    key = name.replace("zoom_", "map_", 1)
    return next((text for start, text in CAPTIONS.items() if key.startswith(start)), "")


def figure_html(figures, name, dataset):
    data = base64.b64encode(figures.bytes[name]).decode("ascii")
    alt = escape(f"{name.replace('_', ' ')}, {plots_word(dataset)}")
    return (f'<figure id="{escape(name)}"><img alt="{alt}" src="data:image/png;base64,{data}">'
            f"<figcaption>{escape(caption_of(name))} Files: figures/{escape(name)}.pdf, .png</figcaption></figure>")


def _facts(pairs):
    return "<dl>" + "".join(f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in pairs if v) + "</dl>"


def header_html(run):
    m = run.manifest
    strategies = "; ".join(
        s["label"] + "".join(f" {k}={v}" for k, v in sorted(s.get("options", {}).items())) for s in m["strategies"])
    libraries = ", ".join(f"{k} {v}" for k, v in sorted(m.get("libraries", {}).items()))
    words = sorted({plots_word(d) for d in run.datasets})
    title = f"{m.get('experiment', 'run')}: {' and '.join(words)} and procedural parcels"
    return title, f"<h1>{escape(title)}</h1>" + _facts([
        ("data", ", ".join(d["title"] for d in run.datasets)), ("strategies", strategies),
        ("repetitions", run.repetitions), ("seed", m["seed"]),
        ("commit", m["commit"] + (" with uncommitted changes" if m.get("dirty") else "")),
        ("plat", m.get("plat_version", "")), ("compiler", f"{m.get('compiler', '')} {m.get('compiler_flags', '')}"),
        ("libraries", libraries)])


def dataset_html(run, dataset, figures, names):
    """`names`: figures of this data set by section."""
    out = [f"<h2 id=\"{escape(dataset['name'])}\">{escape(dataset['title'])}: {plots_word(dataset)} and "
           "procedural parcels</h2>"]
    out.append(_facts([
        ("data set", dataset["name"]), ("reference", plots_word(dataset)), ("licence", dataset.get("licence")),
        ("attribution", dataset.get("attribution")), ("CRS", dataset.get("crs")),
        ("blocks", f"{dataset.get('blocks', 0):,}"), (plots_word(dataset), f"{dataset.get('parcels', 0):,}")]))
    if dataset.get("plots") == "tessellated":
        out.append('<p class="warning">No parcels are known for this place. Everything here is measured against '
                   "<b>tessellated plots</b>: cells of an enclosed tessellation of the building footprints.</p>")
    out.append('<div class="verdict"><h3>Verdict</h3><p>' +
               " ".join(escape(s) for s in summary_sentences(run, dataset)) + "</p><ul>" +
               "".join(f"<li>{escape(measure_sentence(run, dataset, m))}</li>" for m in run.measures) + "</ul></div>")
    out.append(overview_table(run, dataset))
    if found := search_table(run, dataset):
        out.append(found + "<p>Each part of the blocks is divided with the options that were best on the <em>other</em> "
                   "blocks, so no searched option was chosen on what it is compared with. Score: mean of distance (KS) "
                   "over noise floor.</p>")

    def section(title, key):
        if names.get(key):
            out.append(f"<h3>{escape(title)} ({plots_word(dataset)})</h3>")
            out.extend(figure_html(figures, n, dataset) for n in names[key])

    section("Distances at a glance", "distances")
    section("Histograms", "histograms")
    section("Distribution functions", "ecdf")
    section("Maps", "maps")
    section("Worst blocks", "worst")
    out.append(f"<h3>Distances ({plots_word(dataset)})</h3>")
    out.extend(distance_tables(run, dataset))
    out.append("<p>Bold: the nearest strategy. Green: within the range of the noise floor. Ratio: distance by mean "
               "noise floor.</p>")
    out.append(f"<h3>Differences between strategies ({plots_word(dataset)})</h3>")
    tables = [difference_table(run, dataset, kind) for kind in ("ks", "wasserstein", "jensen_shannon")]
    if any(tables):
        out.append(tables[0])
        out.append("<details><summary>The same for Wasserstein-1 and Jensen-Shannon</summary>" +
                   "".join(tables[1:]) + "</details>")
        out.append("<p>Difference: first minus second; negative where the first is closer. Bold: significant at 5 % "
                   "after Holm's adjustment over all measures and pairs of one distance. Effect size: paired Cliff's delta "
                   "over blocks, −1 (the first is closer in every block) to 1.</p>")
    else:
        out.append("<p>No two strategies have parcels in the same blocks.</p>")
    failures = failure_table(run, dataset)
    out.append(f"<h3>Failures ({plots_word(dataset)})</h3>" +
               (failures or "<p>Every strategy divided every block.</p>"))
    out.append(f"<p>In QGIS: Layer, Add Layer, Add Vector Layer, <code>layout_{escape(dataset['name'])}.gpkg</code>; "
               "one layer per strategy, with every measure as a field, and <code>failures</code>.</p>")
    return "\n".join(out)


METHODS = """
<h2>Methods</h2>
<p>Every measure, its unit and its tolerance: docs/measures.md. What the files hold: docs/run_directory.md. In short:
distances compare the parcels of the blocks that have both; intervals come from a bootstrap over blocks, because parcels
of a block are not independent; differences between strategies are tested by swapping the strategies block by block at
random, two-sided, and adjusted by Holm's procedure; the noise floor is the distance between random halves of the blocks
of the reference, which have half the blocks and so lie further apart, by the square root of 2, than two places of full
size would. Options of a strategy are fitted to each block's own parcels (VKW12, section 6), so a strategy knows the mean
and the spread of area and width: that those agree is no evidence; aspect ratio, neighbours, frontage and form are.</p>
<p>To go further: notebooks/explore_run.ipynb.</p>
"""


def page_html(run, sections):
    title, header = header_html(run)
    return (f"<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{escape(title)}</title>"
            f"<style>{CSS}</style></head><body>\n{header}\n" + "\n".join(sections) + METHODS + "</body></html>\n")
