// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The rules on the motion itself: 16, the grips are never further apart than the blade is long, 17, no
// target leaps out of the path, and 19, outside of the foam the blade is carried as it lies. All find what is
// in no declaration wrong: a target that was moved, or that belongs to another program.

#include <algorithm>
#include <cmath>

#include "bw/core/motion/motion.h"
#include "bw/core/text/number_text.h"
#include "motion/motion_check.h"
#include "rapid/linked_program.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

constexpr double kLengthSlack = 1e-3;  ///< mm, rounding of printed positions
constexpr double kSpeedLeap = 2;       ///< times its stated speed that a move may ask for by its \T
constexpr double kRateLeap = 3;        ///< times what the slower moves of the block do
constexpr double kTargetLeap = 2.5;    ///< times the moves beside them: both moves at a target
constexpr double kLeastOffset = 5;     ///< mm that a target must be off its neighbours to be a leap
constexpr double kLeastTurn = 5;       ///< degrees

std::string nameOf(const Step& step) { return quoted(step.statement->name); }

/// A move between two known targets.
struct Segment {
  bool known = false;
  double length = 0;        ///< mm
  double turn = 0;          ///< degrees
  double seconds = 0;       ///< by \T, 0 if not stated
  double speedExcess = -1;  ///< its speed by \T over that of its speeddata, below 0 if unknown
  double turnExcess = -1;
};

/// What a quarter of the values that are known stay below.
double lowerQuartile(const std::vector<Segment>& segments, double Segment::*value) {
  std::vector<double> known;
  for (const Segment& s : segments)
    if (s.*value >= 0) known.push_back(s.*value);
  if (known.empty()) return 0;
  const auto at = known.begin() + std::ptrdiff_t((known.size() - 1) / 4);
  std::nth_element(known.begin(), at, known.end());
  return *at;
}

/// Checks the moves of one synchronised block of one task.
class PathChecker {
 public:
  PathChecker(const std::vector<const Step*>& path, Breaches& breaches) : path_(path), breaches_(breaches) {
    for (std::size_t i = 0; i < path.size(); ++i) segments_.push_back(segmentTo(i));
  }

  void run() {
    const double speed = std::max(kSpeedLeap, kRateLeap * lowerQuartile(segments_, &Segment::speedExcess));
    const double turn = std::max(kSpeedLeap, kRateLeap * lowerQuartile(segments_, &Segment::turnExcess));
    for (std::size_t i = 1; i < path_.size(); ++i) {
      const Segment& s = segments_[i];
      const std::string move = "the move from " + nameOf(*path_[i - 1]) + " to " + nameOf(*path_[i]);
      if (s.speedExcess > speed) {
        leap(i, move + " goes " + shortText(s.length, 4) + " mm in " + shortText(s.seconds, 4) + " s, at " +
                    shortText(s.speedExcess) + " times the " + shortText(path_[i]->speed, 4) +
                    " mm/s of its speeddata; one of them leaps");
      } else if (s.turnExcess > turn && s.turn > kLeastTurn) {
        leap(i, move + " turns by " + shortText(s.turn) + " degrees in " + shortText(s.seconds, 4) +
                    " s, at " + shortText(s.turnExcess) +
                    " times the rate of its speeddata; one of them leaps");
      } else {
        checkTarget(i);
      }
    }
  }

 private:
  Segment segmentTo(std::size_t i) const {
    Segment s;
    if (i == 0 || !hasPose(*path_[i]) || !hasPose(*path_[i - 1])) return s;
    const Pose a = poseOf(*path_[i - 1]), b = poseOf(*path_[i]);
    s.known = true;
    s.length = (b.position - a.position).norm();
    s.turn = turnDegrees(a.rotation.normalized(), b.rotation.normalized());
    s.seconds = std::max(0.0, path_[i]->statement->duration.value_or(0));
    if (!(s.seconds > 0)) return s;
    if (path_[i]->speed > 0) s.speedExcess = s.length / s.seconds / path_[i]->speed;
    if (const DataDeclaration* speed = path_[i]->speedData; speed && speed->numbers[1] > 0)
      s.turnExcess = s.turn / s.seconds / speed->numbers[1];
    return s;
  }

  /// A target that the path goes out to and comes back from, in moves much quicker (or, where no times are
  /// stated, longer) than those before and after.
  void checkTarget(std::size_t i) {
    if (i + 1 >= path_.size() || !segments_[i].known || !segments_[i + 1].known) return;
    const Segment &to = segments_[i], &from = segments_[i + 1];
    const bool timed = to.seconds > 0 && from.seconds > 0;
    const auto rate = [&](const Segment& s) { return timed ? s.length / s.seconds : s.length; };
    double beside = -1;
    for (const std::size_t other : {i - 1, i + 2}) {
      if (other >= path_.size() || !segments_[other].known || (timed && !(segments_[other].seconds > 0)))
        continue;
      // The approach runs at a speed of its own.
      if (!sameName(path_[other]->statement->speed, path_[i]->statement->speed)) continue;
      beside = std::max(beside, rate(segments_[other]));
    }
    if (beside < 0 || std::min(rate(to), rate(from)) <= kTargetLeap * beside) return;
    const Eigen::Vector3d p = poseOf(*path_[i]).position, before = poseOf(*path_[i - 1]).position,
                          after = poseOf(*path_[i + 1]).position;
    if ((p - before).dot(after - p) >= 0) return;
    const Eigen::Vector3d along = after - before;
    const double share =
        along.norm() > 0 ? std::clamp((p - before).dot(along) / along.squaredNorm(), 0.0, 1.0) : 0;
    const double offset = (p - before - share * along).norm();
    if (offset < kLeastOffset) return;
    leap(i, "the target " + nameOf(*path_[i]) + " lies " + shortText(offset, 4) +
                " mm off the way between its neighbours, which are " + shortText(along.norm(), 4) +
                " mm apart; it leaps");
  }

  void leap(std::size_t i, std::string message) { breaches_.rule(17, *path_[i], std::move(message)); }

  const std::vector<const Step*>& path_;
  Breaches& breaches_;
  std::vector<Segment> segments_;
};

constexpr double kHeld = 0.1;       ///< mm by which the right end may move against the left one
constexpr double kHeldTurn = 0.05;  ///< degrees by which an end may turn

/// The right end seen from the left one.
Pose between(const Step& left, const Step& right) {
  const Pose a = poseOf(left), b = poseOf(right);
  const Eigen::Quaterniond back = a.rotation.normalized().conjugate();
  return {back * (b.position - a.position), back * b.rotation.normalized()};
}

}  // namespace

void checkCarried(const LinkedProgram& program, Breaches& breaches) {
  if (program.tasks.size() != 2) return;
  const std::vector<const Step*> left = synchronisedMoves(program.tasks[0]),
                                 right = synchronisedMoves(program.tasks[1]);
  const std::size_t n = std::min(left.size(), right.size());
  const auto look = [&](std::size_t out, std::size_t in, std::string_view name) {
    const Step &l = *left[out], &r = *right[out];
    if (!sameName(l.statement->name, name) || !hasPose(l) || !hasPose(r) || !hasPose(*left[in]) ||
        !hasPose(*right[in]))
      return;
    const Pose a = between(l, r), b = between(*left[in], *right[in]);
    const double off = (a.position - b.position).norm(), turn = turnDegrees(a.rotation, b.rotation);
    if (off <= kHeld && turn <= kHeldTurn) return;
    breaches.rule(19, r,
                  "at " + nameOf(l) + " the right end is held " + shortText(off, 4) + " mm and " +
                      shortText(turn, 4) + " degrees otherwise against the left one than at " +
                      nameOf(*left[in]) + ": the blade is not carried as it lies, but bent on the way");
  };
  if (n < 2) return;
  look(0, 1, kApproachTarget);
  if (left.size() == right.size()) look(n - 1, n - 2, kRetreatTarget);
}

void checkLeaps(const LinkedTask& task, Breaches& breaches) {
  for (const std::vector<const Step*>& path : synchronisedBlocks(task)) PathChecker(path, breaches).run();
}

void checkGrips(const LinkedProgram& program, double bladeLength, Breaches& breaches) {
  if (!(bladeLength > 0) || program.tasks.size() != 2) return;
  const std::vector<const Step*> left = synchronisedMoves(program.tasks[0]),
                                 right = synchronisedMoves(program.tasks[1]);
  const double most = bladeLength + mostPull(bladeLength) + kLengthSlack;
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    const double distance = lengthBetween(*left[i], *right[i]).value_or(0);
    if (distance <= most) continue;
    breaches.rule(16, *right[i],
                  "at " + nameOf(*right[i]) + " the grips are " + shortText(distance, 7) + " mm apart, " +
                      shortText(distance - bladeLength) + " mm more than the blade of " +
                      shortText(bladeLength, 7) + " mm is long; it would tear");
  }
}

}  // namespace bw::robotio
