// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <array>

#include "controls/fields.h"
#include "controls/side_panel.h"
#include "workbench/workbench.h"
#include "workflow/blade_fields.h"
#include "workflow/block_fields.h"
#include "workflow/input_fields.h"
#include "workflow/number_lines.h"
#include "workflow/output_fields.h"
#include "workflow/process_fields.h"
#include "workflow/step_section.h"

namespace bw::app {

/// The left panel: the four steps of the work with their state and their few essential controls.
class WorkflowPanel : public SidePanel {
  Q_OBJECT

 public:
  WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  const BladeFields* bladeFields() const { return bladeFields_; }
  InputFields* inputFields() const { return input_; }
  const OutputFields* outputFields() const { return output_; }
  StepSection& section(model::Step step) { return *sections_[std::size_t(step)]; }

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

  BladeFields* bladeFields_ = nullptr;
  BlockFields* blockFields_ = nullptr;
  ProcessLines numbers_;
  InputFields* input_ = nullptr;
  ProcessFields* process_ = nullptr;
  OutputFields* output_ = nullptr;
};

}  // namespace bw::app
