"""A solver for compas_dem: its problems in, its results out.

    from kaya.compas import Kaya, solve
    results = solve(problem, Kaya(ratio=1e-9))       # a compas_dem Problem, or the name of its JSON file
    results.resultant_global((3, 4)), results.reaction(0), results.displacement(5)

compas is not needed for JSON files. `register()` lets Problem.solve of compas_dem take Kaya(). Units are those of the problem; joint stiffnesses kn and kt
are stress per displacement. Without a joint model they are those of Kaya, without a contact model the friction is that of Kaya.
"""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from typing import Any, Iterable

import numpy as np
from numpy.typing import NDArray

from .model import Model

Vector = NDArray[np.float64]


class Kaya:
    """A solver in the sense of compas_dem: a name and parameters.

    ratio: unbalanced over average force at the end. cycles: most cycles of one stage. damping: the words after `damp`. displacement_cycles: cycles in
    which prescribed displacements are reached. kn, kt, friction: where the problem has none.
    """

    name = "kaya"

    def __init__(self, ratio: float = 1e-10, cycles: int = 200_000, damping: str = "local 0.8", displacement_cycles: int = 2000,
                 kn: float = 1e10, kt: float = 1e10, friction: float = 30.0) -> None:
        self.parameters: dict[str, Any] = dict(ratio=ratio, cycles=cycles, damping=damping, displacement_cycles=displacement_cycles,
                                               kn=kn, kt=kt, friction=friction)

    def __repr__(self) -> str:
        return f"Solver(name={self.name}, parameters={self.parameters})"


@dataclass
class Block:
    """A rigid block: `node` is its number in the graph of the model."""

    node: int
    vertices: Vector
    faces: list[list[int]]
    density: float
    support: bool


@dataclass
class Assembly:
    """A problem as kaya needs it."""

    blocks: list[Block]
    gravity: Vector
    loads: list[tuple[int, Vector, Vector | None, Vector]] = field(default_factory=list)  # node, force, point or None, moment
    motions: dict[int, list[float | None]] = field(default_factory=dict)  # node: three translations, three rotations
    friction: float | None = None
    cohesion: float = 0.0
    kn: float | None = None
    kt: float | None = None


class Results:
    """Results by node and edge, as compas_dem names them. The forces of the edge (u, v) are those of u on v."""

    def __init__(self) -> None:
        self.nodes: dict[int, dict[str, Any]] = {}
        self.edges: dict[tuple[int, int], dict[str, Any]] = {}
        self.metadata: dict[str, Any] = {}

    def edge_attribute(self, edge: tuple[int, int], name: str) -> Any:
        """None where there is no contact; forces turn with the order of the nodes."""
        if edge in self.edges:
            return self.edges[edge].get(name)
        value = self.edges.get(edge[::-1], {}).get(name)
        return [-part for part in value] if value is not None and name in ("resultant_global", "normal") else value

    def node_attribute(self, node: int, name: str) -> Any:
        return self.nodes.get(node, {}).get(name)

    def resultant_global(self, edge: tuple[int, int]) -> Any:
        return self.edge_attribute(edge, "resultant_global")

    def force_point(self, edge: tuple[int, int]) -> Any:
        return self.edge_attribute(edge, "force_point")

    def contact_polygon(self, edge: tuple[int, int]) -> Any:
        return self.edge_attribute(edge, "contact_polygon")

    def displacement(self, node: int) -> Any:
        return self.node_attribute(node, "displacement")

    def transformation(self, node: int) -> Any:
        return self.node_attribute(node, "transformation")

    def reaction(self, node: int) -> Any:
        """The force of a support on its block, own weight included; None for free blocks."""
        return self.node_attribute(node, "reaction")

    def save(self, file: str | os.PathLike[str]) -> None:
        """A JSON file as compas_dem reads it."""
        data = {"model_id": "", "problem_id": "", "displacement_scale": 1.0, "node_data": {str(n): v for n, v in self.nodes.items()},
                "edge_data": {f"{u},{v}": value for (u, v), value in self.edges.items()}, "metadata": self.metadata}
        with open(file, "w", encoding="utf-8") as stream:
            json.dump({"dtype": "compas_dem.problem/Results", "data": data}, stream)

    def write_into(self, graph: Any) -> None:
        """Stores all attributes in the graph of a model; edges that it lacks are added."""
        for node, values in self.nodes.items():
            for name, value in values.items():
                graph.node_attribute(node, name, value)
        for (u, v), values in self.edges.items():
            if not graph.has_edge((u, v)) and not graph.has_edge((v, u)):
                graph.add_edge(u, v)
            for name, value in values.items():
                graph.edge_attribute((u, v), name, value)


# Reading problems: objects of compas_dem by their attributes, JSON by its keys.


class _Data:
    """A JSON object of compas, with its keys as attributes; None for keys that it lacks."""

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _plain(self._data.get(name))

    def items(self) -> Iterable[tuple[str, Any]]:
        return ((key, _plain(value)) for key, value in self._data.items())


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return _Data(value["data"]) if isinstance(value.get("data"), dict) and "dtype" in value else value.get("data") \
            if "dtype" in value else _Data(value)
    return [_plain(one) for one in value] if isinstance(value, list) else value


def _get(thing: Any, name: str) -> Any:
    return thing.get(name) if isinstance(thing, dict) else getattr(thing, name, None)


def _vector(value: Any) -> Vector:
    vector = np.array(list(value), dtype=float)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise ValueError(f"{value!r} is not a vector of three numbers")
    return vector


def _mesh(geometry: Any, node: int) -> tuple[Vector, list[list[int]]]:
    if hasattr(type(geometry), "to_vertices_and_faces"):
        vertices, faces = geometry.to_vertices_and_faces()
        return np.array([list(vertex) for vertex in vertices], dtype=float), [list(face) for face in faces]
    if geometry is None or geometry.vertex is None or geometry.face is None:
        raise ValueError(f"block {node} has no mesh")
    keys = {key: at for at, (key, _) in enumerate(geometry.vertex.items())}
    vertices = [[corner.x, corner.y, corner.z] for _, corner in geometry.vertex.items()]
    return np.array(vertices, dtype=float), [[keys[str(corner)] for corner in face] for _, face in geometry.face.items()]


def _placed(vertices: Vector, transformation: Any) -> Vector:
    matrix = None if transformation is None else transformation.matrix
    if matrix is None:
        return vertices
    turned = np.array(matrix, dtype=float)
    return np.asarray(vertices @ turned[:3, :3].T + turned[:3, 3], dtype=float)


def _density(block: Any, model: Any, node: int) -> float:
    material = _get(block, "material")
    if isinstance(material, str):  # the guid of one of the materials of the model
        materials = _get(model, "materials")
        listed = dict(materials.items()) if isinstance(materials, _Data) else {}
        material = listed.get(material)
    density = _get(material, "density")
    if density is None or not density > 0:
        raise ValueError(f"block {node} has no material with a density")
    return float(density)


def _blocks(model: Any) -> list[Block]:
    blocks = []
    if callable(_get(model, "elements")):  # a BlockModel
        for element in model.elements():
            vertices, faces = _mesh(element.modelgeometry, element.graphnode)
            blocks.append(Block(element.graphnode, vertices, faces, _density(element, model, element.graphnode), bool(element.is_support)))
        return blocks
    elements = _get(model, "elements")
    listed = list(elements.items()) if isinstance(elements, _Data) else [(str(at), one) for at, one in enumerate(elements or [])]
    nodes = {}
    graph = _get(model, "graph")
    if graph is not None and graph.node is not None:
        nodes = {data.element: int(node) for node, data in graph.node.items() if isinstance(data.element, str)}
    for at, (guid, element) in enumerate(listed):
        node = nodes.get(guid, at)
        vertices, faces = _mesh(element.geometry, node)
        blocks.append(Block(node, _placed(vertices, element.transformation), faces, _density(element, model, node), bool(element.is_support)))
    return blocks


def _polygon(value: Any) -> Vector:
    points = value.points if getattr(value, "points", None) is not None else value
    return np.array([list(point) for point in points], dtype=float)


def _area_vector(points: Vector) -> Vector:
    return np.asarray(sum(np.cross(a - points[0], b - points[0]) for a, b in zip(points[1:], points[2:])) / 2, dtype=float)


def _surface_load(entry: Any) -> tuple[int, Vector, Vector | None, Vector]:
    """Magnitude times area along the direction, or the normal of the polygon, at the centroid of the polygon."""
    points = _polygon(_get(entry, "polygon"))
    if len(points) < 3:
        raise ValueError("the polygon of a surface load has at least three corners")
    whole = _area_vector(points)
    area = float(np.linalg.norm(whole))
    if not area > 0:
        raise ValueError("the polygon of a surface load has no area")
    triangles = [(points[0], a, b) for a, b in zip(points[1:], points[2:])]
    shares = [float(np.cross(b - a, c - a) @ whole) / 2 / area**2 for a, b, c in triangles]
    centroid = sum(share * (a + b + c) / 3 for share, (a, b, c) in zip(shares, triangles))
    given = _get(entry, "direction")
    direction = whole / area if given is None else _vector(given)
    return _get(entry, "block_index"), direction * float(_get(entry, "magnitude")) * area, np.asarray(centroid), np.zeros(3)


def assembly_of(problem: Any) -> Assembly:
    """A Problem of compas_dem, the dict of its JSON, or the name of its file. Raises ValueError with what it lacks."""
    if isinstance(problem, (str, os.PathLike)):
        with open(problem, encoding="utf-8") as stream:
            problem = json.load(stream)
    if isinstance(problem, dict):
        problem = _plain(problem)
    model, conditions = _get(problem, "model"), _get(problem, "boundary_conditions")
    if model is None or conditions is None:
        raise ValueError("this is not a Problem of compas_dem: it has no model or no boundary_conditions; save the Problem, not its model alone")
    down = np.array([0, 0, -float(_get(conditions, "g") or 9.81)]) if _get(conditions, "gravity") else np.zeros(3)
    gravity = sum((_vector(one) for one in _get(conditions, "body_forces") or []), down)
    assembly = Assembly(_blocks(model), np.asarray(gravity))
    if not assembly.blocks:
        raise ValueError("the model has no blocks")
    nodes = {block.node: block for block in assembly.blocks}
    for entry in _get(conditions, "point_loads") or []:
        point, moment = _get(entry, "point"), _get(entry, "moment")
        assembly.loads.append((_get(entry, "block_index"), _vector(_get(entry, "force")), None if point is None else _vector(point),
                               np.zeros(3) if moment is None else _vector(moment)))
    assembly.loads += [_surface_load(entry) for entry in _get(conditions, "surface_loads") or []]
    for entry in _get(conditions, "displacements") or []:
        motion = assembly.motions.setdefault(_get(entry, "block_index"), [None] * 6)
        for first, part in ((0, _get(entry, "translation")), (3, _get(entry, "rotation"))):
            for axis, value in enumerate(part or []):
                if value is not None:
                    motion[first + axis] = float(value)
    for block in assembly.blocks:
        if block.support:
            assembly.motions.setdefault(block.node, [0.0] * 6)
    for node in [load[0] for load in assembly.loads] + list(assembly.motions):
        if node not in nodes:
            raise ValueError(f"there is no block {node}, which has a load or a displacement")
    if not assembly.motions:
        raise ValueError("no block is supported: add_supports_from_model() or add_support(index)")
    contact = _get(_get(problem, "contact_properties"), "contact_model")
    if contact is not None:
        friction, angle = _get(contact, "mu"), _get(contact, "phi")
        assembly.friction = math.degrees(math.atan(friction)) if friction is not None else angle
        assembly.cohesion = float(_get(contact, "c") or 0)
    joint = _get(_get(problem, "contact_properties"), "joint_model")
    assembly.kn, assembly.kt = _get(joint, "kn"), _get(joint, "kt")
    return assembly


# Decks.

_VELOCITIES = ("xvel", "yvel", "zvel", "rxvel", "ryvel", "rzvel")


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _lines_of_block(block: Block, material: int) -> str:
    outward = sum(float(_area_vector(block.vertices[face]) @ block.vertices[face[0]]) for face in block.faces) > 0
    turned = [face[::-1] if outward else face for face in block.faces]  # decks list corners clockwise seen from outside
    faces = " &\n ".join("face " + " ".join(_numbers(block.vertices[corner]) for corner in face) for face in turned)
    return f"poly {faces} &\n mat {material} group 'node {block.node}'"


def deck_of(assembly: Assembly, solver: Kaya | None = None) -> str:
    """The problem as a deck for the program, up to the equilibrium before displacements: the blocks are groups named 'node 0', 'node 1', ..."""
    parameters = (solver or Kaya()).parameters
    densities = sorted({block.density for block in assembly.blocks})
    kn, kt = assembly.kn or parameters["kn"], assembly.kt or parameters["kt"]
    friction = parameters["friction"] if assembly.friction is None else assembly.friction
    lines = [_lines_of_block(block, densities.index(block.density) + 1) for block in assembly.blocks]
    lines += [f"prop mat {number} dens {density!r}" for number, density in enumerate(densities, 1)]
    lines.append(f"prop jmat 1 jkn {kn!r} jks {kt!r} jfric {friction!r} jcoh {assembly.cohesion!r}")
    for node, motion in assembly.motions.items():
        held = " ".join(word for word, value in zip(_VELOCITIES, motion) if value is not None)
        if held:
            lines.append(f"fix {'' if None not in motion else held} range group 'node {node}'")
    lines.append(f"gravity {_numbers(assembly.gravity)}")
    for node, force, point, moment in assembly.loads:
        words = " ".join(f"{axis}load {value!r}" for axis, value in zip("xyz", force.tolist()) if value)
        if words:
            lines.append(f"apply {words}{'' if point is None else ' at ' + _numbers(point)} range group 'node {node}'")
        words = " ".join(f"{axis}moment {value!r}" for axis, value in zip("xyz", moment.tolist()) if value)
        if words:
            lines.append(f"apply {words} range group 'node {node}'")
    lines += [f"damp {parameters['damping']}", _solve(parameters)]
    return "\n".join(lines) + "\n"


def _solve(parameters: dict[str, Any]) -> str:
    return f"solve ratio {parameters['ratio']!r} cycles {parameters['cycles']}"


def _displace(model: Model, assembly: Assembly, parameters: dict[str, Any]) -> None:
    """Moves blocks by what is prescribed, in equal steps, then to equilibrium."""
    moving = {node: motion for node, motion in assembly.motions.items() if any(motion)}
    if not moving:
        return
    left, cycles = 1.0, int(parameters["displacement_cycles"])
    for _ in range(3):  # the time step may change under way: the rest follows
        duration = cycles * model.time_step
        for node, motion in moving.items():
            words = " ".join(f"{word} {value * left / duration!r}" for word, value in zip(_VELOCITIES, motion) if value)
            model.command(f"apply {words} range group 'node {node}'")
        model.command(f"cycle time {duration!r}")
        left, cycles = 1 - _covered(model, *next(iter(moving.items()))), 100
    for node, motion in moving.items():
        words = " ".join(f"{word} 0" for word, value in zip(_VELOCITIES, motion) if value)
        model.command(f"apply {words} range group 'node {node}'")
    model.command(_solve(parameters))


def _covered(model: Model, node: int, motion: list[float | None]) -> float:
    """The part of a motion that is done; that of all blocks is the same."""
    row = model.blocks["group"].index(f"node {node}")
    turn = model.view("blocks", "orientation")[row]
    sine = float(np.linalg.norm(turn[1:]))
    angles = turn[1:] * (2 * math.atan2(sine, turn[0]) / sine if sine > 0 else 2)
    done = [*model.blocks["displacement"][row], *angles]
    axis = max((k for k, value in enumerate(motion) if value), key=lambda k: (k < 3, abs(motion[k] or 0)))
    return float(done[axis]) / (motion[axis] or 1.0)


def _matrix(quaternion: Vector, before: Vector, after: Vector) -> list[list[float]]:
    """Of the motion that turns a block about its centroid and moves that from `before` to `after`."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, after - turn @ before
    return [[float(value) for value in row] for row in matrix]


def _results(model: Model, assembly: Assembly, firsts: dict[int, int], start: Vector) -> Results:
    """`firsts` is the node of the first row of each block."""
    results = Results()
    place, displacement, orientation = model.blocks["position"], model.blocks["displacement"], model.view("blocks", "orientation")[:]
    numbers = model.blocks["id"]
    node_of = {int(numbers[row]): node for row, node in firsts.items()}
    supports = model.reactions()["groups"]
    for row, node in firsts.items():
        attributes: dict[str, Any] = {"displacement": displacement[row].tolist(),
                                      "transformation": _matrix(orientation[row], start[row], place[row])}
        if (support := supports.get(f"node {node}")) is not None:
            attributes["reaction"] = support["force"].tolist()
        results.nodes[node] = attributes
    for one in model.interfaces():
        edge = node_of[one["block1"]], node_of[one["block2"]]
        results.edges[edge] = {
            "face_contact": bool(one["polygons"]), "resultant_global": one["force"].tolist(), "force_point": one["point"].tolist(),
            "force_magnitude": float(np.linalg.norm(one["force"])), "normal": one["normal"].tolist(), "normal_force": one["normal_force"],
            "shear_force": one["shear_force"], "utilisation": one["utilisation"], "area": one["area"],
            "contact_polygon": one["polygons"][0].tolist() if one["polygons"] else None,
            "contact_polygons": [polygon.tolist() for polygon in one["polygons"]]}
    results.metadata = {"solver": "kaya", "cycles": model.cycle_number, "ratio": model.average_ratio, "hash": model.hash,
                        "weight": model.reactions()["weight"].tolist(), "warnings": model.warnings}
    return results


def _refuse_pieces(assembly: Assembly, groups: list[str]) -> None:
    """Loads and motions of a concave block would act on each of its convex pieces."""
    driven = {load[0] for load in assembly.loads} | {node for node, motion in assembly.motions.items() if any(motion)}
    for node in sorted(driven):
        if groups.count(f"node {node}") > 1:
            raise ValueError(f"block {node} is concave: a load or a displacement of it is not supported; divide it into convex blocks")


def solve(problem: Any, solver: Kaya | None = None, model: Model | None = None) -> Results:
    """Solves a Problem of compas_dem, or that of a JSON file, and writes the results into the graph of its model, if it has one.

    `model` is the empty model of kaya that is used. Raises ValueError for what the problem lacks, kaya.Error for what kaya refuses.
    """
    solver, engine = solver or Kaya(), model or Model()
    assembly = assembly_of(problem)
    head, _, run = deck_of(assembly, solver).rpartition("solve ")
    engine.command(head)
    firsts: dict[int, int] = {}
    for row, group in enumerate(engine.blocks["group"]):  # a concave block is several convex ones, joined
        node = int(group.removeprefix("node "))
        if node not in firsts.values():
            firsts[row] = node
    _refuse_pieces(assembly, engine.blocks["group"])
    start = engine.blocks["position"].copy()
    engine.command("solve " + run)
    _displace(engine, assembly, solver.parameters)
    results = _results(engine, assembly, firsts, start)
    graph = _get(_get(problem, "model"), "graph") if not isinstance(problem, (str, os.PathLike, dict)) else None
    if hasattr(graph, "edge_attribute"):
        results.write_into(graph)
    return results


def register() -> None:
    """Lets Problem.solve(Kaya()) of compas_dem call kaya; Solver.Kaya() makes the solver."""
    try:
        from compas_dem.problem import Problem, Solver
    except ImportError as missing:
        raise ImportError("compas_dem is not installed, so there is no Problem to register with; kaya.compas.solve reads its JSON files "
                          "without it") from missing
    others = Problem.solve

    def of_any(problem: Any, solver: Any, *words: Any, **options: Any) -> Any:
        return solve(problem, solver) if isinstance(solver, Kaya) else others(problem, solver, *words, **options)

    Problem.solve = of_any
    Solver.Kaya = staticmethod(Kaya)
