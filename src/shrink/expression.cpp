#include "shrink/expression.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "lint/causes.h"
#include "scenario/nearest_word.h"

namespace contactscope::shrink {

struct Expression::Node {
  enum class Kind { Constant, Fact, Operator } kind = Kind::Constant;
  Value value{};               // for a constant
  std::string side, quantity;  // for a fact
  std::string name;            // for an operator: "+", "<", "and", "abs", "angle", "negate"
  std::vector<Node> operands{};
};

const std::set<std::string>& quantities() {
  static const std::set<std::string> all = {"points",   "separation", "touching", "overlap",
                                            "axis",     "type",       "ids",      "normal_x",
                                            "normal_y", "normal_z",   "manifolds"};
  return all;
}

namespace {

std::vector<std::string_view> quantity_words() {
  return {quantities().begin(), quantities().end()};
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
  Parser(const std::string& text, std::set<std::string>& sides) : text_(text), sides_(sides) {
    next();
  }

  Node whole() {
    Node root = disjunction();
    if (!token_.empty()) fail("unexpected '" + token_ + "'");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ExpressionError("column " + std::to_string(begin_ + 1) + " of '" + text_ + "': " + what);
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
    } else if (is_word(first)) {
      const bool is_number = std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '.';
      while (at_ < text_.size() &&
             (is_word(text_[at_]) || (is_number && (text_[at_] == '-' || text_[at_] == '+') &&
                                      (text_[at_ - 1] == 'e' || text_[at_ - 1] == 'E'))))
        token_ += text_[at_++];
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
    if (token_ == "=") fail("compare with '==', not '='");
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

  static Node apply(const std::string& name, std::vector<Node> operands) {
    return {Node::Kind::Operator, {}, {}, {}, name, std::move(operands)};
  }

  template <class Below>
  Node chain(std::initializer_list<const char*> names, const Below& below) {
    Node left = below();
    for (;;) {
      const auto found = std::ranges::find(names, token_);
      if (found == names.end()) return left;
      next();
      left = apply(*found, {std::move(left), below()});
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
    if (take("-")) return apply("negate", {sign()});
    return term();
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
      Node text{Node::Kind::Constant, token_.substr(1, token_.size() - 2), {}, {}, {}, {}};
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
      return apply("abs", {std::move(inner)});
    }
    if (take("angle")) {
      need("(");
      Node one = side();
      need(",");
      Node other = side();
      need(")");
      return apply("angle", {std::move(one), std::move(other)});
    }
    return fact();
  }

  Node number() {
    double value = 0;
    const char* const end = token_.data() + token_.size();
    const auto [stop, error] = std::from_chars(token_.data(), end, value);
    if (error != std::errc() || stop != end) fail("'" + token_ + "' is not a number");
    next();
    return {Node::Kind::Constant, value, {}, {}, {}, {}};
  }

  void require_cause(const std::string& cause) const {
    const std::vector<std::string_view> known = lint::causes();
    if (std::ranges::find(known, cause) != known.end()) return;
    const std::string near = did_you_mean(cause, known);
    fail("'" + cause + "' is not a cause of findings; " +
         (near.empty() ? "known: " + quoted_list(known) : near));
  }

  Node side() {
    Node named{Node::Kind::Fact, {}, token_, {}, {}, {}};
    if (token_.empty() || std::isalpha(static_cast<unsigned char>(token_.front())) == 0)
      fail("expected a side, such as in angle(float, double)");
    sides_.insert(token_);
    next();
    return named;
  }

  Node fact() {
    const std::size_t dot = token_.find('.');
    Node named{Node::Kind::Fact, {}, {}, {}, {}, {}};
    if (token_ == "unmet" || token_ == "lint") {
      named.side = token_;
    } else if (dot == std::string::npos) {
      named.quantity = token_;
    } else {
      named.side = token_.substr(0, dot);
      named.quantity = token_.substr(dot + 1);
    }
    if (named.side == "lint" && !named.quantity.empty()) require_cause(named.quantity);
    const bool is_known =
        named.side == "lint" || named.side == "unmet" || quantities().contains(named.quantity);
    if (!is_known)
      fail("'" + named.quantity + "' is not a quantity; " +
           did_you_mean(named.quantity, quantity_words()) +
           "known: " + quoted_list(quantity_words()) + ", lint, lint.CAUSE and unmet");
    sides_.insert(named.side);
    next();
    return named;
  }

  const std::string& text_;
  std::set<std::string>& sides_;
  std::size_t at_ = 0, begin_ = 0;
  std::string token_;
};

Expression::Expression(const std::string& text) : text_(text) {
  root_ = std::make_shared<const Node>(Parser(text_, sides_).whole());
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

bool Expression::holds(const Lookup& lookup) const {
  return is_true(evaluate(*root_, lookup));
}

}  // namespace contactscope::shrink
