#include "draw/insets/contact_cells.h"
#include "draw/scene/labels.h"
#include "draw/scene/outlines.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kLabelSize = 17, kDigit = 22;

/// The sign is the winding of the triangle.
std::string signed_area(double value) {
  return (value < 0 ? "−" : "+") + spell_area(std::abs(value));
}

struct ChoicePen : Pen {
  struct Label {
    Vec2d at;
    std::string text;
    Color color;
    bool bold;
    bool centered = false;  // centred on its place, which has room
    bool leader = true;     // if far from its place
  };

  const ContactPlane& plane;
  const std::vector<Point2>& places;
  const ContactCell& cell;
  std::size_t wanted;
  bool is_alone;

  const std::vector<int>& kept = cell.kept;
  const std::vector<trace::Choice>& choices = cell.choices;
  std::size_t shown = std::min(wanted, kept.size());
  Vec2d middle = middle_of(places);
  LabelPlacer placer{plane.map};
  std::vector<Label> labels{};
  double winding = 1;  // makes the area of the third point positive, as the fourth's triangle is

  void run() {
    for (const Point2& place : places) placer.block(place, px(9));
    if (shown > 3) {
      const std::vector<Vec2d> rim = convex_polygon(mapped(places, flat));
      for (std::size_t i = 0; is_alone && i < rim.size(); ++i)
        placer.block(pixel(rim[i]), pixel(rim[(i + 1) % rim.size()]), px(4));
      kept_before();
    }
    if (shown == 3) side(kept[0], kept[1], 2.5, kContact);
    if (shown > 0 && shown <= choices.size()) {
      const trace::Choice& choice = choices[shown - 1];
      if (choice.rule == "support" && wanted <= choices.size()) support(choice.direction);
      for (const trace::Measure& measure : choice.measures)
        if (measure.point == chosen() && measure.value < 0) winding = -1;
      for (const bool winner : {false, true}) {  // the winner on top
        for (const trace::Measure& measure : choice.measures)
          if ((measure.point == chosen()) == winner) candidate(choice.rule, measure, winner);
      }
    }
    points();
    for (const Label& label : labels)
      if (label.centered) write_centered(label);
    for (const Label& label : labels)
      if (!label.centered) write(label);
  }

  Vec2d place(int point) const { return flat(at(places, point)); }
  int chosen() const { return kept[shown - 1]; }

  void stroke(const Vec2d& a, const Vec2d& b, double width, const Color& color,
              double dash = 0) const {
    path({pixel(a), pixel(b)}, width, color, dash);
  }
  void side(int a, int b, double width, const Color& color) const {
    stroke(place(a), place(b), width, color);
  }
  /// Lines from both ends of the edge against which a candidate was measured.
  void sides(const trace::Measure& measure, double width, const Color& color) const {
    for (const int end : measure.edge) side(end, measure.point, width, color);
  }
  /// Polygon of the points kept before the shown choice.
  void kept_before() const {
    std::vector<Vec2d> corners;
    for (std::size_t k = 0; k + 1 < shown; ++k) corners.push_back(place(kept[k]));
    const std::vector<Point2> polygon =
        mapped(convex_polygon(corners), [](const Vec2d& corner) { return pixel(corner); });
    fill(polygon, with_alpha(kContact, 0.16f));
    outline(polygon, 2, kContact);
  }
  void triangle(int a, int b, int c) const {
    fill({pixel(place(a)), pixel(place(b)), pixel(place(c))}, with_alpha(kContact, 0.16f));
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) side(from, to, 2, kContact);
  }

  void arrow(const Vec2d& from, const Vec2d& tip) {
    const Vec2d along = (tip - from).normalized(), across(-along.y(), along.x());
    const double head = px(13);
    stroke(from, tip - px(8) * along, 3, kNormal);
    fill({pixel(tip), pixel(tip - head * along + 0.42 * head * across),
          pixel(tip - head * along - 0.42 * head * across)},
         kNormal);
    placer.block(pixel(from), pixel(tip), px(8));
  }

  /// The fixed direction, and the perpendicular line through the farthest point.
  void support(const Vec3d& direction) {
    const Vec2d on_page(plane.axes.u.dot(direction), -plane.axes.v.dot(direction));
    if (on_page.norm() < 0.5) return;
    const Vec2d along = on_page.normalized(), across(-along.y(), along.x());
    const Vec2d at = place(chosen());
    // The line is long enough to meet the arrow.
    const Vec2d foot = middle + (at - middle).dot(along) * along;
    const double reach = (foot - at).dot(across), past = px(40);
    const Vec2d from = at + (std::min(reach, 0.0) - past) * across,
                to = at + (std::max(reach, 0.0) + past) * across;
    stroke(from, to, 2, kNormal, 7);
    placer.block(pixel(from), pixel(to), px(6));
    labels.push_back({at, "the farthest", kText, false});
    arrow(middle, foot - px(3) * along);
    labels.push_back({middle - px(10) * along, "fixed direction", kText, false});
  }

  void candidate(const std::string& rule, const trace::Measure& measure, bool winner) {
    const Color color = winner ? kContact : kDropped;
    const bool by_distance = rule == "distance";
    const bool grows = rule == "outside" || by_distance;
    const double area = winding * measure.value;  // of a triangle, signed
    // The talk's measures are negative outside. A point inside all edges adds nothing.
    if (grows && !(measure.value < 0)) return;
    const std::string value = rule == "farthest"                 ? spell_length(measure.value)
                              : rule == "deepest" || by_distance ? spell_length(-measure.value)
                              : rule == "triangle"
                                  ? signed_area(area) + (area < 0 ? ", clockwise" : "")
                              : rule == "equally_deep" ? spell_area(std::abs(measure.value))
                                                       : spell_area(-measure.value);
    if (grows && winner) return outside(measure, value, by_distance);
    if (by_distance) offset_from_edge(measure, 1.4, with_alpha(kAxis, 0.9f));
    Vec2d at = place(measure.point);
    if (rule == "triangle" && winner) {
      triangle(measure.edge[0], measure.edge[1], measure.point);
      const bool spelled = is_alone && shown == 3;
      labels.push_back(area_label(place(measure.edge[0]), place(measure.edge[1]), at,
                                  spelled ? "½ n · (e × f) = " + value : value));
      if (spelled) cross_product(measure);
      return;
    }
    if (rule == "farthest") {
      side(kept[0], measure.point, winner ? 3.0 : 1.2,
           winner ? kContact : with_alpha(kDropped, 0.7f));
      at = (1 - 0.62) * place(kept[0]) + 0.62 * at;
    } else if (rule != "triangle" && rule != "deepest" && rule != "equally_deep" && !grows) {
      return;
    }
    labels.push_back({at, value, color, winner});
    if (grows && !by_distance && is_alone && shown == 4)
      labels.back().text +=
          " (" + spell_number(2 * measure.value / std::abs(twice_first()), 3) + ")";
  }

  /// The sides e and f whose cross product points out of the page, as the normal n does.
  void cross_product(const trace::Measure& measure) {
    Vec2d from = place(measure.edge[0]), to = place(measure.edge[1]);
    const Vec2d point = place(measure.point);
    if (contactscope::cross(to - from, point - from) > 0) std::swap(from, to);  // y is down
    const Vec2d n = (from + to + point) / 3 + px(32) * Vec2d(-2.2, 1);
    ring(pixel(n), 7, 9, kNormal);
    disc(pixel(n), 2.5, kNormal);
    text("n, out of the page", pixel(n) + Point2{px(16), px(6)}, Align::Left, kNormal);
    for (const auto& [end, name] : {std::pair{to, "e"}, {point, "f"}}) {
      arrow(from, end - px(kKeptReach) * (end - from).normalized());
      labels.push_back({0.5 * (from + end), name, kText, true});
    }
  }

  /// The winner with the edge that it is outside of; if several, the edge that decides.
  void outside(const trace::Measure& measure, const std::string& spelled, bool by_distance) {
    const Vec2d from = place(measure.edge[0]), to = place(measure.edge[1]);
    const Vec2d point = place(measure.point);
    hatch(convex_polygon({from, to, point}), {}, 5, 1.3, kContact);
    sides(measure, 2.5, kContact);
    if (!by_distance) {
      labels.push_back(area_label(from, to, point, spelled));
      if (is_alone && shown == 4) signed_areas();
      return;
    }
    // The measure that decided, and the area gained.
    const Vec2d foot = offset_from_edge(measure, 2.2, kAxis);
    labels.push_back({0.5 * (foot + point), spelled, kAxisText, true});
    const double area = 0.5 * std::abs(contactscope::cross(to - from, point - from)) /
                        std::pow(plane.pixels_per_metre, 2);
    labels.push_back(area_label(from, to, point, spell_area(area)));
  }

  /// A kept point in the contact plane, metres.
  Vec2d on_plane(std::size_t k) const {
    return plane.axes.along(at(cell.points, kept[k]).position);
  }
  double twice_first() const {
    return contactscope::cross(on_plane(1) - on_plane(0), on_plane(2) - on_plane(0));
  }

  /// The signed area of the triangle of each edge and the fourth point, as in the talk, and its share of
  /// the first triangle's area: the barycentric coordinate of the corner across. Written in a free corner of
  /// the map, if there is one.
  void signed_areas() {
    constexpr double kTableText = 14, kTableRow = 22, kColumn = 8, kInside = 4;  // pixels
    constexpr std::size_t kColumns = 4;
    using Row = std::array<std::string, kColumns>;
    const Vec2d corners[3] = {on_plane(0), on_plane(1), on_plane(2)}, point = on_plane(3);
    const double twice = twice_first();
    std::vector<Row> rows{{"triangle", "signed area", "barycentric", "−: clockwise"}};
    for (std::size_t k = 0; k < 3; ++k) {
      // Along the edges counter-clockwise, as seen.
      const std::size_t next = (k + 1) % 3, first = twice > 0 ? k : next, last = k + next - first;
      const Vec2d &from = corners[first], &to = corners[last];
      const double area = 0.5 * contactscope::cross(to - from, point - from);
      const double share = 2 * area / std::abs(twice);
      if (share < 0)
        stroke(place(kept[(k + 2) % 3]), place(kept[3]), 1.2, with_alpha(kShapeEdge, 0.6f), 6);
      rows.push_back({std::to_string(first + 1) + " " + std::to_string(last + 1) + " 4",
                      signed_area(area), (share > 0 ? "+" : "") + spell_number(share, 3),
                      share > 0 ? "inside: skipped" : "outside: added"});
    }
    const Pen table_pen(drawing(), scale(), kTableText);
    std::array<double, kColumns> widths{};
    for (const Row& row : rows)
      for (std::size_t c = 0; c < kColumns; ++c)
        widths[c] =
            std::max<double>(widths[c], table_pen.width_of(row[c], Weight::Bold) + px(kColumn));
    const double width = std::accumulate(widths.begin(), widths.end(), 0.0);
    const double height = px(kTableRow) * static_cast<double>(rows.size());
    const Outline patch = as_outline(places);
    std::optional<Rect> table;
    for (const bool low : {false, true})
      for (const bool right : {false, true}) {
        const Rect& map = plane.map;
        const Rect corner{right ? map.right() - width : map.x,
                          low ? map.bottom() - height : map.y + px(kInside), width, height};
        const Rect room = corner.grown(px(kDigit));
        const Eigen::AlignedBox2d taken(Vec2d(room.x, room.y), Vec2d(room.right(), room.bottom()));
        if (!table && !overlap(patch, taken)) table = corner;
      }
    if (!table) return;
    double baseline = table->y + px(kTableText);
    for (const Row& row : rows) {
      const bool is_head = &row == &rows.front(), adds = row[1].starts_with("−");
      const Color& color = adds ? kContact : is_head ? kQuietText : kText;
      double left = table->x;
      for (std::size_t c = 0; c < kColumns; ++c) {
        const bool is_number = c == 1 || c == 2;
        const double from = is_number ? left + widths[c] - px(kColumn) : left;
        table_pen.text(row[c], pixel(from, baseline), is_number ? Align::Right : Align::Left, color,
                       adds ? Weight::Bold : Weight::Regular);
        left += widths[c];
      }
      placer.block(pixel(table->x, baseline - px(6)),
                   pixel(table->right() - px(2 * kColumn), baseline - px(6)), px(0.4 * kTableRow));
      baseline += px(kTableRow);
    }
  }

  /// Perpendicular from the line of the edge to a point. Returns its foot.
  Vec2d offset_from_edge(const trace::Measure& measure, double width, const Color& color) const {
    const Vec2d from = place(measure.edge[0]), to = place(measure.edge[1]);
    const Vec2d point = place(measure.point), edge = to - from;
    const double share = edge.dot(point - from) / edge.squaredNorm();
    const Vec2d foot = from + share * edge;
    if (share < 0 || share > 1) stroke(share < 0 ? from : to, foot, 1.2, kAxis, 4);
    stroke(foot, point, width + 2.3, kWhite);
    stroke(foot, point, width, color);
    return foot;
  }

  void points() {
    const auto end = kept.begin() + static_cast<std::ptrdiff_t>(shown);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto found = std::find(kept.begin(), end, static_cast<int>(i));
      if (found == end) {
        draw_plain_point(places[i], *this);
        continue;
      }
      draw_kept_point(places[i], *this, 1);
      number(places[i], static_cast<int>(found - kept.begin()) + 1);
    }
    // No mark on a level patch. Choice by area may drop the deepest point.
    if (shown > 3)
      for (const int i : deepest_points(cell.points)) draw_deepest_mark(at(places, i), *this, 1);
  }

  /// Next to the point, away from the middle.
  void number(const Point2& at, int number) {
    const Vec2d out = outward(middle, flat(at));
    const double reach = px(kKeptReach + 0.5 * kDigit);
    text(std::to_string(number), pixel(flat(at) + reach * out) + Point2{0, px(0.34 * kDigit)},
         Align::Center, kContact, Weight::Bold, kDigit, 2);
    placer.block(pixel(flat(at) + px(19) * out), px(12));
  }

  void write_centered(const Label& label) {
    const Weight weight = label.bold ? Weight::Bold : Weight::Regular;
    const Vec2d half(0.5 * width_of(label.text, weight), 0);
    text(label.text, pixel(label.at) + Point2{0, px(0.34 * kLabelSize)}, Align::Center, label.color,
         weight, 0, 3);
    placer.block(pixel(label.at - half), pixel(label.at + half), px(0.6 * kLabelSize));
  }

  /// In the middle of a triangle if there is room, otherwise next to its last corner.
  Label area_label(const Vec2d& a, const Vec2d& b, const Vec2d& c,
                   const std::string& spelled) const {
    const double twice = std::abs(contactscope::cross(b - a, c - a));
    const double inscribed = 2 * twice / ((b - a).norm() + (c - b).norm() + (a - c).norm());
    const bool fits = inscribed > 1.1 * width_of(spelled, Weight::Bold);
    // Beyond the point's number.
    const Vec2d at_corner = c + px(26) * outward(middle, c);
    return {fits ? Vec2d((a + b + c) / 3) : at_corner, spelled, kContact, true, fits, false};
  }

  void write(const Label& label) {
    const float size = px(kLabelSize);
    const Weight weight = label.bold ? Weight::Bold : Weight::Regular;
    const Vec2d offset = outward(middle, label.at);
    const auto found =
        placer.place(pixel(label.at), width_of(label.text, weight), 0.76f * ascent(size, weight),
                     descent(size, weight), {px(14), pixel(offset)});
    if (!found) return;
    if (found->needs_leader && label.leader) {
      stroke(label.at, flat(found->leader_end), 3.5, with_alpha(kWhite, 0.8f));
      stroke(label.at, flat(found->leader_end), 1, label.color);
    }
    text(label.text, found->left_baseline, Align::Left, label.color, weight, 0, 2.5);
  }
};

}  // namespace

void draw_choice(const ContactPlane& plane, const std::vector<Point2>& places,
                 const ContactCell& cell, int shown, bool is_alone) {
  const Pen pen(plane.drawing(), plane.scale(), kLabelSize);
  ChoicePen{pen, plane, places, cell, static_cast<std::size_t>(shown), is_alone}.run();
}

}  // namespace contactscope::draw
