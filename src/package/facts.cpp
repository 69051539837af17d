#include "package/facts.h"

#include "core/spell.h"
#include "package/contactscope/version.h"
#include "scenario/run_facts.h"

#define CONTACTSCOPE_WORD_OF(number) #number
#define CONTACTSCOPE_WORD(number) CONTACTSCOPE_WORD_OF(number)

namespace contactscope::package {
namespace {

std::string spelled(const Vec3& vector) {
  return printed("(%.6g, %.6g, %.6g)", vector.x, vector.y, vector.z);
}

}  // namespace

const char* version() {
  return CONTACTSCOPE_WORD(CONTACTSCOPE_VERSION_MAJOR) "." CONTACTSCOPE_WORD(
      CONTACTSCOPE_VERSION_MINOR) "." CONTACTSCOPE_WORD(CONTACTSCOPE_VERSION_PATCH);
}

const char* trace_schema() { return contactscope::trace::kSchema; }

double separation_of(const Manifold& manifold) {
  if (manifold.points.empty()) return 0;
  return std::ranges::min(manifold.points, {}, &ContactPoint::separation).separation;
}

double separation_of(const std::vector<Manifold>& manifolds) {
  std::optional<double> deepest;
  for (const Manifold& manifold : manifolds) {
    if (manifold.points.empty()) continue;
    deepest = std::min(deepest.value_or(separation_of(manifold)), separation_of(manifold));
  }
  return deepest.value_or(0);
}

std::string to_string(const Manifold& manifold) {
  std::string text =
      "normal " + spelled(manifold.normal) + ", " + counted(manifold.points.size(), "point");
  const auto spell = [](const ContactPoint& point) {
    return spelled(point.position) + printed(" %.6g", point.separation);
  };
  return text + (manifold.points.empty() ? "" : ": ") + separated(manifold.points, ", ", spell);
}

Vec3d to_inside(const Vec3& vector) { return {vector.x, vector.y, vector.z}; }

Vec3 to_outside(const Vec3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

contactscope::Pose<double> to_inside(const Pose& pose) {
  const auto& [w, x, y, z] = pose.rotation;
  Quatd rotation(w, x, y, z);
  const double length = rotation.norm();
  // Keep unit quaternions bit for bit.
  constexpr double kRounding = 1e-15;
  if (length > 0 && std::isfinite(length) && std::abs(length - 1) > kRounding)
    rotation.coeffs() /= length;
  return {rotation, to_inside(pose.position)};
}

Pose to_outside(const contactscope::Pose<double>& pose) {
  return {to_outside(pose.position),
          {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()}};
}

contactscope::trace::Manifold to_inside(const Manifold& manifold) {
  contactscope::trace::Manifold inside;
  inside.normal = to_inside(manifold.normal);
  inside.axis = manifold.axis;
  inside.type = manifold.type;
  if (manifold.triangle >= 0) inside.triangle = manifold.triangle;
  for (const ContactPoint& point : manifold.points) {
    contactscope::trace::Point& record = inside.points.emplace_back();
    record.position = to_inside(point.position);
    record.separation = point.separation;
    record.id = point.id;
  }
  return inside;
}

Manifold to_outside(const contactscope::trace::Manifold& manifold) {
  Manifold outside;
  outside.normal = to_outside(manifold.normal);
  outside.axis = manifold.axis;
  outside.type = manifold.type;
  outside.triangle = manifold.triangle.value_or(-1);
  outside.points = mapped(manifold.points, [](const contactscope::trace::Point& point) {
    return ContactPoint{to_outside(point.position), point.separation, point.id};
  });
  return outside;
}

contactscope::trace::Shape traced(const std::string& name, const Collider& collider,
                                  Scalar scalar) {
  contactscope::trace::Shape shape;
  shape.name = name;
  shape.type = collider.built().type;
  const auto describe_kind = [&](const auto& kind) { describe(kind, shape); };
  if (scalar == Scalar::Float)
    std::visit(describe_kind, collider.built().in_float);
  else
    std::visit(describe_kind, collider.built().in_double);
  return shape;
}

Trace trace_of(contactscope::trace::Trace facts) {
  return Trace(std::make_shared<const Trace::Facts>(Trace::Facts{std::move(facts)}));
}

const char* name_of(Scalar scalar) { return scalar == Scalar::Float ? "float" : "double"; }

void refuse(const std::string& what, const std::string& word,
            const std::vector<std::string_view>& known) {
  throw std::invalid_argument("unknown " + what + " '" + word + "'; " + near_or_all(word, known));
}

}  // namespace contactscope::package
