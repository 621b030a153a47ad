// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include <array>
#include <functional>

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
  void editPlacement(const QString& text, const std::function<void(BlockPlacement&)>& change);
  BlockPlacement placement() const;

  Workbench& bench_;
  QCheckBox* automatic_;
  std::array<NumberField*, 3> origin_, size_, rotation_;
};

}  // namespace bw::app
