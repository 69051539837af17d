#include <algorithm>
#include <cmath>

#include "draw/insets/contact_plane.h"
#include "draw/scene/labels.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kLabelSize = 17;
constexpr double kDigit = 22;
constexpr Color kEdgeSeenInside = kReferenceFace;

class ChoicePen : Pen {
 public:
  ChoicePen(const ContactPlane& plane, const std::vector<Point2>& places,
            const std::vector<int>& kept)
      : Pen(plane.drawing(), plane.scale(), kLabelSize),
        plane_(plane),
        places_(places),
        kept_(kept),
        middle_(middle_of(places)),
        placer_(plane.map) {}

  void run(const std::vector<trace::Choice>& choices, std::size_t wanted) {
    shown_ = std::min(wanted, kept_.size());
    for (const Point2& place : places_) placer_.block(place, px(9));
    if (shown_ > 3) triangle(kept_[0], kept_[1], kept_[2]);
    if (shown_ == 3) side(kept_[0], kept_[1], 2.5, kContact);
    if (shown_ > 0 && shown_ <= choices.size()) {
      const trace::Choice& choice = choices[shown_ - 1];
      if (choice.rule == "support" && wanted <= choices.size()) support(choice.direction);
      for (const bool winner : {false, true}) {  // the winner on top
        for (const trace::Measure& measure : choice.measures) {
          if ((measure.point == chosen()) == winner) candidate(choice.rule, measure, winner);
        }
      }
    }
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

  Vec2d place(int point) const { return flat(places_[static_cast<std::size_t>(point)]); }
  int chosen() const { return kept_[shown_ - 1]; }

  void stroke(const Vec2d& a, const Vec2d& b, double width, const Color& color,
              double dash = 0) const {
    path({pixel(a), pixel(b)}, width, color, dash);
  }
  void side(int a, int b, double width, const Color& color) const {
    stroke(place(a), place(b), width, color);
  }
  /// From both ends of the edge that a candidate was measured against.
  void sides(const trace::Measure& measure, double width, const Color& color) const {
    for (const int end : measure.edge) side(end, measure.point, width, color);
  }
  void triangle(int a, int b, int c) const {
    fill({pixel(place(a)), pixel(place(b)), pixel(place(c))}, with_alpha(kContact, 0.16f));
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) side(from, to, 2, kContact);
  }

  /// The fixed direction, and the line at right angles to it through the point that is farthest.
  void support(const Vec3d& direction) {
    const Vec2d on_page(plane_.axes.u.dot(direction), -plane_.axes.v.dot(direction));
    if (on_page.norm() < 0.5) return;
    const Vec2d along = on_page.normalized(), across(-along.y(), along.x());
    const Vec2d at = place(chosen());
    const double half = 0.22 * std::min(plane_.map.width, plane_.map.height);
    stroke(at - half * across, at + half * across, 2, kNormal, 7);
    const Vec2d tip = middle_ + half * along;
    stroke(middle_, tip - px(8) * along, 3, kNormal);
    const double head = px(13);
    fill({pixel(tip), pixel(tip - head * along + 0.42 * head * across),
          pixel(tip - head * along - 0.42 * head * across)},
         kNormal);
    placer_.block(pixel(middle_), pixel(tip), px(8));
    labels_.push_back({middle_ - px(10) * along, "fixed direction", kText, false});
  }

  void candidate(const std::string& rule, const trace::Measure& measure, bool winner) {
    const Color color = winner ? kContact : kDropped;
    const bool by_distance = rule == "distance";
    const std::string value = by_distance || rule == "farthest" ? spell_length(measure.value)
                              : rule == "deepest"               ? spell_length(-measure.value)
                                                                : spell_signed(measure.value);
    const auto label = [&](const Vec2d& at) { labels_.push_back({at, value, color, winner}); };
    if (rule == "farthest") {
      side(kept_[0], measure.point, winner ? 3.0 : 1.2,
           winner ? kContact : with_alpha(kDropped, 0.7f));
      label((1 - 0.62) * place(kept_[0]) + 0.62 * place(measure.point));
    } else if (rule == "triangle") {
      if (winner) {
        triangle(measure.edge[0], measure.edge[1], measure.point);
      } else {
        sides(measure, 1.2, with_alpha(kDropped, 0.55f));
      }
      label(place(measure.point));
    } else if (rule == "outside" || by_distance) {
      if (winner) return outside(measure, value, by_distance);
      sides(measure, 1.2, with_alpha(kDropped, 0.55f));
      label(place(measure.point));
    } else if (rule == "deepest") {
      label(place(measure.point));
    }
  }

  /// The winner with each edge, as on the talk's slides: one negative area (or distance), and
  /// positive ones that are skipped. Of the others the one that decides.
  void outside(const trace::Measure& measure, const std::string& spelled, bool by_distance) {
    const Vec2d from = place(measure.edge[0]), to = place(measure.edge[1]);
    const Vec2d point = place(measure.point);
    const Vec2d middle = (from + to + point) / 3;
    if (!(measure.value < 0)) {
      if (by_distance) return;  // the edges that see it inside decide nothing
      fill({pixel(from), pixel(to), pixel(point)}, with_alpha(kEdgeSeenInside, 0.07f));
      for (const Vec2d& end : {from, to}) {
        stroke(end, point, 1.2f, with_alpha(kEdgeSeenInside, 0.6f), 6);
        placer_.block(pixel(end), pixel(point), px(4));
      }
      labels_.push_back({middle, spelled, kEdgeSeenInside, false, true});
      return;
    }
    hatch(convex_polygon({from, to, point}), {}, 5, 1.3, kContact);
    sides(measure, 2.5, kContact);
    if (!by_distance) {
      labels_.push_back({middle, spelled, kContact, true});
      return;
    }
    // What it went by, and what that gained.
    const Vec2d edge = to - from;
    const double share = edge.dot(point - from) / edge.squaredNorm();
    const Vec2d foot = from + share * edge;
    if (share < 0 || share > 1) stroke(share < 0 ? from : to, foot, 1.2f, kAxis, 4);
    stroke(foot, point, 4.5, kWhite);
    stroke(foot, point, 2.2, kAxis);
    labels_.push_back({0.5 * (foot + point), spelled, kAxisText, true});
    const double area = 0.5 * std::abs(contactscope::cross(edge, point - from)) /
                        std::pow(plane_.pixels_per_metre, 2);
    labels_.push_back({middle, spell_signed(-area), kContact, true});
  }

  /// Areas as the talk has them: negative outside.
  static std::string spell_signed(double area) { return (area > 0 ? "+" : "") + spell_area(area); }

  void points() {
    const auto end = kept_.begin() + static_cast<std::ptrdiff_t>(shown_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto found = std::find(kept_.begin(), end, static_cast<int>(i));
      if (found == end) {
        draw_plain_point(places_[i], *this);
        continue;
      }
      draw_kept_point(places_[i], *this, 1);
      number(places_[i], static_cast<int>(found - kept_.begin()) + 1);
    }
  }

  /// Beside the point, away from the middle.
  void number(const Point2& at, int number) {
    const Vec2d out = way_out(middle_, flat(at));
    const double reach = px(kKeptReach + 0.5 * kDigit);
    text(std::to_string(number), pixel(flat(at) + reach * out) + Point2{0, px(0.34 * kDigit)},
         Align::Center, kContact, Weight::Bold, kDigit, 2);
    placer_.block(pixel(flat(at) + px(19) * out), px(12));
  }

  void write(const Label& label) {
    const float size = px(kLabelSize);
    const Weight weight = label.bold ? Weight::Bold : Weight::Regular;
    const Vec2d way = (label.inwards ? -1.0 : 1.0) * way_out(middle_, label.at);
    const auto found =
        placer_.place(pixel(label.at), width_of(label.text, weight), 0.76f * ascent(size, weight),
                      descent(size, weight), px(14), pixel(way));
    if (!found) return;
    if (found->needs_leader) {
      stroke(label.at, flat(found->leader_end), 3.5, with_alpha(kWhite, 0.8f));
      stroke(label.at, flat(found->leader_end), 1, label.color);
    }
    text(label.text, found->left_baseline, Align::Left, label.color, weight, 0, 2.5);
  }

  const ContactPlane& plane_;
  const std::vector<Point2>& places_;
  const std::vector<int>& kept_;
  std::size_t shown_ = 0;
  Vec2d middle_;
  LabelPlacer placer_;
  std::vector<Label> labels_;
};

}  // namespace

void draw_choice(const ContactPlane& plane, const std::vector<Point2>& places,
                 const std::vector<int>& kept, const std::vector<trace::Choice>& choices,
                 int shown) {
  ChoicePen(plane, places, kept).run(choices, static_cast<std::size_t>(shown));
}

}  // namespace contactscope::draw
