// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>

#include "bw/core/design/design.h"

namespace bw::app {

class ChoiceField;
class Workbench;

// Words of choices for a cut, in the order of their values.

/// `BlockFace`
QStringList faceWords();
/// `CutPose::quarters`
QStringList turnWords();
/// `KeptSide`
QStringList keptWords();

/// Fills a choice of the place of a cut among those of its block, and shows its own: where its height tells
/// it, the closed field shows the place that it has.
void showOrder(ChoiceField& field, const Workbench& bench, const Cut& cut);

}  // namespace bw::app
