// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <QWidget>

#include <vector>

#include "controls/fields.h"

namespace bw::app {

/// The summary of the result in one line: a few numbers, of which each may break its limit. Where the line is
/// too narrow for all, the least important go; none is cut.
class SummaryLine : public QWidget {
  Q_OBJECT

 public:
  struct Part {
    QString text;
    int weight = 0;  ///< the smallest go first
    bool broken = false;
  };

  explicit SummaryLine(QWidget* parent = nullptr);

  void setParts(const std::vector<Part>& parts, bool stale);
  /// One label a part, in their order.
  const std::vector<ValueLabel*>& labels() const { return labels_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();

  std::vector<Part> parts_;
  std::vector<ValueLabel*> labels_;
};

}  // namespace bw::app
