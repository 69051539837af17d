"""Tests of contactscope.py: its adapters against engines, and what it does by calling the program.

    CONTACTSCOPE=build/release/contactscope python3 tests/recorder/python_test.py

MUJOCO_FACTS and BULLET_FACTS are programs of tests/adapters; without them the tests of their engines are skipped.
"""

import ast
import contextlib
import io
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import textwrap
import types
import unittest
from types import SimpleNamespace

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", "src", "recorder"), HERE]

import contactscope  # noqa: E402
import mujoco_view  # noqa: E402
from contactscope import (Manifold, Point, ProgramError, Recorder, add_trimesh, assert_manifold, lint,  # noqa: E402
                          record_arrays, record_mujoco, record_newton, record_pybullet, render)


def program_of(variable):
    path = os.environ.get(variable, "")
    return path if os.path.exists(path) else None


class InAFolder(unittest.TestCase):
    """Each test runs in an empty folder, without the variables that change what is written."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        before = dict(os.environ)
        self.addCleanup(lambda: (os.environ.clear(), os.environ.update(before)))
        for name in ("CI", "CONTACTSCOPE_UPDATE", "CONTACTSCOPE_SNAPSHOTS", "CONTACTSCOPE_OUT"):
            os.environ.pop(name, None)

    def frames_of(self, path):
        with open(path, encoding="utf-8") as file:
            return [json.loads(line) for line in file]


def read(path):
    with open(path, "rb") as file:
        return file.read()


def quiet(call, *arguments, **options):
    """The call's result, and what it prints to the standard error."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        return call(*arguments, **options), said.getvalue()


STACK = """<mujoco><worldbody><geom name="ground" type="plane" size="5 5 1"/>
  <body name="lower" pos="0 0 0.5"><freejoint/><geom type="box" size="0.5 0.5 0.5"/></body>
  <body name="upper" pos="0.1 0 1.5"><freejoint/><geom type="box" size="0.5 0.5 0.5"/></body>
  <body name="ball" pos="2 0 0.4"><freejoint/><geom type="sphere" size="0.4"/></body></worldbody></mujoco>"""

# Each type of geom, contacts of 1, 3, 4 and 6 dimensions, a contact in its gap, a body of two geoms and one that is
# only visual, joints, and a geom that collides only by a pair.
ZOO = """<mujoco><option cone="%s" iterations="30"/><asset>
  <mesh name="wedge" vertex="-0.5 -0.4 -0.3  0.5 -0.4 -0.3  0.5 0.4 -0.3  -0.5 0.4 -0.3  0 -0.3 0.4  0 0.3 0.4  0 0 0"/>
  <hfield name="hills" nrow="4" ncol="5" size="2 1.5 0.4 0.1"/></asset><worldbody>
  <geom name="ground" type="plane" size="5 5 1"/><geom name="hills" type="hfield" hfield="hills" pos="9 0 0"/>
  <body name="ball" pos="0 0 0.39"><freejoint/><geom type="sphere" size="0.4" condim="1"/></body>
  <body name="pill" pos="2 0 0.21"><freejoint/><geom type="capsule" size="0.2 0.5" euler="0 90 0" condim="4"/></body>
  <body name="crate" pos="4 0 0.3"><freejoint/><geom type="box" size="0.3 0.4 0.3" condim="6"/></body>
  <body name="drum" pos="0 3 0.29"><freejoint/><geom type="cylinder" size="0.3 0.3"/></body>
  <body name="egg" pos="2 3 0.19"><freejoint/><geom type="ellipsoid" size="0.4 0.3 0.2"/></body>
  <body name="wedge" pos="4 3 0.28"><freejoint/><geom type="mesh" mesh="wedge"/></body>
  <body name="upon_hills" pos="9 0 0.6"><freejoint/><geom type="sphere" size="0.3"/></body>
  <body name="near" pos="0 6 0.25"><freejoint/><geom type="sphere" size="0.2" margin="0.1" gap="0.1"/></body>
  <body name="hammer" pos="-3 0 0.19" euler="0 0 200"><freejoint/><geom name="head" type="sphere" size="0.2"/>
    <geom name="handle" type="capsule" size="0.05 0.5" pos="0.5 0 -0.1" euler="0 95 0"/>
    <geom type="box" size="1 1 1" contype="0" conaffinity="0"/></body>
  <body name="arm" pos="-3 3 0.5" euler="170 10 100"><joint type="hinge" axis="0 1 0"/>
    <geom type="box" size=".3 .1 .1"/>
    <body pos=".5 0 0"><joint type="hinge" axis="0 1 0"/>
      <geom name="ghost" type="sphere" size=".1" contype="0" conaffinity="0"/></body></body></worldbody>
  <contact><pair geom1="ghost" geom2="ground"/></contact></mujoco>"""


@unittest.skipUnless(program_of("MUJOCO_FACTS") and mujoco_view.library(), "MuJoCo is not installed")
class MujocoTest(InAFolder):
    """The oracle is the C++ adapter in another process, on MuJoCo's own library."""

    def view(self, world):
        with open("model.xml", "w", encoding="utf-8") as file:
            file.write(world)
        view = mujoco_view.Mujoco(os.environ["MUJOCO_FACTS"], "model.xml")
        self.addCleanup(view.close)
        return view

    def test_the_bytes_are_those_of_the_adapter_in_cpp(self):
        version = mujoco_view.version()
        for world, steps, least in ((STACK, 30, 100), (ZOO % "pyramidal", 40, 400), (ZOO % "elliptic", 40, 400)):
            view = self.view(world)
            with Recorder("python.jsonl", "mujoco/run", version=version) as recorder:
                for _ in range(steps):
                    view.step()
                    quiet(record_mujoco, recorder, view.model, view.data)
            subprocess.run([os.environ["MUJOCO_FACTS"], "model.xml", str(steps), "cpp.jsonl"], check=True,
                           stderr=subprocess.DEVNULL)
            self.assertEqual(read("python.jsonl"), read("cpp.jsonl"))
            points = [point for line in self.frames_of("python.jsonl")[1:] for pair in line["pairs"]
                      for manifold in pair["manifolds"] for point in manifold["points"]]
            self.assertGreater(len(points), least)

    def test_the_time_is_that_of_the_poses(self):
        view = self.view(STACK)
        with Recorder("run.jsonl", "mujoco/run") as recorder:
            view.forward()
            record_mujoco(recorder, view.model, view.data, integrated=False)
            view.step()
            view.step()
            record_mujoco(recorder, view.model, view.data)
        head, first, second = self.frames_of("run.jsonl")
        self.assertEqual((head["engine"], head["up"], head["poses_at"]), ("MuJoCo", "z", "before_step"))
        self.assertEqual((first["time"], second["time"]), (0, 0.002))

    def test_a_force_has_the_adhesion_of_later_versions_taken_off(self):
        view = self.view(STACK)
        for _ in range(10):  # they fall onto each other
            view.step()
        impulses = []
        for adhesion in (None, 3.0):
            contacts = [SimpleNamespace(**{name: getattr(view.data.contact[i], name) for name in mujoco_view.CONTACT},
                                        **({} if adhesion is None else {"adhesion": adhesion}))
                        for i in range(view.data.ncon)]
            data = SimpleNamespace(**{name: getattr(view.data, name) for name in mujoco_view.DATA}, contact=contacts)
            with Recorder("run.jsonl", "mujoco/run") as recorder:
                record_mujoco(recorder, view.model, data)
            impulses.append([point["impulse"]["normal"] for pair in self.frames_of("run.jsonl")[1]["pairs"]
                             for manifold in pair["manifolds"] for point in manifold["points"]])
        self.assertGreater(len(impulses[0]), 4)
        for before, after in zip(*impulses):
            self.assertAlmostEqual(before - after, 3.0 * 0.002, 12)

    def test_another_model_is_refused(self):
        small, large = self.view(STACK), self.view(ZOO % "elliptic")
        with Recorder("run.jsonl", "mujoco/run") as recorder:
            small.step()
            record_mujoco(recorder, small.model, small.data)
            with self.assertRaisesRegex(ValueError, "one recorder for each model"):
                record_mujoco(recorder, large.model, large.data)
            with self.assertRaisesRegex(ValueError, "something else than Newton"):
                record_newton(recorder, newton_model(), None, None, 0)


class PyBullet:
    """The functions of the module pybullet, with the numbers of bullet_facts."""

    def __init__(self, lines):
        self.bodies, self.steps, self.now = lines[0]["bodies"], lines[1:], 0
        self.contacts = ()

    def getPhysicsEngineParameters(self):
        return {"gravityAccelerationX": 0, "gravityAccelerationY": 0, "gravityAccelerationZ": -9.81,
                "fixedTimeStep": 1 / 60, "numSubSteps": 0, "numSolverIterations": 10}

    def getNumBodies(self):
        return len(self.bodies)

    def getBodyUniqueId(self, i):
        return i

    def getNumJoints(self, body):
        return 0

    def getBodyInfo(self, body):
        return b"baseLink", self.bodies[body]["name"].encode()

    def getCollisionShapeData(self, body, link):
        return tuple((body, link, form["type"], form["size"], b"", form["position"], form["turn"])
                     for form in self.bodies[body]["shapes"])

    def getMeshData(self, body, link, collisionShapeIndex=-1):
        vertices = self.bodies[body]["shapes"][max(collisionShapeIndex, 0)]["vertices"]
        return len(vertices), vertices

    def getDynamicsInfo(self, body, link):
        one = self.bodies[body]
        return (one["mass"], 0.5, (1, 1, 1), (0, 0, 0), (0, 0, 0, 1), 0, 0, 0, -1, -1, 1, one["margin"])

    def getBasePositionAndOrientation(self, body):
        return tuple(self.steps[self.now]["poses"][body][:2])

    def getBaseVelocity(self, body):
        return tuple(self.steps[self.now]["poses"][body][2:])

    def stepSimulation(self):
        self.contacts = self.steps[self.now]["contacts"]
        self.now = min(self.now + 1, len(self.steps) - 1)

    def getContactPoints(self):
        return self.contacts


class Robot(PyBullet):
    """A hidden body, and an arm with a base that is a concave mesh and a link of two balls, turned about z."""

    class error(Exception):
        pass

    def __init__(self):
        super().__init__([{"bodies": [{"name": "hidden", "mass": 1}, {"name": "", "mass": 1, "margin": 0}]}, {}])
        self.steps[0]["contacts"] = [[0, 1, 0, 0, -1, (0, 2.3, 1), (0, 2.3, 1), (0, 0, 1), 0.001, 0.0,
                                      0.0, (1, 0, 0), 0.0, (0, 1, 0)],
                                     [0, 1, 1, 0, -1, (0, 1.3, 1), (0, 2, 1), (0, 0, 1), -0.01, 60.0, 6.0, (1, 0, 0),
                                      0.0, (0, 1, 0)]]

    def getNumJoints(self, body):
        return body

    def getJointInfo(self, body, link):
        return (0, b"joint", *[0] * 10, b"hand")

    def getCollisionShapeData(self, body, link):
        if body == 0:
            raise Robot.error("Error receiving collision shape info")
        if link < 0:
            return ((body, link, 5, (1, 1, 1), b"unknown_file", (0, 0, 0), (0, 0, 0, 1)),)
        return tuple((body, link, 2, (0.3, 0.3, 0.3), b"", (x, 0, 0), (0, 0, 0, 1)) for x in (1, 2))

    def getMeshData(self, body, link, collisionShapeIndex=-1):
        return 0, ()

    def getBasePositionAndOrientation(self, body):
        return (0, 0, 0), (0, 0, 0, 1)

    def getLinkState(self, body, link, computeForwardKinematics=0):
        half = math.sqrt(0.5)
        return ((0, 0, 1), (0, 0, half, half)) if computeForwardKinematics else ((9, 9, 9), (0, 0, 0, 1))


class LinksTest(InAFolder):
    def test_links_are_bodies_with_parts(self):
        with Recorder("run.jsonl", "bullet/run") as recorder:
            _, said = quiet(record_pybullet, recorder, Robot())
        self.assertIn("no shape of body 0 (hidden)", said)
        self.assertIn("concave meshes", said)
        head, frame = self.frames_of("run.jsonl")
        shapes = {**head["shapes"], **frame.get("shapes", {})}
        self.assertEqual({name: shape["body"] for name, shape in shapes.items()}, {"hand/0": "hand", "hand/1": "hand"})
        for name, y in (("hand/0", 1), ("hand/1", 2)):
            for number, expected in zip(frame["poses"][name]["position"], (0, y, 1)):
                self.assertAlmostEqual(number, expected, 12)
        self.assertEqual(frame["pairs"], [])  # both contacts have a body that is left out

    def test_a_point_is_of_the_nearest_part(self):
        robot = Robot()
        ball = ((2, -1, 2, (0.5, 0.5, 0.5), b"", (0, 0, 0), (0, 0, 0, 1)),)
        robot.bodies.append({"name": "ball", "mass": 1, "margin": 0})
        forms, count = robot.getCollisionShapeData, robot.getNumJoints
        robot.getCollisionShapeData = lambda body, link: ball if body == 2 else forms(body, link)
        robot.getNumJoints = lambda body: 0 if body == 2 else count(body)
        robot.getBaseVelocity = lambda body: ((0, 0, 0), (0, 0, 0))
        robot.steps[0]["contacts"][1][2:5] = 2, 0, -1
        with Recorder("run.jsonl", "bullet/run") as recorder:
            quiet(record_pybullet, recorder, robot)
        frame = self.frames_of("run.jsonl")[1]
        pair, = frame["pairs"]
        self.assertEqual((pair["a"], pair["b"]), ("hand/0", "ball"))
        manifold, = pair["manifolds"]
        self.assertEqual(manifold["normal"], [0, 0, -1])
        self.assertAlmostEqual(manifold["points"][0]["impulse"]["normal"], 1, 12)
        self.assertAlmostEqual(manifold["points"][0]["impulse"]["friction"][0], -0.1, 12)
        self.assertEqual(list(frame["solver"]["bodies"]), ["ball"])


@unittest.skipUnless(program_of("BULLET_FACTS"), "Bullet is not installed")
class BulletTest(InAFolder):
    """The oracle is the C++ adapter on Debian's Bullet; its numbers are single precision."""

    def same(self, one, other, place=""):
        if isinstance(one, dict):
            self.assertEqual(sorted(one), sorted(other), place)
            for key in one:
                self.same(one[key], other[key], f"{place}.{key}")
        elif isinstance(one, list):
            self.assertEqual(len(one), len(other), place)
            for i, pair in enumerate(zip(one, other)):
                self.same(*pair, f"{place}[{i}]")
        elif isinstance(one, float) or isinstance(other, float):
            self.assertAlmostEqual(one, other, delta=2e-6 * max(1, abs(one)), msg=place)
        else:
            self.assertEqual(one, other, place)

    def test_the_trace_is_that_of_the_adapter_in_cpp(self):
        printed = subprocess.run([os.environ["BULLET_FACTS"], "cpp.jsonl"], stdout=subprocess.PIPE, check=True,
                                 encoding="utf-8").stdout
        client = PyBullet([json.loads(line) for line in printed.splitlines()])
        with Recorder("python.jsonl", "bullet/run", version="3.24", doubles=False) as recorder:
            for _ in range(40):
                record_pybullet(recorder, client)
        ours, theirs = self.frames_of("python.jsonl"), self.frames_of("cpp.jsonl")
        self.assertEqual(len(ours), len(theirs))
        points = 0
        for one, other in zip(ours, theirs):
            for line in (one, other):
                line.pop("solver", None)  # PyBullet does not say whether impulses are warm-started
                for shape in line.get("shapes", {}).values():
                    shape["vertices"].sort()
                points += sum(len(manifold["points"]) for pair in line.get("pairs", [])
                              for manifold in pair["manifolds"])
            self.same(one, other)
        self.assertGreater(points, 1000)


def newton_model():
    """A plane, a ball with a margin, a crate on the world and a capsule without collisions."""
    return SimpleNamespace(
        up_axis=2, shape_label=["ground", "ball", "crate", "ghost"], shape_body=[-1, 0, -1, 0], shape_type=[1, 3, 7, 4],
        shape_transform=[[0, 0, 0, 0, 0, 0, 1], [0.1, 0, 0, 0, 0, 0, 1], [3, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 1]],
        shape_scale=[[0, 0, 0], [0.3, 0, 0], [0.5, 0.5, 0.5], [0.1, 0.1, 0]], shape_margin=[0, 0.02, 0, 0],
        shape_flags=[3, 3, 3, 1], shape_source=[None] * 4)


class ArraysTest(InAFolder):
    def contacts(self, sign=1):
        """The ball is a quarter turn about z, so its offset of 0.1 along x is along y: at 0, 0.1, 0.31. Its radius with
        its margin is 0.32, so it overlaps the plane by 10 mm. Points are in the frame of the body."""
        return SimpleNamespace(
            rigid_contact_count=[1], rigid_contact_shape0=[0, -1], rigid_contact_shape1=[1, -1],
            rigid_contact_point0=[[0, 0.1, 0], [0, 0, 0]], rigid_contact_point1=[[0.1, 0, 0], [0, 0, 0]],
            rigid_contact_normal=[[0, 0, sign], [0, 0, 0]], rigid_contact_margin0=[0, 0],
            rigid_contact_margin1=[0.32, 0], force=[[1, 2, -30, 0, 0, 0], [0] * 6])

    def record(self, contacts):
        half = math.sqrt(0.5)
        state = SimpleNamespace(body_q=[[0, 0, 0.31, 0, 0, half, half]])
        with Recorder("run.jsonl", "newton/run") as recorder:
            for i in range(3):
                record_newton(recorder, newton_model(), state, contacts, i / 60, 1 / 60)
        return self.frames_of("run.jsonl")

    def test_points_of_newton_are_moved_to_the_surfaces(self):
        head, first = self.record(self.contacts())[:2]
        self.assertEqual(sorted({**head["shapes"], **first.get("shapes", {})}), ["ball", "crate", "ground"])
        pair = first["pairs"][0]
        self.assertEqual((pair["a"], pair["b"]), ("ground", "ball"))
        point = pair["manifolds"][0]["points"][0]
        self.assertAlmostEqual(point["separation"], -0.01, 12)
        for key, expected in (("on_a", (0, 0.1, 0)), ("on_b", (0, 0.1, -0.01)), ("position", (0, 0.1, -0.005))):
            for actual, number in zip(point[key], expected):
                self.assertAlmostEqual(actual, number, 12)
        self.assertAlmostEqual(point["impulse"]["normal"], 30 / 60, 12)  # the force acts on body 0
        self.assertAlmostEqual(point["impulse"]["friction"][0], -1 / 60, 12)

    @unittest.skipUnless(program_of("CONTACTSCOPE"), "the program is not built")
    def test_lint_agrees_with_the_surfaces_and_would_see_a_flipped_normal(self):
        self.record(self.contacts())
        self.assertEqual(lint("run.jsonl"), [])
        self.record(self.contacts(-1))
        self.assertTrue(lint("run.jsonl"))

    def test_arrays_are_grouped_by_shapes_and_normal(self):
        class Tensor(list):
            def detach(self):
                return self

            def cpu(self):
                return self

            def tolist(self):
                return list(self)

        with Recorder("run.jsonl", "mine/arrays") as recorder:
            shapes = [recorder.plane("ground", (0, 1, 0), 0), None, recorder.box("crate", 0.5, 0.5, 0.5)]
            record_arrays(recorder, 0.5, shapes, [[0, 0, 0]] * 2 + [[0, 0.49, 0]], Tensor([Tensor([0, 0, 0, 1])] * 3),
                          Tensor([0, 0, 2, 0, -1]), [2, 2, 0, 1, 2],
                          [[-0.5, 0, 0], [0.5, 0, 0], [0, 0, 0.5], [0, 0, 0], [0, 0, 0]],
                          [[0, 1, 0], [0, 1, 0], [0, -1, 0], [0, 1, 0], [0, 1, 0]], [-0.01] * 5,
                          impulses=[1, 2, 3, 4, 5], xyzw=True)
            with self.assertRaisesRegex(ValueError, "separations has 1 entries, not 2"):
                record_arrays(recorder, 1, shapes, [[0, 0, 0]] * 3, [[1, 0, 0, 0]] * 3, [0, 0], [2, 2], [[0, 0, 0]] * 2,
                              [[0, 1, 0]] * 2, [0])
            with self.assertRaisesRegex(ValueError, "outside of recorder.frame"), recorder.frame(1):
                record_arrays(recorder, 1, [], [], [], [], [], [], [], [])
            with self.assertRaisesRegex(ValueError, "contact 0 is of shape 3, but there are 3"):
                record_arrays(recorder, 1, shapes, [[0, 0, 0]] * 3, [[1, 0, 0, 0]] * 3, [0], [3], [[0, 0, 0]],
                              [[0, 1, 0]], [0])
        frame = self.frames_of("run.jsonl")[1]
        self.assertEqual(frame["poses"]["crate"]["quat_wxyz"], [1, 0, 0, 0])
        self.assertEqual(len(frame["pairs"]), 1)
        # The third is of crate and ground: it is swapped, and so has the same normal in a manifold of its own.
        self.assertEqual([[point["impulse"]["normal"] for point in manifold["points"]]
                          for manifold in frame["pairs"][0]["manifolds"]], [[1, 2], [3]])
        self.assertEqual(frame["pairs"][0]["manifolds"][1]["normal"], [0, 1, 0])

    def test_trimesh(self):
        corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
        with Recorder("run.jsonl", "mine/mesh") as recorder:
            add_trimesh(recorder, "faces", SimpleNamespace(vertices=corners, faces=faces))
            add_trimesh(recorder, "flat", SimpleNamespace(vertices=sum(corners, []), indices=sum(faces, [])))
            add_trimesh(recorder, "hull", SimpleNamespace(vertices=corners, faces=faces), hull=True)
            with self.assertRaisesRegex(TypeError, "neither faces, triangles nor indices"):
                add_trimesh(recorder, "none", SimpleNamespace(vertices=corners))
        shapes = self.frames_of("run.jsonl")[0]["shapes"]
        self.assertEqual(shapes["faces"], shapes["flat"])
        self.assertEqual((shapes["faces"]["type"], shapes["faces"]["faces"]), ("mesh", faces))
        self.assertEqual((shapes["hull"]["type"], shapes["hull"]["vertices"]), ("hull", corners))


def crate_falls(path, x=0.0, normal=1, frames=4):
    """Frames of a crate on a plane, 20 mm deep."""
    recorder = Recorder(path, "mine/stack", "test", "1.0")
    ground, crate = recorder.plane("ground", (0, 1, 0), 0), None
    for i in range(frames):
        with recorder.frame(i / 60):
            if crate is None:
                crate = recorder.box("crate", 0.5, 0.5, 0.5)
            recorder.pose(ground, (0, 0, 0))
            recorder.pose(crate, (x, 0.48, 0))
            recorder.manifold(ground, crate, (0, normal, 0),
                              [Point((x + 0.5 * i, 0, 0.5 * k), -0.02) for i in (-1, 1) for k in (-1, 1)])
    recorder.stop()
    return recorder


@unittest.skipUnless(program_of("CONTACTSCOPE"), "the program is not built")
class ProgramTest(InAFolder):
    def test_lint_returns_findings(self):
        crate_falls("right.jsonl")
        self.assertEqual(lint("right.jsonl"), [])
        finding, = lint(crate_falls("wrong.jsonl", normal=-1))
        self.assertEqual((finding.cause, finding.count, finding.of), ("flipped_normals", 4, 4))
        self.assertEqual((finding.frame, finding.a, finding.b), (0, "ground", "crate"))
        self.assertEqual(finding.marks[3], (3, "ground", "crate"))
        self.assertIn("negate each normal", str(finding))
        self.assertEqual(lint("wrong.jsonl", ignore=["flipped_normals", "separation"]), [])

    def test_a_frame_is_a_picture(self):
        picture = render(crate_falls("run.jsonl"), size="640x360")
        data = picture._repr_png_()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (640, 360))
        self.assertIn("<svg", picture._repr_svg_()[:500])
        self.assertIsNone(picture._repr_html_())
        self.assertEqual(read(picture.save("a.png")), data)
        self.assertEqual(read(render("run.jsonl", 3, size="640x360").save("b.png")), data)  # the last is the default
        self.assertEqual(read(render("run.jsonl").save("c.pdf"))[:5], b"%PDF-")
        with self.assertRaisesRegex(ValueError, "does not end with .png"):
            picture.save("a.gif")

    def test_frames_are_a_page(self):
        pages = [render(crate_falls("run.jsonl"), (1, 2)), render("run.jsonl", "all", viewer=True)]
        for page in pages:
            self.assertIsNone(page._repr_png_())
            self.assertIsNone(page._repr_svg_())
            self.assertTrue(page._repr_html_().startswith("<iframe"))
            self.assertIn("<!doctype html", page.html()[:200].lower())
        self.assertIn(b"acTL", pages[0].png()[:200])  # animated

    def test_errors_are_those_of_the_program(self):
        with open("bad.jsonl", "w", encoding="utf-8") as file:
            file.write('{"schema":"contactscope.trace/1","scenario":\n')
        for call in (lambda: lint("bad.jsonl"), lambda: assert_manifold("bad.jsonl", "a/b", update=True)):
            with self.assertRaisesRegex(ProgramError, r"bad\.jsonl:1:"):
                call()
        with self.assertRaisesRegex(ProgramError, "colour"):
            render(crate_falls("run.jsonl"), colour="red").png()
        os.environ["CONTACTSCOPE"] = ""
        os.environ["PATH"] = "/nowhere"
        with self.assertRaisesRegex(FileNotFoundError, "set CONTACTSCOPE"):
            lint("run.jsonl")

    def test_a_frame_is_compared_with_its_snapshot(self):
        recorder = crate_falls("run.jsonl")
        missing = "no snapshot at .*snapshots/stack/frame_2/trace.jsonl; run the test once with"
        with self.assertRaisesRegex(AssertionError, missing):
            assert_manifold(recorder, "stack/frame_2", frame=2)
        self.assertFalse(os.path.exists("snapshots"))
        os.environ["CONTACTSCOPE_UPDATE"] = "1"
        _, said = quiet(assert_manifold, recorder, "stack/frame_2", frame=2)
        self.assertIn("wrote", said)
        del os.environ["CONTACTSCOPE_UPDATE"]
        stored = self.frames_of("snapshots/stack/frame_2/trace.jsonl")
        self.assertEqual([line["frame"] for line in stored[1:]], [2])
        self.assertEqual(sorted(stored[0]["shapes"]), ["crate", "ground"])  # one of them comes in frame 0
        assert_manifold("run.jsonl", "stack/frame_2", frame=2)

        moved = crate_falls("moved.jsonl", x=0.01)
        with self.assertRaises(AssertionError) as failure:
            assert_manifold(moved, "stack/frame_2", frame=2)
        said = str(failure.exception)
        self.assertRegex(said, "stack/frame_2 frame 2, crate: moved 10 mm along x; so 4 points changed")
        self.assertIn("CONTACTSCOPE_UPDATE=1", said)
        for which in ("expected", "actual", "difference"):
            picture = os.path.abspath(f"out/check/stack/frame_2/frame_0002.{which}.png")
            self.assertEqual(read(picture)[:4], b"\x89PNG")
        self.assertIn(picture, said)
        stem = picture[:-len("difference.png")]
        self.assertNotEqual(read(stem + "actual.png"), read(stem + "expected.png"))

        before = read("snapshots/stack/frame_2/trace.jsonl")
        os.environ.update(CI="true", CONTACTSCOPE_UPDATE="1")
        with self.assertRaisesRegex(AssertionError, "CI is set, so nothing is written"):
            assert_manifold(moved, "stack/frame_2", frame=2)
        self.assertEqual(read("snapshots/stack/frame_2/trace.jsonl"), before)
        del os.environ["CI"], os.environ["CONTACTSCOPE_UPDATE"]
        quiet(assert_manifold, moved, "stack/frame_2", frame=2, update=True)
        assert_manifold(moved, "stack/frame_2", frame=2)

    def test_a_whole_trace_is_compared(self):
        quiet(assert_manifold, crate_falls("run.jsonl"), "stack/all", update=True, snapshots="elsewhere")
        os.environ["CONTACTSCOPE_SNAPSHOTS"] = "elsewhere"
        assert_manifold("run.jsonl", "stack/all")
        with self.assertRaisesRegex(AssertionError, "ground-crate"):
            assert_manifold(crate_falls("flipped.jsonl", normal=-1), "stack/all", pictures=False)

    def test_manifolds_alone_are_drawn_on_stand_ins(self):
        def patch(count, x=0.0):
            places = [(x - 0.5, 0, -0.5), (0.5, 0, -0.5), (0.5, 0, 0.5), (-0.5, 0, 0.5)][:count]
            return Manifold((0, 1, 0), [Point(place, -0.01, id=i) for i, place in enumerate(places)])

        for count in (1, 2, 4):
            name = f"patch/of_{count}"
            quiet(assert_manifold, patch(count), name, update=True)
            assert_manifold([patch(count)], name)
            with self.assertRaisesRegex(AssertionError, "point 0 moved 1 mm along -x"):
                assert_manifold(patch(count, -0.001), name, pictures=False)
            self.assertFalse(os.path.exists("out"))
            quiet(assert_manifold, patch(count, -0.001), name, update=True)
            assert_manifold(patch(count, -0.001), name)
        shapes = self.frames_of("snapshots/patch/of_4/trace.jsonl")[0]["shapes"]
        self.assertEqual(sorted(shapes["b"]["vertices"])[0], [-0.501, 0, -0.5])  # of what was stored last
        with self.assertRaisesRegex(AssertionError, "patch/of_4 frame 0.*\nsee .*difference.png"):
            assert_manifold([], "patch/of_4")

    def test_the_stand_in_is_the_outline_of_the_points(self):
        places = [(0, 0, 0), (1, 0, 0), (0.5, 0, 0), (1, 0, 1), (0.4, 0, 0.6), (0, 0, 1), (0, 0, 0.25)]
        for turn in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):  # the plane's normal along each axis
            normal = [(0, -1, 0)[k] for k in turn]
            points = [Point([place[k] for k in turn], 0) for place in places]
            quiet(assert_manifold, Manifold(normal, points), "patch/outline", update=True)
            plane, outline = (self.frames_of("snapshots/patch/outline/trace.jsonl")[0]["shapes"][name] for name in "ab")
            self.assertEqual(plane["half_space"], {"normal": normal, "offset": 0})
            corners = outline["vertices"]
            self.assertEqual(sorted(corners), sorted([place[k] for k in turn] for i, place in enumerate(places)
                                                     if i in (0, 1, 3, 5)))
            for i in range(4):  # neighbours are an edge of the square
                self.assertEqual(sum(abs(p - q) for p, q in zip(corners[i - 1], corners[i])), 1)

    def test_what_cannot_be_a_snapshot(self):
        with self.assertRaisesRegex(ValueError, "GROUP/IDEA"):
            assert_manifold(crate_falls("run.jsonl"), "stack")
        with self.assertRaisesRegex(ValueError, "has no frame 9; its frames are 0 to 3"):
            assert_manifold("run.jsonl", "stack/nine", frame=9, update=True)


class DocumentsTest(unittest.TestCase):
    def test_the_samples_of_the_document_are_python(self):
        with open(os.path.join(HERE, "..", "..", "src", "recorder", "README.md"), encoding="utf-8") as file:
            blocks = re.findall(r"(?:^(?:    .*)?\n)+", file.read(), re.M)
        samples = [textwrap.dedent(block) for block in blocks if "from contactscope import" in block]
        self.assertEqual(len(samples), 3)
        for sample in samples:
            for node in ast.walk(ast.parse(sample)):
                if isinstance(node, ast.ImportFrom):
                    self.assertEqual([one.name for one in node.names if not hasattr(contactscope, one.name)], [])

    def test_every_public_name_is_documented(self):
        public = [value for name, value in vars(contactscope).items()
                  if not name.startswith("_") and getattr(value, "__module__", None) == "contactscope"
                  and isinstance(value, (type, types.FunctionType))]
        self.assertGreater(len(public), 10)
        for value in public:
            self.assertTrue(value.__doc__ and len(value.__doc__) > 30, value.__name__)


if __name__ == "__main__":
    unittest.main()
