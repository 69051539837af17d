#include "draw/scene/simplex_steps.h"

#include <algorithm>
#include <cmath>

namespace contactscope::draw {
namespace {

using Vertices = std::vector<trace::SimplexVertex>;

/// Support points in the order in which they were found.
class Numbering {
 public:
  int number(const trace::SimplexVertex& vertex) {
    const auto found = std::find(known_.begin(), known_.end(), vertex);
    if (found != known_.end()) return static_cast<int>(found - known_.begin()) + 1;
    known_.push_back(vertex);
    return static_cast<int>(known_.size());
  }
  bool knows(const trace::SimplexVertex& vertex) const {
    return std::find(known_.begin(), known_.end(), vertex) != known_.end();
  }

 private:
  Vertices known_;
};

/// Steps done before `frame`, of a story that starts with frame `first`.
int steps_done(bool story, int frame, int steps) {
  return story ? std::clamp(frame, 0, steps) : steps;
}

std::optional<trace::SimplexVertex> new_in(const Vertices& vertices, const Numbering& known) {
  for (const trace::SimplexVertex& vertex : vertices) {
    if (!known.knows(vertex)) return vertex;
  }
  return std::nullopt;
}

SimplexStep gjk_step(const std::vector<trace::Simplex>& steps, int done) {
  SimplexStep shown;
  shown.steps = static_cast<int>(steps.size());
  shown.step = done;
  Numbering numbering;
  for (int k = 0; k < done; ++k) {
    shown.numbers.clear();
    shown.vertices = steps[static_cast<std::size_t>(k)];
    for (const trace::SimplexVertex& vertex : shown.vertices)
      shown.numbers.push_back(numbering.number(vertex));
  }
  if (!shown.last()) shown.next = new_in(steps[static_cast<std::size_t>(done)], numbering);
  return shown;
}

/// Polytope k is what k expansions made.
SimplexStep epa_step(const std::vector<trace::Polytope>& polytopes, int done) {
  SimplexStep shown;
  shown.of = SimplexStep::Of::Epa;
  shown.steps = static_cast<int>(polytopes.size()) - 1;
  shown.step = done;
  Numbering numbering;
  for (int k = 0; k <= done; ++k) {
    shown.numbers.clear();
    shown.polytope = &polytopes[static_cast<std::size_t>(k)];
    for (const trace::SimplexVertex& vertex : shown.polytope->vertices)
      shown.numbers.push_back(numbering.number(vertex));
  }
  shown.vertices = shown.polytope->vertices;
  if (!shown.last())
    shown.next = new_in(polytopes[static_cast<std::size_t>(done) + 1].vertices, numbering);
  return shown;
}

}  // namespace

std::optional<SimplexStep> simplex_step(const View& view, const trace::Frame& frame,
                                        const trace::Pair& pair) {
  const bool gjk_story = view.story == Story::GjkSteps;
  const bool epa_story = view.story == Story::EpaSteps;
  if (pair.penetration && !gjk_story) {
    const trace::Penetration& penetration = *pair.penetration;
    if (!penetration.polytopes.empty()) {
      const int steps = static_cast<int>(penetration.polytopes.size()) - 1;
      return epa_step(penetration.polytopes, steps_done(epa_story, frame.frame, steps));
    }
    if (!penetration.portals.empty()) {
      const int steps = static_cast<int>(penetration.portals.size());
      SimplexStep shown = gjk_step(penetration.portals, steps_done(epa_story, frame.frame, steps));
      shown.of = SimplexStep::Of::Mpr;
      return shown;
    }
  }
  if (!pair.gjk || pair.gjk->steps.empty()) return std::nullopt;
  const int steps = static_cast<int>(pair.gjk->steps.size());
  return gjk_step(pair.gjk->steps, steps_done(gjk_story, frame.frame, steps));
}

// The nearest point lies inside of one of the parts, a vertex, an edge, a triangle or the whole, and
// is there the foot of the origin: all parts whose foot is inside of them are looked at. The weights
// of a part's corners follow from Gram-Schmidt; a flat part is left to its own parts.
Vec3d nearest_to_origin(const std::vector<Vec3d>& points) {
  Vec3d best = points.front();
  const unsigned parts = 1u << points.size();
  for (unsigned part = 1; part < parts; ++part) {
    std::vector<Vec3d> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((part >> i & 1u) != 0) corners.push_back(points[i]);
    }
    std::vector<Vec3d> across;  // the way to each corner from the first, across the ways before it
    bool flat = false;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Vec3d way = corners[i] - corners[0];
      Vec3d rest = way;
      for (const Vec3d& other : across) rest -= other.dot(rest) / other.squaredNorm() * other;
      flat = flat || rest.norm() <= 1e-12 * way.norm();
      across.push_back(rest);
    }
    if (flat) continue;
    Vec3d foot = corners[0];
    double first = 1;  // weight of the first corner
    bool inside = true;
    for (std::size_t i = corners.size(); i-- > 1;) {
      const Vec3d way = corners[i] - corners[0];
      const double weight = -across[i - 1].dot(foot) / across[i - 1].dot(way);
      foot += weight * way;
      first -= weight;
      inside = inside && weight >= 0;
    }
    if (inside && first >= 0 && foot.norm() < best.norm()) best = foot;
  }
  return best;
}

}  // namespace contactscope::draw
