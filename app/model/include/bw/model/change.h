// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFlags>

#include <map>
#include <string>

#include "bw/pipeline/pipeline.h"

namespace bw::model {

/// What the user looks at: a cut of the design, of its block, and what of it.
struct Selection {
  enum class Kind { result, surface, block, blade, station };
  Kind kind = Kind::result;
  int station = -1;                  ///< position in the stations of the cut, for Kind::station
  std::string block = {}, cut = {};  ///< ids of the design; to select: empty = the ones that are selected
  bool operator==(const Selection&) const = default;
};

/// What can be seen of a design at work, and so what can become another.
enum class Aspect {
  design = 1 << 0,     ///< its values
  source = 1 << 1,     ///< the CAD file as it was read, with the triangles of its faces
  target = 1 << 2,     ///< of a cut: the faces that are cut
  block = 1 << 3,      ///< where its block lies, and the direction of travel
  poses = 1 << 4,      ///< its blades
  motion = 1 << 5,     ///< when they are where
  checks = 1 << 6,     ///< what was found of them, and the limits that they are judged by
  result = 1 << 7,     ///< the newest evaluation, whatever of it is another
  messages = 1 << 8,   ///< findings, errors and what an export tells
  state = 1 << 9,      ///< of the steps and of the CAD file on the disk; what may be done now
  progress = 1 << 10,  ///< of what is being computed
  selection = 1 << 11,
  playTime = 1 << 12,  ///< and whether the moving blade is shown
  sketch = 1 << 14,    ///< what follows the hand in place of the result, or that nothing does any more
  part = 1 << 15,      ///< what is left of its blocks, and how their cuts meet
  thoughts = 1 << 13,  ///< of a cut: what `pipeline::addSecondThought` adds; no picture shows it at rest
};
Q_DECLARE_FLAGS(Aspects, Aspect)
Q_DECLARE_OPERATORS_FOR_FLAGS(Aspects)
/// All aspects that belong to one cut.
inline constexpr Aspects kAspectsOfCut =
    Aspect::target | Aspect::block | Aspect::poses | Aspect::motion | Aspect::checks;

/// What changed: a view refreshes what it shows of it.
struct Change {
  Aspects whole = {};                        ///< of the design
  std::map<std::string, Aspects> cuts = {};  ///< of each cut, by its id

  /// True if one of these changed, be it of any cut.
  bool any(Aspects of) const;
  /// True if one of these changed, of the whole or of the cut selected.
  bool any(Aspects of, const Selection& seen) const;
  Change& operator|=(const Change& other);
};

/// What differs between two evaluations, either of which may be null. Stages are shared where nothing they
/// hang on changed: a stage that is the same is the same pointer.
Change difference(const pipeline::Evaluation* before, const pipeline::Evaluation* after);

}  // namespace bw::model
