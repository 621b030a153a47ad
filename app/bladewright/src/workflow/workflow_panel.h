// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QVBoxLayout>
#include <QWidget>

#include <array>

#include "bw/model/step_state.h"
#include "controls/fields.h"
#include "controls/layout.h"
#include "controls/theme.h"
#include "workbench/workbench.h"
#include "workflow/input_fields.h"
#include "workflow/number_lines.h"
#include "workflow/output_fields.h"
#include "workflow/process_fields.h"
#include "workflow/setup_fields.h"
#include "workflow/variable_fields.h"

namespace bw::app {

/// The head of a step: chevron, icon, title, and the state as icon and words; a thin bar while it runs.
class StepHead : public QAbstractButton {
  Q_OBJECT

 public:
  StepHead(const Theme& theme, const QString& icon, const QString& title, QWidget* parent = nullptr);
  void setState(const model::StepState& state);
  const model::StepState& state() const { return state_; }
  QSize sizeHint() const override;
  /// The room that its words and icons need, in pixels.
  int textWidth() const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  const Theme& theme_;
  QString icon_;
  model::StepState state_;
};

/// A step of the work that folds: its head, and its controls below.
class StepSection : public QWidget {
  Q_OBJECT

 public:
  StepSection(const Theme& theme, const QString& icon, const QString& title, QWidget* body,
              QWidget* parent = nullptr);
  StepHead& head() { return *head_; }

 private:
  StepHead* head_;
};

/// The left panel: the four steps of the work with their state and their few essential controls.
class WorkflowPanel : public SidePanel {
  Q_OBJECT

 public:
  WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  const BladeFields* bladeFields() const { return bladeFields_; }
  InputFields* inputFields() const { return input_; }
  const OutputFields* outputFields() const { return output_; }
  StepSection& section(model::Step step) { return *sections_[std::size_t(step)]; }

 signals:
  /// The plan of the blocks is to be seen.
  void blocksRequested();

 private:
  QWidget* makeSetup();
  QWidget* makeInput();
  QWidget* makeProcess();
  QWidget* makeOutput();
  void follow(const Change& change);
  void refreshStates();

  Workbench& bench_;
  const Theme& theme_;
  std::array<StepSection*, model::kStepCount> sections_{};

  VariableFields* variables_ = nullptr;
  BladeFields* bladeFields_ = nullptr;
  BlockFields* blockFields_ = nullptr;
  CutFields* cutFields_ = nullptr;
  ProcessLines numbers_;
  InputFields* input_ = nullptr;
  ProcessFields* process_ = nullptr;
  OutputFields* output_ = nullptr;
};

}  // namespace bw::app
