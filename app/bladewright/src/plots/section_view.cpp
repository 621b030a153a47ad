// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/section_view.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr int kMargin = 12;
constexpr int kAxisLeft = 40;   ///< room for the numbers of a vertical axis
constexpr int kAxisBelow = 16;  ///< and of a horizontal one

/// As many words as there is room for.
QString curvatureTitle(const QFontMetrics& metrics, double width, const QString& limit) {
  for (const QString& text :
       {SectionView::tr("Curvature along the blade in 1/m, limit 1/%1").arg(limit),
        SectionView::tr("Curvature in 1/m, limit 1/%1").arg(limit), SectionView::tr("Curvature, 1/m")})
    if (metrics.horizontalAdvance(text) <= width) return text;
  return {};
}

}  // namespace

SectionView::SectionView(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(tr("Section view"));
  connect(&bench, &Workbench::changed, this, &SectionView::follow);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  rebuild();
}

void SectionView::follow(const Change& change) {
  if (change.any(Aspect::poses | Aspect::motion | Aspect::checks | Aspect::sketch, bench_.selection()))
    return rebuild();
  if (change.any(Aspect::selection | Aspect::playTime)) return rebuildDrawing();
  if (change.any(Aspect::state)) update();
}

void SectionView::setExaggeration(double factor) {
  exaggeration_ = factor;
  rebuildDrawing();
}

int SectionView::shownStation() const {
  if (bench_.selection().station >= 0) return bench_.selection().station;
  const double at = bench_.stationAt(bench_.playTime());
  return at < 0 ? -1 : int(std::lround(at));
}

void SectionView::rebuild() {
  numbers_.clear();
  if (const pipeline::CutSketch* sketch = bench_.sketchedCut())
    numbers_ = stationNumbers(*sketch);
  else if (const auto result = bench_.sweep())
    numbers_ = stationNumbers(*result);
  tolerance_ = bench_.design().process.tolerance;
  drawing_.station = -1;
  rebuildDrawing();
}

void SectionView::rebuildDrawing() {
  const AxisRange before = wholeAlong();
  drawing_ = {};
  if (const Sweep* row = bench_.row()) {
    const int station = std::min(shownStation(), int(row->poses.size()) - 1);
    // The other shape is sought once the hand rests.
    const auto result = bench_.sketchedCut() ? std::nullopt : bench_.sweep();
    const std::optional<OtherRest>* other =
        result && station >= 0 ? &result->certainty.stations[std::size_t(station)].other : nullptr;
    drawing_ = makeSectionDrawing(*row, other && *other ? &**other : nullptr, station, exaggeration_);
  }
  // The zoom stays from station to station, as long as there is something in it.
  if (drawing_.station < 0 || !window_.intersects(drawing_.bounds)) window_ = {};
  if (wholeAlong() != before) along_ = wholeAlong();
  update();
}

QRectF SectionView::sectionArea() const {
  const QRectF plot = curvatureArea();
  const double left = kMargin + kAxisLeft, right = plot.left() - kAxisLeft - kMargin;
  return {left, plot.top(), right - left, plot.height()};
}

QRectF SectionView::curvatureArea() const {
  const double line = QFontMetrics(Theme::secondaryFont()).height();
  const double plotWidth = std::clamp(0.34 * width(), 180.0, 420.0) - kAxisLeft;
  const double top = kBarsHeight + 8 + 2 * line, bottom = height() - kMargin - kAxisBelow;
  return {width() - kMargin - plotWidth, top, plotWidth, std::max(0.0, bottom - top)};
}

SectionFrame SectionView::seen() const { return hold_ ? hold_->seen : frame(); }

SectionFrame SectionView::frame() const {
  constexpr double kGrip = 12;  // px beside the ends of the blade
  const QRectF area = sectionArea(), &all = drawing_.bounds;
  const double room = kGrip * all.width() / std::max(1.0, area.width() - 2 * kGrip);
  return {area, window_.isNull() ? all.adjusted(-room, 0, room, 0) : window_};
}

AxisRange SectionView::wholeAlong() const {
  return {0, drawing_.curvature.isEmpty() ? 0.0 : drawing_.curvature.back().x()};
}

SectionGrips SectionView::grips() const {
  const Sweep* row = bench_.row();
  if (!findGrips_ || !row || drawing_.station < 0) return {};
  // Each point belongs to the station that is next to it.
  const auto index = std::size_t(drawing_.station);
  const Frame& plane = row->poses[index].frame;
  double reach = 0;
  for (const std::size_t beside : {index - 1, index + 1})
    if (beside < row->poses.size())
      reach = std::max(reach, 0.5 * std::abs(plane.toLocal(row->poses[beside].frame.origin).z()));
  SectionGrips found = findGrips_(plane, reach);
  const auto show = [this](Eigen::Vector2d& place) {
    const QPointF shown = drawing_.plane.shown(place);
    place = {shown.x(), shown.y()};
  };
  for (SectionGrips::Grip& grip : found.grips) show(grip.place);
  for (Eigen::Vector2d& corner : found.region) show(corner);
  for (SectionGrips::Way& way : found.ways)
    for (Eigen::Vector2d* end : {&way.from, &way.to}) show(*end);
  for (SectionGrips::Meeting& meeting : found.meetings)
    for (Eigen::Vector2d* place : {&meeting.at, &meeting.from, &meeting.to}) show(*place);
  return found;
}

QPointF SectionView::placeOf(const SectionGrips::Grip& grip) const {
  return seen().toArea.map(QPointF(grip.place.x(), grip.place.y()));
}

QStringList SectionView::readout() const {
  if (drawing_.station < 0 || cursor_.isNull()) return {};
  if (hold_) return grips().text.split('\n');
  if (sectionArea().contains(cursor_)) {
    const QPointF p = frame().toPlane(cursor_);
    const int decimals = frame().scale > 20 ? 2 : 1;
    QStringList lines = {tr("%1, %2 mm").arg(axisText(p.x(), decimals), axisText(p.y(), decimals))};
    const PlanarCurve& target = bench_.row()->fits[std::size_t(drawing_.station)].target;
    const Eigen::Vector2d at = drawing_.plane.inPlane(p);
    const Eigen::Vector2d foot = target.value(target.nearestParameter(at));
    lines << tr("%1 from the target").arg(lengthText((at - foot).norm() / exaggeration_));
    return lines;
  }
  if (curvatureArea().contains(cursor_)) {
    const QRectF area = curvatureArea();
    const double arc = along_.low + along_.span() * (cursor_.x() - area.left()) / area.width();
    Elastica::State state;
    const BladePose& pose = bench_.row()->poses[std::size_t(drawing_.station)];
    const double own = drawing_.plane.mirrored() ? pose.blade.length() - arc : arc;
    pose.at({&own, 1}, {&state, 1});
    const double curvature = state.curvature;
    return {
        tr("%1 along the blade").arg(lengthText(arc)),
        tr("%1 1/m, radius %2")
            .arg(axisText(1000 * curvature, 3), radiusText(curvature == 0 ? 1e12 : 1 / std::abs(curvature)))};
  }
  return {};
}

void SectionView::paintCursor(QPainter& painter) const {
  const QStringList lines = readout();
  if (lines.isEmpty() || !grabbed_.isNull()) return;
  const Colours& c = theme_.colours();
  if (hold_) return paintReadout(painter, cursor_, QRectF(rect()).adjusted(2, 2, -2, -2), lines, c);
  painter.setPen(QPen(c.secondary, 1, Qt::DotLine));
  const QRectF area = sectionArea().contains(cursor_) ? sectionArea() : curvatureArea();
  painter.drawLine(QPointF(cursor_.x(), area.top()), QPointF(cursor_.x(), area.bottom()));
  if (sectionArea().contains(cursor_))
    painter.drawLine(QPointF(area.left(), cursor_.y()), QPointF(area.right(), cursor_.y()));
  paintReadout(painter, cursor_, QRectF(rect()).adjusted(2, 2, -2, -2), lines, c);
}

QRectF SectionView::barRect(int station) const {
  const int count = int(numbers_.size());
  if (station < 0 || station >= count) return {};
  const double width = double(this->width() - 2 * kMargin) / count;
  return {kMargin + station * width, 4, width, double(kBarsHeight - 4)};
}

int SectionView::stationAt(const QPointF& position) const {
  const int count = int(numbers_.size());
  if (count == 0 || position.y() > kBarsHeight + 4) return -1;
  const double t = (position.x() - kMargin) / (width() - 2 * kMargin);
  return t < 0 || t >= 1 ? -1 : int(t * count);
}

void SectionView::paintBars(QPainter& painter) const {
  const Colours& c = theme_.colours();
  double highest = 1.25 * tolerance_;
  for (const StationNumbers& n : numbers_) highest = std::max(highest, n.deviation);
  const double base = kBarsHeight, top = 6;
  const double limit = base - (base - top) * tolerance_ / highest;
  const double moving = bench_.moving() ? bench_.stationAt(bench_.playTime()) : -1;
  for (int i = 0; i < int(numbers_.size()); ++i) {
    QRectF bar = barRect(i);
    const double gap = bar.width() > 4 ? 1 : 0;
    const double height = std::max(2.0, (base - top) * numbers_[std::size_t(i)].deviation / highest);
    const bool over = numbers_[std::size_t(i)].deviation > tolerance_;
    QColor colour = i == drawing_.station ? c.selection : over ? c.error : c.disabled;
    if (i == hovered_ && i != drawing_.station) colour = colour.darker(c.dark ? 70 : 130);
    painter.fillRect(QRectF(bar.left() + gap / 2, base - height, std::max(1.0, bar.width() - gap), height),
                     colour);
  }
  painter.setPen(QPen(c.secondary, 1, Qt::DotLine));
  painter.drawLine(QPointF(kMargin, limit), QPointF(width() - kMargin, limit));
  if (moving >= 0) {
    const double x = barRect(0).center().x() + moving * barRect(0).width();
    painter.setPen(QPen(c.accent, 1.5));
    painter.drawLine(QPointF(x, 2), QPointF(x, base));
  }
}

void SectionView::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), c.panel);
  if (drawing_.station < 0) {
    painter.setPen(c.secondary);
    painter.drawText(rect(), Qt::AlignCenter, tr("The stations stand here as soon as a result is there."));
    return;
  }
  if (bench_.stale()) painter.setOpacity(kStaleOpacity);
  paintBars(painter);

  const QFont small = Theme::secondaryFont();
  const QFontMetrics metrics(small);
  const int textHeight = metrics.height();
  painter.setFont(small);
  double top = kBarsHeight + 4;
  const StationNumbers& n = numbers_[std::size_t(drawing_.station)];
  const BladePose& station = bench_.row()->poses[std::size_t(drawing_.station)];
  const QString title = tr("Station %1").arg(station.index + 1);
  QFont bold = small;
  bold.setWeight(QFont::DemiBold);
  painter.setFont(bold);
  painter.setPen(c.text);
  const int titleWidth = QFontMetrics(bold).horizontalAdvance(title);
  painter.drawText(QRectF(kMargin, top, titleWidth + 4, textHeight), Qt::AlignLeft, title);
  painter.setFont(small);
  painter.setPen(n.deviation > tolerance_ ? c.error : c.secondary);
  const QString facts =
      tr("deviation %1, radius %2, travel %3")
          .arg(lengthText(n.deviation), radiusText(n.maxCurvature > 0 ? 1 / n.maxCurvature : 1e12),
               lengthText(station.travel));
  const int factsLeft = kMargin + titleWidth + 12;
  painter.drawText(QRectF(factsLeft, top, width() - factsLeft - kMargin, textHeight), Qt::AlignLeft,
                   metrics.elidedText(facts, Qt::ElideRight, width() - factsLeft - kMargin));
  paintSectionKey(painter,
                  QRectF(factsLeft + metrics.horizontalAdvance(facts), top,
                         width() - kMargin - factsLeft - metrics.horizontalAdvance(facts), textHeight),
                  drawing_, c);
  top += textHeight + 4;

  // Side by side: the section takes what the curvature leaves.
  paintSection(painter, seen(), drawing_, tolerance_, exaggeration_, c);
  paintGrips(painter, seen(), grips(), c);
  const QRectF plot = curvatureArea();
  painter.setPen(c.secondary);
  painter.setFont(small);
  const double limitRadius = bench_.row()->request.blade.minRadius();
  painter.drawText(QRectF(plot.left() - kAxisLeft, top - 2, plot.width() + kAxisLeft, textHeight),
                   Qt::AlignLeft, curvatureTitle(metrics, plot.width() + kAxisLeft, radiusText(limitRadius)));
  if (plot.height() > 12)
    paintCurvature(painter, plot, along_, drawing_, bench_.row()->request.blade.maxCurvature(), c);
  painter.setOpacity(1);
  paintCursor(painter);
  if (hasFocus()) {
    painter.setOpacity(1);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(c.selection, 1));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

}  // namespace bw::app
