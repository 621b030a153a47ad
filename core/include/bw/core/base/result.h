// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "bw/core/base/remedy.h"

namespace bw {

/// What went wrong, in the classes that a caller can act on. The command line maps them to exit statuses.
enum class ErrorCode {
  badInput,     ///< the input or the usage is wrong (exit status 2)
  noSolution,   ///< the problem has no solution (3)
  cannotRead,   ///< a file could not be read (4)
  cannotWrite,  ///< a file could not be written (4)
  cancelled,    ///< stopped on request (130)
  internal,     ///< a fault of our own (5)
};

/// The name of `code` as it stands in JSON: "bad-input", "no-solution", "cannot-read", …
const char* errorCodeName(ErrorCode code);

/// One failure. `message` is one clear sentence that names the thing, the number and the remedy.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;
  std::string where = {};  ///< the file, key, station or parameter concerned; may be empty
  std::optional<double> value = std::nullopt;  ///< the offending number, if there is one
  std::optional<double> limit = std::nullopt;  ///< the bound that it violates, if there is one
  Remedies remedies = {};                      ///< of what `message` advises, what can be done at once
};

/// The result of every function that can fail. No exception crosses a module.
template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for the failing side of a `Result`.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string where = {},
                                                std::optional<double> value = std::nullopt,
                                                std::optional<double> limit = std::nullopt) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(where), value, limit, {}});
}

}  // namespace bw

/// Guards against faults of our own, never against bad input: ends the program, or the case at hand.
#define BW_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::bw::checkFailed(#condition, __FILE__, __LINE__))

namespace bw {
/// Reports a failed BW_CHECK: aborts, or throws behind a barrier.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line);
}  // namespace bw
