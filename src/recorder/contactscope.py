"""Records the contacts of a physics engine as a trace for contactscope.

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

`contactscope render run.jsonl` draws the trace, `contactscope lint run.jsonl` checks it.

Conventions: metres, world space. Quaternions are unit, in the order w, x, y, z. Normals are unit and point
from a to b. A negative separation is an overlap. Impulses are newton seconds and act on b, unless the
recorder is told otherwise. A vector is anything with three numbers: a tuple, a list, a NumPy array.

Each frame is written when it ends, so a crash loses no earlier frame. Wrong arguments raise ValueError or
TypeError before anything is recorded of them.

MIT License; the text is in contactscope.h.
"""

import bisect
import math
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Iterable, Optional, Sequence

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
        self._z_up = z_up
        head = ['{"schema":"contactscope.trace/1","scenario":', _quoted(scenario),
                ',"scalar":"double"' if doubles else ',"scalar":"float"', ',"up":"z"' if z_up else ',"up":"y"']
        for key, value in (("engine", engine), ("version", version)):
            if value is not None:
                head += [f',"{key}":', _quoted(value)]
        if poses_at != "contacts":
            head.append(f',"poses_at":"{poses_at}"')
        if force_step > 0 or friction_on_a:
            head.append(',"impulses":{"unit":"%s","on":"%s"' % ("N" if force_step > 0 else "N s",
                                                                "a" if friction_on_a else "b"))
            head.append(',"step":%.17g}' % force_step if force_step > 0 else "}")
        self._head: Optional[str] = "".join(head)  # until it is written
        self._names: list = []    # by shape, as JSON
        self._shapes: list = []   # by shape: its entry without the closing brace; None for compounds, and once written
        self._margins: dict = {}  # metres, by shape
        self._parts: dict = {}    # by shape: compound, position, rotation
        self._compounds: set = set()
        self._notes: set = set()
        self._number = 0
        self._time: Optional[float] = None  # of the frame that has begun
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
        self._poses, self._manifolds, self._bodies, self._solver = {}, [], [], None

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
        if self._head is not None:
            self._write(self._head + self._new_shapes())
            self._head = None

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
        if point.on_a is not None:
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
