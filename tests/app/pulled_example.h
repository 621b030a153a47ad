// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Shipped designs, one with a pole that a hand pulls.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/pipeline.h"

namespace bw::test {

using pipeline::Evaluation;

inline Design designed(const char* name) {
  Design design = pipeline::exampleDesign(name).value();
  design.output.programs.clear();
  return design;
}

inline Design pulled(double up) {
  Design design = designed("bump");
  design.bindings.clear();
  std::get<PolesSurface>(design.source().surface->shape).at(2, 1).height += up;
  return design;
}

inline std::shared_ptr<const Evaluation> evaluated(const Design& design) {
  pipeline::Outcome outcome = pipeline::evaluate(design, nullptr, {});
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::make_shared<const Evaluation>(std::move(outcome.evaluation));
}

}  // namespace bw::test
