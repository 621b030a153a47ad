// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/kerf_table_field.h"

#include "bw/core/sweep/kerf_text.h"

namespace bw::app {

KerfTableField::KerfTableField(QWidget* parent) : TypedField(parent) {
  setPlaceholderText(tr("None: one width at any speed"));
}

void KerfTableField::show(const KerfTable& table) {
  const bool changed = table != table_;
  table_ = table;
  showValue(changed);
}

QString KerfTableField::take(const QString& text) {
  const Result<KerfTable> read = readTypedKerf(text.toStdString());
  if (!read) {
    QString why = QString::fromStdString(read.error().message);
    why[0] = why[0].toUpper();
    return why;
  }
  if (*read == table_) return {};
  table_ = *read;
  emit edited(*read);
  return {};
}

QString KerfTableField::valueText() const { return QString::fromStdString(typedKerf(table_)); }

QString KerfTableField::limitsText() const {
  return tr("Such as 5: 4.2, 20: 2.6 for 4.2 mm at 5 mm/s and 2.6 mm at 20 mm/s");
}

}  // namespace bw::app
