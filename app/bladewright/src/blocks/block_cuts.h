// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QWidget>

#include <functional>
#include <string>
#include <vector>

#include "controls/fields.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The cuts of the block selected, a line each: its place in the order, the face of the block that lies on
/// top, the turn about the vertical, the side that stays, how far the foam stands back from the surface,
/// which only one that is alone in its block may, and, where one has it, the length of its own blade. Its
/// name makes it the cut at work.
class BlockCuts : public QWidget {
  Q_OBJECT

 public:
  explicit BlockCuts(Workbench& bench, QWidget* parent = nullptr);
  void refresh();
  /// Whether the name of a cut stands above its line, which then takes less width.
  void setNarrow(bool narrow);
  /// px that a line takes where names stand beside.
  int wideWidth() const;

 private:
  struct Line {
    std::string cut;
    QToolButton* name;
    ChoiceField *order, *up, *turn, *keep;
    NumberField *offset, *length;
  };
  void rebuild(const std::vector<std::string>& cuts);
  ChoiceField* addChoice(const char* name, const QString& title, const QStringList& items,
                         const std::string& cut, const QString& step,
                         const std::function<void(Cut&, int)>& change);
  NumberField* addOffset(const std::string& cut);
  NumberField* addLength(const std::string& cut);
  /// Puts all in their places.
  void arrange();
  void edit(const std::string& cut, const QString& step, const std::function<void(Cut&)>& change);

  Workbench& bench_;
  QGridLayout* grid_;
  std::vector<QLabel*> heads_;
  std::vector<Line> lines_;
  bool narrow_ = false;
};

}  // namespace bw::app
