"""The command line says what it does: help, versions, lists, exit statuses."""

import json
import re
import unittest

from plat_cli import DONE, CliTest, plat

# The interface that users rely on: subcommand -> flags and arguments its help must name.
COMMANDS = {
    ("list",): ["what", "--json", "strategies", "datasets", "experiments"],
    ("data",): ["list", "fetch", "check", "PLAT_DATA_DIR"],
    ("data", "list"): ["--json"],
    ("data", "fetch"): ["name"],
    ("data", "check"): ["names"],
    ("blocks",): ["--streets", "--out", "FILE[:layer]", "--jobs"],
    ("exemplar",): ["city", "--out", "--parcels", "--window", "--set", "main_share_01", "FILE[:layer]"],
    ("subdivide",): ["--blocks", "--streets", "--observed", "--strategy", "--set", "--seed", "--jobs", "--out", "--trace"],
    ("compare",): ["observed", "generated", "--out", "FILE[:layer]", "--seed", "--jobs"],
    ("run",): ["config", "--out", "--data", "--seed", "--jobs", "--resume"],
    ("report",): ["dir", "report.html", "--worst"],
    ("figure",): ["names", "--list", "--out", "PLAT_DATA_DIR"],
    ("orthophoto",): ["--city", "--streets", "--parcels", "--footprints", "--water", "--window", "--pixel", "--seed", "--out"],
    ("synthesize",): ["script", "--out", "--seed", "--jobs", "docs/synthesis_script.md"],
    ("transitions",): ["points", "--base", "--from", "--street", "--streets", "--set", "--out"],
    ("search",): ["problem", "--method", "--set", "--k", "--json", "--out", "--relax"],
}


class Help(CliTest):
    def test_every_command_explains_itself_with_an_example(self):
        for command, words in COMMANDS.items():
            with self.subTest(command=command):
                result = plat(*command, "--help")
                self.assert_status(result, DONE)
                self.assertEqual(result.stderr, "")
                for word in [*words, "Exit status", "Example"]:
                    self.assertIn(word, result.stdout)

    def test_the_program_names_every_command(self):
        result = plat("--help")
        self.assert_status(result, DONE)
        for command in COMMANDS:
            self.assertRegex(result.stdout, rf"(?m)^  {command[0]} ")

    def test_examples_use_flags_that_exist(self):
        for command in COMMANDS:
            text = plat(*command, "--help").stdout
            example = text[text.index("Example") :]
            for name, flags in re.findall(r"plat ((?:data )?\w+)((?:[^\n]|\\\n)*)", example):
                known = plat(*name.split(), "--help").stdout
                for flag in re.findall(r"--\w[\w-]*", flags):
                    self.assertIn(flag, known, f"example of {command}: {flag} of plat {name}")

    def test_version_is_a_number(self):
        result = plat("--version")
        self.assert_status(result, DONE)
        self.assertRegex(result.stdout, r"\d+\.\d+\.\d+")


class Lists(CliTest):
    def json_of(self, *command):
        result = plat(*command, "--json")
        self.assert_status(result, DONE)
        return json.loads(result.stdout)

    def test_strategies_have_options_with_ranges(self):
        strategies = {s["name"]: s for s in self.json_of("list", "strategies")}
        self.assertLessEqual({"voronoi", "skeleton", "obb", "affine_vertex", "descriptor", "box"}, set(strategies))
        for strategy in strategies.values():
            for option in strategy["options"]:
                self.assertTrue(option["description"])
                if option["type"] == "choice":
                    self.assertIn(option["default"], option["choices"])
                elif option["default"] == "none":
                    self.assertEqual(option["type"], "number or none")
                    self.assertLess(option["min"], option["max"])
                else:
                    self.assertLessEqual(option["min"], option["default"])
                    self.assertLessEqual(option["default"], option["max"])

    def test_the_text_lists_name_what_the_json_lists_name(self):
        for what in ("strategies", "datasets", "experiments"):
            text = plat("list", what)
            self.assert_status(text, DONE)
            names = [entry["name"] for entry in self.json_of("list", what)]
            self.assertTrue(names)
            for name in names:
                self.assertIn(name, text.stdout)

    def test_data_list_names_the_same_sets_as_list_datasets(self):
        self.assertEqual(
            [d["name"] for d in self.json_of("data", "list")], [d["name"] for d in self.json_of("list", "datasets")]
        )


class WrongUse(CliTest):
    def test_wrong_arguments_are_one_line_and_status_2(self):
        for arguments, word in [
            ((), "subcommand"),
            (("subdivid",), "subdivid"),
            (("list",), "what"),
            (("list", "strategy"), "strategy"),
            (("subdivide", "--blocks", "b.gpkg"), "required"),
            (("subdivide", "--blocks", "b", "--strategy", "obb", "--out", "o.gpkg", "--jobs", "many"), "many"),
            (("subdivide", "--blocks", "b", "--strategy", "obb", "--out", "o.gpkg", "--seed", "-1"), "-1"),
            (("subdivide", "--blocks", "b", "--strategy", "obb", "--out", "o.gpkg", "--ste", "a=1"), "--ste"),
            (("run", "parcels_vs_observed"), "--out"),
            (("data", "check", "atlantis"), "atlantis"),
            (("data", "fetch", "atlantis"), "atlantis"),
        ]:
            with self.subTest(arguments=arguments):
                self.assert_refused(plat(*arguments), word)


if __name__ == "__main__":
    unittest.main()
