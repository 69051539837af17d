"""Records the contacts of a physics engine as a trace for contactscope, draws and checks them.

Python 3.8 or later, standard library only; copy this file next to the program. The bytes are those that
contactscope.h writes for the same calls with `doubles` set.

    from contactscope import Point, Recorder

    with Recorder("run.jsonl", "mine/stack", "my engine", "1.0") as recorder:
        floor = recorder.plane("floor", (0, 1, 0), 0)
        crate = recorder.box("crate", 0.5, 0.5, 0.5)
        while running:
            with recorder.frame(time):
                recorder.pose(crate, position, quaternion_wxyz)  # every shape in this frame
                recorder.manifold(floor, crate, normal, [Point(position, separation)])

`contactscope render run.jsonl` draws the trace, `contactscope lint run.jsonl` checks it; here

    render("run.jsonl", frame=12)                                   # a picture, shown in notebooks
    lint("run.jsonl")                                               # wrong claims, as objects
    assert_manifold("run.jsonl", "stack/frame_12", frame=12)        # in a test: compares with a stored snapshot

These three call the program, which is $CONTACTSCOPE, or else `contactscope` on the PATH.

The calls of Recorder are written for some engines, in one line for each step: record_mujoco, record_pybullet,
record_newton; record_arrays for others that keep contacts in arrays; add_trimesh for shapes. None of them imports
an engine: they read the attributes of the objects that they get.

Conventions: metres, world space. Quaternions are unit, in the order w, x, y, z. Normals are unit and point
from a to b. A negative separation is an overlap. Impulses are newton seconds and act on b, unless the
recorder is told otherwise. A vector is anything with three numbers: a tuple, a list, a NumPy array.

Each frame is written when it ends, so a crash loses no earlier frame. Wrong arguments raise ValueError or
TypeError before anything is recorded of them.

MIT License; the text is in contactscope.h.
"""

import bisect
import html
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Union

Vector = Sequence[float]

_POWERS = [float(f"1e{exponent}") for exponent in range(-10, 10)]
_ORIGIN, _UNTURNED = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)
_BOX_FACES = "[[0,4,6,2],[1,3,7,5],[0,1,5,4],[2,6,7,3],[0,2,3,1],[4,5,7,6]]"


@dataclass
class Point:
    """A contact point.

    on_a, on_b: the points on the two surfaces, both or none, metres.
    impulse: along the normal, over the step; friction: a vector perpendicular to the normal.
    id: identifies the point across frames, 0 to 2^64 - 1.
    idle: a speculative point that the solver did not act on.
    """

    position: Vector
    separation: float
    on_a: Optional[Vector] = None
    on_b: Optional[Vector] = None
    impulse: Optional[float] = None
    friction: Vector = _ORIGIN
    id: Optional[int] = None
    idle: bool = False


@dataclass
class Manifold:
    """Points with one normal, unit, from a to b. `triangle`: its index in the mesh, or -1."""

    normal: Vector
    points: Sequence[Point]
    triangle: int = -1


class Recorder:
    """A trace file. `scenario` is GROUP/IDEA, the folder of its pictures.

    doubles: the engine computes in double (17 digits), else in float (9 digits).
    z_up: z points up, else y.
    poses_at: time of the poses: "contacts", or "before_step" or "after_step" of their step.
    force_step: above 0, impulses are forces in newtons over a step of this many seconds.
    friction_on_a: friction acts on a, not on b.

    Raises OSError if the file cannot be written.
    """

    def __init__(self, path, scenario: str, engine: Optional[str] = None, version: Optional[str] = None, *,
                 doubles: bool = True, z_up: bool = False, poses_at: str = "contacts",
                 force_step: float = 0, friction_on_a: bool = False):
        if poses_at not in ("contacts", "before_step", "after_step"):
            raise ValueError(f"poses_at is {poses_at!r}; write 'contacts', 'before_step' or 'after_step'")
        self._digits = 17 if doubles else 9
        self._z_up, self._poses_at = z_up, poses_at
        self._scenario, self._engine, self._version = scenario, engine, version
        self._force_step, self._friction_on_a = force_step, friction_on_a
        self._has_head = False    # in the file
        self._names: list = []    # by shape, as JSON
        self._shapes: list = []   # by shape: its entry without the closing brace; None for compounds, and once written
        self._margins: dict = {}  # metres, by shape
        self._parts: dict = {}    # by shape: compound, position, rotation
        self._compounds: set = set()
        self._notes: set = set()
        self._number = 0
        self._time: Optional[float] = None  # of the frame that has begun
        self._world: Any = None   # what an adapter knows of its engine
        self.path = os.fspath(path)
        self._file = open(path, "wb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        """Ends the frame that has begun, and closes the file."""
        if self._file.closed:
            return
        if self._time is not None:
            self.end_frame()
        self._write_head()
        self._file.close()

    # Shapes, in local coordinates; add them at any time. Each returns the number of the shape. Duplicate names get
    # a numeric suffix, and None a name.

    def box(self, name: Optional[str], half_x: float, half_y: float, half_z: float) -> int:
        half = _numbers((half_x, half_y, half_z), 3, "half extents")
        corners = [[h if i >> k & 1 else -h for k, h in enumerate(half)] for i in range(8)]
        return self._solid(name, "box", corners, f',"faces":{_BOX_FACES}')

    def sphere(self, name: Optional[str], radius: float) -> int:
        return self._solid(name, "sphere", [_ORIGIN], ',"faces":[],"radius":%.17g' % radius)

    def capsule(self, name: Optional[str], start: Vector, end: Vector, radius: float) -> int:
        return self._solid(name, "capsule", [start, end], ',"faces":[],"radius":%.17g' % radius)

    def hull(self, name: Optional[str], vertices: Iterable[Vector]) -> int:
        """Readers compute the faces of the convex hull."""
        return self._solid(name, "hull", vertices)

    def cylinder(self, name: Optional[str], axis: int, half_length: float, radius: float) -> int:
        """Centred on the origin, along axis 0, 1 or 2 (x, y, z). Written as a hull with 64 sides and its corners
        on the round surface; the error is up to 0.12 % of the radius."""
        return self._turned(name, "cylinder", axis, half_length, radius, radius)

    def cone(self, name: Optional[str], axis: int, half_length: float, radius: float) -> int:
        """The same with its tip at +half_length."""
        return self._turned(name, "cone", axis, half_length, radius, 0)

    def mesh(self, name: Optional[str], vertices: Iterable[Vector], triangles: Iterable[Sequence[int]]) -> int:
        """Three indices per triangle, counter-clockwise seen from outside."""
        corners = list(vertices)
        faces = [[int(i) for i in triangle] for triangle in triangles]
        for triangle in faces:
            if len(triangle) != 3 or not all(0 <= i < len(corners) for i in triangle):
                raise ValueError(f"triangle {triangle} of mesh {name!r} is not three indices of its {len(corners)} vertices")
        text = ",".join("[" + ",".join(map(str, triangle)) + "]" for triangle in faces)
        return self._solid(name, "mesh", corners, f',"faces":[{text}]')

    def plane(self, name: Optional[str], normal: Vector, offset: float) -> int:
        """Solid where normal . x <= offset."""
        return self._solid(name, "plane", [], ',"faces":[],"half_space":{"normal":%s,"offset":%s}'
                           % (self._list(_numbers(normal, 3, "normal")), self._text(offset)))

    def height_field(self, name: Optional[str], rows: Iterable[Vector], spacing: float) -> int:
        """Rows of heights; the first height is at the origin, neighbours are `spacing` metres from each other.
        Columns run along +x, rows along -z if y is up and along +y if z is up."""
        heights = [[float(h) for h in row] for row in rows]
        columns = len(heights[0]) if heights else 0
        if len(heights) < 2 or columns < 2 or any(len(row) != columns for row in heights):
            raise ValueError(f"height field {name!r} needs two or more rows of the same length, two or more")
        vertices, triangles = [], []
        for y, row in enumerate(heights):
            for x, height in enumerate(row):
                vertices.append((x * spacing, y * spacing, height) if self._z_up
                                else (x * spacing, height, -y * spacing))
                if y + 1 < len(heights) and x + 1 < columns:
                    i = y * columns + x
                    triangles += [(i, i + 1, i + columns + 1), (i, i + columns + 1, i + columns)]
        return self.mesh(name, vertices, triangles)

    def margin(self, shape: int, margin: float):
        """For engines that add a margin to convex shapes: moves the surface of a hull, cylinder or cone outwards
        and rounds its edges. Call it before the first frame with the shape."""
        self._margins[self._known(shape)] = float(margin)

    def compound(self, name: Optional[str]) -> int:
        """A body made of shapes at fixed poses. Call pose() for the compound, not for its parts."""
        number = self._add(name, None)
        self._compounds.add(number)
        return number

    def part(self, compound: int, shape: int, position: Vector, quat_wxyz: Vector):
        if compound == shape:
            raise ValueError("a compound cannot be a part of itself")
        self._parts[self._known(shape)] = (self._known(compound), _numbers(position, 3, "position"),
                                           _numbers(quat_wxyz, 4, "quaternion"))

    def note(self, text: str):
        """Prints to the standard error what is not recorded, and why; repeated texts once."""
        if text not in self._notes:
            self._notes.add(text)
            print(f"contactscope: {text}", file=sys.stderr)

    # Frames

    @contextmanager
    def frame(self, time: float):
        """begin_frame() and end_frame() around a block; what was recorded before an exception is kept."""
        self.begin_frame(time)
        try:
            yield self
        finally:
            self.end_frame()

    def begin_frame(self, time: float):
        time = float(time)
        if self._time is not None:
            self.end_frame()
        self._write_head()
        self._time = time
        self._poses: dict = {}
        self._manifolds: list = []
        self._bodies: list = []
        self._solver: Optional[Tuple[int, int, bool]] = None

    def pose(self, shape: int, position: Vector, quat_wxyz: Vector = _UNTURNED):
        """A shape without a pose is absent from this frame."""
        self._begun()
        self._poses[self._known(shape)] = (_numbers(position, 3, "position"), _numbers(quat_wxyz, 4, "quaternion"))

    def manifold(self, a: int, b: int, normal: Vector, points: Iterable[Point], triangle: int = -1):
        """`triangle`: its index in the mesh, or -1. A pair may have several manifolds. If b was created before a,
        the pair is written swapped, with its normal, friction and sides."""
        self._begun()
        first, second = self._known(a), self._known(b)
        if first == second:
            raise ValueError("a manifold is of two shapes")
        swapped = first > second
        kept = [_Checked(point, swapped) for point in points]
        if not kept:
            return
        place, direction = kept[0].position, _numbers(normal, 3, "normal")
        if swapped:
            first, second, direction = second, first, _negated(direction)
        self._manifolds.append((first, second, int(triangle), place, direction, kept))

    def body(self, shape: int, mass: float, center_of_mass: Vector, velocity: Vector, angular_velocity: Vector):
        self._begun()
        numbers = [_numbers(vector, 3, key) for key, vector in (
            ("center_of_mass", center_of_mass), ("velocity", velocity), ("angular_velocity", angular_velocity))]
        self._bodies.append((self._known(shape), float(mass), numbers))

    def solver(self, iterations: int, substeps: int = 0, warm_start: bool = False):
        """Solver settings of this step, for frames with bodies; 0 for those the engine does not have."""
        self._begun()
        self._solver = (int(iterations), int(substeps), bool(warm_start))

    def end_frame(self):
        self._begun()
        poses = dict(self._poses)
        for shape, (compound, position, rotation) in sorted(self._parts.items()):
            if compound in poses:
                poses[shape] = _composed(poses[compound], position, rotation)
        text = ",".join(f'{self._names[shape]}:{{"position":{self._list(place)},"quat_wxyz":{self._list(turn)}}}'
                        for shape, (place, turn) in sorted(poses.items()) if shape not in self._compounds)
        line = f'{{"frame":{self._number},"time":{self._text(self._time)}{self._new_shapes()},"poses":{{{text}}}'
        self._write(line + self._pairs() + self._solved())
        self._time = None
        self._number += 1

    # Text of the file

    def _text(self, value) -> str:
        return _number(float(value), self._digits)

    def _list(self, values: Iterable[float]) -> str:
        return "[" + ",".join(map(self._text, values)) + "]"

    def _write(self, line: str):
        self._file.write((line + "}\n").encode())
        self._file.flush()

    def _write_head(self):
        if self._has_head:
            return
        self._has_head = True
        head = ['{"schema":"contactscope.trace/1","scenario":', _quoted(self._scenario),
                ',"scalar":"double"' if self._digits == 17 else ',"scalar":"float"',
                ',"up":"z"' if self._z_up else ',"up":"y"']
        for key, value in (("engine", self._engine), ("version", self._version)):
            if value is not None:
                head += [f',"{key}":', _quoted(value)]
        if self._poses_at != "contacts":
            head.append(f',"poses_at":"{self._poses_at}"')
        step = self._force_step
        if step > 0 or self._friction_on_a:
            head.append(',"impulses":{"unit":"%s","on":"%s"' % ("N" if step > 0 else "N s",
                                                                "a" if self._friction_on_a else "b"))
            head.append(',"step":%.17g}' % step if step > 0 else "}")
        self._write("".join(head) + self._new_shapes())

    def _adopt(self, world: Any, engine: str, version: Optional[str], z_up: bool, poses_at: str):
        """The header's facts that an adapter knows; called before the first frame."""
        if self._has_head or self._world is not None:
            raise ValueError(f"this trace has frames of something else than {engine}; use one recorder for each world")
        self._engine, self._version = self._engine or engine, self._version or version
        self._z_up, self._poses_at = z_up, poses_at
        self._world = world

    def _begun(self):
        if self._time is None:
            raise ValueError("no frame has begun; call begin_frame(time) first, or use `with recorder.frame(time):`")

    def _known(self, shape) -> int:
        if not 0 <= shape < len(self._names):
            raise ValueError(f"there is no shape {shape}; pass the number that box(), hull() ... returned")
        return int(shape)

    def _add(self, name: Optional[str], entry: Optional[str]) -> int:
        base = "shape" if name is None else str(name)
        number, quoted = 1, _quoted(base)
        while quoted in self._names:
            number += 1
            quoted = _quoted(f"{base} {number}")
        self._names.append(quoted)
        self._shapes.append(entry)
        return len(self._names) - 1

    def _solid(self, name: Optional[str], kind: str, vertices: Iterable[Vector], rest: str = "") -> int:
        corners = ",".join(self._list(_numbers(vertex, 3, "vertex")) for vertex in vertices)
        return self._add(name, f'{{"type":"{kind}","vertices":[{corners}]{rest}')

    def _turned(self, name: Optional[str], kind: str, axis: int, half_length: float, radius: float, top: float) -> int:
        if axis not in (0, 1, 2):
            raise ValueError(f"axis {axis} is not 0, 1 or 2")
        corners = 64
        cosine, sine = 0.99518472667219688624, 0.09801714032956060199  # of 1/64 turn
        rings: list = [[], []]
        x, y = 1.0, 0.0
        for _ in range(corners):
            for k, around in enumerate((radius, top)):
                corner = [0.0, 0.0, 0.0]
                corner[axis] = half_length if k else -half_length
                corner[(axis + 1) % 3], corner[(axis + 2) % 3] = around * x, around * y
                rings[k].append(corner)
            x, y = cosine * x - sine * y, sine * x + cosine * y
        tip = [half_length if k == axis else 0.0 for k in range(3)]
        return self._solid(name, kind, rings[0] + (rings[1] if top > 0 else [tip]))

    def _new_shapes(self) -> str:
        """Shapes that are not in the file yet."""
        entries = []
        for shape, entry in enumerate(self._shapes):
            if entry is None:
                continue
            margin = self._margins.get(shape, 0)
            if margin > 0:
                entry += f',"margin":{self._text(margin)}'
            if shape in self._parts:
                entry += f',"body":{self._names[self._parts[shape][0]]}'
            entries.append(f"{self._names[shape]}:{entry}}}")
            self._shapes[shape] = None
        return ',"shapes":{' + ",".join(entries) + "}"

    def _pairs(self) -> str:
        pairs: dict = {}
        for a, b, triangle, _, normal, points in sorted(self._manifolds, key=lambda one: one[:5]):
            text = f'{{"normal":{self._list(normal)}'
            if triangle >= 0:
                text += f',"triangle":{triangle}'
            text += ',"points":[' + ",".join(map(self._point, points)) + "]}"
            pairs.setdefault((a, b), []).append(text)
        return ',"pairs":[' + ",".join(
            f'{{"a":{self._names[a]},"b":{self._names[b]},"manifolds":[{",".join(texts)}]}}'
            for (a, b), texts in pairs.items()) + "]"

    def _point(self, point: "_Checked") -> str:
        text = f'{{"position":{self._list(point.position)},"separation":{self._text(point.separation)}'
        if point.id is not None:
            text += f',"id":"{point.id}"'
        if point.impulse is not None:
            text += f',"impulse":{{"normal":{self._text(point.impulse)},"friction":{self._list(point.friction)}}}'
        if point.sides is not None:
            text += ',"on_a":%s,"on_b":%s' % tuple(map(self._list, point.sides))
        return text + (',"active":false}' if point.idle else "}")

    def _solved(self) -> str:
        if self._solver is None and not self._bodies:
            return ""
        iterations, substeps, warm_start = self._solver or (0, 0, False)
        bodies = ",".join(
            f'{self._names[shape]}:{{"mass":{self._text(mass)}' + "".join(
                f',"{key}":{self._list(vector)}'
                for key, vector in zip(("center_of_mass", "velocity", "angular_velocity"), numbers)) + "}"
            for shape, mass, numbers in sorted(self._bodies, key=lambda body: body[0]))
        warm = ',"warm_start":true' if warm_start else ""
        return f',"solver":{{"iterations":{iterations},"substeps":{substeps}{warm},"bodies":{{{bodies}}}}}'


class _Checked:
    """A point as it is written: numbers are floats, sides and friction are swapped with the pair."""

    def __init__(self, point: Point, swapped: bool):
        self.position = _numbers(point.position, 3, "position")
        self.separation = float(point.separation)
        if (point.on_a is None) != (point.on_b is None):
            raise ValueError("a point has on_a and on_b, or none of them")
        self.sides = None
        if point.on_a is not None and point.on_b is not None:
            sides = [_numbers(point.on_a, 3, "on_a"), _numbers(point.on_b, 3, "on_b")]
            self.sides = sides[::-1] if swapped else sides
        self.impulse = None if point.impulse is None else float(point.impulse)
        friction = _numbers(point.friction, 3, "friction")
        self.friction = _negated(friction) if swapped else friction
        self.id = None if point.id is None else int(point.id)
        if self.id is not None and not 0 <= self.id < 1 << 64:
            raise ValueError(f"id {self.id} is not within 0 to 2^64 - 1")
        self.idle = bool(point.idle)


def _numbers(values: Vector, count: int, what: str) -> tuple:
    numbers = tuple(float(value) for value in values)
    if len(numbers) != count:
        raise ValueError(f"{what} has {len(numbers)} numbers, not {count}")
    return numbers


def _negated(vector: Vector) -> tuple:
    return tuple(-value for value in vector)


def _quoted(text: str) -> str:
    """A JSON string; lone surrogates become question marks."""
    out = []
    for c in text.encode("utf-8", "replace").decode():
        out.append("\\u%04x" % ord(c) if c < " " else "\\" + c if c in '"\\' else c)
    return '"' + "".join(out) + '"'


def _number(value: float, count: int) -> str:
    """`value` with `count` significant digits, halves rounded away from zero; null if it is not finite."""
    if not math.isfinite(value):
        return "null"  # JSON has no nan or infinity; readers report where it is
    if value == 0:
        return "0"
    sign, size = "-" if value < 0 else "", abs(value)
    if not 1e-10 <= size < 1e9:
        return sign + "%.*g" % (count, size)
    before = bisect.bisect_right(_POWERS, size) - 10  # digits before the point; 0 or less: zeros after it
    numerator, denominator = size.as_integer_ratio()
    whole = (2 * numerator * 10 ** (count - before) + denominator) // (2 * denominator)
    digits = str(whole)
    if len(digits) > count:  # rounding reached the next power of ten
        before += 1
    fraction = digits[max(before, 0):].rstrip("0")
    if before <= 0:
        return sign + "0." + "0" * -before + fraction
    return sign + digits[:before] + ("." + fraction if fraction else "")


def _composed(whole, position: Vector, rotation: Vector):
    """World pose of a part of a compound. The order of the operations is that of contactscope.h."""
    place, p = whole
    t = [2 * (p[1 + (k + 1) % 3] * position[(k + 2) % 3] - p[1 + (k + 2) % 3] * position[(k + 1) % 3]) for k in range(3)]
    moved = tuple(position[k] + p[0] * t[k] + p[1 + (k + 1) % 3] * t[(k + 2) % 3] - p[1 + (k + 2) % 3] * t[(k + 1) % 3]
                  + place[k] for k in range(3))
    q = rotation
    return moved, (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
                   p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
                   p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
                   p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


# Adapters. They read attributes, so the engine's module is not needed, and arrays may be of NumPy, Warp or PyTorch.
# src/adapters/README.md explains the conversions, which are those of the C++ headers.

def add_trimesh(recorder: Recorder, name: Optional[str], mesh: Any, hull: bool = False) -> int:
    """Adds a trimesh.Trimesh, or another object with `vertices` (n x 3, metres) and `faces`, `triangles` or `indices`
    (m x 3 or 3 m numbers, counter-clockwise seen from outside). Returns the number of the shape.

    hull: the engine collides it as its convex hull.
    """
    vertices = _rows(mesh.vertices, 3)
    if hull:
        return recorder.hull(name, vertices)
    for key in ("faces", "triangles", "indices"):
        if getattr(mesh, key, None) is not None:
            return recorder.mesh(name, vertices, _rows(getattr(mesh, key), 3))
    raise TypeError(f"{type(mesh).__name__} {name!r} has vertices, but neither faces, triangles nor indices; "
                    "pass hull=True if it is convex")


def record_mujoco(recorder: Recorder, model: Any, data: Any, integrated: bool = True):
    """Records the last mj_step as a frame, contact forces included:

        with Recorder("run.jsonl", "mine/stack") as recorder:
            ...
            mujoco.mj_step(model, data)
            record_mujoco(recorder, model, data)

    model, data: mujoco.MjModel and mujoco.MjData, 2.2 or later, or wrappers with their attributes.
    integrated: False after mj_forward. Do not call it after mj_step1, which solves nothing.

    The first call adds the geoms that collide, and sets the recorder's engine, up axis and time of poses. Poses are
    those of the contacts: mj_step computes both before it integrates, and keeps them in mjData. Raises ValueError if
    the recorder has frames of something else.
    """
    _between_frames(recorder)
    if type(recorder._world) is not _MujocoWorld:
        _MujocoWorld(recorder, model)
    world = recorder._world
    if model.ngeom != len(world.shapes):
        raise ValueError("the model is not that of the frames before; use one recorder for each model")
    world.record(model, data, integrated)


class _MujocoWorld:
    """Shapes by geom and by body; None: not recorded."""

    PLANE, FIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = range(8)
    WITHOUT_WARM_START = 1 << 8  # mjDSBL_WARMSTART

    def __init__(self, recorder: Recorder, model: Any):
        gravity = _list_of(model.opt.gravity)
        recorder._adopt(self, "MuJoCo", getattr(sys.modules.get("mujoco"), "__version__", None),
                        abs(gravity[1]) <= abs(gravity[2]), "before_step")
        self.recorder = recorder
        self.types = _list_of(model.geom_type)
        self.shapes: List[Optional[int]] = []
        self.bodies: List[Optional[int]] = [None] * model.nbody
        collides = [bool(a or b) for a, b in zip(_list_of(model.geom_contype), _list_of(model.geom_conaffinity))]
        if model.npair > 0:
            for geom in _list_of(model.pair_geom1) + _list_of(model.pair_geom2):
                collides[geom] = True
        owners = _list_of(model.geom_bodyid)
        parts = [0] * model.nbody
        for body, is_solid in zip(owners, collides):
            parts[body] += is_solid
        for geom, body in enumerate(owners):
            is_whole = body > 0 and parts[body] == 1
            name = self.name(model, model.name_geomadr[geom])
            if not name and is_whole:  # the only geom of a body takes the body's name if it has none
                name = self.name(model, model.name_bodyadr[body]) or f"body {body}"
            shape = self.add(model, geom, name or f"geom {geom}") if collides[geom] else None
            self.shapes.append(shape)
            if shape is None or body == 0:
                continue
            if is_whole:
                self.bodies[body] = shape
                continue
            if self.bodies[body] is None:
                self.bodies[body] = recorder.compound(self.name(model, model.name_bodyadr[body]) or f"body {body}")
            recorder.part(self.bodies[body], shape, _ORIGIN, _UNTURNED)  # geoms have their own poses

    @staticmethod
    def name(model: Any, address: int) -> str:
        return bytes(model.names[address:model.names.index(b"\0", address)]).decode("utf-8", "replace")

    def add(self, model: Any, geom: int, name: str) -> Optional[int]:
        kind, size, recorder = self.types[geom], _list_of(model.geom_size[geom]), self.recorder
        if kind == self.PLANE:
            return recorder.plane(name, (0, 0, 1), 0)
        if kind == self.SPHERE:
            return recorder.sphere(name, size[0])
        if kind == self.CAPSULE:
            return recorder.capsule(name, (0, 0, -size[1]), (0, 0, size[1]), size[0])
        if kind == self.CYLINDER:
            return recorder.cylinder(name, 2, size[1], size[0])
        if kind == self.BOX:
            return recorder.box(name, *size)
        if kind == self.ELLIPSOID:
            recorder.note("MuJoCo: an ellipsoid is recorded as the hull of 1000 of its points")
            return recorder.hull(name, _ellipsoid(size))
        if kind == self.MESH:
            return recorder.hull(name, self.hull(model, int(model.geom_dataid[geom])))
        if kind == self.FIELD:
            return self.height_field(model, int(model.geom_dataid[geom]), name)
        recorder.note("MuJoCo: a geom of unknown type is left out")
        return None

    @staticmethod
    def hull(model: Any, mesh: int) -> List[List[float]]:
        """MuJoCo collides meshes as convex hulls. The mesh's graph lists the vertices of its hull: counts of vertices
        and faces, an address per vertex, a mesh index per vertex."""
        first, graph = int(model.mesh_vertadr[mesh]), int(model.mesh_graphadr[mesh])
        chosen: Iterable[int] = range(int(model.mesh_vertnum[mesh]))
        if graph >= 0:
            count = int(model.mesh_graph[graph])
            chosen = [int(model.mesh_graph[graph + 2 + count + i]) for i in range(count)]
        return [_list_of(model.mesh_vert[first + i]) for i in chosen]

    def height_field(self, model: Any, field: int, name: str) -> int:
        """The upper surface. The diagonal of each cell goes from its least x and y to its greatest."""
        rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
        size, first = _list_of(model.hfield_size[field]), int(model.hfield_adr[field])
        heights = [float(model.hfield_data[first + i]) for i in range(rows * columns)]
        vertices, triangles = [], []
        for row in range(rows):
            for column in range(columns):
                i = row * columns + column
                vertices.append((size[0] * (2.0 * column / (columns - 1) - 1), size[1] * (2.0 * row / (rows - 1) - 1),
                                 size[2] * heights[i]))
                if row + 1 < rows and column + 1 < columns:
                    triangles += [(i, i + 1, i + columns + 1), (i, i + columns + 1, i + columns)]
        return self.recorder.mesh(name, vertices, triangles)

    def record(self, model: Any, data: Any, integrated: bool):
        recorder, step = self.recorder, float(model.opt.timestep)
        recorder.begin_frame(float(data.time) - (step if integrated else 0))
        recorder.solver(model.opt.iterations, 1, not int(model.opt.disableflags) & self.WITHOUT_WARM_START)
        places, turns = _rows(data.geom_xpos, 3), _rows(data.geom_xmat, 9)
        for geom, shape in enumerate(self.shapes):
            if shape is not None:
                recorder.pose(shape, places[geom], _quaternion(turns[geom]))
        self.record_bodies(model, data)
        forces = _list_of(data.efc_force)
        found: Dict[tuple, List[Point]] = {}  # by shapes and normal
        for i in range(data.ncon):
            contact = data.contact[i]
            a, b = contact.geom if hasattr(contact, "geom") else (contact.geom1, contact.geom2)  # 2.x has two fields
            if a < 0 or b < 0 or self.shapes[a] is None or self.shapes[b] is None:
                continue
            frame = _list_of(contact.frame)  # its first axis is the normal, from geom 1 to geom 2
            key = (self.shapes[a], self.shapes[b], tuple(frame[:3]))
            found.setdefault(key, []).append(self.point(model, contact, frame, forces, self.is_halfway(a, b), step))
        for (a, b, normal), points in sorted(found.items(), key=lambda one: one[0]):
            recorder.manifold(a, b, normal, points)
        recorder.end_frame()

    def record_bodies(self, model: Any, data: Any):
        """Velocities of centres of mass. Those in mjData are at the centre of mass of the whole tree."""
        centers, velocities, trees = _rows(data.xipos, 3), _rows(data.cvel, 6), _rows(data.subtree_com, 3)
        for body, shape in enumerate(self.bodies):
            if shape is None or model.body_weldid[body] == 0:
                continue
            spin, linear = velocities[body][:3], velocities[body][3:]
            tree = trees[int(model.body_rootid[body])]
            arm = [x - y for x, y in zip(centers[body], tree)]
            turned = (arm[1] * spin[2] - arm[2] * spin[1], arm[2] * spin[0] - arm[0] * spin[2],
                      arm[0] * spin[1] - arm[1] * spin[0])
            self.recorder.body(shape, model.body_mass[body], centers[body],
                               [v - t for v, t in zip(linear, turned)], spin)

    def is_halfway(self, one: int, other: int) -> bool:
        """MuJoCo documents every point as halfway between the surfaces. Only its analytic cases are: points of two
        boxes and of libccd are anywhere in the overlap."""
        first, second = self.types[one], self.types[other]
        round_ones = (self.SPHERE, self.CAPSULE)
        return first == self.PLANE or (first in round_ones and second in round_ones + (self.BOX,))

    @staticmethod
    def point(model: Any, contact: Any, frame: List[float], forces: List[float], is_halfway: bool,
              step: float) -> Point:
        place, separation, address = _list_of(contact.pos), float(contact.dist), int(contact.efc_address)
        point = Point(place, separation, idle=address < 0)
        if is_halfway:
            half = [frame[k] * separation / 2 for k in range(3)]
            point.on_a = [place[k] - half[k] for k in range(3)]
            point.on_b = [place[k] + half[k] for k in range(3)]
        if address >= 0:
            # As mj_contactForce: newtons on geom 2, along the contact's axes. A pyramid's edges come in pairs.
            size = int(contact.dim)
            if size > 1 and int(model.opt.cone) == 0:
                edges, across = forces[address:address + 2 * (size - 1)], _list_of(contact.friction)
                force = [0.0]
                for edge in edges:
                    force[0] += edge
                force += [(edges[2 * i] - edges[2 * i + 1]) * across[i] for i in range(size - 1)]
            else:
                force = forces[address:address + size]
            force += [0.0] * (3 - len(force))
            point.impulse = (force[0] - float(getattr(contact, "adhesion", 0))) * step  # adhesion: 3.9 and later
            point.friction = [step * (force[1] * frame[3 + k] + force[2] * frame[6 + k]) for k in range(3)]
        return point


def record_pybullet(recorder: Recorder, client: Any, step: Optional[Callable[[], Any]] = None):
    """Steps the simulation, and records the step as a frame. Call it in place of stepSimulation():

        with Recorder("run.jsonl", "mine/stack") as recorder:
            for _ in range(240):
                record_pybullet(recorder, pybullet)

    client: the module pybullet, or a BulletClient.
    step: what makes one step of the engine, if it is not client.stepSimulation.

    Poses are from before the step, as contacts are: Bullet detects, solves and integrates in this order. PyBullet's
    normals point from b to a and its forces act on a; both are negated, and forces become impulses. It does not say
    where a plane is (its shape's origin is assumed), which shape of several in a link a point belongs to (the nearest
    is taken), or what a mesh's triangles are (the convex hull is recorded, a concave mesh is left out with a note).
    Raises ValueError if the recorder has frames of something else.
    """
    _between_frames(recorder)
    if type(recorder._world) is not _BulletWorld:
        _BulletWorld(recorder, client)
    recorder._world.record(client, client.stepSimulation if step is None else step)


@dataclass
class _Leaf:
    """A shape of a link, in the frame of the link's centre of mass, which is that of PyBullet's poses."""

    shape: int
    kind: int
    size: List[float]
    position: Vector
    turn: Vector

    def distance(self, place: Tuple[Vector, Vector], point: Vector) -> float:
        """About how far a point (world) is from the surface, metres."""
        position, turn = _composed(place, self.position, self.turn)
        x, y, z = _turned_back(turn, [p - q for p, q in zip(point, position)])
        if self.kind == _BulletWorld.PLANE:
            return abs(self.size[0] * x + self.size[1] * y + self.size[2] * z)
        if self.kind == _BulletWorld.SPHERE:
            return abs(math.hypot(x, y, z) - self.size[0])
        if self.kind == _BulletWorld.CAPSULE:
            return abs(math.hypot(x, y, max(abs(z) - self.size[0] / 2, 0)) - self.size[1])
        if self.kind == _BulletWorld.CYLINDER:
            sides = [math.hypot(x, y) - self.size[1], abs(z) - self.size[0] / 2]
        else:
            sides = [abs(p) - s / 2 for p, s in zip((x, y, z), self.size)]
        return abs(max(sides)) if max(sides) <= 0 else math.hypot(*(max(side, 0) for side in sides))


class _BulletWorld:
    SPHERE, BOX, CYLINDER, MESH, PLANE, CAPSULE = range(2, 8)  # pybullet.GEOM_SPHERE ...
    NO_LEAF = -1

    def __init__(self, recorder: Recorder, client: Any):
        settings = client.getPhysicsEngineParameters()
        recorder._adopt(self, "Bullet", None,
                        abs(settings["gravityAccelerationZ"]) >= abs(settings["gravityAccelerationY"]), "before_step")
        self.recorder = recorder
        self.time = 0.0
        self.bodies: Dict[int, int] = {}  # by PyBullet's id: how many links
        self.links: Dict[Tuple[int, int], Tuple[Optional[int], List[_Leaf]]] = {}  # the link's shape or compound

    def record(self, client: Any, step: Callable[[], Any]):
        recorder, settings = self.recorder, client.getPhysicsEngineParameters()
        substeps, seconds = max(int(settings["numSubSteps"]), 1), float(settings["fixedTimeStep"])
        if substeps > 1:
            recorder.note("PyBullet: numSubSteps is above 1; contacts are of the last substep, poses of the first")
        bodies = [client.getBodyUniqueId(i) for i in range(client.getNumBodies())]
        for body in bodies:
            if body not in self.bodies:
                self.add(client, body)
        recorder.begin_frame(self.time)
        recorder.solver(int(settings["numSolverIterations"]), substeps)
        places: Dict[Tuple[int, int], Tuple[Vector, Vector]] = {}
        for body in bodies:
            for link in range(-1, self.bodies[body]):
                whole, leaves = self.links[body, link]
                if whole is None:
                    continue
                place = places[body, link] = self.place(client, body, link)
                for leaf in leaves:
                    recorder.pose(leaf.shape, *_composed(place, leaf.position, leaf.turn))
                mass = float(client.getDynamicsInfo(body, link)[0]) if link < 0 and not self.bodies[body] else 0
                if mass > 0:
                    velocity, spin = client.getBaseVelocity(body)
                    recorder.body(whole, mass, place[0], velocity, spin)
        step()
        self.record_contacts(client, places, seconds)
        recorder.end_frame()
        self.time += seconds

    @staticmethod
    def place(client: Any, body: int, link: int) -> Tuple[Vector, Vector]:
        """Of the centre of mass."""
        if link < 0:
            position, turn = client.getBasePositionAndOrientation(body)
        else:
            # Without this argument PyBullet returns a link's pose of the step before.
            position, turn = client.getLinkState(body, link, computeForwardKinematics=1)[:2]
        return tuple(position), (turn[3], *turn[:3])

    def add(self, client: Any, body: int):
        count = self.bodies[body] = client.getNumJoints(body)
        base, model = (_decoded(text) for text in client.getBodyInfo(body)[:2])
        for link in range(-1, count):
            name = (model or base) if link < 0 else _decoded(client.getJointInfo(body, link)[12])
            forms = self.forms(client, body, link)
            leaves = []
            for i, form in enumerate(forms):
                leaf = self.leaf(client, form, i if len(forms) > 1 else -1,
                                 (name or f"body {body}") + (f"/{i}" if len(forms) > 1 else ""))
                if leaf is not None:
                    leaves.append(leaf)
            whole = leaves[0].shape if len(leaves) == 1 else None
            if len(leaves) > 1:
                whole = self.recorder.compound(name or f"body {body}")
                for leaf in leaves:
                    self.recorder.part(whole, leaf.shape, leaf.position, leaf.turn)
            self.links[body, link] = whole, leaves
        if not any(self.links[body, link][1] for link in range(-1, count)):
            self.recorder.note(f"PyBullet: it returns no shape of body {body} ({model or base}), which is left out, as "
                               "bodies with useMaximalCoordinates are")

    @staticmethod
    def forms(client: Any, body: int, link: int) -> Any:
        try:
            return client.getCollisionShapeData(body, link)
        except Exception as error:  # pybullet.error, which cannot be named without the module
            if type(error).__name__ != "error":
                raise
            return ()

    def leaf(self, client: Any, form: Any, index: int, name: str) -> Optional[_Leaf]:
        body, link, kind, size, turn = form[0], form[1], form[2], [float(x) for x in form[3]], form[6]
        position, recorder = tuple(form[5]), self.recorder
        if kind == self.SPHERE:
            shape = recorder.sphere(name, size[0])
        elif kind == self.BOX:
            shape = recorder.box(name, *(x / 2 for x in size))
        elif kind == self.CYLINDER:
            shape = recorder.cylinder(name, 2, size[0] / 2, size[1])
        elif kind == self.CAPSULE:
            shape = recorder.capsule(name, (0, 0, -size[0] / 2), (0, 0, size[0] / 2), size[1])
        elif kind == self.PLANE:
            shape = recorder.plane(name, size, 0)
        else:
            # PyBullet returns vertices of convex hulls only, in the frame of the centre of mass.
            vertices = list(client.getMeshData(body, link, collisionShapeIndex=index)[1]) if kind == self.MESH else []
            if not vertices:
                recorder.note("PyBullet: concave meshes and height fields, whose triangles it does not return, "
                              "are left out")
                return None
            shape = recorder.hull(name, vertices)
            facts = client.getDynamicsInfo(body, link)
            if len(facts) > 11 and facts[11] > 0:
                recorder.margin(shape, facts[11])
            size = [2 * max(abs(v[k]) for v in vertices) for k in range(3)]
            return _Leaf(shape, kind, size, _ORIGIN, _UNTURNED)
        return _Leaf(shape, kind, size, position, (turn[3], *turn[:3]))

    def nearest(self, key: Tuple[int, int], places: Dict[Tuple[int, int], Tuple[Vector, Vector]], point: Vector) -> int:
        leaves = self.links[key][1] if key in places else []
        if len(leaves) <= 1:
            return leaves[0].shape if leaves else self.NO_LEAF
        return min(leaves, key=lambda leaf: leaf.distance(places[key], point)).shape

    def record_contacts(self, client: Any, places: Dict[Tuple[int, int], Tuple[Vector, Vector]], seconds: float):
        found: Dict[tuple, List[Point]] = {}
        for contact in client.getContactPoints() or ():
            _, body_a, body_b, link_a, link_b, on_a, on_b, normal, separation, force = contact[:10]
            a, b = self.nearest((body_a, link_a), places, on_a), self.nearest((body_b, link_b), places, on_b)
            if a == self.NO_LEAF or b == self.NO_LEAF or a == b:
                continue
            friction = [-seconds * (contact[10] * p + contact[12] * q) for p, q in zip(contact[11], contact[13])]
            found.setdefault((a, b, _negated(normal)), []).append(
                Point([(p + q) / 2 for p, q in zip(on_a, on_b)], separation, on_a, on_b, force * seconds, friction,
                      idle=separation > 0 and force == 0))
        for (a, b, direction), points in found.items():
            self.recorder.manifold(a, b, direction, points)


def record_newton(recorder: Recorder, model: Any, state: Any, contacts: Any, time: float, step: float = 0):
    """Records the contacts that model.collide(state) or a CollisionPipeline has written, as a frame:

        with Recorder("run.jsonl", "mine/stack") as recorder:
            ...
            model.collide(state, contacts)
            record_newton(recorder, model, state, contacts, time)

    model, state, contacts: newton.Model, State and Contacts of one world, with Newton 1.0's attributes.
    time: seconds. step: seconds; above 0, contacts.force is recorded as impulses where it is requested.

    Shapes that do not collide, height fields and splats are left out. A margin of a shape moves its surface outwards.
    Raises ValueError if the recorder has frames of something else.
    """
    _between_frames(recorder)
    if type(recorder._world) is not _NewtonWorld:
        _NewtonWorld(recorder, model)
    recorder._world.record(model, state, contacts, time, step)


class _NewtonWorld:
    PLANE, FIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH, CONE, HULL = range(1, 11)  # newton.GeoType
    COLLIDES = 1 << 1  # ShapeFlags.COLLIDE_SHAPES

    def __init__(self, recorder: Recorder, model: Any):
        recorder._adopt(self, "Newton", getattr(sys.modules.get("newton"), "__version__", None),
                        int(model.up_axis) == 2, "contacts")
        self.recorder = recorder
        self.owners = _list_of(model.shape_body)
        self.offsets = [(tuple(row[:3]), (row[6], *row[3:6])) for row in _rows(model.shape_transform, 7)]
        kinds, sizes, flags = _list_of(model.shape_type), _rows(model.shape_scale, 3), _list_of(model.shape_flags)
        margins = [0.0] * len(kinds)
        if getattr(model, "shape_margin", None) is not None:
            margins = _list_of(model.shape_margin)
        names = getattr(model, "shape_label", None) or getattr(model, "shape_key", None) or [None] * len(kinds)
        self.shapes = [self.add(name, kind, size, margin, source) if flag & self.COLLIDES else None
                       for name, kind, size, margin, source, flag
                       in zip(names, kinds, sizes, margins, model.shape_source, flags)]

    def add(self, name: Optional[str], kind: int, size: List[float], margin: float, source: Any) -> Optional[int]:
        recorder, (x, y, z) = self.recorder, size
        if kind == self.PLANE:
            if x > 0 or y > 0:
                recorder.note("Newton: a plane with a width is recorded as an infinite one")
            return recorder.plane(name, (0, 0, 1), margin)
        if kind == self.SPHERE:
            return recorder.sphere(name, x + margin)
        if kind == self.CAPSULE:
            return recorder.capsule(name, (0, 0, -y), (0, 0, y), x + margin)
        if kind == self.BOX and not margin > 0:
            return recorder.box(name, x, y, z)
        if kind == self.CYLINDER:
            shape = recorder.cylinder(name, 2, y, x)
        elif kind == self.CONE:
            shape = recorder.cone(name, 2, y, x)
        elif kind == self.ELLIPSOID:
            recorder.note("Newton: an ellipsoid is recorded as the hull of 1000 of its points")
            shape = recorder.hull(name, _ellipsoid(size))
        elif kind == self.BOX:
            shape = recorder.hull(name, [[h if i >> k & 1 else -h for k, h in enumerate(size)] for i in range(8)])
        elif kind in (self.MESH, self.HULL):
            vertices = [[p * s for p, s in zip(vertex, size)] for vertex in _rows(source.vertices, 3)]
            if kind == self.MESH:
                if margin > 0:
                    recorder.note("Newton: the margin of a mesh is not recorded")
                return recorder.mesh(name, vertices, _rows(source.indices, 3))
            shape = recorder.hull(name, vertices)
        else:
            recorder.note("Newton: height fields and splats are left out")
            return None
        if margin > 0:
            recorder.margin(shape, margin)
        return shape

    def record(self, model: Any, state: Any, contacts: Any, time: float, step: float):
        # Quaternions are x, y, z, w. A body of -1 is the world.
        bodies = [(tuple(row[:3]), (row[6], *row[3:6])) for row in _rows(state.body_q, 7)]
        bodies.append((_ORIGIN, _UNTURNED))
        poses = [_composed(bodies[body], *offset) for body, offset in zip(self.owners, self.offsets)]
        count = _list_of(contacts.rigid_contact_count)[0]
        a, b = _list_of(contacts.rigid_contact_shape0)[:count], _list_of(contacts.rigid_contact_shape1)[:count]
        normals = _rows(contacts.rigid_contact_normal, 3)[:count]  # from shape 0 to shape 1
        sides = []
        # Points are in the frame of the body, on the core of round shapes: a thickness away from the surface.
        for shapes, number, sign in ((a, 0, 1), (b, 1, -1)):
            points = _rows(getattr(contacts, f"rigid_contact_point{number}"), 3)
            thickness = getattr(contacts, f"rigid_contact_margin{number}", None)
            if thickness is None:  # before 1.0
                thickness = getattr(contacts, f"rigid_contact_thickness{number}")
            cores = [_composed(bodies[self.owners[shape]], point, _UNTURNED)[0] for shape, point in zip(shapes, points)]
            sides.append([[p + sign * n * t for p, n in zip(core, normal)]
                          for core, normal, t in zip(cores, normals, _list_of(thickness))])
        separations = [sum((q - p) * n for p, q, n in zip(one, other, normal))
                       for one, other, normal in zip(sides[0], sides[1], normals)]
        impulses = frictions = None
        force = getattr(contacts, "force", None)
        if step > 0 and force is not None:
            # It acts on body 0; its first three numbers are newtons.
            pushes = [[-step * f for f in row[:3]] for row in _rows(force, 6)[:count]]
            impulses = [sum(p * n for p, n in zip(push, normal)) for push, normal in zip(pushes, normals)]
            frictions = [[p - size * n for p, n in zip(push, normal)]
                         for push, normal, size in zip(pushes, normals, impulses)]
        record_arrays(self.recorder, time, self.shapes, [pose[0] for pose in poses], [pose[1] for pose in poses], a, b,
                      [[(p + q) / 2 for p, q in zip(one, other)] for one, other in zip(*sides)], normals, separations,
                      impulses=impulses, frictions=frictions, on_a=sides[0], on_b=sides[1])


def record_arrays(recorder: Recorder, time: float, shapes: Sequence[Optional[int]], positions: Any, quaternions: Any,
                  a: Any, b: Any, points: Any, normals: Any, separations: Any, *, impulses: Any = None,
                  frictions: Any = None, on_a: Any = None, on_b: Any = None, xyzw: bool = False):
    """Records poses and contacts that an engine keeps in arrays (NumPy, Warp, PyTorch, lists), as a frame.

    shapes: n numbers that the recorder returned; None for shapes that are not recorded.
    positions (n x 3, metres), quaternions (n x 4; w, x, y, z, or with `xyzw` x, y, z, w): their poses.
    a, b (m): indices into `shapes`. A contact with a shape that is not recorded, or below 0, is left out.
    points, normals (m x 3): in world space, normals unit, from a to b. separations (m): metres, negative: overlap.
    impulses (m): newton seconds; frictions (m x 3): of b; on_a, on_b (m x 3): the points on the surfaces.

    Contacts of the same shapes with the same normal are one manifold. Raises ValueError if a length does not fit.

    Genesis, whose normals point from b to a:

        c = scene.rigid_solver.collider.get_contacts()
        record_arrays(recorder, time, shapes, positions, quaternions, c["geom_a"], c["geom_b"], c["position"],
                      -c["normal"], -c["penetration"])
    """
    _between_frames(recorder)
    first, second = _list_of(a), _list_of(b)
    count = len(first)
    columns = {"b": second, "points": _rows(points, 3), "normals": _rows(normals, 3),
               "separations": _list_of(separations), "impulses": None if impulses is None else _list_of(impulses)}
    for key, values in (("frictions", frictions), ("on_a", on_a), ("on_b", on_b)):
        columns[key] = None if values is None else _rows(values, 3)
    places, turns = _rows(positions, 3), _rows(quaternions, 4)
    for key, values, length in [(key, values, count) for key, values in columns.items()] + [
            ("positions", places, len(shapes)), ("quaternions", turns, len(shapes))]:
        if values is not None and len(values) != length:
            raise ValueError(f"{key} has {len(values)} entries, not {length}")
    found: Dict[tuple, List[Point]] = {}
    for i in range(count):
        pair = int(first[i]), int(second[i])
        if max(pair) >= len(shapes):
            raise ValueError(f"contact {i} is of shape {max(pair)}, but there are {len(shapes)}")
        if min(pair) < 0 or shapes[pair[0]] is None or shapes[pair[1]] is None:
            continue
        values = {key: rows[i] for key, rows in columns.items() if rows is not None}
        point = Point(values["points"], values["separations"], values.get("on_a"), values.get("on_b"),
                      values.get("impulses"), values.get("frictions", _ORIGIN))
        found.setdefault((shapes[pair[0]], shapes[pair[1]], tuple(values["normals"])), []).append(point)
    with recorder.frame(time):
        for shape, place, turn in zip(shapes, places, turns):
            if shape is not None:
                recorder.pose(shape, place, (turn[3], *turn[:3]) if xyzw else turn)
        for (one, other, normal), kept in found.items():
            recorder.manifold(one, other, normal, kept)


def _between_frames(recorder: Recorder):
    if recorder._time is not None:
        raise ValueError("a frame has begun; this call makes a frame of its own, so call it outside of "
                         "recorder.frame()")


def _list_of(values: Any) -> list:
    """Nested lists of the numbers of an array of NumPy, Warp, PyTorch or JAX, which may be on a GPU."""
    for conversion in ("detach", "cpu", "numpy", "tolist"):
        convert = getattr(values, conversion, None)
        if convert is not None:
            values = convert()
    return list(values)


def _rows(values: Any, width: int) -> List[list]:
    """Rows of an array with one or two dimensions."""
    rows = _list_of(values)
    if rows and not hasattr(rows[0], "__len__"):
        return [rows[i:i + width] for i in range(0, len(rows), width)]
    return [_list_of(row) for row in rows]


def _decoded(text: Any) -> str:
    return text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text)


def _ellipsoid(radii: Vector) -> List[Vector]:
    """Points of a spiral that covers the sphere evenly."""
    points: List[Vector] = []
    count = 1000
    for i in range(count):
        height, turn = 1 - (2 * i + 1) / count, 2.39996322972865332 * i
        across = math.sqrt(1 - height * height)
        points.append((radii[0] * across * math.cos(turn), radii[1] * across * math.sin(turn), radii[2] * height))
    return points


def _quaternion(m: Vector) -> List[float]:
    """Of a rotation matrix, row by row; w, x, y, z. The order of the operations is that of MuJoCo."""
    if m[0] + m[4] + m[8] > 0:
        w = 0.5 * math.sqrt(1 + m[0] + m[4] + m[8])
        q = [w, 0.25 * (m[7] - m[5]) / w, 0.25 * (m[2] - m[6]) / w, 0.25 * (m[3] - m[1]) / w]
    elif m[0] > m[4] and m[0] > m[8]:
        x = 0.5 * math.sqrt(1 + m[0] - m[4] - m[8])
        q = [0.25 * (m[7] - m[5]) / x, x, 0.25 * (m[1] + m[3]) / x, 0.25 * (m[2] + m[6]) / x]
    elif m[4] > m[8]:
        y = 0.5 * math.sqrt(1 - m[0] + m[4] - m[8])
        q = [0.25 * (m[2] - m[6]) / y, 0.25 * (m[1] + m[3]) / y, y, 0.25 * (m[5] + m[7]) / y]
    else:
        z = 0.5 * math.sqrt(1 - m[0] - m[4] + m[8])
        q = [0.25 * (m[3] - m[1]) / z, 0.25 * (m[2] + m[6]) / z, 0.25 * (m[5] + m[7]) / z, z]
    size = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    scale = 1 / size
    return [scale * x for x in q]


def _turned_back(turn: Vector, vector: Vector) -> Vector:
    """A vector in the frame with this rotation."""
    return _composed((_ORIGIN, (turn[0], -turn[1], -turn[2], -turn[3])), vector, _UNTURNED)[0]


# The program. It is run for each call, so this file needs no build, works with each Python, and cannot disagree with
# the command line about what a trace means.

Trace = Union[str, "os.PathLike[str]", Recorder]


class ProgramError(RuntimeError):
    """The program contactscope could not do what it was called for; the text is its own, with file, line and remedy."""


@dataclass
class Finding:
    """A mistake that `lint` found. src/trace/README.md has all causes.

    cause: a fixed name, as "flipped_normals". what, remedy: sentences.
    count, of: how many pairs, points or frames it makes wrong, of how many checked.
    gross: the size of an error far beyond approximations, relative to the smaller shape; 0: there is none.
    line, frame, a, b: the first place, or the worst. said, actual: what the trace has there, and what its shapes and
    poses give. marks: each occurrence as (frame, a, b); of more than a thousand an evenly spaced subset.
    """

    cause: str
    what: str
    remedy: str
    count: int
    of: int
    gross: float
    line: int
    frame: Optional[int]
    a: Optional[str]
    b: Optional[str]
    said: str
    actual: str
    marks: List[Tuple[int, Optional[str], Optional[str]]]

    def __str__(self) -> str:
        place = "" if self.frame is None else f"frame {self.frame}"
        if self.a is not None:
            place += f", {self.a}" + ("" if self.b is None else f"-{self.b}")
        return (f"{self.what}, {self.count} of {self.of} [{self.cause}]\n  {place}: {self.said}; {self.actual}\n"
                f"  {self.remedy}")


def lint(trace: Trace, **options: Any) -> List[Finding]:
    """Checks the contacts in a trace against its own shapes and poses. The list is empty if nothing is wrong.

    trace: a file, or a recorder, of which the frames that have ended are checked.
    options: those of `contactscope help lint`, with underscores: strict=True, ignore=["normal"], tolerance=0.001,
        known="known.json" (its findings are left out), frames="0:10".

    Raises ProgramError for a file that cannot be read, and FileNotFoundError without the program.
    """
    found = json.loads(_run(["lint", _file_of(trace), "--json", *_options(options)], allowed=(0, 1)))
    return [Finding(entry["cause"], entry["what"], entry["remedy"], entry["count"], entry["of"], entry["gross"],
                    entry.get("line", 0), entry.get("frame"), entry.get("a"), entry.get("b"), entry.get("said", ""),
                    entry.get("is", ""), [(mark.get("frame"), mark.get("a"), mark.get("b"))
                                          for mark in entry.get("marks", [])])
            for file in found["files"] for entry in file["findings"] if not entry.get("known")]


class Picture:
    """Pictures of frames, drawn when they are shown or saved. A notebook shows one frame as a picture, and several
    as a page with a slider, or with a 3D view."""

    def __init__(self, source: str, frames: Optional[str], viewer: bool, options: Dict[str, Any]):
        self._source, self._frames, self._viewer, self._options = source, frames, viewer, options
        self._drawn: Dict[str, bytes] = {}

    def __repr__(self) -> str:
        frames = "all frames"
        if self._frames is not None:
            frames = ("frames " if self._is_sequence() else "frame ") + self._frames
        return f"<Picture of {self._source}, {frames}; save(path) writes it>"

    def png(self) -> bytes:
        """Pixels; animated if there are several frames."""
        return self._draw("apng" if self._is_sequence() else "png")

    def svg(self) -> str:
        """Vectors of the last frame, with live text."""
        return self._draw("svg").decode()

    def html(self) -> str:
        """A page that needs no network: a slider and the trace's facts, or a 3D view."""
        return self._draw("viewer" if self._viewer else "html").decode()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> str:
        """Writes a file whose ending decides the format: .png, .svg, .pdf, .html, .apng or .webp. Returns the path."""
        path = os.fspath(path)
        ending = path.rsplit(".", 1)[-1].lower() if "." in os.path.basename(path) else ""
        if ending not in ("png", "svg", "pdf", "html", "apng", "webp"):
            raise ValueError(f"{path} does not end with .png, .svg, .pdf, .html, .apng or .webp")
        data = self.png() if ending == "png" else self.html().encode() if ending == "html" else self._draw(ending)
        with open(path, "wb") as file:
            file.write(data)
        return path

    def _repr_png_(self) -> Optional[bytes]:
        return None if self._is_page() else self.png()

    def _repr_svg_(self) -> Optional[str]:
        return None if self._is_page() else self.svg()

    def _repr_html_(self) -> Optional[str]:
        if not self._is_page():
            return None
        return ('<iframe style="width:100%;height:720px;border:0" srcdoc="' + html.escape(self.html()) + '"></iframe>')

    def _is_sequence(self) -> bool:
        return self._frames is None or ":" in self._frames

    def _is_page(self) -> bool:
        return self._viewer or self._is_sequence()

    def _draw(self, form: str) -> bytes:
        if form not in self._drawn:
            frames = [] if self._frames is None else ["--frames", self._frames]
            with tempfile.TemporaryDirectory() as folder:
                drawn = json.loads(_run(["render", self._source, "--format", form, "--out", folder, "--json", *frames,
                                         *_options(self._options)]))
                with open([path for paths in drawn.values() for path in paths][-1], "rb") as file:
                    self._drawn[form] = file.read()
        return self._drawn[form]


def render(trace: Trace, frame: Union[int, str, Tuple[int, int], None] = None, *, viewer: bool = False,
           **options: Any) -> Picture:
    """Pictures of a trace or scenario, for notebooks and files: render("run.jsonl").save("figure.pdf").

    trace: a file, the name of a scenario, or a recorder, of which the frames that have ended are drawn.
    frame: its number; "all", or two numbers for all frames between them, both included. Default: the last frame of a
        trace, all frames of a scenario.
    viewer: notebooks show a 3D page.
    options: those of `contactscope help render`, with underscores: size="800x600", theme="dark",
        pair=("crate", "floor"), focus="worst", layers=["shapes", "contacts"].

    Nothing is drawn before the picture is shown or saved. Then ProgramError has what the program says, and
    FileNotFoundError is raised without the program.
    """
    source = _file_of(trace)
    if frame is None and source.endswith(".jsonl"):
        frame = _last_frame(source)
    if isinstance(frame, tuple):
        frame = f"{frame[0]}:{frame[1]}"
    return Picture(source, None if frame in (None, "all") else str(frame), viewer, options)


def assert_manifold(contacts: Union[Trace, Manifold, Sequence[Manifold]], name: str, *, frame: Optional[int] = None,
                    doubles: bool = True, update: Optional[bool] = None, snapshots: Optional[str] = None,
                    out: Optional[str] = None, pictures: bool = True):
    """Compares contacts with a stored snapshot, in any test framework:

        def test_stack():
            assert_manifold(record_a_stack(), "stack/frame_12", frame=12)

    contacts: a trace, as its file or its recorder; or manifolds alone, which are drawn on stand-ins for their shapes.
    name: GROUP/IDEA; the snapshot is SNAPSHOTS/GROUP/IDEA/trace.jsonl, a trace that `contactscope render` draws.
    frame: only this frame of the trace. Else of a long trace the first, middle and last frame are compared.
    doubles: manifolds alone are of an engine that computes in double.
    update: write what is missing or differs. Default: $CONTACTSCOPE_UPDATE is 1. Never if $CI is 1 or true.
    snapshots: default: $CONTACTSCOPE_SNAPSHOTS, or else snapshots, below the working directory.
    out: pictures of failures are below OUT/check. Default: $CONTACTSCOPE_OUT, or else out.
    pictures: False: a failure draws nothing.

    The comparison is that of `contactscope check`: ids, counts and names exactly, numbers within a few roundings of
    the engine's scalar. Raises AssertionError with the points that moved and the paths of pictures, ValueError for a
    name or a frame that cannot be, ProgramError for a trace that cannot be read, FileNotFoundError without the program.
    """
    __tracebackhide__ = True  # pytest shows the line of the test instead
    if not re.fullmatch(r"[^/\s]+/[^/\s]+", name):
        raise ValueError(f"the name of a snapshot is GROUP/IDEA, as stack/frame_12, not {name!r}")
    folder = os.path.abspath(snapshots or os.environ.get("CONTACTSCOPE_SNAPSHOTS") or "snapshots")
    stored = os.path.join(folder, *name.split("/"), "trace.jsonl")
    wanted = os.environ.get("CONTACTSCOPE_UPDATE") in ("1", "true") if update is None else update
    how = "run the test once with CONTACTSCOPE_UPDATE=1"
    if wanted and os.environ.get("CI") in ("1", "true"):
        wanted, how = False, "CI is set, so nothing is written; unset it and run the test again"
    manifolds: Optional[Sequence[Manifold]] = None
    if isinstance(contacts, Manifold):
        manifolds = [contacts]
    elif not isinstance(contacts, (str, os.PathLike, Recorder)):
        manifolds = list(contacts)
    with tempfile.TemporaryDirectory() as work:
        trace = os.path.join(work, "actual.jsonl")

        def check(shapes: Optional[dict], *extra: str) -> dict:
            lines = (_excerpt(_file_of(contacts), name, frame) if manifolds is None  # type: ignore[arg-type]
                     else _with_stand_ins(manifolds, name, doubles, shapes))
            with open(trace, "w", encoding="utf-8") as file:
                file.writelines(lines)
            return json.loads(_run(["check", trace, "--facts-only", "--snapshots", folder, "--out", work, "--json",
                                    *extra], allowed=(0, 1)))

        if not os.path.exists(stored):
            if not wanted:
                raise AssertionError(f"{name}: no snapshot at {stored}; {how}, review the file and commit it; "
                                     "$CONTACTSCOPE_SNAPSHOTS names another folder")
            check(None, "--write-missing")
            print(f"contactscope: {name}: wrote {stored}; review it and commit it", file=sys.stderr)
            return
        with open(stored, encoding="utf-8") as file:
            shapes = json.loads(file.readline()).get("shapes") if manifolds is not None else None
        found = check(shapes)
        if found["same"]:
            return
        findings = [finding for scenario in found["scenarios"] for finding in scenario["findings"] if finding["fails"]]
        sentences = "\n".join(finding["sentence"] for finding in findings)
        if wanted:
            check(None, "--update=all")
            print(f"contactscope: {sentences}\ncontactscope: rewrote {stored}", file=sys.stderr)
            return
        if pictures:
            actual = os.path.join(work, "check", *name.split("/"), "trace.actual.jsonl")
            sentences += "\n" + _pictures_of(stored, actual, name, sentences,
                                             os.path.abspath(out or os.environ.get("CONTACTSCOPE_OUT") or "out"))
        raise AssertionError(f"{sentences}\nif this is right, {how}: it rewrites {stored}")


def _run(arguments: Sequence[str], allowed: Sequence[int] = (0,)) -> str:
    """What the program prints to its standard output."""
    program = os.environ.get("CONTACTSCOPE") or shutil.which("contactscope")
    if not program:
        raise FileNotFoundError("the program contactscope is not on the PATH; install it, or set CONTACTSCOPE to its "
                                "path")
    done = subprocess.run([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                          errors="replace")
    if done.returncode not in allowed:
        raise ProgramError(done.stderr.strip() or f"contactscope {arguments[0]} ended with status {done.returncode}")
    return done.stdout


def _options(options: Dict[str, Any]) -> List[str]:
    """As the command line takes them: True is a flag, None and False are nothing, lists have commas."""
    words = []
    for key, value in options.items():
        if value is None or value is False:
            continue
        flag = "--" + key.replace("_", "-")
        if value is True:
            words.append(flag)
        else:
            words.append(f"{flag}={','.join(map(str, value)) if isinstance(value, (list, tuple)) else value}")
    return words


def _file_of(trace: Trace) -> str:
    if isinstance(trace, Recorder):
        trace._write_head()
        return trace.path
    return os.fspath(trace)


def _lines_of(path: str) -> List[dict]:
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.strip()]


def _last_frame(path: str) -> Optional[int]:
    last = ""
    with open(path, encoding="utf-8") as file:
        for line in file:
            last = line if line.strip() else last
    return json.loads(last).get("frame") if last else None


def _excerpt(path: str, name: str, frame: Optional[int]) -> List[str]:
    """Lines of the trace under another name; of one frame, with the shapes that the frames before it have added."""
    try:
        lines = _lines_of(path)
    except ValueError:
        _run(["doctor", path])  # says where it is wrong
        raise
    if not lines:
        raise ProgramError(f"{path} is empty; a recorder has written nothing to it")
    head, frames = lines[0], lines[1:]
    head["scenario"] = name
    if frame is not None:
        numbers = [line["frame"] for line in frames]
        if frame not in numbers:
            there = f"its frames are {numbers[0]} to {numbers[-1]}" if numbers else "it has none"
            raise ValueError(f"{path} has no frame {frame}; {there}")
        for line in frames[:numbers.index(frame) + 1]:
            head.setdefault("shapes", {}).update(line.pop("shapes", {}))
        head.pop("frames", None)
        frames = [frames[numbers.index(frame)]]
    return [json.dumps(line) + "\n" for line in [head, *frames]]


def _with_stand_ins(manifolds: Sequence[Manifold], name: str, doubles: bool, shapes: Optional[dict]) -> List[str]:
    """A trace of one frame. "a" is the plane of the first manifold through the mean of its points, "b" the outline of
    all points on that plane; of two points a thin capsule, of one a small ball."""
    kept = [(_numbers(one.normal, 3, "normal"), [_Checked(point, False) for point in one.points], one.triangle)
            for one in manifolds if one.points]
    if shapes is None:
        shapes = {"a": {"type": "plane", "vertices": [], "faces": []}}
        normal: Vector = (0.0, 1.0, 0.0)
        places: List[Vector] = [point.position for _, points, _ in kept for point in points] or [_ORIGIN]
        if kept:
            size = math.sqrt(sum(x * x for x in kept[0][0]))
            normal = tuple(x / size for x in kept[0][0]) if size > 0 else normal
        first: List[Vector] = [point.position for point in kept[0][1]] if kept else places
        middle = [sum(place[k] for place in first) / len(first) for k in range(3)]
        shapes["a"]["half_space"] = {"normal": normal, "offset": sum(n * m for n, m in zip(normal, middle))}
        corners = _outline(places, normal)
        shapes["b"] = {"type": "hull", "vertices": corners,
                       "faces": [list(range(len(corners))), list(range(len(corners)))[::-1]]}
        if len(corners) == 1:
            shapes["b"] = {"type": "sphere", "vertices": corners, "faces": [], "radius": 0.05}
        elif len(corners) == 2:
            shapes["b"] = {"type": "capsule", "vertices": corners, "faces": [], "radius": 0.05 * math.dist(*corners)}
    still = {"position": _ORIGIN, "quat_wxyz": _UNTURNED}
    entries, count = [], 0
    for direction, points, triangle in kept:
        entry: Dict[str, Any] = {"normal": direction, "points": []}
        if triangle >= 0:
            entry["triangle"] = triangle
        for point in points:
            # Features of stand-ins identify nothing, so points without an id have their number.
            count, name_of = count + 1, count if point.id is None else point.id
            one: Dict[str, Any] = {"position": point.position, "separation": point.separation, "id": str(name_of)}
            if point.impulse is not None:
                one["impulse"] = {"normal": point.impulse, "friction": point.friction}
            if point.sides is not None:
                one["on_a"], one["on_b"] = point.sides
            if point.idle:
                one["active"] = False
            entry["points"].append(one)
        entries.append(entry)
    head = {"schema": "contactscope.trace/1", "scenario": name, "source": "Contacts alone; the shapes are stand-ins",
            "scalar": "double" if doubles else "float", "up": "y", "shapes": shapes}
    only = {"frame": 0, "time": 0, "poses": {"a": still, "b": still},
            "pairs": [{"a": "a", "b": "b", "manifolds": entries}] if entries else []}
    return [json.dumps(line) + "\n" for line in (head, only)]


def _outline(places: Sequence[Vector], normal: Vector) -> List[Vector]:
    """The convex outline of points seen along the normal, counter-clockwise."""
    least = min(range(3), key=lambda k: abs(normal[k]))
    axis = [1.0 if k == least else 0.0 for k in range(3)]
    u = [normal[(k + 1) % 3] * axis[(k + 2) % 3] - normal[(k + 2) % 3] * axis[(k + 1) % 3] for k in range(3)]
    v = [normal[(k + 1) % 3] * u[(k + 2) % 3] - normal[(k + 2) % 3] * u[(k + 1) % 3] for k in range(3)]
    flat = sorted({(sum(p * q for p, q in zip(place, u)), sum(p * q for p, q in zip(place, v))): tuple(place)
                   for place in places}.items())
    if len(flat) < 3:
        return [place for _, place in flat]
    outline: list = []
    for side in (flat, flat[::-1]):
        chain: list = []
        for point in side:
            while len(chain) > 1 and _turns_right(chain[-2][0], chain[-1][0], point[0]):
                chain.pop()
            chain.append(point)
        outline += chain[:-1]
    return [place for _, place in outline]


def _turns_right(a: Vector, b: Vector, c: Vector) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0


def _pictures_of(expected: str, actual: str, name: str, sentences: str, out: str) -> str:
    """Draws the frame that the sentences name first, as stored, as it is now, and what differs; says where."""
    if not os.path.exists(actual):
        return "no pictures: the stored trace cannot be compared"
    frames = [line["frame"] for line in _lines_of(actual)[1:]]
    named = re.search(re.escape(name) + r" frame (\d+)", sentences)
    frame = int(named.group(1)) if named else frames[0] if frames else None
    if frame is None:
        return "no pictures: the trace has no frame"
    folder = os.path.join(out, "check", *name.split("/"))
    os.makedirs(folder, exist_ok=True)
    stem = os.path.join(folder, f"frame_{frame:04d}.")
    try:
        for which, path in (("expected", expected), ("actual", actual)):
            render(path, frame).save(f"{stem}{which}.png")
        _run(["diff", expected, actual, "--picture", stem + "difference.png"], allowed=(0, 1))
    except ProgramError as error:
        return f"no pictures: {error}"
    return f"see {stem}difference.png, with .expected.png and .actual.png next to it"
