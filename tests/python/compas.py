#!/usr/bin/env python3
"""compas.py PROGRAM: problems of compas_dem as JSON files and as objects: an arch, a course of a dome and a vault as the program computes them,
loads, displacements, and what a problem may lack. compas itself is not needed."""

import json
import math
import os
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya
from kaya.compas import Kaya, assembly_of, deck_of, register, solve

PROGRAM = os.path.realpath(sys.argv.pop())
DENSITY, G = 2400.0, 9.81
SIDES = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]]


def at(radius, angle, across):
    return [radius * math.cos(angle), across, radius * math.sin(angle)]


def voussoir(inner, outer, begin, end, near, far):
    """Eight corners: four at `begin`, four at `end`."""
    return [at(r, angle, across) for angle in (begin, end)
            for r, across in ((inner, near), (outer, near), (outer, far), (inner, far))]


def arch():
    """(hexahedra, supports): a half circle of 15 voussoirs."""
    turns = np.linspace(math.pi, 0, 16)
    return [voussoir(2.0, 2.5, a, b, 0, 0.8) for a, b in zip(turns, turns[1:])], [0, 14]


def vault():
    """Three arches side by side, on common springers."""
    turns = np.linspace(0.9 * math.pi, 0.1 * math.pi, 10)
    blocks = [voussoir(3.0, 3.6, a, b, y, y + 0.5) for y in (0, 0.5, 1.0) for a, b in zip(turns[1:], turns[2:-1])]
    blocks += [voussoir(3.0, 3.6, a, b, 0, 1.5) for a, b in ((turns[0], turns[1]), (turns[-2], turns[-1]))]
    return blocks, [len(blocks) - 2, len(blocks) - 1]


def dome_course():
    """A ring of 12 stones of a spherical shell that leans inwards, on a ring of supports."""
    def corner(radius, height_angle, turn):
        return [radius * math.cos(height_angle) * math.cos(turn), radius * math.cos(height_angle) * math.sin(turn), radius * math.sin(height_angle)]

    def ring(low, high):
        turns = np.linspace(0, 2 * math.pi, 13)
        return [[corner(r, h, t) for t in (a, b) for r, h in ((2.0, low), (2.3, low), (2.3, high), (2.0, high))] for a, b in zip(turns, turns[1:])]

    return ring(0.3, 0.6) + ring(0.6, 0.9), list(range(12))


def problem(blocks, supports, joint={"kn": 1e10, "kt": 5e9}, **conditions):
    """The JSON of a Problem."""
    elements, nodes = {}, {}
    for number, corners in enumerate(blocks):
        mesh = {"vertex": {str(10 * number + k): dict(zip("xyz", map(float, corner))) for k, corner in enumerate(corners)},
                "face": {str(k): [10 * number + corner for corner in side] for k, side in enumerate(SIDES)}}
        elements[f"guid-{number}"] = {"dtype": "compas_dem.elements/Block", "data": {
            "transformation": None, "geometry": {"dtype": "compas.datastructures/Mesh", "data": mesh}, "is_support": number in supports,
            "material": {"dtype": "compas_dem.material/Stone", "data": {"density": DENSITY}}}}
        nodes[str(number)] = {"element": f"guid-{number}"}
    boundary = {"gravity": True, "g": G, "body_forces": [], "point_loads": [], "surface_loads": [], "displacements": []} | conditions
    return {"dtype": "compas_dem.problem/Problem", "data": {
        "name": "Problem",
        "model": {"dtype": "compas_dem.models/BlockModel", "data": {"elements": elements, "graph": {"node": nodes, "edge": {}}}},
        "boundary_conditions": {"dtype": "compas_dem.problem/BoundaryConditions", "data": boundary},
        "contact_properties": {"dtype": "compas_dem.interactions/ContactProperties", "data": {
            "contact_model": {"dtype": "compas_dem.interactions/MohrCoulomb", "data": {"mu": math.tan(math.radians(35)), "c": 0}},
            "joint_model": joint and {"dtype": "compas_dem.interactions/JointModel", "data": joint}}}}}


def box(x, y, z, size=(1, 1, 1)):
    dx, dy, dz = size
    return [[x + a * dx, y + b * dy, z + c * dz] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]


def clockwise(corners, side):
    """The corners of a side, clockwise seen from outside."""
    a, b, c = (np.array(corners[k]) for k in side[:3])
    return side[::-1] if np.cross(b - a, c - a) @ (a - np.mean(corners, axis=0)) > 0 else side


def hand_deck(blocks, supports):
    """The same model, written as a person would, with the same faces: where a side is divided into triangles moves forces by 1e-6."""
    lines = []
    for block in blocks:
        faces = (" ".join(repr(float(value)) for k in clockwise(block, side) for value in block[k]) for side in SIDES)
        lines.append("poly " + " &\n ".join("face " + face for face in faces))
    lines += [f"prop mat 1 dens {DENSITY}", "prop jmat 1 jkn 1e10 jks 5e9 jfric 35"]
    lines += [f"fix range id {number + 1}" for number in supports]
    return "\n".join(lines + [f"gravity 0 0 {-G}", "damp local 0.8", "solve ratio 1e-11 cycles 400000", "save 'hand.kaya.h5'"]) + "\n"


def tetrahedra(corners):
    """Volume of a hexahedron by triangles of its sides."""
    corners = np.array(corners, float)
    middle, volume = corners.mean(axis=0), 0.0
    for side in SIDES:
        a, b, c, d = corners[side] - middle
        volume += abs(np.dot(a, np.cross(b, c))) / 6 + abs(np.dot(a, np.cross(c, d))) / 6
    return volume


class Structures(unittest.TestCase):
    def check(self, blocks, supports):
        results = solve(problem(blocks, supports), Kaya(ratio=1e-11, cycles=400_000))
        weights = [DENSITY * G * tetrahedra(corners) for corners in blocks]
        whole = sum(weights)
        # Each free block is in equilibrium, and the supports carry all.
        net = np.array([[0, 0, -weight] for weight in weights])
        for (u, v), edge in results.edges.items():
            net[u] -= edge["resultant_global"]
            net[v] += edge["resultant_global"]
        free = [k for k in range(len(blocks)) if k not in supports]
        self.assertLess(abs(net[free]).max(), 1e-9 * whole)
        reactions = np.sum([results.reaction(node) for node in supports], axis=0)
        np.testing.assert_allclose(reactions, (0, 0, whole), atol=1e-9 * whole)
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "hand.3dd").write_text(hand_deck(blocks, supports))
            subprocess.run([PROGRAM, "--quiet", "hand.3dd"], cwd=folder, check=True, capture_output=True)
            hand = kaya.open(folder + "/hand.kaya.h5")
            forces = {(one["block1"] - 1, one["block2"] - 1): one for one in hand.interfaces()}
            self.assertEqual(set(forces), set(results.edges))
            largest = max(np.linalg.norm(one["force"]) for one in forces.values())
            for edge, one in forces.items():
                np.testing.assert_allclose(results.resultant_global(edge), one["force"], atol=1e-6 * largest)
            np.testing.assert_allclose([results.displacement(node) for node in range(len(blocks))], hand.blocks["displacement"],
                                       atol=1e-6 * abs(hand.blocks["displacement"]).max())
        return results

    def test_arch(self):
        results = self.check(*arch())
        crown = results.edges[(6, 7)]
        self.assertGreater(crown["normal_force"], 0)
        point = np.array(crown["force_point"])
        self.assertTrue(2.0 <= np.hypot(point[0], point[2]) <= 2.5) # the thrust line is inside

    def test_dome_course(self):
        results = self.check(*dome_course())
        hoop = [results.edges[tuple(sorted((12 + k, 12 + (k + 1) % 12)))]["normal_force"] for k in range(12)]
        np.testing.assert_allclose(hoop, hoop[0], rtol=1e-6) # by symmetry

    def test_vault(self):
        self.check(*vault())


class Conditions(unittest.TestCase):
    def test_point_and_surface_loads(self):
        load = {"block_index": 1, "force": [0, 0, -500.0], "moment": None, "point": [0.7, 0.5, 2.0], "loading_type": "ramp"}
        face = {"dtype": "compas.geometry/Polygon", "data": {"points": [[0.2, 0.2, 2.0], [0.2, 0.6, 2.0], [0.6, 0.6, 2.0], [0.6, 0.2, 2.0]]}}
        pressure = {"block_index": 1, "polygon": face, "magnitude": 1000.0, "direction": None}  # its normal is down
        results = solve(problem([box(0, 0, 0), box(0, 0, 1)], [0], point_loads=[load], surface_loads=[pressure]))
        weight = DENSITY * G
        np.testing.assert_allclose(results.resultant_global((0, 1)), (0, 0, weight + 500 + 160), atol=1e-6 * weight)
        whole = weight + 660
        expected = [(0.5 * weight + 0.7 * 500 + 0.4 * 160) / whole, (0.5 * weight + 0.5 * 500 + 0.4 * 160) / whole, 1.0]
        np.testing.assert_allclose(results.force_point((0, 1)), expected, atol=1e-5)
        np.testing.assert_allclose(results.resultant_global((1, 0)), (0, 0, -whole), atol=1e-6 * weight)
        np.testing.assert_allclose(results.reaction(0), (0, 0, whole + weight), atol=1e-6 * weight)

    def test_moments_and_body_forces(self):
        load = {"block_index": 1, "force": [0, 0, 0], "moment": [0, 1000.0, 0], "point": None}
        results = solve(problem([box(0, 0, 0), box(0, 0, 1)], [0], point_loads=[load], body_forces=[[0.5, 0, 0]]))
        weight, side = DENSITY * G, DENSITY * 0.5
        np.testing.assert_allclose(results.resultant_global((0, 1)), (-side, 0, weight), atol=1e-6 * weight)
        np.testing.assert_allclose(results.force_point((0, 1))[0], 0.5 + (1000 + 0.5 * side) / weight, atol=1e-5)

    def test_prescribed_displacements(self):
        moved = {"block_index": 2, "translation": [0.0, 0.0, -0.01], "rotation": [0, 0, 0]}
        beam = [box(0, 0, 0), box(0, 0, 1, (4, 1, 0.5)), box(3, 0, 0)]
        results = solve(problem(beam, [0], displacements=[moved]))
        np.testing.assert_allclose(results.displacement(2), (0, 0, -0.01), atol=1e-9)
        np.testing.assert_allclose(results.displacement(0), (0, 0, 0), atol=0)
        # The beam turns about the inner edge of the left support and rests on the outer edge of the right one.
        self.assertAlmostEqual(results.displacement(1)[2], -0.01 / 3, delta=3e-4)
        turned = {"block_index": 1, "translation": [0, 0, 0], "rotation": [0, 0, 0.02]}
        results = solve(problem([box(0, 0, 0), box(5, 0, 0)], [0], displacements=[turned]))
        matrix = np.array(results.transformation(1))
        np.testing.assert_allclose(matrix[:2, :2], [[math.cos(0.02), -math.sin(0.02)], [math.sin(0.02), math.cos(0.02)]], atol=1e-6)
        np.testing.assert_allclose(matrix @ (5.5, 0.5, 0.5, 1), (5.5, 0.5, 0.5, 1), atol=1e-9)

    def test_components_that_are_free(self):
        held = {"block_index": 1, "translation": [0.0, 0.0, None], "rotation": None}
        results = solve(problem([box(0, 0, 0), box(0, 0, 1)], [0], displacements=[held]))
        self.assertLess(results.displacement(1)[2], 0)
        self.assertEqual(results.displacement(1)[:2], [0, 0])

    def test_units_and_places_change_nothing(self):
        blocks, supports = arch()
        plain = solve(problem(blocks, supports))
        moved = solve(problem([[[x + 300, y - 200, z + 100] for x, y, z in block] for block in blocks], supports))
        mirrored = solve(problem([[[-x, y, z] for x, y, z in block] for block in blocks], supports))
        for edge, values in plain.edges.items():
            np.testing.assert_allclose(moved.resultant_global(edge), values["resultant_global"], atol=1e-2)
            np.testing.assert_allclose(np.array(mirrored.resultant_global(edge)) * (-1, 1, 1), values["resultant_global"], atol=1e-2)


class Places(unittest.TestCase):
    def test_files(self):
        blocks, supports = [box(0, 0, 0), box(0, 0, 1)], [0]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "problem.json")
            file.write_text(json.dumps(problem(blocks, supports)))
            results = solve(file)
            results.save(folder + "/results.json")
            read = json.loads(Path(folder, "results.json").read_text())
            self.assertEqual(read["data"]["edge_data"]["0,1"]["resultant_global"], results.resultant_global((0, 1)))
            Path(folder, "stack.3dd").write_text(deck_of(assembly_of(file)))
            said = subprocess.run([PROGRAM, "stack.3dd"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertIn("hash " + results.metadata["hash"], said.stdout + said.stderr)

    def test_objects_and_their_graph(self):
        class Mesh:
            def __init__(self, corners):
                self.corners = corners

            def to_vertices_and_faces(self, triangulated=False):
                return self.corners, SIDES

        class Graph:
            def __init__(self):
                self.values, self.edges = {}, set()

            def has_edge(self, edge):
                return edge in self.edges

            def add_edge(self, u, v):
                self.edges.add((u, v))

            def node_attribute(self, node, name, value):
                self.values[node, name] = value

            def edge_attribute(self, edge, name, value):
                self.values[edge, name] = value

        blocks = [types.SimpleNamespace(graphnode=7 + k, modelgeometry=Mesh(box(0, 0, k)), is_support=k == 0,
                                        material=types.SimpleNamespace(density=DENSITY)) for k in range(2)]
        graph = Graph()
        of_objects = types.SimpleNamespace(
            model=types.SimpleNamespace(elements=lambda: iter(blocks), graph=graph),
            boundary_conditions=types.SimpleNamespace(gravity=True, g=G, body_forces=[], point_loads=[], surface_loads=[], displacements=[]),
            contact_properties=types.SimpleNamespace(contact_model=None, joint_model=None))
        results = solve(of_objects)
        np.testing.assert_allclose(graph.values[(7, 8), "resultant_global"], (0, 0, DENSITY * G), atol=1e-3)
        self.assertEqual(graph.values[8, "displacement"], results.displacement(8))
        self.assertEqual(graph.edges, {(7, 8)})

    def test_registers_with_compas_dem(self):
        try:
            import compas_dem  # noqa: F401
        except ImportError:
            with self.assertRaisesRegex(ImportError, "compas_dem is not installed"):
                register()
        Problem = type("Problem", (), {"solve": lambda self, solver: "of another solver"})
        module = types.ModuleType("compas_dem.problem")
        module.Problem, module.Solver = Problem, type("Solver", (), {})
        sys.modules |= {"compas_dem": types.ModuleType("compas_dem"), "compas_dem.problem": module}
        try:
            register()
            self.assertEqual(Problem().solve("LMGC90"), "of another solver")
            with self.assertRaisesRegex(ValueError, "not a Problem"):
                Problem().solve(module.Solver.Kaya())
        finally:
            del sys.modules["compas_dem"], sys.modules["compas_dem.problem"]


class Wrong(unittest.TestCase):
    def test_problems(self):
        blocks, supports = [box(0, 0, 0), box(0, 0, 1)], [0]

        def without(change):
            one = problem(blocks, supports)
            change(one["data"])
            return one

        def element(data, number=0):
            return data["model"]["data"]["elements"][f"guid-{number}"]["data"]

        load = {"block_index": 9, "force": [0, 0, 1], "moment": None, "point": None}
        line = {"block_index": 1, "polygon": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "magnitude": 1, "direction": None}
        for wrong, text in ((problem(blocks, []), "no block is supported"), (problem(blocks, supports, point_loads=[load]), "no block 9"),
                            (problem(blocks, supports, point_loads=[load | {"force": [1, 2]}]), "vector of three"),
                            (problem(blocks, supports, point_loads=[load | {"force": [1, 2, math.nan]}]), "vector of three"),
                            (problem(blocks, supports, surface_loads=[line]), "no area"), (problem([], []), "no blocks"),
                            (without(lambda data: element(data).update(material=None)), "no material"),
                            (without(lambda data: element(data).update(geometry=None)), "no mesh"),
                            (without(lambda data: data.pop("boundary_conditions")), "not a Problem"), ({}, "not a Problem")):
            with self.assertRaisesRegex(ValueError, text):
                solve(wrong)
        with self.assertRaises(FileNotFoundError):
            solve("nosuch.json")
        open_box = problem(blocks, supports)
        element(open_box["data"])["geometry"]["data"]["face"].pop("0")
        with self.assertRaises(kaya.Error):
            solve(open_box)

    def test_materials_by_their_guid(self):
        one = problem([box(0, 0, 0), box(0, 0, 1)], [0])
        model = one["data"]["model"]["data"]
        model["materials"] = {"stone": {"dtype": "compas_dem.material/Stone", "data": {"density": 1000.0}}}
        for entry in model["elements"].values():
            entry["data"]["material"] = "stone"
        np.testing.assert_allclose(solve(one).metadata["weight"], (0, 0, -2 * 1000 * G), rtol=1e-12)

    def test_defaults_of_the_solver(self):
        deck = deck_of(assembly_of(problem([box(0, 0, 0)], [0], joint=None)), Kaya(kn=3e9, kt=2e9))
        self.assertIn("jkn 3000000000.0 jks 2000000000.0 jfric 35", deck)


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())
    unittest.main()
