// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/messages.h"

#include <QHBoxLayout>
#include <QPainter>

#include <algorithm>

namespace bw::app {

namespace {

constexpr int kInformationTime = 8000;  // ms that information stays
constexpr int kErrorBorder = 3;

}  // namespace

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
    QString text = QString::fromStdString(issue.message);
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

Banner::Banner(const Theme& theme, QWidget* parent)
    : QFrame(parent),
      theme_(theme),
      icon_(new QLabel(this)),
      label_(new QLabel(this)),
      action_(new QPushButton(this)),
      close_(new QToolButton(this)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(kGroupGap, 8, kGap, 8);
  layout->setSpacing(kGap);
  icon_->setFixedSize(20, 20);
  layout->addWidget(icon_, 0, Qt::AlignTop);
  label_->setWordWrap(true);
  label_->setTextFormat(Qt::PlainText);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  layout->addWidget(label_, 1);
  layout->addWidget(action_, 0, Qt::AlignTop);
  close_->setToolTip(tr("Close this line"));
  close_->setAccessibleName(tr("Close this line"));
  layout->addWidget(close_, 0, Qt::AlignTop);
  timer_.setSingleShot(true);
  timer_.setInterval(kInformationTime);
  connect(&timer_, &QTimer::timeout, this, &QWidget::hide);
  connect(close_, &QToolButton::clicked, this, &QWidget::hide);
  connect(action_, &QPushButton::clicked, this, [this] {
    const auto run = notice_.run;
    hide();
    if (run) run();
  });
  connect(&theme, &Theme::changed, this, &Banner::refresh);
  refresh();
  hide();
}

void Banner::tell(const Notice& notice) {
  notice_ = notice;
  QString text = notice.text;
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  label_->setText(text);
  action_->setText(notice.action);
  action_->setVisible(!notice.action.isEmpty());
  refresh();
  show();
  raise();
  emit told();
  timer_.stop();
  if (notice.severity == Severity::info && notice.action.isEmpty()) timer_.start();
}

void Banner::place(const QPoint& corner, int width) {
  constexpr int kWidest = 760;
  const int others = kGroupGap + 20 + kGap + (action_->isHidden() ? 0 : action_->sizeHint().width() + kGap) +
                     close_->sizeHint().width() + 2 * kGap;
  const int wanted = label_->fontMetrics().horizontalAdvance(label_->text()) + others + 4;
  const int taken = std::min({wanted, width, kWidest});
  const int lines = label_->heightForWidth(taken - others);
  setGeometry(corner.x(), corner.y(), taken,
              std::max({lines, action_->isHidden() ? 0 : action_->sizeHint().height(), 22}) + 16);
}

void Banner::outdate() {
  if (notice_.severity != Severity::info || !notice_.action.isEmpty()) hide();
}

void Banner::refresh() {
  icon_->setPixmap(
      theme_.pixmap(severityIcon(notice_.severity), severityColour(notice_.severity, theme_.colours())));
  close_->setIcon(QIcon(theme_.pixmap("close", theme_.colours().secondary)));
  close_->setIconSize({14, 14});
  update();
}

void Banner::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.fillRect(rect(), c.panel);
  const QColor colour = severityColour(notice_.severity, c);
  QColor tint = colour;
  tint.setAlphaF(0.07f);
  painter.fillRect(rect(), tint);
  painter.setPen(c.line);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
  painter.fillRect(QRect(0, 0, kErrorBorder, height()), colour);
}

}  // namespace bw::app
