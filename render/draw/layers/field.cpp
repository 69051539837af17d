#include "draw/layers/layer.h"
#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"

/// Slice through a distance field: contour lines, with a strong line for the surface, and faint
/// cells with their own nodes or triangles. Dots are contact queries.
namespace contactscope::draw {
namespace {

constexpr int kMaxLines = 16;          // on each side of the surface
constexpr double kCellsBetween = 3;    // cells between two lines
constexpr double kFromWhisker = 8;     // pixels
constexpr double kOffSlice = 0.81;     // cells
constexpr double kBetweenProbes = 14;  // pixels
constexpr float kLineText = 17;        // pixels
constexpr double kLineGap = 5;         // pixels
constexpr double kMinNamed = 30;       // pixels from the middle of a labelled region to its border
constexpr double kFromBorder = 0.12;   // share of the view, for a line's label
constexpr Color kOutside = rgb(0x5F6B78);
constexpr Color kInside = rgb(0x6A4C93);
constexpr LineStyle kOutsideLine{1.2f, kOutside};
constexpr LineStyle kInsideLine{1.6f, kInside, true};
constexpr LineStyle kSurface{3.2f, kNormal};
constexpr LineStyle kGrid{0.9f, with_alpha(kDropped, 0.42f)};
constexpr Color kExact = rgb(0xC4E6D2, 0.6f);  // differs from a shape's grey in front of it
constexpr Color kProbe = rgb(0x3F4650);

constexpr Swatch kSurfaceSwatch{LegendGroup::Trees, 19,
                                [](auto& pen) { pen.level_line(0, 23, 3.2, kNormal); }};
constexpr Swatch kOutsideSwatch{LegendGroup::Trees, 20, [](auto& pen) {
                                  pen.level_line(0, 23, 3.2, kNormal, -3);
                                  pen.level_line(0, 23, 1.2, kOutside, 3);
                                }};
constexpr Swatch kLinesSwatch{LegendGroup::Trees, 21, [](auto& pen) {
                                pen.level_line(0, 23, 3.2, kNormal, -6);
                                pen.level_line(0, 23, 1.2, kOutside);
                                pen.dashes(1.6, kInside, 6);
                              }};
constexpr Color kCellBorder = with_alpha(kDropped, 0.5f);
constexpr Swatch kBandSwatch{LegendGroup::Trees, 23,
                             [](auto& pen) { pen.box(kWhite, kCellBorder, 1); }};
constexpr Swatch kExactSwatch{LegendGroup::Trees, 24, [](auto& pen) {
                                pen.fill(pen.block(12, 24), kExact);
                                pen.outline(pen.block(0, 12), 1, kCellBorder);
                                pen.outline(pen.block(12, 24), 1, kCellBorder);
                              }};
constexpr Swatch kProbeSwatch{LegendGroup::Trees, 25, [](auto& pen) { pen.dot(0, 4, kProbe); }};

/// Positions of a slice's cells.
class Cells {
 public:
  explicit Cells(const trace::FieldSlice& slice)
      : origin_(slice.origin),
        along_(slice.cell * slice.next.stableNormalized()),
        across_(slice.cell * slice.next_row.stableNormalized()) {}

  Vec3d corner(int column, int row) const { return origin_ + column * along_ + row * across_; }

  /// Corners of a block of cells.
  std::vector<Vec3d> block(int left, int low, int right, int high) const {
    return {corner(left, low), corner(right, low), corner(right, high), corner(left, high)};
  }

  /// Calls `visit(row, begin, end)` for each run of adjacent cells.
  template <class Visit>
  static void each_run(std::vector<std::array<int, 2>> cells, const Visit& visit) {
    std::ranges::sort(cells, [](const auto& a, const auto& b) {
      return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
    });
    for (std::size_t i = 0; i < cells.size();) {
      std::size_t end = i + 1;
      while (end < cells.size() && cells[end][1] == cells[i][1] &&
             cells[end][0] == cells[end - 1][0] + 1)
        ++end;
      visit(cells[i][1], cells[i][0], cells[end - 1][0] + 1);
      i = end;
    }
  }

 private:
  Vec3d origin_, along_, across_;
};

/// Draws the sides of cells, each once, as a few long lines.
void draw_grid(const trace::FieldSlice& slice, Sketch& sketch) {
  const Cells cells(slice);
  std::vector<std::array<int, 2>> below, right_of;  // sides, by the cell above or to the right
  for (const auto& [column, row] : slice.band) {
    below.insert(below.end(), {{column, row}, {column, row + 1}});
    right_of.insert(right_of.end(), {{row, column}, {row, column + 1}});
  }
  for (const bool upright : {false, true}) {
    auto& sides = upright ? right_of : below;
    std::ranges::sort(sides);
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    Cells::each_run(sides, [&](int line, int begin, int end) {
      const auto corner = [&](int i) {
        return upright ? cells.corner(line, i) : cells.corner(i, line);
      };
      sketch.line(corner(begin), corner(end), kGrid);
    });
  }
}

void draw_exact_cells(const trace::FieldSlice& slice, Sketch& sketch) {
  const Cells cells(slice);
  Cells::each_run(slice.exact, [&](int row, int begin, int end) {
    sketch.surfaces.push_back({cells.block(begin, row, end, row + 1), kExact});
  });
}

void explain_cells(const std::vector<trace::FieldSlice>& slices, Sketch& sketch) {
  const auto any = [&](const auto& cells) {
    return std::ranges::any_of(slices, [&](const auto& slice) { return !(slice.*cells).empty(); });
  };
  if (any(&trace::FieldSlice::exact))
    sketch.explain(kExactSwatch, "cell with its own distances, tinted: asks its triangles");
  else if (any(&trace::FieldSlice::band))
    sketch.explain(kBandSwatch, "cell with its own distances");
}

/// Whether a label has room next to the place.
bool is_well_inside(const Camera& camera, const Vec3d& at) {
  const Rect& view = camera.viewport();
  const std::optional<Point2> seen = camera.project(at);
  return seen && seen->x > view.x + kFromBorder * view.width &&
         seen->x < view.right() - kFromBorder * view.width &&
         seen->y > view.y + kFromBorder * view.height &&
         seen->y < view.bottom() - kFromBorder * view.height;
}

/// Draws contour lines. Returns their lowest rightmost place in the view, if there is one.
std::optional<Vec3d> draw_level(const Scene& scene, const trace::FieldSlice& slice, double level,
                                const LineStyle& style, Sketch& sketch) {
  std::optional<Vec3d> corner;
  const Vec3d lower_right = scene.camera.right() - scene.camera.up();
  for (const Contour& contour : contours_at(slice.distances, slice.columns, level)) {
    Curve curve{{}, style, contour.closed};
    for (const Vec3d& place : contour.points) {
      const Vec3d at = slice.origin + place.x() * slice.next + place.y() * slice.next_row;
      curve.points.push_back(at);
      if (is_well_inside(scene.camera, at) &&
          (!corner || lower_right.dot(at) > lower_right.dot(*corner)))
        corner = at;
    }
    sketch.curves.push_back(std::move(curve));
  }
  return corner;
}

/// If the view has room for fewer lines, they show nothing of the field.
constexpr double kMinLinesInView = 5;

bool has_room_for_lines(const Scene& scene, const trace::FieldSlice& slice, double spacing) {
  return scene.camera.viewport().height >
         kMinLinesInView * spacing * scene.camera.pixels_per_metre(slice.origin);
}

/// `spacing`: metres. Labels the first line on each side. Returns whether there are lines inside.
bool draw_contours(const Scene& scene, const trace::FieldSlice& slice, double spacing,
                   Sketch& sketch) {
  const auto [least, largest] = std::ranges::minmax(slice.distances);
  const double step = spacing / slice.cell;
  const std::string far = spell_quantity(spacing, "m", 1, scene.scales.length);
  const auto draw_side = [&](double sign, double end, const LineStyle& style, const char* side) {
    for (int k = 1; k * step < end; ++k) {
      const std::optional<Vec3d> at = draw_level(scene, slice, sign * k * step, style, sketch);
      if (k == 1 && at)
        sketch.label(*at, far + side, style.color, kLineText, kLineGap).bold = false;
    }
  };
  draw_side(1, largest, kOutsideLine, " outside");
  draw_side(-1, -least, kInsideLine, " inside");
  return -step > least;
}

constexpr int kCoarse = 4;  // cells along the side of a block without its own nodes

/// Number of cells along a side of a slice with this number of values.
int cells_along(const trace::FieldSlice& slice, int values, const Vec3d& step) {
  return static_cast<int>(std::lround((values - 1) * step.norm() / slice.cell));
}

/// Draws blocks whose distances are interpolated between far nodes. Returns whether there are any.
bool draw_coarse_cells(const trace::FieldSlice& slice, Sketch& sketch) {
  const int width = cells_along(slice, slice.columns, slice.next);
  const int height = cells_along(slice, slice.rows(), slice.next_row);
  std::set<std::array<int, 2>> fine;
  for (const auto& [column, row] : slice.band) fine.insert({column / kCoarse, row / kCoarse});
  if (fine.empty()) return false;
  const Cells cells(slice);
  bool any = false;
  for (int row = 0; row + kCoarse <= height; row += kCoarse) {
    for (int column = 0; column + kCoarse <= width; column += kCoarse) {
      if (fine.contains({column / kCoarse, row / kCoarse})) continue;
      sketch.curves.push_back(
          {cells.block(column, row, column + kCoarse, row + kCoarse), kGrid, true});
      any = true;
    }
  }
  return any;
}

/// Labels the largest visible region in which many cells share nodes. Without a label, the white
/// region would look as if it had no field.
void name_coarse_ground(const Scene& scene, const trace::FieldSlice& slice, Sketch& sketch) {
  const int width = cells_along(slice, slice.columns, slice.next);
  const int height = cells_along(slice, slice.rows(), slice.next_row);
  if (slice.band.empty() || width < 1 || height < 1) return;
  // Distance of each cell, in cells, to the nearest with its own nodes or to the border.
  std::vector<int> away(static_cast<std::size_t>((width + 2) * (height + 2)), 0);
  const auto at = [&](int column, int row) -> int& {
    return away[static_cast<std::size_t>((row + 1) * (width + 2) + column + 1)];
  };
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) at(column, row) = width + height;
  for (const auto& [column, row] : slice.band)
    if (column >= 0 && column < width && row >= 0 && row < height) at(column, row) = 0;
  for (const int offset : {1, -1}) {
    for (int i = 0; i < width * height; ++i) {
      const int cell = offset > 0 ? i : width * height - 1 - i;
      const int column = cell % width, row = cell / width;
      int& here = at(column, row);
      here =
          std::min({here, at(column - offset, row) + 1, at(column, row - offset) + 1,
                    at(column - offset, row - offset) + 1, at(column + offset, row - offset) + 1});
    }
  }
  // On another shape the label would seem to belong to it.
  const auto covers = [&](const Vec3d& place) {
    return [&, place](const PlacedShape& shape) {
      const Vec3d center = shape.pose.transform(shape.traced().center_of_mass);
      return shape.traced().name != slice.name && (place - center).norm() < shape.mesh->radius;
    };
  };
  const Cells cells(slice);
  // Ties go to the place nearest to the middle, because others may be at a border.
  const Vec3d slice_middle = 0.5 * (cells.corner(0, 0) + cells.corner(width, height));
  double least_off = 0;
  std::optional<Vec3d> middle;
  std::array<int, 2> block{};
  int farthest = 0;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Vec3d center = 0.5 * (cells.corner(column, row) + cells.corner(column + 1, row + 1));
      const double off = (center - slice_middle).norm();
      if (at(column, row) < farthest || (at(column, row) == farthest && off >= least_off) ||
          !is_well_inside(scene.camera, center) ||
          std::ranges::any_of(scene.shapes, covers(center)))
        continue;
      least_off = off;
      farthest = at(column, row);
      middle = center;
      block = {column - column % kCoarse, row - row % kCoarse};
    }
  }
  const double pixels =
      middle ? (farthest - 0.5) * slice.cell * scene.camera.pixels_per_metre(*middle) : 0;
  // Away from the sides of the large cells.
  const Vec3d between = 0.5 * (cells.corner(block[0], block[1]) +
                               cells.corner(block[0] + kCoarse, block[1] + kCoarse));
  if (pixels >= kMinNamed * scene.scales.pixel)
    sketch.label(between, "blended here", kQuietText, kLineText, 0).bold = false;
}

void draw_slices(const Scene& scene, Sketch& sketch) {
  double largest = 0, cell = 0;
  for (const trace::FieldSlice& slice : scene.frame.field_slices) {
    cell = std::max(cell, slice.cell);
    for (const double distance : slice.distances)
      largest = std::max(largest, slice.cell * std::abs(distance));
  }
  if (!(largest > 0)) return;
  const double spacing = round_down(std::max(kCellsBetween * cell, 2 * largest / kMaxLines));
  bool inside = false, any_lines = false;
  for (const trace::FieldSlice& slice : scene.frame.field_slices) {
    draw_exact_cells(slice, sketch);
    draw_grid(slice, sketch);
    // Contour lines would hide the sizes of the cells.
    if (!draw_coarse_cells(slice, sketch) && has_room_for_lines(scene, slice, spacing)) {
      any_lines = true;
      inside |= draw_contours(scene, slice, spacing, sketch);
    }
    draw_level(scene, slice, 0, kSurface, sketch);
    name_coarse_ground(scene, slice, sketch);
  }
  explain_cells(scene.frame.field_slices, sketch);
  if (!any_lines) {
    sketch.explain(kSurfaceSwatch, "surface of the field");
    return;
  }
  sketch.explain(
      inside ? kLinesSwatch : kOutsideSwatch,
      "surface, and lines every " + spell_quantity(spacing, "m", 1, scene.scales.length));
}

/// Whiskers of a pair on the screen.
std::vector<Segment2> seen_whiskers(const Scene& scene, const trace::Pair& pair) {
  std::vector<Segment2> whiskers;
  for (const PairPoint& point : kept_points(pair)) {
    if (!has_whisker(scene, pair, point)) continue;
    const OnBoth ends = whisker_at(scene, pair, point);
    if (const auto seen = project_segment(scene.camera, ends.on_a, ends.on_b))
      whiskers.push_back(*seen);
  }
  return whiskers;
}

/// Whether a place is within kOffSlice of the slice through one of the pair's fields.
bool is_in_slice(const Scene& scene, const trace::Pair& pair, const Vec3d& at) {
  return std::ranges::any_of(scene.frame.field_slices, [&](const trace::FieldSlice& slice) {
    const Vec3d normal = slice.next.cross(slice.next_row).stableNormalized();
    return (slice.name == pair.a || slice.name == pair.b) &&
           std::abs(normal.dot(at - slice.origin)) <= kOffSlice * slice.cell;
  });
}

/// Draws one of the probes within kBetweenProbes of each other on the screen, and none on a
/// whisker, their result. Probes before and behind the slice would seem to be inside the shape's
/// section.
void draw_probes(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.field_probes) return;
  const std::vector<Segment2> whiskers = seen_whiskers(scene, pair);
  const auto is_on_whisker = [&](const Vec3d& at) {
    const std::optional<Point2> seen = scene.camera.project(at);
    return seen && std::ranges::any_of(whiskers, [&](const Segment2& whisker) {
             return distance(whisker.nearest(*seen), *seen) < kFromWhisker * scene.scales.pixel;
           });
  };
  const Vec3d right = scene.camera.right(), up = scene.camera.up();
  std::set<std::pair<double, double>> drawn;
  for (const trace::FieldProbe& probe : pair.field_probes->probes) {
    if (!is_in_slice(scene, pair, probe.position) || is_on_whisker(probe.position)) continue;
    const double cells =
        scene.camera.pixels_per_metre(probe.position) / (kBetweenProbes * scene.scales.pixel);
    if (drawn
            .emplace(std::floor(cells * right.dot(probe.position)),
                     std::floor(cells * up.dot(probe.position)))
            .second)
      sketch.mark(MarkKind::Node, probe.position, kProbe);
  }
  if (!drawn.empty()) sketch.explain(kProbeSwatch, "asked here");
}

}  // namespace

const LayerDrawing kFieldLayer{
    .needs = {&Stages::fields}, .beneath = draw_slices, .search = draw_probes};

}  // namespace contactscope::draw
