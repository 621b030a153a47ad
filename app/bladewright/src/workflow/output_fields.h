// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QObject>
#include <QPushButton>

#include <array>
#include <string>
#include <vector>

#include "controls/fields.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Fields of the programs that are written, and the buttons that write them and everything else; edits go to
/// the job.
class OutputFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  OutputFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();
  /// What may be written now, and where the last export went.
  void refreshState();

 signals:
  void exportRequested();
  void programsRequested();
  void pictureRequested();

 private:
  Workbench& bench_;
  std::vector<QCheckBox*> programs_;  ///< one a format
  ChoiceField* cell_;
  std::vector<std::string> cells_;
  QPushButton *export_, *exportPrograms_;
  QLabel* exported_;
};

}  // namespace bw::app
