// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/text/expression.h"

namespace bw {

/// Parses JSON text; a syntax error tells line and column. A key that stands twice in one object is an error
/// too, and so is a text that is larger, deeper or fuller than any use has need of (memory and stack are
/// bounded).
Result<nlohmann::json> parseJsonText(std::string_view text, const std::string& what);

/// What numbers can be told by in place of digits: a text that begins with =, such as "=width/2".
struct ExpressionScope {
  std::vector<NamedNumber> numbers = {};
  /// What was read so, by the JSON pointer of the number in its document.
  std::map<std::string, BoundNumber> bound = {};
};

/// Reads one JSON object strictly: each key is asked for by name with its type and range; `finish` rejects
/// keys that nobody asked for and names the nearest one. The first error wins; reading goes on harmlessly
/// after it.
class ObjectReader {
 public:
  /// `path` is how messages name the object, for instance "job" or "job.block". With a `scope`, which must
  /// outlive the reader, numbers may be expressions.
  ObjectReader(const nlohmann::json& object, std::string path, ExpressionScope* scope = nullptr);

  bool has(const std::string& key);
  /// Complains with `message` if the key is absent, or names a key that looks like a slip for it.
  void need(const std::string& key, const std::string& message);
  /// The member, or null if it is absent.
  const nlohmann::json* member(const std::string& key);
  /// The member, or null if it is absent or null.
  const nlohmann::json* given(const std::string& key);
  /// Each leaves `out` alone where the key is absent.
  void number(const std::string& key, double& out, double min, double max);
  /// An entry of the member `key`, which messages call `name`; false where it is none.
  bool number(const std::string& key, const std::string& name, const nlohmann::json& entry, double& out,
              double min, double max);
  /// null counts as absent.
  void number(const std::string& key, std::optional<double>& out, double min, double max);
  void integer(const std::string& key, int& out, int min, int max);
  void boolean(const std::string& key, bool& out);
  void text(const std::string& key, std::string& out);
  /// One of `words`; the index goes to `out`.
  void word(const std::string& key, const std::vector<std::string>& words, int& out);
  void vector3(const std::string& key, Eigen::Vector3d& out, double min, double max);

  /// The version in `key`, needed if `fallback` is 0. One above `newest` is the error to return before
  /// anything else is read: what a newer program writes has other keys and other meanings.
  Result<void> version(const std::string& key, int& out, int newest, int fallback);

  void complain(const std::string& key, std::string message, std::optional<double> value = std::nullopt,
                std::optional<double> limit = std::nullopt);
  /// Takes over the error of what was read from a member, if it has one; false then.
  template <class T>
  bool adopt(const Result<T>& inner) {
    if (!inner && !error_) error_ = inner.error();
    return inner.has_value();
  }
  /// Takes over what was read from a member, or its error; `out` stays then.
  template <class T, class Out>
  void take(Result<T> inner, Out& out) {
    if (adopt(inner)) out = *std::move(inner);
  }
  /// After all keys were asked for: the first error, unknown keys included.
  Result<void> finish();
  const std::string& path() const { return path_; }
  ExpressionScope* scope() const { return scope_; }

 private:
  /// The member if it is of a type, else null; complains where it is of another.
  const nlohmann::json* typed(const std::string& key, bool (nlohmann::json::*isType)() const noexcept,
                              const char* what);
  /// Complains about the number `name` of the member where it is not finite or out of range.
  bool within(const std::string& key, const std::string& name, double x, double min, double max);

  const nlohmann::json& object_;
  /// A number, or what an expression comes to; complains where it is neither.
  std::optional<double> numeric(const std::string& key, const std::string& name, const nlohmann::json& value,
                                const char* what);
  /// The JSON pointer of a number of the object.
  std::string pointerTo(const std::string& name) const;

  std::string path_;
  ExpressionScope* scope_;
  std::vector<std::string> known_;
  std::optional<Error> error_;
};

}  // namespace bw
