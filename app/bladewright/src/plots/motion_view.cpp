// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/motion_view.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "controls/paint.h"

namespace bw::app {

namespace {

constexpr int kLeft = 64, kRight = 16, kTop = 12, kAxis = 20;
constexpr int kFrameInterval = 16;  // ms
constexpr std::array<double, 4> kPaces = {1, 4, 10, 30};

}  // namespace

Timeline::Timeline(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Timeline"));
  setToolTip(tr("Drag to move the blade; arrow keys step from station to station"));
  setCursor(Qt::SizeHorCursor);
  connect(&bench, &Workbench::resultChanged, this, &Timeline::rebuild);
  connect(&bench, &Workbench::playTimeChanged, this, qOverload<>(&QWidget::update));
  connect(&bench, &Workbench::selectionChanged, this, qOverload<>(&QWidget::update));
  connect(&bench, &Workbench::stateChanged, this, qOverload<>(&QWidget::update));
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  rebuild();
}

void Timeline::rebuild() {
  samples_.clear();
  end_ = bench_.playEnd();
  if (const pipeline::SweepResult* result = bench_.sweep()) {
    const std::vector<StationNumbers> numbers = stationNumbers(*result);
    samples_.reserve(numbers.size());
    std::size_t i = 0;
    // Instants with a station come in the order of the stations.
    for (const MotionInstant& instant : result->motion.instants)
      if (instant.station >= 0 && i < numbers.size()) {
        samples_.push_back({instant.time, numbers[i].speedMin, numbers[i].speedMax, numbers[i].stress});
        ++i;
      }
  }
  update();
}

double Timeline::xOf(double seconds) const {
  return kLeft + (width() - kLeft - kRight) * (end_ > 0 ? seconds / end_ : 0);
}

double Timeline::timeAt(double x) const {
  return std::clamp((x - kLeft) / std::max(1, width() - kLeft - kRight), 0.0, 1.0) * end_;
}

void Timeline::paintPlot(QPainter& painter, const QRectF& area, const QString& title, const QString& unit,
                         double limit, const QString& limitText, double Sample::*low,
                         double Sample::*high) const {
  const Colours& c = theme_.colours();
  double highest = 0;
  for (const Sample& s : samples_) highest = std::max(highest, s.*high);
  const bool limitShown = limit < 2.5 * highest;
  const bool over = highest > limit * (1 + 1e-9);
  const double range = std::max(1.12 * std::max(highest, limitShown ? limit : 0.0), 1e-9);
  const auto y = [&](double v) { return area.bottom() - area.height() * v / range; };
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  const QColor colour = over && limitShown ? c.error : c.selection;
  QPolygonF upper, band;
  for (const Sample& s : samples_) upper << QPointF(xOf(s.time), y(s.*high));
  band = upper;
  for (auto s = samples_.rbegin(); s != samples_.rend(); ++s)
    band << QPointF(xOf(s->time), low ? y((*s).*low) : area.bottom());
  QColor shade = colour;
  shade.setAlphaF(0.14f);
  painter.setPen(Qt::NoPen);
  painter.setBrush(shade);
  painter.drawPolygon(band);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colour, 1.5));
  painter.drawPolyline(upper);
  const QFontMetrics metrics(painter.font());
  if (limitShown) {
    painter.setPen(QPen(over ? c.error : c.secondary, 1, Qt::DashLine));
    painter.drawLine(QPointF(area.left(), y(limit)), QPointF(area.right(), y(limit)));
    painter.setPen(over ? c.error : c.secondary);
    painter.drawText(QRectF(area.left() + 4, y(limit) + 1, area.width() - 8, metrics.height()),
                     Qt::AlignRight, limitText);
  }
  painter.setPen(c.secondary);
  const QRectF margin(0, area.top() - 2, kLeft - 8, area.height() + 4);
  painter.drawText(margin, Qt::AlignRight | Qt::AlignTop, title);
  const QString value = QString::fromStdString(shortText(highest, 3));
  if (area.height() > 2.4 * metrics.height())
    painter.drawText(margin.translated(0, metrics.height()), Qt::AlignRight | Qt::AlignTop, value);
  if (area.height() > 3.4 * metrics.height())
    painter.drawText(margin.translated(0, 2 * metrics.height()), Qt::AlignRight | Qt::AlignTop, unit);
}

void Timeline::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), c.panel);
  painter.setFont(Theme::secondaryFont());
  if (samples_.size() < 2 || end_ <= 0) {
    painter.setPen(c.secondary);
    painter.setFont(Theme::bodyFont());
    painter.drawText(rect(), Qt::AlignCenter, tr("The motion stands here as soon as a result is there."));
    return;
  }
  if (bench_.stale()) painter.setOpacity(kStaleOpacity);
  const double height = this->height() - kTop - kAxis;
  const double gap = 8;
  const double half = (height - gap) / 2;
  const double plotWidth = width() - kLeft - kRight;
  const Blade& blade = bench_.sweep()->sweep.blade;
  const double allowed = blade.yieldStress / blade.safety;
  paintPlot(painter, {double(kLeft), double(kTop), plotWidth, half}, tr("Speed"), "mm/s", 1e18, {},
            &Sample::speedMin, &Sample::speedMax);
  paintPlot(painter, {kLeft, kTop + half + gap, plotWidth, half}, tr("Stress"), "N/mm²", allowed,
            tr("limit %1").arg(std::lround(allowed)), nullptr, &Sample::stress);

  // Time axis.
  const QFontMetrics metrics(painter.font());
  painter.setPen(c.secondary);
  const double step = std::max(roundBelow(end_ / 5), 0.1);
  for (double t = 0; t <= end_ + 1e-9; t += step) {
    const double x = xOf(t);
    painter.drawLine(QPointF(x, kTop + height), QPointF(x, kTop + height + 3));
    const QString text = step >= 1 ? timeText(t).chopped(2) : timeText(t);
    painter.drawText(QRectF(x - 40, kTop + height + 3, 80, metrics.height()), Qt::AlignHCenter, text);
  }
  if (bench_.selection().station >= 0) {
    const double x = xOf(bench_.timeOfStation(bench_.selection().station));
    painter.setPen(QPen(c.selection, 1, Qt::DashLine));
    painter.drawLine(QPointF(x, kTop), QPointF(x, kTop + height));
  }
  const double x = xOf(bench_.playTime());
  painter.setOpacity(1);
  painter.setPen(QPen(c.accent, 1.5));
  painter.drawLine(QPointF(x, kTop), QPointF(x, kTop + height));
  painter.setBrush(c.accent);
  painter.setPen(Qt::NoPen);
  // Its handle stands above the plots, clear of the times below.
  painter.drawPolygon(QPolygonF() << QPointF(x - 5, kTop - 10) << QPointF(x + 5, kTop - 10)
                                  << QPointF(x + 5, kTop - 5) << QPointF(x, kTop)
                                  << QPointF(x - 5, kTop - 5));
  if (hasFocus()) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(c.selection, 1));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

void Timeline::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) bench_.setPlayTime(timeAt(event->position().x()));
}

void Timeline::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) bench_.setPlayTime(timeAt(event->position().x()));
}

bool Timeline::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Home || key == Qt::Key_End)
      event->accept();
  }
  return QWidget::event(event);
}

void Timeline::keyPressEvent(QKeyEvent* event) {
  const int station = int(std::lround(bench_.stationAt(bench_.playTime())));
  if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
    const pipeline::SweepResult* result = bench_.sweep();
    if (!result) return;
    const int next = std::clamp(station + (event->key() == Qt::Key_Right ? 1 : -1), 0,
                                int(result->sweep.stations.size()) - 1);
    bench_.setPlayTime(bench_.timeOfStation(next));
  } else if (event->key() == Qt::Key_Home) {
    bench_.setPlayTime(0);
  } else if (event->key() == Qt::Key_End) {
    bench_.setPlayTime(end_);
  } else {
    QWidget::keyPressEvent(event);
  }
}

MotionView::MotionView(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme), timeline_(new Timeline(bench, theme, this)) {
  setObjectName("panel");
  setAttribute(Qt::WA_StyledBackground);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 4, 0, 0);
  layout->setSpacing(4);
  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(8, 0, 12, 0);
  bar->setSpacing(2);
  const auto button = [&](const char* icon, const QString& tip, const std::function<void()>& press) {
    auto* b = new QToolButton(this);
    b->setProperty("iconName", QString(icon));
    b->setToolTip(tip);
    b->setAccessibleName(tip);
    connect(b, &QToolButton::clicked, this, press);
    bar->addWidget(b);
    buttons_ << b;
    return b;
  };
  button("to-start", tr("To the start"), [this] { goTo(0); });
  button("step-back", tr("Station before"), [this] { stepStation(-1); });
  play_ = button("play", tr("Play or pause (Space)"), [this] { togglePlay(); });
  button("step-forward", tr("Next station"), [this] { stepStation(1); });
  button("to-end", tr("To the end"), [this] { goTo(bench_.playEnd()); });
  bar->addSpacing(kGap);
  clock_ = new QLabel(this);
  clock_->setMinimumWidth(130);
  bar->addWidget(clock_);
  bar->addStretch();
  blade_ = new QCheckBox(tr("Show the blade"), this);
  blade_->setToolTip(tr("The moving blade in the picture"));
  connect(blade_, &QCheckBox::clicked, &bench, &Workbench::setMoving);
  bar->addWidget(blade_);
  bar->addSpacing(kGroupGap);
  auto* paceLabel = new QLabel(tr("Pace"), this);
  bar->addWidget(paceLabel);
  bar->addSpacing(4);
  pace_ = new ChoiceField(this);
  pace_->setMinimumWidth(72);
  pace_->setMinimumContentsLength(3);
  for (double pace : kPaces) pace_->addItem(QStringLiteral("%1×").arg(pace));
  pace_->setCurrentIndex(2);
  pace_->setToolTip(tr("Times faster than the cut"));
  pace_->setAccessibleName(tr("Pace"));
  paceLabel->setBuddy(pace_);
  bar->addWidget(pace_);
  layout->addLayout(bar);
  layout->addWidget(timeline_, 1);

  timer_.setInterval(kFrameInterval);
  connect(&timer_, &QTimer::timeout, this, &MotionView::tick);
  connect(&bench, &Workbench::playTimeChanged, this, &MotionView::refresh);
  connect(&bench, &Workbench::resultChanged, this, &MotionView::refresh);
  connect(&theme, &Theme::changed, this, &MotionView::refresh);
  refresh();
}

void MotionView::togglePlay() {
  if (timer_.isActive()) {
    timer_.stop();
  } else if (bench_.playEnd() > 0) {
    if (bench_.playTime() >= bench_.playEnd()) bench_.setPlayTime(0);
    bench_.setMoving(true);
    elapsed_.start();
    timer_.start();
  }
  refresh();
}

void MotionView::tick() {
  const double seconds =
      double(elapsed_.restart()) / 1000 * kPaces[std::size_t(std::max(0, pace_->currentIndex()))];
  bench_.setPlayTime(bench_.playTime() + seconds);
  if (bench_.playTime() >= bench_.playEnd()) timer_.stop();
  refresh();
}

void MotionView::stepStation(int by) {
  const pipeline::SweepResult* result = bench_.sweep();
  if (!result) return;
  const double at = bench_.stationAt(bench_.playTime());
  const int from = by > 0 ? int(std::floor(at + 1e-6)) : int(std::ceil(at - 1e-6));
  goTo(bench_.timeOfStation(std::clamp(from + by, 0, int(result->sweep.stations.size()) - 1)));
}

void MotionView::goTo(double seconds) {
  bench_.setMoving(true);
  bench_.setPlayTime(seconds);
}

void MotionView::refresh() {
  const bool there = bench_.playEnd() > 0;
  if (!there) timer_.stop();
  for (QToolButton* b : buttons_) {
    const QString icon =
        b == play_ && playing() ? QStringLiteral("pause") : b->property("iconName").toString();
    if (b->property("shownIcon").toString() != icon + (theme_.dark() ? "d" : "l")) {
      b->setProperty("shownIcon", icon + (theme_.dark() ? "d" : "l"));
      b->setIcon(theme_.icon(icon));
    }
    b->setEnabled(there);
  }
  blade_->setChecked(bench_.moving());
  blade_->setEnabled(there);
  pace_->setEnabled(there);
  clock_->setText(there
                      ? QStringLiteral("%1 / %2").arg(timeText(bench_.playTime()), timeText(bench_.playEnd()))
                      : QString());
}

}  // namespace bw::app
