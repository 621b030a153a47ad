// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How a stage is made, or taken over.
#pragma once

#include <chrono>
#include <memory>
#include <type_traits>
#include <utility>

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A stage as it was before, where neither its request nor anything that it stands on changed; else `make`
/// makes it of its request, and its time is added to `seconds`.
template <class Request, class T, class Make>
Result<void> settle(Stage<Request, T>& stage, const Stage<Request, T>* before,
                    const std::type_identity_t<Request>& request, Inputs inputs, double& seconds,
                    const Make& make) {
  if (before && before->value && before->request == request && before->inputs == inputs) {
    stage = *before;
    return {};
  }
  stage.request = request;
  stage.inputs = std::move(inputs);
  stage.findings.clear();
  const auto start = Clock::now();
  Result<T> made = make(stage.request, stage.findings);
  if (!made) return tl::unexpected<Error>(made.error());
  stage.value = std::make_shared<const T>(std::move(*made));
  seconds += secondsSince(start);
  return {};
}

inline void append(Findings& all, const Findings& more) { all.insert(all.end(), more.begin(), more.end()); }

}  // namespace bw::pipeline
