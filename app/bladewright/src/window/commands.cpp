// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/commands.h"

#include <QFile>
#include <QKeyEvent>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>

#include <algorithm>

#include "bw/core/base/result.h"
#include "controls/fields.h"
#include "controls/typed_field.h"

namespace bw::app {

namespace {

/// A letter, a digit, Space, Home or End alone or with Shift.
bool isPlainKey(const QKeySequence& keys) {
  const QKeyCombination first = keys[0];
  const bool modified = first.keyboardModifiers() & ~Qt::KeyboardModifiers(Qt::ShiftModifier);
  const bool plain =
      first.key() <= Qt::Key_AsciiTilde || first.key() == Qt::Key_Home || first.key() == Qt::Key_End;
  return !modified && plain;
}

/// How well `text` fits what was typed: lower is better, −1 = not at all. Words may be typed in part and in
/// any order.
int rank(const QString& text, const QString& typed) {
  int total = 0;
  for (const QString& word : typed.split(' ', Qt::SkipEmptyParts)) {
    const qsizetype at = text.indexOf(word, 0, Qt::CaseInsensitive);
    if (at < 0) return -1;
    const bool wordStart = at == 0 || text[at - 1] == ' ';
    total += int(at) + (wordStart ? 0 : 50);
  }
  return total;
}

constexpr int kRowHeight = 34, kIconSize = 20, kTextLeft = 40;
constexpr int kByTip = 1000;  // a command found by its tooltip only comes after those found by name
constexpr int kKeysRole = Qt::UserRole + 1;

/// A line of the palette: icon, name, and the keys at the right edge.
class PaletteLine : public QStyledItemDelegate {
 public:
  PaletteLine(const Theme& theme, QObject* parent) : QStyledItemDelegate(parent), theme_(theme) {}

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const override {
    return {option.rect.width(), kRowHeight};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyleOptionViewItem bare = option;
    initStyleOption(&bare, index);
    const QIcon icon = bare.icon;
    bare.text.clear();
    bare.icon = {};
    bare.widget->style()->drawControl(QStyle::CE_ItemViewItem, &bare, painter, bare.widget);
    const QRect row = option.rect.adjusted(kGap, 0, -kGap, 0);
    icon.paint(painter, QRect(row.left(), row.center().y() - kIconSize / 2, kIconSize, kIconSize));
    const QString keys = index.data(kKeysRole).toString();
    painter->setFont(Theme::secondaryFont());
    painter->setPen(theme_.colours().secondary);
    painter->drawText(row, Qt::AlignRight | Qt::AlignVCenter, keys);
    const int keysWidth = painter->fontMetrics().horizontalAdvance(keys) + 2 * kGap;
    painter->setFont(Theme::bodyFont());
    painter->setPen(theme_.colours().text);
    const QRect text(row.left() + kTextLeft - kGap, row.top(), row.width() - kTextLeft + kGap - keysWidth,
                     row.height());
    painter->drawText(
        text, Qt::AlignLeft | Qt::AlignVCenter,
        painter->fontMetrics().elidedText(index.data().toString(), Qt::ElideRight, text.width()));
  }

 private:
  const Theme& theme_;
};

constexpr QSize kSize(720, 560);
constexpr char kTip[] = "tip";  // property of a command: what it does, and its key

}  // namespace

QString commandText(const QAction& action) {
  QString text = action.text();
  text.remove('&');
  return text;
}

Commands::Commands(const Theme& theme, QWidget* window) : QObject(window), theme_(theme), window_(window) {
  connect(&theme, &Theme::changed, this, &Commands::refreshIcons);
}

QAction* Commands::add(const CommandInfo& info, std::function<void(bool)> run) {
  auto* action = new QAction(info.text, window_);
  action->setObjectName(info.id);
  action->setProperty("iconName", info.icon);
  action->setCheckable(info.checkable);
  setIcon(*action);
  action->setShortcuts(info.shortcuts);
  // Such a key stands in the menu, but is left to the widgets first: see pressKey.
  if (!info.shortcuts.isEmpty() && isPlainKey(info.shortcuts.first()))
    action->setShortcutContext(Qt::WidgetShortcut);
  QString tip = info.tip.isEmpty() ? commandText(*action) : info.tip;
  if (!info.shortcuts.isEmpty())
    tip += QStringLiteral(" (%1)").arg(info.shortcuts.first().toString(QKeySequence::NativeText));
  action->setToolTip(tip);
  action->setProperty(kTip, tip);
  action->setStatusTip(QString());
  connect(action, &QAction::triggered, this, [this, run = std::move(run)](bool checked) {
    finishTyping(*window_);  // a command works on what is meant
    run(checked);
  });
  window_->addAction(action);
  actions_.push_back(action);
  return action;
}

QAction* Commands::operator[](const QString& id) const {
  for (QAction* action : actions_)
    if (action->objectName() == id) return action;
  BW_CHECK(!"an unknown command was asked for");
  return nullptr;
}

void Commands::allow(const QString& id, const QString& why) const {
  QAction* action = (*this)[id];
  const QString tip = action->property(kTip).toString();
  action->setEnabled(why.isEmpty());
  action->setToolTip(why.isEmpty() ? tip : tip + "\n" + why);
}

bool Commands::pressKey(const QKeyEvent* event) {
  const QKeySequence pressed(
      QKeyCombination(event->modifiers() & ~Qt::KeypadModifier, Qt::Key(event->key())));
  for (QAction* action : actions_)
    if (action->shortcutContext() == Qt::WidgetShortcut && action->shortcuts().contains(pressed)) {
      if (action->isEnabled()) action->trigger();
      return true;
    }
  return false;
}

void Commands::refreshIcons() {
  for (QAction* action : actions_) setIcon(*action);
}

void Commands::setIcon(QAction& action) const {
  const QString name = action.property("iconName").toString();
  if (!name.isEmpty())
    action.setIcon(theme_.icon(name));
  else if (action.isCheckable())
    action.setIcon(theme_.tick());
}

CommandPalette::CommandPalette(const Commands& commands, QWidget* parent)
    : QDialog(parent, Qt::Dialog | Qt::FramelessWindowHint),
      commands_(commands),
      line_(new QLineEdit(this)),
      list_(new QListWidget(this)) {
  setModal(true);
  setWindowTitle(tr("Find a command"));
  auto* layout = makeBox<QVBoxLayout>(this, {kGap, kGap, kGap, kGap}, kGap);
  line_->setPlaceholderText(tr("Find a command"));
  line_->setAccessibleName(tr("Find a command"));
  line_->setClearButtonEnabled(true);
  layout->addWidget(line_);
  layout->addWidget(list_);
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setItemDelegate(new PaletteLine(commands.theme(), list_));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  line_->installEventFilter(this);
  connect(line_, &QLineEdit::textChanged, this, &CommandPalette::filter);
  connect(line_, &QLineEdit::returnPressed, this, &CommandPalette::run);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::run);
}

void CommandPalette::open() {
  const QWidget* window = parentWidget();
  const int width = std::min(520, window->width() - 64), height = std::min(420, window->height() - 96);
  resize(width, height);
  move(window->mapToGlobal(QPoint((window->width() - width) / 2, 72)));
  line_->clear();
  filter({});
  QDialog::open();
  line_->setFocus();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == line_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const int step = key == Qt::Key_Down ? 1 : key == Qt::Key_Up ? -1 : 0;
    if (step != 0 && list_->count() > 0) {
      list_->setCurrentRow(std::clamp(list_->currentRow() + step, 0, list_->count() - 1));
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

void CommandPalette::filter(const QString& text) {
  std::vector<std::pair<int, QAction*>> found;
  for (QAction* action : commands_.all()) {
    if (!action->isEnabled() || action->objectName() == "edit.palette") continue;
    int fit = rank(commandText(*action), text);
    if (fit < 0) {
      fit = rank(action->toolTip(), text);
      if (fit >= 0) fit += kByTip;
    }
    if (fit >= 0) found.emplace_back(fit, action);
  }
  std::ranges::stable_sort(found, {}, &std::pair<int, QAction*>::first);
  list_->clear();
  for (const auto& [fit, action] : found) {
    auto* item = new QListWidgetItem(action->icon(), commandText(*action), list_);
    item->setData(kKeysRole, action->shortcut().toString(QKeySequence::NativeText));
    item->setToolTip(action->toolTip());
    item->setData(Qt::UserRole, QVariant::fromValue<void*>(action));
  }
  list_->setCurrentRow(0);
}

void CommandPalette::run() {
  const QListWidgetItem* item = list_->currentItem();
  accept();
  if (item) static_cast<QAction*>(item->data(Qt::UserRole).value<void*>())->trigger();
}

GuideWindow::GuideWindow(const Commands& commands, QWidget* parent)
    : QDialog(parent),
      commands_(commands),
      tabs_(new QTabWidget(this)),
      guide_(new QTextBrowser(tabs_)),
      keys_(new QTextBrowser(tabs_)) {
  setWindowTitle(tr("Guide and keys"));
  auto* layout = makeBox<QVBoxLayout>(this);
  layout->addWidget(tabs_);
  tabs_->setDocumentMode(true);
  tabs_->addTab(guide_, tr("Guide"));
  tabs_->addTab(keys_, tr("Keys"));
  for (QTextBrowser* page : {guide_, keys_}) {
    page->setFrameShape(QFrame::NoFrame);
    page->setOpenExternalLinks(true);
    page->document()->setDocumentMargin(kGroupGap);
  }
  guide_->setAccessibleName(tr("Guide"));
  keys_->setAccessibleName(tr("Keys"));
  guide_->setSearchPaths({":/guide"});  // its pictures
  QFile file(":/guide/user-guide.md");
  if (file.open(QIODevice::ReadOnly)) guide_->setMarkdown(QString::fromUtf8(file.readAll()));
}

void GuideWindow::open() {
  keys_->setHtml(keysText());
  if (!isVisible()) resize(kSize.boundedTo(parentWidget()->size()));
  show();  // beside the work, not in its way
  raise();
  activateWindow();
}

QString GuideWindow::keysText() const {
  QString text = QStringLiteral("<h2>%1</h2><table cellspacing=\"0\" cellpadding=\"3\">").arg(tr("Commands"));
  const auto line = [&text](const QString& keys, const QString& what) {
    text += QStringLiteral("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
                .arg(keys.toHtmlEscaped(), what.toHtmlEscaped());
  };
  for (const QAction* action : commands_.all()) {
    QStringList keys;
    for (const QKeySequence& key : action->shortcuts()) keys << key.toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) line(keys.join(tr(" or ")), commandText(*action));
  }
  text +=
      QStringLiteral("</table><h2>%1</h2><table cellspacing=\"0\" cellpadding=\"3\">").arg(tr("In a field"));
  line(tr("Enter"), tr("Take what is typed, and give the keyboard back to the picture"));
  line(tr("Esc"), tr("Bring the value back, and give the keyboard back to the picture"));
  line(tr("Up, Down"), tr("One step more or less; Page Up and Page Down ten"));
  line(tr("Tab"), tr("Take what is typed and go to the next field"));
  text += QStringLiteral("</table><h2>%1</h2><table cellspacing=\"0\" cellpadding=\"3\">")
              .arg(tr("At a handle that was chosen"));
  line(tr("A number, = or Enter"), tr("Type its numbers, or expressions, in a field beside it"));
  line(tr("Up, Down"), tr("1 mm up or down; with Alt 0.1 mm, with Ctrl or Shift 10 mm"));
  line(tr("Left, Right"), tr("The same across, for a point of a section"));
  line(tr("Esc"), tr("Take the moves of the keys back; then choose no handle"));
  return text + QStringLiteral("</table>");
}

}  // namespace bw::app
