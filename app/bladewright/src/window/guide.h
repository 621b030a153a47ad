// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QTabWidget>
#include <QTextBrowser>

#include "window/commands.h"

namespace bw::app {

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
