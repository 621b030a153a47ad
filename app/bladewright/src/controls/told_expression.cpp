// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/told_expression.h"

#include <QHelpEvent>
#include <QToolTip>

#include <algorithm>

namespace bw::app {

namespace {

constexpr int kMargin = 9;  // px, between it and the edge of the field
constexpr QLatin1Char kEquals('=');

}  // namespace

QLabel* makeTold(QWidget& field) {
  auto* told = new QLabel(&field);
  told->setObjectName("told");
  told->setAttribute(Qt::WA_TransparentForMouseEvents);
  told->setTextFormat(Qt::PlainText);
  told->hide();
  return told;
}

void placeTold(QLabel& told, const QString& text, int room) {
  // Rather a little nearer to the number than half a sign.
  constexpr int kNearer = 4;
  const int least = told.fontMetrics().horizontalAdvance(kEquals);
  const int width = room + kNearer >= least ? std::max(room, least) : 0;
  const QString shown = told.fontMetrics().elidedText(text, Qt::ElideRight, width);
  const bool signAlone = width > 0 && text.startsWith(kEquals) && !shown.startsWith(kEquals);
  told.setText(signAlone ? QString(kEquals) : shown);
  told.setGeometry(kMargin, 0, width, told.parentWidget()->height());
}

void showWithTold(QWidget& field, const QEvent& event, const QString& told) {
  const QString tip = field.toolTip();
  QToolTip::showText(static_cast<const QHelpEvent&>(event).globalPos(),
                     tip.isEmpty() ? told : tip + QLatin1Char('\n') + told, &field);
}

}  // namespace bw::app
