#include "find/expression.h"

#include "core/key_table.h"
#include "core/spell.h"

namespace contactscope::find {

struct Expression::Node {
  enum class Kind { Constant, Fact, Operator } kind = Kind::Constant;
  Value value{};               // for a constant
  std::string side, quantity;  // for a fact
  std::string name;            // for an operator: "+", "<", "and", "abs", "angle", "negate"
  std::vector<Node> operands{};
  Unit unit = Unit::Any;
};

const Quantity* Vocabulary::quantity(std::string_view name) const {
  const auto found = std::ranges::find(quantities, name, &Quantity::name);
  return found == quantities.end() ? nullptr : &*found;
}

namespace {

/// A unit that may follow a number.
struct UnitWord {
  std::string_view name;
  Unit unit;
  double factor;  // to the unit in which values are
};
constexpr std::array<UnitWord, 11> kUnitWords = {{{"m", Unit::Metres, 1},
                                                  {"cm", Unit::Metres, 1e-2},
                                                  {"mm", Unit::Metres, 1e-3},
                                                  {"um", Unit::Metres, 1e-6},
                                                  {"nm", Unit::Metres, 1e-9},
                                                  {"deg", Unit::Degrees, 1},
                                                  {"rad", Unit::Degrees, 180 / std::numbers::pi},
                                                  {"s", Unit::Seconds, 1},
                                                  {"ms", Unit::Seconds, 1e-3},
                                                  {"Ns", Unit::NewtonSeconds, 1},
                                                  {"N", Unit::NewtonSeconds, 1}}};

const char* spelled(Unit unit) {
  constexpr const char* kNames[] = {"a number", "a count", "a text",    "a length",
                                    "an angle", "a time",  "an impulse"};
  return kNames[static_cast<std::size_t>(unit)];
}

double number_of(const Value& value) {
  const double* const number = std::get_if<double>(&value);
  return number != nullptr ? *number : kUnknown;
}

bool is_true(const Value& value) {
  if (const auto* const text = std::get_if<std::string>(&value)) return !text->empty();
  const double number = std::get<double>(value);
  return !std::isnan(number) && number != 0;
}

/// Compares two texts, or two known numbers; everything else is unordered.
std::optional<int> order_of(const Value& one, const Value& other) {
  if (one.index() != other.index()) return std::nullopt;
  if (const auto* const text = std::get_if<std::string>(&one))
    return text->compare(std::get<std::string>(other));
  const double a = number_of(one), b = number_of(other);
  if (std::isnan(a) || std::isnan(b)) return std::nullopt;
  return a < b ? -1 : a > b;
}

bool compare(const std::string& name, const Value& one, const Value& other) {
  const std::optional<int> order = order_of(one, other);
  if (!order) return false;
  if (name == "==") return *order == 0;
  if (name == "!=") return *order != 0;
  if (name == "<") return *order < 0;
  if (name == "<=") return *order <= 0;
  return name == ">" ? *order > 0 : *order >= 0;
}

double calculate(const std::string& name, double a, double b) {
  if (name == "+") return a + b;
  if (name == "-") return a - b;
  return name == "*" ? a * b : a / b;
}

}  // namespace

/// Recursive descent: or, and, not, comparison, sum, product, sign, term.
class Expression::Parser {
 public:
  Parser(const std::string& text, const Vocabulary& vocabulary, std::vector<Fact>& facts,
         std::vector<std::string>& assumptions, std::vector<std::string>& texts)
      : text_(text),
        vocabulary_(vocabulary),
        facts_(facts),
        assumptions_(assumptions),
        texts_(texts) {
    next();
  }

  Node whole() {
    Node root = disjunction();
    if (!token_.empty()) fail("unexpected '" + token_ + "'; join conditions with 'and' or 'or'");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail(begin_, what); }
  [[noreturn]] void fail(std::size_t at, const std::string& what) const {
    throw ExpressionError("column " + std::to_string(at + 1) + " of '" + text_ + "': " + what +
                          "\n  " + text_ + "\n  " + std::string(at, ' ') + "^");
  }

  /// Reads the token that starts at `at_`; empty at the end.
  void next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    begin_ = at_;
    token_.clear();
    if (at_ >= text_.size()) return;
    const char first = text_[at_];
    const auto is_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    if (first == '"' || first == '\'') {
      const std::size_t end = text_.find(first, at_ + 1);
      if (end == std::string::npos) fail("the closing quote is missing");
      token_ = text_.substr(at_, end + 1 - at_);
      at_ = end + 1;
    } else if (std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '.') {
      const char* const begin = text_.data() + at_;
      const char* const end = std::from_chars(begin, text_.data() + text_.size(), number_).ptr;
      if (end == begin) fail("'.' is not a number");
      token_.assign(begin, end);
      at_ += token_.size();
    } else if (is_word(first)) {
      while (at_ < text_.size() && is_word(text_[at_])) token_ += text_[at_++];
    } else {
      token_ = text_[at_++];
      const std::string both = token_ + (at_ < text_.size() ? text_[at_] : ' ');
      if (both == "==" || both == "!=" || both == "<=" || both == ">=" || both == "&&" ||
          both == "||") {
        token_ = both;
        ++at_;
      }
    }
    if (token_ == "&&") token_ = "and";
    if (token_ == "||") token_ = "or";
    if (token_ == "!") token_ = "not";
    if (token_ == "=") fail("compare with '==', '>=' or '<=', not '='");
  }

  bool take(const std::string& token) {
    if (token_ != token) return false;
    next();
    return true;
  }
  void need(const std::string& token) {
    if (!take(token))
      fail(token_.empty() ? "'" + token + "' is missing at the end"
                          : "found '" + token_ + "', expected '" + token + "'");
  }

  static Node apply(const std::string& name, std::vector<Node> operands, Unit unit = Unit::Any) {
    return {Node::Kind::Operator, {}, {}, {}, name, std::move(operands), unit};
  }

  /// The unit of a result; fails at the operator if a length is compared with an angle.
  Unit unit_of(const std::string& name, const Node& left, const Node& right, std::size_t at) const {
    const Unit one = left.unit, other = right.unit;
    if (name == "and" || name == "or") return Unit::Any;
    const bool is_plain = other == Unit::Any || other == Unit::Count;
    if (name == "*")
      return is_plain ? one : one == Unit::Any || one == Unit::Count ? other : Unit::Any;
    if (name == "/") return is_plain ? one : Unit::Any;
    if (one != Unit::Any && other != Unit::Any && one != other)
      fail(at, std::string("left of '") + name + "' is " + spelled(one) + ", right of it " +
                   spelled(other));
    if (one == Unit::Any) assume(left, other);
    if (other == Unit::Any) assume(right, one);
    if (name != "+" && name != "-") return Unit::Any;
    return one == Unit::Any ? other : one;
  }

  void assume(const Node& number, Unit unit) const {
    const auto known = std::ranges::find_if(
        kUnitWords, [&](const UnitWord& word) { return word.unit == unit && word.factor == 1; });
    if (number.kind != Node::Kind::Constant || known == kUnitWords.end()) return;
    const double* const value = std::get_if<double>(&number.value);
    if (value == nullptr || *value == 0) return;
    const std::string spelled = printed("%g", *value);
    assumptions_.push_back(spelled + " is " + spelled + " " + std::string(known->name));
  }

  template <class Below> Node chain(std::initializer_list<const char*> names, const Below& below) {
    Node left = below();
    for (;;) {
      const auto found = std::ranges::find(names, token_);
      if (found == names.end()) return left;
      const std::size_t at = begin_;
      next();
      Node right = below();
      const Unit unit = unit_of(*found, left, right, at);
      left = apply(*found, {std::move(left), std::move(right)}, unit);
    }
  }

  Node disjunction() {
    return chain({"or"}, [&] { return conjunction(); });
  }
  Node conjunction() {
    return chain({"and"}, [&] { return negation(); });
  }
  Node negation() {
    if (take("not")) return apply("not", {negation()});
    return chain({"==", "!=", "<", "<=", ">", ">="}, [&] { return sum(); });
  }
  Node sum() {
    return chain({"+", "-"}, [&] { return product(); });
  }
  Node product() {
    return chain({"*", "/"}, [&] { return sign(); });
  }
  Node sign() {
    if (!take("-")) return term();
    Node inner = sign();
    return apply("negate", {inner}, inner.unit);
  }

  Node term() {
    if (take("(")) {
      Node inner = disjunction();
      need(")");
      return inner;
    }
    if (token_.empty()) fail("a quantity is missing at the end");
    const char first = token_.front();
    if (first == '"' || first == '\'') {
      Node text{
          Node::Kind::Constant, token_.substr(1, token_.size() - 2), {}, {}, {}, {}, Unit::Text};
      texts_.push_back(token_.substr(1, token_.size() - 2));
      next();
      return text;
    }
    if (std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(first)) == 0)
      fail("found '" + token_ + "', expected a quantity");
    if (take("abs")) {
      need("(");
      Node inner = disjunction();
      need(")");
      return apply("abs", {inner}, inner.unit);
    }
    if (take("angle")) {
      need("(");
      Node one = side();
      need(",");
      Node other = side();
      need(")");
      return apply("angle", {std::move(one), std::move(other)}, Unit::Degrees);
    }
    return fact();
  }

  /// "5", "5 mm" or "5mm".
  Node number() {
    Node number{Node::Kind::Constant, number_, {}, {}, {}, {}};
    next();
    const bool is_word =
        !token_.empty() && std::isalpha(static_cast<unsigned char>(token_.front())) != 0;
    if (!is_word || token_ == "and" || token_ == "or") return number;
    const auto known = std::ranges::find(kUnitWords, token_, &UnitWord::name);
    const std::vector<std::string_view> names = names_in(kUnitWords);
    if (known == kUnitWords.end())
      fail("'" + token_ + "' is not a unit; " + near_or_all(token_, names));
    number.value = std::get<double>(number.value) * known->factor;
    number.unit = known->unit;
    if (take("N"))
      need("s");
    else
      next();
    return number;
  }

  void require_side(const std::string& name) const {
    const std::vector<std::string_view> sides(vocabulary_.sides.begin(), vocabulary_.sides.end());
    if (!sides.empty() && std::ranges::find(sides, name) == sides.end())
      fail("'" + name + "' is not known here; " + did_you_mean(name, sides) +
           "before a dot there may be " + quoted_list(sides));
  }
  void require_cause(const std::string& name) const {
    const std::vector<std::string_view>& causes = vocabulary_.causes;
    if (causes.empty() || std::ranges::find(causes, name) != causes.end()) return;
    fail("'" + name + "' is not a cause of findings; " + near_or_all(name, causes));
  }
  void note(const Fact& fact) {
    if (std::ranges::find(facts_, fact) == facts_.end()) facts_.push_back(fact);
  }

  Node side() {
    Node named{Node::Kind::Fact, {}, token_, {}, {}, {}};
    if (token_.empty() || std::isalpha(static_cast<unsigned char>(token_.front())) == 0)
      fail("expected a side, such as in angle(float, double)");
    require_side(token_);
    for (const char* axis : {"normal_x", "normal_y", "normal_z"}) note({token_, axis, Unit::Count});
    next();
    return named;
  }

  Node fact() {
    const std::size_t dot = token_.find('.');
    Node named{Node::Kind::Fact, {}, token_.substr(0, dot == std::string::npos ? 0 : dot),
               token_,           {}, {}};
    if (dot != std::string::npos) named.quantity = token_.substr(dot + 1);
    const std::vector<std::string>& counts = vocabulary_.counts;
    if (dot == std::string::npos && std::ranges::find(counts, token_) != counts.end())
      std::swap(named.side, named.quantity);
    if (std::ranges::find(counts, named.side) == counts.end()) {
      if (!named.side.empty()) require_side(named.side);
      const Quantity* const known = vocabulary_.quantity(named.quantity);
      if (known == nullptr) refuse(named.quantity);
      if (known->is_change && !named.side.empty())
        fail("'" + named.quantity + "' is a change from the frame before; leave out '" +
             named.side + ".'");
      named.unit = known->unit;
    } else {
      named.unit = Unit::Count;
      if (named.side == "lint" && !named.quantity.empty()) require_cause(named.quantity);
    }
    note({named.side, named.quantity, named.unit});
    next();
    return named;
  }

  [[noreturn]] void refuse(const std::string& quantity) const {
    std::vector<std::string_view> names = names_in(vocabulary_.quantities);
    std::string near = did_you_mean(quantity, names);
    if (near.starts_with("did you mean 'motion'"))
      near += "it is in metres since the frame before; ";
    names.insert(names.end(), vocabulary_.counts.begin(), vocabulary_.counts.end());
    fail("'" + quantity + "' is not a quantity" +
         (near.empty() ? "; put the name of a shape in quotes; " : "; ") + near +
         "known: " + quoted_list(names));
  }

  const std::string& text_;
  const Vocabulary& vocabulary_;
  std::vector<Fact>& facts_;
  std::vector<std::string>&assumptions_, &texts_;
  std::size_t at_ = 0, begin_ = 0;
  std::string token_;
  double number_ = 0;  // the value of a token that is a number
};

Expression::Expression(const std::string& text, const Vocabulary& vocabulary) : text_(text) {
  root_ =
      std::make_shared<const Node>(Parser(text_, vocabulary, facts_, assumptions_, texts_).whole());
}

std::set<std::string> Expression::sides() const {
  std::set<std::string> sides;
  for (const Fact& fact : facts_) sides.insert(fact.side);
  return sides;
}

Value Expression::evaluate(const Node& node, const Lookup& lookup) {
  if (node.kind == Node::Kind::Constant) return node.value;
  if (node.kind == Node::Kind::Fact) return lookup(node.side, node.quantity);
  const auto operand = [&](std::size_t i) { return evaluate(node.operands[i], lookup); };
  const std::string& name = node.name;
  if (name == "and") return double(is_true(operand(0)) && is_true(operand(1)));
  if (name == "or") return double(is_true(operand(0)) || is_true(operand(1)));
  if (name == "not") return double(!is_true(operand(0)));
  if (name == "abs") return std::abs(number_of(operand(0)));
  if (name == "negate") return -number_of(operand(0));
  if (name == "angle") {
    double product = 0;
    for (const char* axis : {"normal_x", "normal_y", "normal_z"})
      product += number_of(lookup(node.operands[0].side, axis)) *
                 number_of(lookup(node.operands[1].side, axis));
    return std::acos(std::clamp(product, -1.0, 1.0)) * 180 / std::numbers::pi;
  }
  if (name == "+" || name == "-" || name == "*" || name == "/")
    return calculate(name, number_of(operand(0)), number_of(operand(1)));
  return double(compare(name, operand(0), operand(1)));
}

bool Expression::holds(const Lookup& lookup) const { return is_true(evaluate(*root_, lookup)); }

}  // namespace contactscope::find
