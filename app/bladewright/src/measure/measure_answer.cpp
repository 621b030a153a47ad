// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "measure/measure_answer.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "controls/fields.h"
#include "controls/numbers.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr double kShortest = 10, kLongest = 20000;  // mm: lengths that a design takes
constexpr double kStep = 0.01;                      // mm: a design's length is stored so finely
constexpr double kImplausible = 0.01;               // chance below which the readings contradict their errors

QString dash() { return QStringLiteral("–"); }

/// How much the length changes for one unit more of a reading, with its sign.
QString changeText(double slope) {
  return (slope < 0 ? QString() : QStringLiteral("+")) +
         QString::fromStdString(fixedText(slope, std::abs(slope) < 9.95 ? 2 : 1)) + " mm";
}

/// True if the errors given do not allow for how much the readings differ.
bool implausible(const CalibrationResult& result) {
  return result.plausibility && *result.plausibility < kImplausible;
}

/// In percent; a chance that is next to none is told as that.
QString chanceText(double chance) {
  constexpr double kNone = 1e-3;
  return chance < kNone ? QStringLiteral("< 0.1") : QString::fromStdString(shortText(100 * chance, 2));
}

QString withError(const Estimate& estimate, const QString& value) {
  return estimate.error ? MeasureAnswer::tr("%1 ± %2").arg(value, lengthText(*estimate.error)) : value;
}

}  // namespace

MeasureAnswer::MeasureAnswer(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  auto* layout = makeBox<QVBoxLayout>(this, {kGroupGap, kGroupGap, kGroupGap, kGroupGap}, kGap);
  layout->addLayout(makeMessage());
  auto* columns = makeBox<QHBoxLayout>(nullptr, {}, kStepGap);
  columns->addLayout(makeCommon(), 1);
  columns->addLayout(makeSingle(), 1);
  layout->addLayout(columns);
}

QLayout* MeasureAnswer::makeMessage() {
  auto* told = makeBox<QHBoxLayout>(nullptr, {}, kGap);
  icon_ = new QLabel(this);
  icon_->setFixedSize(20, 20);
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  message_->setAccessibleName(tr("What is wrong"));
  told->addWidget(icon_, 0, Qt::AlignTop);
  told->addWidget(message_, 1);
  return told;
}

QLayout* MeasureAnswer::makeCommon() {
  auto* common = makeBox<QVBoxLayout>(nullptr, {}, 4);
  auto* name = new QLabel(tr("Blade length at the cut"), this);
  name->setObjectName("secondary");
  length_ = new QLabel(this);
  QFont big = Theme::bodyFont();
  big.setPointSize(22);
  big.setWeight(QFont::DemiBold);
  length_->setFont(big);
  length_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  length_->setAccessibleName(tr("Blade length at the cut"));
  common->addWidget(name);
  common->addWidget(length_);
  const auto small = [&](const QString& accessible) {
    QLabel* label = makeNote({}, this);
    label->setAccessibleName(accessible);
    common->addWidget(label);
    return label;
  };
  interval_ = small(tr("Confidence interval"));
  reference_ = small(tr("Length when cold"));
  fit_ = small(tr("Agreement of the measurements"));
  common->addStretch();
  use_ =
      makeButton(tr("Use for this design"), tr("Stores the length in the blade of the design; can be undone"),
                 this, &MeasureAnswer::use);
  use_->setObjectName("primary");
  auto* useLine = new QHBoxLayout;
  useLine->addWidget(use_);
  useLine->addStretch();
  common->addSpacing(kGap);
  common->addLayout(useLine);
  useNote_ = makeNote({}, this);
  common->addWidget(useNote_);
  return common;
}

QLayout* MeasureAnswer::makeSingle() {
  auto* single = new FormColumn(this);
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
  return singleColumn;
}

void MeasureAnswer::setOutcome(const MeasurementOutcome& outcome, int chosen, bool hinged, bool outdated) {
  outcome_ = outcome;
  outdated_ = outdated;
  for (QLabel* label : {length_, interval_, reference_, fit_}) label->setEnabled(!outdated);
  refreshCommon();
  refreshUse();
  refreshSingle(chosen, hinged);
  tellProblem();
}

double MeasureAnswer::storedLength() const {
  return kStep * std::round(outcome_.length->length.value / kStep);
}

void MeasureAnswer::refreshCommon() {
  const auto& length = outcome_.length;
  length_->setText(length ? QString::fromStdString(fixedText(length->length.value, 2)) + " mm" : dash());
  if (!length)
    interval_->setText(outcome_.measured == 0 ? tr("Type a height, and the length follows.") : QString());
  else if (length->length.error)
    interval_->setText((implausible(*length) ? tr("By the errors given, which do not hold: %1 to %2 mm")
                                             : tr("95 % sure: %1 to %2 mm"))
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
    fit << (length->plausibility
                ? (implausible(*length) ? tr("The errors given do not explain the scatter (%1 % chance)")
                                        : tr("The errors given explain the scatter (%1 % chance)"))
                      .arg(chanceText(*length->plausibility))
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
}

void MeasureAnswer::refreshUse() {
  const auto& length = outcome_.length;
  const bool open = !bench_.document().empty();
  const bool fits = length && storedLength() >= kShortest && storedLength() <= kLongest;
  use_->setEnabled(open && fits && !outdated_);
  if (outdated_)
    useNote_->setText(tr("The number marked red is not in it; mend that first, or take it back with Esc."));
  else if (!open)
    useNote_->setText(tr("Open a surface or a design to use the length there."));
  else if (length && !fits)
    useNote_->setText(tr("A design takes blades of %1 to %2 mm.").arg(kShortest).arg(kLongest));
  else if (length && storedLength() != bench_.design().blade.length)
    useNote_->setText(tr("Makes the blade %1 %2.")
                          .arg(lengthText(std::abs(storedLength() - bench_.design().blade.length)),
                               storedLength() > bench_.design().blade.length ? tr("longer") : tr("shorter")));
  else
    useNote_->setText(length ? tr("The design has this length.") : QString());
}

void MeasureAnswer::refreshSingle(int chosen, bool hinged) {
  const RowOutcome& out = outcome_.rows[std::size_t(chosen)];
  one_->setText(tr("Measurement %1 alone").arg(chosen + 1));
  case_->setText(out.measured ? caseText(out.measured->letter) : dash());
  byHeight_->setText(out.measured ? changeText(out.measured->byHeight) : dash());
  byAngle_->setText(out.measured && !hinged ? changeText(fromDegrees(out.measured->byAngle)) : dash());
  byDistance_->setText(out.measured ? changeText(out.measured->byDistance) : dash());
  radius_->setText(out.measured && out.measured->elastica.maxCurvature() > 0
                       ? radiusText(1 / out.measured->elastica.maxCurvature())
                       : dash());
}

void MeasureAnswer::tellProblem() {
  Severity severity = Severity::warning;
  QString text;
  const double limit = bench_.design().blade.minRadius();
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
    if (text.isEmpty() && outcome_.length && implausible(*outcome_.length))
      text =
          tr("The measurements differ more than the errors given allow; check the one that is furthest off.");
  }
  message_->setText(text);
  message_->setVisible(!text.isEmpty());
  icon_->setVisible(!text.isEmpty());
  icon_->setPixmap(theme_.pixmap(severityIcon(severity), severityColour(severity, theme_.colours())));
}

void MeasureAnswer::use() {
  if (!outcome_.length || bench_.document().empty()) return;
  const double length = storedLength(), before = bench_.design().blade.length;
  if (length != before) {
    bench_.editDesign(tr("Use measured blade length"), [length](Design& design) {
      design.blade.length = length;
      design.blade.autoLength = false;
    });
    bench_.tell(
        Topic::made, Severity::info,
        tr("The blade is now %1 mm long; it was %2 mm.")
            .arg(QString::fromStdString(shortText(length, 8)), QString::fromStdString(shortText(before, 8))));
  }
  emit used();
}

}  // namespace bw::app
