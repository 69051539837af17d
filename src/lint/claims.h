#pragma once

#include "lint/reading.h"
#include "lint/solid.h"

namespace contactscope::lint {

/// Kinds of wrong claims of a pair.
enum class Wrong {
  Separation,  // a point's separation is not the distance of the surfaces along the normal
  Surface,     // a point is farther from a surface than its separation
  Side,        // 'on_a' or 'on_b' is not on its surface
  Normal,      // the overlap along it is not the least overlap
  Deepest,     // no point is as deep as the overlap along the normal
};
inline constexpr int kWrongs = 5;

struct Problem {
  Wrong kind = Wrong::Separation;
  int manifold = 0, point = 0;
  double said = 0, is = 0;     // metres
  std::string shape{};         // for Surface and Side
  Vec3d best = Vec3d::Zero();  // for Normal: the direction of least overlap
};

/// The claims of a pair compared with its shapes.
struct Verdict {
  int claims = 0;  // number of claims tested
  int wrong = 0;
  int beyond = 0;                   // of these, beyond the tolerance that the user gives
  std::optional<Problem> worst{};   // largest error of the first kind that occurs
  double farthest = 0;              // its error, metres
  std::vector<double> deeper{};     // for each point: excess of its reported overlap
  std::vector<double> separations;  // measured, for the same points
  double tolerance = 0;             // metres
  double allowed = 0;               // likewise, by the user
  int kept = 0;                     // claims that hold for points kept from earlier frames alone
};

/// Whether the largest separation, read with another sign or unit, has the size of the measured
/// one. Any small number is near enough for surfaces that nearly touch.
bool have_their_size(const Reading& reading, const Verdict& verdict);

/// The shapes of a trace by name. Degenerate shapes are left out and listed in `refused`.
class Solids {
 public:
  void add(const trace::Shape& shape);
  /// Deforms meshes; undone by the next frame.
  void deform(const std::vector<trace::Deformed>& now);
  /// nullptr: refused or unknown.
  const Solid* find(const std::string& name, Form form = Form::AsReported) const;
  /// The body of a shape; without one, the shape itself.
  const std::string& body_of(const std::string& name) const;

  /// Error of claims about two shapes for which causes are sought, metres: lint::tolerance_of(), or
  /// `tolerance` if that is smaller. A larger one only hides.
  double tolerance_of(const Placed& a, const Placed& b) const;
  /// Allowed error: at least tolerance_of().
  double allowed_for(const Placed& a, const Placed& b) const;

  /// Type of a known shape, as in the trace.
  const std::string& type_of(const std::string& name) const { return shapes_.at(name).type; }

  /// The shapes that collided: Bullet rounds edges, but not of two boxes.
  Reading collided(const std::string& a, const std::string& b) const;

  bool are_of_bullet = false;
  std::map<std::string, std::string> refused;  // reasons by name
  double tolerance = 0;                        // metres; 0: not given

 private:
  std::map<std::string, trace::Shape> shapes_;
  std::map<std::string, Solid> solids_, deformed_;
  mutable std::map<std::pair<std::string, Form>, Solid> reformed_;  // created on demand
};

struct LintOptions;
class Balance;

/// A sign may be wrong in a single frame, and then explains a jump.
enum class Explained { Wholly, ButForSigns };

/// A frame and its neighbours; nullptr if there is none.
struct Moments {
  const trace::Frame* before = nullptr;
  const trace::Frame* now = nullptr;
  const trace::Frame* after = nullptr;
  const LintOptions* options = nullptr;
  /// Pairs of this frame whose errors a check over time explains.
  std::map<const trace::Pair*, Explained>* explained = nullptr;
  const Balance* balance = nullptr;  // of this frame
  bool after_step = false;           // poses are those after the step of the contacts

  /// The frame with the poses of the contacts.
  const trace::Frame* of_contacts() const { return after_step ? before : now; }
};

/// Pose of a shape in a frame under a reading; empty if there is none.
std::optional<Placed> place(const Solids& solids, const trace::Frame* frame,
                            const std::string& name, const Reading& reading);

/// Whether the step of the contacts leaves a shape exactly where it is, as of a sleeping body.
bool stands_still(const Solids& solids, const Moments& frames, const std::string& name);

/// Whether another frame has b elsewhere, as seen from a.
bool moves(const Solids& solids, const Moments& frames, const trace::Pair& pair, double tolerance);

/// Tests every claim of a pair's manifolds under one reading; empty without shapes or poses.
std::optional<Verdict> judge(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                             const Reading& reading);

/// Scales that differ by less are the same, and margins as such.
inline constexpr double kSameScale[] = {1.03, 1.01};
/// The scale of shape a (0), of b (1), or of both alike (2), under which the shapes have the
/// separations of all points and the points are on them; 0: there is none. Or the margin that a (3) or
/// b (4) has in addition, as such a scale: 1.1 is a tenth of the shape's size.
double scale_of(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                std::size_t which);

/// Allowed error of claims about two shapes, metres: a share of the smaller one, plus the single
/// precision rounding of their coordinates.
double tolerance_of(const Placed& a, const Placed& b);

}  // namespace contactscope::lint
