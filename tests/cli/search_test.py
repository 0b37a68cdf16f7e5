"""plat search: sequences with what they consume, as text and as JSON lines; no solution is status 1."""

import json
import unittest

from plat_cli import DONE, FAILURES, ROOT, CliTest, plat

EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.json"))
STREET = ROOT / "docs" / "examples" / "street.json"


def lines(text):
    return [json.loads(line) for line in text.splitlines()]


class Search(CliTest):
    def problem(self, **changes):
        document = {
            "resources": [{"name": "length_m", "step": 0.2}],
            "cost_step": 0.5,
            "elements": [{"name": "a", "uses": {"length_m": 0.6}}, {"name": "b", "uses": {"length_m": 1.0}}],
            "transition_matrix": [[1.5, 0.5], [0, None]],
            "bounds": {"length_m": 2.2},
            **changes,
        }
        path = self.path("problem.json")
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    def test_every_example_has_a_solution_that_keeps_its_bounds(self):
        for path in EXAMPLES:
            with self.subTest(path.name):
                result = plat("search", path, "--json")
                self.assert_status(result, DONE)
                best, summary = lines(result.stdout)
                self.assertEqual(summary["found"], 1)
                bounds = json.loads(path.read_text(encoding="utf-8"))["bounds"]
                for resource, bound in bounds.items():
                    low, high = bound if isinstance(bound, list) else (bound, bound)
                    self.assertGreaterEqual(best["consumed"][resource], (low or 0) - 1e-9)
                    if high is not None:
                        self.assertLessEqual(best["consumed"][resource], high + 1e-9)

    def test_text_says_elements_cost_and_what_was_consumed(self):
        result = plat("search", self.problem(), "--k", 9)
        self.assert_status(result, DONE)
        self.assertIn("1: cost 0.5\n   a, b, a\n   length_m 2.2 of 2.2\n", result.stdout)
        self.assertIn("3 sequences, there are no more", result.stdout)

    def test_json_lines_are_the_sequences_in_order_and_a_summary(self):
        result = plat("search", STREET, "--k", 50, "--json")
        self.assert_status(result, DONE)
        *found, summary = lines(result.stdout)
        self.assertEqual([s["rank"] for s in found], list(range(1, 51)))
        costs = [s["cost"] for s in found]
        self.assertEqual(costs, sorted(costs))
        self.assertEqual(len({tuple(s["elements"]) for s in found}), 50)
        self.assertEqual((summary["found"], summary["is_everything"]), (50, False))
        self.assertGreater(summary["states_created"], 0)
        for sequence in found:
            self.assertEqual(sequence["consumed"]["length_m"], 60)

    def test_out_holds_what_standard_output_would(self):
        shown = lines(plat("search", STREET, "--k", 5, "--json").stdout)
        result = plat("search", STREET, "--k", 5, "--json", "--out", self.path("s.jsonl"))
        self.assert_status(result, DONE)
        self.assertEqual(result.stdout, "")
        written = lines(self.path("s.jsonl").read_text(encoding="utf-8"))
        self.assertEqual(written[:5], shown[:5])
        self.assert_only("s.jsonl")

    def test_every_method_finds_the_same_costs(self):
        methods = [s["name"] for s in lines_of_list() if s["family"] == "sequence_search"]
        self.assertTrue(methods)
        costs = {}
        for method in methods:
            result = plat("search", STREET, "--method", method, "--k", 20, "--json")
            self.assert_status(result, DONE)
            costs[method] = [s["cost"] for s in lines(result.stdout)[:-1]]
        for method in methods:
            self.assertEqual(costs[method], costs[methods[0]], method)

    def test_no_solution_is_status_1(self):
        result = plat("search", self.problem(bounds={"length_m": 0.8}))
        self.assert_status(result, FAILURES)
        self.assertIn("0 sequences, there are no more", result.stdout)

    def test_no_solution_names_what_cuts_and_what_is_near(self):
        problem = self.problem(bounds={"length_m": 0.8})
        result = plat("search", problem)
        self.assertIn("without these bounds there are sequences: length_m\n", result.stdout)
        self.assertIn("length_m 0.8: nearest attainable with all other bounds kept: 0.6 and 1\n", result.stdout)
        summary = lines(plat("search", problem, "--json").stdout)[-1]
        self.assertEqual(summary["diagnosis"]["cuts"], [[{"resource": "length_m"}]])
        self.assertEqual(summary["diagnosis"]["nearest"], [{"resource": "length_m", "below": 0.6, "above": 1}])

    def test_no_transitions_at_all_are_told(self):
        result = plat("search", self.problem(elements=[{"name": "a", "front": False}], transition_matrix=[[1]]))
        self.assert_status(result, FAILURES)
        self.assertIn("whatever the bounds: no element may begin", result.stdout)

    def test_relaxation_misses_least_and_is_refused_for_unknown_bounds(self):
        problem = self.problem(bounds={"length_m": 1.4})
        result = plat("search", problem, "--relax", "length_m=10", "--json")
        self.assert_status(result, FAILURES)
        relaxation = lines(result.stdout)[-1]["relaxation"]
        self.assertEqual(relaxation["distance"], 2)
        self.assertEqual(relaxation["sequence"]["elements"], ["b", "a"])  # 1.6 at cost 0
        self.assert_refused(plat("search", problem, "--relax", "lenth_m=1"), "lenth_m", "length_m")
        self.assert_refused(plat("search", problem, "--relax", "length_m=no"), "length_m=no", "above 0")

    def test_local_bounds_are_relaxed_by_segment(self):
        document = json.loads((ROOT / "docs" / "examples" / "corner_and_t.json").read_text(encoding="utf-8"))
        next(s for s in document["segments"] if s["name"] == "north")["bounds"]["length_m"] = 12
        path = self.path("structure.json")
        path.write_text(json.dumps(document), encoding="utf-8")
        result = plat("search", path, "--relax", "length_m=1,north:length_m=0.5", "--json")
        self.assert_status(result, FAILURES)
        summary = lines(result.stdout)[-1]
        self.assertIn([{"resource": "length_m", "segment": "north"}], summary["diagnosis"]["cuts"])
        relaxed = summary["relaxation"]["sequence"]["consumed_by_segment"]["north"]["length_m"]
        self.assertAlmostEqual(summary["relaxation"]["distance"], 0.5 * abs(relaxed - 12))

    def test_a_structure_is_told_by_its_parts(self):
        result = plat("search", ROOT / "docs" / "examples" / "corner_and_t.json", "--json")
        best = lines(result.stdout)[0]
        self.assertEqual(set(best["segments"]), {"west", "north", "east", "wing"})
        self.assertEqual(best["key_points"]["wing"], "junction")
        self.assertEqual(best["segments"]["west"][0], "left gable")
        self.assertEqual(best["consumed_by_segment"]["north"]["length_m"], 13.2)

    def test_a_closed_courtyard_keeps_the_bounds_of_every_side(self):
        result = plat("search", ROOT / "docs" / "examples" / "courtyard.json", "--json")
        best = lines(result.stdout)[0]
        self.assertEqual(best["cost"], 24)
        self.assertEqual(len(best["key_points"]), 6)
        self.assertEqual(best["segments"]["south"].count("balcony"), 3)
        self.assertEqual(best["consumed_by_segment"]["east"]["length_m"], 18)

    def test_bad_input_is_one_line_with_what_is_allowed(self):
        good = self.problem()
        for arguments, words in [
            ((self.path("none.json"),), ["none.json", "cannot be read"]),
            ((self.problem(bounds={"lengt_m": 1}),), ["problem.json", "lengt_m", "length_m"]),
            ((self.problem(bounds={"length_m": 0.5}),), ["length_m = 0.5", "0.2", "nearest"]),
            ((good, "--method", "layerd"), ["layerd", "layered"]),
            ((good, "--method", "layered", "--set", "memory=1"), ["memory"]),
            ((good, "--k", 0), ["0"]),
            ((good, "--out", self.path("no/folder.jsonl")), ["--out", "folder.jsonl"]),
        ]:
            with self.subTest(words):
                self.problem(**({"bounds": {"lengt_m": 1}} if "lengt_m" in words else {}))
                if "length_m = 0.5" in words:
                    self.problem(bounds={"length_m": 0.5})
                self.assert_refused(plat("search", *arguments), *words)


def lines_of_list():
    return json.loads(plat("list", "strategies", "--json").stdout)


if __name__ == "__main__":
    unittest.main()
