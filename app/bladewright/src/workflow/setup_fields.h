// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include <functional>
#include <vector>

#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/direction_lines.h"
#include "workflow/length_band.h"
#include "workflow/number_lines.h"

namespace bw::app {

/// Fields of the blade; edits go to the job.
class BladeFields : public QObject {
  Q_OBJECT

 public:
  /// Preset and length go to `column`, the rest to `details`.
  BladeFields(Workbench& bench, FormColumn* column, FormColumn* details, const Theme& theme, QObject* parent);
  void refresh();
  /// What is known of the lengths that serve.
  void refreshLengths();

 signals:
  /// The length is to be found from a measurement.
  void measureRequested();

 private:
  void editBlade(const QString& text, const std::function<void(Blade&)>& change);
  /// The preset that this blade is, whatever its length; null for an own one.
  const Blade* presetOf(const Blade& blade) const;

  Workbench& bench_;
  std::vector<Blade> presets_;
  ChoiceField* preset_;
  BladeLines numbers_;
  NumberField* length_;
  QCheckBox* autoLength_;
  LengthBand* band_;
  QLabel* lengths_;
  QLabel* minRadius_;
  QCheckBox* weight_;
  DirectionLines* up_;
};

/// Fields of a block's place; edits go to the job.
class BlockFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  BlockFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();

 private:
  BlockPlacement placement() const;

  Workbench& bench_;
  QCheckBox* automatic_;
  /// A number of the placement, in units of `unit`.
  struct Number {
    NumberField* field;
    Eigen::Vector3d BlockPlacement::*member;
    int axis;
    double unit;
  };
  std::vector<Number> numbers_;
};

/// Which cut is at work, and with what length of blade if not that of all; another one, and one fewer.
class CutFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  CutFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();

 private:
  void refreshChoice();
  void add();
  void remove();

  Workbench& bench_;
  QPushButton *add_, *remove_;
  ChoiceField* cut_;
  NumberField* length_;
};

}  // namespace bw::app
