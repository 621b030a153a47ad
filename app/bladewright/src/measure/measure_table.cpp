// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "measure/measure_table.h"

#include <QEvent>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw::app {

namespace {

constexpr double kLargest = 100000;    // mm
constexpr double kLargestAngle = 177;  // °, what the calibration takes
constexpr int kTextWidth = 62;         // of a column that is only read
constexpr double kCloser = 0.98;       // distance of a further measurement over the last
enum Column { kNumber, kDistance, kAngle, kHeight, kTemperature, kExpected, kLength, kResidual, kRemove };

}  // namespace

MeasureTable::MeasureTable(const Theme& theme, QWidget* parent)
    : QWidget(parent), theme_(theme), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(6);
  grid_->setVerticalSpacing(4);
  const auto head = [&](Column column, const QString& text, const QString& tip) {
    auto* label = makeNote(text, this);
    label->setWordWrap(false);
    label->setToolTip(tip);
    grid_->addWidget(label, 0, column, Qt::AlignRight | Qt::AlignBottom);
    return label;
  };
  head(kDistance, tr("Distance"), tr("Between the two ends of the free blade"));
  angleHead_ = head(kAngle, tr("Angle"), tr("Of both grips, down from the line through the ends"));
  head(kHeight, tr("Height"), tr("From the line through the ends down to the middle of the blade"));
  head(kTemperature, tr("Temperature"), tr("Temperature of the blade while it was measured"));
  head(kExpected, tr("Expected"), tr("The height at which the blade of the design would hang"));
  head(kLength, tr("Length"), tr("At the working temperature, from this measurement alone"));
  residualHead_ = head(kResidual, tr("Off by"), tr("Measured height less the height of the common length"));
  grid_->setColumnStretch(kRemove, 1);
  for (Column column : {kExpected, kLength}) grid_->setColumnMinimumWidth(column, kTextWidth);
  add_ = new QPushButton(tr("Add measurement"), this);
  add_->setToolTip(tr("The same blade held otherwise: several measurements tell how sure the length is"));
  connect(add_, &QPushButton::clicked, this, &MeasureTable::addRow);
  connect(&theme, &Theme::changed, this, &MeasureTable::refreshIcons);
}

void MeasureTable::appendLine(const MeasurementRow& row) {
  Line line;
  line.number = new QToolButton(this);
  line.number->setCheckable(true);
  line.number->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  line.number->setIconSize({12, 12});
  line.number->setFixedWidth(44);
  line.number->setToolTip(tr("Draw this measurement"));
  const auto field = [&](const NumberRange& range, double value, int width) {
    auto* number = new NumberField(range, this);
    number->setLive(true);  // the length follows while it is typed
    number->setFixedWidth(width);
    number->show(value);
    number->installEventFilter(this);
    connect(number, &NumberField::edited, this, &MeasureTable::edited);
    connect(number, &NumberField::refusedChanged, this, &MeasureTable::edited);
    return number;
  };
  line.distance = field({1, kLargest, 2, 1, "mm"}, row.distance, 100);
  line.angle = field({0, kLargestAngle, 2, 1, QString(QChar(0xb0))}, toDegrees(row.angle), 70);
  line.height = field({0, kLargest, 2, 1, "mm"}, row.height, 100);
  line.height->setBlank(tr("not yet"));
  line.temperature = field({-50, 1500, 1, 10, QString(QChar(0xb0)) + "C"}, row.temperature, 80);
  const auto value = [&](const QString& name) {
    auto* label = new QLabel(this);
    label->setFont(Theme::secondaryFont());
    label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    label->setAccessibleName(name);
    return label;
  };
  line.expected = value(tr("Expected height"));
  line.expected->setObjectName("secondary");
  line.length = value(tr("Length from this measurement alone"));
  line.residual = value(tr("Off the common length"));
  line.remove = new QToolButton(this);
  line.remove->setIconSize({14, 14});
  line.remove->setToolTip(tr("Remove this measurement"));
  connect(line.remove, &QToolButton::clicked, this, [this, button = line.remove] { removeLine(button); });
  connect(line.number, &QToolButton::clicked, this, [this, button = line.number] {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].number == button) choose(int(i));
  });
  lines_.push_back(line);
}

void MeasureTable::arrange() {
  // One measurement agrees with itself, and is not taken away.
  const bool several = lines_.size() > 1;
  residualHead_->setVisible(several);
  grid_->setColumnMinimumWidth(kResidual, several ? kTextWidth : 0);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    const std::vector<QWidget*> widgets = line.widgets();
    for (std::size_t column = 0; column < widgets.size(); ++column) {
      grid_->addWidget(widgets[column], int(i) + 1, int(column),
                       column == kRemove ? Qt::AlignLeft : Qt::AlignRight);
      widgets[column]->show();
    }
    line.angle->setVisible(!hinged_);
    line.number->setText(QString::number(i + 1));
    line.number->setAccessibleName(tr("Draw measurement %1").arg(i + 1));
    line.distance->setAccessibleName(tr("Distance %1").arg(i + 1));
    line.angle->setAccessibleName(tr("Angle %1").arg(i + 1));
    line.height->setAccessibleName(tr("Height %1").arg(i + 1));
    line.temperature->setAccessibleName(tr("Temperature %1").arg(i + 1));
    line.remove->setAccessibleName(tr("Remove measurement %1").arg(i + 1));
    line.remove->setVisible(several);
    line.residual->setVisible(several);
  }
  grid_->addWidget(add_, int(lines_.size()) + 1, kDistance, 1, 3, Qt::AlignLeft);
  add_->setEnabled(lines_.size() < std::size_t(kMostRows));
  // Lines made later come before the button all the same.
  QWidget* before = nullptr;
  for (const Line& line : lines_)
    for (QWidget* widget : line.widgets()) {
      if (widget->focusPolicy() == Qt::NoFocus) continue;
      if (before) setTabOrder(before, widget);
      before = widget;
    }
  if (before) setTabOrder(before, add_);
  choose(std::clamp(chosen_, 0, int(lines_.size()) - 1));
  refreshIcons();
}

void MeasureTable::refreshIcons() {
  for (const Line& line : lines_) {
    line.number->setIcon(theme_.tick());
    line.remove->setIcon(QIcon(theme_.pixmap("close", theme_.colours().secondary)));
  }
}

void MeasureTable::setRows(const std::vector<MeasurementRow>& rows) {
  for (const Line& line : lines_)
    for (QWidget* widget : line.widgets()) delete widget;
  lines_.clear();
  for (const MeasurementRow& row : rows) appendLine(row);
  chosen_ = 0;
  arrange();
}

std::vector<MeasurementRow> MeasureTable::rows() const {
  std::vector<MeasurementRow> rows;
  for (const Line& line : lines_)
    rows.push_back({line.distance->value(), fromDegrees(line.angle->value()), line.height->value(),
                    line.temperature->value()});
  return rows;
}

void MeasureTable::setHinged(bool hinged) {
  hinged_ = hinged;
  angleHead_->setVisible(!hinged);
  for (const Line& line : lines_) line.angle->setVisible(!hinged);
}

void MeasureTable::setOutcome(const MeasurementOutcome& outcome) {
  // Two digits after the point in a column, so that lines compare.
  const auto text = [](const std::optional<double>& value) {
    return value ? QString::fromStdString(fixedText(*value, 2)) : QStringLiteral("–");
  };
  for (std::size_t i = 0; i < lines_.size() && i < outcome.rows.size(); ++i) {
    const RowOutcome& row = outcome.rows[i];
    lines_[i].expected->setText(text(row.expected ? std::optional(row.expected->height) : std::nullopt));
    lines_[i].length->setText(text(row.lengthAtCut));
    lines_[i].residual->setText(outcome.measured > 1 ? text(row.residual) : QStringLiteral("–"));
  }
}

void MeasureTable::choose(int row) {
  const int next = std::clamp(row, 0, int(lines_.size()) - 1);
  for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i].number->setChecked(int(i) == next);
  if (next == chosen_) return;
  chosen_ = next;
  emit chosenChanged(next);
}

void MeasureTable::addRow() {
  MeasurementRow row = rows().back();
  row.distance = std::max(1.0, std::round(kCloser * row.distance));
  row.height = 0;
  appendLine(row);
  arrange();
  choose(int(lines_.size()) - 1);
  lines_.back().height->setFocus();
  lines_.back().height->selectAll();
  emit edited();
}

void MeasureTable::removeLine(QToolButton* button) {
  const auto found =
      std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) { return line.remove == button; });
  if (found == lines_.end() || lines_.size() < 2) return;
  const int index = int(found - lines_.begin());
  for (QWidget* widget : found->widgets()) {
    grid_->removeWidget(widget);
    widget->hide();
    widget->deleteLater();  // it is the sender
  }
  lines_.erase(found);
  if (chosen_ >= index && chosen_ > 0) --chosen_;
  arrange();
  lines_[std::size_t(chosen_)].distance->setFocus();
  emit chosenChanged(chosen_);
  emit edited();
}

bool MeasureTable::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusIn)
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (QWidget* widget : lines_[i].widgets())
        if (widget == watched) choose(int(i));
  return QWidget::eventFilter(watched, event);
}

}  // namespace bw::app
