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
/// and its stations. A click selects, and chooses a curve; the eye shows and hides (also V), the lock keeps
/// from changes (also L), F2 or a double click gives another name.
class ObjectTree : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { name, seen, kept };
  /// What a curve was called, empty if nothing, and what it is called after its place.
  struct CurveName {
    QString own, place;
  };

  ObjectTree(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// The line of an object, of its first cut where several are of one surface; null if there is none.
  QTreeWidgetItem* lineOf(const Object& object) const;
  /// Marks the curve of the surface at work that is chosen, counted from 0, where curves are listed, else its
  /// surface, until something else is selected.
  void showCurve(const std::optional<int>& curve);
  QSize sizeHint() const override { return {250, 180}; }
  QSize minimumSizeHint() const override { return {160, 72}; }

 signals:
  /// A line of the surface that is at work since then: of one of its curves, counted from 0, or its own.
  void curveChosen(const std::optional<int>& curve);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  /// What a line stands for, besides its object.
  struct Line {
    std::optional<Object> object;  ///< empty for a single station
    std::string block, cut;
    int station = -1, curve = -1;
  };
  void follow(const Change& change);
  void rebuild();
  QTreeWidgetItem* addLine(QTreeWidgetItem* parent, const QString& text, const char* icon, const Line& line);
  void fillCurves(QTreeWidgetItem& surface);
  void fillStations(QTreeWidgetItem& stations);
  void refreshStations();
  /// The eyes and locks of a line and of those below it.
  void paint(QTreeWidgetItem& item);
  void paintAll();
  const Line& lineOf(const QTreeWidgetItem& item) const;
  void select(const QTreeWidgetItem& item);
  void toggle(const QTreeWidgetItem& item, int column);
  /// Opens the field of a name, or tells why there is none.
  void beginRenaming(QTreeWidgetItem& item);
  void rename(const QTreeWidgetItem& item);
  /// Of the line of a curve; nothing for other lines.
  std::optional<CurveName> nameOfCurve(const QTreeWidgetItem& item) const;
  /// Marks the line of what is selected.
  void markSelected();

  Workbench& bench_;
  const Theme& theme_;
  std::vector<Line> lines_;
  std::string built_;         ///< what the lines are for
  std::optional<int> curve_;  ///< of the surface at work, that is marked
  bool busy_ = false;         ///< lines are changed by the program
};

}  // namespace bw::app
