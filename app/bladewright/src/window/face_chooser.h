// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>

#include <vector>

#include "bw/scene/scene.h"
#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Choosing the faces of the file in the picture: the line that tells how, the words beside the mouse, and
/// the edits of the design. Both widgets float over the picture.
class FaceChooser : public QFrame {
  Q_OBJECT

 public:
  /// `picture` is what they float over.
  FaceChooser(Workbench& bench, const Theme& theme, QWidget* picture);

  bool choosing() const { return choosing_; }
  /// Does nothing where there is nothing to choose among.
  void setChoosing(bool on);
  /// Whether the file has several faces that can be shown.
  bool possible() const;
  /// Adds to a style what faces are chosen, and the one under the mouse.
  void applyTo(scene::Style& style) const;
  /// The words beside the mouse, empty if it is over no face.
  QString hint() const { return hint_->isVisible() ? hint_->text() : QString(); }
  QPushButton* done() { return done_; }

  /// The mouse is over `face` (−1: none), which appears at `place` of the picture.
  void hover(int face, const QPointF& place);
  /// Chooses that face alone, or, with Ctrl, adds it to the others or takes it from them.
  void click(int face, Qt::KeyboardModifiers keys);

 signals:
  /// What applyTo() adds is another.
  void changed();
  void choosingChanged(bool choosing);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::vector<int> chosen() const;
  QString wordsFor(int face) const;
  void refresh();
  void place();

  Workbench& bench_;
  const Theme& theme_;
  QWidget* picture_;
  QLabel *text_, *hint_;
  QPushButton* done_;
  bool choosing_ = false;
  int hovered_ = -1;
};

}  // namespace bw::app
