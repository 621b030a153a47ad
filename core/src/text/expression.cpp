// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "text/expression_grid.h"
#include "text/typed_text.h"

namespace bw {

namespace {

constexpr int kDeepest = 32;              // brackets, signs and powers within each other
constexpr std::size_t kLongestName = 40;  // letters

constexpr std::string_view kPiName = "pi";
constexpr const char* kOperand = "a number, a name or an opening bracket is expected";

struct Function {
  std::string_view name;
  int arguments;  // 0: two or more
};
/// In the order of the operators of a step, from `Op::sin` on.
constexpr std::array<Function, 13> kFunctions = {{{"sin", 1},
                                                  {"cos", 1},
                                                  {"tan", 1},
                                                  {"asin", 1},
                                                  {"acos", 1},
                                                  {"atan", 1},
                                                  {"sqrt", 1},
                                                  {"exp", 1},
                                                  {"log", 1},
                                                  {"abs", 1},
                                                  {"atan2", 2},
                                                  {"min", 0},
                                                  {"max", 0}}};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::string_view nameAt(std::string_view text) {
  if (text.empty() || !isLetter(text.front())) return {};
  const auto end =
      std::find_if_not(text.begin(), text.end(), [](char c) { return isLetter(c) || isDigit(c); });
  return text.substr(0, std::size_t(end - text.begin()));
}

const Function* functionOf(std::string_view name) {
  const auto* found = std::ranges::find(kFunctions, name, &Function::name);
  return found == kFunctions.end() ? nullptr : found;
}

std::string numbered(int character, const std::string& sentence) {
  return "character " + std::to_string(character) + ": " + sentence;
}

}  // namespace

/// Reads a text by descent, and lays down each operator after its operands.
class ExpressionParser {
 public:
  using Op = Expression::Op;

  ExpressionParser(std::string_view text, const std::vector<std::string>& names)
      : text_(plainSigns(text)), rest_(text_), names_(names) {}

  /// The steps of one that is read, for the other way to compute it, `ExpressionGrid`.
  static const auto& stepsOf(const Expression& expression) { return expression.steps_; }

  Result<Expression> read() {
    if (rest_.size() > Expression::kLongest)
      return fail(ErrorCode::badInput,
                  "a formula may have " + std::to_string(Expression::kLongest) + " bytes, not " +
                      std::to_string(rest_.size()),
                  "expression", double(rest_.size()), double(Expression::kLongest));
    if (!sum(0)) return tl::unexpected(*error_);
    if (!rest_.empty()) {
      refuseRest("an operator or the end is expected");
      return tl::unexpected(*error_);
    }
    return std::move(expression_);
  }

 private:
  int character() {
    const std::string_view before = std::string_view(text_).substr(0, text_.size() - rest_.size());
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    return 1 + int(std::ranges::count_if(before, begins));
  }

  bool refuseAt(int at, const std::string& sentence) {
    error_ = Error{ErrorCode::badInput, numbered(at, sentence), "expression", double(at)};
    return false;
  }
  bool refuse(const std::string& sentence) { return refuseAt(character(), sentence); }

  /// What stands at the rest is not `expected`.
  bool refuseRest(const std::string& expected) {
    if (rest_.empty()) return refuse("the formula ends where " + expected);
    std::string_view thing = nameAt(rest_);
    if (thing.empty()) thing = leadingWord(rest_);
    if (thing.empty()) thing = rest_.substr(0, 1);
    const bool product = expected != kOperand && (isLetter(rest_.front()) || rest_.front() == '(');
    const bool comma = rest_.front() == ',';
    return refuse(inQuotes(thing) + " stands where " + expected + (product ? "; products need their *" : "") +
                  (comma ? "; decimals stand after a point" : ""));
  }

  void skipSpaces() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(char c) {
    skipSpaces();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    skipSpaces();
    return true;
  }

  void lay(Op op, int at, int name = 0, double number = 0) {
    expression_.steps_.push_back({op, name, at, number});
  }

  bool deeper(int depth) { return depth <= kDeepest || refuse("the formula is nested too deeply here"); }

  bool sum(int depth) {
    if (!product(depth)) return false;
    for (;;) {
      skipSpaces();
      const int at = character();
      const bool plus = take('+');
      if (!plus && !take('-')) return true;
      if (!product(depth)) return false;
      lay(plus ? Op::add : Op::subtract, at);
    }
  }

  bool product(int depth) {
    if (!factor(depth)) return false;
    for (;;) {
      skipSpaces();
      const int at = character();
      const bool times = take('*');
      if (!times && !take('/')) return true;
      if (!factor(depth)) return false;
      lay(times ? Op::multiply : Op::divide, at);
    }
  }

  /// A sign, or a power, whose exponent may have a sign again.
  bool factor(int depth) {
    if (!deeper(depth)) return false;
    skipSpaces();
    const int at = character();
    if (take('+')) return factor(depth + 1);
    if (take('-')) {
      if (!factor(depth + 1)) return false;
      lay(Op::negate, at);
      return true;
    }
    if (!operand(depth)) return false;
    skipSpaces();
    const int power = character();
    if (!take('^')) return true;
    if (!factor(depth + 1)) return false;
    lay(Op::power, power);
    return true;
  }

  bool operand(int depth) {
    const int at = character();
    if (take('(')) {
      if (!sum(depth + 1)) return false;
      return take(')') || refuseRest("an operator or the closing bracket of character " + std::to_string(at) +
                                     " is expected");
    }
    if (rest_.empty()) return refuseRest(kOperand);
    if (takePi(rest_)) {
      lay(Op::number, at, 0, kPi);
      return true;
    }
    if (isDigit(rest_.front()) || rest_.front() == '.') return number(at);
    const std::string_view name = nameAt(rest_);
    if (name.empty()) return refuseRest(kOperand);
    if (const Function* function = functionOf(name)) return call(*function, at, depth);
    return named(name, at);
  }

  bool number(int at) {
    std::size_t end = 0;
    const auto digits = [&] {
      const std::size_t first = end;
      while (end < rest_.size() && isDigit(rest_[end])) ++end;
      return end > first;
    };
    bool any = digits();
    if (end < rest_.size() && rest_[end] == '.') {
      ++end;
      any |= digits();
    }
    if (!any) return refuseRest(kOperand);
    if (end < rest_.size() && (rest_[end] == 'e' || rest_[end] == 'E')) {
      const std::size_t mantissa = end++;
      if (end < rest_.size() && (rest_[end] == '+' || rest_[end] == '-')) ++end;
      if (!digits()) end = mantissa;
    }
    const std::string_view numeral = rest_.substr(0, end);
    if (end + 1 < rest_.size() && rest_[end] == ',' && isDigit(rest_[end + 1])) {
      const std::string whole(numeral), decimals(1, rest_[end + 1]);
      rest_.remove_prefix(end);
      return refuse("a comma between digits can part decimals or arguments; decimals stand after a point (" +
                    whole + "." + decimals + "), arguments get a space or a semicolon between them (" +
                    whole + "; " + decimals + ")");
    }
    const std::optional<double> value = parseNumber(numeral);
    if (!value) return refuse(inQuotes(numeral) + " is too large or too small");
    lay(Op::number, at, 0, *value);
    rest_.remove_prefix(end);
    return true;
  }

  bool named(std::string_view name, int at) {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) {
      std::vector<std::string> known = names_;
      known.emplace_back(kPiName);
      for (const Function& function : kFunctions) known.emplace_back(function.name);
      const std::string nearest = nearestWord(name, known.data(), int(known.size()));
      const std::string others =
          names_.empty() ? "there are no variables" : "the names are " + joined(names_, "and");
      return refuse("there is no " + inQuotes(name) + "; " +
                    (nearest.empty() ? others : "did you mean " + inQuotes(nearest) + "?"));
    }
    rest_.remove_prefix(name.size());
    if (take('(')) return refuseAt(at, inQuotes(name) + " is a number, no function; products need their *");
    lay(Op::name, at, int(found - names_.begin()));
    return true;
  }

  bool call(const Function& function, int at, int depth) {
    const std::string name(function.name);
    rest_.remove_prefix(name.size());
    if (!take('(')) return refuseRest("the bracket of " + name + "(…) is expected");
    const Op op = Op(int(Op::sin) + int(&function - kFunctions.data()));
    const bool many = function.arguments == 0;
    int count = 0;
    do {
      if (!sum(depth + 1)) return false;
      if (many && count > 0) lay(op, at);  // of the ones before, and this one
      ++count;
    } while (take(',') || take(';'));
    if (!take(')'))
      return refuseRest("an operator, a comma or the closing bracket of " + name + " is expected");
    if (many ? count < 2 : count != function.arguments)
      return refuseAt(at, name + " takes " +
                              (many                      ? "two or more"
                               : function.arguments == 1 ? "one"
                                                         : "two") +
                              (function.arguments == 1 ? " number" : " numbers") + ", not " +
                              std::to_string(count));
    if (!many) lay(op, at);
    return true;
  }

  std::string text_;
  std::string_view rest_;
  const std::vector<std::string>& names_;
  Expression expression_;
  std::optional<Error> error_;
};

Result<Expression> Expression::parse(std::string_view text, const std::vector<std::string>& names) {
  return ExpressionParser(text, names).read();
}

namespace {

using Op = ExpressionParser::Op;

/// True for an operator of two operands.
bool isBinary(Op op) { return op >= Op::atan2 || (op >= Op::add && op <= Op::power); }

/// What an operator makes of its operands; `b` is the one of a single operand.
double applied(Op op, double a, double b) {
  switch (op) {
    case Op::number:
    case Op::name:
      break;
    case Op::negate:
      return -b;
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::power:
      return std::pow(a, b);
    case Op::sin:
      return std::sin(b);
    case Op::cos:
      return std::cos(b);
    case Op::tan:
      return std::tan(b);
    case Op::asin:
      return std::asin(b);
    case Op::acos:
      return std::acos(b);
    case Op::atan:
      return std::atan(b);
    case Op::sqrt:
      return std::sqrt(b);
    case Op::exp:
      return std::exp(b);
    case Op::log:
      return std::log(b);
    case Op::abs:
      return std::abs(b);
    case Op::atan2:
      return std::atan2(a, b);
    case Op::min:
      return std::min(a, b);
    case Op::max:
      return std::max(a, b);
  }
  return b;
}

}  // namespace

Result<double> Expression::value(std::span<const double> values) const {
  std::array<double, kStack> stack;
  int top = -1;
  for (const Step& step : steps_) {
    double b = 0, a = 0;
    if (step.op == Op::number || step.op == Op::name) {
      BW_CHECK(top + 1 < kStack);
      ++top;
      b = step.op == Op::number ? step.number : values[std::size_t(step.name)];
    } else {
      b = stack[std::size_t(top)];
      if (isBinary(step.op)) a = stack[std::size_t(--top)];
    }
    double& out = stack[std::size_t(top)];
    out = applied(step.op, a, b);
    if (std::isfinite(out)) [[likely]]
      continue;
    const auto n = [](double x) { return shortText(x, 6); };
    std::string why;
    if (step.op == Op::divide && b == 0)
      why = "this divides " + n(a) + " by zero";
    else if (step.op >= Op::sin && step.op < Op::atan2)
      why = std::string(kFunctions[std::size_t(int(step.op) - int(Op::sin))].name) + "(" + n(b) +
            ") is no finite number";
    else if (step.op == Op::power)
      why = n(a) + "^" + n(b) + " is no finite number";
    else
      why = "the numbers become too large";
    return fail(ErrorCode::noSolution, numbered(step.character, why), "expression", double(step.character));
  }
  return stack[0] + 0.0;  // no "-0"
}

bool Expression::uses(std::size_t name) const {
  return std::ranges::any_of(
      steps_, [&](const Step& step) { return step.op == Op::name && std::size_t(step.name) == name; });
}

ExpressionGrid::ExpressionGrid(const Expression& expression, std::vector<double> values, std::size_t inner,
                               std::size_t outer)
    : values_(std::move(values)), inner_(inner), outer_(outer) {
  std::vector<int> stack;
  for (const auto& step : ExpressionParser::stepsOf(expression)) {
    Node node{std::uint8_t(step.op), -1, -1, step.name, false, false, {step.number}};
    if (step.op == Op::name) {
      node.byInner = std::size_t(step.name) == inner_;
      node.byOuter = std::size_t(step.name) == outer_;
    } else if (step.op != Op::number) {
      const auto takeOperand = [&] {
        const int operand = stack.back();
        stack.pop_back();
        node.byInner |= nodes_[std::size_t(operand)].byInner;
        node.byOuter |= nodes_[std::size_t(operand)].byOuter;
        return operand;
      };
      node.right = takeOperand();
      if (isBinary(step.op)) node.left = takeOperand();
    }
    stack.push_back(int(nodes_.size()));
    nodes_.push_back(std::move(node));
  }
}

bool ExpressionGrid::compute(Node& node) const {
  const Op op = Op(node.op);
  if (op == Op::number) return true;
  if (op == Op::name) {
    if (node.byInner)
      node.values = columns_;
    else
      node.values[0] = values_[std::size_t(node.name)];
    return true;
  }
  const Node& right = nodes_[std::size_t(node.right)];
  const Node& left = node.left < 0 ? right : nodes_[std::size_t(node.left)];
  const std::size_t stepLeft = left.byInner ? 1 : 0, stepRight = right.byInner ? 1 : 0;
  bool finite = true;
  for (std::size_t i = 0; i < node.values.size(); ++i) {
    node.values[i] = applied(op, left.values[i * stepLeft], right.values[i * stepRight]);
    finite &= std::isfinite(node.values[i]);
  }
  return finite;
}

void ExpressionGrid::setColumns(std::span<const double> inner) {
  columns_.assign(inner.begin(), inner.end());
  columnsAreFinite_ = true;
  for (Node& node : nodes_) {
    if (node.byInner) node.values.resize(columns_.size());
    if (!node.byOuter) columnsAreFinite_ &= compute(node);
  }
}

bool ExpressionGrid::row(double outer, std::span<const double> inner, std::span<double> out) {
  if (!std::ranges::equal(inner, columns_)) setColumns(inner);
  values_[outer_] = outer;
  bool finite = columnsAreFinite_;
  for (Node& node : nodes_)
    if (node.byOuter) finite &= compute(node);
  const Node& last = nodes_.back();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = last.values[last.byInner ? i : 0] + 0.0;  // no "-0"
  return finite;
}

bool isExpressionName(std::string_view text) {
  std::string_view pi = text;
  return !text.empty() && text.size() <= kLongestName && nameAt(text) == text && !functionOf(text) &&
         !(takePi(pi) && pi.empty());
}

Result<double> evaluateExpression(std::string_view text, std::span<const NamedNumber> numbers) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const NamedNumber& number : numbers) {
    names.push_back(number.name);
    values.push_back(number.value);
  }
  const Result<Expression> expression = Expression::parse(text, names);
  return expression ? expression->value(values) : Result<double>(tl::unexpected<Error>(expression.error()));
}

}  // namespace bw
