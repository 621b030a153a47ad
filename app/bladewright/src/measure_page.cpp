// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "measure_page.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QScrollArea>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "bw/core/units.h"
#include "messages.h"
#include "numbers.h"

namespace bw::app {

namespace {

constexpr double kFirstDistance = 0.97;             // of the blade's length
constexpr double kFirstAngle = 25;                  // °
constexpr double kShortest = 10, kLongest = 20000;  // mm: lengths that a design takes
constexpr double kStep = 0.01;                      // mm: a design's length is stored so finely
constexpr double kImplausible = 0.01;               // chance below which the readings contradict their errors

QString dash() { return QStringLiteral("–"); }

/// How much the length changes for one unit more of a reading, with its sign.
QString changeText(double slope) {
  return (slope < 0 ? QString() : QStringLiteral("+")) +
         QString::fromStdString(fixedText(slope, std::abs(slope) < 9.95 ? 2 : 1)) + " mm";
}

QString withError(const Estimate& estimate, const QString& value) {
  return estimate.error ? MeasurePage::tr("%1 ± %2").arg(value, lengthText(*estimate.error)) : value;
}

}  // namespace

MeasurePage::MeasurePage(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setObjectName("panel");
  setAttribute(Qt::WA_StyledBackground);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(kGroupGap, kGap, kGroupGap, kGap);
  head->setSpacing(kGroupGap);
  auto* back = new QPushButton(tr("Back"), this);
  back->setToolTip(tr("Back without a change (Esc)"));
  connect(back, &QPushButton::clicked, this, &MeasurePage::left);
  auto* title = new QLabel(tr("Length of the mounted blade"), this);
  title->setFont(Theme::titleFont());
  blade_ = makeNote({}, this);
  blade_->setWordWrap(false);
  head->addWidget(back);
  head->addWidget(title);
  head->addStretch();
  head->addWidget(blade_);
  layout->addLayout(head);
  layout->addWidget(makeLine(this));

  auto* columns = new QHBoxLayout;
  columns->setContentsMargins(0, 0, 0, 0);
  columns->setSpacing(0);
  scroll_ = new QScrollArea(this);
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setFocusPolicy(Qt::NoFocus);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll_->setWidget(makeInput());
  columns->addWidget(scroll_);
  auto* line = new QFrame(this);
  line->setObjectName("vline");
  columns->addWidget(line);
  auto* right = new QVBoxLayout;
  right->setContentsMargins(0, 0, 0, 0);
  right->setSpacing(0);
  drawing_ = new MeasureDrawing(theme, this);
  right->addWidget(drawing_, 1);
  right->addWidget(makeLine(this));
  right->addWidget(makeAnswer());
  columns->addLayout(right, 1);
  layout->addLayout(columns, 1);

  connect(table_, &MeasureTable::edited, this, &MeasurePage::refresh);
  connect(table_, &MeasureTable::chosenChanged, this, &MeasurePage::refresh);
  connect(&bench.document(), &model::Document::designChanged, this, [this] {
    if (entered_) refresh();
  });
  connect(&bench.document(), &model::Document::replaced, this, [this] {
    if (entered_) refresh();
  });
  connect(&theme, &Theme::changed, this, [this] {
    if (entered_) refresh();
  });
}

QWidget* MeasurePage::makeInput() {
  auto* page = new QWidget;
  page->setObjectName("page");
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(kGroupGap, kGroupGap, kGroupGap, kGroupGap);
  layout->setSpacing(kGap);
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
    auto* field = new NumberField(range);
    field->setKeyboardTracking(true);
    field->setSpecialValueText(tr("unknown"));
    sure->add(name, field, tip);
    connect(field, &NumberField::edited, this, &MeasurePage::refresh);
    return field;
  };
  heightError_ =
      error(tr("Error of the height"), {0, 1000, 3, 0.1, "mm"}, tr("Two readings in three err by less"));
  angleError_ = error(tr("Error of the angle"), {0, 45, 3, 0.1, QString(QChar(0xb0))},
                      tr("Two readings in three err by less"));
  distanceError_ =
      error(tr("Error of the distance"), {0, 1000, 3, 0.1, "mm"}, tr("Two readings in three err by less"));
  const auto offset = [&](const QString& name, const QString& tip) {
    auto* box = new QCheckBox(name);
    box->setToolTip(tip);
    sure->addWide(box);
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

QWidget* MeasurePage::makeAnswer() {
  auto* page = new QWidget(this);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(kGroupGap, kGroupGap, kGroupGap, kGroupGap);
  layout->setSpacing(kGap);
  auto* told = new QHBoxLayout;
  told->setSpacing(kGap);
  icon_ = new QLabel(page);
  icon_->setFixedSize(20, 20);
  message_ = new QLabel(page);
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  message_->setAccessibleName(tr("What is wrong"));
  told->addWidget(icon_, 0, Qt::AlignTop);
  told->addWidget(message_, 1);

  auto* columns = new QHBoxLayout;
  columns->setSpacing(kStepGap);
  auto* common = new QVBoxLayout;
  common->setSpacing(4);
  auto* name = new QLabel(tr("Blade length at the cut"), page);
  name->setObjectName("secondary");
  length_ = new QLabel(page);
  QFont big = Theme::bodyFont();
  big.setPointSize(22);
  big.setWeight(QFont::DemiBold);
  length_->setFont(big);
  length_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  length_->setAccessibleName(tr("Blade length at the cut"));
  common->addWidget(name);
  common->addWidget(length_);
  const auto small = [&](const QString& accessible) {
    QLabel* label = makeNote({}, page);
    label->setAccessibleName(accessible);
    common->addWidget(label);
    return label;
  };
  interval_ = small(tr("Confidence interval"));
  reference_ = small(tr("Length when cold"));
  fit_ = small(tr("Agreement of the measurements"));
  common->addStretch();
  use_ = new QPushButton(tr("Use for this design"), page);
  use_->setObjectName("primary");
  use_->setToolTip(tr("Stores the length in the blade of the design; can be undone"));
  connect(use_, &QPushButton::clicked, this, &MeasurePage::use);
  auto* useLine = new QHBoxLayout;
  useLine->addWidget(use_);
  useLine->addStretch();
  common->addSpacing(kGap);
  common->addLayout(useLine);
  useNote_ = makeNote({}, page);
  common->addWidget(useNote_);
  columns->addLayout(common, 1);

  auto* single = new FormColumn(page);
  one_ = single->addHeading({});
  case_ = single->addValue(tr("Shape"),
                           tr("The four shapes of a blade held by both ends, from slack (A) to taut (D)"));
  byHeight_ =
      single->addValue(tr("1 mm more height"), tr("How much the length changes with the height measured"));
  byAngle_ =
      single->addValue(tr("1° more angle"), tr("How much the length changes with the angle of both grips"));
  byDistance_ =
      single->addValue(tr("1 mm more distance"), tr("How much the length changes with the distance"));
  radius_ = single->addValue(tr("Tightest radius"), tr("Of the blade as measured"));
  single->addGap(0);
  auto* singleColumn = new QVBoxLayout;
  singleColumn->addWidget(single);
  singleColumn->addStretch();
  columns->addLayout(singleColumn, 1);
  layout->addLayout(told);
  layout->addLayout(columns);
  return page;
}

void MeasurePage::enter() {
  if (!entered_) {
    entered_ = true;
    const Blade& blade = bench_.job().blade;
    table_->setRows({{std::max(1.0, std::round(kFirstDistance * blade.length)), fromDegrees(kFirstAngle), 0,
                      blade.temperature}});
  }
  constexpr int kScrollBar = 10;
  scroll_->setFixedWidth(table_->minimumSizeHint().width() + 2 * kGroupGap + kScrollBar);
  refresh();
}

double MeasurePage::storedLength() const { return kStep * std::round(outcome_.length->length.value / kStep); }

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
  const Blade& blade = bench_.job().blade;
  outcome_ = evaluateSheet(sheet, blade);
  table_->setOutcome(outcome_);
  blade_->setText(tr("%1, %2 long, %3 °C at the cut, expands %4·10⁻⁶/K")
                      .arg(QString::fromStdString(blade.title.empty() ? blade.name : blade.title),
                           lengthText(blade.length), QString::fromStdString(shortText(blade.temperature, 4)),
                           QString::fromStdString(shortText(1e6 * blade.thermalExpansion, 3))));
  refreshDrawing();
  refreshNumbers();
  tellProblem();
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

void MeasurePage::refreshNumbers() {
  const auto& length = outcome_.length;
  length_->setText(length ? QString::fromStdString(fixedText(length->length.value, 2)) + " mm" : dash());
  if (!length)
    interval_->setText(outcome_.measured == 0 ? tr("Type a height, and the length follows.") : QString());
  else if (length->length.error)
    interval_->setText(tr("95 % sure: %1 to %2 mm")
                           .arg(QString::fromStdString(fixedText(*length->length.low, 2)),
                                QString::fromStdString(fixedText(*length->length.high, 2))));
  else
    interval_->setText(tr("Further measurements, or the errors of the readings, tell how sure this is."));
  reference_->setText(
      length ? tr("%1 mm at 20 °C").arg(QString::fromStdString(fixedText(length->reference.value, 2)))
             : QString());
  reference_->setVisible(length.has_value());
  QStringList fit;
  if (length && length->degreesOfFreedom > 0) {
    fit << (length->plausibility ? tr("The errors given explain the scatter (%1 % chance)")
                                       .arg(std::lround(100 * *length->plausibility))
                                 : tr("Heights scatter by %1").arg(lengthText(length->sigma)));
  }
  if (length && length->heightOffset)
    fit << tr("Heights read too much by %1")
               .arg(withError(*length->heightOffset, lengthText(length->heightOffset->value)));
  if (length && length->angleOffset) {
    const Estimate& offset = *length->angleOffset;
    QString value = QString::fromStdString(fixedText(toDegrees(offset.value), 2)) + QChar(0xb0);
    if (offset.error)
      value += tr(" ± %1°").arg(QString::fromStdString(fixedText(toDegrees(*offset.error), 2)));
    fit << tr("Angles read too much by %1").arg(value);
  }
  fit_->setText(fit.join('\n'));
  fit_->setVisible(!fit.isEmpty());

  const bool open = !bench_.document().empty();
  const bool fits = length && storedLength() >= kShortest && storedLength() <= kLongest;
  use_->setEnabled(open && fits);
  if (!open)
    useNote_->setText(tr("Open a surface or a design to use the length there."));
  else if (length && !fits)
    useNote_->setText(tr("A design takes blades of %1 to %2 mm.").arg(kShortest).arg(kLongest));
  else if (length && storedLength() != bench_.job().blade.length)
    useNote_->setText(tr("Makes the blade %1 %2.")
                          .arg(lengthText(std::abs(storedLength() - bench_.job().blade.length)),
                               storedLength() > bench_.job().blade.length ? tr("longer") : tr("shorter")));
  else
    useNote_->setText(length ? tr("The design has this length.") : QString());

  const auto row = std::size_t(table_->chosen());
  const RowOutcome& out = outcome_.rows[row];
  one_->setText(tr("Measurement %1 alone").arg(row + 1));
  const bool hinged = ends_->currentIndex() == 1;
  case_->setText(out.measured ? caseText(out.measured->letter) : dash());
  byHeight_->setText(out.measured ? changeText(out.measured->byHeight) : dash());
  byAngle_->setText(out.measured && !hinged ? changeText(fromDegrees(out.measured->byAngle)) : dash());
  byDistance_->setText(out.measured ? changeText(out.measured->byDistance) : dash());
  radius_->setText(out.measured && out.measured->elastica.maxCurvature() > 0
                       ? radiusText(1 / out.measured->elastica.maxCurvature())
                       : dash());
}

void MeasurePage::tellProblem() {
  Severity severity = Severity::warning;
  QString text;
  const double limit = bench_.job().blade.minRadius();
  if (!outcome_.problem.isEmpty()) {
    severity = Severity::error;
    text = outcome_.problem;
  } else {
    for (std::size_t i = 0; i < outcome_.rows.size() && text.isEmpty(); ++i) {
      const auto& measured = outcome_.rows[i].measured;
      if (!measured) continue;
      if (!measured->stable)
        text =
            tr("Measurement %1: a blade held like this does not rest in this shape; measure with less sag.")
                .arg(i + 1);
      else if (measured->elastica.maxCurvature() * limit > 1)
        text = tr("Measurement %1: a radius of %2 bends the blade for good, its limit is %3; measure with "
                  "the ends further apart.")
                   .arg(i + 1)
                   .arg(radiusText(1 / measured->elastica.maxCurvature()), radiusText(limit));
    }
    if (text.isEmpty() && outcome_.length && outcome_.length->plausibility &&
        *outcome_.length->plausibility < kImplausible)
      text =
          tr("The measurements differ more than the errors given allow; check the one that is furthest off.");
  }
  message_->setText(text);
  message_->setVisible(!text.isEmpty());
  icon_->setVisible(!text.isEmpty());
  icon_->setPixmap(theme_.pixmap(severityIcon(severity), severityColour(severity, theme_.colours())));
}

void MeasurePage::use() {
  if (!outcome_.length || bench_.document().empty()) return;
  const double length = storedLength(), before = bench_.job().blade.length;
  if (length != before) {
    bench_.editJob(tr("Use measured blade length"), [length](Job& job) { job.blade.length = length; });
    bench_.tell(
        {Severity::info,
         tr("The blade is now %1 mm long; it was %2 mm.")
             .arg(QString::fromStdString(shortText(length, 8)), QString::fromStdString(shortText(before, 8))),
         {},
         {}});
  }
  emit left();
}

void MeasurePage::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape)
    emit left();
  else
    QWidget::keyPressEvent(event);
}

}  // namespace bw::app
