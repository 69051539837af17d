// The recorders in Python and in JavaScript: what they say of wrong arguments, and what only they accept.

#include "scripts.h"

#include <sstream>

#include "trace/json.h"

namespace contactscope {
namespace {

trace::Trace read(const std::string& file) {
  std::istringstream in(read_text(file));
  return trace::read_trace(in, file);
}

TEST_P(Scripts, SayWhatIsWrong) {
  struct Case {
    const char *py, *js;  ///< "" where the language has no such case
    const char *said_py, *said_js;
  };
  const Case cases[] = {
      {"r.pose(ball, (0, 0, 0))", "r.pose(ball, [0, 0, 0])",
       "no frame has begun; call begin_frame(time) first",
       "no frame has begun; call beginFrame(time) first"},
      {"r.begin_frame(0); r.pose(7, (0, 0, 0))", "r.beginFrame(0); r.pose(7, [0, 0, 0])",
       "there is no shape 7; pass the number", "there is no shape 7; pass the number"},
      {"r.begin_frame(0); r.pose(ball, (0, 0))", "r.beginFrame(0); r.pose(ball, [0, 0])",
       "position has 2 numbers, not 3", "position has 2 numbers, not 3"},
      {"r.begin_frame(0); r.manifold(ball, ball, (0, 1, 0), [])",
       "r.beginFrame(0); r.manifold(ball, ball, [0, 1, 0], [])", "a manifold is of two shapes",
       "a manifold is of two shapes"},
      {"r.begin_frame(0); r.manifold(ball, other, (0, 1, 0), [Point((0, 0, 0), 0, on_a=(0, 0, "
       "0))])",
       "r.beginFrame(0); r.manifold(ball, other, [0, 1, 0], [{position: [0, 0, 0], separation: 0, "
       "onA: [0, 0, 0]}])",
       "on_a and on_b, or none", "onA and onB, or none"},
      {"r.mesh('m', [(0, 0, 0)], [(0, 1, 2)])", "r.mesh('m', [[0, 0, 0]], [[0, 1, 2]])",
       "not three indices of its 1 vertices", "not three indices of its 1 vertices"},
      {"r.cone('c', 3, 1, 1)", "r.cone('c', 3, 1, 1)", "axis 3 is not 0, 1 or 2",
       "axis 3 is not 0, 1 or 2"},
      {"Recorder('x.jsonl', 'a/b', poses_at='later')",
       "new Recorder('x.jsonl', 'a/b', {posesAt: 'later'})", "write 'contacts', 'before_step'",
       "pass \"contacts\", \"before_step\""},
      // Without types and keyword arguments, mistakes that Python finds by itself.
      {"", "new Recorder('x.jsonl', 'a/b', {poses_at: 'contacts'})", "",
       "options: there is no key \"poses_at\"; the keys are engine, version, doubles"},
      {"", "new Recorder('x.jsonl', {engine: 'e'})", "", "scenario is an object with engine; pass"},
      {"", "new Recorder(7, 'a/b')", "", "the target is 7; pass a file name, or an object with"},
      {"", "r.sphere('s')", "", "radius is undefined; pass a number"},
      {"", "r.sphere('s', '1')", "", "radius is \"1\"; pass a number"},
      {"", "r.hull('h', [0, 0, 0, 1])", "", "vertices: 4 numbers are not three for each"},
      {"", "r.hull('h', [[0, 0, undefined]])", "", "a number of vertex is undefined"},
      {"", "r.heightField('h', [[1, 2], [3]], 1)", "", "two or more rows of the same length"},
      {"", "r.beginFrame(0); r.pose(ball, {w: 1, x: 0, y: 0, z: 0})", "",
       "position has 4 numbers, not 3"},
      {"", "r.beginFrame(0); r.pose(ball, [0, 0, 0], {x: 0, y: 0, z: 0})", "",
       "quaternion has 3 numbers, not 4"},
      {"", "r.beginFrame(0); r.pose(ball, undefined)", "",
       "position is undefined; pass [x, y, z] or {x, y, z}"},
      {"", "r.beginFrame(0); r.manifold(ball, other, [0, 1, 0], [{position: [0, 0, 0]}])", "",
       "separation is undefined; pass a number"},
      {"", "r.beginFrame(0); r.manifold(ball, other, [0, 1, 0], [{position: [0, 0, 0], on_a: 1}])",
       "", "a point: there is no key \"on_a\"; the keys are position, separation, onA"},
      {"",
       "r.beginFrame(0); r.manifold(ball, other, [0, 1, 0], [{position: [0, 0, 0], separation: 0, "
       "id: 2 ** 60}])",
       "", "or a BigInt"},
      {"",
       "r.beginFrame(0); r.manifold(ball, other, [0, 1, 0], [{position: [0, 0, 0], separation: 0, "
       "id: -1}])",
       "", "id -1 is not within 0 to 2^64 - 1"},
      {"", "r.hull('h', {})", "", "vertices: an object with no keys is not a list; pass an array"},
      {"",
       "r.beginFrame(0); r.manifold(ball, other, [0, 1, 0], {position: [0, 0, 0], separation: 0})",
       "", "points: an object with position, separation is not a list; pass an array"},
      {"", "r.mesh('m', [0, 0, 0], [{a: 0, b: 0, c: 0}])", "",
       "a triangle: an object with a, b, c is not a list"},
      {"", "r.beginFrame(0); r.solver(4.5)", "", "iterations is 4.5; pass a whole number"},
      {"", "r.frame(0)", "", "frame(time, work) needs a function"},
      {"", "r.frame(0, async () => {})", "", "call beginFrame(time) and endFrame() around it"},
      {"", "r.stop(); r.beginFrame(1)", "", "the recording has stopped; make a new Recorder"}};
  std::string script;
  std::vector<std::pair<std::string, std::string>> expected;
  for (const Case& one : cases) {
    const std::string wrong = is_python() ? one.py : one.js;
    if (wrong.empty()) continue;
    expected.emplace_back(wrong, is_python() ? one.said_py : one.said_js);
    script +=
        is_python()
            ? "try:\n  with Recorder('run.jsonl', 'mine/stack') as r:\n    ball, other = "
              "r.sphere('ball', 1), r.sphere('other', 1)\n    " +
                  wrong + "\n  print('nothing')\nexcept ValueError as error:\n  print(error)\n"
            : "{\n  const r = new Recorder('run.jsonl', 'mine/stack');\n  const ball = "
              "r.sphere('ball', 1), other = r.sphere('other', 1);\n  try {\n    " +
                  wrong + ";\n    console.log('nothing');\n  } catch (error) {\n    if (!(error " +
                  "instanceof TypeError || error instanceof RangeError)) throw error;\n    " +
                  "console.log(error.message);\n  } finally {\n    r.stop();\n  }\n}\n";
  }
  std::istringstream said(output_of(script));
  for (const auto& [wrong, message] : expected) {
    std::string line;
    std::getline(said, line);
    EXPECT_NE(line.find(message), std::string::npos) << wrong << ": " << line;
  }
  // Earlier records are whole.
  EXPECT_EQ(read(folder_ / "run.jsonl").header.shapes.size(), 2u);
}

/// The example of the README, around an engine that does not move.
TEST_P(Scripts, TheExampleOfTheReadmeRuns) {
  const std::string import =
      is_python() ? "    from contactscope import" : "    import { Recorder }";
  std::istringstream readme(read_text(CONTACTSCOPE_SOURCE_DIR "/src/recorder/README.md"));
  std::string example, line;
  while (std::getline(readme, line) && !line.starts_with(import)) {
  }
  do {
    example += line.substr(std::min<std::size_t>(4, line.size())) + "\n";
  } while (std::getline(readme, line) && (line.empty() || line.starts_with("    ")));
  std::filesystem::copy_file(CONTACTSCOPE_SOURCE_DIR "/src/recorder/contactscope.mjs",
                             folder_ / "contactscope.mjs");
  const std::string values =
      is_python()
          ? "position, quaternion_wxyz = (0, 0.49, 0), (1, 0, 0, 0)\nplace, separation, "
            "newton_seconds = (0, 0, 0), -0.01, 2.5\n"
          : "const body = {position: {x: 0, y: 0.49, z: 0}, quaternion: {x: 0, y: 0, z: 0, "
            "w: 1}};\nconst place = {x: 0, y: 0, z: 0}, separation = -0.01, newtonSeconds = "
            "2.5;\n";
  const std::string file =
      folder_.write("example" + GetParam().ending, GetParam().path + values + example);
  EXPECT_EQ(printed_by(file), "");
  const trace::Trace trace = read(folder_ / "run.jsonl");
  ASSERT_EQ(trace.frames.size(), 60u);
  EXPECT_EQ(trace.header.engine, "my engine");
  const trace::Frame& last = trace.frames.back();
  EXPECT_DOUBLE_EQ(last.time, 59.0 / 60);
  ASSERT_EQ(last.poses.size(), 2u);
  EXPECT_EQ(last.poses[1].second.position, Vec3d(0, 0.49, 0));
  EXPECT_EQ(last.poses[1].second.rotation.coeffs(), Quatd::Identity().coeffs());
  const trace::Point& point = last.pairs.at(0).manifolds.at(0).points.at(0);
  EXPECT_EQ(point.separation, -0.01);
  EXPECT_EQ(point.impulse->normal, 2.5);
}

class ScriptsInJavaScript : public Scripts {};

/// Vertices and triangles in one typed array each are those in lists; an object with write() gets
/// what a file gets, each line at once, and stays open.
TEST_P(ScriptsInJavaScript, TakeTypedArraysAndWriteToObjects) {
  const std::string script = R"(
const record = (target, vertices, triangles, place, turn) => {
  const r = new Recorder(target, "mine/stack", { doubles: false });
  const mesh = r.mesh("mesh", vertices, triangles), hull = r.hull("hull", vertices);
  const sum = r.frame(0, () => {
    r.pose(mesh, place, turn);
    r.manifold(mesh, hull, place, [{ position: place, separation: 0.25, onA: null, impulse: undefined }], 1);
    return 7;
  });
  if (sum !== 7) throw new Error("frame() returns " + sum);
  r.stop();
  r.stop();
};
record("lists.jsonl", [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 2, 3]], [1, 2, 3], [0.5, -0.5, 0.5, -0.5]);
const lines = [], { writeFileSync } = await import("node:fs");
const sink = { write: (text) => lines.push(text), end: () => { throw new Error("it was closed"); } };
record(sink, Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1), Uint32Array.of(0, 1, 2, 0, 2, 3),
       { x: 1, y: 2, z: 3 }, { x: -0.5, y: 0.5, z: -0.5, w: 0.5 });
if (lines.length !== 2 || !lines.every((line) => line.endsWith("}\n"))) throw new Error(lines.join("|"));
writeFileSync("objects.jsonl", lines.join(""));
record(new URL("file://" + process.cwd() + "/url.jsonl"), [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
       [Uint16Array.of(0, 1, 2), [0, 2, 3]], new Float64Array([1, 2, 3]), [0.5, -0.5, 0.5, -0.5]);
)";
  EXPECT_EQ(output_of(script), "");
  const std::string lists = read_text(folder_ / "lists.jsonl");
  EXPECT_EQ(read_text(folder_ / "objects.jsonl"), lists);
  EXPECT_EQ(read_text(folder_ / "url.jsonl"), lists);
  const trace::Trace trace = read(folder_ / "lists.jsonl");
  EXPECT_EQ(trace.header.shapes.at(0).faces.size(), 2u);
  EXPECT_EQ(trace.header.shapes.at(1).vertices.size(), 4u);
  EXPECT_EQ(trace.frames.at(0).poses.at(0).second.position, Vec3d(1, 2, 3));
  EXPECT_EQ(trace.frames.at(0).pairs.at(0).manifolds.at(0).triangle, 1);
}

/// A browser has no `process`, and no file can be opened.
TEST_P(ScriptsInJavaScript, RunWithoutNode) {
  const std::string script = R"(
globalThis.process = undefined;
const { Recorder: InBrowser } = await import(')" CONTACTSCOPE_SOURCE_DIR
                             R"(/src/recorder/contactscope.mjs?browser');
let text = "";
const r = new InBrowser({ write: (line) => { text += line; } }, "mine/stack");
r.sphere("ball", 0.5);
r.frame(0, () => {});
console.log(text.split("\n").length);
try {
  new InBrowser("run.jsonl", "mine/stack");
} catch (error) {
  console.log(error.message);
}
)";
  EXPECT_EQ(
      output_of(script),
      "3\na browser has no files; pass an object with write(text), such as { write: (text) => "
      "lines.push(text) }\n");
}

INSTANTIATE_TEST_SUITE_P(Recorder, Scripts, ::testing::Values(python(), java_script()), name_of);
INSTANTIATE_TEST_SUITE_P(Recorder, ScriptsInJavaScript, ::testing::Values(java_script()), name_of);

}  // namespace
}  // namespace contactscope
