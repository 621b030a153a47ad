// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QWidget>

#include <vector>

#include "controls/fields.h"
#include "controls/theme.h"
#include "measure/blade_measuring.h"

namespace bw::app {

/// The measurements, a line each: how the blade was held and how far it sagged, and what follows from that.
/// The line that is worked in is the chosen one.
class MeasureTable : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kMostRows = 50;

  explicit MeasureTable(const Theme& theme, QWidget* parent = nullptr);

  void setRows(const std::vector<MeasurementRow>& rows);
  std::vector<MeasurementRow> rows() const;
  void setHinged(bool hinged);
  /// Shows what follows from the rows.
  void setOutcome(const MeasurementOutcome& outcome);
  int chosen() const { return chosen_; }
  void choose(int row);

 public slots:
  /// One more like the last, with its ends a little closer and no height yet; its height gets the focus.
  void addRow();

 signals:
  void edited();
  void chosenChanged(int row);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Line {
    QToolButton* number;
    NumberField *distance, *angle, *height, *temperature;
    QLabel *expected, *length, *residual;
    QToolButton* remove;
    std::vector<QWidget*> widgets() const {
      return {number, distance, angle, height, temperature, expected, length, residual, remove};
    }
  };
  void appendLine(const MeasurementRow& row);
  void removeLine(QToolButton* button);
  void arrange();
  void refreshIcons();

  const Theme& theme_;
  QGridLayout* grid_;
  std::vector<Line> lines_;
  QLabel *angleHead_ = nullptr, *residualHead_ = nullptr;
  QPushButton* add_;
  bool hinged_ = false;
  int chosen_ = 0;
};

}  // namespace bw::app
