"""plat search --graph: the intermediate graph of a small problem, to be drawn."""

import json
import unittest

from plat_cli import BAD_INPUT, DONE, ROOT, CliTest, plat

THREE = ROOT / "docs" / "examples" / "three_elements.json"


class SearchGraph(CliTest):
    def test_has_states_arcs_and_both_ends(self):
        out = self.path("graph.json")
        self.assert_status(plat("search", THREE, "--graph", out), DONE)
        graph = json.loads(out.read_text(encoding="utf-8"))
        self.assertEqual(graph["dimensions"], ["lambda_1", "lambda_2"])
        states = graph["states"]
        self.assertEqual({s["element"] for s in states}, {"A", "B", "C"})
        self.assertTrue(any(s["entry"] for s in states) and any(s["exit"] for s in states))
        self.assertTrue(any(s["alive"] for s in states) and not all(s["alive"] for s in states))
        for arc in graph["arcs"]:
            self.assertLess(arc["from"], arc["to"])
            self.assertLess(states[arc["from"]]["level"], states[arc["to"]]["level"])
        self.assertIn({"from": states.index(next(s for s in states if s["entry"])), "cost": 2},
                      [{"from": a["from"], "cost": a["cost"]} for a in graph["arcs"]])

    def test_a_graph_too_large_to_draw_is_refused(self):
        problem = json.loads(THREE.read_text(encoding="utf-8"))
        problem["bounds"] = {"lambda_1": [0, 4000], "lambda_2": 8000}
        file, out = self.path("large.json"), self.path("graph.json")
        file.write_text(json.dumps(problem), encoding="utf-8")
        result = plat("search", file, "--graph", out)
        self.assert_status(result, BAD_INPUT)
        self.assertIn("too many to draw", result.stderr)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
