// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QFrame>
#include <QKeyEvent>
#include <QString>

#include <functional>
#include <optional>
#include <vector>

#include "bw/view/scene_view.h"
#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/bound_number.h"

namespace bw::app {

/// True for a key that a number may begin with; the point and the comma lead from station to station.
bool beginsNumber(const QKeyEvent& key);

/// A small field over the 3D view beside a handle, with a line for each of its numbers.
class HandleField : public QFrame {
  Q_OBJECT

 public:
  struct Line {
    QString label, name;  ///< before the number, and for screen readers
    NumberRange range;
    std::function<std::optional<double>()> value = {};  ///< as it is now; nothing: it is gone
    NumberPlace place = {};                             ///< for expressions; null: none can stand there
    /// What is typed; the field tells whether it stands for an expression.
    std::function<void(double, const NumberField&)> take = {};
  };

  HandleField(Workbench& bench, view::SceneView* view);

  /// Opens it beside a point of the scene, with the last line ready to be typed into; what a key typed goes
  /// into it.
  void open(const QString& title, std::vector<Line> lines,
            std::function<std::optional<Eigen::Vector3d>()> beside, const QKeyEvent* typed);
  /// What is typed and not taken is dropped.
  void close();

 private:
  void place();
  void follow(const Change& change);
  void watchFocus(const QWidget* now);

  Workbench& bench_;
  view::SceneView* view_;
  std::vector<Line> lines_;
  std::vector<NumberField*> fields_;
  std::function<std::optional<Eigen::Vector3d>()> beside_;
};

}  // namespace bw::app
