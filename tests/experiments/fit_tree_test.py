"""What experiments/block_style fits and validates. Run: /usr/bin/python3 tests/experiments/fit_tree_test.py"""

import pathlib
import sys
import types
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments" / "block_style"))

import fit_tree  # noqa: E402


def planted(n, noise=0.0):
    """Features of which the second tells which of three strategies is best; the cost of the best is 0, of others 1."""
    rng = numpy.random.default_rng(3)
    features = rng.uniform(0.0, 1.0, (n, len(fit_tree.FEATURES)))
    best = numpy.digitize(features[:, 1], [0.25, 0.6])
    wrong = rng.uniform(0.0, 1.0, n) < noise
    best[wrong] = rng.integers(0, 3, wrong.sum())
    return features, 1.0 - numpy.eye(3)[best], best


class Tree(unittest.TestCase):
    def test_finds_the_planted_splits(self):
        features, cost, best = planted(600)
        nodes = fit_tree.grow(features, cost)
        splits = sorted((f, round(t, 1)) for f, t, *_ in nodes if f is not None)
        self.assertEqual(splits, [(1, 0.2), (1, 0.6)])
        self.assertGreater((fit_tree.predict(nodes, features) == best).mean(), 0.98)

    def test_no_leaf_is_smaller_than_allowed_and_sizes_add_up(self):
        features, cost, _ = planted(300, noise=0.6)
        nodes = fit_tree.grow(features, cost)
        for feature, _, below, above, _, blocks in nodes:
            self.assertGreaterEqual(blocks, fit_tree.LEAST_BLOCKS)
            if feature is not None:
                self.assertEqual(blocks, nodes[below][5] + nodes[above][5])

    def test_leaves_that_choose_the_same_are_one(self):
        leaf = (None, None, None, None, 1, 30)
        nodes = [(0, 0.5, 1, 2, 1, 60), leaf, leaf]
        self.assertEqual(fit_tree.collapsed(nodes), [(None, None, None, None, 1, 60)])

    def test_a_prediction_is_made_without_the_block(self):
        features, cost, best = planted(200)
        place = types.SimpleNamespace(features=features, scores=cost, best=best, keys=list(range(200)))
        parts = numpy.arange(200) % 5
        before = fit_tree.held_out(place, parts)
        inside = parts == 2
        place.scores, place.best = cost.copy(), best.copy()
        place.scores[inside] = cost[inside][:, ::-1]
        place.best[inside] = 2 - best[inside]
        after = fit_tree.held_out(place, parts)
        self.assertTrue((before[:, inside] == after[:, inside]).all())
        self.assertFalse((before == after).all(), "the other folds see them")


class Distances(unittest.TestCase):
    def test_known_values(self):
        a, b = numpy.array([0.0, 1.0]), numpy.array([0.5, 2.5, 2.5])
        self.assertAlmostEqual(fit_tree.wasserstein(a, a + 3.0), 3.0)
        self.assertAlmostEqual(fit_tree.wasserstein(a, b), 4.0 / 3.0)
        self.assertAlmostEqual(fit_tree.ks_statistic(a, b), 2.0 / 3.0)
        self.assertEqual(fit_tree.ks_statistic(a, a), 0.0)

    def test_regret_is_zero_for_the_best_and_bounded_for_a_failure(self):
        regret = fit_tree.regret(numpy.array([[0.5, 0.2, numpy.inf]]))
        numpy.testing.assert_allclose(regret, [[0.3, 0.0, 2.0]])


if __name__ == "__main__":
    unittest.main()
