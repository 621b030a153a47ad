// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QTreeWidget>

#include <optional>
#include <string>
#include <vector>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// All that a design is made of: blocks, of each its cuts, of each its surface with the curves that tell it,
/// and its stations. A click selects; the eye shows and hides (also V), the lock keeps from changes (also L),
/// F2 or a double click gives another name.
class ObjectTree : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { name, seen, kept };

  ObjectTree(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// The line of an object, of its first cut where several are of one surface; null if there is none.
  QTreeWidgetItem* lineOf(const Object& object) const;
  QSize sizeHint() const override { return {250, 180}; }
  QSize minimumSizeHint() const override { return {160, 72}; }

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  /// What a line stands for, besides its object.
  struct Line {
    std::optional<Object> object;  ///< empty for a curve or a single station
    std::string block, cut;
    int station = -1;
  };
  void follow(const Change& change);
  void rebuild();
  QTreeWidgetItem* addLine(QTreeWidgetItem* parent, const QString& text, const char* icon, const Line& line);
  void addCurves(QTreeWidgetItem* surface, const Line& line);
  void fillStations(QTreeWidgetItem& stations);
  void refreshStations();
  /// The eyes and locks of a line and of those below it.
  void paint(QTreeWidgetItem& item);
  void paintAll();
  const Line& lineOf(const QTreeWidgetItem& item) const;
  void select(const QTreeWidgetItem& item);
  void toggle(const QTreeWidgetItem& item, int column);
  void rename(const QTreeWidgetItem& item);
  /// Marks the line of what is selected.
  void markSelected();

  Workbench& bench_;
  const Theme& theme_;
  std::vector<Line> lines_;
  std::string built_;  ///< what the lines are for
  bool busy_ = false;  ///< lines are changed by the program
};

}  // namespace bw::app
