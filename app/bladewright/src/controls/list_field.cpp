// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/list_field.h"

#include "bw/core/text/typed_number.h"

namespace bw::app {

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
  if (!read) {
    QString why = QString::fromStdString(read.error().message);
    why[0] = why[0].toUpper();
    return why;
  }
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
