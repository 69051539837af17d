#include "draw/layers/layer.h"
#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

/// Collection of a mesh's candidate triangles: Gregorius 2015, "Mesh Contacts".
namespace contactscope::draw {
namespace {

constexpr float kLeftOut = 0.22f;  // opacity of skipped boxes

constexpr Swatch kQuerySwatch{LegendGroup::Trees, 0, [](auto& pen) { pen.area(kNormal, 0, 2); }};
constexpr Swatch kBoxSwatch{LegendGroup::Trees, 1, [](auto& pen) { pen.area(kBox, 0, 2.5); }};
constexpr Swatch kMissSwatch{LegendGroup::Trees, 2,
                             [](auto& pen) { pen.area(kDropped, kLeftOut, 1.5); }};

constexpr double kSeam = 3;  // pixels between a box's side and its drawing

/// Boxes of a tree share sides. Each is drawn slightly smaller, so that sides can be distinguished.
trace::Box drawn_box(const Scene& scene, const trace::Box& box, const PlacedShape& mesh) {
  const Vec3d middle = mesh.pose.transform(0.5 * (box.lower + box.upper));
  const double seam = kSeam * scene.scales.pixel / scene.camera.pixels_per_metre(middle);
  trace::Box drawn = box;
  for (int k = 0; k < 3; ++k) {
    if (drawn.upper[k] - drawn.lower[k] < 4 * seam) continue;
    drawn.lower[k] += seam;
    drawn.upper[k] -= seam;
  }
  return drawn;
}

// Section through the middle of a box across its shortest side: the whole box on a flat mesh.
std::vector<Vec3d> widest_cut(const trace::Box& box, const PlacedShape& mesh) {
  int shortest = 0;
  const Vec3d sizes = box.upper - box.lower;
  sizes.minCoeff(&shortest);
  std::vector<Vec3d> corners = sides_of(solid_box(box))[2 * static_cast<std::size_t>(shortest)];
  for (Vec3d& corner : corners) {
    corner[shortest] = 0.5 * (box.lower[shortest] + box.upper[shortest]);
    corner = mesh.pose.transform(corner);
  }
  return corners;
}

const PlacedShape* mesh_of(const Scene& scene, const trace::Pair& pair) {
  return pair.tree ? scene.find(pair.tree->shape) : nullptr;
}

/// Triangles that a query found. Each is then tested for contacts.
void draw_candidates(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* mesh = mesh_of(scene, pair);
  if (mesh == nullptr) return;
  for (const int candidate : pair.tree->candidates) {
    if (candidate < 0 || candidate >= count_of(mesh->traced().faces)) continue;
    // Inside boxes of the tree, their sides are weaker.
    const bool boxed = scene.shows(Layer::Tree);
    sketch.face(mesh->polygon(candidate), with_alpha(kClipPolygon, boxed ? 0.3f : 0.22f),
                {boxed ? 1.0f : 1.5f, with_alpha(kClipPolygon, boxed ? 0.5f : 1), false,
                 LineStyle::Hidden::Faint});
    sketch.explain(kClipPolygonSwatch, "candidate triangle", mean_of(mesh->polygon(candidate)));
  }
}

/// The query box, which overlaps the boxes of the found triangles.
void draw_query(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* mesh = mesh_of(scene, pair);
  if (mesh == nullptr) return;
  outline(pair.tree->box, mesh->pose, {2.0f, kNormal, false, LineStyle::Hidden::Faint}, sketch);
  sketch.explain(kQuerySwatch, "box of the shape that asks",
                 mesh->pose.transform(pair.tree->box.upper));
}

void draw_tree(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* mesh = mesh_of(scene, pair);
  if (mesh == nullptr) return;
  if (!scene.shows(Layer::Candidates)) draw_candidates(scene, pair, sketch);
  // Skipped boxes below found ones. An entered inner node is visible through its children.
  for (const bool found : {false, true}) {
    for (const trace::TreeVisit& visit : pair.tree->visits) {
      if (visit.overlaps != found || (found && !visit.leaf)) continue;
      const trace::Box box = drawn_box(scene, visit.box, *mesh);
      if (!found)
        sketch.surfaces.push_back({widest_cut(box, *mesh), with_alpha(kDropped, kLeftOut)});
      outline(box, mesh->pose, found ? LineStyle{3.0f, kBox} : LineStyle{2.5f, kDropped}, sketch);
      sketch.explain(found ? kBoxSwatch : kMissSwatch,
                     found ? "box of triangles that are tested" : "box left out, with all below",
                     mesh->pose.transform(visit.box.upper));
    }
  }
  if (!scene.shows(Layer::Candidates)) draw_query(scene, pair, sketch);
  const auto left_out = [&](const trace::TreeVisit& visit) {
    const auto is_within = [&](int corner) {
      return solid_box(visit.box).contains(at(mesh->traced().vertices, corner));
    };
    return std::ranges::count_if(mesh->traced().faces, [&](const std::vector<int>& face) {
      return !visit.overlaps && std::ranges::all_of(face, is_within);
    });
  };
  const auto most = std::ranges::max_element(pair.tree->visits, {}, left_out);
  if (most != pair.tree->visits.end() && left_out(*most) > 1)
    sketch.label(mesh->pose.transform(0.5 * (most->box.lower + most->box.upper)),
                 "a node: " + std::to_string(left_out(*most)) + " triangles left out at once",
                 kText, 16, 0);
}

constexpr Swatch kDeformedSwatch{LegendGroup::Trees, 5, [](auto& pen) { pen.area(kBox, 0, 1.5); }};

// Boxes share faces, and coincident lines add up, so they are lighter instead of translucent.
constexpr Color kLightBox = {0.3f + 0.7f * kBox.r, 0.3f + 0.7f * kBox.g, 0.3f + 0.7f * kBox.b, 1};

constexpr Swatch kLargestSwatch{LegendGroup::Trees, 6, [](auto& pen) { pen.area(kBox, 0.16f, 3); }};

/// Highlights one of many overlapping boxes, to show how much they have grown.
void draw_largest(const std::vector<trace::Box>& boxes, const PlacedShape& mesh, Sketch& sketch) {
  const auto volume = [](const trace::Box& box) { return (box.upper - box.lower).prod(); };
  const trace::Box& largest = *std::ranges::max_element(boxes, {}, volume);
  for (std::vector<Vec3d>& side : sides_of(solid_box(largest))) {
    for (Vec3d& corner : side) corner = mesh.pose.transform(corner);
    sketch.surfaces.push_back({side, with_alpha(kBox, 0.16f)});
  }
  outline(largest, mesh.pose, {3.0f, kBox}, sketch);
  sketch.explain(kLargestSwatch, "largest of them");
  sketch.label(mesh.pose.transform(0.5 * (largest.lower + largest.upper)),
               spell_number(volume(largest), 3) + " m³", kBox, 17, 10);
}

/// The boxes in the tree of a deforming mesh.
void draw_deformed_trees(const Scene& scene, Sketch& sketch) {
  for (const trace::Deformed& deformed : scene.frame.deformed) {
    const PlacedShape* mesh = scene.find(deformed.name);
    if (mesh == nullptr) continue;
    for (const trace::Box& box : deformed.boxes)
      outline(box, mesh->pose, {1.2f, kLightBox}, sketch);
    sketch.explain(kDeformedSwatch, "boxes of the tree, four levels down");
    if (deformed.boxes.size() > 1) draw_largest(deformed.boxes, *mesh, sketch);
  }
}

// The boxes that a broad phase used to find pairs.

constexpr std::size_t kMaxNamed = 12;  // boxes
constexpr double kNameRoom = 20;       // pixels for a name next to a box
constexpr double kAxisLength = 56;     // pixels, below the names of the lowest boxes
constexpr double kBeyondBoxes = 12;    // pixels: extension of a line at their ends

constexpr Swatch kMeetingBoxSwatch{LegendGroup::Trees, 3,
                                   [](auto& pen) { pen.area(kBox, 0, 2.5); }};
constexpr Swatch kShapeBoxSwatch{LegendGroup::Trees, 5, [](auto& pen) { pen.area(kBox, 0, 1.5); },
                                 kBox};
constexpr double kMinShared = 6;  // pixels: a smaller fill is not visible
constexpr Color kShared = with_alpha(kBox, 0.22f);
constexpr Swatch kSharedSwatch{LegendGroup::Trees, 4,
                               [](auto& pen) { pen.box(kShared, kShared, 1); }};
// Not dashed: a small box would lose its corners, and many boxes would be hard to read.
constexpr LineStyle kAlone{1.2f, kDropped};
constexpr Swatch kAloneSwatch{LegendGroup::Trees, 4,
                              [](auto& pen) { pen.area(kAlone.color, 0, kAlone.width); }};

/// Null if there is no box of that name.
const trace::Box* box_of(const std::string& name, const std::vector<trace::Bounds>& all) {
  const auto found = std::ranges::find(all, name, &trace::Bounds::name);
  return found == all.end() ? nullptr : &found->box;
}

/// Position of a name, and its direction from the box.
struct NamePlace {
  Vec3d at, out;
};

/// Below the box on the screen, above it or next to it: the first side without another box.
NamePlace free_side(const Scene& scene, const trace::Bounds& bounds,
                    const std::vector<trace::Bounds>& all) {
  const Vec3d right = scene.camera.right(), up = scene.camera.up();
  const auto half = [](const trace::Box& box) -> Vec3d { return 0.5 * (box.upper - box.lower); };
  const auto center = [](const trace::Box& box) -> Vec3d { return 0.5 * (box.upper + box.lower); };
  const double pixels = scene.camera.pixels_per_metre(center(bounds.box)) / scene.scales.pixel;
  const auto place = [&](const Vec3d& out) -> NamePlace {
    return {center(bounds.box) + out.cwiseAbs().dot(half(bounds.box)) * out, out};
  };
  const auto is_free = [&](const NamePlace& name) {
    const double room = kNameRoom / pixels;
    return std::ranges::none_of(all, [&](const trace::Bounds& other) {
      const Vec3d screen_axis = name.at - center(other.box), reach = half(other.box);
      return &other != &bounds &&
             std::abs(right.dot(screen_axis)) < right.cwiseAbs().dot(reach) + room &&
             std::abs(up.dot(screen_axis)) < up.cwiseAbs().dot(reach) + room;
    });
  };
  for (const Vec3d& out : {Vec3d(-up), up, right, Vec3d(-right)})
    if (const NamePlace name = place(out); is_free(name)) return name;
  return place(-up);
}

// Cells and nodes have numbers and borders in the place of names. A box that differs from all
// others, such as a slab among crates, is the picture's subject and gets a name.
bool is_one_of_a_kind(const std::string& name, const std::vector<trace::Bounds>& all) {
  const std::string_view kind = kind_of_name(name);
  return kind == name && std::ranges::count_if(all, [&](const trace::Bounds& other) {
                           return kind_of_name(other.name) == kind;
                         }) == 1;
}

// At the upper edge, inside, because nodes are outside.
void name_within(const Scene& scene, const trace::Bounds& bounds, Sketch& sketch) {
  const Vec3d up = scene.camera.up(), half = 0.5 * (bounds.box.upper - bounds.box.lower);
  sketch.label(bounds.box.lower + half + up.cwiseAbs().dot(half) * up, in_words(bounds.name), kText,
               16, 6, Vec3d(-up));
}

// Without a broad phase: the axis-aligned box of each shape, as in debuggers of engines.
void draw_boxes_of_shapes(const Scene& scene, Sketch& sketch) {
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.traced().half_space || shape.vertices.empty()) continue;
    const Eigen::AlignedBox3d around = box_around(shape.vertices);
    const Vec3d radius = Vec3d::Constant(shape.traced().radius);
    const trace::Box box{around.min() - radius, around.max() + radius};
    outline(box, {}, {1.5f, kBox}, sketch);
    sketch.explain(kShapeBoxSwatch, "axis-aligned box of a shape", box.upper);
  }
}

// Edges of a solid box that face the viewer; hidden ones are faint, to keep many boxes readable.
void outline_solid(const Scene& scene, const trace::Box& box, const LineStyle& style,
                   Sketch& sketch) {
  const Eigen::AlignedBox3d solid = solid_box(box);
  // By bits: 1 the upper x, 2 the upper y, 4 the upper z.
  const auto corner = [&](int bits) {
    return Vec3d(solid.corner(static_cast<Eigen::AlignedBox3d::CornerType>(bits)));
  };
  const auto is_front = [&](int bits, int axis) {
    return scene.camera.faces(corner(bits),
                              ((bits >> axis & 1) != 0 ? 1.0 : -1.0) * Vec3d::Unit(axis));
  };
  LineStyle behind = style;
  behind.width = 1;
  behind.color = with_alpha(style.color, 0.35f);
  for (int bits = 0; bits < 8; ++bits) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((bits >> axis & 1) != 0) continue;
      const bool seen = is_front(bits, (axis + 1) % 3) || is_front(bits, (axis + 2) % 3);
      sketch.line(corner(bits), corner(bits | 1 << axis), seen ? style : behind);
    }
  }
}

// Fills the intersection of two boxes.
void draw_shared(const Scene& scene, const trace::Box& a, const trace::Box& b, Sketch& sketch) {
  const Eigen::AlignedBox3d shared = solid_box(a).intersection(solid_box(b));
  if (shared.isEmpty()) return;
  int side = 0;
  for (const std::vector<Vec3d>& face : sides_of(shared)) {
    const Vec3d outward = (side % 2 == 0 ? -1.0 : 1.0) * Vec3d::Unit(side / 2);
    if (scene.camera.faces(face[0], outward)) sketch.surfaces.push_back({face, kShared});
    ++side;
  }
  const Vec3d seen = scene.camera.pixels_per_metre(shared.center()) * shared.sizes();
  const auto width = [&](const Vec3d& screen_axis) { return seen.dot(screen_axis.cwiseAbs()); };
  if (std::min(width(scene.camera.right()), width(scene.camera.up())) >
      kMinShared * scene.scales.pixel)
    sketch.explain(kSharedSwatch, "where two boxes overlap", shared.center());
}

// Directions of the axes along which sweep and prune sorts the ends.
void draw_swept_axes(const Scene& scene, const std::vector<trace::Bounds>& all, Sketch& sketch) {
  Eigen::AlignedBox3d around;
  for (const trace::Bounds& bounds : all) around.extend(solid_box(bounds.box));
  const Vec3d right = scene.camera.right(), up = scene.camera.up(), reach = 0.5 * around.sizes();
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(around.center());
  const Vec3d corner = around.center() - right.cwiseAbs().dot(reach) * right -
                       (up.cwiseAbs().dot(reach) + 1.5 * kNameRoom * pixel) * up;
  const double length = kAxisLength * pixel;
  constexpr const char* kNames[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d screen_axis = length * Vec3d::Unit(axis);
    // An axis along the view is a point.
    if (std::hypot(right.dot(screen_axis), up.dot(screen_axis)) < 0.3 * length) continue;
    sketch.arrow_to_scale(corner, screen_axis, 2, 9, kShapeEdge);
    sketch.label(corner + screen_axis, kNames[axis], kText, 16, 6, Vec3d::Unit(axis));
  }
}

// A line across both boxes at the place of an end swap. The place on the axis is the same, however
// far the boxes are from each other along the other axes.
void draw_passing_ends(const Scene& scene, const std::vector<trace::Bounds>& all, Sketch& sketch) {
  for (const trace::EndSwap& swap : scene.frame.broad_phase->end_swaps) {
    const trace::Box *lower = box_of(swap.lower, all), *upper = box_of(swap.upper, all);
    const int axis = swap.axis == "x" ? 0 : swap.axis == "y" ? 1 : 2;
    const Vec3d across = scene.camera.to_eye(Vec3d::Zero()).cross(Vec3d::Unit(axis)).cwiseAbs();
    if (lower == nullptr || upper == nullptr || across.isZero(0.1)) continue;
    int along = 0;
    across.maxCoeff(&along);
    const Eigen::AlignedBox3d both = solid_box(*lower).merged(solid_box(*upper));
    const double beyond =
        kBeyondBoxes * scene.scales.pixel / scene.camera.pixels_per_metre(both.center());
    Vec3d from = both.max(), to = both.max();
    from[axis] = to[axis] = swap.place;
    from[along] = both.min()[along] - beyond;
    to[along] += beyond;
    sketch.line(from, to, {swap.counts ? 2.5f : 1.5f, swap.counts ? kBox : kShapeEdge});
    sketch.label(to, "ends pass along " + swap.axis, swap.counts ? kBox : kQuietText, 16, 6,
                 Vec3d(to - from));
  }
}

void draw_bounds(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase) return draw_boxes_of_shapes(scene, sketch);
  const auto meets = [&](const trace::Bounds& bounds) {
    return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& pair) {
      return pair.a == bounds.name || pair.b == bounds.name;
    });
  };
  std::vector<trace::Bounds> all = scene.frame.broad_phase->bounds;
  const bool few = all.size() <= kMaxNamed && scene.view.layout != ViewLayout::Stages,
             named = few && !scene.shows(Layer::Cells);
  const auto meeting = std::stable_partition(all.begin(), all.end(), std::not_fn(meets));
  for (auto bounds = all.begin(); bounds != all.end(); ++bounds) {
    const bool alone = bounds < meeting;
    outline_solid(scene, bounds->box, alone ? kAlone : LineStyle{2.5f, kBox}, sketch);
    if (named) {
      const NamePlace name = free_side(scene, *bounds, all);
      sketch.label(name.at, in_words(bounds->name), kText, 16, 6, name.out);
    } else if (few && is_one_of_a_kind(bounds->name, all)) {
      name_within(scene, *bounds, sketch);
    }
    sketch.explain(alone ? kAloneSwatch : kMeetingBoxSwatch,
                   alone ? "box that meets no other" : "box that meets another", bounds->box.upper);
  }
  if (scene.frame.broad_phase->method == "sweep_and_prune" && all.size() <= kMaxNamed) {
    draw_swept_axes(scene, all, sketch);
    draw_passing_ends(scene, all, sketch);
  }
  const auto is_mesh = [&](const std::string& name) {
    const PlacedShape* shape = scene.find(name);
    return shape != nullptr && shape->is_mesh();
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    const trace::Box *a = box_of(pair.a, all), *b = box_of(pair.b, all);
    // For a body on a mesh it is most of the body's own box, and would hide the triangles.
    if (a == nullptr || b == nullptr || is_mesh(pair.a) != is_mesh(pair.b)) continue;
    draw_shared(scene, *a, *b, sketch);
  }
}

}  // namespace

const LayerDrawing kCandidatesLayer{
    .needs = {&Stages::tree},
    .beneath =
        [](const Scene& scene, Sketch& sketch) {
          for (const trace::Pair& pair : scene.frame.pairs) draw_candidates(scene, pair, sketch);
        },
    .search =
        [](const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
          if (!scene.shows(Layer::Bounds)) draw_query(scene, pair, sketch);
        },
};
const LayerDrawing kTreeLayer{
    .needs = {&Stages::tree}, .beneath = draw_deformed_trees, .search = draw_tree};

const LayerDrawing kBoundsLayer{.above = draw_bounds};

}  // namespace contactscope::draw
