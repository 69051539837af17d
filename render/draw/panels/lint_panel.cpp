#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

// The panel's rows without its heading, alone and above the rankings.
constexpr std::size_t kRows = 16, kRowsAboveRankings = 11;
constexpr std::size_t kOfFault = 3;  // places of a fault that are listed
constexpr LineStyle kFaultOutline{1.8f, kText, true}, kFitOutline{2.4f, kDropped, true};

constexpr std::size_t kNotTimes = 3;  // rows for the axis of time and two places
// Height of a finding's time, in rows, and from there to its places and to the next finding.
constexpr double kStrip = 0.4, kBelowStrip = 0.6, kBetween = 0.4;
constexpr float kNormalLength = 64;  // pixels
constexpr double kMuchLarger = 4;    // than the smallest body: no outline

constexpr Swatch kFaultSwatch{LegendGroup::Points, 12, [](auto& pen) { pen.dot(5.6, 7.4, kText); }};

constexpr Swatch kSurfaceNormalSwatch{LegendGroup::Forces, 2,
                                      [](auto& pen) { pen.open_arrow(2, kDropped); }};

constexpr Swatch kFitSwatch{LegendGroup::Shapes, 4, [](auto& pen) { pen.dashes(2.4, kDropped); }};

constexpr Swatch kPathSwatch{LegendGroup::Motion, 1, [](auto& pen) { pen.arrow(3, 12, kMotion); }};

/// A cause in words; some codes are too short to be understood.
std::string cause_in_words(const std::string& cause) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"separation", "wrong separations"},
      {"surface", "points off the surfaces"},
      {"side", "on_a or on_b off"},
      {"normal", "wrong normals"},
      {"deepest", "no point as deep"}};
  const auto known =
      std::ranges::find(kWords, cause, &std::pair<std::string_view, std::string_view>::first);
  return known == std::end(kWords) ? in_words(cause) : std::string(known->second);
}

/// The places of a fault in one frame, each pair once, numbered over all faults.
struct InFrame {
  const Fault* fault;
  std::vector<const Fault::Place*> places{};
  std::size_t before = 0;  // listed places of the faults before
  std::size_t room = 0;    // rows of the panel for the places

  std::size_t listed() const {
    const std::size_t all = std::min(places.size(), kOfFault);
    return all == places.size() && all <= room ? all
                                               : std::min(all, std::max<std::size_t>(room, 1) - 1);
  }
  /// Whether a row counts the places that are not listed.
  bool counts_others() const { return listed() < places.size() && room > 0; }
  /// "!2": of a place, in the panel and in the view.
  std::string number(std::size_t i) const { return "!" + std::to_string(before + i + 1); }
};

std::size_t rows_in(const View& view) {
  return view.shows(Panel::Worst) ? kRowsAboveRankings : kRows;
}
/// The number of findings with a row for their time.
std::size_t times_in(const View& view) {
  const bool over_time = std::ranges::any_of(view.faults, [](const Fault& fault) {
    return !fault.frames.empty() && fault.frames.front() != fault.frames.back();
  });
  if (!over_time) return 0;
  const std::size_t taken = view.faults.size() + kNotTimes;
  return std::min(view.faults.size(), rows_in(view) - std::min(rows_in(view), taken));
}

std::vector<InFrame> faults_in(const View& view, int frame) {
  std::vector<InFrame> all;
  // Each fault has a row for its cause; the first ones share the others.
  const std::size_t rows = rows_in(view), times = times_in(view);
  std::size_t room = rows - std::min(rows, view.faults.size() + times + (times > 0 ? 1 : 0));
  for (const Fault& fault : view.faults) {
    InFrame here{&fault};
    if (!all.empty()) here.before = all.back().before + all.back().listed();
    here.room = room;
    for (const Fault::Place& place : fault.places)
      if (place.frame == frame && !place.a.empty() &&
          std::ranges::none_of(here.places, [&](const auto* other) {
            return other->a == place.a && other->b == place.b;
          }))
        here.places.push_back(&place);
    room -= here.listed() + here.counts_others();
    all.push_back(std::move(here));
  }
  return all;
}

/// The findings of lint, and the pairs that they name in the drawn frame, with their numbers in the
/// view.
class LintPanel : public PanelContent {
 public:
  using PanelContent::PanelContent;

  PanelNeed need(const PanelMoment&) const override {
    const auto high = [&](std::size_t rows) {
      return Sheet::heading_height(scale_) + static_cast<float>(rows) * Sheet::line_height(scale_);
    };
    const std::size_t rows =
        std::min(rows_in(staging_.view), by_overlap_ + 5 * staging_.view.faults.size() +
                                             (times_ > 0 ? times_ + kNotTimes : 0));
    return {high(rows), high(rows), high(rows), 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const std::vector<InFrame> faults = faults_in(staging_.view, frames_[moment.frame].frame);
    const auto conditions = std::ranges::count_if(staging_.view.faults, &Fault::is_condition);
    const std::size_t findings = faults.size() - static_cast<std::size_t>(conditions);
    const bool ignores = staging_.view.ignores_faults;
    sheet.heading(faults.empty()
                      ? ignores ? "lint: nothing else is wrong" : "lint: nothing is wrong"
                  : findings == 0 ? "pairs for which the condition holds"
                                  : "lint: " + counted(findings, "finding", "findings"));
    const auto height = static_cast<double>(sheet.line_height());
    const auto row = [&](const std::string& text, const std::string& value = "") {
      const Rect rest = sheet.rest();
      const double baseline = rest.y + 0.78 * height;
      const Pen& pen = sheet.pen();
      const Weight weight = value.empty() ? Weight::Regular : Weight::Bold;
      const float room = static_cast<float>(rest.width) - pen.px(10) - pen.width_of(Said{value});
      if (!value.empty())
        pen.text(Said{value}, pixel(rest.right(), baseline), Align::Right, kQuietText);
      pen.text(pen.fitted(text, weight, room), pixel(rest.x, baseline), Align::Left, kText, weight);
      sheet.skip_to(rest.y + height);
    };
    if (by_overlap_) row("in view: the largest overlap for its body's size");
    for (const InFrame& one : faults) {
      const Fault& fault = *one.fault;
      const auto left = static_cast<std::size_t>(faults.data() + faults.size() - &one);
      if (sheet.rest().height + 1 < std::min<double>(2, double(left)) * height) {
        row("and " + counted(left, "more finding", "more findings"));
        break;
      }
      row(fault.is_condition ? fault.cause : cause_in_words(fault.cause),
          (fault.of > 0 ? spell_count(fault.count) + " of " + spell_count(fault.of)
                        : counted(static_cast<std::size_t>(fault.count), "time", "times")) +
              (one.places.empty() ? ", frame " + std::to_string(fault.first) : ""));
      const bool has_time = faults.size() - left < times_;
      if (has_time) draw_times(fault, moment.frame, sheet);
      for (std::size_t i = 0; i < one.listed(); ++i) {
        const Fault::Place& place = *one.places[i];
        row(one.number(i) + "  " + name_in_words(place.a) +
            (place.b.empty() ? "" : " and " + name_in_words(place.b)));
      }
      if (one.counts_others()) {
        const std::string noun = one.places.front()->b.empty() ? "more shape" : "more pair";
        row("and " + counted(one.places.size() - one.listed(), noun, noun + "s"));
      }
      if (has_time) sheet.skip_to(sheet.rest().y + kBetween * height);
    }
    if (times_ > 0) {
      const Rect rest = sheet.rest();
      draw_time_axis(frames_, rest.x, rest.width, rest.y + 0.6 * height, sheet.pen());
      sheet.skip_to(rest.y + height);
    }
    const Fault* const first = faults.empty() ? nullptr : faults[0].fault;
    if (first == nullptr || first->first != frames_[moment.frame].frame) return {};
    const std::string detail = "!1: " + first->detail;
    const auto lines = wrapped(detail, sheet.text_height(), float(sheet.rest().width));
    if (!first->detail.empty() && double(lines.size()) * height <= sheet.rest().height)
      sheet.paragraph(detail, kQuietText);
    return {};
  }

 private:
  /// The frames in which it occurs, on a line of time.
  void draw_times(const Fault& fault, std::size_t moment, Sheet& sheet) const {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const Rect strip{rest.x, rest.y, rest.width, kStrip * sheet.line_height()};
    pen.fill(strip, with_alpha(kQuietText, 0.12f));
    const double first = frames_.front().frame, all = frames_.back().frame - first + 1;
    const double width = std::max<double>(strip.width / all, pen.px(1.5));
    for (const int frame : fault.frames)
      if (frame >= first)
        pen.fill({strip.x + strip.width * (frame - first) / all, strip.y, width, strip.height},
                 kText);
    draw_moment(strip, frames_.size(), moment, pen);
    sheet.skip_to(rest.y + kBelowStrip * sheet.line_height());
  }

  const std::size_t times_ = times_in(staging_.view);
  /// Whether lint has nothing to focus on.
  const bool by_overlap_ = staging_.view.focus == Focus::Worst && !staging_.view.first_fault();
};

/// The reported normal at a place, and the one that the shapes have there.
void draw_both_normals(const trace::Pair& pair, const Vec3d& at, const Vec3d& normal,
                       Sketch& sketch) {
  const auto of_manifold = [&](const trace::Manifold& manifold) {
    double least = std::numeric_limits<double>::infinity();
    for (const trace::Point& point : manifold.points)
      least = std::min(least, (point.position - at).norm());
    return least;
  };
  if (pair.manifolds.empty()) return;
  // If several manifolds have the point, the one that lint names.
  const double nearest = of_manifold(std::ranges::min(pair.manifolds, {}, of_manifold));
  const auto cosine = [&](const trace::Manifold& manifold) {
    return of_manifold(manifold) > nearest ? 2 : manifold.normal.dot(normal);
  };
  const Vec3d reported = std::ranges::min(pair.manifolds, {}, cosine).normal;
  sketch.arrow(at, normal, kNormalLength, 2.5f, 11, kDropped).open = true;
  const bool is_drawn = std::ranges::any_of(sketch.arrows, [&](const Arrow& arrow) {
    return arrow.from == at && arrow.direction == reported;
  });
  if (!is_drawn) sketch.arrow(at, reported, kNormalLength, 3, 13, kNormal);
  const double angle = std::atan2(reported.cross(normal).norm(), reported.dot(normal));
  sketch.label(at, printed("%.0f°", angle * 180 / std::numbers::pi), kText, 16, 30,
               (reported + normal).normalized());
  sketch.explain(kNormalSwatch, "normal, from A to B", at);
  sketch.explain(kSurfaceNormalSwatch, "normal that the shapes have there", at);
}

/// A shape at the size that its contacts fit, if that is another one.
void draw_fit(const Scene& scene, const Fault& fault, PlacedShape shape, Sketch& sketch) {
  const auto& [name, scale] = fault.fits;
  if (scale == 0 || !(name.empty() || name == shape.traced().name)) return;
  for (Vec3d& vertex : shape.vertices)
    vertex = shape.pose.position + scale * (vertex - shape.pose.position);
  if (const double radius = shape.traced().radius; radius > 0)
    sketch.curves.push_back(
        {RoundBody{shape.vertices, scale * radius}.outline(scene.camera), kFitOutline, true});
  else
    draw_ghost(scene.camera, shape, kFitOutline, sketch);
  sketch.explain(kFitSwatch, "size that the contacts fit", shape.vertices.front());
}

/// Where a body was, and where it is a step later.
void draw_path(const std::array<Vec3d, 2>& path, Sketch& sketch, bool is_named) {
  const Vec3d step = path[1] - path[0];
  sketch.arrow_to_scale(path[0], step, 3, 12, kMotion);
  if (!is_named) return;
  sketch.label(path[0], spell_length(step.norm()) + " in a step", kMotion, 16, 14,
               step.normalized());
  sketch.explain(kPathSwatch, "step of a body", path[0]);
}

}  // namespace

void draw_faults(const Scene& scene, Sketch& sketch) {
  for (const InFrame& one : faults_in(scene.view, scene.frame.frame)) {
    for (std::size_t i = 0; i < one.listed(); ++i) {
      const Fault::Place& place = *one.places[i];
      const std::string &a = place.a, &b = place.b;
      sketch.begin("lint", b.empty() ? a : a + " " + b);
      const auto pair = std::ranges::find_if(scene.frame.pairs, [&](const trace::Pair& of) {
        return std::minmax(of.a, of.b) == std::minmax(a, b);
      });
      const bool is_reported = pair != scene.frame.pairs.end();
      const bool is_first = one.before + i == 0;
      const bool is_outlined = is_reported && scene.scales.heap && !pair->manifolds.empty();
      std::optional<Vec3d> at;
      double least = std::numeric_limits<double>::infinity();
      for (const std::string* name : {&a, &b}) {
        const PlacedShape* const shape = scene.find(*name);
        if (shape == nullptr || shape->traced().half_space) continue;
        if (is_first && !is_outlined &&
            shape->mesh->radius < kMuchLarger * scene.meshes.smallest_radius())
          draw_ghost(scene.camera, *shape, kFaultOutline, sketch);
        if (is_first) draw_fit(scene, *one.fault, *shape, sketch);
        // Where the pair has no contact: the smaller body.
        if (shape->mesh->radius < least) at = mean_of(shape->vertices);
        least = std::min(least, shape->mesh->radius);
      }
      if (is_reported)
        if (const auto deepest = deepest_contact(*pair)) at = deepest->point->position;
      if (place.at) at = place.at;
      if (!at || !scene.camera.sees(*at)) continue;
      if (is_reported && place.normal && one.before == 0)
        draw_both_normals(*pair, *at, *place.normal, sketch);
      if (place.path) draw_path(*place.path, sketch, is_first);
      sketch.mark(MarkKind::WideRing, *at, kText);
      const bool is_named =
          !b.empty() || (!place.path && std::ranges::count(scene.view.focus_on, a) > 0);
      const std::string name = is_named ? "" : " " + name_in_words(a);
      sketch.label(*at, one.number(i) + name, kText, 16, 10);
      sketch.explain(kFaultSwatch,
                     one.fault->is_condition ? "the condition holds" : "named by lint", *at);
    }
    for (std::size_t i = one.listed(); i < one.places.size(); ++i)
      if (const auto& path = one.places[i]->path) draw_path(*path, sketch, false);
  }
}

const PanelDrawing kLintPanel{.make = make_panel<LintPanel>};

}  // namespace contactscope::draw
