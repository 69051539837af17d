#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Motion of two shapes over the step, and their first contact: Catto 2013, "Continuous Collision".
/// Draws outlines at the times up to which the search proved them separated, their first contact,
/// and their poses at the end of the step, which a discrete engine would see. For rotations also
/// the path of the contact point; for deforming meshes the paths of corners.
namespace contactscope::draw {
namespace {

constexpr double kMinPath = 3;             // pixels of a shape's displacement in the step
constexpr double kMinBetweenSkins = 0.02;  // share of the step: nearer outlines are merged

constexpr LineStyle kSkin{1.2f, kDropped};
constexpr LineStyle kEnd{2.0f, kDropped, true};
constexpr LineStyle kEndPath{1.2f, kDropped, true};
constexpr LineStyle kEndPathOfHit{1.2f, with_alpha(kDropped, 0.55f), true};
constexpr LineStyle kEndOfHit{1.6f, with_alpha(kDropped, 0.55f), true};
constexpr LineStyle kMeeting{3.0f, kContact};

constexpr Swatch kSkinSwatch{LegendGroup::Motion, 5,
                             [](auto& pen) { pen.level_line(0, 23, 1.2, kDropped); }};
constexpr Swatch kEndSwatch{LegendGroup::Motion, 6, [](auto& pen) { pen.dashes(2, kDropped); }};
constexpr Swatch kEndOfHitSwatch{LegendGroup::Motion, 6,
                                 [](auto& pen) { pen.dashes(kEndOfHit.width, kEndOfHit.color); }};
constexpr Swatch kMeetingSwatch{LegendGroup::Motion, 7,
                                [](auto& pen) { pen.level_line(0, 23, 3, kContact); }};

// With the contact point.
constexpr Swatch kFirstMeetingSwatch{LegendGroup::Motion, 7, [](auto& pen) {
                                       pen.level_line(0, 23, 3, kContact);
                                       pen.dot(0, 4.8, kContact);
                                     }};

constexpr Color kSwept = with_alpha(kDropped, 0.09f);
constexpr LineStyle kSweptBorder{1.0f, with_alpha(kDropped, 0.5f)};
constexpr Swatch kSweptSwatch{LegendGroup::Motion, 4,
                              [](auto& pen) { pen.box(kSwept, kSweptBorder.color, 1); }};

constexpr LineStyle kTrue{2.2f, kShapeEdge};
constexpr Swatch kTrueSwatch{LegendGroup::Motion, 8,
                             [](auto& pen) { pen.level_line(0, 23, 2.2, kShapeEdge); }};

constexpr double kMinTurnShown = 0.5;  // radians: smaller rotations look like straight lines
constexpr double kMinCornerPath = 24;  // pixels
constexpr double kCornerClear = 8;     // pixels between the head of a path and the corner
constexpr double kTurnHead = 12,
                 kTurnClear = 10;  // pixels: of the arrow head, and between it and the dot

constexpr float kTurningPathWidth = 1.8f;
constexpr Swatch kTurningPathSwatch{
    LegendGroup::Motion, 14, [](auto& pen) { pen.arrow(kTurningPathWidth, 10, kShapeEdge); }};
constexpr LineStyle kMetTriangleNow{1.5f, kContact};
constexpr LineStyle kCornerPath{1.5f, kContact, true};
constexpr Swatch kCornerPathSwatch{LegendGroup::Motion, 15,
                                   [](auto& pen) { pen.dashes(1.5, kContact); }};

constexpr Swatch kGhostSwatch{LegendGroup::Motion, 9, [](auto& pen) { pen.dot(4.2, 6.2, kAxis); }};

/// The survey's "Continuous Collision Detection (CCD)", Fig. 5: a ball that moves straight sweeps a
/// capsule.
void draw_swept_ball(const Scene& scene, const PlacedShape& ball, const Vec3d& displacement,
                     Sketch& sketch) {
  const Vec3d& from = ball.vertices.front();
  const std::vector<Vec3d> outline =
      RoundBody{{from, from + displacement}, ball.traced().radius}.outline(scene.camera);
  if (outline.size() < 3) return;
  sketch.surfaces.push_back({outline, kSwept});
  sketch.outline(outline, kSweptBorder);
  sketch.explain(kSweptSwatch, "swept by the ball: a capsule");
}

/// Whether the frame has no earlier pair in which this shape hits another.
bool is_first_hit_of(const Scene& scene, const trace::Pair& pair, const PlacedShape& shape) {
  const std::string& name = shape.traced().name;
  const auto first = std::ranges::find_if(scene.frame.pairs, [&](const trace::Pair& each) {
    return each.impact && each.impact->status == "hit" && (each.a == name || each.b == name);
  });
  return first != scene.frame.pairs.end() && &*first == &pair;
}

/// Whether the displacement or rotation of a shape is visible. A resting shape would cover itself.
bool moves(const Scene& scene, const PlacedShape& shape, const trace::Travel& travel) {
  const double offset = travel.displacement.norm() + travel.turn.norm() * shape.mesh->radius;
  return offset * scene.camera.pixels_per_metre(travel.pivot) > kMinPath * scene.scales.pixel;
}

/// Path of the contact point from its position now to the contact, as an arrow: shows the rotation.
void draw_turning_path(const Scene& scene, const trace::Travel& travel, const Vec3d& turn,
                       const Vec3d& point, double time, Sketch& sketch) {
  constexpr int kSteps = 48;
  const auto turned = [&](double part) {
    const double angle = part * turn.norm();
    return Quatd(Eigen::AngleAxisd(angle, angle > 0 ? Vec3d(turn.normalized()) : Vec3d::UnitX()));
  };
  const Vec3d arm = turned(time).conjugate() * (point - travel.pivot - time * travel.displacement);
  const double pixels = scene.camera.pixels_per_metre(point) / scene.scales.pixel;
  std::vector<Vec3d> offset;  // up to the start of the head
  for (int i = 0; i <= kSteps; ++i) {
    const double part = time * i / kSteps;
    const Vec3d at = travel.pivot + part * travel.displacement + turned(part) * arm;
    const double left = (point - at).norm() * pixels;
    if (left < kTurnClear) break;
    if (left > kTurnClear + kTurnHead) offset.push_back(at);
  }
  if (offset.size() < 3) return;
  const Vec3d last = offset.back(), along = (point - last).normalized();
  sketch.curves.push_back({offset, {kTurningPathWidth, kShapeEdge}});
  sketch.arrow_head(last, point - kTurnClear / pixels * along, kTurningPathWidth, kTurnHead,
                    kShapeEdge);
  sketch.explain(kTurningPathSwatch, "way of the point that meets");
}

/// Numbers an outline with the approach chart's step, at its highest end on the screen.
void number_skin(const Scene& scene, const PlacedShape& shape, const trace::Travel& travel,
                 double time, std::size_t step, Sketch& sketch) {
  constexpr double kEqually = 0.98;  // share of the largest distance from the pivot
  if (travel.turn.isZero(0) || shape.vertices.empty()) return;
  const PlacedShape skin =
      moved(shape, travel.pivot, time * travel.displacement, time * travel.turn);
  const Vec3d pivot = travel.pivot + time * travel.displacement;
  const auto reach = [&](const Vec3d& at) { return (at - pivot).norm(); };
  const double farthest = reach(*std::ranges::max_element(skin.vertices, {}, reach));
  const Vec3d* end = nullptr;
  for (const Vec3d& at : skin.vertices) {
    if (reach(at) < kEqually * farthest) continue;
    if (end == nullptr || (at - *end).dot(scene.camera.up()) > 0) end = &at;
  }
  const double round =
      skin.traced().radius * scene.camera.pixels_per_metre(*end) / scene.scales.pixel;
  sketch.label(*end, std::to_string(step), kAxisText, 17, round + 5,
               Vec3d((*end - pivot).normalized()));
}

/// The triangle of a mesh at the first contact, and the straight paths of its corners to there.
void draw_met_triangle(const Scene& scene, const PlacedShape* mesh, int triangle,
                       const std::vector<Vec3d>& corners, Sketch& sketch) {
  if (corners.empty()) return;
  sketch.face(corners, with_alpha(kContact, 0.3f), kMeeting);
  sketch.explain(kMeetingSwatch, "the triangles where they first meet");
  if (mesh == nullptr || triangle < 0 || triangle >= count_of(mesh->traced().faces)) return;
  const std::vector<Vec3d> now = mesh->polygon(triangle);
  const double pixels = scene.camera.pixels_per_metre(corners[0]) / scene.scales.pixel;
  if (now.size() != corners.size() || (corners[0] - now[0]).norm() * pixels < kMinCornerPath)
    return;
  sketch.face(now, with_alpha(kContact, 0.15f), kMetTriangleNow);
  for (std::size_t i = 0; i < now.size(); ++i)
    draw_path(scene, now[i], corners[i], kCornerClear / pixels, kCornerPath, sketch);
  sketch.explain(kCornerPathSwatch, "way of a corner");
}

/// Labels a triangle with its mesh's role, at its corner farthest from the other triangle.
void name_met_triangle(const char* role, const Color& ink, const std::vector<Vec3d>& corners,
                       const std::vector<Vec3d>& others, Sketch& sketch) {
  if (corners.empty() || others.empty()) return;
  const Vec3d middle = mean_of(others);
  const Vec3d& corner = *std::ranges::max_element(
      corners, {}, [&](const Vec3d& p) { return (p - middle).squaredNorm(); });
  sketch.label(corner, role, ink, 17, 8, Vec3d((corner - middle).normalized()));
}

void draw_sweep(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.impact) return;
  const trace::Impact& impact = *pair.impact;
  // A cast moves shapes without rotation. Only the contact shows their rotation at that time.
  const bool is_cast = impact.method == "swept";
  std::vector<std::pair<const PlacedShape*, const trace::Travel*>> moving;
  for (const auto& [name, travel] :
       {std::pair(&pair.a, &impact.travel_a), std::pair(&pair.b, &impact.travel_b)}) {
    const PlacedShape* shape = scene.find(*name);
    if (shape != nullptr && moves(scene, *shape, *travel)) moving.emplace_back(shape, travel);
  }
  const auto draw_turned = [&](double time, double turned, const LineStyle& style,
                               bool filled = false) {
    for (const auto& [shape, travel] : moving) {
      if (shape->traced().half_space) continue;
      std::optional<Color> fill;
      if (filled) fill = shape->is_a ? kShapeA : kShapeB;
      draw_ghost(scene.camera,
                 moved(*shape, travel->pivot, time * travel->displacement, turned * travel->turn),
                 style, sketch, fill);
    }
  };
  const auto draw_at = [&](double time, const LineStyle& style, bool filled = false) {
    draw_turned(time, is_cast && time < 1 ? 0 : time, style, filled);
  };
  const auto number_skins = [&](double time, std::size_t step) {
    if (!scene.view.shows(Panel::Approach)) return;
    for (const auto& [shape, travel] : moving)
      number_skin(scene, *shape, *travel, time, step, sketch);
  };
  if (impact.status == "hit" && !impact.steps.empty()) number_skins(0, 1);
  double last = 0;
  for (std::size_t i = 0; i < impact.steps.size(); ++i) {
    const trace::ImpactStep& step = impact.steps[i];
    if (impact.method == "speculative") break;  // no search; the answer judges ghosts alone
    if (impact.status == "separated") break;    // nothing found: the path is enough
    if (step.safe - last < kMinBetweenSkins || step.safe >= 1) continue;
    if (impact.status == "hit" && impact.time - step.safe < kMinBetweenSkins) continue;
    last = step.safe;
    draw_at(step.safe, kSkin);
    number_skins(step.safe, i + 2);
    sketch.explain(kSkinSwatch, "an iteration: apart for certain until then");
  }
  // If shapes still overlap at the end, a discrete engine would see it too: nothing is missed.
  const bool is_seen_anyway =
      impact.status == "hit" && !impact.distances.empty() && impact.distances.back().distance <= 0;
  if (!moving.empty() && !is_seen_anyway) {
    // A stopped shape does not get there, so its outline is weaker.
    draw_at(1, impact.status == "hit" ? kEndOfHit : kEnd);
    const auto ends_in_view = [&](const auto& each) {
      const auto& [shape, travel] = each;
      return in_view(scene.camera,
                     moved(*shape, travel->pivot, travel->displacement, travel->turn));
    };
    if (std::ranges::any_of(moving, ends_in_view))
      sketch.explain(impact.status == "hit" ? kEndOfHitSwatch : kEndSwatch,
                     "at the next frame, if nothing stopped it");
  }
  if (!is_seen_anyway) {
    for (const auto& [shape, travel] : moving) {
      if (!travel->turn.isZero(0)) continue;
      // Centres of shapes other than balls are not visible, and here not important.
      if (impact.status == "hit" && border_of_ball(*shape) == 0) continue;
      if (is_ball(*shape) && is_first_hit_of(scene, pair, *shape))
        draw_swept_ball(scene, *shape, travel->displacement, sketch);
      const Vec3d middle = shape->pose.transform(shape->traced().center_of_mass);
      draw_path(scene, middle, middle + travel->displacement, border_of_ball(*shape),
                impact.status == "hit" ? kEndPathOfHit : kEndPath, sketch);
    }
  }
  for (const Vec3d& ghost : impact.ghosts) {
    sketch.mark(MarkKind::WideRing, ghost, kAxis);
    sketch.explain(kGhostSwatch, "ghost: holds back what would go past", ghost);
  }
  draw_met_triangle(scene, scene.find(pair.a), impact.triangle_a, impact.corners_a, sketch);
  draw_met_triangle(scene, scene.find(pair.b), impact.triangle_b, impact.corners_b, sketch);
  name_met_triangle("A", kArcOfA, impact.corners_a, impact.corners_b, sketch);
  name_met_triangle("B", kArcOfB, impact.corners_b, impact.corners_a, sketch);
  if (impact.status != "hit") return;
  const bool turns = !impact.travel_a.turn.isZero(0) || !impact.travel_b.turn.isZero(0);
  if (is_cast && turns) {
    draw_turned(impact.time, impact.time, kTrue);
    sketch.explain(kTrueSwatch, "how it is turned by then");
  }
  if (!moving.empty()) {
    draw_at(impact.time, kMeeting, true);
    sketch.explain(kFirstMeetingSwatch, "where they first meet");
  }
  for (const trace::Travel* travel : {&impact.travel_a, &impact.travel_b}) {
    // A cast does not rotate the shape, so its point moves straight.
    if (travel->turn.norm() > kMinTurnShown)
      draw_turning_path(scene, *travel, is_cast ? Vec3d(Vec3d::Zero()) : travel->turn,
                        impact.point_a, impact.time, sketch);
  }
  sketch.mark(MarkKind::Dot, impact.point_a, kContact);
}

// Onion skins: outlines of moving shapes in earlier frames. A jump leaves no outlines in between.

constexpr std::size_t kMaxSkins = 12;  // per shape

constexpr LineStyle kPast{1.2f, kDropped};
constexpr LineStyle kTrailPath{1.5f, kDropped, true};
// If dashes mark future positions.
constexpr LineStyle kSolidPath{1.2f, with_alpha(kDropped, 0.7f)};

constexpr double kMinOfBox = 30;    // pixels: shorter displacements are drawn for balls only
constexpr double kMinStep = 4;      // pixels: closer outlines would merge into bars
constexpr double kMinTurn = 0.005;  // sine of half the rotation
constexpr double kSpread = 1.1;     // radii of the shape between the outlines of a long path

constexpr Swatch kPastSwatch{LegendGroup::Motion, 4,
                             [](auto& pen) { pen.level_line(0, 23, 1.2, kDropped); }};

// Thins poses, from the present one (last) back to the oldest, so that outlines are
// distinguishable.
std::vector<Pose<double>> spread(const std::vector<Pose<double>>& past, const PlacedShape& shape) {
  const Vec3d& middle = shape.traced().center_of_mass;
  const double radius = shape.mesh->radius;
  std::vector<Pose<double>> kept = {past.back()};
  for (auto pose = past.rbegin() + 1; pose != past.rend(); ++pose) {
    const Pose<double>& after = kept.back();
    const double offset = (pose->transform(middle) - after.transform(middle)).norm();
    const double turn = 2 * (pose->rotation * after.rotation.conjugate()).vec().norm();
    if (offset + radius * turn >= kSpread * radius) kept.push_back(*pose);
  }
  // Where the path begins, in place of an outline close to it.
  const Vec3d begin = past.front().transform(middle);
  if (kept.size() > 1 && (kept.back().transform(middle) - begin).norm() < kSpread * radius / 3)
    kept.pop_back();
  kept.push_back(past.front());
  std::ranges::reverse(kept);
  return kept;
}

void draw_trail(const Scene& scene, Sketch& sketch) {
  if (scene.sequence == nullptr) return;
  const bool shows_future = scene.shows(Layer::Sweep) || scene.shows(Layer::Ahead);
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.is_mesh() || shape.traced().half_space) continue;
    const Vec3d middle = shape.traced().center_of_mass;
    std::vector<Pose<double>> past;
    for (const FramePoses& frame : *scene.sequence) {
      if (frame.frame >= scene.frame.frame) break;
      const auto then = std::ranges::find(frame.poses, shape.traced().name,
                                          &std::pair<std::string, Pose<double>>::first);
      if (then != frame.poses.end()) past.push_back(then->second);
    }
    const bool is_long = past.size() > kMaxSkins;
    past.push_back(shape.pose);
    const std::size_t before = past.size() < 2 ? 0 : past.size() - 2;
    const auto last_path =
        seen_distance(scene.camera, past[before].transform(middle), shape.pose.transform(middle));
    const bool rests = last_path && *last_path < kMinStep * scene.scales.pixel;
    if (is_long) past = spread(past, shape);
    if (past.size() > kMaxSkins + 1) past.erase(past.begin(), past.end() - kMaxSkins - 1);
    const Vec3d now = shape.pose.transform(middle);
    const double pixels_per_metre = scene.camera.pixels_per_metre(now) / scene.scales.pixel;
    std::optional<Vec3d> last;  // position of the newest drawn outline
    for (std::size_t k = 0; k + 1 < past.size(); ++k) {
      const Pose<double>&then = past[k], &next = past[k + 1];
      const Vec3d place = then.transform(middle), offset = next.transform(middle) - place;
      const Quatd turn = then.rotation * shape.pose.rotation.conjugate();
      if (offset.isZero(0) && then.rotation.coeffs() == next.rotation.coeffs()) continue;
      // Inside a box, a displacement too short for an arrow head has no meaning. If the shape rests
      // now, arrows would suggest that it still moves.
      const auto seen = seen_distance(scene.camera, place, Vec3d(place + offset));
      const bool has_head = seen && *seen >= kMinOfBox * scene.scales.pixel;
      if (border_of_ball(shape) > 0 || (has_head && !rests))
        draw_path(scene, place, place + offset, border_of_ball(shape),
                  shows_future ? kSolidPath : kTrailPath, sketch);
      const auto merges = [&](const Vec3d& other) {
        return (place - other).norm() * pixels_per_metre < kMinStep;
      };
      if (turn.vec().norm() < kMinTurn && (merges(now) || (last && merges(*last)))) continue;
      last = place;
      const Eigen::AngleAxisd back(turn);
      draw_ghost(scene.camera, moved(shape, now, place - now, Vec3d(back.angle() * back.axis())),
                 kPast, sketch);
      sketch.explain(kPastSwatch, "in the frames before", place);
    }
  }
}

// Catto 2013, "Continuous Collision": a contact of shapes that do not touch yet limits their
// approach to the gap. Draws each body's pose one frame later without contacts, and the gap.

constexpr double kMinAhead = 8;  // pixels
constexpr double kAside = 44;    // pixels from the point, to avoid the impulse arrow

constexpr LineStyle kGhost{2.0f, kDropped, true};

constexpr Swatch kAheadSwatch{LegendGroup::Motion, 4, [](auto& pen) { pen.dashes(2, kDropped); }};

// Distance within which points become contacts: a dashed line, and a measure opposite to the gap's.
void draw_speculative_margin(const Scene& scene, const Vec3d& from, const Vec3d& out,
                             const Vec3d& aside, Sketch& sketch) {
  const double margin = scene.frame.solver->speculative_margin;
  const Vec3d to = from + margin * out;
  if (!(margin > 0) || !scene.camera.sees(to)) return;
  sketch.line(to - 4 * aside, to + 2 * aside, {1.5f, kAxis, true});
  const Vec3d below = -3 * aside;
  sketch.measure(from + below, to + below, 1.8f, 10, kAxis);
  sketch.label(0.5 * (from + to) + below,
               "speculative margin " + spell_length(margin, 0, scene.scales.length), kAxisText, 17,
               10, Vec3d(-scene.camera.up()));
}

void draw_ahead(const Scene& scene, Sketch& sketch) {
  const double step = scene.scales.step;
  if (!scene.frame.solver || step <= 0) return;
  for (const trace::Body& body : scene.bodies()) {
    const Vec3d& center = body.center_of_mass;
    const Vec3d offset = step * body.velocity;
    const double pixels = offset.norm() * scene.camera.pixels_per_metre(center);
    const PlacedShape* shape = scene.find(body.name);
    if (shape == nullptr || pixels < kMinAhead * scene.scales.pixel) continue;
    const Vec3d turn = step * body.angular_velocity;
    const PlacedShape later = moved(*shape, center, offset, turn);
    draw_ghost(scene.camera, later, kGhost, sketch);
    draw_path(scene, center, center + offset, border_of_ball(*shape), {1.2f, kDropped, true},
              sketch);
    if (!in_view(scene.camera, later)) continue;
    sketch.explain(kAheadSwatch, "a frame later, if nothing stopped it", Vec3d(center + offset));
  }
  for (const trace::Pair& pair : scene.frame.pairs) {
    const PlacedShape* a = scene.find(pair.a);
    const double side = a == nullptr || a->traced().radius == 0 ? 1 : -1;  // to the other surface
    for (const auto& [manifold, point] : all_points(pair)) {
      if (!stands_off(*point, scene.scales)) continue;
      const Vec3d& from = point->position;
      const Vec3d to = from + side * point->separation * manifold->normal;
      const Vec3d up = scene.camera.up();
      const Vec3d aside = kAside * scene.scales.pixel / scene.camera.pixels_per_metre(from) * up;
      for (const Vec3d& end : {from, to}) sketch.line(end, end + 1.2 * aside, {1.0f, kAxis});
      draw_gap(scene, from + aside, to + aside, point->separation, scene.noise(pair), 12, up,
               sketch);
      draw_speculative_margin(scene, from, side * manifold->normal, aside, sketch);
    }
  }
}

}  // namespace

const LayerDrawing kSweepLayer{.result = draw_sweep};

const LayerDrawing kTrailLayer{.beneath = draw_trail};

const LayerDrawing kAheadLayer{.above = draw_ahead};

}  // namespace contactscope::draw
