// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "measure/measure_page.h"

#include <QHBoxLayout>
#include <QKeyEvent>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "controls/layout.h"
#include "controls/numbers.h"

namespace bw::app {

namespace {

constexpr double kFirstDistance = 0.97;  // of the blade's length
constexpr double kFirstAngle = 25;       // °

}  // namespace

MeasurePage::MeasurePage(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setObjectName("panel");
  setAttribute(Qt::WA_StyledBackground);
  auto* layout = makeBox<QVBoxLayout>(this, {}, 0);
  auto* head = makeBox<QHBoxLayout>(nullptr, {kGroupGap, kGap, kGroupGap, kGap}, kGroupGap);
  blade_ = makeNote({}, this);
  blade_->setWordWrap(false);
  head->addWidget(makeButton(tr("Back"), tr("Back without a change (Esc)"), this, &MeasurePage::left));
  head->addWidget(makeTitle(tr("Length of the mounted blade"), this));
  head->addStretch();
  head->addWidget(blade_);
  layout->addLayout(head);
  layout->addWidget(makeLine(this));

  auto* columns = makeBox<QHBoxLayout>(nullptr, {}, 0);
  auto* input = new SidePanel(0, this);
  input->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  input->setWidget(makeInput());
  columns->addWidget(input);
  auto* line = new QFrame(this);
  line->setObjectName("vline");
  columns->addWidget(line);
  auto* right = makeBox<QVBoxLayout>(nullptr, {}, 0);
  drawing_ = new MeasureDrawing(theme, this);
  right->addWidget(drawing_, 1);
  right->addWidget(makeLine(this));
  answer_ = new MeasureAnswer(bench, theme, this);
  right->addWidget(answer_);
  columns->addLayout(right, 1);
  layout->addLayout(columns, 1);

  connect(table_, &MeasureTable::edited, this, &MeasurePage::refresh);
  connect(table_, &MeasureTable::chosenChanged, this, &MeasurePage::refresh);
  connect(answer_, &MeasureAnswer::used, this, &MeasurePage::left);
  connect(&bench, &Workbench::changed, this, [this](const Change& change) {
    if (entered_ && change.any(Aspect::design)) refresh();
  });
  connect(&theme, &Theme::changed, this, [this] {
    if (entered_) refresh();
  });
}

QWidget* MeasurePage::makeInput() {
  auto* page = new QWidget;
  page->setObjectName("page");
  auto* layout = makeBox<QVBoxLayout>(page, {kGroupGap, kGroupGap, kGroupGap, kGroupGap}, kGap);
  layout->addWidget(makeNote(
      tr("Hold the blade level, both grips at the same angle, so that it sags evenly. Type the distance "
         "between its "
         "ends, the angle of the grips and how far its middle hangs below the line through the ends."),
      page));
  auto* ends = new QHBoxLayout;
  auto* endsName = new QLabel(tr("Ends"), page);
  ends_ = new ChoiceField(page);
  ends_->addItems({tr("held at an angle by the grips"), tr("hinged, they turn freely")});
  ends_->setAccessibleName(tr("Ends"));
  ends_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  endsName->setBuddy(ends_);
  ends->setSpacing(kGroupGap);
  ends->addWidget(endsName);
  ends->addWidget(ends_);
  ends->addStretch();
  layout->addSpacing(kGap);
  layout->addLayout(ends);
  table_ = new MeasureTable(theme_, page);
  layout->addWidget(table_);
  connect(ends_, &QComboBox::activated, this, [this](int index) {
    table_->setHinged(index == 1);
    refresh();
  });

  auto* sure = new FormColumn(page);
  sure->setMaximumWidth(420);
  sure->addHeading(tr("How exact the readings are"));
  sure->addWide(
      makeNote(tr("Standard deviations, if they are known. Otherwise the scatter of several measurements "
                  "tells how sure the length is.")));
  const auto error = [&](const QString& name, const NumberRange& range, const QString& tip) {
    auto* field = sure->add(name, new NumberField(range), tip);
    field->setLive(true);
    field->setBlank(tr("unknown"));
    connect(field, &NumberField::edited, this, &MeasurePage::refresh);
    connect(field, &NumberField::refusedChanged, this, &MeasurePage::refresh);
    return field;
  };
  heightError_ =
      error(tr("Error of the height"), {0, 1000, 3, 0.1, "mm"}, tr("Two readings in three err by less"));
  angleError_ = error(tr("Error of the angle"), {0, 45, 3, 0.1, QString(QChar(0xb0))},
                      tr("Two readings in three err by less"));
  distanceError_ =
      error(tr("Error of the distance"), {0, 1000, 3, 0.1, "mm"}, tr("Two readings in three err by less"));
  const auto offset = [&](const QString& name, const QString& tip) {
    auto* box = sure->addCheck(name, tip);
    connect(box, &QCheckBox::clicked, this, &MeasurePage::refresh);
    return box;
  };
  heightOffset_ = offset(tr("Find a constant error of the heights"),
                         tr("As of a gauge whose zero is displaced; takes one measurement more"));
  angleOffset_ = offset(tr("Find a constant error of the angles"),
                        tr("As of grips mounted askew; takes one measurement more"));
  layout->addSpacing(kGap);
  layout->addWidget(sure);
  layout->addStretch();
  return page;
}

void MeasurePage::enter() {
  if (!entered_) {
    entered_ = true;
    const Blade& blade = bench_.design().blade;
    table_->setRows({{std::max(1.0, std::round(kFirstDistance * blade.length)), fromDegrees(kFirstAngle), 0,
                      blade.temperature}});
  }
  refresh();
}

void MeasurePage::refresh() {
  MeasurementSheet sheet;
  sheet.hinged = ends_->currentIndex() == 1;
  sheet.rows = table_->rows();
  sheet.heightError = heightError_->value();
  sheet.angleError = fromDegrees(angleError_->value());
  sheet.distanceError = distanceError_->value();
  sheet.heightOffset = heightOffset_->isChecked();
  sheet.angleOffset = angleOffset_->isChecked();
  angleError_->setEnabled(!sheet.hinged);
  angleOffset_->setEnabled(!sheet.hinged);
  const Blade& blade = bench_.design().blade;
  outcome_ = evaluateSheet(sheet, blade);
  table_->setOutcome(outcome_);
  blade_->setText(tr("%1, %2 long, %3 °C at the cut, expands %4·10⁻⁶/K")
                      .arg(QString::fromStdString(blade.title.empty() ? blade.name : blade.title),
                           lengthText(blade.length), QString::fromStdString(shortText(blade.temperature, 4)),
                           QString::fromStdString(shortText(1e6 * blade.thermalExpansion, 3))));
  refreshDrawing();
  answer_->setOutcome(outcome_, table_->chosen(), sheet.hinged, refusedField(*this) != nullptr);
}

void MeasurePage::refreshDrawing() {
  const auto row = std::size_t(table_->chosen());
  const MeasurementRow typed = table_->rows()[row];
  const RowOutcome& out = outcome_.rows[row];
  MeasureDrawing::Content content{
      typed.distance, ends_->currentIndex() == 1, out.measured, out.expected, typed.height, false};
  if (!out.measured && typed.height > 0) {
    // No blade fits these numbers: the last one that did stays, paler.
    content = drawing_->content();
    content.outdated = true;
  }
  drawing_->setContent(std::move(content));
}

void MeasurePage::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape) return QWidget::keyPressEvent(event);
  // What is marked red goes first, wherever the keyboard is.
  if (TypedField* field = refusedField(*this))
    field->restore();
  else
    emit left();
}

}  // namespace bw::app
