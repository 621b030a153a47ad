// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QFrame>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>

#include <filesystem>
#include <string>
#include <vector>

#include "bw/model/recovery.h"
#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Unsaved designs that a crash, a kill or the end of a session left behind: picture, name, place, date and
/// size of each, newest first, with a button to go on and one to discard. Hidden while there are none.
class RecoveryList : public QFrame {
  Q_OBJECT

 public:
  RecoveryList(const Theme& theme, const std::filesystem::path& folder, QWidget* parent = nullptr);
  /// Looks into the folder again.
  void refresh();
  const std::vector<model::RecoveryCopy>& copies() const { return copies_; }

 signals:
  void openRequested(const QString& copy);
  void discardRequested(const QString& copy, const QString& name);
  /// It has other rows.
  void refreshed();

 private:
  QWidget* makeRow(const model::RecoveryCopy& copy);

  const Theme& theme_;
  std::filesystem::path folder_;
  std::vector<model::RecoveryCopy> copies_;
  QVBoxLayout* rows_;
};

class RecoveryList;

/// One example: picture and title.
class ExampleCard : public QAbstractButton {
  Q_OBJECT

 public:
  ExampleCard(const Theme& theme, const QString& name, const QString& title, QWidget* parent = nullptr);
  QSize sizeHint() const override;
  /// In both themes.
  bool hasPicture() const { return !picture_.isNull() && !darkPicture_.isNull(); }

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  const Theme& theme_;
  QPixmap picture_, darkPicture_;
};

/// What the window begins with: open a surface or a design, an example, or a recent file. Tab and the arrow
/// keys go through it, Enter opens.
class StartPage : public QScrollArea {
  Q_OBJECT

 public:
  StartPage(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);
  const std::vector<ExampleCard*>& cards() const { return cards_; }
  /// Puts the unsaved work above the recent files.
  void putAbove(RecoveryList* list);

 signals:
  void openSurfaceRequested();
  void openDesignRequested();
  void newBlockRequested();
  void newWallRequested();
  void measureRequested();
  void openRequested(const QString& file);
  void exampleRequested(const QString& name);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refreshRecent();
  void arrange();
  /// To the nearest target in a direction of the page.
  void moveKeyboard(const QAbstractButton& from, const QPoint& direction);

  Workbench& bench_;
  const Theme& theme_;
  QWidget* page_;
  QWidget* shelf_;
  QVBoxLayout* above_;
  QAbstractButton* surface_;
  std::vector<ExampleCard*> cards_;
  int columns_ = 0;
  QLabel* recentTitle_;
  QVBoxLayout* recent_;
};

}  // namespace bw::app
