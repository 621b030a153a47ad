// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>

#include <optional>
#include <string>
#include <vector>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// A calm line that floats over the picture and moves nothing: icon, text, at most one button, and a cross.
/// Notices stand behind each other, the newest in front, until they are answered (by their button or the
/// cross) or no longer hold (`outdate`).
class Banner : public QFrame {
  Q_OBJECT

 public:
  explicit Banner(const Theme& theme, QWidget* parent = nullptr);
  /// Puts a notice in front; it takes the place of an earlier one of its topic, or with its text.
  void tell(const Notice& notice);
  /// Takes the notices of a topic away.
  void outdate(Topic topic);
  /// Stands at `corner` and takes as much of `width` as its words need.
  void place(const QPoint& corner, int width);
  /// Out of sight while another page is shown; the next notice, or `resume`, brings it back.
  void pause() { hide(); }
  void resume();
  QString text() const { return label_->text(); }
  QPushButton* action() { return action_; }
  QToolButton* cross() { return close_; }
  /// All that stand, the one in front last.
  const std::vector<Notice>& notices() const { return standing_; }

 signals:
  /// Another text stands: the line may need another place.
  void told();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void showFront();
  void refresh();
  /// Takes the front notice away and shows the next.
  Notice answer();

  const Theme& theme_;
  std::vector<Notice> standing_;
  QLabel *icon_, *label_, *more_;
  QPushButton* action_;
  QToolButton* close_;
};

/// All messages, errors first; a click selects and frames the place.
class MessageList : public QListWidget {
  Q_OBJECT

 public:
  MessageList(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

 signals:
  /// How many errors and warnings stand in the list.
  void counted(int errors, int warnings);
  /// That message was chosen; an empty one where none is any more.
  void chosen(const bw::app::Message& message);

 private:
  void refresh();

  Workbench& bench_;
  const Theme& theme_;
  std::vector<Message> shown_;
  /// The message that was chosen last, and the cut it is about.
  struct Looked {
    QString text;
    std::string cut;
  };
  std::optional<Looked> looked_;
};

/// The messages, and below them a button for each thing that would mend the chosen one.
class MessagePanel : public QWidget {
  Q_OBJECT

 public:
  MessagePanel(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  MessageList& list() { return *list_; }

 private:
  void offer(const Message& message);

  Workbench& bench_;
  MessageList* list_;
  QWidget* row_;
};

}  // namespace bw::app
