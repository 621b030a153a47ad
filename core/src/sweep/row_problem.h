// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include <optional>

#include <vector>

#include "sweep/row_station.h"

namespace bw::sweep {

/// What the grips of some stations of a row cost, as a problem of Ceres whose parameters are the stations'
/// own numbers: how far each blade is off its section and from what is asked of it, and the kinks in the way
/// of the grips.
class RowProblem : ceres::EvaluationCallback {
 public:
  /// `stations` in the order of the row, of which those of one alone may be held beside `beside`. All of it
  /// must outlive the problem.
  RowProblem(const Row& row, std::vector<Station*> stations, const Station* beside = nullptr);
  RowProblem(const RowProblem&) = delete;
  RowProblem& operator=(const RowProblem&) = delete;
  ~RowProblem() override = default;

  /// Looks at the stations, with or without their slopes. False where one of them is none of a blade, or at a
  /// stop.
  bool look(bool slopes = true);
  /// Chooses the grips.
  void solve();
  /// The same from where what is asked for is met, or nearly.
  void settle();
  /// Half the sum of squares, the residuals, and their derivatives where these are asked for; all stations
  /// are looked at. Empty where one of them is none of a blade.
  std::optional<double> evaluate(std::vector<double>& residuals, ceres::CRSMatrix* slopes = nullptr);

 private:
  void PrepareForEvaluation(bool slopes, bool isNew) override;
  /// Has stations look at margins that they have come near to; true if one has come below a margin so.
  bool watch();
  /// Takes stations back to where the solver stands, whose last step is mostly none that it takes.
  void stepBack();

  const Row& row_;
  std::vector<Station*> stations_;
  double demand_;  ///< what it costs to miss 1 mm of what is asked for, in parts of the tolerance
  bool solving_ = false, first_ = true;  ///< where the solver begins they have been looked at
  std::vector<Station> stood_;           ///< where it stood before the step that it looks at
  bool stands_ = false;                  ///< it took the last step
  ceres::Problem problem_;               // last: it holds this
};

/// What a step of the grips of one station to those beside it may turn without being told of, rad.
inline constexpr double kEasySwing = 15 * kDegree;

}  // namespace bw::sweep
