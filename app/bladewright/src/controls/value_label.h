// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <QLabel>

namespace bw::app {

/// A number that is read: red with an icon where it breaks a limit, pale where it is out of date.
class ValueLabel : public QLabel {
  Q_OBJECT
  Q_PROPERTY(QColor errorColour MEMBER errorColour_)

 public:
  explicit ValueLabel(QWidget* parent = nullptr);

  /// How the number stands.
  void setStanding(bool broken, bool stale);
  bool broken() const { return broken_; }
  bool stale() const { return stale_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QColor errorColour_;
  bool broken_ = false, stale_ = false;
};

}  // namespace bw::app
