// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>

#include <string>
#include <vector>

#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// One example: picture and title.
class ExampleCard : public QAbstractButton {
  Q_OBJECT

 public:
  ExampleCard(const Theme& theme, const QString& name, const QString& title, QWidget* parent = nullptr);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  const Theme& theme_;
  QPixmap picture_, darkPicture_;
};

/// What the window begins with: open a surface or a design, an example, or a recent file.
class StartPage : public QScrollArea {
  Q_OBJECT

 public:
  StartPage(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);
  const std::vector<ExampleCard*>& cards() const { return cards_; }

 signals:
  void openSurfaceRequested();
  void openDesignRequested();
  void measureRequested();
  void openRequested(const QString& file);
  void exampleRequested(const QString& name);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refreshRecent();
  void arrange();

  Workbench& bench_;
  const Theme& theme_;
  QWidget* page_;
  QWidget* shelf_;
  std::vector<ExampleCard*> cards_;
  int columns_ = 0;
  QLabel* recentTitle_;
  QVBoxLayout* recent_;
};

}  // namespace bw::app
