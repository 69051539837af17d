"""Tests of contactscope-import: poses and sizes that MuJoCo 3.14.0 computed (import/poses.json), links by hand, and errors.

    CONTACTSCOPE=build/release/contactscope python3 tests/scenario/import_test.py
"""

import base64
import json
import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

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


def product(a, b):
    return [[sum(a[r][k] * b[k][c] for k in range(4)) for c in range(4)] for r in range(4)]


def affine(random_of):
    """A rotation, a scale that may mirror, and a displacement, as a matrix of four rows."""
    axis = [random_of.gauss(0, 1) for _ in range(3)]
    length, angle = math.sqrt(sum(x * x for x in axis)), random_of.uniform(0, 3)
    x, y, z = (value / length for value in axis)
    c, s, d = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    turn = [[c + x * x * d, x * y * d - z * s, x * z * d + y * s], [y * x * d + z * s, c + y * y * d, y * z * d - x * s], [z * x * d - y * s, z * y * d + x * s, c + z * z * d]]
    scale = [random_of.choice((-1, 1)) * random_of.uniform(0.5, 2) for _ in range(3)]
    return [[turn[r][k] * scale[k] for k in range(3)] + [random_of.uniform(-3, 3)] for r in range(3)] + [[0, 0, 0, 1]]


WEDGE = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


class Scenes(unittest.TestCase):
    """A wedge in two nested nodes of each format: its vertices in the world are the product of the matrices."""

    def write(self, folder, outer, inner, ending):
        path = os.path.join(folder, "wedge" + ending)
        if ending == ".dae":
            rows = lambda m: " ".join(repr(x) for row in m for x in row)
            text = f"""<COLLADA><asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array>{" ".join(str(x) for v in WEDGE for x in v)}</float_array>
<technique_common><accessor stride="3"/></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<polylist><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/><vcount>3 3 3 3</vcount>
<p>{" ".join(f"{i} 0" for face in FACES for i in face)}</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node name="outer"><matrix>{rows(outer)}</matrix><node name="wedge"><matrix>{rows(inner)}</matrix>
<instance_geometry url="#g"/></node></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>"""
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        elif ending == ".3mf":
            columns = lambda m: " ".join(repr(m[r][c]) for c in range(4) for r in range(3))
            text = f"""<model unit="centimeter" xmlns="m"><resources><object id="1"><mesh><vertices>
{"".join(f'<vertex x="{v[0]}" y="{v[1]}" z="{v[2]}"/>' for v in WEDGE)}</vertices><triangles>
{"".join(f'<triangle v1="{f[0]}" v2="{f[1]}" v3="{f[2]}"/>' for f in FACES)}</triangles></mesh></object>
<object id="2"><components><component objectid="1" transform="{columns(inner)}"/></components></object></resources>
<build><item objectid="2" transform="{columns(outer)}"/></build></model>"""
            with zipfile.ZipFile(path, "w") as archive:
                archive.writestr("3D/3dmodel.model", text)
        else:
            column_major = lambda m: [m[r][c] for c in range(4) for r in range(4)]
            data = struct.pack("<12H", *(i for face in FACES for i in face)) + struct.pack("<12f", *(x for v in WEDGE for x in v))
            scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                     "nodes": [{"matrix": column_major(outer), "children": [1]}, {"name": "wedge", "matrix": column_major(inner), "mesh": 0}],
                     "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
                     "accessors": [{"bufferView": 0, "componentType": 5123, "count": 12, "type": "SCALAR"},
                                   {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"}],
                     "bufferViews": [{"buffer": 0, "byteLength": 24}, {"buffer": 0, "byteOffset": 24, "byteLength": 48}],
                     "buffers": [{"byteLength": len(data)}]}
            if ending == ".gltf":
                scene["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
                with open(path, "w", encoding="utf-8") as file:
                    json.dump(scene, file)
            else:
                text = json.dumps(scene).encode()
                text += b" " * (-len(text) % 4)
                with open(path, "wb") as file:
                    file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
                    file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)
        return path

    def test_meshes_are_where_the_nodes_put_them_and_face_outwards(self):
        for seed, ending in enumerate((".dae", ".3mf", ".gltf", ".glb") * 3):
            random_of = random.Random(seed)
            outer, inner = affine(random_of), affine(random_of)
            metre = 0.01 if ending in (".dae", ".3mf") else 1
            right = [[metre * sum(row[k] * (*v, 1)[k] for k in range(4)) for row in product(outer, inner)[:3]] for v in WEDGE]
            with tempfile.TemporaryDirectory() as folder:
                run = imported(self.write(folder, outer, inner, ending), "--mesh")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn('up = "z"' if ending in (".dae", ".3mf") else 'up = "y"', run.stdout)
            (shape,) = shapes_of(run.stdout).values()
            self.assertEqual(shape["type"], "mesh")
            flat = shape["keys"]["vertices"]
            mine = [in_world(shape, flat[i:i + 3]) for i in range(0, 12, 3)]
            order = [min(range(4), key=lambda k: math.dist(mine[k], v)) for v in right]
            for k, v in zip(order, right):
                self.assertLess(math.dist(mine[k], v), 1e-9 * metre + 1e-15, ending)
            self.assertEqual(sorted(order), [0, 1, 2, 3])
            corners = [int(i) for i in shape["keys"]["triangles"]]
            self.assertEqual(len(corners), 12)
            middle = [sum(v[i] for v in mine) / 4 for i in range(3)]
            for i in range(0, 12, 3):
                a, b, c = (mine[k] for k in corners[i:i + 3])
                u, w, out = ([q[n] - p[n] for n in range(3)] for p, q in ((a, b), (a, c), (middle, a)))
                normal = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
                self.assertGreater(sum(x * y for x, y in zip(normal, out)), 0, ending)

    def test_a_concave_polygon_is_cut_inside(self):
        chevron = [(0, 0), (2, 1), (4, 0), (2, 3)]
        with tempfile.TemporaryDirectory() as folder:
            path = self.write(folder, affine(random.Random(1)), affine(random.Random(2)), ".dae")
            with open(path, encoding="utf-8") as file:
                text = file.read()
            text = re.sub(r"<float_array>.*?</float_array>", "<float_array>" + " ".join(f"{x} {y} 0" for x, y in chevron) + "</float_array>", text)
            text = re.sub(r"<vcount>.*?</p>", "<vcount>4</vcount><p>0 0 1 0 2 0 3 0</p>", text, flags=re.DOTALL)
            text = re.sub(r"<matrix>.*?</matrix>", "", text)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            run = imported(path)
        self.assertEqual(run.returncode, 0, run.stderr)
        (shape,) = shapes_of(run.stdout).values()
        self.assertEqual(shape["type"], "mesh")
        flat, corners = shape["keys"]["vertices"], [int(i) for i in shape["keys"]["triangles"]]
        area = 0
        for i in range(0, len(corners), 3):
            a, b, c = (flat[3 * k:3 * k + 2] for k in corners[i:i + 3])
            area += abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
        self.assertAlmostEqual(area, 4e-4, 12)

    def test_of_several_parts_each_is_its_hull_unless_it_is_flat(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = [[float(r == c) for c in range(4)] for r in range(4)]
            path = self.write(folder, unit, unit, ".gltf")
            with open(path, encoding="utf-8") as file:
                scene = json.load(file)
            scene["nodes"].append({"name": "sheet", "mesh": 0, "scale": [1, 1, 0]})
            scene["scenes"][0]["nodes"].append(2)
            with open(path, "w", encoding="utf-8") as file:
                json.dump(scene, file)
            run = imported(path)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual({name: shape["type"] for name, shape in shapes_of(run.stdout).items()}, {"wedge": "hull", "sheet": "mesh"})
        self.assertIn("'sheet' is flat", run.stderr)
        self.assertEqual(pairs_of(run.stdout), {frozenset(("wedge", "sheet"))})

    def test_a_link_may_have_such_a_mesh(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = [[float(r == c) for c in range(4)] for r in range(4)]
            self.write(folder, unit, unit, ".dae")
            model = os.path.join(folder, "a.urdf")
            with open(model, "w", encoding="utf-8") as file:
                file.write('<robot name="r"><link name="l"><collision><geometry><mesh filename="wedge.dae"/></geometry></collision></link></robot>')
            run = imported(model)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertAlmostEqual(max(shapes_of(run.stdout)["l"]["keys"]["vertices"]), 0.03, 12)

    def test_damaged_ones_are_refused(self):
        for ending in (".dae", ".3mf", ".gltf", ".glb"):
            with tempfile.TemporaryDirectory() as folder:
                path = self.write(folder, affine(random.Random(1)), affine(random.Random(2)), ending)
                with open(path, "rb") as file:
                    data = file.read()
                random_of = random.Random(ending)
                for _ in range(12):
                    damaged = bytearray(data[:random_of.randrange(len(data))] if random_of.random() < 0.5 else data)
                    for _ in range(random_of.randrange(4)):
                        if damaged:
                            damaged[random_of.randrange(len(damaged))] = random_of.randrange(256)
                    with open(path, "wb") as file:
                        file.write(damaged)
                    run = imported(path)
                    self.assertIn(run.returncode, (0, 2), run.stderr)
                    self.assertNotIn("Traceback", run.stderr)
                    self.assertEqual(run.stdout == "", run.returncode == 2)

    def test_files_elsewhere_are_not_opened(self):
        for uri in ("https://example.org/a.bin", "/etc/passwd", "../a.bin", "%2e%2e/a.bin"):
            with tempfile.TemporaryDirectory() as folder:
                path = self.write(folder, affine(random.Random(1)), affine(random.Random(2)), ".gltf")
                with open(path, encoding="utf-8") as file:
                    scene = json.load(file)
                scene["buffers"][0]["uri"] = uri
                with open(path, "w", encoding="utf-8") as file:
                    json.dump(scene, file)
                run = imported(path)
            self.assertEqual(run.returncode, 2)
            self.assertIn("which is not in its folder", run.stderr)


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

    def test_a_scene_of_meshes_is_a_scenario(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = [[float(r == c) for c in range(4)] for r in range(4)]
            for ending in (".dae", ".3mf", ".gltf", ".glb"):
                trace = self.run_program("trace", Scenes().write(folder, unit, unit, ending))
                self.assertEqual(trace.returncode, 0, trace.stderr)
                (shape,) = json.loads(trace.stdout.splitlines()[0])["shapes"].values()
                self.assertEqual((shape["type"], len(shape["vertices"]), len(shape["faces"])), ("mesh", 4, 4))

    def test_everything_that_is_read_is_a_valid_scenario(self):
        trace = self.run_program("trace", os.path.join(MODELS, "spellings.xml"))
        self.assertEqual(trace.returncode, 0, trace.stderr)
        self.assertIn("an ellipsoid is the hull", trace.stderr)

    def test_a_scene_that_is_cut_off_is_refused_by_every_verb(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, data, said in (("a.glb", b"glTF\2\0\0\0", "it is cut off"), ("a.gltf", b'{"asset": {"version": "2.0"}}', "it has no triangle"),
                                     ("a.3mf", b"PK\3\4", "this is no 3MF"), ("a.dae", b"<COLLADA>\n<x", "this is not valid XML")):
                path = os.path.join(folder, name)
                with open(path, "wb") as file:
                    file.write(data)
                for verb in ("import", "trace", "check", "render", "lint"):
                    run = self.run_program(verb, path)
                    self.assertEqual(run.returncode, 2)
                    self.assertIn(f"{path}:{2 if name == 'a.dae' else 1}:1: {said}", run.stdout + run.stderr)

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
