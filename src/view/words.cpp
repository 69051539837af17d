#include "view/words.h"

namespace contactscope {

// A text that a layer, inset or panel adds to pictures needs a row here to be replaceable.
const std::vector<std::string_view>& known_words() {
  // clang-format off
  static const std::vector<std::string_view> words = {
      // Shapes and pairs.
      "shape without its margin of {n}", "core and margin: the surface that touches",
      "core and margin", "core, {n} within the faces", "what the field has lost of the shape",
      "virtual sphere", "island: bodies that contacts join", "island that sleeps", "island",
      "B moved out of A", "face on face: {points}", "edge on face: {points}",
      "edge on edge: {points}", "point on face: {points}", "point on edge: {points}",
      "point on point: {points}",
      // Faces and features.
      "reference face", "incident face", "side plane, outward normal", "side plane", "clip polygon",
      "as clipped, on the incident face", "as clipped", "moved onto the reference face", "cut away",
      "new corner, in the order made", "corner that touches", "edge that touches",
      "face that touches", "corner, edge or face that touches", "edges that cross", "edge of A",
      "edge of B", "face {n}", "axis of the capsule, clipped", "axis of the capsule",
      "triangle touched", "incident triangle", "support: hull of the contact points",
      "support: a line between two points", "support", "prism about face, edges and vertices",
      "prism about face",
      // Contact points.
      "contact point", "contact point, {sign}", "contact points", "one-shot point, {sign}",
      "point within the margin, not touching", "point within the margin, not touching: {sign}",
      "points in one place", "line between the centres", "overlap", "speculative", "deepest points",
      "new point", "kept point, its age in frames", "taken out, and why", "new", "broken",
      "replaced", "{n} apart, slid", "places that met, and how far they are apart now",
      "places that met, now apart (× {n})", "kept from the step before", "on the surface of A",
      "on the surface of B", "on the surface of B, {distance}", "smallest way of B to other points",
      "closest points", "closest points of the edges", "asked here", "no normal: contact skipped",
      "contact skipped", "no contact in this frame", "no contact",
      // Reduction.
      "reduced away", "kept, in order of choice", "kept, in order of choice, and their area",
      "kept", "deepest", "largest area", "kept area", "kept area, hatched: lost", "contact polygon",
      "box along the axes", "largest triangle", "triangle so far", "added outside",
      "distance to the edge", "other candidates", "points over time, orange: kept", "now",
      "area {n}", "deepest kept", "deepest kept, {n}", "deepest lost", "deepest lost by {n}",
      // Normals, axes and distances.
      "normal, from A to B", "normal of the contact", "normal of a face that is just as near",
      "normal and points as most have them", "leans {n}", "separating axis and gap",
      "separating axis and gap; it ended the test", "chosen axis, its overlap", "chosen axis",
      "best axis of a query, its overlap", "best axis of a query", "edges that make the axis",
      "axis that separates", "axis without a gap", "cross product of two edges",
      "cross product of two edges, separates", "cross product of two edges, skipped",
      "cross product of both axes", "shared stretch", "centre", "end of the axis",
      "nearest on the axis", "plane of the best face or edges, extended",
      "plane of the best face or edges", "support point of the other shape",
      "parallel plane through the support point", "overlap of the cores", "distance of the cores",
      "distance of the cores, and the gap that the margins leave", "other ways out",
      "way out that is taken, as long as the overlap", "way out that is taken",
      // GJK, EPA and the Gauss map.
      "Minkowski difference B − A", "Gauss map of A and −B", "origin", "simplex", "polytope",
      "portal and inner point", "face nearest to the origin", "nearest point, its distance",
      "distance of its plane", "the origin's distance from the border", "next point",
      "search for the next point", "no point lies beyond", "support points of the simplex",
      "support points of the nearest face", "faces and edges of {shape}", "ring of {segment}",
      "arcs that cross",
      // Stability, forces and motion.
      "centre of mass", "centre of mass, and its projection", "stable", "unstable, on the border",
      "unstable: turns about a line", "unstable: turns about a line, {margin}",
      "unstable: turns about a point", "unstable: turns about a point, {margin}", "marginal",
      "margin: to the border of the support", "axis about which the body turns",
      "normal impulse, {scale}", "normal force, {scale}", "friction, {scale}", "longer than drawn",
      "velocity, way in {n}", "spin, turn in {n}", "slides at {n}",
      "relative velocity at the contact, way in {n}", "its part along the normal",
      "in the frames before", "at the next frame, if nothing stopped it",
      "a frame later, if nothing stopped it", "way through the step, not to scale",
      "where they first meet", "the triangles where they first meet", "how it is turned by then",
      "hit", "a step of the search: apart for certain until then", "way of a ball's centre",
      "centre of the ball as it touches", "way of the point that meets", "way of a corner",
      "ghost: holds back what would go past",
      // Meshes, trees, fields and bounds.
      "triangle that crosses the other mesh", "triangles that overlap in one plane",
      "triangle without an area", "a point where they touch", "edge at which the surface ends",
      "inside the other", "where the surfaces meet", "where they touch, which does not count",
      "candidate triangle", "box of triangles that are tested",
      "boxes of the tree, four levels down", "largest of them", "box left out, with all below",
      "box left out", "box of the shape that asks", "axis-aligned box of a shape",
      "box that meets another", "box that meets no other", "where two boxes overlap",
      "pair that is tested", "tested in vain: boxes do not overlap", "bounds say no",
      "bounds say no, the shapes yes", "bounds say yes, as the shapes do",
      "bounds say yes, the shapes no", "larger nodes, deeper ones darker",
      "node, as far as its boxes reach", "nodes around others, three levels",
      "leaf: a box and a margin around it", "number: tests in a cell", "number: tests at a node",
      "too large for cells, tested with all: {n} tests", "the only cell, of all boxes",
      "a box and its span", "begins in the span, so tested: {n}", "surface of the field",
      "surface, and lines every {n}", "blended here", "cell with its own distances",
      "cell with its own distances, tinted: asks its triangles",
      // Headings and rows of panels.
      "contact plane, seen along the normal", "chosen axis, frame by frame",
      "answers, frame by frame", "answer", "over time", "time", "share of the step",
      "what each stage lets through", "what the trees cost", "triangles of A against those of B",
      "ends in order on three axes", "intervals of A and B along each axis",
      "distance through the step", "stability: centre of mass over the contact", "no preference",
      "full test", "frames need no full test", "faces of A", "faces of B", "edges",
      "pairs of edges", "not tested", "pairs of {n} shapes", "whose boxes overlap",
      "pairs in contact", "the shapes", "axis-aligned boxes", "oriented boxes",
      "lint: {n}", "lint: nothing is wrong", "named by lint", "worst of {n} in contact", "no pair in contact", "by overlap", "by impulse",
      "by change of overlap since the last frame", "no frame before this one", "none",
      "overlaps of {n} points", "overlaps: no contact points", "no point overlaps in any frame",
      "1 shape has left the view", "{n} shapes have left the view",
  };
  // clang-format on
  return words;
}

std::string_view place_in(std::string_view key) {
  const std::size_t begin = key.find('{'), end = key.find('}', begin);
  return end == key.npos ? std::string_view() : key.substr(begin, end + 1 - begin);
}

void Words::replace(std::string_view key, const std::string& by) {
  texts_.insert_or_assign(std::string(key), by);
}

void Words::rename(std::string_view name, const std::string& by) {
  // Pictures show "old crate" for old_crate.
  for (const std::string& shown : {std::string(name), name_in_words(name)}) {
    replace(shown, by);
    replace("A: " + shown, by.empty() ? by : "A: " + by);
    replace("B: " + shown, by.empty() ? by : "B: " + by);
    replace(shown + ": {answer}", by.empty() ? by : by + ": {answer}");
  }
}

void Words::replace(const Words& others) {
  for (const auto& [key, by] : others.texts_) replace(key, by);
}

std::string Words::of(std::string_view text) const {
  if (const auto whole = texts_.find(text); whole != texts_.end()) return whole->second;
  for (const auto& [key, by] : texts_) {
    const std::string_view place = place_in(key);
    if (place.empty()) continue;
    const std::string_view before(key.data(), place.data());
    const std::string_view after = std::string_view(key).substr(before.size() + place.size());
    if (text.size() <= before.size() + after.size() || !text.starts_with(before) ||
        !text.ends_with(after))
      continue;
    std::string result = by;
    const std::string_view filled =
        text.substr(before.size(), text.size() - before.size() - after.size());
    if (!by.empty()) result.replace(by.find(place), place.size(), filled);
    return result;
  }
  return std::string(text);
}

std::string_view kind_of_name(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789_- ");
  return last == std::string_view::npos ? name : name.substr(0, last + 1);
}

std::string name_in_words(std::string_view name) {
  std::string words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool parts = name[i] == '_' || name[i] == ' ';
    // "crate1" becomes "crate 1". "box3d", whose number is inside, and the parts "car/5" stay.
    const bool counts =
        name[i] >= '0' && name[i] <= '9' && i > 0 &&
        std::string_view("0123456789-./:#").find(name[i - 1]) == std::string_view::npos &&
        name.find_first_not_of("0123456789", i) == std::string_view::npos;
    if ((parts || counts) && !words.empty() && words.back() != ' ') words += ' ';
    if (!parts) words += name[i];
  }
  return words;
}

}  // namespace contactscope
