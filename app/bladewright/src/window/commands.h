// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAction>
#include <QDialog>
#include <QKeyEvent>
#include <QKeySequence>
#include <QLineEdit>
#include <QListWidget>
#include <QObject>
#include <QTabWidget>
#include <QTextBrowser>

#include <functional>
#include <vector>

#include "controls/theme.h"

namespace bw::app {

/// What a command is made of.
struct CommandInfo {
  QString id;    ///< stable word, for instance "file.open"
  QString text;  ///< for the menu, with the mnemonic
  QString icon;  ///< may be empty
  QString tip;
  QList<QKeySequence> shortcuts;
  bool checkable = false;
};

/// The name of a command without the mark of its mnemonic.
QString commandText(const QAction& action);

/// Every command of the window, once: menus, tool buttons, shortcuts and the palette all take it from here.
class Commands : public QObject {
  Q_OBJECT

 public:
  Commands(const Theme& theme, QWidget* window);

  /// Adds a command; `run` gets the checked state.
  QAction* add(const CommandInfo& info, std::function<void(bool)> run);
  /// The command of that id; it must exist.
  QAction* operator[](const QString& id) const;
  /// Allows a command, or tells why not below what it does: `why` is empty where it is allowed.
  void allow(const QString& id, const QString& why) const;
  /// Runs the command of a key without modifiers that no widget wanted for itself: letters and Space belong
  /// to a focused field or button first. False if there is none.
  bool pressKey(const QKeyEvent* event);
  const std::vector<QAction*>& all() const { return actions_; }
  const Theme& theme() const { return theme_; }

 private:
  void refreshIcons();
  void setIcon(QAction& action) const;

  const Theme& theme_;
  QWidget* window_;
  std::vector<QAction*> actions_;
};

/// Finds a command by typing a part of its name.
class CommandPalette : public QDialog {
  Q_OBJECT

 public:
  CommandPalette(const Commands& commands, QWidget* parent);
  void open() override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void filter(const QString& text);
  void run();

  const Commands& commands_;
  QLineEdit* line_;
  QListWidget* list_;
};

/// The guide to the window and the list of its keys, beside the work: both come with the program.
class GuideWindow : public QDialog {
  Q_OBJECT

 public:
  GuideWindow(const Commands& commands, QWidget* parent);

  /// The guide; the keys beside it are those of the commands now.
  void open() override;
  const QTextBrowser& guide() const { return *guide_; }
  const QTextBrowser& keys() const { return *keys_; }

 private:
  QString keysText() const;

  const Commands& commands_;
  QTabWidget* tabs_;
  QTextBrowser *guide_, *keys_;
};

}  // namespace bw::app
