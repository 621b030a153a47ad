// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/kerf_table_field.h"

#include <QHelpEvent>
#include <QToolTip>

#include <algorithm>
#include <cmath>
#include <string>

#include "controls/told_expression.h"

namespace bw::app {

namespace {

constexpr double kSame = 1e-12;    // relative: what a number and its expression may differ by
constexpr int kEdges = 2 * 9 + 4;  // px, beside and between what the field shows

/// Those of the expressions that came to the numbers that there are.
KerfExpressions standing(const KerfExpressions& told, const KerfTable& table) {
  KerfExpressions stand;
  for (std::size_t i = 0; i < table.size(); ++i)
    for (const auto& [number, now] : {std::pair("/0", table[i].speed), {"/1", table[i].width}}) {
      const auto one = told.find("/" + std::to_string(i) + number);
      if (one != told.end() && std::abs(now - one->second.value) <= kSame * std::abs(one->second.value))
        stand.insert(*one);
    }
  return stand;
}

}  // namespace

KerfTableField::KerfTableField(QWidget* parent) : TypedField(parent), told_(makeTold(*this)) {
  setPlaceholderText(tr("None: one width at any speed"));
  setAlignment(Qt::AlignRight);
  connect(this, &QLineEdit::textChanged, this, &KerfTableField::refreshTold);
}

void KerfTableField::show(const KerfTable& table, const KerfExpressions& expressions) {
  const KerfExpressions stand = standing(expressions, table);
  const bool changed = table != table_ || stand != expressions_;
  table_ = table;
  expressions_ = stand;
  showValue(changed);
  refreshTold();
}

QString KerfTableField::expression() const {
  return expressions_.empty() ? QString() : QString::fromStdString(typedKerf(table_, expressions_));
}

void KerfTableField::refreshTold() {
  const QString told = expression();
  told_->setVisible(!told.isEmpty() && !hasFocus() && !typing());
  const int room = std::max(0, width() - kEdges - fontMetrics().horizontalAdvance(text()));
  placeTold(*told_, told, room);
  // It is a list, which begins with no =.
  told_->setText(told_->fontMetrics().elidedText(told, Qt::ElideRight, room));
}

bool KerfTableField::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && !expression().isEmpty()) {
    const QString tip = tr("%1\nNumbers typed here take its place.").arg(expression());
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                       toolTip().isEmpty() ? tip : toolTip() + QLatin1Char('\n') + tip, this);
    return true;
  }
  return TypedField::event(event);
}

void KerfTableField::resizeEvent(QResizeEvent* event) {
  TypedField::resizeEvent(event);
  refreshTold();
}

/// What is shown is another with and without the keyboard.
void KerfTableField::focusInEvent(QFocusEvent* event) {
  const bool told = !expressions_.empty() && !typing();
  if (told) setText(valueText());
  TypedField::focusInEvent(event);
  if (told) selectAll();
  refreshTold();
}

void KerfTableField::focusOutEvent(QFocusEvent* event) {
  TypedField::focusOutEvent(event);
  if (!expressions_.empty() && !typing()) setText(valueText());
  refreshTold();
}

QString KerfTableField::take(const QString& text) {
  const Result<ToldKerf> read = readTypedKerf(text.toStdString(), value_);
  if (!read) {
    QString why = QString::fromStdString(read.error().message);
    why[0] = why[0].toUpper();
    return why;
  }
  if (read->table == table_ && read->expressions == expressions_) return {};
  table_ = read->table;
  expressions_ = read->expressions;
  emit edited(table_, expressions_);
  return {};
}

QString KerfTableField::valueText() const {
  return hasFocus() && !expressions_.empty() ? expression() : QString::fromStdString(typedKerf(table_));
}

QString KerfTableField::limitsText() const {
  return tr("Such as 5: 4.2, 20: 2.6 for 4.2 mm at 5 mm/s and 2.6 mm at 20 mm/s");
}

}  // namespace bw::app
