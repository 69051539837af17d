#include "viewer/viewer.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "find/finder.h"
#include "viewer/in_chromium.h"

namespace contactscope::viewer {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Viewer, FetchesNothingAndNamesOfATraceAreNoMarkup) {
  const std::string html = page_of(rising());
  for (const char* word : {"http:", "https:", " src=", "<link", "broken", "crate <b>", "@DATA@"})
    EXPECT_THAT(html, Not(HasSubstr(word)));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  if (!three_script().empty()) {
    EXPECT_THAT(html, HasSubstr("MIT License"));
  }
  EXPECT_EQ(html, page_of(rising()));
}

TEST(Viewer, LeavesOutFindingsThatAreIgnoredOrKnown) {
  CrateOnSlab scene = rising();
  for (trace::Point& point : scene.frames[1].pairs[0].manifolds[0].points) point.separation = 0.5;
  lint::LintOptions none;
  for (const std::string_view cause : lint::causes()) none.ignored.push_back({std::string(cause)});
  const auto is_known = [](const lint::Finding&) { return true; };
  EXPECT_EQ(page_of(scene, none), page_of(scene, {}, is_known));
  EXPECT_NE(page_of(scene, none), page_of(scene));
}

TEST_F(InChromium, ShowsTheFactsOfTheTraceAndAnswersClicksKeysAndSearch) {
  const json page = result(R"(
    const { data, state, onScreen, orbit } = contactscope, canvas = document.getElementById('view');
    const text = id => document.getElementById(id).textContent, all = [];
    const fire = (target, type, x, y, more) => target.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, button: 0, bubbles: true, ...more }));
    HTMLElement.prototype.setPointerCapture = () => {};  // made-up pointers cannot be captured
    const key = key => document.dispatchEvent(new KeyboardEvent('keydown', { key }));
    for (let i = 0; i < data.points.id.length; ++i)
      all.push([...data.points.position.subarray(3 * i, 3 * i + 3), data.points.separation[i], data.points.impulse[i], data.texts[data.points.id[i]]]);
    const seen = { title: document.title, points: all, pose: [...data.pose.subarray(7 * 23, 7 * 24)], start: state.frame, found: text('found'),
      separation: data.contacts.separation[11] };
    // A click on the first point of frame 6, and one on nothing.
    const box = canvas.getBoundingClientRect(), at = data.manifolds.first[data.contacts.manifolds[2]];
    const [x, y] = onScreen(data.points.position.subarray(3 * at, 3 * at + 3));
    fire(canvas, 'pointerdown', box.left + x, box.top + y);
    fire(canvas, 'pointerup', box.left + x, box.top + y);
    seen.clicked = state.selection;
    seen.facts = text('facts');
    seen.markup = document.querySelectorAll('#facts b').length;
    seen.hash = contactscope.hash();
    // A drag turns the view and selects nothing else.
    const yaw = orbit.yaw;
    fire(canvas, 'pointerdown', box.left + 50, box.top + 50);
    fire(canvas, 'pointermove', box.left + 150, box.top + 50);
    fire(canvas, 'pointerup', box.left + 150, box.top + 50);
    seen.turned = orbit.yaw - yaw;
    seen.still = state.selection;
    // The end of the timeline, keys, a layer.
    const line = document.getElementById('timeline').getBoundingClientRect();
    fire(document.getElementById('timeline'), 'pointerdown', line.right - 6, line.top + 20);
    seen.scrubbed = data.frames[state.frame];
    key('ArrowLeft');
    seen.stepped = data.frames[state.frame];
    key('Home');
    seen.before = contactscope.layers.dots.rows;
    key('1');
    seen.shapes = [state.on.has('shapes'), contactscope.bodies.forms[0].mesh.visible];
    contactscope.search('normal_turn > 30 deg and not overlap < 0.1 mm');
    seen.search = [text('found'), text('hits')];
    document.querySelector('#hits button').click();
    seen.shown = [data.frames[state.frame], document.querySelector('#hits [aria-current]')?.textContent.trim()];
    key('Home');
    seen.elsewhere = document.querySelectorAll('#hits [aria-current]').length;
    contactscope.search('overlap > ');
    seen.wrong = text('found');
    // Programs that take a picture wait for the load event.
    return new Promise(done => {
      const wait = () => {
        seen.loaded = performance.getEntriesByType('navigation')[0].loadEventStart - performance.getEntriesByName('ready')[0].startTime;
        seen.loaded > 0 || performance.now() > 20000 ? done(seen) : setTimeout(wait, 10);
      };
      wait();
    });)");
  ASSERT_FALSE(page.contains("error")) << page["error"];
  const CrateOnSlab scene = rising();
  EXPECT_EQ(page["title"], scene.header.title);
  std::size_t i = 0;
  for (const trace::Frame& frame : scene.frames)
    for (const trace::Manifold& manifold : frame.pairs[0].manifolds)
      for (const trace::Point& point : manifold.points) {
        const json& shown = page["points"].at(i++);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(shown[static_cast<std::size_t>(k)].get<double>(), point.position[k],
                      kPlaceError);
        EXPECT_NEAR(shown[3].get<double>(), point.separation, fine(point.separation));
        EXPECT_NEAR(shown[4].get<double>(), point.impulse->normal, 1e-3 * point.impulse->normal);
        EXPECT_EQ(shown[5], point.id);
      }
  EXPECT_EQ(page["points"].size(), i);
  EXPECT_NEAR(page["pose"][1].get<double>(), scene.frames[11].poses[1].second.position.y(), 1e-4);
  const double separation = scene.frames[11].pairs[0].separation;
  EXPECT_NEAR(page["separation"].get<double>(), separation, fine(separation));
  EXPECT_EQ(page["start"], 2);
  EXPECT_EQ(page["found"], "4 records in 4 frames");
  EXPECT_EQ(page["clicked"].dump(), R"({"pair":0,"point":"b:v4"})");
  EXPECT_THAT(page["facts"].get<std::string>(), HasSubstr("slab and crate <b>&amp;"));
  EXPECT_THAT(page["facts"].get<std::string>(), HasSubstr("2.5 N s"));
  EXPECT_EQ(page["markup"], 0);
  EXPECT_THAT(page["hash"].get<std::string>(), HasSubstr("frame=6&"));
  EXPECT_THAT(page["hash"].get<std::string>(), HasSubstr("point=b%3Av4"));
  EXPECT_NEAR(page["turned"].get<double>(), -0.8, 1e-9);
  EXPECT_EQ(page["still"], page["clicked"]);
  EXPECT_EQ(page["scrubbed"], 33);
  EXPECT_EQ(page["stepped"], 30);
  EXPECT_EQ(page["before"], 2 + 2 + 2 + 1);  // points, found ones, the deepest, the selected one
  EXPECT_EQ(page["shapes"].dump(), "[false,false]");
  EXPECT_EQ(page["search"][0], "1 record in 1 frame");
  EXPECT_THAT(page["search"][1].get<std::string>(), HasSubstr("frame 3: slab and crate <b>&amp;"));
  EXPECT_EQ(page["shown"].dump(), R"([3,"frame 3: slab and crate <b>&amp;"])");
  EXPECT_EQ(page["elsewhere"], 0);
  EXPECT_GT(page["loaded"].get<double>(), 0);
  EXPECT_THAT(page["wrong"].get<std::string>(), HasSubstr("a quantity is missing at the end"));
}

/// Overlaps of 19.14 to 19.16 mm, where three digits change, and others from 1 to 75 mm: the page has
/// the digits of the trace, although its numbers are rounded.
TEST_F(InChromium, TitleAndTimelineHaveTheSameOverlap) {
  CrateOnSlab scene = rising();
  scene.header.title = "{overlap} deep";
  for (std::size_t f = 0; f < 60; ++f) {
    if (f >= scene.frames.size()) scene.frames.push_back(scene.frames.back());
    scene.frames[f].frame = int(f), scene.frames[f].time = 0.02 * double(f);
    trace::Pair& pair = scene.frames[f].pairs[0];
    pair.manifolds = rising().frames[0].pairs[0].manifolds;
    pair.state = "touching";
    pair.separation = f < 12 ? -0.01914 - 2e-6 * double(f) : -1e-3 * std::pow(1.094, f - 12);
    for (trace::Point& point : pair.manifolds[0].points) point.separation = pair.separation;
  }
  const json page = result(R"(
    const { data, go } = contactscope;
    return { both: data.titles.map((title, frame) => {
      go(frame);
      return title.replace(' deep', '') + ' = ' + document.querySelector('#timeline span').textContent.replace('overlap ', '');
    }) };)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  std::set<std::string> different;
  for (const json& both : page["both"]) {
    const auto text = both.get<std::string>();
    different.insert(text);
    EXPECT_EQ(text.substr(0, text.find(" = ")), text.substr(text.find(" = ") + 3));
  }
  EXPECT_GT(different.size(), 48u) << page;
}

/// The findings about a pair come before its facts, and before those of its bodies.
TEST_F(InChromium, ASelectedPairShowsItsFindings) {
  CrateOnSlab scene = rising();
  for (trace::Point& point : scene.frames[1].pairs[0].manifolds[0].points) point.separation = 0.5;
  const json page = result(R"(
    const { data, select, go } = contactscope, said = () => document.querySelector('#facts .finding')?.textContent ?? '';
    const finding = data.findings[0];
    const in_frame = frame => (go(frame), select({ pair: 0 }), said());
    return { what: finding.what, said: finding.said, frames: finding.places, here: in_frame(finding.index), before: in_frame(0),
      body: (select({ body: 0 }), said()), none: (select(null), said()), open: document.getElementById('findings').open };)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  const auto what = page["what"].get<std::string>();
  EXPECT_THAT(page["here"].get<std::string>(), testing::StartsWith(what + "In this frame"));
  EXPECT_THAT(page["here"].get<std::string>(), HasSubstr(page["said"].get<std::string>()));
  EXPECT_THAT(page["before"].get<std::string>(), testing::StartsWith(what + "Not in this frame"));
  EXPECT_THAT(page["body"].get<std::string>(), testing::StartsWith(what));
  EXPECT_EQ(page["none"], "");
  EXPECT_EQ(page["open"], false) << "the link names a frame";
}

TEST_F(InChromium, SearchStaysAtAFrameThatIsFoundAndGoesOnIfRepeated) {
  const json page = result(R"(
    const { data, state, go } = contactscope, expression = document.getElementById('expression');
    const enter = text => {
      expression.value = text;
      document.getElementById('search').requestSubmit();
      return data.frames[state.frame];
    };
    const seen = [];
    go(1);
    for (const text of ['points > 0', 'points > 0', 'points > 0', 'points > 0', 'points > 1', 'points == 0', 'points == 0', 'points == 7', 'points ==', 'points == 0'])
      seen.push(enter(text));
    return { seen, lint: document.body.textContent.includes('lint: nothing is wrong') };)");
  ASSERT_FALSE(page.contains("error")) << page["error"];
  EXPECT_EQ(page["lint"], true) << "a clean trace";
  // Points are in frames 0 to 9, every third one. What is found nowhere, or is wrong, moves nothing.
  EXPECT_EQ(page["seen"].dump(), "[3,6,9,0,0,12,15,15,15,15]");
}

/// A crate that is recorded too large has dashes at the size that its contacts fit.
TEST_F(InChromium, AShapeOfAnotherSizeIsDrawnAtTheSizeThatContactsFit) {
  CrateOnSlab scene = rising();
  const std::string crate = scene.frames[0].pairs[0].b;
  for (trace::Shape& shape : scene.header.shapes)
    for (Vec3d& vertex : shape.vertices)
      if (shape.name == crate) vertex *= 1.25;
  const json page = result(R"(
    const { data, layers } = contactscope;
    document.querySelector('#lint button').click();
    return { fits: data.findings[0]?.fits, cause: data.findings[0]?.what, drawn: layers.hasFit, note: document.body.textContent.includes('the size that the contacts fit') };)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  ASSERT_TRUE(page["fits"].is_array()) << page["cause"];
  EXPECT_NEAR(page["fits"][1].get<double>(), 0.8, 0.01);
  EXPECT_EQ(page["drawn"], true);
  EXPECT_EQ(page["note"], true);
}

TEST_F(InChromium, FindingsNameTheirFrameAndShapesAndSelectThem) {
  const json page = result(R"(
    const { state, data, orbit, bodies, onScreen } = contactscope, canvas = document.getElementById('view'), click = button => {
      state.selection = null;
      orbit.target.set(9, 9, 9);
      button.click();
      orbit.place(canvas.clientWidth, canvas.clientHeight, 100);
      const corners = data.shapes[1].vertices.map(vertex => onScreen(new THREE.Vector3(...vertex).applyMatrix4(bodies.matrices[1]).toArray()));
      const isFramed = corners.every(([x, y, z]) => z < 1 && x > 0 && x < canvas.clientWidth && y > 0 && y < canvas.clientHeight);
      return [button.textContent, state.selection, data.frames[state.frame], isFramed];
    };
    return { rows: [...document.querySelectorAll('#lint button')].map(click), places: data.findings.map(finding => finding.places) };)");
  ASSERT_FALSE(page.contains("error")) << page["error"];
  ASSERT_FALSE(page["rows"].empty());
  for (std::size_t i = 0; i < page["rows"].size(); ++i) {
    const json& row = page["rows"][i];
    EXPECT_THAT(row[0].get<std::string>(),
                HasSubstr("frame " + std::to_string(row[2].get<int>()) + ", "));
    EXPECT_THAT(row[0].get<std::string>(), HasSubstr("crate <b>&amp;"));
    EXPECT_TRUE(row[1].is_object()) << row[0];
    EXPECT_EQ(row[3], true) << "the whole crate is in view";
    EXPECT_THAT(page["places"][i], testing::Contains(row[2].get<int>() / 3)) << row[0];
  }
}

/// A link that names a finding alone opens its frame, not the deepest one, and its pair.
TEST_F(InChromium, AFindingInTheHashOpensWhereItIs) {
  CrateOnSlab scene = rising();
  for (trace::Point& point : scene.frames[1].pairs[0].manifolds[0].points) point.separation = 0.5;
  hash_ = "#finding=1";
  const json page = result(R"(
    const { data, state } = contactscope;
    return { open: [state.frame, data.findings[0].index, state.selection] };)",
                           scene);
  EXPECT_EQ(page["open"].dump(), R"([1,1,{"pair":0}])");
}

/// Without a link's hash: the first finding's frame, pair, sentence and point.
TEST_F(InChromium, OpensOnTheFirstFindingAndFollowsUntilTheCameraIsMoved) {
  CrateOnSlab scene = rising();
  for (trace::Point& point : scene.frames[1].pairs[0].manifolds[0].points) point.separation = 0.5;
  hash_.clear();
  const json page = result(R"(
    const { data, state, orbit, layers, bodies, onScreen, go, select, hash } = contactscope, text = id => document.getElementById(id).textContent;
    const canvas = document.getElementById('view'), finding = data.findings[0];
    const framed = () => {
      orbit.place(canvas.clientWidth, canvas.clientHeight, 100);
      return data.shapes.map((shape, body) => shape.vertices.every(vertex => {
        const [x, y, z] = onScreen(new THREE.Vector3(...vertex).applyMatrix4(bodies.matrices[body]).toArray());
        return z < 1 && x > 0 && x < canvas.clientWidth && y > 0 && y < canvas.clientHeight;
      }));
    };
    const seen = { open: [state.finding, data.frames[state.frame] === finding.frame, state.selection, text('title') === finding.what, document.title.startsWith(finding.what), framed()],
      said: text('said'), marks: layers.marks.map(mark => mark.text), ringed: document.getElementById('ringed').hidden, names: layers.labels.map(label => label.text), facts: text('facts'), hash: hash() };
    select(null);
    seen.closed = [state.finding, text('said')];
    seen.frames = [0, 11].map(frame => (go(frame), framed()));
    orbit.zoom(0.5);
    const { distance } = orbit;
    go(3);
    seen.free = [orbit.distance === distance, hash().includes('camera=')];
    const enter = words => {
      document.getElementById('expression').value = words;
      document.getElementById('search').requestSubmit();
      return [state.selection, data.frames[state.frame], text('found')];
    };
    seen.searches = [enter('overlap > 0.5 mm and frame < 1'), enter('CRATE'), enter('overlp > 1 mm'), enter('Slab, crate <b>&amp;'), enter('depth > 1 mm')];
    return seen;)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  EXPECT_EQ(page["open"].dump(), R"([0,true,{"pair":0},true,true,[true,true]])");
  EXPECT_THAT(page["said"].get<std::string>(), HasSubstr("slab and crate <b>&amp;: point "));
  ASSERT_FALSE(page["marks"].empty());
  EXPECT_THAT(page["marks"][0].get<std::string>(), testing::StartsWith("lint: point "));
  EXPECT_EQ(page["ringed"], false) << "the legend has the ring";
  EXPECT_THAT(page["names"].get<std::vector<std::string>>(), testing::Contains("slab"));
  EXPECT_THAT(page["facts"].get<std::string>(), HasSubstr("point 0 "));
  EXPECT_THAT(page["hash"].get<std::string>(), HasSubstr("finding=1"));
  EXPECT_THAT(page["hash"].get<std::string>(), Not(HasSubstr("camera")));
  EXPECT_EQ(page["closed"].dump(), R"([-1,""])");
  EXPECT_EQ(page["frames"].dump(), "[[true,true],[true,true]]");
  EXPECT_EQ(page["free"].dump(), "[true,true]");
  EXPECT_EQ(page["searches"][0].dump(), R"([{"pair":0},0,"1 record in 1 frame"])");
  EXPECT_EQ(page["searches"][1].dump(), R"([{"body":1},0,"1 body"])");
  for (const int wrong : {2, 4})
    EXPECT_THAT(page["searches"][wrong][2].get<std::string>(),
                HasSubstr("did you mean 'overlap'?"));
  EXPECT_EQ(page["searches"][3][0].dump(), R"({"pair":0})");
  EXPECT_THAT(page["searches"][3][2].get<std::string>(), testing::EndsWith("records in 12 frames"));
}

/// Fourteen crates in a row, and one that flies off; the overlap is deepest in frame 0. The link has a
/// theme, so no finding is opened.
TEST_F(InChromium, OpensAtTheDeepestOverlapWithAllBodiesInViewButNotWhatFliesOff) {
  CrateOnSlab scene = rising();
  for (int i = 0; i < 15; ++i) {
    trace::Shape shape = scene.header.shapes[1];
    shape.name = i < 14 ? "crate " + std::to_string(i) : "gone";
    scene.header.shapes.push_back(shape);
    for (trace::Frame& frame : scene.frames)
      frame.poses.emplace_back(
          shape.name, Pose<double>{Quatd::Identity(), i < 14 ? Vec3d(3.0 * i, 0, 0)
                                                             : Vec3d(0, 1000 + frame.frame, 0)});
  }
  hash_ = "#theme=light";
  const json page = result(R"(
    const { data, state, orbit, bodies, onScreen, go, select } = contactscope, canvas = document.getElementById('view');
    const outside = () => {
      orbit.place(canvas.clientWidth, canvas.clientHeight, 100);
      return data.shapes.filter((_, body) => {
        const [x, y, z] = onScreen(new THREE.Vector3().setFromMatrixPosition(bodies.matrices[body]).toArray());
        return z > 1 || x < 0 || x > canvas.clientWidth || y < 0 || y > canvas.clientHeight;
      }).map(shape => shape.name);
    };
    const seen = [state.frame, state.finding, outside()];
    go(11);
    seen.push(outside());
    select({ body: data.shapes.length - 1 });
    document.getElementById('fit').click();
    seen.push(outside().includes('gone'));
    return { seen };)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  EXPECT_EQ(page["seen"].dump(), R"([0,-1,["gone"],["gone"],false])");
}

/// Fifteen crates on a slab, and a wall next to them that is much larger: seen from its side, and from
/// the other one.
TEST_F(InChromium, AWallBetweenTheEyeAndTheContactsIsCutAway) {
  CrateOnSlab scene = rising();
  const auto add = [&](const std::string& name, double factor, double flat, const Vec3d& at) {
    trace::Shape shape = scene.header.shapes[1];
    shape.name = name;
    for (Vec3d& vertex : shape.vertices) vertex *= factor, vertex.z() *= flat;
    scene.header.shapes.push_back(shape);
    for (trace::Frame& frame : scene.frames)
      frame.poses.emplace_back(name, Pose<double>{Quatd::Identity(), at});
  };
  for (int i = 0; i < 14; ++i) add("other " + std::to_string(i), 1, 1, {3.0 * i, 50, 0});
  add("wall", 12, 0.01, {0, 0, 4});
  const json page = result(R"(
    const { data, orbit, bodies, go, select } = contactscope, canvas = document.getElementById('view'), ray = new THREE.Raycaster();
    go(0);
    select({ pair: 0 });
    return Object.fromEntries([1, -1].map(side => {
      orbit.target.set(0, 0, 0);
      orbit.lookFrom([0, 0.1, side]);
      orbit.distance = 20;
      orbit.place(canvas.clientWidth, canvas.clientHeight, 100);
      const isCut = bodies.cut(orbit.camera.position);
      const hit = place => {
        const { x, y } = place.project(orbit.camera);
        ray.setFromCamera({ x, y }, orbit.camera);
        return (data.shapes[bodies.hit(ray)] || {}).name || '';
      };
      const crate = new THREE.Vector3().setFromMatrixPosition(bodies.matrices[1]);
      return [side, [hit(crate), hit(new THREE.Vector3(-2, 4, 4)), isCut]];
    }));)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  EXPECT_EQ(page["1"], (json{"crate <b>&amp;", "", true}));
  EXPECT_EQ(page["-1"], (json{"crate <b>&amp;", "wall", false}));
}

/// Fifteen crates in a row behind each other, and the slab far away. The last but one is selected.
TEST_F(InChromium, BodiesBeforeASelectedOneAreCutAwayAndAreNotHit) {
  CrateOnSlab scene = rising();
  for (int i = 0; i < 14; ++i) {
    trace::Shape shape = scene.header.shapes[1];
    shape.name = "crate " + std::to_string(i);
    scene.header.shapes.push_back(shape);
    for (trace::Frame& frame : scene.frames)
      frame.poses.emplace_back(shape.name, Pose<double>{Quatd::Identity(), Vec3d(0, 50, 3.0 * i)});
  }
  const json page = result(R"(
    const { data, orbit, bodies, go, select } = contactscope, canvas = document.getElementById('view'), gl = canvas.getContext('webgl'), ray = new THREE.Raycaster();
    const body = name => data.shapes.findIndex(shape => shape.name === name), at = z => new THREE.Vector3(0, 50, z);
    go(0);
    const hit = () => {
      orbit.target.copy(at(3));
      orbit.lookFrom([0, 0, 1]);
      orbit.distance = 200;
      orbit.place(canvas.clientWidth, canvas.clientHeight, 100);
      ray.setFromCamera({ x: 0, y: 0 }, orbit.camera);
      return (data.shapes[bodies.hit(ray)] || {}).name || '';
    };
    const seen = [hit()];
    for (const name of ['crate 1', 'crate 13']) {
      select({ body: body(name) });
      seen.push(hit());
    }
    select(null);
    seen.push(hit());
    return { seen };)",
                           scene);
  ASSERT_FALSE(page.contains("error")) << page["error"];
  EXPECT_EQ(page["seen"].dump(), R"(["crate 13","crate 1","crate 13","crate 13"])");
}

TEST_F(InChromium, DamagedFactsAreReportedWithOrWithoutAWorker) {
  for (const bool workers : {true, false}) {
    const json page = result("return { title: document.getElementById('title').textContent };",
                             rising(), workers, [](std::string& html) {
                               const std::string begin = "id=\"facts_data\">\n";
                               html.erase(html.find(begin) + begin.size() + 40, 30);
                             });
    EXPECT_THAT(page["title"].get<std::string>(), HasSubstr("its facts cannot be unpacked"));
  }
}

/// The pair leaves the trace and comes back.
CrateOnSlab leaving() {
  CrateOnSlab scene = rising();
  for (const int frame : {2, 8, 9}) at(scene.frames, frame).pairs.clear();
  return scene;
}

/// Number of records that `find` finds in the trace of the page.
int found_by_find(const std::string& expression) {
  find::Finder finder(find::Expression(expression, find::vocabulary()));
  const CrateOnSlab scene = leaving();
  finder.take(lint::lint({scene.header, scene.frames}));
  int hits = 0;
  for (const trace::Frame& frame : scene.frames) hits += int(finder.next(frame).size());
  return hits;
}

TEST_F(InChromium, SearchKnowsTheWordsOfFindAndFindsTheSame) {
  std::vector<std::string> expressions = {"age > 1",
                                          "away == 5",
                                          "previous.away > 3",
                                          "lint",
                                          "lint > 1",
                                          "lint and not points",
                                          "not lint and points_lost",
                                          "away >= 2",
                                          "previous.points > points",
                                          "previous.overlap > 15 mm and previous.frame < 9",
                                          "previous.age >= 0",
                                          "points_gained > 0 or points_lost == 4",
                                          "ids_lost > 2 or ids_gained > 0",
                                          "overlap > 17.5 mm",
                                          "overlap_change < 0",
                                          "impulse_change > 1 N s",
                                          "normal_turn > 30 deg",
                                          "motion > 0.5 mm",
                                          "turn > 1 deg",
                                          "label == '' and manifolds and touching",
                                          "axis == ''",
                                          "motion > 500000 nm and a == 'slab'"};
  std::set<std::string> causes;
  for (const lint::Finding& one : lint::lint({leaving().header, leaving().frames}))
    causes.insert(one.cause);
  ASSERT_FALSE(causes.empty());
  for (const std::string& cause : causes) expressions.push_back("lint." + cause);
  const json page = result("const found = " + json(expressions).dump() + R"(.map(one => {
      contactscope.search(one);
      return Number.parseInt(document.getElementById('found').textContent);
    });
    contactscope.search('previous.motion > 1');
    return { found, quantities: contactscope.quantities, refused: document.getElementById('found').textContent };)",
                           leaving());
  ASSERT_FALSE(page.contains("error")) << page["error"];
  for (std::size_t i = 0; i < expressions.size(); ++i)
    EXPECT_EQ(page["found"][i], found_by_find(expressions[i])) << expressions[i];
  EXPECT_EQ(found_by_find("age > 0"), 1);
  EXPECT_THAT(page["refused"].get<std::string>(), HasSubstr("leave out 'previous.'"));
  std::vector<std::string> words;
  for (const find::Quantity& known : find::pair_quantities()) words.emplace_back(known.name);
  EXPECT_THAT(page["quantities"].get<std::vector<std::string>>(),
              testing::UnorderedElementsAreArray(words));
}

}  // namespace
}  // namespace contactscope::viewer
