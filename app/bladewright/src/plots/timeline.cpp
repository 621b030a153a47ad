// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/timeline.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/station_times.h"
#include "bw/core/text/number_text.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr int kLeft = 64, kRight = 16, kTop = 12, kAxis = 20;
constexpr double kNotch = 0.8;         ///< zoom of one notch of the wheel
constexpr double kBarriersSeen = 4.5;  ///< of the least barrier: higher ones are told, not drawn

}  // namespace

Timeline::Timeline(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(tr("Timeline"));
  setAccessibleDescription(
      tr("Drag to move the blade, turn the wheel to zoom; arrow keys step from station to station"));
  setCursor(Qt::SizeHorCursor);
  connect(&bench, &Workbench::changed, this, &Timeline::follow);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  rebuild();
}

void Timeline::rebuild() {
  samples_.clear();
  // A change of the design keeps what is looked at, as a part of the whole.
  const double before = end_;
  end_ = bench_.playEnd();
  seen_ = before > 0 && end_ > 0 ? AxisRange{seen_.low * end_ / before, seen_.high * end_ / before}
                                 : AxisRange{0, end_};
  if (const auto result = bench_.sweep()) {
    const std::vector<StationNumbers> numbers = stationNumbers(*result);
    const std::vector<double> times = stationTimes(result->motion, result->sweep.poses);
    samples_.reserve(times.size());
    for (std::size_t i = 0; i < std::min(times.size(), numbers.size()); ++i)
      samples_.push_back({times[i], numbers[i].speedMin, numbers[i].speedMax, numbers[i].stress});
  }
  margins_.clear();
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  if (cut && cut->run.value)
    for (const SimulatedBlade& at : cut->run.value->blades) margins_ << QPointF(at.time, at.margin);
  barriers_.clear();
  bool goesOn = false;
  if (cut && cut->barriers.value)
    for (const BarrierLook& look : *cut->barriers.value) {
      if (look.barrier && !goesOn) barriers_.emplace_back();
      goesOn = look.barrier.has_value();
      if (goesOn) barriers_.back() << QPointF(look.time, *look.barrier);
    }
  update();
}

void Timeline::follow(const Change& change) {
  if (change.any(Aspect::motion | Aspect::checks | Aspect::thoughts, bench_.selection())) rebuild();
  // The playhead stays in sight.
  if (const double time = bench_.playTime();
      change.any(Aspect::playTime) && (time < seen_.low || time > seen_.high))
    seen_ = seen_.moved(time - 0.5 * (seen_.low + seen_.high), {0, end_});
  if (change.any(Aspect::playTime | Aspect::selection | Aspect::state)) update();
}

double Timeline::xOf(double seconds) const {
  return kLeft + (width() - kLeft - kRight) * (seen_.span() > 0 ? (seconds - seen_.low) / seen_.span() : 0);
}

double Timeline::timeAt(double x) const {
  return seen_.low + std::clamp((x - kLeft) / std::max(1, width() - kLeft - kRight), 0.0, 1.0) * seen_.span();
}

Timeline::Sample Timeline::at(double seconds) const {
  const auto after = std::ranges::lower_bound(samples_, seconds, {}, &Sample::time);
  if (after == samples_.begin()) return samples_.front();
  if (after == samples_.end()) return samples_.back();
  const Sample &a = *(after - 1), &b = *after;
  const double t = b.time > a.time ? (seconds - a.time) / (b.time - a.time) : 0;
  return {seconds, std::lerp(a.speedMin, b.speedMin, t), std::lerp(a.speedMax, b.speedMax, t),
          std::lerp(a.stress, b.stress, t)};
}

std::optional<double> Timeline::barrierAt(double seconds) const {
  constexpr double kNear = 4;  // px
  for (const QPolygonF& part : barriers_) {
    const auto after = std::ranges::lower_bound(part, seconds, {}, &QPointF::x);
    if (after != part.begin() && after != part.end()) {
      const QPointF &a = *(after - 1), &b = *after;
      return std::lerp(a.y(), b.y(), (seconds - a.x()) / (b.x() - a.x()));
    }
    const QPointF& nearest = after == part.end() ? part.back() : part.front();
    if (std::abs(xOf(nearest.x()) - xOf(seconds)) <= kNear) return nearest.y();
  }
  return {};
}

QStringList Timeline::readout() const {
  if (cursor_ < kLeft || cursor_ > width() - kRight || samples_.size() < 2) return {};
  const double time = timeAt(cursor_);
  const Sample sample = at(time);
  const double station = bench_.stationAt(time);
  QStringList lines = {
      station < 0 ? timeText(time) : tr("%1, station %2").arg(timeText(time)).arg(std::lround(station) + 1),
      tr("%1 to %2").arg(speedText(sample.speedMin), speedText(sample.speedMax)),
      tr("%1 N/mm²").arg(std::lround(sample.stress))};
  if (const auto after = std::ranges::lower_bound(margins_, time, {}, &QPointF::x); after != margins_.end()) {
    const QPointF& at = *after;
    lines << tr("margin %1").arg(QString::fromStdString(shortText(at.y(), 2)));
  }
  if (const std::optional<double> barrier = barrierAt(time))
    lines << tr("barrier %1 N mm").arg(QString::fromStdString(shortText(*barrier, 2)));
  return lines;
}

void Timeline::zoom(double about, double factor) {
  seen_ = seen_.zoomed(about, factor, {0, end_});
  update();
}

std::vector<Timeline::Track> Timeline::tracks() const {
  const pipeline::CutResult result = *bench_.sweep();
  const Blade& blade = result.sweep.request.blade;
  const double allowed = blade.yieldStress / blade.safety;
  Track speed{tr("Speed, mm/s"), {{}}};
  Track stress{tr("Stress, N/mm²"), {{}}, {}, allowed, false, tr("limit %1").arg(std::lround(allowed))};
  for (const Sample& s : samples_) {
    speed.high.front() << QPointF(s.time, s.speedMax);
    speed.low << QPointF(s.time, s.speedMin);
    stress.high.front() << QPointF(s.time, s.stress);
  }
  std::vector<Track> all = {std::move(speed), std::move(stress)};
  const double least = bench_.design().process.margin;
  if (!margins_.isEmpty())
    all.push_back({tr("Stability margin"),
                   {margins_},
                   {},
                   least,
                   true,
                   tr("least %1").arg(QString::fromStdString(shortText(least, 2)))});
  if (!barriers_.empty())
    all.push_back({tr("Energy barrier, N mm"),
                   barriers_,
                   {},
                   kLeastBarrier,
                   true,
                   tr("least %1").arg(QString::fromStdString(shortText(kLeastBarrier))),
                   true,
                   kBarriersSeen * kLeastBarrier});
  return all;
}

void Timeline::paintPlot(QPainter& painter, const QRectF& area, const Track& track) const {
  const Colours& c = theme_.colours();
  double highest = 0, lowest = std::numeric_limits<double>::infinity();
  for (const QPolygonF& line : track.high)
    for (const QPointF& p : line) {
      highest = std::max(highest, p.y());
      lowest = std::min(lowest, p.y());
    }
  const double limit = track.limit.value_or(0);
  const bool limitShown = track.limit && (track.least || limit < 2.5 * highest);
  const bool over = track.limit && (track.least ? lowest < limit * (1 - 1e-9) : highest > limit * (1 + 1e-9));
  // What is nothing beside its limit, as the stress of a blade that is held straight, looks so.
  constexpr double kNothing = 0.02, kSmallest = 1e-3;
  const double range = std::max(
      {1.12 * std::max(std::min(highest, track.top), limitShown ? limit : 0.0), kNothing * limit, kSmallest});
  const auto y = [&](double v) { return area.bottom() - area.height() * v / range; };
  const auto placed = [&](const QPointF& p) { return QPointF(xOf(p.x()), y(p.y())); };
  paintLeftAxis(painter, area, {0, range}, c, true);
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  const QColor colour = over && limitShown ? c.error : c.selection;
  QColor shade = colour;
  shade.setAlphaF(0.14f);
  painter.save();
  painter.setClipRect(area.adjusted(0, -1, 0, 1));
  for (const QPolygonF& line : track.high) {
    QPolygonF upper;
    for (const QPointF& p : line) upper << placed(p);
    QPolygonF band = upper;
    if (track.low.isEmpty())
      band << QPointF(upper.back().x(), area.bottom()) << QPointF(upper.front().x(), area.bottom());
    for (auto p = track.low.rbegin(); p != track.low.rend(); ++p) band << placed(*p);
    painter.setPen(Qt::NoPen);
    painter.setBrush(shade);
    painter.drawPolygon(band);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colour, 1.5));
    painter.drawPolyline(upper);
    if (!track.dots) continue;
    painter.setBrush(colour);
    for (const QPointF& p : upper) painter.drawEllipse(p, 1.5, 1.5);
  }
  painter.restore();
  const QFontMetrics metrics(painter.font());
  if (limitShown) {
    painter.setPen(QPen(over ? c.error : c.secondary, 1, Qt::DashLine));
    painter.drawLine(QPointF(area.left(), y(limit)), QPointF(area.right(), y(limit)));
    painter.setPen(over ? c.error : c.secondary);
    const bool below = y(limit) + 1 + metrics.height() <= area.bottom();
    painter.drawText(QRectF(area.left() + 4, below ? y(limit) + 1 : y(limit) - 1 - metrics.height(),
                            area.width() - 8, metrics.height()),
                     Qt::AlignRight, track.limitText);
  }
  // On a card of its own, so that the grid does not run through it.
  const QRectF name(area.left() + 3, area.top(), metrics.horizontalAdvance(track.title) + 6,
                    metrics.height());
  QColor card = c.panel;
  card.setAlphaF(0.8f);
  painter.fillRect(name, card);
  painter.setPen(c.secondary);
  painter.drawText(name, Qt::AlignCenter, track.title);
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
  if (bench_.stale() || bench_.sketch()) painter.setOpacity(kStaleOpacity);
  const double height = this->height() - kTop - kAxis;
  const double gap = 8;
  const std::vector<Track> all = tracks();
  const double each = (height - gap * double(all.size() - 1)) / double(all.size());
  const double plotWidth = width() - kLeft - kRight;
  for (std::size_t i = 0; i < all.size(); ++i)
    paintPlot(painter, {double(kLeft), kTop + double(i) * (each + gap), plotWidth, each}, all[i]);

  // Time axis.
  const QFontMetrics metrics(painter.font());
  painter.setPen(c.secondary);
  const double step = std::max(roundBelow(seen_.span() / 5), 0.1);
  for (double t = step * std::ceil(seen_.low / step - 1e-9); t <= seen_.high + 1e-9; t += step) {
    const double x = xOf(t);
    painter.drawLine(QPointF(x, kTop + height), QPointF(x, kTop + height + 3));
    const QString text = step >= 1 ? timeText(t).chopped(2) : timeText(t);
    painter.drawText(QRectF(x - 40, kTop + height + 3, 80, metrics.height()), Qt::AlignHCenter, text);
  }
  painter.setClipRect(QRectF(kLeft - 6, 0, plotWidth + 12, kTop + height));
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
  painter.setClipping(false);
  if (const QStringList lines = readout(); !lines.isEmpty()) {
    painter.setPen(QPen(c.secondary, 1, Qt::DotLine));
    painter.drawLine(QPointF(cursor_, kTop), QPointF(cursor_, kTop + height));
    paintReadout(painter, {cursor_, kTop + 0.5 * height}, QRectF(rect()).adjusted(2, 2, -2, -2), lines, c);
  }
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
  cursor_ = event->buttons() & Qt::LeftButton ? -1 : event->position().x();
  if (event->buttons() & Qt::LeftButton) bench_.setPlayTime(timeAt(event->position().x()));
  update();
}

void Timeline::mouseDoubleClickEvent(QMouseEvent*) {
  seen_ = {0, end_};
  update();
}

void Timeline::leaveEvent(QEvent*) {
  cursor_ = -1;
  update();
}

void Timeline::wheelEvent(QWheelEvent* event) {
  event->accept();
  // With Shift some platforms turn the wheel's way by themselves.
  const double across = event->angleDelta().x() / 120.0, notches = event->angleDelta().y() / 120.0;
  if (event->modifiers() & Qt::ShiftModifier || std::abs(across) > std::abs(notches)) {
    seen_ = seen_.moved(-0.1 * (across + (across == 0 ? notches : 0)) * seen_.span(), {0, end_});
    return update();
  }
  zoom(timeAt(event->position().x()), std::pow(kNotch, notches));
}

bool Timeline::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Home || key == Qt::Key_End ||
        key == Qt::Key_Plus || key == Qt::Key_Minus || key == Qt::Key_0)
      event->accept();
  }
  return QWidget::event(event);
}

void Timeline::keyPressEvent(QKeyEvent* event) {
  const int station = int(std::lround(bench_.stationAt(bench_.playTime())));
  if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
    const auto result = bench_.sweep();
    if (!result) return;
    const int next = std::clamp(station + (event->key() == Qt::Key_Right ? 1 : -1), 0,
                                int(result->sweep.poses.size()) - 1);
    bench_.setPlayTime(bench_.timeOfStation(next));
  } else if (event->key() == Qt::Key_Home) {
    bench_.setPlayTime(0);
  } else if (event->key() == Qt::Key_End) {
    bench_.setPlayTime(end_);
  } else if (event->key() == Qt::Key_Plus || event->key() == Qt::Key_Minus) {
    zoom(bench_.playTime(), event->key() == Qt::Key_Plus ? kNotch : 1 / kNotch);
  } else if (event->key() == Qt::Key_0) {
    zoom(0, 1e9);
  } else {
    QWidget::keyPressEvent(event);
  }
}

}  // namespace bw::app
