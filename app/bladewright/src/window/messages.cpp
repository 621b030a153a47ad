// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/messages.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <functional>

#include "bw/words/findings.h"
#include "controls/fields.h"
#include "controls/severity.h"

namespace bw::app {

MessageList::MessageList(Workbench& bench, const Theme& theme, QWidget* parent)
    : QListWidget(parent), bench_(bench), theme_(theme) {
  setWordWrap(true);
  setIconSize({16, 16});
  setUniformItemSizes(false);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollMode(ScrollPerPixel);
  setResizeMode(Adjust);
  setAccessibleName(tr("Messages"));
  const auto show = [this](QListWidgetItem* item) {
    const int i = item->data(Qt::UserRole).toInt();
    if (i < 0 || std::size_t(i) >= shown_.size()) return;
    const Message message = shown_[std::size_t(i)];
    bench_.showPlace(message);
    emit chosen(message.remedies);
  };
  connect(this, &QListWidget::itemClicked, this, show);
  connect(this, &QListWidget::itemActivated, this, show);
  connect(&bench, &Workbench::changed, this, [this](const Change& change) {
    if (change.any(Aspect::messages)) refresh();
  });
  connect(&theme, &Theme::changed, this, &MessageList::refresh);
  refresh();
}

void MessageList::refresh() {
  shown_ = bench_.messages();
  std::ranges::stable_sort(shown_, std::ranges::greater(), &Message::severity);
  clear();
  int errors = 0, warnings = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Message& message = shown_[i];
    errors += message.severity == Severity::error;
    warnings += message.severity == Severity::warning;
    auto* item = new QListWidgetItem(message.text, this);
    item->setIcon(QIcon(theme_.pixmap(severityIcon(message.severity),
                                      severityColour(message.severity, theme_.colours()), 16)));
    item->setData(Qt::UserRole, int(i));
    item->setToolTip(tr("Click to see the place"));
    item->setData(Qt::AccessibleTextRole, QString(severityName(message.severity)) + ": " + message.text);
  }
  if (shown_.empty()) {
    auto* item = new QListWidgetItem(
        bench_.sweep() ? tr("Nothing to tell: all checks hold.") : tr("No messages."), this);
    item->setData(Qt::UserRole, -1);
    item->setFlags(Qt::NoItemFlags);
    item->setForeground(theme_.colours().secondary);
  }
  emit counted(errors, warnings);
  emit chosen({});
}

MessagePanel::MessagePanel(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench) {
  auto* column = makeBox<QVBoxLayout>(this, {}, 0);
  list_ = new MessageList(bench, theme, this);
  column->addWidget(list_, 1);
  row_ = new QWidget(this);
  auto* row = makeBox<QHBoxLayout>(row_, {kGap, kGap / 2, kGap, kGap / 2});
  row->addStretch();
  column->addWidget(row_);
  row_->hide();
  connect(list_, &MessageList::chosen, this, &MessagePanel::offer);
}

void MessagePanel::offer(const Remedies& remedies) {
  auto* row = static_cast<QHBoxLayout*>(row_->layout());
  while (row->count() > 1) {
    const std::unique_ptr<QLayoutItem> item(row->takeAt(0));
    item->widget()->hide();
    item->widget()->deleteLater();
  }
  for (const Remedy& remedy : remedies) {
    if (!bench_.canApply(remedy)) continue;
    auto* button = new QPushButton(QString::fromStdString(words::action(remedy)), row_);
    connect(button, &QPushButton::clicked, this, [this, remedy] { bench_.apply(remedy); });
    row->insertWidget(row->count() - 1, button);
  }
  row_->setVisible(row->count() > 1);
}

}  // namespace bw::app
