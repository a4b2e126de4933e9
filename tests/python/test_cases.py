"""Cases as dictionaries: reading, changing, writing, checking."""

import os
import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np

import perilink

EXAMPLES = Path(os.environ["PERILINK_SOURCE_DIR"]) / "meshes"

STRIP = """
[body]
spacing = 10.0
horizon = 31.0

[[regions]]
name = "strip"
x = [0, 40]
y = [0, 80]

[[regions]]
name = "lower end"
x = [0, 40]
y = [0, 20]

[[regions]]
name = "upper end"
x = [0, 40]
y = [60, 80]

[[materials]]
region = "strip"
youngs_modulus = 3000.0
fracture_energy = 0.001

[[supports]]
region = "lower end"
fix = ["x", "y"]

[[loads]]
region = "upper end"
force = [0, 12]
"""


class Cases(unittest.TestCase):
    def test_every_example_is_written_as_it_was_read(self):
        examples = sorted(EXAMPLES.glob("*.toml"))
        self.assertGreater(len(examples), 10)
        for path in examples:
            case = perilink.read_case(path)
            self.assertEqual(case, tomllib.loads(path.read_text()))
            self.assertEqual(case.toml(), path.read_text())
            case["title"] = "changed"
            again = perilink.parse_case(case.toml(), path)
            self.assertEqual(again, case)
            self.assertNotEqual(again.toml(), path.read_text())

    def test_a_case_is_built_from_keywords(self):
        table = tomllib.loads(STRIP)
        built = perilink.Case(
            body={"spacing": np.float64(10.0), "horizon": 31, "thickness": None},
            regions=[
                {"name": "strip", "x": np.array([0, 40]), "y": (0, 80)},
                {"name": "lower end", "x": [0, 40], "y": [0, 20]},
                {"name": "upper end", "x": [0, 40], "y": [60, 80]},
            ],
            materials=table["materials"],
            supports=table["supports"],
            loads=table["loads"],
            analysis={"type": "damage"},
        )
        self.assertEqual(built.check(), perilink.parse_case(STRIP).check())
        self.assertEqual(built.check()["body"]["thickness"], 1.0)

    def test_texts_and_nested_tables_are_written(self):
        case = perilink.Case(title='a "quoted" \\ name,\tü \x7f',
                             odd={"in ner": {"a": [1, {"b": True}]}})
        self.assertEqual(tomllib.loads(case.toml()), case)
        with self.assertRaisesRegex(TypeError, "cannot hold"):
            perilink.Case(body={"spacing": object()}).toml()

    def test_copies_share_nothing(self):
        case = perilink.parse_case(STRIP)
        copy = case.copy()
        copy["body"]["spacing"] = 5.0
        self.assertEqual(case["body"]["spacing"], 10.0)
        self.assertEqual(case.toml(), STRIP)

    def test_a_file_may_be_changed_by_an_array(self):
        case = perilink.parse_case(STRIP)
        case["regions"][0]["x"] = np.array([0, 40])
        self.assertEqual(case.toml(), STRIP)
        case["regions"][0]["x"] = np.array([0, 50])
        self.assertEqual(case.check()["regions"][0]["x"], [0, 50])

    def test_points_of_a_field_are_an_array(self):
        points = np.array([[0, 0, 1], [40, 0, 1], [0, 80, 4], [40, 80, 4]])
        case = perilink.parse_case(STRIP)
        case["graded"] = [{"property": "fracture_energy", "file": points}]
        self.assertEqual(case.check()["graded"][0]["file"], "graded_1.csv")
        graded = perilink.build(case).critical_stretch
        case["graded"][0] = {"property": "fracture_energy", "factor": "1 + 3 * y / 80"}
        formula = perilink.build(case).critical_stretch
        np.testing.assert_allclose(graded, formula, rtol=1e-12)
        with tempfile.TemporaryDirectory() as folder:
            case["graded"][0] = {"property": "fracture_energy", "file": points,
                                 "column": "energy"}
            case.write(Path(folder) / "strip.toml")
            self.assertEqual((Path(folder) / "strip_graded_1.csv").read_text().splitlines()[:2],
                             ["x,y,energy", "0.0,0.0,1.0"])
            again = perilink.read_case(Path(folder) / "strip.toml")
            np.testing.assert_array_equal(perilink.build(again).critical_stretch, graded)
            perilink.run(case, Path(folder) / "r")
            self.assertTrue((Path(folder) / "r" / "graded_1.csv").exists())
            kept = tomllib.loads((Path(folder) / "r" / "case.toml").read_text())
            self.assertEqual(Path(kept["graded"][0]["file"]).name, "graded_1.csv")
        case["graded"][0]["file"] = points[:, :2]
        with self.assertRaisesRegex(ValueError, r"shape \(4, 2\); allowed are \(n, 3\)"):
            perilink.build(case)

    def test_cases_in_one_folder_keep_their_points(self):
        points = np.array([[0.0, 0.0, 1.0], [0.0, 80.0, 1.0]])
        case = perilink.parse_case(STRIP)
        # One array serves two tables.
        case["graded"] = [{"property": p, "file": points, "column": p}
                          for p in ("youngs_modulus", "fracture_energy")]
        with tempfile.TemporaryDirectory() as folder:
            for name, factor in (("soft", 1.0), ("stiff", 4.0)):
                case["graded"][0]["file"] = points * [1.0, 1.0, factor]
                case.write(Path(folder) / f"{name}.toml")
            soft, stiff = (perilink.build(perilink.read_case(Path(folder) / f"{name}.toml"))
                           for name in ("soft", "stiff"))
            np.testing.assert_allclose(stiff.stiffness, 4.0 * soft.stiffness, rtol=1e-9)

    def test_other_files_are_found_from_another_folder(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "sub").mkdir()
            (folder / "field.csv").write_text("x,y,factor\n0,0,1\n0,80,4\n")
            case = perilink.Case(perilink.parse_case(STRIP), path=folder / "strip.toml")
            case["graded"] = [{"property": "fracture_energy", "file": "field.csv"}]
            case.write(folder / "near.toml")
            self.assertIn('file = "field.csv"', (folder / "near.toml").read_text())
            case.write(folder / "sub" / "far.toml")
            perilink.build(perilink.read_case(folder / "sub" / "far.toml"))
            self.assertEqual(perilink.Case(case).path, case.path)

    def test_plain_dictionaries_are_cases_and_paths_are_not(self):
        tables = tomllib.loads(STRIP)
        self.assertGreater(len(perilink.build(tables).bonds), 0)
        with self.assertRaisesRegex(TypeError, "read_case"):
            perilink.build("strip.toml")

    def test_faults_of_a_file_have_their_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "faulty.toml"
            path.write_text(STRIP.replace("horizon", "horizn"))
            with self.assertRaises(perilink.InputError) as caught:
                perilink.read_case(path)
            self.assertEqual(caught.exception.path, str(path))
            self.assertEqual(caught.exception.line, 4)
            self.assertEqual(caught.exception.key, "body.horizn")
            self.assertIn(f"{path}:4: body.horizn: ", str(caught.exception))
            self.assertIn("did you mean `horizon`?", str(caught.exception))
            with self.assertRaises(perilink.FileError):
                perilink.read_case(path.with_name("missing.toml"))

    def test_faults_of_a_changed_case_have_their_key(self):
        case = perilink.parse_case(STRIP)
        case["materials"][0]["youngs_modulus"] = -1
        with self.assertRaises(perilink.InputError) as caught:
            case.check()
        self.assertEqual(caught.exception.line, 0)
        self.assertEqual(caught.exception.key, "materials[1].youngs_modulus")
        self.assertTrue(str(caught.exception).startswith("case: materials[1].youngs_modulus: "))
        self.assertIsInstance(caught.exception, ValueError)

    def test_help_and_schema_have_every_key(self):
        schema = perilink.case_schema()["properties"]
        self.assertEqual(schema["analysis"]["properties"]["rows"]["default"], 500)
        for name, table in schema.items():
            for key in table.get("items", table).get("properties", {}):
                self.assertIn(f"  {key}: ", perilink.Case.__doc__, name)


if __name__ == "__main__":
    unittest.main()
