// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/messages.h"

#include <algorithm>

#include "bw/core/printable.h"

namespace bw::app {

QColor severityColour(Severity severity, const Colours& colours) {
  return severity == Severity::error     ? colours.error
         : severity == Severity::warning ? colours.warning
                                         : colours.selection;
}

QString severityIcon(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

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
    if (i >= 0 && std::size_t(i) < shown_.size()) bench_.showPlace(shown_[std::size_t(i)]);
  };
  connect(this, &QListWidget::itemClicked, this, show);
  connect(this, &QListWidget::itemActivated, this, show);
  connect(&bench, &Workbench::resultChanged, this, &MessageList::refresh);
  connect(&bench, &Workbench::messagesChanged, this, &MessageList::refresh);
  connect(&theme, &Theme::changed, this, &MessageList::refresh);
  refresh();
}

void MessageList::refresh() {
  shown_ = bench_.messages();
  std::stable_sort(shown_.begin(), shown_.end(),
                   [](const Issue& a, const Issue& b) { return int(a.severity) > int(b.severity); });
  clear();
  int errors = 0, warnings = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Issue& issue = shown_[i];
    errors += issue.severity == Severity::error;
    warnings += issue.severity == Severity::warning;
    QString text = QString::fromStdString(printable(issue.message));
    if (!issue.where.text.empty() && issue.message.find(issue.where.text) == std::string::npos)
      text = QString::fromStdString(issue.where.text) + ": " + text;
    if (!text.isEmpty()) text[0] = text[0].toUpper();
    auto* item = new QListWidgetItem(text, this);
    item->setIcon(QIcon(
        theme_.pixmap(severityIcon(issue.severity), severityColour(issue.severity, theme_.colours()), 16)));
    item->setData(Qt::UserRole, int(i));
    item->setToolTip(tr("Click to see the place"));
    item->setData(Qt::AccessibleTextRole, QString(severityName(issue.severity)) + ": " + text);
  }
  if (shown_.empty()) {
    auto* item = new QListWidgetItem(
        bench_.sweep() ? tr("Nothing to tell: all checks hold.") : tr("No messages."), this);
    item->setData(Qt::UserRole, -1);
    item->setFlags(Qt::NoItemFlags);
    item->setForeground(theme_.colours().secondary);
  }
  emit counted(errors, warnings);
}

}  // namespace bw::app
