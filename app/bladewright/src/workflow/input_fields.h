// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QObject>
#include <QPushButton>

#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/face_fields.h"

namespace bw::app {

/// Fields of the CAD file and of its faces that are cut; edits go to the design.
class InputFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  InputFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();
  /// What can be done with the file as it lies on the disk now.
  void refreshState();
  FaceFields& faces() { return *faces_; }

 signals:
  void openRequested();
  void replaceRequested();
  void reloadRequested();
  void locateRequested();

 private:
  void applyUnit(int index);
  /// `size` of the target as it was read; zero if it was not.
  void showUnits(const geometry::CadInfo* info, const Eigen::Vector3d& size);
  void embed(bool on);

  Workbench& bench_;
  QLabel *fileName_, *fileFacts_;
  QPushButton *replace_, *reload_, *locate_;
  ChoiceField* unit_;
  FaceFields* faces_;
  QCheckBox* embed_;
};

}  // namespace bw::app
