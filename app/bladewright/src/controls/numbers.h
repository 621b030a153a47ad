// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include <Eigen/Core>

#include "bw/core/sweep/sweep.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/sketch.h"

namespace bw::app {

/// Numbers for people, with units and sensible digits.
QString lengthText(double mm);          ///< "0.12 mm", "1.25 m" never: always mm
QString radiusText(double mm);          ///< "straight" beyond 1 km
QString angleText(double rad);          ///< "14.3°"
QString speedText(double mmPerSecond);  ///< "2.4 mm/s"
QString timeText(double seconds);       ///< "1:23.4"
QString percentText(double fraction);   ///< "98.4 %", never rounded up to 100 %
QString pointText(const Eigen::Vector3d& p);
QString sizeText(const Eigen::Vector3d& size);

/// A text that begins with a capital as part of a sentence; names in it stay as they were given.
QString withinSentence(QString text);

/// Which numbers of a result break their limits.
struct SweepLimits {
  bool deviation = false;  ///< beyond the tolerance
  bool radius = false;     ///< and stress: beyond what leaves the blade elastic
  bool angle = false, speed = false, clearance = false, floor = false, margin = false;
  bool between = false;   ///< beyond the tolerance between the stations
  bool coverage = false;  ///< the surface reaches beyond the cut by more than the tolerance
};
SweepLimits brokenLimits(const pipeline::CutResult& result, const Design& design);
SweepLimits brokenLimits(const pipeline::StationView& station, const Design& design);

/// Numbers of one station that follow from the cut surface's fields.
struct StationNumbers {
  double deviation = 0;               ///< the largest |deviation| of its row, mm
  double speedMin = 0, speedMax = 0;  ///< mm/s
  double maxCurvature = 0;            ///< of the whole blade, 1/mm
  double stress = 0;                  ///< N/mm², bending stress there
};

/// One entry a station of the sweep, or of what follows the hand.
std::vector<StationNumbers> stationNumbers(const pipeline::CutResult& result);
std::vector<StationNumbers> stationNumbers(const pipeline::CutSketch& sketch);

}  // namespace bw::app
