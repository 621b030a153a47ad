// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/summary_line.h"

#include <QStringList>

#include <algorithm>
#include <numeric>

#include "controls/theme.h"

namespace bw::app {

SummaryLine::SummaryLine(QWidget* parent) : QWidget(parent) {}

void SummaryLine::setParts(const std::vector<Part>& parts, bool stale) {
  parts_ = parts;
  while (labels_.size() > parts.size()) {
    delete labels_.back();
    labels_.pop_back();
  }
  while (labels_.size() < parts.size()) {
    auto* label = new ValueLabel(this);
    label->setFont(Theme::secondaryFont());
    labels_.push_back(label);
  }
  QStringList texts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    labels_[i]->setText(parts[i].text);
    labels_[i]->setStanding(parts[i].broken, stale);
    texts << parts[i].text;
  }
  setAccessibleDescription(texts.join(QStringLiteral(", ")));
  updateGeometry();
  arrange();
}

QSize SummaryLine::sizeHint() const {
  QSize size(kGap, 0);
  for (const ValueLabel* label : labels_) {
    const QSize part = label->sizeHint();
    size = {size.width() + part.width() + kGroupGap, std::max(size.height(), part.height())};
  }
  return size;
}

QSize SummaryLine::minimumSizeHint() const { return {0, sizeHint().height()}; }

void SummaryLine::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

void SummaryLine::arrange() {
  std::vector<std::size_t> order(parts_.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [this](std::size_t a, std::size_t b) { return parts_[a].weight > parts_[b].weight; });
  std::vector<bool> shown(parts_.size());
  int room = width() - kGap;
  for (std::size_t i : order) {
    room -= labels_[i]->sizeHint().width() + kGroupGap;
    if (room < 0) break;
    shown[i] = true;
  }
  int x = width() - kGap;
  for (std::size_t i = parts_.size(); i-- > 0;) {
    labels_[i]->setVisible(shown[i]);
    if (!shown[i]) continue;
    const int taken = labels_[i]->sizeHint().width();
    x -= taken;
    labels_[i]->setGeometry(x, 0, taken, height());
    x -= kGroupGap;
  }
}

}  // namespace bw::app
