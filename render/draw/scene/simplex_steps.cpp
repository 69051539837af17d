#include "draw/scene/simplex_steps.h"

#include <algorithm>

#include "core/at.h"

namespace contactscope::draw {
namespace {

using Vertices = std::vector<trace::SimplexVertex>;

}  // namespace

std::optional<SimplexStep> simplex_step(const View& view, const trace::Frame& frame,
                                        const trace::Pair& pair) {
  using Of = SimplexStep::Of;
  // `lists`: vertices of each step.
  const auto shown = [&](Of of, Story story, const std::vector<Vertices>& lists) {
    // Polytope k is the state after k expansions, simplex k the state after step k + 1.
    const int before = of == Of::Epa ? 1 : 0;
    SimplexStep result;
    result.of = of;
    result.steps = count_of(lists) - before;
    result.step = view.story == story ? std::clamp(frame.frame, 0, result.steps) : result.steps;
    Vertices known;  // support points in the order of discovery
    for (int k = 0; k < result.step + before; ++k) {
      result.vertices = at(lists, k);
      result.numbers.clear();
      for (const trace::SimplexVertex& vertex : result.vertices) {
        const auto found = std::ranges::find(known, vertex);
        result.numbers.push_back(static_cast<int>(found - known.begin()) + 1);
        if (found == known.end()) known.push_back(vertex);
      }
    }
    if (result.last()) return result;
    const Vertices& next = at(lists, result.step + before);
    const auto is_new = [&](const auto& vertex) { return !std::ranges::count(known, vertex); };
    const auto found = std::ranges::find_if(next, is_new);
    if (found != next.end()) result.next = *found;
    return result;
  };
  if (pair.penetration && view.story != Story::GjkSteps) {
    const std::vector<trace::Polytope>& polytopes = pair.penetration->polytopes;
    if (!polytopes.empty()) {
      SimplexStep step =
          shown(Of::Epa, Story::EpaSteps, mapped(polytopes, &trace::Polytope::vertices));
      step.polytope = &at(polytopes, step.step);
      return step;
    }
    const std::vector<trace::Simplex>& portals = pair.penetration->portals;
    if (!portals.empty()) return shown(Of::Mpr, Story::EpaSteps, portals);
  }
  if (!pair.gjk || pair.gjk->steps.empty()) return std::nullopt;
  return shown(Of::Gjk, Story::GjkSteps, pair.gjk->steps);
}

// The nearest point is in the interior of a vertex, edge, triangle or the whole, and is there the
// origin's projection. All parts that contain their projection are compared. Weights of the corners
// follow from Gram-Schmidt; a flat part is skipped, because its own parts cover it.
Vec3d nearest_to_origin(const std::vector<Vec3d>& points) {
  Vec3d best = points.front();
  const unsigned parts = 1u << points.size();
  for (unsigned part = 1; part < parts; ++part) {
    std::vector<Vec3d> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((part >> i & 1u) != 0) corners.push_back(points[i]);
    }
    std::vector<Vec3d> across;  // offsets from the first corner, orthogonalised
    bool flat = false;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Vec3d offset = corners[i] - corners[0];
      Vec3d rest = offset;
      for (const Vec3d& other : across) rest -= other.dot(rest) / other.squaredNorm() * other;
      flat = flat || rest.norm() <= 1e-12 * offset.norm();
      across.push_back(rest);
    }
    if (flat) continue;
    Vec3d foot = corners[0];
    double first = 1;  // weight of the first corner
    bool inside = true;
    for (std::size_t i = corners.size(); i-- > 1;) {
      const Vec3d offset = corners[i] - corners[0];
      const double weight = -across[i - 1].dot(foot) / across[i - 1].dot(offset);
      foot += weight * offset;
      first -= weight;
      inside = inside && weight >= 0;
    }
    if (inside && first >= 0 && foot.norm() < best.norm()) best = foot;
  }
  return best;
}

}  // namespace contactscope::draw
