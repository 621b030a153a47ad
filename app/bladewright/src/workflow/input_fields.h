// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QObject>
#include <QPushButton>

#include <array>

#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/surface_fields.h"

namespace bw::app {

/// Fields that choose the faces of the file: the largest, all, by number, by name, one side, or the nearest
/// to a point; edits go to the design.
class FaceFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  FaceFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();
  /// Hides all of them.
  void hide();
  /// Whether the faces are being chosen in the picture, and whether they can be.
  void showChoosing(bool choosing, bool possible);

 signals:
  void chooseInPictureRequested(bool on);

 private:
  void choose(const FaceChoice& choice);
  /// Takes another way of choosing, with what it would begin with.
  void chooseKind(int kind);
  void chooseNumbers(const std::vector<int>& numbers);
  void showNames(const FaceChoice& face, const geometry::CadInfo* info);
  void showSides(const FaceChoice& face, const geometry::CadInfo* info);

  Workbench& bench_;
  ChoiceField *kinds_, *names_, *sides_;
  ListField* numbers_;
  QPushButton* inPicture_;
  std::array<NumberField*, 3> point_;
};

/// Fields of the CAD file and of its faces that are cut, or of the surface that is designed; edits go to the
/// design.
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
  /// The layers of the drawing that the design was made from, where it has several.
  void showLayers();
  /// `size` of the target as it was read; zero if it was not.
  void showUnits(const geometry::CadInfo* info, const Eigen::Vector3d& size);
  void embed(bool on);

  Workbench& bench_;
  QLabel *fileName_, *fileFacts_;
  ChoiceField* layer_;
  SurfaceFields* surface_;
  QPushButton *replace_, *reload_, *locate_;
  ChoiceField* unit_;
  FaceFields* faces_;
  QCheckBox *follow_, *embed_;
};

}  // namespace bw::app
