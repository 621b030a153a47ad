// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QObject>
#include <QPushButton>

#include <array>
#include <string>
#include <vector>

#include "controls/fields.h"
#include "controls/typed_field.h"
#include "workbench/workbench.h"
#include "workflow/export_blocks.h"

namespace bw::app {

/// A line that takes the folder of exports; empty: each asks for one.
class FolderField : public TypedField {
  Q_OBJECT

 public:
  explicit FolderField(Workbench& bench, QWidget* parent = nullptr);
  void refresh() { showValue(text() != valueText()); }

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;

 private:
  Workbench& bench_;
};

/// What is written: programs and their cell, kinds of files, blocks, and the buttons that write them. What
/// programs are made of is an edit of the design.
class OutputFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  OutputFields(Workbench& bench, FormColumn* column, const Theme& theme, QObject* parent);
  void refresh();
  /// What may be written now, and where the last export went.
  void refreshState();
  /// How the blocks stand.
  void refreshBlocks() { blocks_->refresh(); }

 signals:
  /// A folder is to be chosen.
  void folderRequested();
  void exportRequested();
  void programsRequested();
  void pictureRequested();

 private:
  Workbench& bench_;
  std::vector<QCheckBox*> programs_;  ///< one a format
  std::array<QCheckBox*, pipeline::kFileKinds> kinds_{};
  ExportBlocks* blocks_;
  ChoiceField* cell_;
  FolderField* folder_;
  std::vector<std::string> cells_;
  QPushButton *export_, *exportPrograms_;
  QLabel* exported_;
};

}  // namespace bw::app
