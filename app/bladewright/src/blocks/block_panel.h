// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QScrollArea>

#include "blocks/block_cuts.h"
#include "blocks/block_plan.h"
#include "controls/fields.h"
#include "controls/theme.h"
#include "workbench/workbench.h"
#include "workflow/grid_fields.h"

namespace bw::app {

/// The blocks of the design: their plan, their numbers, sizes and gaps, and the cuts of the one selected.
/// The plan stands beside the others where there is room, else above them.
class BlockPanel : public QScrollArea {
  Q_OBJECT

 public:
  BlockPanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  BlockPlan& plan() { return *plan_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void follow(const Change& change);
  void refreshLayers();
  void refreshState();
  void arrange();

  Workbench& bench_;
  const Theme& theme_;
  QBoxLayout* parts_;
  QScrollArea* details_;
  ChoiceField* layer_;
  BlockPlan* plan_;
  GridFields* numbers_;
  QLabel *icon_, *title_, *state_;
  BlockCuts* cuts_;
};

}  // namespace bw::app
