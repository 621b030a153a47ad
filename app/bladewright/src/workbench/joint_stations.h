// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>

#include "bw/core/base/finding.h"
#include "bw/core/design/design.h"
#include "bw/pipeline/pipeline.h"

namespace bw::app {

/// More stations for cuts that meet: where one has others than its neighbour, they miss each other between
/// them.
struct JointStations {
  std::set<std::string> cuts;  ///< ids: the two of the joint, and all that go on in them
  int blocks = 0;              ///< that they are of
  int count = 0;               ///< of each

  /// The design with so many in each of them, and in cuts of its grid that are like them.
  Design in(const Design& design) const;
};

/// What the remedy of a finding about a joint comes to; nothing for other findings, and such as more stations
/// do not mend.
std::optional<JointStations> stationsForJoint(const pipeline::Evaluation& evaluation, const Finding& finding);

}  // namespace bw::app
