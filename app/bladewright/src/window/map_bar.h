// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QFrame>
#include <QLabel>
#include <QMenu>
#include <QToolButton>

#include "bw/scene/scene.h"
#include "controls/fields.h"
#include "controls/theme.h"
#include "window/commands.h"

namespace bw::app {

/// A part of a style that is on or off.
using StyleSwitch = bool& (*)(scene::Style&);
template <bool scene::Style::*member>
bool& switchOf(scene::Style& style) {
  return style.*member;
}
template <scene::Kind kind>
bool& shows(scene::Style& style) {
  return style[kind].visible;
}

/// The line over the picture: which map is shown, its range, isolines, what is visible, and the views.
class MapBar : public QFrame {
  Q_OBJECT

 public:
  MapBar(const Theme& theme, const Commands& commands, QWidget* parent = nullptr);

  const scene::Style& style() const { return style_; }
  /// Takes over a style that something else changed (theme, tolerance, playhead).
  void setStyle(const scene::Style& style);
  using QWidget::setStyle;
  /// The legend's range in use, shown in the fields while it follows the data.
  void setRangeInUse(const std::optional<std::pair<double, double>>& range);
  /// The unit of the mapped field, in which the range is typed.
  void setRangeUnit(const QString& unit);
  /// Whether there are creases, whose map can be chosen then.
  void setCreases(bool any);
  /// Puts the cursor into the range field.
  void editRange();
  ChoiceField& field() { return *field_; }
  /// What can stand beside the picture, by name, and which of them does. The third, the state before the last
  /// change, is there only if `before`.
  void setComparisons(const QStringList& items, int index, bool before);
  ChoiceField& comparison() { return *comparison_; }
  void chooseField(const std::string& name);
  /// The words of the maps in the order of the choice.
  static const std::vector<std::string>& fieldNames();

 signals:
  void styleEdited(const bw::scene::Style& style);
  void comparisonChosen(int index);

 private:
  void refresh();
  void showRange();
  QWidget* makeLayers();

  const Theme& theme_;
  scene::Style style_;
  bool mapped_ = false;  ///< a field with a range is on the screen
  ChoiceField *field_, *comparison_;
  QStringList comparisons_;
  QWidget* rangeGroup_;
  NumberField *min_, *max_;
  QToolButton *automatic_, *layers_;
  QMenu* layersMenu_;
  std::vector<std::pair<QCheckBox*, StyleSwitch>> shows_;
  std::vector<std::pair<HandSlider*, scene::Kind>> opacities_;
};

}  // namespace bw::app
