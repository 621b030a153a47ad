// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "step_scan.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace bw::geometry {

namespace {

constexpr std::size_t kMaxDigits = 9;  // of an entity's number: OCCT keeps it in 32 bits

/// Passes over a string, comment or any other character of a STEP text; `at` must be inside it.
std::size_t nextToken(std::string_view text, std::size_t at) {
  if (text[at] == '\'') {
    const std::size_t end = text.find('\'', at + 1);
    return end == std::string_view::npos ? text.size() : end + 1;
  }
  if (text.compare(at, 2, "/*") == 0) {
    const std::size_t end = text.find("*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + 2;
  }
  return at + 1;
}

/// Calls `visit(digits, defines)` for every number of an entity in the text, until it returns false.
template <class Visit>
void eachNumber(std::string_view text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size(); at = nextToken(text, at)) {
    if (text[at] != '#') continue;
    std::size_t end = at + 1;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
    const std::string_view digits = text.substr(at + 1, end - at - 1);
    while (end < text.size() && std::isspace(static_cast<unsigned char>(text[end]))) ++end;
    if (!visit(digits, end < text.size() && text[end] == '=')) return;
  }
}

int numberOf(std::string_view digits) {
  int number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

}  // namespace

std::string stepNumberFault(std::string_view text) {
  std::vector<int> numbers;
  std::string fault;
  eachNumber(text, [&](std::string_view digits, bool defines) {
    if (digits.empty() || digits.size() > kMaxDigits ||
        digits.find_first_not_of('0') == std::string_view::npos) {
      fault = "\"#" + std::string(digits) +
              "\" is not the number of an entity; the file is damaged: copy or export it again";
      return false;
    }
    if (defines) numbers.push_back(numberOf(digits));
    return true;
  });
  if (!fault.empty()) return fault;
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice == numbers.end()) return {};
  return "its entity #" + std::to_string(*twice) +
         " is there twice; the file is damaged: copy or export it again";
}

StepReferences::StepReferences(std::string_view text) {
  int user = 0;
  eachNumber(text, [&](std::string_view digits, bool defines) {
    if (defines) {
      user = numberOf(digits);
    } else {
      uses_.emplace_back(numberOf(digits), user);
    }
    return true;
  });
  std::sort(uses_.begin(), uses_.end());
}

std::vector<int> StepReferences::usersOf(int entity) const {
  std::vector<int> users;
  for (auto it = std::lower_bound(uses_.begin(), uses_.end(), std::pair(entity, 0));
       it != uses_.end() && it->first == entity; ++it) {
    users.push_back(it->second);
  }
  return users;
}

}  // namespace bw::geometry
