// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstddef>
#include <unordered_set>

#include "bw/core/text/typed_number.h"
#include "text/typed_text.h"

namespace bw {

namespace {

constexpr std::size_t kMostDigits = 9;  // fits an int
constexpr std::size_t kShortestRun = 3;

/// Reads lists of numbers and of ranges.
class ListParser {
 public:
  ListParser(std::string_view text, int count, std::string_view thing)
      : text_(plainSigns(text)), rest_(text_), count_(count), thing_(thing) {}

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
    return refuse(quoted(rest_) + " is not understood; write " + thing_ + " numbers such as 0, 3, 5-7");
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
      return refuse(quoted(high + "-" + low) + " runs backwards; write " + low + "-" + high);
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
    if (!fits || value >= count_)
      return refuse("there is no " + thing_ + " " + std::string(digits.substr(0, kMostDigits)) +
                    (fits ? "" : "\u2026") +
                    (count_ == 1 ? "; the only one is 0"
                                 : "; they are numbered from 0 to " + std::to_string(count_ - 1)));
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
  std::vector<int> numbers_;
  std::unordered_set<int> known_;
};

}  // namespace

Result<std::vector<int>> readNumberList(std::string_view text, int count, std::string_view thing) {
  return ListParser(text, count, thing).read();
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
