// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/robotio/cell/placement.h"

#include "motion/motion_check.h"

namespace bw::robotio {

Findings checkPlacement(const Motion& motion, const Cell& cell) {
  Findings findings;
  if (!checkMotion(motion) || motion.instants.front().poses.size() != cell.tasks.size()) return findings;
  for (std::size_t end = 0; end < cell.tasks.size(); ++end) {
    for (const MotionInstant* instant : {&motion.instants.front(), &motion.instants.back()}) {
      const Eigen::Vector3d p_W =
          cell.workObject.position + cell.workObject.rotation * instant->poses[end].position;
      const double own = (p_W - cell.tasks[end].base.position).norm();
      std::size_t nearest = end;
      double least = own;
      for (std::size_t other = 0; other < cell.tasks.size(); ++other) {
        const double distance = (p_W - cell.tasks[other].base.position).norm();
        if (distance < least) {
          nearest = other;
          least = distance;
        }
      }
      if (nearest == end) continue;
      const Eigen::Vector3d& p_B = instant->poses[end].position;
      findings.push_back({Severity::warning,
                          WrongSide{endName(end), cell.tasks[end].name, cell.tasks[nearest].name, own, least,
                                    instant == &motion.instants.front()},
                          {{}, motion.block.frame.toWorld(p_B.head<2>(), p_B.z())},
                          {TurnDirection{}}});
      break;
    }
  }
  return findings;
}

}  // namespace bw::robotio
