// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QObject>

#include "controls/fields.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Fields of the CAD file and of its faces that are cut; edits go to the design.
class InputFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  InputFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();

 signals:
  void openRequested();

 private:
  void applyFaces();
  void embed(bool on);

  Workbench& bench_;
  QLabel *fileName_, *fileFacts_;
  ChoiceField* faces_;
  TextField* faceList_;
  QLabel* faceListLabel_;
  QCheckBox* embed_;
};

}  // namespace bw::app
