// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a field shows of the expression that its number stands for while nobody types into it.
#pragma once

#include <QEvent>
#include <QLabel>

namespace bw::app {

/// A label at the left end of `field`, hidden as yet.
QLabel* makeTold(QWidget& field);
/// Puts what is told ("=width/2", "=width; 500") into `room` px, shortened where it is longer; of an
/// expression its = at least is seen.
void placeTold(QLabel& told, const QString& text, int room);
/// Shows the tooltip of `field` that `event` asks for, with `told` below.
void showWithTold(QWidget& field, const QEvent& event, const QString& told);

}  // namespace bw::app
