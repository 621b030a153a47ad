// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include <vector>

#include "controls/fields.h"
#include "workbench/workbench.h"

namespace bw::app {

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

}  // namespace bw::app
