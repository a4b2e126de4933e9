"""Arrays of models, elastic solutions, meshes from arrays."""

import gc
import tempfile
import unittest
from pathlib import Path

import numpy as np

import perilink
from test_cases import EXAMPLES, STRIP


def plate(cells: int, length: float, height: float) -> perilink.Mesh:
    """A rectangle of right triangles, with groups for its ends and its cells."""
    across = max(2, round(cells * height / length))
    x, y = np.meshgrid(np.linspace(0, length, cells + 1), np.linspace(0, height, across + 1),
                       indexing="ij")
    number = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (n.ravel() for n in (number[:-1, :-1], number[1:, :-1], number[1:, 1:],
                                      number[:-1, 1:]))
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    points = np.stack([x.ravel(), y.ravel()], 1)
    centre = points[triangles].mean(axis=1)
    return perilink.Mesh(points, triangles, {
        "plate": np.arange(len(triangles)),
        "right half": np.flatnonzero(centre[:, 0] > length / 2),
        "left end": np.stack([number[0, :-1], number[0, 1:]], 1),
        "right end": np.stack([number[-1, :-1], number[-1, 1:]], 1),
    })


def meshed_case(mesh: perilink.Mesh) -> perilink.Case:
    return perilink.Case(
        body={"mesh": mesh, "horizon_ratio": 2.5},
        regions=[{"name": name, "group": name} for name in mesh.groups]
        + [{"name": "corner", "x": [0, 0], "y": [0, 0]}],
        materials=[{"region": "plate", "youngs_modulus": 100.0, "fracture_energy": "infinite"}],
        supports=[{"region": "left end", "fix": ["x"]}, {"region": "corner", "fix": ["y"]}],
        displacements=[{"region": "right end", "x": 0.04}],
        analysis={"type": "elastic"},
    )


class Problems(unittest.TestCase):
    def test_arrays_have_the_shapes_of_the_model(self):
        problem = perilink.build(perilink.parse_case(STRIP))
        self.assertEqual((problem.dim, problem.width), (2, 2))
        self.assertEqual(problem.positions.shape, (45, 2))
        # 5 by 9 particles 10 apart; cells at edges and corners are cut.
        np.testing.assert_allclose(problem.volumes.sum(), 40 * 80)
        bonds = problem.bonds
        self.assertEqual(bonds.shape, (len(problem.stiffness), 2))
        self.assertEqual(problem.first_bar_element, len(bonds))
        self.assertTrue(np.all(bonds[:, 0] < bonds[:, 1]))
        ends = problem.positions[bonds]
        np.testing.assert_allclose(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), problem.lengths)
        self.assertLessEqual(problem.lengths.max(), problem.horizon)
        self.assertEqual(problem.critical_stretch.shape, problem.stiffness.shape)
        self.assertTrue(np.all(problem.critical_stretch > 0))
        np.testing.assert_array_equal(
            problem.regions["lower end"], np.flatnonzero(problem.positions[:, 1] < 25))
        self.assertEqual(problem.kind.max(), 0)
        self.assertEqual(problem.material.max(), 0)

    def test_arrays_are_views_that_outlive_the_problem(self):
        problem = perilink.build(perilink.parse_case(STRIP))
        for name in ("positions", "volumes", "material", "bonds", "stiffness", "critical_stretch"):
            first, second = getattr(problem, name), getattr(problem, name)
            self.assertTrue(np.may_share_memory(first, second), name)
            self.assertFalse(first.flags.writeable, name)
        bonds, positions = problem.bonds, problem.positions
        copies = bonds.copy(), positions.copy()
        del problem
        gc.collect()
        perilink.build(perilink.parse_case(STRIP))
        np.testing.assert_array_equal(bonds, copies[0])
        np.testing.assert_array_equal(positions, copies[1])

    def test_uniform_tension_of_a_mesh_from_arrays_is_exact(self):
        case = meshed_case(plate(16, 2.0, 1.0))
        solution = perilink.solve(case)
        # Calibrated bonds are exact in uniform strain: E A u / L and E u / L.
        self.assertAlmostEqual(solution.load, 100 * 1.0 * 0.04 / 2.0, delta=1e-8)
        self.assertAlmostEqual(solution.strain_energy, 0.5 * 2.0 * 0.04, delta=1e-9)
        problem = perilink.build(case)
        np.testing.assert_allclose(solution.displacement[:, 0], 0.02 * problem.positions[:, 0],
                                   atol=1e-10)
        np.testing.assert_allclose(solution.stress[:, 0], 2.0, rtol=1e-7)
        np.testing.assert_allclose(solution.reactions["supports: left end"]["force"], [-2.0, 0, 0],
                                   atol=1e-8)

    def test_a_mesh_is_kept_with_the_results(self):
        mesh = plate(8, 2.0, 1.0)
        with tempfile.TemporaryDirectory() as folder:
            result = perilink.run(meshed_case(mesh), Path(folder) / "out")
            again = perilink.run(perilink.read_case(Path(folder) / "out/case.toml"))
            np.testing.assert_array_equal(result.fields()["displacement"],
                                          again.fields()["displacement"])
            with self.assertRaises(perilink.FileError):
                perilink.run(meshed_case(mesh), Path(folder) / "out")
            meshed_case(mesh).write(Path(folder) / "case.toml")
            read = perilink.build(perilink.read_case(Path(folder) / "case.toml"))
        np.testing.assert_array_equal(read.positions, mesh.points)

    def test_groups_of_cells_and_sides_are_regions(self):
        mesh = plate(8, 2.0, 1.0)
        regions = perilink.build(meshed_case(mesh)).regions
        self.assertEqual(set(regions["left end"]), set(np.flatnonzero(mesh.points[:, 0] == 0.0)))
        self.assertEqual(set(regions["right half"]), set(np.flatnonzero(mesh.points[:, 0] >= 1.0)))
        self.assertEqual(len(regions["plate"]), len(mesh.points))

    def test_a_tetrahedron_mesh_in_space(self):
        # A cube of six tetrahedra around its diagonal.
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
        cells = [[0, 4, 6, 7], [0, 6, 2, 7], [0, 2, 3, 7], [0, 3, 1, 7], [0, 1, 5, 7], [0, 5, 4, 7]]
        mesh = perilink.Mesh(corners, cells, {"all": range(6), "bottom": [[0, 4, 6], [0, 6, 2]]})
        case = perilink.Case(
            body={"problem": "three_dimensional", "mesh": mesh, "method": "linear_elements"},
            regions=[{"name": "all", "group": "all"}, {"name": "bottom", "group": "bottom"}],
            materials=[{"region": "all", "youngs_modulus": 1.0, "poissons_ratio": 0.25}],
            supports=[{"region": "bottom", "fix": ["x", "y", "z"]}],
            loads=[{"region": "all", "body_force": [0, 0, -1.0]}],
            analysis={"type": "elastic"},
        )
        solution = perilink.solve(case)
        np.testing.assert_allclose(solution.reactions["supports: bottom"]["force"], [0, 0, 1.0],
                                   atol=1e-12)

    def test_faulty_meshes_are_refused(self):
        points, cells = [[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]
        for arguments, text in [
            ((points, [[0, 1]]), "allowed are"),
            ((points, [[0, 1, 3]]), "numbers 0 to 2"),
            ((points, [[0.0, 1.0, 2.0]]), "integers"),
            (([0, 1, 2], cells), "points have the shape"),
            ((points, cells, {"a": [1]}), "numbers 0 to 0"),
            ((points, cells, {"a": [[0, 1, 2]]}), "allowed are"),
            ((points, cells, {'a"': [0]}), "quotes"),
        ]:
            with self.assertRaisesRegex(ValueError, text):
                perilink.Mesh(*arguments)

    def test_an_open_crack_is_open_in_all_kinds_of_cases(self):
        case = perilink.parse_case(STRIP)
        case["materials"][0].update({"tensile_strength": 0.3, "softening": "linear"})
        case["cracks"] = [{"points": [[0, 40], [20, 40]], "closing": True}]
        single = perilink.solve(perilink.build(case))
        case["stages"] = [{"name": "pull", "to": 0.5}]
        staged = perilink.solve(perilink.build(case))
        np.testing.assert_array_equal(staged.displacement, single.displacement)
        del case["stages"]
        case["materials"][0]["density"] = 1e-9
        for analysis in ({"type": "elastic"}, {"type": "explicit", "duration": 1.0},
                         {"type": "relaxation"}):
            case["analysis"] = analysis
            other = perilink.solve(perilink.build(case))
            np.testing.assert_allclose(other.displacement, single.displacement, rtol=1e-12,
                                       atol=1e-15, err_msg=analysis["type"])
        del case["analysis"]
        del case["cracks"]
        whole = perilink.solve(perilink.build(case))
        self.assertGreater(single.strain_energy, 1.1 * whole.strain_energy)

    def test_examples_build(self):
        for name in ("rc_cantilever", "roof", "timber_beam"):
            problem = perilink.build(perilink.read_case(EXAMPLES / f"{name}.toml"))
            self.assertEqual(len(problem.bonds), len(problem.lengths), name)


if __name__ == "__main__":
    unittest.main()
