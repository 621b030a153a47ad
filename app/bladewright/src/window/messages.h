// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// All findings, errors first; a click selects and frames the place.
class MessageList : public QListWidget {
  Q_OBJECT

 public:
  MessageList(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

 signals:
  /// How many errors and warnings stand in the list.
  void counted(int errors, int warnings);

 private:
  void refresh();

  Workbench& bench_;
  const Theme& theme_;
  Issues shown_;
};

/// A calm line that floats over the picture and moves nothing: icon, text, at most one button, and a cross.
class Banner : public QFrame {
  Q_OBJECT

 public:
  explicit Banner(const Theme& theme, QWidget* parent = nullptr);
  void tell(const Notice& notice);
  /// Stands at `corner` and takes as much of `width` as its words need.
  void place(const QPoint& corner, int width);
  /// Takes the notice away, unless it tells of something that is done (information).
  void outdate();
  QString text() const { return label_->text(); }
  QPushButton* action() { return action_; }

 signals:
  /// Another text stands: the line may need another place.
  void told();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void refresh();

  const Theme& theme_;
  Notice notice_;
  QLabel *icon_, *label_;
  QPushButton* action_;
  QToolButton* close_;
  QTimer timer_;
};

/// The colour and icon of a severity.
QColor severityColour(Severity severity, const Colours& colours);
QString severityIcon(Severity severity);

}  // namespace bw::app
