// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QObject>

#include <optional>

#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/direction_lines.h"
#include "workflow/kerf_table_field.h"
#include "workflow/margin_plot.h"
#include "workflow/number_lines.h"
#include "workflow/station_lines.h"

namespace bw::app {

/// Fields of the way of cutting: stations, direction, speed, and how the blade is fitted; edits go to the
/// job.
class ProcessFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  ProcessFields(Workbench& bench, FormColumn* column, const Theme& theme, QObject* parent);
  void refresh();
  /// What is known of the margins that serve.
  void refreshMargins();
  /// How the stations are counted, and how many are found where that follows from the tolerance.
  void refreshStations() { stations_->refresh(); }

 private:
  void addFit(FormColumn* column, const Theme& theme);
  void addKerf(FormColumn* column);
  void addMargins(FormColumn* column, const Theme& theme);  ///< what of the deviation a margin costs
  void addNumbers(FormColumn* column, ProcessPart part);

  Workbench& bench_;
  StationLines* stations_;
  ChoiceField *extend_, *fitLength_;
  DirectionLines* direction_;
  NumberField* kerf_ = nullptr;
  KerfTableField* kerfTable_;
  ProcessLines numbers_;
  QCheckBox *endpoints_, *tangents_;
  MarginPlot* trade_;
  QLabel* margins_;
};

}  // namespace bw::app
