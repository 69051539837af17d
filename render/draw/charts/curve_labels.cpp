#include "draw/charts/curve_labels.h"

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr std::size_t kMaxObstacles = 60;
constexpr float kRow = 17;
constexpr float kBetweenNames = 5;  // if one of them has several rows
constexpr float kLetters = 14;
constexpr float kRing = 8;  // radius, around marked points
constexpr float kLeader = 18;
constexpr float kWidest = 150;   // of a row of a name
constexpr float kAtBorder = 12;  // a line that ends this near to the border ends there
constexpr float kOverhang = 12;  // of names, below the chart's lower border

Weight weight_of(const NamedLine& line) { return line.quiet ? Weight::Regular : Weight::Bold; }

/// Splits a name into words; a number and its unit stay together.
std::vector<std::string> words_of(const std::string& name) {
  constexpr std::array<const char*, 12> kUnits = {"%",  "×",  "ns", "µs", "ms", "s",
                                                  "µm", "mm", "cm", "m",  "km", "kg"};
  std::vector<std::string> words;
  std::istringstream all(name);
  for (std::string word; all >> word;) {
    const std::string bare = word.substr(0, word.find_last_not_of(",;:") + 1);
    const bool is_unit = std::ranges::find(kUnits, bare) != kUnits.end();
    const bool follows_number =
        !words.empty() && std::isdigit(static_cast<unsigned char>(words.back().back())) != 0;
    if (is_unit && follows_number)
      words.back() += " " + word;
    else
      words.push_back(word);
  }
  return words;
}

std::vector<std::string> rows_of(const NamedLine& line, const Pen& pen) {
  std::vector<std::string> rows;
  for (const std::string& word : words_of(line.name)) {
    const bool fits =
        !rows.empty() && pen.width_of(rows.back() + " " + word, weight_of(line)) <= pen.px(kWidest);
    if (fits)
      rows.back() += " " + word;
    else
      rows.push_back(word);
  }
  return rows;
}

/// A name to the right of a chart.
struct SideLabel {
  const NamedLine* line;
  std::vector<std::string> rows;
  float middle;  // y
};

/// Moves crowded names down, then back up from the bottom.
void spread_out(std::vector<SideLabel>& names, float row, float between, float top, float bottom) {
  std::ranges::stable_sort(names, {}, &SideLabel::middle);
  const bool any_wraps =
      std::ranges::any_of(names, [](const SideLabel& name) { return name.rows.size() > 1; });
  const auto half = [&](const SideLabel& name) {
    return 0.5f * (row * static_cast<float>(name.rows.size()) + (any_wraps ? between : 0));
  };
  float least = top;
  for (SideLabel& name : names) {
    name.middle = std::max(name.middle, least + half(name));
    least = name.middle + half(name);
  }
  float most = bottom;
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    name->middle = std::min(name->middle, most - half(*name));
    most = name->middle - half(*name);
  }
}

void write_mark(const MarkedPoint& mark, const PlacedLabel& place, const Color& color,
                const Pen& pen) {
  if (place.needs_leader) {
    const Point2 offset = place.leader_end - mark.at;
    const Point2 border = mark.at + pen.px(kRing) / std::hypot(offset.x, offset.y) * offset;
    pen.line(border, place.leader_end, 1, color);
  }
  pen.text(mark.words, pixel(place.box.x, place.box.y) + Point2{0, 0.84f * pen.px(kMarkLetters)},
           Align::Left, color, Weight::Bold, kMarkLetters, 2.5);
}

}  // namespace

std::vector<PlacedLabel> place_with_marks(const std::vector<std::pair<MarkedPoint, Color>>& marks,
                                          const std::vector<LineLabel>& labels,
                                          LabelObstacles obstacles, const Rect& room, float height,
                                          const Pen& pen) {
  const float size = pen.px(kMarkLetters);
  std::vector<LineLabel> all;
  for (const auto& [mark, color] : marks) {
    pen.ring(mark.at, pen.px(kRing - 3), pen.px(kRing + 1.5), kWhite);
    pen.ring(mark.at, pen.px(kRing - 1.8), pen.px(kRing), kText);
    obstacles.boxes.push_back(Rect{mark.at.x, mark.at.y, 0, 0}.grown(pen.px(kRing - 1)));
    all.push_back(
        {text_width(mark.words, size, FontWeight::Bold), {mark.at}, pen.px(0.6 * kRing), size});
  }
  all.insert(all.end(), labels.begin(), labels.end());
  std::vector<PlacedLabel> places = place_line_labels(all, obstacles, room, height, pen.scale());
  for (std::size_t i = 0; i < marks.size(); ++i)
    write_mark(marks[i].first, places[i], marks[i].second, pen);
  places.erase(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(marks.size()));
  return places;
}

void name_near(const std::vector<const NamedLine*>& named,
               const std::vector<std::vector<Point2>>& anchors, const std::vector<NamedLine>& lines,
               const Rect& area, const Pen& pen) {
  LabelObstacles obstacles;
  for (const NamedLine& line : lines) {
    // A subset of a long curve's points represents it.
    const std::size_t step = 1 + line.points.size() / kMaxObstacles;
    if (step == 1)
      obstacles.markers.insert(obstacles.markers.end(), line.points.begin(), line.points.end());
    for (std::size_t i = step; i < line.points.size(); i += step)
      obstacles.lines.push_back({line.points[i - step], line.points[i], 1.2f});
  }
  std::vector<LineLabel> labels;
  std::vector<std::pair<MarkedPoint, Color>> marks;
  for (const NamedLine& line : lines)
    for (const MarkedPoint& mark : line.marks) marks.emplace_back(mark, line.color);
  for (std::size_t i = 0; i < named.size(); ++i)
    labels.push_back({pen.width_of(named[i]->name, weight_of(*named[i])), anchors[i]});
  const float height = pen.px(kLetters);
  const std::vector<PlacedLabel> places =
      place_with_marks(marks, labels, obstacles, area.grown(-pen.px(4)), height, pen);
  for (std::size_t i = 0; i < named.size(); ++i) {
    const PlacedLabel& place = places[i];
    const NamedLine& line = *named[i];
    if (place.needs_leader) pen.line(place.anchor, place.leader_end, 1, line.color);
    pen.text(line.name, pixel(place.box.x, place.box.y) + Point2{0, 0.84f * height}, Align::Left,
             line.color, weight_of(line), 0, 2);
  }
}

float side_room(const std::vector<NamedLine>& lines, const Pen& pen) {
  float widest = 0;
  for (const NamedLine& line : lines)
    for (const std::string& row : rows_of(line, pen))
      widest = std::max(widest, pen.width_of(row, weight_of(line)));
  return lines.empty() ? 0 : widest + pen.px(kLeader + 2);
}

void name_at_side(const std::vector<NamedLine>& lines, const Rect& area, const Pen& pen) {
  const auto right = static_cast<float>(area.right());
  std::vector<SideLabel> side_labels;
  std::vector<const NamedLine*> inside;
  std::vector<std::vector<Point2>> anchors;
  for (const NamedLine& line : lines) {
    if (line.points.empty() || line.name.empty()) continue;
    const Point2& end = line.points.back();
    if (end.x > right - pen.px(kAtBorder)) {
      side_labels.push_back({&line, rows_of(line, pen), end.y});
    } else {
      inside.push_back(&line);
      anchors.push_back({end});
    }
  }
  name_near(inside, anchors, lines, area, pen);
  const float row = pen.px(kRow);
  spread_out(side_labels, row, pen.px(kBetweenNames), static_cast<float>(area.y),
             static_cast<float>(area.bottom()) + pen.px(kOverhang));
  const float left = right + pen.px(kLeader);
  for (const SideLabel& name : side_labels) {
    pen.line(name.line->points.back(), {left - pen.px(3), name.middle}, 1, name.line->color);
    float baseline =
        name.middle + pen.px(5) - 0.5f * row * static_cast<float>(name.rows.size() - 1);
    for (const std::string& text : name.rows) {
      pen.text(text, {left, baseline}, Align::Left, name.line->color, weight_of(*name.line));
      baseline += row;
    }
  }
}

void name_inside(const std::vector<NamedLine>& lines, const Rect& area, const Pen& pen) {
  std::vector<const NamedLine*> named;
  std::vector<std::vector<Point2>> anchors;
  for (const NamedLine& line : lines) {
    if (line.points.empty() || line.name.empty()) continue;
    named.push_back(&line);
    // Prefer anchors far from other lines, and without marks.
    std::vector<Point2> own = line.points;
    const auto is_marked = [&](const Point2& point) {
      return std::ranges::any_of(line.marks,
                                 [&](const MarkedPoint& mark) { return mark.at == point; });
    };
    if (own.size() > line.marks.size()) std::erase_if(own, is_marked);
    const auto nearest = [&](const Point2& point) {
      float least = 1e9f;
      for (const NamedLine& other : lines)
        for (const Point2& at : other.points)
          if (&other != &line) least = std::min(least, distance(at, point));
      return -least;
    };
    std::ranges::stable_sort(own, {}, nearest);
    anchors.push_back(own);
  }
  name_near(named, anchors, lines, area, pen);
}

}  // namespace contactscope::draw
