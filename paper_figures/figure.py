"""What every figure shares: its line of figures.json, the work folder, runs of plat, claims and the files it ends with."""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time
import warnings

# Debian's geopandas 0.12 warns of its own dependencies' versions.
warnings.filterwarnings("ignore", category=FutureWarning)
warnings.filterwarnings("ignore", message=".*[Ss]hapely.*")

FOLDER = pathlib.Path(__file__).resolve().parent
REPORT = pathlib.Path(os.environ.get("PLAT_EXPERIMENTS_DIR", FOLDER.parent / "experiments")) / "report"
sys.path.insert(0, str(REPORT))

#: How a claim's measured value is held against its bound in figures.json.
BOUNDS = {
    "at_most": lambda value, bound: value <= bound,
    "at_least": lambda value, bound: value >= bound,
    "below": lambda value, bound: value < bound,
    "above": lambda value, bound: value > bound}
BOUND_SIGNS = {"at_most": "≤", "at_least": "≥", "below": "<", "above": ">"}


class FigureError(Exception):
    """The figure cannot be made; the message is one line."""


def listing():
    """Figure id -> its entry."""
    entries = json.loads((FOLDER / "figures.json").read_text(encoding="utf-8"))["figures"]
    return {entry["id"]: entry for entry in entries}


def bound_of(claim):
    """(kind, number) of a claim in the listing: each has exactly one bound."""
    (kind,) = [k for k in BOUNDS if k in claim]
    return kind, claim[kind]


class Figure:
    """One figure while it is being made.

    Bounds stand in figures.json, written before the value was known; a script only hands in what it measured.
    """

    def __init__(self, identifier, out):
        self.id = identifier
        self.entry = listing()[identifier]
        self.base = pathlib.Path(out) / identifier
        self.work = self.base.parent / "work" / self.base.name
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        self.commands = []
        self.failures = []
        self.sources = {}
        self._measured = {}

    def path(self, name):
        return self.work / name

    def plat(self, *arguments):
        """Runs plat; what it lists as failures is counted by the caller, bad input ends the figure."""
        words = [str(a) for a in arguments]
        result = subprocess.run([_binary(), *words], capture_output=True, text=True, check=False)
        # The listing of commands must not name this machine's folders.
        self.commands.append("plat " + " ".join(w.replace(str(self.work) + "/", "") for w in words))
        if result.returncode not in (0, 1):
            said = result.stderr.strip().removeprefix("plat: ")
            raise FigureError(f"plat {words[0]}: {said or f'status {result.returncode}'}")
        return result.stdout

    def program(self, name, *arguments):
        """Runs a program of an experiment, which lies beside plat. Its status 1 is for the caller's claims to tell."""
        words = [str(a) for a in arguments]
        program = pathlib.Path(_binary()).parent / name
        if not program.exists():
            raise FigureError(f"{name} is not beside plat; build it")
        result = subprocess.run([str(program), *words], capture_output=True, text=True, check=False)
        self.commands.append(f"{name} " + " ".join(w.replace(str(self.work) + "/", "") for w in words))
        if result.returncode not in (0, 1):
            raise FigureError(f"{name}: {result.stderr.strip() or f'status {result.returncode}'}")
        return result.stdout

    def dataset(self, name):
        """The catalogue's entry, remembered for the attribution."""
        if name not in self.sources:
            known = {d["name"]: d for d in json.loads(_run_plain("data", "list", "--json"))}
            if name not in known:
                raise FigureError(f"no data set \"{name}\"")
            if not known[name]["is_present"]:
                raise FigureError(f"data set \"{name}\" is not in the data folder; get it from {known[name]['source']} "
                                  "and set PLAT_DATA_DIR")
            self.sources[name] = known[name]
        return self.sources[name]

    def note_failures(self, of, count, total):
        """Blocks that a strategy could not divide: told in the figure's file, never dropped unsaid."""
        self.failures.append({"of": of, "failed": int(count), "blocks": int(total)})

    def measured(self, key, value, note=""):
        """Hands in the value of a claim of the listing."""
        if key not in {c["key"] for c in self.entry["claims"]}:
            raise FigureError(f"{self.id}: claim \"{key}\" is not in figures.json")
        self._measured[key] = (float(value), note)

    def verdicts(self):
        rows = []
        for claim in self.entry["claims"]:
            if claim["key"] not in self._measured:
                raise FigureError(f"{self.id}: claim \"{claim['key']}\" was never measured")
            value, note = self._measured[claim["key"]]
            kind, bound = bound_of(claim)
            # Not a number: nothing could be measured, so the claim does not hold.
            rows.append({"key": claim["key"], "text": claim["text"], "measure": claim["measure"], "value": value,
                         "bound": {kind: bound}, "why_this_bound": claim["why"], "note": note,
                         "verdict": "PASS" if BOUNDS[kind](value, bound) else "FAIL"})
        return rows

    def attribution(self):
        return "; ".join(f"{s['title'].split(':')[0]}: {s['attribution']}, {s['licence']}" for s in self.sources.values())

    def save(self, picture):
        """Writes PDF and PNG; `picture` is a matplotlib figure."""
        from style import Figures

        Figures(self.base.parent).save(picture, self.base.name)

    def finish(self):
        """Writes the claims. @returns 0 every claim holds, 1 one does not"""
        rows = self.verdicts()
        record = {"id": self.id, "paper": self.entry["paper"], "figure": self.entry["figure"],
                  "title": self.entry["title"], "caption": self.entry["caption"], "stands_in": self.entry["stands_in"],
                  "sources": [f"{s['title']}; {s['attribution']}; {s['licence']}" for s in self.sources.values()],
                  "claims": rows, "undivided": self.failures, "plat": _run_plain("--version").strip(),
                  "commands": self.commands}
        part = self.base.with_suffix(".json.part")
        part.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        os.replace(part, self.base.with_suffix(".json"))
        for row in rows:
            (kind, bound), = row["bound"].items()
            print(f"  {row['verdict']}  {row['key']}: {row['value']:.4g} ({BOUND_SIGNS[kind]} {bound:g})"
                  + (f"  {row['note']}" if row["note"] else ""))
        return 0 if all(row["verdict"] == "PASS" for row in rows) else 1


def _binary():
    return os.environ.get("PLAT_BINARY", str(FOLDER.parent / "build" / "release" / "plat"))


def _run_plain(*arguments):
    result = subprocess.run([_binary(), *arguments], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise FigureError(result.stderr.strip())
    return result.stdout


def make(identifier, draw):
    """Runs `draw(figure)` from the command line. Exit status 0 every claim holds, 1 one does not, 2 bad input."""
    parser = argparse.ArgumentParser(description=f"Draws {identifier}; use `plat figure {identifier}`.")
    parser.add_argument("--out", default="out/figures", help="folder for PDF, PNG and JSON")
    arguments = parser.parse_args()
    started = time.monotonic()
    try:
        figure = Figure(identifier, arguments.out)
        draw(figure)
        print(f"{figure.base}.png  {figure.entry['title']}  ({time.monotonic() - started:.1f} s)")
        return figure.finish()
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "geopandas", "pandas", "numpy", "fiona", "shapely", "style", "maps"):
            raise
        print(f"plat: figure: Python has no {error.name}; python3-matplotlib and python3-geopandas are needed, and "
              f"PLAT_EXPERIMENTS_DIR must be Plat's experiments folder (now {REPORT.parent})", file=sys.stderr)
    except FigureError as error:
        print(f"plat: {identifier}: {error}", file=sys.stderr)
    return 2
