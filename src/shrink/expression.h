#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>

/// What a shrunk pair still has to show, as the command line has it:
///
///     float.points != double.points
///     abs(bullet.separation - double.separation) > 0.001 and double.touching
///     lint.flipped_normals
///     unmet
///
/// Numbers, texts in quotes and SIDE.QUANTITY, with + - * /, == != < <= > >=, and, or, not, parentheses,
/// abs(x) and angle(SIDE, SIDE), degrees between two normals. What a side does not know, as the normal of
/// shapes that are apart, is neither equal nor unequal to anything.
namespace contactscope::shrink {

/// A number, or a text. No number: nobody knows.
using Value = std::variant<double, std::string>;
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// An expression that cannot be read: what() says where, and what would be right.
class ExpressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Expression {
 public:
  /// What one side says of the pair; of `lint` and `unmet` the side is that word, and the quantity a cause
  /// or empty.
  using Lookup = std::function<Value(const std::string& side, const std::string& quantity)>;

  /// Throws ExpressionError.
  explicit Expression(const std::string& text);

  const std::string& text() const { return text_; }
  /// The sides that it names: "float", "bullet". A quantity by itself is of the side "".
  const std::set<std::string>& sides() const { return sides_; }
  /// Whether it holds. Texts are true where they are not empty, numbers where they are not 0.
  bool holds(const Lookup& lookup) const;

 private:
  struct Node;
  class Parser;

  static Value evaluate(const Node& node, const Lookup& lookup);

  std::string text_;
  std::set<std::string> sides_;
  std::shared_ptr<const Node> root_;
};

/// What may be asked of a side, "points" and so on.
const std::set<std::string>& quantities();

}  // namespace contactscope::shrink
