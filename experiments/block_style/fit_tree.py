"""python3 fit_tree.py RUN_DIR: which strategy reproduces a block best, and a decision tree that tells it from the parcels' style.

Reads what `plat run block_style` wrote; writes RUN_DIR/block_style/*.csv (README.md says what is in each).
"""

import argparse
import pathlib

import numpy
import pandas

#: Of blocks.csv; what the names mean is said in parcels/parcel_style.h.
FEATURES = ("count", "area_variation", "width_variation", "aspect_ratio_mean", "access_share_01", "access_area_01",
            "rows_mean")
DEPTH = 3
LEAST_BLOCKS = 20  #: in a leaf
LEAST_GAIN = 1e-9  #: of a split: less is rounding
FOLDS = 5
RESAMPLES = 1000
SEED = 1


def wasserstein(a, b):
    """Area between the distribution functions."""
    at = numpy.sort(numpy.concatenate([a, b]))
    below = [numpy.searchsorted(numpy.sort(x), at[:-1], "right") / len(x) for x in (a, b)]
    return float((numpy.abs(below[0] - below[1]) * numpy.diff(at)).sum())


def ks_statistic(a, b):
    at = numpy.concatenate([a, b])
    below = [numpy.searchsorted(numpy.sort(x), at, "right") / len(x) for x in (a, b)]
    return float(numpy.abs(below[0] - below[1]).max())


class Place:
    """Blocks of all data sets: features, and the score of each strategy."""

    def __init__(self, run):
        parcels = pandas.read_csv(run / "parcels.csv", dtype={"parcel_id": str})
        blocks = pandas.read_csv(run / "blocks.csv")
        self.parcels = {key: group[["area_m2", "aspect_ratio"]].to_numpy()
                        for key, group in parcels.groupby(["layer", "dataset", "block_id"])}
        observed = blocks[blocks["layer"] == "observed"].reset_index(drop=True)
        self.strategies = [s for s in dict.fromkeys(blocks["layer"]) if s != "observed"]
        self.keys = list(zip(observed["dataset"], observed["block_id"]))
        self.cities = observed["dataset"].to_numpy()
        observed["count"] = observed["parcels"]
        observed["area_variation"] = observed["area_deviation_m2"] / observed["area_mean_m2"]
        observed["width_variation"] = observed["width_deviation_m"] / observed["width_mean_m"]
        self.features = observed[list(FEATURES)].to_numpy(dtype=float)
        self.scores = numpy.array([[self._score(s, key) for s in self.strategies] for key in self.keys])
        self.best = self.scores.argmin(axis=1)

    def _score(self, strategy, key):
        """W1 of ln(area) + W1 of ln(aspect ratio): by which factors parcels are off. A failed block is infinitely bad."""
        generated = self.parcels.get((strategy, *key))
        if generated is None:
            return numpy.inf
        observed = self.parcels[("observed", *key)]
        return sum(wasserstein(numpy.log(observed[:, i]), numpy.log(generated[:, i])) for i in range(2))

    def pooled(self, blocks, chosen, column):
        """(observed, generated) values of the blocks, each divided by the strategy chosen for it."""
        pairs = [(self.keys[i], self.strategies[c]) for i, c in zip(blocks, chosen)
                 if (self.strategies[c], *self.keys[i]) in self.parcels]
        return (numpy.concatenate([self.parcels[("observed", *k)][:, column] for k, _ in pairs]),
                numpy.concatenate([self.parcels[(s, *k)][:, column] for k, s in pairs]))


def regret(scores):
    """Of each block and strategy: the score above the best one's, at most 2 (a factor of e in both measures)."""
    return numpy.minimum(scores - scores.min(axis=1, keepdims=True), 2.0)


def grow(features, cost, depth=DEPTH):
    """A tree as a list of nodes, root first: (feature, threshold, below, above, choice, blocks); leaves have no feature.

    A leaf chooses the strategy of least mean cost; a split is the one that leaves the least total cost.
    """
    nodes = []

    def add(rows, depth_left):
        index = len(nodes)
        nodes.append(None)
        choice = int(cost[rows].sum(axis=0).argmin())
        split = best_split(rows) if depth_left > 0 else None
        if split is None:
            nodes[index] = (None, None, None, None, choice, len(rows))
            return index
        feature, threshold = split
        is_below = features[rows, feature] < threshold
        below = add(rows[is_below], depth_left - 1)
        above = add(rows[~is_below], depth_left - 1)
        nodes[index] = (feature, threshold, below, above, choice, len(rows))
        return index

    def best_split(rows):
        best, best_cost = None, cost[rows].sum(axis=0).min() - LEAST_GAIN
        for feature in range(features.shape[1]):
            order = rows[numpy.argsort(features[rows, feature], kind="stable")]
            values = features[order, feature]
            sums = cost[order].cumsum(axis=0)
            left = sums[:-1].min(axis=1)
            right = (sums[-1] - sums[:-1]).min(axis=1)
            size = numpy.arange(1, len(order))
            allowed = (values[1:] > values[:-1]) & (size >= LEAST_BLOCKS) & (len(order) - size >= LEAST_BLOCKS)
            total = numpy.where(allowed, left + right, numpy.inf)
            if len(total) and total.min() < best_cost:
                at = int(total.argmin())
                # Few digits: the table is read by people.
                threshold = float(f"{0.5 * (values[at] + values[at + 1]):.4g}")
                if values[at] < threshold <= values[at + 1]:
                    best, best_cost = (feature, threshold), total.min()
        return best

    add(numpy.arange(len(features)), depth)
    return collapsed(nodes)


def collapsed(nodes):
    """Splits whose leaves choose the same are leaves; nodes are numbered again, root first."""
    out = []

    def choices(i):
        feature, _, below, above, choice, _ = nodes[i]
        return {choice} if feature is None else choices(below) | choices(above)

    def copy(i):
        feature, threshold, below, above, choice, blocks = nodes[i]
        index = len(out)
        out.append(None)
        if feature is None or len(choices(i)) == 1:
            out[index] = (None, None, None, None, choices(i).pop(), blocks)
        else:
            out[index] = (feature, threshold, copy(below), copy(above), choice, blocks)
        return index

    copy(0)
    return out


def predict(nodes, features):
    out = []
    for row in features:
        i = 0
        while nodes[i][0] is not None:
            i = nodes[i][2] if row[nodes[i][0]] < nodes[i][1] else nodes[i][3]
        out.append(nodes[i][4])
    return numpy.array(out)


def interval(values, rng):
    """Mean and its 95 % interval by bootstrap over blocks."""
    draws = values[rng.integers(0, len(values), (RESAMPLES, len(values)))].mean(axis=1)
    return values.mean(), *numpy.quantile(draws, [0.025, 0.975])


def held_out(place, parts):
    """(prediction, majority class, best single strategy) per block, each from the blocks of other parts."""
    cost = regret(place.scores)
    out = numpy.zeros((3, len(place.keys)), dtype=int)
    for part in numpy.unique(parts):
        inside, outside = parts == part, parts != part
        tree = grow(place.features[outside], cost[outside])
        out[0, inside] = predict(tree, place.features[inside])
        out[1, inside] = numpy.bincount(place.best[outside]).argmax()
        out[2, inside] = cost[outside].sum(axis=0).argmin()
    return out


def tree_table(place, nodes):
    rows = []
    for i, (feature, threshold, below, above, choice, blocks) in enumerate(nodes):
        rows.append({"node": i, "feature": "" if feature is None else FEATURES[feature],
                     "threshold": "" if feature is None else f"{threshold:g}", "below": "" if feature is None else below,
                     "above": "" if feature is None else above, "style": place.strategies[choice], "blocks": blocks})
    return pandas.DataFrame(rows)


def evaluate(place, validation, parts, accuracy, confusion, distances):
    rng = numpy.random.default_rng(SEED)
    tree, majority, single = held_out(place, parts)
    cost = regret(place.scores)
    everywhere = numpy.arange(len(place.keys))
    for city in ("all", *dict.fromkeys(place.cities)):
        rows = everywhere if city == "all" else numpy.flatnonzero(place.cities == city)
        for name, chosen in (("tree", tree), ("majority", majority), ("best_single", single), ("oracle", place.best)):
            for quantity, values in (("accuracy", (chosen == place.best)[rows].astype(float)),
                                     ("regret", cost[rows, chosen[rows]])):
                mean, low, high = interval(values, rng)
                accuracy.append({"validation": validation, "dataset": city, "choice": name, "quantity": quantity,
                                 "value": mean, "ci_low": low, "ci_high": high, "blocks": len(rows)})
            if city == "all":
                continue
            for column, measure in enumerate(("area_m2", "aspect_ratio")):
                distances.append({"validation": validation, "dataset": city, "choice": name, "measure": measure,
                                  "ks": ks_statistic(*place.pooled(rows, chosen[rows], column))})
    for truth in range(len(place.strategies)):
        for predicted in range(len(place.strategies)):
            confusion.append({"validation": validation, "best": place.strategies[truth],
                              "predicted": place.strategies[predicted],
                              "blocks": int(((place.best == truth) & (tree == predicted)).sum())})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", metavar="RUN_DIR", type=pathlib.Path, help="the --out of `plat run block_style`")
    run = parser.parse_args().run
    place = Place(run)
    out = run / "block_style"
    out.mkdir(exist_ok=True)
    order = numpy.random.default_rng(SEED).permutation(len(place.keys))
    folds = numpy.empty(len(order), dtype=int)
    folds[order] = numpy.arange(len(order)) % FOLDS
    accuracy, confusion, distances = [], [], []
    evaluate(place, "folds_over_blocks", folds, accuracy, confusion, distances)
    evaluate(place, "leave_one_city_out", place.cities, accuracy, confusion, distances)
    floor = pandas.read_csv(run / "distances.csv")
    floor = floor[floor["distance"] == "ks"].groupby(["dataset", "measure"])["noise_mean"].first()
    distances = pandas.DataFrame(distances)
    distances["noise_mean"] = [floor[d, m] for d, m in zip(distances["dataset"], distances["measure"])]
    labels = pandas.DataFrame(place.scores, columns=[f"score_{s}" for s in place.strategies])
    labels.insert(0, "best", [place.strategies[i] for i in place.best])
    labels.insert(0, "block_id", [k[1] for k in place.keys])
    labels.insert(0, "dataset", place.cities)
    tables = {"labels": labels, "accuracy": pandas.DataFrame(accuracy), "confusion": pandas.DataFrame(confusion),
              "distances": distances, "tree": tree_table(place, grow(place.features, regret(place.scores)))}
    for name, table in tables.items():
        table.to_csv(out / f"{name}.csv", index=False)
    print(tables["tree"].to_string(index=False))
    print(tables["accuracy"].round(3).to_string(index=False))
    print(distances.round(4).to_string(index=False))


if __name__ == "__main__":
    main()
