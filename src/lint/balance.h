#pragma once

#include "lint/claims.h"
#include "lint/linter.h"

namespace contactscope::lint {

inline constexpr double kGravity = 9.81;  // metres per second squared

/// Sums of the contact impulses on a body in a frame, N s.
struct Load {
  Vec3d impulse = Vec3d::Zero();
  Vec3d once = Vec3d::Zero();  // without points that are there already
  bool is_known = true;        // no active point is without an impulse
  std::set<std::array<double, 4>> points{};
};
using Loads = std::map<std::string, Load>;  // by body

/// Null for a body without contacts, and if an impulse is not known.
const Load* known_load(const Loads& loads, const std::string& body);

/// Compares the motion of bodies with gravity and the impulses of their contacts. Where the two agree
/// for nearly all bodies, an impulse that is missing is that of a contact that is not reported.
class Balance {
 public:
  explicit Balance(const trace::Header& header)
      : up_(header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY()) {}

  void see(const Solids& solids, const Moments& frames);

  struct Missing {
    Vec3d impulse;         // N s, world
    double share = 0;      // of weight and contacts, beyond damping; 0 in an impact
    bool was_off = false;  // in the frame before, even if that was an impact: maybe of a joint

    static constexpr double kOff = 0.05;  // more is no rounding
    bool is_off() const { return share > kOff; }
  };
  /// Null for static bodies, sleeping ones, and if impulses do not explain the motions of bodies.
  const Missing* missing(const std::string& body) const;
  bool is_off(const std::string& body) const { return missing(body) && missing(body)->is_off(); }
  const std::map<std::string, Missing>& all() const { return missing_; }

  Loads before, now, after;  // empty without such a frame

 private:
  Vec3d up_;
  std::map<std::string, Missing> missing_;
  std::set<std::string> off_;     // bodies that are off, even in an impact
  int count_ = 0, balanced_ = 0;  // bodies with contacts, of all frames
};

}  // namespace contactscope::lint
