#include "shrink/shrink.h"

#include "core/spell.h"

namespace contactscope::shrink {
namespace {

Quatd rotation_of(const Turn& turn) {
  const auto& n = turn.numbers;
  if (turn.form == Turn::Form::Quaternion) return Quatd(n[0], n[1], n[2], n[3]);
  const Vec3d axis(n[0], n[1], n[2]);
  if (turn.form == Turn::Form::None || axis.isZero(0)) return Quatd::Identity();
  return Quatd(Eigen::AngleAxisd(n[3] * std::numbers::pi / 180, axis.normalized()));
}

/// Significant digits of a number, without trailing zeros.
int digits_of(double number) {
  std::string text = spell(std::abs(number));
  int digits = 0;
  if (const std::size_t exponent = text.find('e'); exponent != std::string::npos) {
    digits = 1;
    text.resize(exponent);
  }
  std::erase(text, '.');
  const std::size_t first = text.find_first_not_of('0');
  if (first == std::string::npos) return 0;
  const std::size_t last = text.find_last_not_of('0');
  return digits + static_cast<int>(last - first) + 1;
}

template <class List, class Spell>
std::string spell_list(const List& list, const Spell& spell_one) {
  return "[" + separated(list, ", ", spell_one) + "]";
}

std::string spell_points(const std::vector<Vec3d>& points) {
  return spell_list(points, [](const Vec3d& point) { return spell(point); });
}

void add_shape(const SmallShape& shape, std::string& text) {
  const auto add = [&](const std::string& key, const std::string& value) {
    text += key + " = " + value + "\n";
  };
  text += "\n[shapes." + shape.name + "]\n";
  using Kind = SmallShape::Kind;
  constexpr const char* kTypes[] = {"box", "hull", "sphere", "capsule", "plane", "mesh"};
  const Kind kind = shape.kind;
  add("type", quoted(kTypes[static_cast<std::size_t>(kind)]));
  if (kind == Kind::Box) add("half_extents", spell(shape.half_extents));
  if (kind == Kind::Hull || kind == Kind::Mesh) add("vertices", spell_points(shape.vertices));
  if (kind == Kind::Capsule) add("points", spell_points(shape.vertices));
  if (kind == Kind::Sphere || kind == Kind::Capsule) add("radius", spell(shape.radius));
  if (kind == Kind::Plane) {
    add("normal", spell(shape.normal));
    add("offset", spell(shape.offset));
  }
  if (kind == Kind::Mesh)
    add("triangles", spell_list(shape.triangles, [](const std::array<int, 3>& corners) {
          return spell_list(corners, [](int corner) { return std::to_string(corner); });
        }));
  if (!shape.position.isZero(0)) add("position", spell(shape.position));
  const auto& n = shape.turn.numbers;
  if (shape.turn.form == Turn::Form::Quaternion)
    add("rotation", "{ quat_wxyz = " + spell_list(n, [](double one) { return spell(one); }) + " }");
  if (shape.turn.form == Turn::Form::AxisDegrees)
    add("rotation",
        "{ axis = " + spell(Vec3d(n[0], n[1], n[2])) + ", degrees = " + spell(n[3]) + " }");
}

/// Doubles braces, which mark placeholders in titles.
std::string without_facts(const std::string& title) {
  std::string text;
  for (const char c : title) {
    text += c;
    if (c == '{' || c == '}') text += c;
  }
  // A bar between spaces separates alternatives.
  for (std::size_t at = text.find(" | "); at != std::string::npos; at = text.find(" | "))
    text.replace(at, 3, " or ");
  return text;
}

}  // namespace

Pose<double> SmallShape::pose() const { return {rotation_of(turn), position}; }

int SmallShape::vertex_count() const {
  if (kind == Kind::Box) return 8;
  if (kind == Kind::Sphere) return 1;
  return count_of(vertices);
}

std::string spell(double number) {
  if (number == 0) return "0";
  std::string spelled = shortest(number);
  // TOML integers have 64 bits and no exponent.
  if (std::abs(number) >= 1e18 && spelled.find_first_of(".e") == std::string::npos) spelled += ".0";
  return spelled;
}

std::string spell(const Vec3d& vector) {
  return "[" + spell(vector.x()) + ", " + spell(vector.y()) + ", " + spell(vector.z()) + "]";
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

std::vector<double*> numbers_of(PairOfTwo& pair) {
  std::vector<double*> all;
  const auto add = [&](Vec3d& vector) {
    for (int i = 0; i < 3; ++i) all.push_back(&vector[i]);
  };
  for (SmallShape* const shape : {&pair.a, &pair.b}) {
    add(shape->position);
    if (shape->turn.form == Turn::Form::AxisDegrees)
      for (double& number : shape->turn.numbers) all.push_back(&number);
    if (shape->kind == SmallShape::Kind::Box) add(shape->half_extents);
    if (shape->kind == SmallShape::Kind::Sphere || shape->kind == SmallShape::Kind::Capsule)
      all.push_back(&shape->radius);
    if (shape->kind == SmallShape::Kind::Plane) {
      add(shape->normal);
      all.push_back(&shape->offset);
    }
    for (Vec3d& vertex : shape->vertices) add(vertex);
  }
  return all;
}

int digits_of(const PairOfTwo& pair) {
  PairOfTwo copy = pair;
  int digits = 0;
  for (const double* const number : numbers_of(copy)) digits += digits_of(*number);
  for (const SmallShape* const shape : {&pair.a, &pair.b})
    if (shape->turn.form == Turn::Form::Quaternion) digits += 4 * 17;
  return digits;
}

std::string to_scenario(const PairOfTwo& pair, const std::string& title,
                        const std::string& source) {
  std::string text = "title  = " + quoted(without_facts(title)) + "\n";
  text += "source = " + quoted(source) + "\n";
  if (pair.up != "y") text += "up     = " + quoted(pair.up) + "\n";
  add_shape(pair.a, text);
  add_shape(pair.b, text);
  const std::string both = "a = " + quoted(pair.a.name) + "\nb = " + quoted(pair.b.name) + "\n";
  text += "\n[[pairs]]\n" + both;
  if (!pair.settings.empty()) text += "\n[pipeline]\n";
  for (const auto& [key, value] : pair.settings) text += key + " = " + value + "\n";
  if (pair.expectation.empty()) return text;
  text += "\n[[expect]]\n" + both;
  for (const auto& [key, value] : pair.expectation) text += key + " = " + value + "\n";
  return text;
}

}  // namespace contactscope::shrink
