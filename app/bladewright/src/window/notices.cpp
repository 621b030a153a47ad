// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/notices.h"

#include <QHBoxLayout>
#include <QPainter>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QTextLayout>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "bw/core/text/printable.h"
#include "controls/fields.h"

namespace bw::app {

namespace {

constexpr int kBorder = 3;
constexpr int kWidest = 760;
constexpr int kLeastHeight = 22, kMargin = 8;

}  // namespace

Banner::Banner(const Theme& theme, QWidget* parent)
    : QFrame(parent),
      theme_(theme),
      icon_(new QLabel(this)),
      label_(new QLabel(this)),
      more_(new QLabel(this)),
      action_(new QPushButton(this)),
      close_(new QToolButton(this)) {
  auto* layout = makeBox<QHBoxLayout>(this, {kGroupGap, kMargin, kGap, kMargin}, kGap);
  icon_->setFixedSize(20, 20);
  layout->addWidget(icon_, 0, Qt::AlignTop);
  label_->setWordWrap(true);
  label_->setTextFormat(Qt::PlainText);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  layout->addWidget(label_, 1);
  layout->addWidget(action_, 0, Qt::AlignTop);
  more_->setObjectName("secondary");
  more_->setToolTip(tr("More lines stand behind this one: close it to read the next"));
  layout->addWidget(more_, 0, Qt::AlignTop);
  close_->setToolTip(tr("Close this line"));
  close_->setAccessibleName(tr("Close this line"));
  layout->addWidget(close_, 0, Qt::AlignTop);
  connect(close_, &QToolButton::clicked, this, &Banner::answer);
  connect(action_, &QPushButton::clicked, this, [this] {
    if (const auto run = answer().run) run();
  });
  connect(&theme, &Theme::changed, this, &Banner::refresh);
  hide();
}

void Banner::tell(const Notice& notice) {
  std::erase_if(standing_, [&](const Notice& n) { return n.text == notice.text || n.topic == notice.topic; });
  standing_.push_back(notice);
  showFront();
}

void Banner::outdate(Topic topic) {
  if (std::erase_if(standing_, [&](const Notice& n) { return n.topic == topic; }) == 0) return;
  if (isVisible() || standing_.empty()) showFront();
}

void Banner::resume() {
  if (!standing_.empty()) showFront();
}

Notice Banner::answer() {
  if (standing_.empty()) return {};
  Notice answered = std::move(standing_.back());
  standing_.pop_back();
  showFront();
  return answered;
}

void Banner::showFront() {
  if (standing_.empty()) return hide();
  const Notice& notice = standing_.back();
  // Names of files and entities come from outside.
  label_->setText(QString::fromStdString(printable(notice.text.toStdString())));
  action_->setText(notice.action);
  action_->setVisible(!notice.action.isEmpty());
  more_->setText(tr("1 of %1").arg(standing_.size()));
  more_->setVisible(standing_.size() > 1);
  refresh();
  show();
  raise();
  emit told();
}

void Banner::place(const QPoint& corner, int width) {
  const auto taken = [](const QWidget* widget) {
    return widget->isHidden() ? 0 : widget->sizeHint().width() + kGap;
  };
  const int others = kGroupGap + 20 + kGap + taken(action_) + taken(more_) + taken(close_) + kGap;
  const int wanted = label_->fontMetrics().horizontalAdvance(label_->text()) + others + 4;
  const int given = std::min({wanted, width, kWidest});
  const int lines = label_->heightForWidth(given - others);
  setGeometry(
      corner.x(), corner.y(), given,
      std::max({lines, action_->isHidden() ? 0 : action_->sizeHint().height(), kLeastHeight}) + 2 * kMargin);
}

void Banner::refresh() {
  const Severity severity = standing_.empty() ? Severity::info : standing_.back().severity;
  icon_->setPixmap(theme_.pixmap(severityIcon(severity), severityColour(severity, theme_.colours())));
  close_->setIcon(QIcon(theme_.pixmap("close", theme_.colours().secondary)));
  close_->setIconSize({14, 14});
  update();
}

void Banner::paintEvent(QPaintEvent*) {
  if (standing_.empty()) return;
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.fillRect(rect(), c.panel);
  const QColor colour = severityColour(standing_.back().severity, c);
  QColor tint = colour;
  tint.setAlphaF(0.07f);
  painter.fillRect(rect(), tint);
  painter.setPen(c.line);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
  painter.fillRect(QRect(0, 0, kBorder, height()), colour);
}

namespace {

/// As wide as the list, and as high as the text is in the width that the style leaves it there: the view
/// measures it wider than it draws it.
class WrappedText : public QStyledItemDelegate {
 public:
  explicit WrappedText(QListView* view) : QStyledItemDelegate(view), view_(view) {}
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    constexpr int kHigh = 4096;
    QStyleOptionViewItem own = option;
    initStyleOption(&own, index);
    own.rect = {0, 0, view_->viewport()->width(), kHigh};
    const QStyle& style = *view_->style();
    const QRect room = style.subElementRect(QStyle::SE_ItemViewItemText, &own, view_);
    const int margin = style.pixelMetric(QStyle::PM_FocusFrameHMargin, &own, view_) + 1;
    QTextOption wrapped;
    wrapped.setWrapMode(QTextOption::WordWrap);
    QTextLayout text(own.text, own.font);
    text.setTextOption(wrapped);
    text.beginLayout();
    double height = 0;
    for (QTextLine line = text.createLine(); line.isValid(); line = text.createLine()) {
      line.setLineWidth(std::max(1, room.width() - 2 * margin));
      height += line.height();
    }
    text.endLayout();
    const int content = std::max(int(std::ceil(height)) + 2 * margin, view_->iconSize().height());
    return {own.rect.width(), content + kHigh - room.height()};
  }

 private:
  QListView* view_;
};

}  // namespace

MessageList::MessageList(Workbench& bench, const Theme& theme, QWidget* parent)
    : QListWidget(parent), bench_(bench), theme_(theme) {
  setWordWrap(true);
  setItemDelegate(new WrappedText(this));
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
    looked_ = Looked{message.text, bench_.selection().cut};
    emit chosen(message);
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
  // What is known a moment later does not take the one that is looked at out of the hand.
  const std::optional<Looked> looked = std::exchange(looked_, std::nullopt);
  std::optional<Message> still;
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
    if (still || !looked || message.text != looked->text || bench_.selection().cut != looked->cut) continue;
    setCurrentItem(item);
    looked_ = looked;
    still = message;
  }
  if (shown_.empty()) {
    auto* item = new QListWidgetItem(
        bench_.sweep() ? tr("Nothing to tell: all checks hold.") : tr("No messages."), this);
    item->setData(Qt::UserRole, -1);
    item->setFlags(Qt::NoItemFlags);
    item->setForeground(theme_.colours().secondary);
  }
  emit counted(errors, warnings);
  emit chosen(still.value_or(Message()));
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

void MessagePanel::offer(const Message& message) {
  auto* row = static_cast<QHBoxLayout*>(row_->layout());
  while (row->count() > 1) {
    const std::unique_ptr<QLayoutItem> item(row->takeAt(0));
    item->widget()->hide();
    item->widget()->deleteLater();
  }
  for (const Offer& offered : bench_.offersOf(message)) {
    auto* button = new QPushButton(offered.text, row_);
    connect(button, &QPushButton::clicked, this,
            [this, offered] { bench_.editDesign(offered.text, offered.change); });
    row->insertWidget(row->count() - 1, button);
    button->show();
  }
  row_->setVisible(row->count() > 1);
}

}  // namespace bw::app
