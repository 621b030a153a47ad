// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QPushButton>
#include <QScrollArea>
#include <QWidget>

#include <array>
#include <vector>

#include "fields.h"
#include "step_section.h"
#include "workbench.h"

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

/// Fields of the blade; edits go to the job.
class BladeFields : public QObject {
  Q_OBJECT

 public:
  /// Preset and length go to `column`, the rest to `details`.
  BladeFields(Workbench& bench, FormColumn* column, FormColumn* details, QObject* parent);
  void refresh();

 private:
  void editBlade(const QString& text, const std::function<void(Blade&)>& change);

  Workbench& bench_;
  std::vector<Blade> presets_;
  ChoiceField* preset_;
  NumberField *length_, *young_, *yield_, *safety_, *temperature_;
  NumberField *outer_, *inner_, *width_, *thickness_;
  QLabel *outerLabel_, *innerLabel_, *widthLabel_, *thicknessLabel_;
  QLabel* minRadius_;
};

/// The left panel: the four steps of the work with their state and their few essential controls.
class WorkflowPanel : public QScrollArea {
  Q_OBJECT

 public:
  WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

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
