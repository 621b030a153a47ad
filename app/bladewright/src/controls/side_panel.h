// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QScrollArea>

namespace bw::app {

/// A column beside the picture: scrolls up and down, and is always as wide as what it holds needs.
class SidePanel : public QScrollArea {
  Q_OBJECT

 public:
  explicit SidePanel(int leastWidth, QWidget* parent = nullptr);
  QSize minimumSizeHint() const override;
  QSize sizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  int leastWidth_;
};

}  // namespace bw::app
