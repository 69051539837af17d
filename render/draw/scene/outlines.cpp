#include "draw/scene/outlines.h"

#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kMaxBodySides =
    160;  // faces of bodies; with more, as on a landscape, nothing counts as hidden

/// The part of `polygon` to the left of the line through two points, or to its right.
Outline cut(const Outline& polygon, const Vec2d& from, const Vec2d& to, bool left) {
  const double sign = left ? 1 : -1;
  return clipped(
      polygon, [&](const Vec2d& p) { return sign * turn(from, to, p); },
      [](const Vec2d& p, const Vec2d& q, double at_p, double at_q) -> Vec2d {
        return p + at_p / (at_p - at_q) * (q - p);
      });
}

/// Crossings of the contour lines with the sides of the grid's squares. The side from grid point i
/// to the next column has number 2 i, the side to the next row 2 i + 1.
class Crossings {
 public:
  Crossings(std::span<const double> values, int columns, double level)
      : values_(values),
        columns_(columns),
        rows_(count_of(values) / columns),
        level_(level),
        next_(2 * values.size(), {-1, -1}) {
    for (int row = 0; row + 1 < rows_; ++row)
      for (int column = 0; column + 1 < columns_; ++column) join_sides_of(column, row);
  }

  std::vector<Contour> lines() {
    std::vector<Contour> found;
    // First the open lines, which end at the border. The remaining ones are closed.
    for (const bool closed : {false, true}) {
      for (int side = 0; side < count_of(next_); ++side) {
        const auto& [one, other] = at(next_, side);
        if (one >= 0 && (closed || other < 0)) found.push_back(follow(side, closed));
      }
    }
    return found;
  }

 private:
  bool above(int column, int row) const { return at(values_, row * columns_ + column) > level_; }

  void join_sides_of(int column, int row) {
    const int corner = row * columns_ + column;
    // Below, right, above, left; side k runs from corner k to the next, counter-clockwise.
    const std::array<int, 4> sides{2 * corner, 2 * (corner + 1) + 1, 2 * (corner + columns_),
                                   2 * corner + 1};
    const std::array<bool, 4> high{above(column, row), above(column + 1, row),
                                   above(column + 1, row + 1), above(column, row + 1)};
    std::array<int, 4> crossed{};
    int count = 0;
    for (int k = 0; k < 4; ++k)
      if (at(high, k) != at(high, (k + 1) % 4)) at(crossed, count++) = at(sides, k);
    if (count == 2) return join(crossed[0], crossed[1]);
    if (count == 0) return;
    const double mean = (at(values_, corner) + at(values_, corner + 1) +
                         at(values_, corner + columns_) + at(values_, corner + columns_ + 1)) /
                        4;
    // Ambiguous: corners 0 and 2 are connected if the middle is on their side of the level.
    const bool joined = (mean > level_) == high[0];
    join(sides[0], sides[joined ? 1 : 3]);
    join(sides[2], sides[joined ? 3 : 1]);
  }

  void join(int one, int other) {
    const auto add = [this](int side, int to) {
      auto& [first, second] = at(next_, side);
      (first < 0 ? first : second) = to;
    };
    add(one, other);
    add(other, one);
  }

  Vec3d place(int side) const {
    const int from = side / 2, to = from + (side % 2 == 0 ? 1 : columns_);
    const double low = at(values_, from), high = at(values_, to);
    const double part = (level_ - low) / (high - low);
    const Vec3d start(from % columns_, from / columns_, 0);
    return start + part * (side % 2 == 0 ? Vec3d::UnitX() : Vec3d::UnitY());
  }

  /// If the line connects two grid points across a square whose third corner is also on the level,
  /// it passes through that corner. Otherwise corners of a solid on the grid would be cut off.
  void go_to(const Vec3d& to, std::vector<Vec3d>& points) const {
    if (!points.empty()) {
      const Vec3d from = points.back();
      const bool on_grid =
          from == from.array().round().matrix() && to == to.array().round().matrix();
      for (const Vec3d& turn : {Vec3d(from.x(), to.y(), 0), Vec3d(to.x(), from.y(), 0)}) {
        if (!on_grid || turn == from || turn == to) continue;
        if (at(values_, static_cast<int>(turn.y()) * columns_ + static_cast<int>(turn.x())) ==
            level_)
          points.push_back(turn);
      }
    }
    points.push_back(to);
  }

  /// Removes the links that it follows.
  Contour follow(int start, bool closed) {
    Contour line{{}, closed};
    for (int side = start, before = -1; side >= 0;) {
      go_to(place(side), line.points);
      auto& neighbours = at(next_, side);
      const int on = neighbours[0] != before ? neighbours[0] : neighbours[1];
      neighbours = {-1, -1};
      before = side;
      side = on == start ? -1 : on;
    }
    if (closed) {
      go_to(Vec3d(line.points.front()), line.points);
      line.points.pop_back();
    }
    return line;
  }

  std::span<const double> values_;
  int columns_, rows_;
  double level_;
  std::vector<std::array<int, 2>> next_;  // for each side, the two sides to which lines continue
};

}  // namespace

Outline as_outline(const std::vector<Point2>& polygon) {
  return convex_polygon(mapped(polygon, flat));
}

Outline outline_around(const Camera& camera, std::span<const Vec3d> points) {
  std::vector<Vec2d> seen = projected(camera, points);
  return seen.size() < 3 ? Outline() : convex_polygon(std::move(seen));
}

// Separating axis test.
bool overlap(const Outline& polygon, const Eigen::AlignedBox2d& box) {
  if (polygon.size() < 3) return false;
  Eigen::AlignedBox2d around;
  for (const Vec2d& p : polygon) around.extend(p);
  if (!around.intersects(box)) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto is_outside = [&](int corner) {
      return turn(polygon[i], polygon[(i + 1) % polygon.size()],
                  box.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner))) < 0;
    };
    if (is_outside(0) && is_outside(1) && is_outside(2) && is_outside(3)) return false;
  }
  return true;
}

bool lies_on(const Outline& polygon, const Eigen::AlignedBox2d& box) {
  if (polygon.size() < 3) return false;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2d at = box.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner));
    for (std::size_t i = 0; i < polygon.size(); ++i)
      if (turn(polygon[i], polygon[(i + 1) % polygon.size()], at) < 0) return false;
  }
  return true;
}

std::vector<Outline> without(const std::vector<Outline>& polygons, const Outline& hole) {
  constexpr double kMinArea = 0.01;  // square pixels: a long sliver may hold a pixel's middle
  std::vector<Outline> result;
  for (Outline rest : polygons) {
    for (std::size_t i = 0; i < hole.size() && rest.size() > 2; ++i) {
      const Vec2d &from = hole[i], &to = hole[(i + 1) % hole.size()];
      Outline outside = cut(rest, from, to, false);
      if (outside.size() > 2 && area_of(outside) > kMinArea) result.push_back(std::move(outside));
      rest = cut(rest, from, to, true);
    }
  }
  return result;
}

std::vector<Outline> with_shared_corners(std::vector<Outline> pieces) {
  constexpr double kOnEdge = 0.01;           // pixels
  constexpr std::size_t kMaxCorners = 2000;  // the time grows with their square
  std::vector<Vec2d> corners;
  for (const Outline& piece : pieces) corners.insert(corners.end(), piece.begin(), piece.end());
  if (corners.size() > kMaxCorners) return pieces;
  for (Outline& piece : pieces) {
    Outline joined;
    std::vector<bool> begins_whole;  // whether an edge has no further corner
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec2d &from = piece[i], edge = piece[(i + 1) % piece.size()] - from;
      const double length = edge.norm();
      std::vector<std::pair<double, Vec2d>> on;  // by distance from the edge's begin
      for (const Vec2d& corner : corners) {
        const double along = edge.dot(corner - from) / length;
        if (along > kOnEdge && along < length - kOnEdge &&
            std::abs(cross(edge, corner - from)) < kOnEdge * length)
          on.emplace_back(along, corner);
      }
      std::ranges::sort(on, {}, &std::pair<double, Vec2d>::first);
      joined.push_back(from);
      begins_whole.push_back(on.empty());
      for (const auto& [along, corner] : on) {
        if (corner == joined.back()) continue;
        joined.push_back(corner);
        begins_whole.push_back(false);
      }
    }
    // Filled as a fan about its first corner, next to which no corner should be on a line.
    for (std::size_t i = 0; i < joined.size(); ++i) {
      if (!begins_whole[i] || !begins_whole[(i + joined.size() - 1) % joined.size()]) continue;
      std::rotate(joined.begin(), joined.begin() + static_cast<std::ptrdiff_t>(i), joined.end());
      break;
    }
    piece = std::move(joined);
  }
  return pieces;
}

std::vector<Outline> outlines_before(const std::vector<Point2>& polygon, const Camera& camera,
                                     std::span<const Surface> surfaces) {
  const Outline whole = as_outline(polygon);
  Eigen::AlignedBox2d box;
  for (const Vec2d& p : whole) box.extend(p);
  std::vector<Outline> found;
  std::map<int, std::vector<Vec2d>> round;
  for (const Surface& surface : surfaces) {
    // An opaque body hides the polygon by itself.
    if (surface.kind != Surface::Kind::Body || surface.color.a >= 1) continue;
    std::vector<Point2> seen = project_polygon(camera, surface.polygon);
    if (seen.empty()) continue;
    if (surface.body >= 0) {
      for (const Point2& p : seen) round[surface.body].push_back(flat(p));
      continue;
    }
    Eigen::AlignedBox2d own;
    for (const Point2& p : seen) own.extend(flat(p));
    if (!own.intersects(box)) continue;
    if (found.size() == kMaxBodySides) return {};
    found.push_back(as_outline(seen));
  }
  for (auto& [body, points] : round) found.push_back(convex_polygon(std::move(points)));
  std::erase_if(found, [](const Outline& outline) { return outline.size() < 3; });
  return found;
}

std::vector<Contour> contours_at(std::span<const double> values, int columns, double level) {
  assert(columns > 0 && values.size() % static_cast<std::size_t>(columns) == 0);
  return Crossings(values, columns, level).lines();
}

}  // namespace contactscope::draw
