// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include <optional>

#include "controls/fields.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Lines of a form for the stations of the cut selected: how they are counted, and their number or their
/// spacing; edits go to the design.
class StationLines : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`; `slider`: one below the number, too.
  StationLines(Workbench& bench, FormColumn* column, bool slider, QObject* parent);
  /// Also where another number is found by the tolerance.
  void refresh();

 private:
  void addSlider(FormColumn* column);
  std::optional<int> found() const;

  Workbench& bench_;
  ChoiceField* mode_;
  NumberField *number_, *spacing_;
  HandSlider* slider_ = nullptr;
  int dragId_ = -1;  ///< joins the moves of one drag of the slider
};

}  // namespace bw::app
