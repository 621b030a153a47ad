// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <memory>
#include <optional>

#include "bw/core/sweep/blade_lengths.h"
#include "controls/theme.h"

namespace bw::app {

/// Which lengths of blade serve, as a line of lengths: those where every station is certain, those where it
/// is held, the best one, and the length of the design. A click takes a length.
class LengthBand : public QWidget {
  Q_OBJECT

 public:
  explicit LengthBand(const Theme& theme, QWidget* parent = nullptr);

  /// `lengths` null: not known yet. `length`: of the blade in use, mm.
  void show(std::shared_ptr<const BladeLengths> lengths, double length);
  using QWidget::show;
  /// The place of a length, mm, in the widget.
  double xOf(double length) const;
  QSize sizeHint() const override { return {160, 22}; }
  QSize minimumSizeHint() const override { return {80, 22}; }

 signals:
  void chosen(double length);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  double lengthAt(double x) const;
  QString tipAt(double length) const;

  const Theme& theme_;
  std::shared_ptr<const BladeLengths> lengths_;
  double length_ = 0;
};

/// How the worst station of a trial rests, in words.
QString restText(const RowTrial& trial);

/// "655 to 740 mm serve, best 710 mm", or that none does, or that it is not known yet.
QString lengthsText(const BladeLengths* lengths);

}  // namespace bw::app
