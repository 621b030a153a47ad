// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QVBoxLayout>
#include <QWidget>

#include "bw/model/step_state.h"
#include "controls/theme.h"

namespace bw::app {

/// The head of a step: chevron, icon, title, and the state as icon and words; a thin bar while it runs.
class StepHead : public QAbstractButton {
  Q_OBJECT

 public:
  StepHead(const Theme& theme, const QString& icon, const QString& title, QWidget* parent = nullptr);
  void setState(const model::StepState& state);
  const model::StepState& state() const { return state_; }
  QSize sizeHint() const override;
  /// The room that its words and icons need, in pixels.
  int textWidth() const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  const Theme& theme_;
  QString icon_;
  model::StepState state_;
};

/// A step of the work that folds: its head, and its controls below.
class StepSection : public QWidget {
  Q_OBJECT

 public:
  StepSection(const Theme& theme, const QString& icon, const QString& title, QWidget* body,
              QWidget* parent = nullptr);
  StepHead& head() { return *head_; }

 private:
  StepHead* head_;
};

}  // namespace bw::app
