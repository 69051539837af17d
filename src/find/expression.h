#pragma once

#include "core/standard.h"

/// A condition on contacts, as on the command line of `shrink` and `find`:
///
///     float.points != double.points
///     abs(bullet.separation - double.separation) > 0.001 and double.touching
///     overlap > 5 mm and normal_turn > 20 deg
///
/// Numbers, also with a unit, texts in quotes and SIDE.QUANTITY, with + - * /, == != < <= > >=, and,
/// or, not, parentheses, abs(x) and angle(SIDE, SIDE), degrees between two normals. A value that a
/// side does not know, such as the normal of separated shapes, is neither equal nor unequal to
/// anything.
namespace contactscope::find {

/// A number or a text. nan: unknown.
using Value = std::variant<double, std::string>;
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Unit of a value. Different ones cannot be compared; a number without a unit fits all.
enum class Unit { Any, Count, Text, Metres, Degrees, Seconds, NewtonSeconds };

/// A name that an expression may use.
struct Quantity {
  std::string_view name;
  Unit unit = Unit::Any;
  bool is_change = false;  // from the frame before, which is not known of the frame before
};

/// The names that the expressions of a verb may use.
struct Vocabulary {
  std::vector<Quantity> quantities;
  std::vector<std::string> sides;          // those that may precede a quantity; empty: any
  std::vector<std::string> counts;         // sides that stand alone, or before a cause: "lint"
  std::vector<std::string_view> causes{};  // that may follow "lint."; empty: any

  /// Null if there is none.
  const Quantity* quantity(std::string_view name) const;
};

/// A syntax error: what() contains the position, the remedy, and the expression with a mark below.
class ExpressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Expression {
 public:
  /// The value of a quantity of one side. For sides that are counts the quantity is a cause or
  /// empty.
  using Lookup = std::function<Value(const std::string& side, const std::string& quantity)>;

  /// A quantity of a side in the expression, as written, and its unit.
  struct Fact {
    std::string side, quantity;
    Unit unit = Unit::Any;

    std::string name() const {
      return side + (side.empty() || quantity.empty() ? "" : ".") + quantity;
    }
    friend bool operator==(const Fact&, const Fact&) = default;
  };

  /// Throws ExpressionError.
  Expression(const std::string& text, const Vocabulary& vocabulary);

  const std::string& text() const { return text_; }
  /// The facts in the expression, each once, in order.
  const std::vector<Fact>& facts() const { return facts_; }
  /// Comparisons of a quantity that has a unit with a number that has none: "50 is 50 m".
  const std::vector<std::string>& assumptions() const { return assumptions_; }
  /// The texts in quotes.
  const std::vector<std::string>& texts() const { return texts_; }
  /// The sides in the expression: "float", "bullet". A quantity without a side has the side "".
  std::set<std::string> sides() const;
  /// Whether the expression is true. Texts are true if not empty, numbers if not 0.
  bool holds(const Lookup& lookup) const;

 private:
  struct Node;
  class Parser;

  static Value evaluate(const Node& node, const Lookup& lookup);

  std::string text_;
  std::vector<Fact> facts_;
  std::vector<std::string> assumptions_, texts_;
  std::shared_ptr<const Node> root_;
};

}  // namespace contactscope::find
