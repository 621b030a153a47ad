// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/fields.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QScrollBar>
#include <QStyle>
#include <QStylePainter>
#include <QToolButton>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <memory>

#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr int kIconSize = 13, kIconGap = 4;  // of a value that breaks its limit
constexpr char kHead[] = "foldHead", kLabel[] = "lineLabel";
constexpr int kFieldWidth = 132;
constexpr int kShortTextRole = Qt::UserRole + 100;

}  // namespace

ValueLabel::ValueLabel(QWidget* parent) : QLabel(parent) {
  setTextInteractionFlags(Qt::TextSelectableByMouse);
}

void ValueLabel::setStanding(bool broken, bool stale) {
  if (broken == broken_ && stale == stale_) return;
  broken_ = broken;
  stale_ = stale;
  setProperty("broken", broken);
  setProperty("stale", stale);
  setContentsMargins(broken ? kIconSize + kIconGap : 0, 0, 0, 0);
  setAccessibleDescription(broken ? tr("Breaks its limit") : stale ? tr("Out of date") : QString());
  style()->unpolish(this);
  style()->polish(this);
  update();
}

void ValueLabel::paintEvent(QPaintEvent* event) {
  QLabel::paintEvent(event);
  if (!broken_) return;
  const QRect inside = contentsRect();
  const int text = std::min(fontMetrics().horizontalAdvance(this->text()), inside.width());
  const int x = alignment() & Qt::AlignRight ? inside.right() + 1 - text : inside.left();
  QPainter painter(this);
  painter.setOpacity(stale_ ? kStaleOpacity : 1);
  painter.drawPixmap(x - kIconSize - kIconGap, inside.center().y() - kIconSize / 2,
                     Theme::pixmap("error", errorColour_, kIconSize, devicePixelRatioF()));
}

ChoiceField::ChoiceField(QWidget* parent) : QComboBox(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(6);
}

void ChoiceField::show(int index) {
  const QSignalBlocker quiet(this);
  setCurrentIndex(index);
}

void ChoiceField::setShortText(int index, const QString& text) { setItemData(index, text, kShortTextRole); }

QString ChoiceField::shownText() const {
  const QVariant text = currentData(kShortTextRole);
  return text.isValid() ? text.toString() : currentText();
}

int ChoiceField::textWidth() const {
  QStyleOptionComboBox option;
  initStyleOption(&option);
  return style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this).width();
}

void ChoiceField::showPopup() {
  const int frame = 2 * kGap + view()->verticalScrollBar()->sizeHint().width();
  view()->setMinimumWidth(std::max(width(), view()->sizeHintForColumn(0) + frame));
  QComboBox::showPopup();
}

bool ChoiceField::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && fontMetrics().horizontalAdvance(shownText()) > textWidth()) {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                       toolTip().isEmpty() ? currentText() : currentText() + "\n" + toolTip(), this);
    return true;
  }
  return QComboBox::event(event);
}

void ChoiceField::paintEvent(QPaintEvent*) {
  QStylePainter painter(this);
  QStyleOptionComboBox option;
  initStyleOption(&option);
  option.currentText = fontMetrics().elidedText(shownText(), Qt::ElideRight, textWidth());
  painter.setPen(palette().color(QPalette::Text));
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

void ChoiceField::hidePopup() {
  QComboBox::hidePopup();
  // After the popup has given the keyboard back to this field.
  QMetaObject::invokeMethod(
      this,
      [this] {
        if (hasFocus()) returnKeyboard(*this);
      },
      Qt::QueuedConnection);
}

void ChoiceField::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  const bool leave = key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Escape;
  if (!leave || !returnKeyboard(*this)) QComboBox::keyPressEvent(event);
}

void ChoiceField::wheelEvent(QWheelEvent* event) { event->ignore(); }

HandSlider::HandSlider(QWidget* parent) : QSlider(Qt::Horizontal, parent) {
  setMinimumHeight(20);
  setFocusPolicy(Qt::StrongFocus);
  connect(this, &QSlider::valueChanged, this, [this](int value) {
    if (!quiet_) emit moved(value);
  });
}

void HandSlider::show(int value) {
  if (held_) return;
  quiet_ = true;
  setValue(value);
  quiet_ = false;
}

bool HandSlider::event(QEvent* event) {
  // Before the window, where Esc stops the computation.
  const bool key = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (!key || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape || !held_ || !putBack_)
    return QSlider::event(event);
  event->accept();
  if (event->type() == QEvent::ShortcutOverride) return true;
  const QPointF at = rect().center();
  QMouseEvent release(QEvent::MouseButtonRelease, at, mapToGlobal(at), Qt::LeftButton, {}, {});
  QCoreApplication::sendEvent(this, &release);
  putBack_();
  return true;
}

void HandSlider::mousePressEvent(QMouseEvent* event) {
  // Before the base class: a press beside the handle moves it at once.
  held_ = event->button() == Qt::LeftButton;
  if (held_) {
    emit grabbed();
    if (keep_) putBack_ = keep_();
  }
  QSlider::mousePressEvent(event);
}

void HandSlider::mouseReleaseEvent(QMouseEvent* event) {
  QSlider::mouseReleaseEvent(event);
  held_ = false;
}

void HandSlider::wheelEvent(QWheelEvent* event) { event->ignore(); }

FormColumn::FormColumn(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(kGap);
  grid_->setVerticalSpacing(6);
  grid_->setColumnStretch(0, 1);
}

void FormColumn::addLine(const QString& label, QWidget* field, const QString& tip) {
  auto* text = new QLabel(label, this);
  text->setBuddy(field);
  const QString limits = field->property("limits").toString();
  QString whole = tip;
  if (!limits.isEmpty()) whole += (whole.isEmpty() ? QString() : QStringLiteral("\n")) + limits;
  if (!whole.isEmpty()) {
    text->setToolTip(whole);
    field->setToolTip(whole);
  }
  if (field->accessibleName().isEmpty()) field->setAccessibleName(label);
  field->setFixedWidth(kFieldWidth);
  grid_->addWidget(text, row_, 0, Qt::AlignVCenter);
  grid_->addWidget(field, row_++, 1, Qt::AlignRight | Qt::AlignVCenter);
  field->setProperty(kLabel, QVariant::fromValue(text));
}

ChoiceField* FormColumn::addTogether(QBoxLayout* layout, const QString& label, const QString& tip) {
  auto* line = new QWidget(this);
  line->setLayout(layout);
  auto* text = new QLabel(label, line);
  auto* field = new ChoiceField(line);
  text->setBuddy(field);
  text->setToolTip(tip);
  field->setToolTip(tip);
  field->setAccessibleName(label);
  field->setProperty(kLabel, QVariant::fromValue(text));
  layout->addWidget(text);
  layout->addWidget(field);
  addWide(line);
  return field;
}

ChoiceField* FormColumn::addLong(const QString& label, const QString& tip) {
  auto* layout = makeBox<QHBoxLayout>(nullptr, {}, kGroupGap);
  ChoiceField* field = addTogether(layout, label, tip);
  layout->setStretchFactor(field, 1);
  return field;
}

ChoiceField* FormColumn::addBelow(const QString& label, const QString& tip) {
  return addTogether(makeBox<QVBoxLayout>(nullptr, {}, 2), label, tip);
}

QCheckBox* FormColumn::addCheck(const QString& text, const QString& tip) {
  auto* box = addWide(new QCheckBox(text));
  box->setToolTip(tip);
  return box;
}

ValueLabel* FormColumn::addValue(const QString& label, const QString& tip) {
  auto* name = new QLabel(label, this);
  name->setObjectName("secondary");
  auto* value = new ValueLabel(this);
  value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  name->setToolTip(tip);
  value->setToolTip(tip);
  value->setAccessibleName(label);
  grid_->addWidget(name, row_, 0);
  grid_->addWidget(value, row_++, 1);
  return value;
}

QLabel* FormColumn::addHeading(const QString& text) {
  if (row_ > 0) addGap(kGap);
  auto* label = new QLabel(text, this);
  QFont font = Theme::bodyFont();
  font.setWeight(QFont::DemiBold);
  label->setFont(font);
  addWide(label);
  return label;
}

void FormColumn::addGap(int height) { grid_->setRowMinimumHeight(row_++, height); }

FormColumn* FormColumn::addFold(const QString& title, const Theme& theme) {
  auto* head = new QToolButton(this);
  head->setText(title);
  head->setCheckable(true);
  head->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  head->setIconSize({14, 14});
  head->setFont(Theme::secondaryFont());
  auto* body = new FormColumn(this);
  body->hide();
  const auto paint = [head, &theme] {
    head->setIcon(QIcon(
        theme.pixmap(head->isChecked() ? "chevron-down" : "chevron-right", theme.colours().secondary, 14)));
  };
  paint();
  makeFolding(*head, *body);
  connect(head, &QToolButton::toggled, body, paint);
  connect(&theme, &Theme::changed, head, paint);
  grid_->addWidget(head, row_++, 0, 1, 2, Qt::AlignLeft);
  addWide(body);
  return body;
}

void makeFolding(QAbstractButton& head, QWidget& body) {
  body.setProperty(kHead, QVariant::fromValue(&head));
  QObject::connect(&head, &QAbstractButton::toggled, &body, &QWidget::setVisible);
}

void unfold(QWidget& widget) {
  for (QWidget* at = &widget; at; at = at->parentWidget())
    if (auto* head = at->property(kHead).value<QAbstractButton*>()) head->setChecked(true);
}

void setLineVisible(QWidget* field, bool visible) {
  field->property(kLabel).value<QLabel*>()->setVisible(visible);
  field->setVisible(visible);
}

void empty(QLayout& layout) {
  while (const std::unique_ptr<QLayoutItem> item{layout.takeAt(0)})
    if (QWidget* widget = item->widget()) {
      widget->hide();
      widget->deleteLater();
    }
}

QLabel* makeTitle(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(Theme::titleFont());
  return label;
}

QWidget* makeLine(QWidget* parent) {
  auto* line = new QFrame(parent);
  line->setObjectName("line");
  return line;
}

QLabel* makeNote(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setObjectName("secondary");
  label->setFont(Theme::secondaryFont());
  label->setWordWrap(true);
  return label;
}

QLabel* makeAnswer() {
  auto* label = new QLabel;
  label->setObjectName("secondary");
  label->setWordWrap(true);
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  label->setMinimumHeight(2 * QFontMetrics(Theme::bodyFont()).lineSpacing());
  return label;
}

}  // namespace bw::app
