// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QLayout>
#include <QScrollArea>

#include <memory>
#include <vector>

namespace bw::app {

/// Groups of controls in a row, in several rows where one is too narrow for them. The last group stands at
/// the right edge of its row.
class FlowLayout : public QLayout {
 public:
  explicit FlowLayout(QWidget* parent);

  void addItem(QLayoutItem* item) override;
  int count() const override { return int(items_.size()); }
  QLayoutItem* itemAt(int index) const override;
  QLayoutItem* takeAt(int index) override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return arrange(width, nullptr); }
  QSize sizeHint() const override;
  QSize minimumSize() const override;
  void setGeometry(const QRect& area) override;

 private:
  /// The height of the rows in `width`; puts the items in their places within `area`, if there is one.
  int arrange(int width, const QRect* area) const;

  std::vector<std::unique_ptr<QLayoutItem>> items_;
};

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

/// Before a window draws itself because the display uncovers it, its texts are laid out: none is seen in the
/// place of the one before it.
class LaidOutFirst : public QObject {
 public:
  explicit LaidOutFirst(QWidget* window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace bw::app
