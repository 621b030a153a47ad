// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/kerf_table_field.h"

#include <algorithm>
#include <string>

namespace bw::app {

namespace {

/// Those of the expressions that came to the numbers that there are.
KerfExpressions standingOf(const KerfExpressions& told, const KerfTable& table) {
  KerfExpressions stand;
  for (std::size_t i = 0; i < table.size(); ++i)
    for (const auto& [number, now] : {std::pair("/0", table[i].speed), {"/1", table[i].width}}) {
      const auto one = told.find("/" + std::to_string(i) + number);
      if (one != told.end() && standsFor(now, one->second)) stand.insert(*one);
    }
  return stand;
}

}  // namespace

KerfTableField::KerfTableField(QWidget* parent) : ToldListField(parent) {
  setPlaceholderText(tr("None: one width at any speed"));
}

void KerfTableField::show(const KerfTable& table, const KerfExpressions& expressions) {
  const KerfExpressions stand = standingOf(expressions, table);
  const bool changed = table != table_ || stand != expressions_;
  table_ = table;
  expressions_ = stand;
  showValue(changed);
  refreshTold();
}

QString KerfTableField::expression() const {
  return expressions_.empty() ? QString() : QString::fromStdString(typedKerf(table_, expressions_));
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
