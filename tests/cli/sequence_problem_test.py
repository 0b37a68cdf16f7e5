"""docs/sequence_problem.md: the examples keep the schema, and the schema refuses what the reader refuses."""

import copy
import json
import unittest

import jsonschema
from plat_cli import ROOT

EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.json"))
SCHEMA = json.loads((ROOT / "docs" / "sequence_problem.schema.json").read_text(encoding="utf-8"))


class SequenceProblemSchema(unittest.TestCase):
    def test_examples_keep_it(self):
        self.assertGreaterEqual(len(EXAMPLES), 4)
        for path in EXAMPLES:
            with self.subTest(path.name):
                jsonschema.validate(json.loads(path.read_text(encoding="utf-8")), SCHEMA)

    def test_it_refuses_what_makes_no_sense(self):
        good = {"elements": [{"name": "a", "uses": {"length_m": 1}}], "bounds": {"length_m": [1, None]}}
        jsonschema.validate(good, SCHEMA)
        for path, value in [
            (("elements",), []),
            (("elements", 0, "uses", "length_m"), -1),
            (("bounds", "length_m"), [1]),
            (("bound",), {}),
            (("elements", 0, "front"), "yes"),
            (("transition_matrix",), [["x"]]),
            (("key_points",), [{"name": "k"}]),
        ]:
            bad = copy.deepcopy(good)
            at = bad
            for key in path[:-1]:
                at = at[key]
            at[path[-1]] = value
            with self.subTest(path), self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(bad, SCHEMA)


if __name__ == "__main__":
    unittest.main()
