// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/typed_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_set>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "text/typed_text.h"

namespace bw {

namespace {

constexpr int kDeepestBrackets = 32;    // brackets in brackets
constexpr std::size_t kLongest = 1000;  // bytes of a text
constexpr int kTidyDigits = 13;         // of a computed value: 0.07 m is 70 mm, not 70.00000000000001
constexpr double kEqual = 1e-9;         // relative: what counts as whole, or as at a limit

/// A part of the text that has been read: scale · raw + offset in the field's unit.
struct Part {
  double raw = 0, scale = 1, offset = 0;
  bool hasUnit = false;
  bool bare = true;       ///< of a sum: a part without a unit
  bool foreign = false;   ///< in another unit than the field's
  bool sum = false;       ///< a bracket that holds units
  bool hasPi = false;     ///< pi without a unit, which may mean radians
  bool computed = false;  ///< not a single number as typed
  double value() const { return scale * raw + offset; }
};

class Parser {
 public:
  Parser(std::string_view text, const NumberDemand& demand)
      : text_(plainSigns(text)), rest_(text_), kind_(unitKindOf(demand.unit)), demand_(demand) {}

  Result<double> read() {
    if (rest_.size() > kLongest) return refuse("this is too long for a number");
    skipSpaces();
    if (rest_.empty()) return refuse("a number is missing");
    Result<Part> part = sum(0);
    if (!part) return tl::unexpected(part.error());
    skipSpaces();
    if (!rest_.empty()) return refuseRest();
    if (part->hasPi && kind_ == unitKindOf("°")) return refuse("with pi an angle needs its unit, rad or °");
    double value = part->value();
    if (!std::isfinite(value)) return refuse(inQuotes(text_) + " has no finite value");
    if (part->computed) value = parseNumber(shortText(value, kTidyDigits)).value_or(value);
    return checked(value);
  }

 private:
  tl::unexpected<Error> refuse(std::string sentence) const {
    return fail(ErrorCode::badInput, std::move(sentence));
  }

  tl::unexpected<Error> refuseRest() const {
    const std::string word(leadingWord(rest_));
    if (word.empty()) return refuse(inQuotes(rest_) + " is not understood");
    const std::vector<std::string> names = typedUnitNames(demand_.unit);
    if (const UnitKind* other = kindOfName(word); names.empty() || !other)
      return refuse(inQuotes(word) + " is not understood" +
                    (names.empty() ? "" : "; units here are " + joined(names, "and")));
    else if (other != kind_)
      return refuse(inQuotes(word) + " is the unit of " + std::string(other->name) + "; here it is " +
                    joined(names, "or"));
    return refuse(inQuotes(word) + " stands where no unit can");
  }

  Result<double> checked(double value) const {
    const auto meets = [&](double limit) { return std::abs(value - limit) <= kEqual * std::abs(limit); };
    if (demand_.whole) {
      const double whole = std::round(value);
      if (std::abs(value - whole) > kEqual * std::max(1.0, std::abs(whole)))
        return fail(ErrorCode::badInput, shortText(value, 6) + " is not a whole number", {}, value);
      value = whole;
    }
    const std::string unit = demand_.unit.empty() ? "" : (demand_.unit == "°" ? "" : " ") + demand_.unit;
    if (value > demand_.max && !meets(demand_.max))
      return fail(ErrorCode::badInput, shortText(value, 6) + unit + " is too much", {}, value, demand_.max);
    if (value < demand_.min && !meets(demand_.min))
      return fail(ErrorCode::badInput, shortText(value, 6) + unit + " is too little", {}, value, demand_.min);
    return std::min(std::max(value, demand_.min), demand_.max) + 0.0;  // no "-0"
  }

  void skipSpaces() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }

  bool take(char c) {
    skipSpaces();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// Parts joined by + and −.
  Result<Part> sum(int depth) {
    const bool minus = take('-');
    if (!minus) take('+');
    Result<Part> first = product(depth);
    if (!first) return first;
    Part total = *first;
    if (minus) total.raw = -total.raw;
    total.computed |= total.foreign;
    for (;;) {
      const bool plus = take('+');
      if (!plus && !take('-')) return total;
      const Result<Part> next = product(depth);
      if (!next) return next;
      if (total.offset != 0 || next->offset != 0) return refuse("temperatures in K or °F stand alone");
      total.bare |= next->bare;
      total.foreign |= next->foreign;
      if (total.bare && total.foreign) return refuse("one part of the sum has a unit and another has none");
      total.raw = total.value() + (plus ? next->value() : -next->value());
      total.scale = 1;
      total.hasUnit |= next->hasUnit;
      total.sum |= total.hasUnit;
      total.hasPi |= next->hasPi;
      total.computed = true;
    }
  }

  /// Parts joined by · and /; the unit of one is that of the whole.
  Result<Part> product(int depth) {
    Result<Part> first = factor(depth);
    if (!first) return first;
    Part total = *first;
    for (;;) {
      const bool cross = take('x') || take('X');
      if (cross && total.raw == 0) return refuse("a number that begins with 0x is not understood");
      const bool times = cross || take('*');
      if (!times && !take('/')) return total;
      const bool minus = take('-');
      const Result<Part> next = factor(depth);
      if (!next) return next;
      if (total.offset != 0 || next->offset != 0) return refuse("temperatures in K or °F stand alone");
      if (total.hasUnit && next->hasUnit)
        return refuse(times ? "two units are multiplied" : "one unit is divided by another");
      if (!times && next->sum) return refuse("a number is divided by one that has a unit");
      if (!times && next->raw == 0) return refuse("this divides by zero");
      total.raw = times ? total.raw * next->raw : total.raw / next->raw;
      if (minus) total.raw = -total.raw;
      if (next->hasUnit) {
        total.scale = next->scale;
        total.bare = next->bare;
        total.hasPi = next->hasPi;
      } else if (!total.hasUnit) {
        total.hasPi |= next->hasPi;
      }
      total.hasUnit |= next->hasUnit;
      total.foreign |= next->foreign;
      total.sum |= next->sum;
      total.computed = true;
    }
  }

  /// A number, pi, or a bracket, with its unit.
  Result<Part> factor(int depth) {
    if (depth > kDeepestBrackets) return refuse("these are too many brackets");
    Part part;
    if (take('(')) {
      const Result<Part> inside = sum(depth + 1);
      if (!inside) return inside;
      if (!take(')')) return rest_.empty() ? refuse("a closing bracket is missing") : refuseRest();
      part = *inside;
      part.computed = true;
      part.sum |= part.hasUnit;
    } else {
      skipSpaces();
      if (rest_.empty()) return refuse("a number is missing at the end");
      if (takePi(rest_)) {
        part.raw = kPi;
        part.hasPi = part.computed = true;
      } else {
        const Result<double> number = takeNumber(rest_);
        if (!number) return number.error().message.empty() ? refuseRest() : refuse(number.error().message);
        part.raw = *number;
      }
    }
    skipSpaces();
    const TypedUnit* unit = kind_ ? unitAt(*kind_, rest_) : nullptr;
    if (!unit) return part;
    if (part.hasUnit) return refuse(inQuotes(unit->name) + " stands after a bracket that has its unit");
    rest_.remove_prefix(unit->name.size());
    part.scale = unit->factor;
    part.offset = unit->offset;
    part.hasUnit = true;
    part.bare = part.hasPi = false;
    part.foreign = unit->factor != 1 || unit->offset != 0;
    return part;
  }

  std::string text_;
  std::string_view rest_;
  const UnitKind* kind_;
  const NumberDemand& demand_;
};

}  // namespace

Result<double> readTypedNumber(std::string_view text, const NumberDemand& demand) {
  return Parser(text, demand).read();
}

namespace {

constexpr std::size_t kMostDigits = 9;  // fits an int
constexpr std::size_t kShortestRun = 3;

/// Reads lists of numbers and of ranges.
class ListParser {
 public:
  ListParser(std::string_view text, int count, std::string_view thing, int lowest)
      : text_(plainSigns(text)), rest_(text_), count_(count), thing_(thing), lowest_(lowest) {}

  Result<std::vector<int>> read() {
    skipSpaces();
    if (rest_.empty()) return refuse("a " + thing_ + " number is missing");
    for (;;) {
      if (const Result<void> item = readItem(); !item) return tl::unexpected(item.error());
      const bool space = skipSpaces();
      if (rest_.empty()) return numbers_;
      if (rest_.front() == ',' || rest_.front() == ';') {
        rest_.remove_prefix(1);
        skipSpaces();
        if (rest_.empty()) return refuse("after the last comma a " + thing_ + " number is missing");
      } else if (!space) {
        return refuseRest();
      }
    }
  }

 private:
  tl::unexpected<Error> refuse(std::string sentence) const {
    return fail(ErrorCode::badInput, std::move(sentence));
  }

  tl::unexpected<Error> refuseRest() const {
    return refuse(inQuotes(rest_) + " is not understood; write " + thing_ + " numbers such as 0, 3, 5-7");
  }

  bool skipSpaces() {
    const std::size_t before = rest_.size();
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    return rest_.size() < before;
  }

  Result<void> readItem() {
    const Result<int> first = number();
    if (!first) return tl::unexpected(first.error());
    const std::string_view after = rest_;
    skipSpaces();
    if (rest_.empty() || rest_.front() != '-') {
      rest_ = after;
      add(*first);
      return {};
    }
    rest_.remove_prefix(1);
    skipSpaces();
    const Result<int> last = number();
    if (!last) return tl::unexpected(last.error());
    const std::string_view behind = rest_;
    skipSpaces();
    if (!rest_.empty() && rest_.front() == '-') return refuseRest();
    rest_ = behind;
    if (*last < *first) {
      const std::string low = std::to_string(*last), high = std::to_string(*first);
      return refuse(inQuotes(high + "-" + low) + " runs backwards; write " + low + "-" + high);
    }
    for (int i = *first; i <= *last; ++i) add(i);
    return {};
  }

  Result<int> number() {
    const auto end =
        std::find_if_not(rest_.begin(), rest_.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::string_view digits = rest_.substr(0, std::size_t(end - rest_.begin()));
    if (digits.empty())
      return rest_.empty() ? Result<int>(refuse("a " + thing_ + " number is missing at the end"))
                           : Result<int>(refuseRest());
    const bool fits = digits.size() <= kMostDigits;
    const int value = fits ? std::stoi(std::string(digits)) : 0;
    if (count_ <= 0) return refuse("there is no " + thing_ + " to choose");
    if (!fits || value < lowest_ || value >= lowest_ + count_)
      return refuse("there is no " + thing_ + " " + std::string(digits.substr(0, kMostDigits)) +
                    (fits ? "" : "\u2026") +
                    (count_ == 1 ? "; the only one is " + std::to_string(lowest_)
                                 : "; they are numbered from " + std::to_string(lowest_) + " to " +
                                       std::to_string(lowest_ + count_ - 1)));
    rest_.remove_prefix(digits.size());
    return value;
  }

  void add(int value) {
    if (known_.insert(value).second) numbers_.push_back(value);
  }

  std::string text_;
  std::string_view rest_;
  int count_;
  std::string thing_;
  int lowest_;
  std::vector<int> numbers_;
  std::unordered_set<int> known_;
};

}  // namespace

Result<std::vector<int>> readNumberList(std::string_view text, int count, std::string_view thing,
                                        int lowest) {
  return ListParser(text, count, thing, lowest).read();
}

std::string numberListText(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    if (end - i < kShortestRun) end = i + 1;
    if (!text.empty()) text += ", ";
    text += std::to_string(numbers[i]);
    if (end > i + 1) text += "-" + std::to_string(numbers[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace bw
