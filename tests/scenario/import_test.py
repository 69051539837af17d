"""Tests of contactscope-import: poses and sizes that MuJoCo 3.14.0 computed (import/poses.json), links by hand, and errors.

    CONTACTSCOPE=build/release/contactscope python3 tests/scenario/import_test.py
"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = os.path.join(HERE, "..", "..", "src", "scenario", "import", "contactscope-import")
MODELS = os.path.join(HERE, "import")
CONTACTSCOPE = os.environ.get("CONTACTSCOPE")


def imported(*arguments):
    return subprocess.run([sys.executable, PROGRAM, *arguments], capture_output=True, text=True)


def numbers(text):
    return [float(word) for word in re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)]


def shapes_of(text):
    """The shapes of a scenario by name: type, position, matrix, and the numbers of each key."""
    shapes = {}
    for name, body in re.findall(r'\[shapes\."([^"]+)"\]\n(.*?)(?=\n\[|\Z)', text, re.DOTALL):
        keys = dict(re.findall(r"^(\w+) = (.*?)(?=\n\w+ = |\Z)", body, re.DOTALL | re.MULTILINE))
        w, x, y, z = numbers(keys["rotation"].partition("=")[2]) if "rotation" in keys else (1, 0, 0, 0)
        matrix = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                  2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                  2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
        shapes[name] = {"type": keys["type"].strip('"'), "position": numbers(keys["position"]) if "position" in keys else [0, 0, 0],
                        "matrix": matrix, "keys": {key: numbers(value) for key, value in keys.items()}}
    return shapes


def pairs_of(text):
    return {frozenset(pair) for pair in re.findall(r'\[\[pairs\]\]\na = "([^"]+)"\nb = "([^"]+)"', text)}


def in_world(shape, point):
    return [shape["position"][i] + sum(shape["matrix"][3 * i + k] * point[k] for k in range(3)) for i in range(3)]


class OfMujoco(unittest.TestCase):
    def near(self, mine, theirs, what, within=1e-9):
        self.assertEqual(len(mine), len(theirs), what)
        for a, b in zip(mine, theirs):
            self.assertLess(abs(a - b), within, what)

    def test_poses_and_sizes_are_those_of_mujoco(self):
        kPlane, kField, kSphere, kCapsule, kEllipsoid, kCylinder, kBox, kMesh = range(8)
        with open(os.path.join(MODELS, "poses.json"), encoding="utf-8") as file:
            expected = json.load(file)
        for key, geoms in expected.items():
            run = imported(os.path.join(MODELS, "spellings.xml"), "--visual", *(["--keyframe", key] if key else []))
            self.assertEqual(run.returncode, 0, run.stderr)
            shapes = shapes_of(run.stdout)
            self.assertEqual(list(shapes), [geom["name"] for geom in geoms])
            for geom in geoms:
                shape, what = shapes[geom["name"]], f"{key} {geom['name']}"
                keys, size, kind = shape["keys"], geom["size"], geom["type"]
                columns = [[m[k::3] for k in range(3)] for m in (shape["matrix"], geom["matrix"])]
                if kind == kMesh:
                    points = keys["vertices"]
                    mine = [in_world(shape, points[i:i + 3]) for i in range(0, len(points), 3)]
                    self.assertEqual(len(mine), len(geom["vertices"]), what)
                    for vertex in geom["vertices"]:  # MuJoCo stores them in single precision
                        self.assertLess(min(math.dist(vertex, other) for other in mine), 1e-6, what)
                    continue
                self.near(shape["position"], geom["position"], what)
                if kind == kCylinder:
                    self.near(columns[0][1], columns[1][2], what)
                    self.near([keys["radius"][0], keys["half_height"][0]], size[:2], what)
                elif kind == kCapsule:
                    self.near(columns[0][2], columns[1][2], what)
                    self.near([keys["radius"][0], keys["points"][5]], size[:2], what)
                elif kind == kSphere:
                    self.near(keys["radius"], size[:1], what)
                else:
                    self.near(shape["matrix"], geom["matrix"], what)
                if kind == kBox:
                    self.near(keys["half_extents"], size, what)
                if kind == kEllipsoid:
                    self.near([max(keys["vertices"][k::3]) for k in range(3)], size, what)
                if kind == kField:
                    self.near(keys["vertices"][2::3], geom["heights"], what, 1e-7)

    def test_pairs_are_those_that_mujoco_tests_and_are_near(self):
        run = imported(os.path.join(MODELS, "spellings.xml"))
        pairs = pairs_of(run.stdout)
        self.assertIn("left out; --visual reads them", run.stderr)  # the sign touches nothing
        self.assertNotIn("sign", shapes_of(run.stdout))
        for one, other in (("thin", "thick"), ("thin", "upper"), ("thin", "can"), ("floor", "post")):
            self.assertNotIn(frozenset((one, other)), pairs)  # a body, its parent, excluded, both static
        self.assertNotIn(frozenset(("floor", "egg")), pairs)  # far


class OfLinks(unittest.TestCase):
    def test_urdf_places_its_links_by_joints(self):
        run = imported(os.path.join(MODELS, "arm.urdf"), "--joint", f"turn={math.pi / 2}", "--joint", "lift=0.2")
        self.assertEqual(run.returncode, 0, run.stderr)
        shapes = shapes_of(run.stdout)
        self.assertEqual([shape["type"] for shape in shapes.values()], ["box", "cylinder", "sphere"])
        self.assertEqual(shapes["base"]["keys"]["half_extents"], [0.2, 0.2, 0.05])
        for mine, right in zip(shapes["tube"]["position"] + shapes["lower"]["position"], [0, 0, 0.3, 0, 0.1, 0.75]):
            self.assertAlmostEqual(mine, right, 12)
        for mine, right in zip(shapes["tube"]["matrix"][1::3], [0, 0, 1]):  # the axis of a cylinder is y here
            self.assertAlmostEqual(mine, right, 12)
        self.assertEqual(pairs_of(run.stdout), set())  # joined links do not touch

    def test_sdf_places_collisions_in_links_in_models(self):
        run = imported(os.path.join(MODELS, "table.sdf"))
        self.assertEqual(run.returncode, 0, run.stderr)
        shapes = shapes_of(run.stdout)
        for mine, right in zip(shapes["top plate"]["position"] + shapes["leg tube"]["position"], [1, 0, 0.7, 1, 0.4, 0.34]):
            self.assertAlmostEqual(mine, right, 12)
        self.assertEqual(pairs_of(run.stdout), {frozenset(("top plate", "leg tube"))})

    def test_meshes_are_found_and_scaled(self):
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "robot", "urdf"))
            with open(os.path.join(folder, "robot", "wedge.obj"), "w", encoding="utf-8") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
            model = os.path.join(folder, "robot", "urdf", "a.urdf")
            text = '<robot name="r"><link name="l"><collision><geometry><mesh filename="{}" {}/></geometry></collision></link></robot>'
            for uri, scale, key, count in (("package://robot/wedge.obj", "", "file", 0), ("../wedge.obj", 'scale="2 2 2"', "vertices", 12)):
                with open(model, "w", encoding="utf-8") as file:
                    file.write(text.format(uri, scale))
                run = imported(model)
                self.assertEqual(run.returncode, 0, run.stderr)
                shape = shapes_of(run.stdout)["l"]
                self.assertEqual(shape["type"], "hull")
                self.assertIn(key, shape["keys"])
                if count:
                    self.assertEqual(max(shape["keys"]["vertices"]), 2)
                    self.assertEqual(len(shape["keys"]["vertices"]), count)


class Refused(unittest.TestCase):
    def refused(self, text, message, name="bad.xml"):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            run = imported(path)
            self.assertEqual(run.returncode, 2, run.stdout)
            self.assertEqual(run.stdout, "")
            self.assertTrue(run.stderr.startswith(path + ":"), run.stderr)
            self.assertIn(message, run.stderr)
            self.assertNotIn("Traceback", run.stderr)

    def test_bad_models_name_the_line_and_the_remedy(self):
        def world(text):
            return f"<mujoco>\n<worldbody>\n{text}\n</worldbody></mujoco>"

        self.refused("<mujoco>\n<worldbody>", ":2:1: this is not valid XML")
        self.refused(world('<geom type="bx" size="1 1 1"/>'), ":3:1: 'type' of <geom> is 'bx'; it may be plane")
        self.refused(world('<geom type="box" size="1 1"/>'), "'size' of a box has 3 positive numbers")
        self.refused(world('<geom size="1" pos="1 x 3"/>'), ":3:1: 'pos' of <geom> is '1 x 3'; write 3 numbers")
        self.refused(world('<geom size="1" pos="1 nan 3"/>'), "is not finite")
        self.refused(world('<geom size="1" quat="1 0 0 0" euler="1 2 3"/>'), "has 'quat' and 'euler'; leave one of them out")
        self.refused(world('<geom type="mesh" mesh="cup"/>'), "there is no mesh 'cup' in <asset>")
        self.refused(world('<geom class="cls" size="1"/>'), "there is no default class 'cls'")
        self.refused('<mujoco><include file="bad.xml"/></mujoco>', "'bad.xml' includes itself")
        self.refused('<mujoco><include file="gone.xml"/></mujoco>', "gone.xml': it cannot be read")
        self.refused("<mujoco/>", "has no shape that can touch another")
        self.refused("<page/>", "the root is <page>; a model has <mujoco>, <robot> or <sdf>")
        self.refused('<robot name="r"><joint name="j"><parent link="a"/><child link="b"/></joint></robot>', "names the link 'a', which is not there", "r.urdf")

    def test_entities_are_refused_before_they_grow_or_read_files(self):
        bomb = '<!DOCTYPE r [<!ENTITY a "aaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]>\n<mujoco>&b;</mujoco>'
        self.refused(bomb, "entities is not read")
        self.refused('<!DOCTYPE r [<!ENTITY a SYSTEM "/etc/passwd">]>\n<mujoco>&a;</mujoco>', "entities is not read")


@unittest.skipUnless(CONTACTSCOPE, "set CONTACTSCOPE to the program")
class OfTheProgram(unittest.TestCase):
    def run_program(self, *arguments):
        return subprocess.run([CONTACTSCOPE, *arguments], capture_output=True, text=True)

    def test_a_model_is_a_scenario(self):
        model = os.path.join(MODELS, "table.sdf")
        printed, trace = self.run_program("import", model), self.run_program("trace", model)
        self.assertEqual((printed.returncode, trace.returncode), (0, 0), trace.stderr)
        self.assertEqual(printed.stdout, imported(model).stdout)
        lines = [json.loads(line) for line in trace.stdout.splitlines()]
        self.assertEqual(set(lines[0]["shapes"]), {"top plate", "leg tube"})
        self.assertEqual(lines[1]["pairs"][0]["state"], "touching")

    def test_everything_that_is_read_is_a_valid_scenario(self):
        trace = self.run_program("trace", os.path.join(MODELS, "spellings.xml"))
        self.assertEqual(trace.returncode, 0, trace.stderr)
        self.assertIn("an ellipsoid is the hull", trace.stderr)

    def test_errors_are_those_of_the_importer(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bad.urdf")
            with open(path, "w", encoding="utf-8") as file:
                file.write('<robot name="r">\n<link name="a"><collision/></link></robot>')
            for verb in ("import", "trace", "render"):
                run = self.run_program(verb, path)
                self.assertEqual(run.returncode, 2)
                self.assertIn(path + ":2:1: a <collision> needs a <geometry> with a shape", run.stderr)


if __name__ == "__main__":
    unittest.main()
