// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QPixmap>
#include <QTableWidget>
#include <QTimer>

#include <memory>
#include <string>
#include <vector>

#include "bw/pipeline/vary.h"
#include "bw/view/scene_view.h"
#include "controls/fields.h"
#include "controls/number_field.h"
#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// A variable of the design over a range: what the design comes to with each value, as a table with small
/// pictures that fills while it is computed. A value of it can be taken over. Closed, it stops what it
/// computes.
class VaryDialog : public QDialog {
  Q_OBJECT

 public:
  VaryDialog(Workbench& bench, const Theme& theme, QWidget* parent);
  ~VaryDialog() override;

  const QTableWidget& table() const { return *table_; }
  bool computing() const { return work_ != nullptr; }

 signals:
  /// A value of the table is to become that of the variable.
  void taken(const std::string& variable, double value);

 private:
  struct Work;

  void showVariable();
  void start();
  void stop();
  /// Puts what has been computed since into the table.
  void collect();
  void finish(const Result<void>& done);
  void add(const pipeline::Variation& variation, const scene::Content& content);
  /// Shows it, and gives a small picture of it.
  QPixmap pictureOf(const scene::Content& content);
  void copyTable();
  void takeRow();
  void refresh();

  Workbench& bench_;
  const Theme& theme_;
  ChoiceField* variable_;
  NumberField *from_, *to_, *count_;
  QPushButton *start_, *stop_, *take_, *copy_;
  QLabel* state_;
  QTableWidget* table_;
  view::SceneView* newest_;  ///< what was computed last; pictures are taken of it
  QTimer collector_;
  std::shared_ptr<Work> work_;  ///< null while nothing is computed
  std::vector<pipeline::Variation> rows_;
  std::string shown_;  ///< the variable of the rows
};

}  // namespace bw::app
