// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QListWidget>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// All findings, errors first; a click selects and frames the place.
class MessageList : public QListWidget {
  Q_OBJECT

 public:
  MessageList(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

 signals:
  /// How many errors and warnings stand in the list.
  void counted(int errors, int warnings);

 private:
  void refresh();

  Workbench& bench_;
  const Theme& theme_;
  Issues shown_;
};

/// The colour and icon of a severity.
QColor severityColour(Severity severity, const Colours& colours);
QString severityIcon(Severity severity);

}  // namespace bw::app
