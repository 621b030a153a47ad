// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/direction_lines.h"
#include "workflow/station_lines.h"

namespace bw::app {

/// Lines of a form for what a cut is told by, besides its surface: stations, direction, how its block lies
/// for it, its place in the order, the side that stays, the offset and its blade; edits go to the design.
class CutLines : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  CutLines(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();

 private:
  ChoiceField* addChoice(FormColumn* column, const QString& title, const QString& tip,
                         const QStringList& items, const QString& step,
                         const std::function<void(Cut&, int)>& change);
  void addOffset(FormColumn* column);

  Workbench& bench_;
  StationLines* stations_;
  DirectionLines* direction_;
  ChoiceField *up_, *turn_, *order_, *keep_;
  NumberField *offset_, *length_;
};

}  // namespace bw::app
