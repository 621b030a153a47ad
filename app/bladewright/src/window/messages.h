// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QListWidget>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// All messages, errors first; a click selects and frames the place.
class MessageList : public QListWidget {
  Q_OBJECT

 public:
  MessageList(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

 signals:
  /// How many errors and warnings stand in the list.
  void counted(int errors, int warnings);
  /// What would mend the message that was chosen.
  void chosen(const bw::Remedies& remedies);

 private:
  void refresh();

  Workbench& bench_;
  const Theme& theme_;
  std::vector<Message> shown_;
};

/// The messages, and below them a button for each thing that would mend the chosen one.
class MessagePanel : public QWidget {
  Q_OBJECT

 public:
  MessagePanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  MessageList& list() { return *list_; }

 private:
  void offer(const Remedies& remedies);

  Workbench& bench_;
  MessageList* list_;
  QWidget* row_;
};

}  // namespace bw::app
