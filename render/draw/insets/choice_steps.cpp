#include "draw/insets/choice_steps.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/hatch.h"
#include "draw/scene/labels.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kLabelSize = 17;
constexpr double kDigit = 22;

class ChoicePainter {
 public:
  ChoicePainter(const ChoiceStep& step, Drawing& drawing)
      : step_(step), pen_(drawing, step.layout.scale, kLabelSize), placer_(step.map) {
    shown_ = std::min(static_cast<std::size_t>(step.shown), step.kept.size());
    for (const Point2& place : step.places) {
      middle_ += flat(place) / static_cast<double>(step.places.size());
    }
  }

  void run() {
    for (const Point2& place : step_.places) placer_.block(place, pen_.px(9));
    const bool known = shown_ > 0 && shown_ <= step_.choices.size();
    if (shown_ > 3) triangle(step_.kept[0], step_.kept[1], step_.kept[2], kContact, 0.16f);
    if (shown_ == 3) line(step_.kept[0], step_.kept[1], 2.5f, kContact);
    if (known) candidates(step_.choices[shown_ - 1]);
    points();
    for (const Label& label : labels_) write(label);
  }

 private:
  struct Label {
    Vec2d at;
    std::string text;
    Color color;
    bool bold;
    bool inwards = false;  // goes to the middle's side of its place
  };

  const Point2& place(int point) const { return step_.places[static_cast<std::size_t>(point)]; }
  int chosen() const { return step_.kept[shown_ - 1]; }

  void line(int a, int b, float width, const Color& color) {
    stroke(place(a), place(b), width, color);
  }

  void stroke(const Point2& a, const Point2& b, double width, const Color& color, double dash = 0) {
    pen_.path({a, b}, width, color, dash);
  }

  void triangle(int a, int b, int c, const Color& color, float fill) {
    pen_.fill({place(a), place(b), place(c)}, with_alpha(color, fill));
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) line(from, to, 2, color);
  }

  void candidates(const trace::Choice& choice) {
    if (choice.rule == "support") support();
    for (const bool winner : {false, true}) {  // the winner on top
      for (const trace::Measure& measure : choice.measures) {
        if ((measure.point == chosen()) == winner) candidate(choice.rule, measure, winner);
      }
    }
  }

  /// The fixed direction, and the line at right angles to it through the point that is farthest.
  void support() {
    if (step_.direction.norm() < 0.5) return;
    const Vec2d along = step_.direction.normalized();
    const Vec2d across(-along.y(), along.x());
    const Vec2d at = flat(place(chosen()));
    const double half = 0.22 * std::min(step_.map.width, step_.map.height);
    stroke(pixel(at - half * across), pixel(at + half * across), 2, kNormal, 7);
    const Vec2d from = middle_;
    const Vec2d tip = middle_ + half * along;
    stroke(pixel(from), pixel(tip - pen_.px(8) * along), 3, kNormal);
    const double head = pen_.px(13);
    pen_.fill({pixel(tip), pixel(tip - head * along + 0.42 * head * across),
               pixel(tip - head * along - 0.42 * head * across)},
              kNormal);
    placer_.block(pixel(from), pixel(tip), pen_.px(8));
    labels_.push_back({from - pen_.px(10) * along, "fixed direction", kText, false});
  }

  void candidate(const std::string& rule, const trace::Measure& measure, bool winner) {
    const Color color = winner ? kContact : kDropped;
    if (rule == "farthest") {
      line(step_.kept[0], measure.point, winner ? 3.0f : 1.2f,
           winner ? kContact : with_alpha(kDropped, 0.7f));
      labels_.push_back({between(step_.kept[0], measure.point, 0.62), spell_length(measure.value),
                         color, winner});
    } else if (rule == "triangle") {
      if (winner) {
        triangle(measure.edge[0], measure.edge[1], measure.point, kContact, 0.16f);
      } else {
        for (const int end : measure.edge)
          stroke(place(end), place(measure.point), 1.2f, with_alpha(kDropped, 0.55f));
      }
      labels_.push_back({flat(place(measure.point)), spell_signed(measure.value), color, winner});
    } else if (rule == "outside") {
      outside(measure, spell_signed(measure.value), false, winner);
    } else if (rule == "distance") {
      outside(measure, spell_length(measure.value), true, winner);
    } else if (rule == "deepest") {
      labels_.push_back({flat(place(measure.point)), spell_length(-measure.value), color, winner});
    }
  }

  /// The winner with each edge, as on the talk's slides: one negative area (or distance), and
  /// positive ones that are skipped. Of the others the one that decides.
  void outside(const trace::Measure& measure, const std::string& spelled, bool by_distance,
               bool winner) {
    if (!winner) {
      for (const int end : measure.edge)
        stroke(place(end), place(measure.point), 1.2f, with_alpha(kDropped, 0.55f));
      labels_.push_back({flat(place(measure.point)), spelled, kDropped, false});
      return;
    }
    const std::vector<Vec2d> corners = {flat(place(measure.edge[0])), flat(place(measure.edge[1])),
                                        flat(place(measure.point))};
    const Vec2d middle = (corners[0] + corners[1] + corners[2]) / 3;
    if (!(measure.value < 0)) {
      if (by_distance) return;  // the edges that see it inside decide nothing
      pen_.fill({pixel(corners[0]), pixel(corners[1]), pixel(corners[2])},
                with_alpha(kReferenceFace, 0.07f));
      for (const int end : measure.edge) rim(place(end), place(measure.point));
      labels_.push_back({middle, spelled, kReferenceFace, false, true});
      return;
    }
    hatch(convex_polygon(corners), {}, pen_.px(5), pen_.px(1.3), kContact, pen_.drawing());
    for (const int end : measure.edge) line(end, measure.point, 2.5f, kContact);
    if (!by_distance) {
      labels_.push_back({middle, spelled, kContact, true});
      return;
    }
    // What it went by, and what that gained.
    const Vec2d edge = corners[1] - corners[0];
    const double share = edge.dot(corners[2] - corners[0]) / edge.squaredNorm();
    const Vec2d foot = corners[0] + share * edge;
    if (share < 0 || share > 1)
      stroke(pixel(share < 0 ? corners[0] : corners[1]), pixel(foot), 1.2f, kAxis, 4);
    stroke(pixel(foot), pixel(corners[2]), 4.5f, kWhite);
    stroke(pixel(foot), pixel(corners[2]), 2.2f, kAxis);
    labels_.push_back({0.5 * (foot + corners[2]), spelled, kAxisText, true});
    const double area =
        0.5 * std::abs(cross(edge, corners[2] - corners[0])) / std::pow(step_.pixels_per_metre, 2);
    labels_.push_back({middle, spell_signed(-area), kContact, true});
  }

  /// A side that labels keep off.
  void rim(const Point2& from, const Point2& to) {
    stroke(from, to, 1.2f, with_alpha(kReferenceFace, 0.6f), 6);
    placer_.block(from, to, pen_.px(4));
  }

  /// Areas as the talk has them: negative outside.
  static std::string spell_signed(double area) { return (area > 0 ? "+" : "") + spell_area(area); }

  Vec2d between(int a, int b, double share) const {
    return (1 - share) * flat(place(a)) + share * flat(place(b));
  }

  void points() {
    for (std::size_t i = 0; i < step_.places.size(); ++i) {
      const auto end = step_.kept.begin() + static_cast<std::ptrdiff_t>(shown_);
      const auto found = std::find(step_.kept.begin(), end, static_cast<int>(i));
      if (found == end) {
        draw_plain_point(step_.places[i], pen_);
        continue;
      }
      draw_kept_point(step_.places[i], pen_, 1);
      number(step_.places[i], static_cast<int>(found - step_.kept.begin()) + 1);
    }
  }

  /// Beside the point, away from the middle.
  void number(const Point2& at, int number) {
    Vec2d out = flat(at) - middle_;
    out = out.norm() > 1 ? Vec2d(out.normalized()) : Vec2d(0, -1);
    const double reach = pen_.px(kKeptReach + 0.5 * kDigit);
    pen_.text(std::to_string(number),
              {static_cast<float>(at.x + reach * out.x()),
               static_cast<float>(at.y + reach * out.y()) + pen_.px(0.34 * kDigit)},
              Align::Center, kContact, Weight::Bold, kDigit, 2);
    placer_.block(pixel(flat(at) + pen_.px(19) * out), pen_.px(12));
  }

  void write(const Label& label) {
    const float size = pen_.px(kLabelSize);
    const Weight weight = label.bold ? Weight::Bold : Weight::Regular;
    const Point2 anchor = pixel(label.at);
    Vec2d away = label.at - middle_;
    away = away.norm() > 1 ? Vec2d(away.normalized()) : Vec2d(0, -1);
    if (label.inwards) away = -away;
    const auto found =
        placer_.place(anchor, pen_.width_of(label.text, weight), 0.76f * ascent(size, weight),
                      descent(size, weight), pen_.px(14), pixel(away));
    if (!found) return;
    if (found->needs_leader) {
      stroke(anchor, found->leader_end, 3.5f, with_alpha(kWhite, 0.8f));
      stroke(anchor, found->leader_end, 1, label.color);
    }
    pen_.text(label.text, found->left_baseline, Align::Left, label.color, weight, 0, 2.5);
  }

  const ChoiceStep& step_;
  Pen pen_;
  LabelPlacer placer_;
  std::size_t shown_ = 0;
  Vec2d middle_ = Vec2d::Zero();
  std::vector<Label> labels_;
};

}  // namespace

void draw_choice(const ChoiceStep& step, Drawing& drawing) {
  ChoicePainter(step, drawing).run();
}

}  // namespace contactscope::draw
