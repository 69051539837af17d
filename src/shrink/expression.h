#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>

/// The property that a shrunk pair must keep, as on the command line:
///
///     float.points != double.points
///     abs(bullet.separation - double.separation) > 0.001 and double.touching
///     lint.flipped_normals
///     unmet
///
/// Numbers, texts in quotes and SIDE.QUANTITY, with + - * /, == != < <= > >=, and, or, not,
/// parentheses, abs(x) and angle(SIDE, SIDE), degrees between two normals. A value that a side does
/// not know, such as the normal of separated shapes, is neither equal nor unequal to anything.
namespace contactscope::shrink {

/// A number or a text. nan: unknown.
using Value = std::variant<double, std::string>;
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A syntax error: what() contains the position and the remedy.
class ExpressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Expression {
 public:
  /// The value of a quantity of one side. For the sides `lint` and `unmet` the quantity is a cause
  /// or empty.
  using Lookup = std::function<Value(const std::string& side, const std::string& quantity)>;

  explicit Expression(const std::string& text);

  const std::string& text() const { return text_; }
  /// The sides in the expression: "float", "bullet". A quantity without a side has the side "".
  const std::set<std::string>& sides() const { return sides_; }
  /// Whether the expression is true. Texts are true if not empty, numbers if not 0.
  bool holds(const Lookup& lookup) const;

 private:
  struct Node;
  class Parser;

  static Value evaluate(const Node& node, const Lookup& lookup);

  std::string text_;
  std::set<std::string> sides_;
  std::shared_ptr<const Node> root_;
};

/// All quantities of a side: "points" and so on.
const std::set<std::string>& quantities();

}  // namespace contactscope::shrink
