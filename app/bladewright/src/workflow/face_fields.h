// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QLabel>
#include <QObject>
#include <QPushButton>

#include <array>

#include "controls/fields.h"
#include "controls/list_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Fields that choose the faces of the file: the largest, all, by number, by name, one side, or the nearest
/// to a point; edits go to the design.
class FaceFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  FaceFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();
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

}  // namespace bw::app
