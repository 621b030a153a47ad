// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QPushButton>
#include <QScrollArea>
#include <QWidget>

#include <array>
#include <vector>

#include "blade_fields.h"
#include "block_fields.h"
#include "fields.h"
#include "step_section.h"
#include "workbench.h"

namespace bw::app {

/// The left panel: the four steps of the work with their state and their few essential controls.
class WorkflowPanel : public QScrollArea {
  Q_OBJECT

 public:
  WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  const BladeFields* bladeFields() const { return bladeFields_; }
  StepSection& section(model::Step step) { return *sections_[std::size_t(step)]; }

 signals:
  void openRequested();
  void exportRequested();
  void programsRequested();
  void pictureRequested();

 private:
  QWidget* makeSetup();
  QWidget* makeInput();
  QWidget* makeProcess();
  QWidget* makeOutput();
  void refresh();
  void refreshStates();

  Workbench& bench_;
  const Theme& theme_;
  std::array<StepSection*, model::kStepCount> sections_{};

  // Setup
  BladeFields* bladeFields_ = nullptr;
  BlockFields* blockFields_ = nullptr;
  NumberField *tolerance_ = nullptr, *clearance_ = nullptr;
  // Input
  QLabel *fileName_ = nullptr, *fileFacts_ = nullptr;
  ChoiceField* faces_ = nullptr;
  QLineEdit* faceList_ = nullptr;
  QLabel* faceListLabel_ = nullptr;
  QCheckBox* embed_ = nullptr;
  // Process
  ChoiceField *direction_ = nullptr, *stationMode_ = nullptr, *fitLength_ = nullptr;
  std::array<NumberField*, 3> directionFields_{};
  std::array<QLabel*, 3> directionLabels_{};
  NumberField *stations_ = nullptr, *spacing_ = nullptr, *lead_ = nullptr, *speed_ = nullptr, *periods_ = nullptr;
  QLabel *stationsLabel_ = nullptr, *spacingLabel_ = nullptr;
  HandSlider* stationSlider_ = nullptr;
  int dragId_ = -1;
  QCheckBox *endpoints_ = nullptr, *tangents_ = nullptr;
  // Output
  std::array<QCheckBox*, 3> programs_{};
  ChoiceField* cell_ = nullptr;
  std::vector<std::string> cells_;
  QPushButton *export_ = nullptr, *exportPrograms_ = nullptr;
  QLabel* exported_ = nullptr;
};

}  // namespace bw::app
