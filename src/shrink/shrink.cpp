#include "shrink/shrink.h"

#include "core/spell.h"

namespace contactscope::shrink {
namespace {

/// Rounded to this many significant digits.
double rounded(double number, int digits) {
  return std::strtod(printed("%.*e", digits - 1, number).c_str(), nullptr);
}

constexpr int kAllDigits = 17;

class Shrinker {
 public:
  Shrinker(const PairOfTwo& start, Judge& judge,
           const std::function<void(const PairOfTwo&)>& progress)
      : best_(start), judge_(judge), progress_(progress) {}

  PairOfTwo run() {
    for (auto before = measure(best_);; before = measure(best_)) {
      for (SmallShape PairOfTwo::*const side : {&PairOfTwo::a, &PairOfTwo::b}) {
        drop_parts(side);
        try_without_volume(side);
        try_as_hull(side);
      }
      drop_claims();
      leave_out([](PairOfTwo & pair) -> auto& { return pair.settings; });
      simplify_places();
      round_numbers();
      if (measure(best_) == before) return best_;
    }
  }

 private:
  /// The sizes to minimise, the most important one first.
  static std::tuple<int, int, int, int> measure(const PairOfTwo& pair) {
    int claims = 0, triangles = 0;
    if (pair.claims)
      for (const trace::Manifold& manifold : *pair.claims) claims += 1 + count_of(manifold.points);
    for (const SmallShape* const shape : {&pair.a, &pair.b})
      triangles += count_of(shape->triangles);
    return {pair.vertex_count() + triangles, claims, count_of(pair.settings), digits_of(pair)};
  }

  bool attempt(const PairOfTwo& pair) {
    if (!(measure(pair) < measure(best_)) || !judge_.holds(pair)) return false;
    best_ = pair;
    if (progress_) progress_(best_);
    return true;
  }

  /// ddmin over the entries of a list of the pair. `then` follows each removal of some of them.
  template <class List, class Then = void (*)(PairOfTwo&)>
  void leave_out(
      const List& list_of, const Then& then = [](PairOfTwo&) {}) {
    for (int size = std::max(1, count_of(list_of(best_)) / 2);; size /= 2) {
      for (int first = 0; first < count_of(list_of(best_));) {
        PairOfTwo tried = best_;
        auto& list = list_of(tried);
        list.erase(list.begin() + first, list.begin() + std::min(first + size, count_of(list)));
        then(tried);
        if (!attempt(tried)) first += size;
      }
      if (size <= 1) return;
    }
  }

  /// Removes vertices without a triangle.
  static void drop_unused(SmallShape& mesh) {
    std::vector<int> place(mesh.vertices.size(), -1);
    std::vector<Vec3d> used;
    for (std::array<int, 3>& corners : mesh.triangles)
      for (int& corner : corners) {
        if (at(place, corner) < 0) {
          at(place, corner) = count_of(used);
          used.push_back(at(mesh.vertices, corner));
        }
        corner = at(place, corner);
      }
    mesh.vertices = used;
  }

  void drop_parts(SmallShape PairOfTwo::*side) {
    if ((best_.*side).kind == SmallShape::Kind::Mesh)
      leave_out(
          [&](PairOfTwo & pair) -> auto& { return (pair.*side).triangles; },
          [&](PairOfTwo& pair) { drop_unused(pair.*side); });
    if ((best_.*side).kind == SmallShape::Kind::Hull)
      leave_out([&](PairOfTwo & pair) -> auto& { return (pair.*side).vertices; });
  }

  /// Replaces a capsule by a ball at one of its ends.
  void try_without_volume(SmallShape PairOfTwo::*side) {
    for (std::size_t end = 0; end < 2 && (best_.*side).kind == SmallShape::Kind::Capsule; ++end) {
      PairOfTwo tried = best_;
      SmallShape& ball = tried.*side;
      ball.position = ball.pose().transform(ball.vertices[end]);
      ball.kind = SmallShape::Kind::Sphere;
      ball.vertices.clear();
      attempt(tried);
    }
  }

  /// Replaces a box by the hull of its corners, which may need fewer.
  void try_as_hull(SmallShape PairOfTwo::*side) {
    if ((best_.*side).kind != SmallShape::Kind::Box) return;
    const PairOfTwo box = best_;
    PairOfTwo tried = best_;
    SmallShape& hull = tried.*side;
    hull.kind = SmallShape::Kind::Hull;
    const Vec3d& half = hull.half_extents;
    for (int i = 0; i < 8; ++i)
      hull.vertices.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                                 i & 4 ? half.z() : -half.z());
    if (!judge_.holds(tried)) return;
    best_ = tried;
    drop_parts(side);
    if (best_.vertex_count() >= box.vertex_count()) best_ = box;
  }

  void drop_claims() {
    if (!best_.claims) return;
    leave_out([](PairOfTwo & pair) -> auto& { return *pair.claims; });
    for (std::size_t m = 0; m < best_.claims->size(); ++m)
      leave_out([&](PairOfTwo & pair) -> auto& { return (*pair.claims)[m].points; });
  }

  static Turn turn_of(const Quatd& rotation) {
    const Eigen::AngleAxisd turn(rotation);
    if (turn.angle() == 0) return {};
    // The largest component is 1, so that simple axes look simple.
    const Vec3d axis = turn.axis() / turn.axis().lpNorm<Eigen::Infinity>();
    return {Turn::Form::AxisDegrees,
            {axis.x(), axis.y(), axis.z(), turn.angle() * 180 / std::numbers::pi}};
  }

  void simplify_places() {
    const Pose<double> a = best_.a.pose();
    const auto attempt_with = [&](const auto& change) {
      PairOfTwo tried = best_;
      change(tried);
      attempt(tried);
    };
    if (std::ranges::count(best_.expectation, "normal", &Setting::first) == 0) {
      attempt_with([&](PairOfTwo& pair) {
        const Pose<double> b_in_a = relative_pose(a, pair.b.pose());
        pair.a.position.setZero();
        pair.a.turn = {};
        pair.b.position = b_in_a.position;
        pair.b.turn = turn_of(b_in_a.rotation);
      });
      attempt_with([](PairOfTwo& pair) { pair.a.turn = {}; });
    }
    attempt_with([](PairOfTwo& pair) {
      pair.b.position -= pair.a.position;
      pair.a.position.setZero();
    });
    attempt_with([](PairOfTwo& pair) { pair.b.turn = {}; });
    for (SmallShape PairOfTwo::*const side : {&PairOfTwo::a, &PairOfTwo::b}) {
      if ((best_.*side).turn.form == Turn::Form::Quaternion)
        attempt_with(
            [&](PairOfTwo& pair) { (pair.*side).turn = turn_of((pair.*side).pose().rotation); });
      // Without rotation the position can move into the vertices.
      const SmallShape& shape = best_.*side;
      if (shape.turn.form == Turn::Form::None && !shape.vertices.empty())
        attempt_with([&](PairOfTwo& pair) {
          for (Vec3d& vertex : (pair.*side).vertices) vertex += (pair.*side).position;
          (pair.*side).position.setZero();
        });
    }
  }

  void round_numbers() {
    for (int digits = 1; digits < kAllDigits; ++digits) {
      PairOfTwo tried = best_;
      for (double* const number : numbers_of(tried)) *number = rounded(*number, digits);
      if (attempt(tried)) break;
    }
    PairOfTwo all = best_;
    const std::size_t count = numbers_of(all).size();
    for (std::size_t i = 0; i < count; ++i) {
      const double number = *numbers_of(best_)[i];
      if (number == 0) continue;
      const auto try_number = [&](double other) {
        PairOfTwo tried = best_;
        *numbers_of(tried)[i] = other;
        return attempt(tried);
      };
      bool is_done = try_number(0) || try_number(std::copysign(1, number));
      for (int digits = 1; digits < kAllDigits && !is_done; ++digits)
        is_done = try_number(rounded(number, digits));
    }
  }

  PairOfTwo best_;
  Judge& judge_;
  const std::function<void(const PairOfTwo&)>& progress_;
};

}  // namespace

Shrunk shrink(const PairOfTwo& start, Judge& judge,
              const std::function<void(const PairOfTwo&)>& progress) {
  PairOfTwo smallest = Shrinker(start, judge, progress).run();
  return {std::move(smallest), judge.requested()};
}

}  // namespace contactscope::shrink
