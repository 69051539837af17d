#include "vector/pieces.h"

namespace contactscope::vector {
namespace {

// Below half a step of eight bits, no pixel changes.
constexpr float kFaintest = 0.5f / 255;
// Ends within this distance are one point, pixels: half of the resolution of two decimals.
constexpr float kSamePoint = 0.005f;
// Pieces of a curve with butt caps overlap by half a pixel at small turns, see compose.cpp.
constexpr float kLap = 0.6f;
constexpr float kLapTurn = 0.9f;  // cosine
// Neighbours with a rounded common edge overlap by less, pixels.
constexpr float kTouching = 0.02f;
// limit of translucent polygons per path: each is compared with all before it
constexpr std::size_t kMaxTranslucent = 256;

bool same(const Color& a, const Color& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a;
}

float area(const std::vector<Point2>& polygon) {
  float sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

Eigen::AlignedBox2f box_of(const std::vector<Point2>& polygon) {
  Eigen::AlignedBox2f box;
  for (const Point2& p : polygon) box.extend(Eigen::Vector2f(p.x, p.y));
  return box;
}

/// Neighbours that only touch are separated.
bool are_separated(const Eigen::AlignedBox2f& a, const Eigen::AlignedBox2f& b) {
  return (a.min().array() > b.max().array() - kTouching).any() ||
         (b.min().array() > a.max().array() - kTouching).any();
}

/// True if an edge of `a`, which has positive area, separates it from `b`.
bool has_parting_side(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point2 edge = a[(i + 1) % a.size()] - a[i];
    const float most = kTouching * length(edge);
    if (std::ranges::all_of(b, [&](const Point2& p) { return cross(edge, p - a[i]) < most; }))
      return true;
  }
  return false;
}

struct Grouping {
  Rect canvas;
  std::vector<Group> groups{};
  std::vector<Eigen::AlignedBox2f>
      extents{};  // of the current path's polygons, if it is translucent
  float run = 0;  // length of the current line, pixels

  std::vector<Piece>& pieces() { return groups.back().pieces; }
  template <class Kind> Kind* last() {
    return pieces().empty() ? nullptr : std::get_if<Kind>(&pieces().back());
  }

  void begin(const Part* part) { groups.push_back({part, {}}); }

  void add(const draw::Fill& fill) {
    std::vector<Point2> polygon = draw::clip_polygon(canvas, fill.polygon);
    if (polygon.size() < 3 || fill.color.a < kFaintest) return;
    const float size = area(polygon);
    if (size == 0) return;
    if (size < 0) std::ranges::reverse(polygon);
    FillPath* path = last<FillPath>();
    if (path == nullptr || !same(path->color, fill.color) || !may_join(*path, polygon)) {
      pieces().push_back(FillPath{{}, fill.color});
      path = last<FillPath>();
      extents.clear();
    }
    if (fill.color.a < 1) extents.push_back(box_of(polygon));
    path->polygons.push_back(std::move(polygon));
  }

  // Overlapping translucent polygons must stay distinct.
  bool may_join(const FillPath& path, const std::vector<Point2>& polygon) const {
    if (path.color.a >= 1) return true;
    if (path.polygons.size() >= kMaxTranslucent) return false;
    const Eigen::AlignedBox2f extent = box_of(polygon);
    for (std::size_t i = 0; i < extents.size(); ++i) {
      if (!are_separated(extents[i], extent) && !has_parting_side(path.polygons[i], polygon) &&
          !has_parting_side(polygon, path.polygons[i]))
        return false;
    }
    return true;
  }

  void add(const draw::Stroke& stroke) {
    if (!(stroke.width > 0) || stroke.color.a < kFaintest) return;
    if (stroke.from == stroke.to && stroke.cap == Cap::Butt) return;
    Point2 from = stroke.from, to = stroke.to;
    float phase = stroke.gap > 0 ? stroke.phase : 0;
    const Rect room = canvas.grown(stroke.width);
    if (!room.contains(from) || !room.contains(to)) {
      const std::optional<draw::Segment2> inside = draw::clip_segment(room, from, to);
      if (!inside) return;
      if (stroke.gap > 0) phase += distance(from, inside->from);
      from = inside->from;
      to = inside->to;
    }
    StrokePath* path = last<StrokePath>();
    const bool dashed = stroke.gap > 0;
    if (path != nullptr && path->width == stroke.width && same(path->color, stroke.color) &&
        path->cap == stroke.cap && path->dash == (dashed ? stroke.dash : 0) &&
        path->gap == (dashed ? stroke.gap : 0)) {
      if (continues(*path, from, to, phase)) return;
      if (!dashed || same_phase(*path, path->phase, phase)) {
        path->lines.push_back({{from, to}});
        run = distance(from, to);
        return;
      }
    }
    pieces().push_back(StrokePath{{{{from, to}}},
                                  stroke.width,
                                  stroke.color,
                                  stroke.cap,
                                  dashed ? stroke.dash : 0,
                                  dashed ? stroke.gap : 0,
                                  phase});
    run = distance(from, to);
  }

  static bool same_phase(const StrokePath& path, float a, float b) {
    const float period = path.dash + path.gap;
    const float off = std::abs(std::remainder(a - b, period));
    return off < 0.05f;  // pixels
  }

  // True if the stroke continues the current line.
  bool continues(StrokePath& path, const Point2& from, const Point2& to, float phase) {
    Polyline& line = path.lines.back();
    if (line.closed) return false;
    const bool dashed = path.gap > 0;
    Point2& end = line.points.back();
    if (distance(end, from) > kSamePoint) {
      if (dashed || path.cap != Cap::Butt || distance(end, from) > kLap) return false;
      const Point2 before = end - line.points[line.points.size() - 2], after = to - from;
      if (dot(before, after) < kLapTurn * length(before) * length(after)) return false;
      end = 0.5f * (end + from);
    }
    if (dashed && !same_phase(path, path.phase + run, phase)) return false;
    run += distance(end, to);
    const float gap = distance(line.points.front(), to);
    if (!dashed && line.points.size() > 2 && gap <= (path.cap == Cap::Butt ? kLap : kSamePoint)) {
      if (gap > kSamePoint) line.points.front() = 0.5f * (line.points.front() + to);
      line.closed = true;
    } else {
      line.points.push_back(to);
    }
    return true;
  }

  void add(const Disc& disc) {
    if (disc.outer > std::max(0.0f, disc.inner) && disc.color.a >= kFaintest &&
        canvas.grown(disc.outer).contains(disc.center))
      pieces().push_back(disc);
  }

  void add(const Text& text) {
    const bool is_seen =
        text.color.a >= kFaintest || (text.halo > 0 && text.halo_color.a >= kFaintest);
    const PlacedText at = placed(text);
    const Rect line{at.left.x, at.left.y - text.size, at.width, 2 * text.size};
    if (is_seen && at.width > 0 && canvas.overlaps(line.grown(text.halo + text.size)))
      pieces().push_back(at);
  }
};

}  // namespace

PlacedText placed(const Text& text) {
  const float width = text_width(text.text, text.size, text.weight);
  const float left = text.at.x - 0.5f * static_cast<float>(text.align) * width;
  return {&text, {std::floor(left * 4 + 0.5f) / 4, std::floor(text.at.y + 0.5f)}, width};
}

std::vector<Group> groups_of(const draw::Drawing& drawing) {
  Grouping grouping{
      {0, 0, static_cast<double>(drawing.width), static_cast<double>(drawing.height)}};
  std::size_t next = 0;  // index of the next part
  bool begun = false;    // the current part has a group
  for (std::size_t i = 0; i < drawing.primitives.size(); ++i) {
    while (next < drawing.parts.size() && drawing.parts[next].first <= i) {
      ++next;
      begun = false;
    }
    if (!begun) grouping.begin(next > 0 ? &drawing.parts[next - 1] : nullptr);
    begun = true;
    std::visit([&](const auto& shape) { grouping.add(shape); }, drawing.primitives[i]);
  }
  std::erase_if(grouping.groups, [](const Group& group) { return group.pieces.empty(); });
  return std::move(grouping.groups);
}

}  // namespace contactscope::vector
