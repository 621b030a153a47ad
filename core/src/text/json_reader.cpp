// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/json_reader.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bw/core/files/file_set.h"
#include "bw/core/text/byte_order_mark.h"
#include "bw/core/text/number_text.h"

namespace bw {

using nlohmann::json;

namespace {

/// Lists within lists: what people and programs write has less than ten; a recursion over it must not end
/// the stack.
constexpr int kDeepest = 128;
/// Numbers, texts, lists and objects of one text. A short text can hold many, at some 100 bytes each.
constexpr std::size_t kMostValues = 20'000'000;

/// Thrown through the parser by its watcher.
struct TooMuch {
  Error error;
};

/// Where in a text its parser is: ".sources[0].surface.x[1]".
class Whereabouts {
 public:
  void follow(json::parse_event_t event, const json& parsed) {
    using Event = json::parse_event_t;
    const bool begins = event == Event::value || event == Event::array_start || event == Event::object_start;
    if (begins && !around_.empty()) ++around_.back().begun;
    if (event == Event::array_start || event == Event::object_start)
      around_.push_back({event == Event::array_start, {}, 0});
    else if (event == Event::array_end || event == Event::object_end)
      around_.pop_back();
    else if (event == Event::key)
      around_.back().key = parsed.get_ref<const std::string&>();
  }
  /// Of the value that is to come.
  std::string text() const {
    std::string path;
    for (std::size_t i = 0; i < around_.size(); ++i) {
      const Around& a = around_[i];
      const std::size_t index = i + 1 == around_.size() ? a.begun : a.begun - 1;
      path += a.isList ? "[" + std::to_string(index) + "]" : "." + a.key;
    }
    return path;
  }

 private:
  struct Around {
    bool isList = false;
    std::string key;
    std::size_t begun = 0;  ///< values
  };
  std::vector<Around> around_;
};

/// The word at a place of a text, where it is one that programs write for what is no finite number.
std::string unnumberAt(std::string_view text, std::size_t at) {
  const auto ofWord = [&](std::size_t i) {
    const char c = text[i];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '+';
  };
  std::size_t from = std::min(at, text.size()), to = from;
  while (from > 0 && ofWord(from - 1)) --from;
  while (to < text.size() && ofWord(to)) ++to;
  std::string word(text.substr(from, to - from)), plain;
  for (const char c : word)
    if (c != '-' && c != '+') plain += char(c | 0x20);
  return plain == "nan" || plain == "inf" || plain == "infinity" ? word : std::string();
}

}  // namespace

Result<json> parseJsonText(std::string_view text, const std::string& what) {
  if (text.size() > kLargestText)
    return fail(ErrorCode::badInput,
                what + " has " + std::to_string(text.size() >> 20) + " MB; at most " +
                    std::to_string(kLargestText >> 20) + " MB are read",
                what, double(text.size()), double(kLargestText));
  // A key that is written twice is a slip: the parser alone would silently take the last.
  std::vector<std::set<std::string>> keys;
  std::string twice;
  std::size_t values = 0;
  Whereabouts place;
  const auto watch = [&](int depth, json::parse_event_t event, json& parsed) {
    place.follow(event, parsed);
    if (depth > kDeepest)
      throw TooMuch{{ErrorCode::badInput,
                     what + " holds lists or objects within each other more than " +
                         std::to_string(kDeepest) + " deep; nothing that is read here goes so deep",
                     what, double(depth), double(kDeepest)}};
    const bool begins = event == json::parse_event_t::value || event == json::parse_event_t::array_start ||
                        event == json::parse_event_t::object_start;
    if (begins && ++values > kMostValues)
      throw TooMuch{{ErrorCode::badInput,
                     what + " holds more than " + std::to_string(kMostValues / 1'000'000) +
                         " million values; split it into several files",
                     what, double(values), double(kMostValues)}};
    if (event == json::parse_event_t::object_start) {
      keys.emplace_back();
    } else if (event == json::parse_event_t::object_end) {
      keys.pop_back();
    } else if (event == json::parse_event_t::key) {
      const std::string& key = parsed.get_ref<const std::string&>();
      if (!keys.back().insert(key).second && twice.empty()) twice = key;
    }
    return true;
  };
  try {
    json value = json::parse(text.begin(), text.end(), watch);
    if (!twice.empty())
      return fail(ErrorCode::badInput,
                  what + " holds the key \"" + twice + "\" twice in one object; remove one", twice);
    return value;
  } catch (const TooMuch& much) {
    return tl::unexpected<Error>(much.error);
  } catch (const json::parse_error& e) {
    const std::size_t at = std::min<std::size_t>(e.byte > 0 ? e.byte - 1 : 0, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
    const std::size_t lineStart = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    const std::size_t column = lineStart == std::string_view::npos ? at + 1 : at - lineStart;
    if (isUtf16(text))
      return fail(ErrorCode::badInput, what + " is UTF-16 text, which is not read here; save it as UTF-8",
                  "line 1");
    if (withoutByteOrderMark(text).find_first_not_of(" \t\r\n") == std::string_view::npos)
      return fail(ErrorCode::badInput, what + " is empty; it must hold a JSON object", what);
    if (const std::string word = unnumberAt(text, at); !word.empty())
      return fail(ErrorCode::badInput,
                  what + place.text() + " is " + word + ", which is no number; give a finite one (line " +
                      std::to_string(line) + ")",
                  what + place.text());
    return fail(
        ErrorCode::badInput,
        what + " is not valid JSON: line " + std::to_string(line) + ", column " + std::to_string(column),
        what, double(line));
  } catch (const json::out_of_range&) {
    return fail(ErrorCode::badInput, what + place.text() + " is a number that is too large",
                what + place.text());
  } catch (const std::exception& e) {
    return fail(ErrorCode::badInput, what + " is not valid JSON: " + e.what(), what);
  }
}

ObjectReader::ObjectReader(const json& object, std::string path, ExpressionScope* scope)
    : object_(object), path_(std::move(path)), scope_(scope) {
  if (!object_.is_object())
    error_ = Error{ErrorCode::badInput, path_ + " must be a JSON object, not " + object_.type_name(), path_};
}

const json* ObjectReader::member(const std::string& key) {
  known_.push_back(key);
  if (!object_.is_object()) return nullptr;
  const auto it = object_.find(key);
  return it == object_.end() ? nullptr : &*it;
}

const json* ObjectReader::given(const std::string& key) {
  const json* value = member(key);
  return value && !value->is_null() ? value : nullptr;
}

bool ObjectReader::has(const std::string& key) { return member(key) != nullptr; }

void ObjectReader::need(const std::string& key, const std::string& message) {
  if (has(key)) return;
  if (object_.is_object()) {
    for (const auto& item : object_.items()) {
      if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
      if (nearestWord(item.key(), &key, 1).empty()) continue;
      complain(item.key(), path_ + " has no key \"" + item.key() + "\"; did you mean \"" + key + "\"?");
      return;
    }
  }
  complain(key, message);
}

void ObjectReader::complain(const std::string& key, std::string message, std::optional<double> value,
                            std::optional<double> limit) {
  if (!error_) error_ = Error{ErrorCode::badInput, std::move(message), path_ + "." + key, value, limit};
}

const json* ObjectReader::typed(const std::string& key, bool (json::*isType)() const noexcept,
                                const char* what) {
  const json* value = member(key);
  if (!value || (value->*isType)()) return value;
  complain(key, path_ + "." + key + " must be " + what + ", not " + value->type_name());
  return nullptr;
}

std::string ObjectReader::pointerTo(const std::string& name) const {
  std::string pointer;
  for (const char c : path_.substr(std::min(path_.find_first_of(".["), path_.size())) + "." + name)
    if (c != ']') pointer += c == '.' || c == '[' ? '/' : c;
  return pointer;
}

std::optional<double> ObjectReader::numeric(const std::string& key, const std::string& name,
                                            const json& value, const char* what) {
  if (value.is_number()) return value.get<double>();
  const std::string text = value.is_string() ? value.get<std::string>() : "";
  if (!scope_ || !text.starts_with('=')) {
    complain(key, path_ + "." + name + " must be " + what + ", not " + value.type_name());
    return std::nullopt;
  }
  const Result<double> x = evaluateExpression(std::string_view(text).substr(1), scope_->numbers);
  if (!x) {
    complain(key, path_ + "." + name + ", after its =, " + x.error().message, x.error().value);
    return std::nullopt;
  }
  scope_->bound[pointerTo(name)] = {text.substr(1), *x};
  return *x;
}

bool ObjectReader::within(const std::string& key, const std::string& name, double x, double min, double max) {
  if (std::isfinite(x) && x >= min && x <= max) return true;
  std::string told;
  if (scope_)
    if (const auto bound = scope_->bound.find(pointerTo(name)); bound != scope_->bound.end())
      told = " (=" + bound->second.text + ")";
  complain(key,
           path_ + "." + name + " is " + shortText(x, 6) + told + " but must lie between " +
               shortText(min, 6) + " and " + shortText(max, 6),
           x, x < min ? min : max);
  return false;
}

void ObjectReader::number(const std::string& key, double& out, double min, double max) {
  if (const json* value = member(key)) number(key, key, *value, out, min, max);
}

bool ObjectReader::number(const std::string& key, const std::string& name, const json& entry, double& out,
                          double min, double max) {
  const std::optional<double> x = numeric(key, name, entry, "a number");
  if (!x || !within(key, name, *x, min, max)) return false;
  out = *x;
  return true;
}

void ObjectReader::number(const std::string& key, std::optional<double>& out, double min, double max) {
  if (!given(key)) return;
  double x = NAN;
  number(key, x, min, max);
  if (!std::isnan(x)) out = x;
}

void ObjectReader::integer(const std::string& key, int& out, int min, int max) {
  const json* value = member(key);
  const std::optional<double> given =
      value ? numeric(key, key, *value, "a whole number") : std::optional<double>();
  if (!given) return;
  const double x = *given;
  if (std::isfinite(x) && x == std::floor(x) && x >= min && x <= max)
    out = int(x);
  else
    complain(key,
             path_ + "." + key + " is " + shortText(x, 9) + " but must be a whole number from " +
                 std::to_string(min) + " to " + std::to_string(max),
             x, x < min ? min : max);
}

Result<void> ObjectReader::version(const std::string& key, int& out, int newest, int fallback) {
  out = fallback;
  integer(key, out, 1, 1'000'000);
  if (out > newest)
    return fail(ErrorCode::badInput,
                "the " + path_ + " has version " + std::to_string(out) + " but this program reads up to " +
                    std::to_string(newest) + "; open it with a newer Bladewright",
                path_ + "." + key, double(out), double(newest));
  return {};
}

void ObjectReader::boolean(const std::string& key, bool& out) {
  if (const json* value = typed(key, &json::is_boolean, "true or false")) out = value->get<bool>();
}

void ObjectReader::text(const std::string& key, std::string& out) {
  if (const json* value = typed(key, &json::is_string, "a text")) out = value->get<std::string>();
}

void ObjectReader::word(const std::string& key, const std::vector<std::string>& words, int& out) {
  const json* value = member(key);
  if (!value) return;
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "\"" : ", \"") + word + "\"";
  if (!value->is_string()) {
    complain(key, path_ + "." + key + " must be one of " + all);
    return;
  }
  const std::string given = value->get<std::string>();
  const auto it = std::find(words.begin(), words.end(), given);
  if (it != words.end()) {
    out = int(it - words.begin());
    return;
  }
  const std::string nearest = nearestWord(given, words.data(), int(words.size()));
  complain(key, path_ + "." + key + " is \"" + given + "\" but must be one of " + all +
                    (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

void ObjectReader::vector3(const std::string& key, Eigen::Vector3d& out, double min, double max) {
  const json* value = member(key);
  if (!value) return;
  Eigen::Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool three = value->is_array() && value->size() == 3;
    if (!three || (!(*value)[i].is_number() && !(scope_ && (*value)[i].is_string())))
      return complain(key, path_ + "." + key + " must be three numbers [x, y, z]");
    const std::string name = key + "[" + std::to_string(i) + "]";
    if (!number(key, name, (*value)[i], result(Eigen::Index(i)), min, max)) return;
  }
  out = result;
}

Result<void> ObjectReader::finish() {
  if (!error_ && object_.is_object()) {
    for (const auto& item : object_.items()) {
      if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
      const std::string nearest = nearestWord(item.key(), known_.data(), int(known_.size()));
      std::string message = path_ + " has no key \"" + item.key() + "\"";
      if (!nearest.empty()) {
        message += "; did you mean \"" + nearest + "\"?";
      } else {
        std::vector<std::string> sorted = known_;
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        message += "; it may have";
        for (std::size_t i = 0; i < sorted.size(); ++i) message += (i ? ", " : " ") + sorted[i];
      }
      complain(item.key(), message);
      break;
    }
  }
  if (error_) return tl::unexpected<Error>(*error_);
  return {};
}

}  // namespace bw
