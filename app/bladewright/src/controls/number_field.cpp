// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/number_field.h"

#include <QKeyEvent>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bw/core/text/number_text.h"
#include "bw/core/text/typed_number.h"
#include "controls/told_expression.h"

namespace bw::app {

namespace {

constexpr int kDigits = 6;                    // at least so many are shown of a number that has them
constexpr int kMostDecimals = 12;             // the rest is rounding
constexpr double kPage = 10;                  // steps of the page keys
constexpr int kUnitGap = 4, kUnitMargin = 9;  // before the unit, and between it and the field's edge
constexpr double kSame = 1e-12;               // relative: what a number and its expression may differ by
constexpr QLatin1Char kEquals('=');

QString withoutTrailingZeros(QString text) {
  if (!text.contains(QLatin1Char('.'))) return text;
  while (text.endsWith(QLatin1Char('0'))) text.chop(1);
  if (text.endsWith(QLatin1Char('.'))) text.chop(1);
  return text == QStringLiteral("-0") ? QStringLiteral("0") : text;
}

/// A sentence of a reader, as it stands under a field.
QString upper(const std::string& sentence) {
  QString text = QString::fromStdString(sentence);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

}  // namespace

NumberField::NumberField(const NumberRange& range, QWidget* parent)
    : TypedField(parent),
      range_(range),
      unit_(new QLabel(this)),
      told_(makeTold(*this)),
      value_(std::clamp(0.0, range.min, range.max)),
      before_(value_) {
  unit_->setObjectName("unit");
  unit_->setAttribute(Qt::WA_TransparentForMouseEvents);
  setAlignment(Qt::AlignRight);
  setUnit(range.unit);
  setText(valueText());
  connect(this, &QLineEdit::textEdited, this, &NumberField::follow);
  connect(this, &QLineEdit::textChanged, this, &NumberField::refreshUnit);
  refreshUnit();
}

void NumberField::show(double value) {
  const bool changed = value != value_;
  value_ = before_ = value;
  showValue(changed);
  refreshUnit();
}

void NumberField::showExpression(const std::optional<BoundNumber>& bound) {
  const bool changed = bound != bound_;
  bound_ = bound;
  showValue(changed);
  refreshUnit();
}

QString NumberField::expression() const {
  const bool stands = bound_ && std::abs(value_ - bound_->value) <= kSame * std::abs(bound_->value);
  return stands ? QString::fromStdString(bound_->text) : QString();
}

void NumberField::setMaximum(double max) {
  range_.max = max;
  refreshLimits();
}

void NumberField::setUnit(const QString& unit) {
  range_.unit = unit;
  refreshLimits();
  refreshUnit();
}

void NumberField::setSuffix(const QString& words) {
  suffix_ = words;
  refreshUnit();
}

void NumberField::refreshUnit() {
  const QString told = expression();
  QString words = suffix_.isEmpty() ? range_.unit : suffix_;
  // While the expression is typed into, what it comes to now takes the place of the unit.
  if (!told.isEmpty() && hasFocus()) {
    words = (textOf(value_) + QLatin1Char(' ') + words).trimmed();
    const int whole = fontMetrics().horizontalAdvance(text()) + unit_->fontMetrics().horizontalAdvance(words);
    if (whole + kUnitGap + 2 * kUnitMargin > width()) words.clear();  // what is typed needs the room
  }
  if (text().startsWith(kEquals) && typing()) words.clear();
  unit_->setText(words);
  unit_->setVisible(!words.isEmpty() && !text().isEmpty() && (text().startsWith(kEquals) || !ownUnitTyped()));
  const int wide = unit_->sizeHint().width();
  unit_->setGeometry(width() - kUnitMargin - wide, 0, wide, height());
  const int beside = words.trimmed().isEmpty() ? 0 : wide + kUnitGap;
  setTextMargins(0, 0, beside, 0);
  const int number = fontMetrics().horizontalAdvance(text()) + beside;
  const int room = width() - 2 * kUnitMargin - number - kUnitGap;
  told_->setVisible(!told.isEmpty() && !hasFocus() && !typing());
  placeTold(*told_, QLatin1Char('=') + told, room);
}

bool NumberField::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip || expression().isEmpty()) return TypedField::event(event);
  showWithTold(*this, *event, tr("= %1\nA number typed here takes its place.").arg(expression()));
  return true;
}

/// What is shown is another with and without the keyboard.
void NumberField::focusInEvent(QFocusEvent* event) {
  if (!expression().isEmpty() && !typing()) setText(valueText());
  TypedField::focusInEvent(event);
  if (!expression().isEmpty() && !typing()) selectAll();
  refreshUnit();
}

void NumberField::focusOutEvent(QFocusEvent* event) {
  TypedField::focusOutEvent(event);
  if (!expression().isEmpty() && !typing()) setText(valueText());
  refreshUnit();
}

void NumberField::resizeEvent(QResizeEvent* event) {
  TypedField::resizeEvent(event);
  refreshUnit();
}

void NumberField::refreshLimits() {
  const QString before = property("limits").toString(), limits = limitsText();
  setProperty("limits", limits);
  // The tip of a line ends with the limits.
  QString tip = toolTip();
  if (!before.isEmpty() && tip.endsWith(before)) tip.chop(before.size());
  if (tip.isEmpty() || tip.endsWith('\n')) setToolTip(tip + limits);
}

void NumberField::setBlank(const QString& words) {
  blank_ = words;
  setPlaceholderText(words);
  setText(valueText());
}

QString NumberField::limitsText() const {
  const QString gap = range_.unit.isEmpty() || range_.unit == QChar(0xb0) ? QString() : QStringLiteral(" ");
  constexpr double kAnywhere = 1e7;  // what only keeps numbers in reason
  if (range_.min <= -kAnywhere && range_.max >= kAnywhere)
    return range_.unit.isEmpty() ? tr("Any number") : tr("Any number, in %1").arg(range_.unit);
  if (range_.max >= kAnywhere) return tr("%1%2 at least").arg(textOf(range_.min), gap + range_.unit);
  return tr("%1 to %2%3").arg(textOf(range_.min), textOf(range_.max), gap + range_.unit);
}

QString NumberField::textOf(double value) const {
  const double size = std::abs(value);
  int decimals = range_.decimals;
  if (size > std::pow(10.0, -kMostDecimals + 3))
    decimals = std::clamp(kDigits - 1 - int(std::floor(std::log10(size))), decimals,
                          std::max(decimals, kMostDecimals));
  return withoutTrailingZeros(QString::fromStdString(fixedText(value, decimals)));
}

QString NumberField::valueText() const {
  if (hasFocus() && !expression().isEmpty()) return kEquals + expression();
  return !blank_.isEmpty() && value_ == range_.min ? QString() : textOf(value_);
}

QString NumberField::read(const QString& text, double* value) const {
  if (!blank_.isEmpty() && text.trimmed().isEmpty()) {
    *value = range_.min;
    return {};
  }
  const NumberDemand demand{range_.unit.toStdString(), range_.min, range_.max, range_.decimals == 0};
  const Result<double> read = readTypedNumber(text.toStdString(), demand);
  if (!read) return upper(read.error().message);
  *value = *read;
  return check_ ? check_(*read) : QString();
}

QString NumberField::take(const QString& text) {
  return text.trimmed().startsWith(kEquals) ? takeExpression(text.trimmed().mid(1)) : takeNumber(text);
}

QString NumberField::takeExpression(const QString& text) {
  if (!use_.value) return tr("A number, for no expression can stand here");
  const std::string expression = text.trimmed().toStdString();
  const Result<double> value = use_.value(expression);
  if (!value) return tr("After its =, %1").arg(QString::fromStdString(value.error().message));
  const QString comes =
      tr("This comes to %1").arg((textOf(*value) + QLatin1Char(' ') + range_.unit).trimmed());
  if (*value < range_.min || *value > range_.max) return tr("%1, which is out of range").arg(comes);
  if (range_.decimals == 0 && *value != std::floor(*value))
    return tr("%1, and must be a whole number").arg(comes);
  if (check_)
    if (const QString why = check_(*value); !why.isEmpty()) return why;
  if (text.trimmed() == this->expression()) return {};
  value_ = before_ = *value;
  bound_ = BoundNumber{expression, *value};
  use_.bind(bound_, [this] { emit edited(value_); });
  return {};
}

QString NumberField::takeNumber(const QString& text) {
  const bool bound = !expression().isEmpty();
  // What the field shows of a number is that number, though it may have more digits.
  if (text == textOf(before_) && !bound) {
    become(before_);
    return {};
  }
  double value = 0;
  if (QString why = read(text, &value); !why.isEmpty()) return why;
  if (bound) {
    value_ = value;
    bound_.reset();
    use_.bind({}, [this] { emit edited(value_); });
  } else {
    become(value);
  }
  before_ = value_;
  return {};
}

void NumberField::become(double value) {
  if (value == std::exchange(value_, value)) return;
  emit edited(value);
}

void NumberField::follow(const QString& text) {
  double value = 0;
  if (live_ && read(text, &value).isEmpty()) become(value);
}

void NumberField::dropped() { become(before_); }

void NumberField::step(double steps) {
  if (!finish() || !expression().isEmpty()) return;  // an expression has no next one
  const double wanted = value_ + steps * range_.step;
  // 0.1 + 0.2 is 0.3 here.
  const double tidy = parseNumber(shortText(wanted, kMostDecimals)).value_or(wanted);
  const double value = nextTaken(std::clamp(tidy, range_.min, range_.max), steps);
  if (value == value_) return;
  become(value);
  before_ = value_;
  setText(valueText());
  selectAll();
}

double NumberField::nextTaken(double value, double steps) const {
  const auto taken = [this](double v) { return !check_ || check_(v).isEmpty(); };
  if (taken(value)) return value;
  if (range_.decimals > 0) return value_;
  const double on = steps > 0 ? 1 : -1;
  for (double v = value + on; v >= range_.min && v <= range_.max; v += on)
    if (taken(v)) return v;
  for (double v = value - on; (v - value_) * on > 0; v -= on)
    if (taken(v)) return v;
  return value_;
}

void NumberField::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  const double steps = key == Qt::Key_Up         ? 1
                       : key == Qt::Key_Down     ? -1
                       : key == Qt::Key_PageUp   ? kPage
                       : key == Qt::Key_PageDown ? -kPage
                                                 : 0;
  if (steps == 0 || event->modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier))
    return TypedField::keyPressEvent(event);
  step(steps);
  event->accept();
}

bool NumberField::ownUnitTyped() const {
  const QString typed = text();
  return std::any_of(typed.begin(), typed.end(),
                     [](QChar c) { return c.isLetter() || c == QChar(0xb0) || c == QLatin1Char('"'); });
}

ListField::ListField(const QString& thing, QWidget* parent) : TypedField(parent), thing_(thing) {
  setAlignment(Qt::AlignRight);
}

void ListField::show(const std::vector<int>& numbers) {
  const bool changed = numbers != numbers_;
  numbers_ = numbers;
  showValue(changed);
}

QString ListField::take(const QString& text) {
  const Result<std::vector<int>> read = readNumberList(text.toStdString(), count_, thing_.toStdString());
  if (!read) return upper(read.error().message);
  if (*read == numbers_) return {};
  numbers_ = *read;
  emit edited(*read);
  return {};
}

QString ListField::valueText() const { return QString::fromStdString(numberListText(numbers_)); }

QString ListField::limitsText() const {
  return count_ > 1 ? tr("Such as 0, 3, 5-7; 0 to %1").arg(count_ - 1) : QString();
}

}  // namespace bw::app
