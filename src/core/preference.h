#pragma once

namespace contactscope {

/// Which axis of the separating axis test wins when several are nearly as deep.
enum class Preference {
  /// Faces of A before faces of B before edge pairs, on meshes the triangle's face first, as long as
  /// the preferred axis is deeper by at most 5% of the depth or 0.2% of the smaller hull's radius,
  /// whichever is larger. An edge contact has one point, and features that change between frames
  /// break warm starting. Catto 2007, "Feature Flip-Flop"; Gregorius 2015, "Hull vs Hull: Feature
  /// Flip-Flop".
  Relative,
  /// The axis of true minimum penetration.
  None,
};

/// "relative", "none", as scenarios and traces spell it.
constexpr const char* to_string(Preference preference) {
  return preference == Preference::Relative ? "relative" : "none";
}

}  // namespace contactscope
