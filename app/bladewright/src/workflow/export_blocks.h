// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QWidget>

#include <string>
#include <vector>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// How a block stands for its export: an icon and a word, what the tip tells, and how long it is cut.
struct BlockStanding {
  const char* icon = "idle";
  QColor Colours::*colour = &Colours::secondary;
  QString word, tip, time;
  bool operator==(const BlockStanding&) const = default;
};
BlockStanding standingOf(const Workbench& bench, const std::string& block);
/// The same of each block of the design, in their order.
std::vector<BlockStanding> standingsOf(const Workbench& bench);

/// The blocks of the design, a line each: whether its programs, drawings and parts are written, how it
/// stands, and its cutting time.
class ExportBlocks : public QWidget {
  Q_OBJECT

 public:
  ExportBlocks(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);
  void refresh();

 private:
  struct Line {
    std::string block;
    QCheckBox* wanted;
    QLabel *icon, *word, *time;
    BlockStanding shown;
  };
  void rebuild();
  void paint(Line& line);

  Workbench& bench_;
  const Theme& theme_;
  QGridLayout* grid_;
  std::vector<std::string> built_;  ///< what the lines are for
  std::vector<Line> lines_;
};

}  // namespace bw::app
