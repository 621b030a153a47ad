// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "blocks/block_plan.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QRegularExpression>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "bw/core/text/number_text.h"
#include "controls/hand_pace.h"
#include "controls/typed_field.h"
#include "workbench/block_layout.h"

namespace bw::app {

namespace {

constexpr double kReach = 5;                     // px on either side of a boundary
constexpr double kLeast = 10;                    // mm, that a block keeps
constexpr int kLeft = 56, kTop = 20, kEdge = 6;  // px around the plan; sizes stand at the left and above
constexpr int kIcon = 16, kPad = 4;

QString mm(double length) { return QString::fromStdString(shortText(length, 6)); }

/// mm from the first face to where a block of a way begins, and to where it ends.
std::pair<double, double> spanOf(const BlockGrid& grid, std::size_t way, std::size_t index) {
  double begin = 0;
  for (std::size_t i = 0; i < index; ++i) begin += grid.sizes[way][i] + grid.gaps[way][i];
  return {begin, begin + grid.sizes[way][index]};
}

}  // namespace

BlockPlan::BlockPlan(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setObjectName("blockPlan");
  setAccessibleName(tr("Plan of the blocks"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  refresh();
}

void BlockPlan::makeCells() {
  cells_.clear();
  const Design& design = bench_.design();
  const std::vector<BlockStanding> standings = standingsOf(bench_);
  grid_ = gridOf(bench_);
  if (grid_) {
    const auto &columns = grid_->sizes[0], &rows = grid_->sizes[1];
    for (std::size_t i = 0; i < design.stock.size(); ++i) {
      const std::size_t column = i % columns.size(), row = i / columns.size() % rows.size();
      const auto [left, right] = spanOf(*grid_, 0, column);
      const auto [front, back] = spanOf(*grid_, 1, row);
      cells_.push_back({design.stock[i].id,
                        QRectF(left, front, right - left, back - front),
                        {int(column), int(row), int(i / columns.size() / rows.size())},
                        standings[i]});
    }
  } else {
    std::vector<double> bottoms;
    for (std::size_t i = 0; i < design.stock.size(); ++i) {
      Bounds bounds;
      if (const auto& placed = design.stock[i].placement)
        for (const Eigen::Vector3d& corner : placed->box().corners()) bounds.add(corner);
      if (!bounds.valid()) continue;
      const Eigen::Vector3d size = bounds.size();
      cells_.push_back(
          {design.stock[i].id, QRectF(bounds.min.x(), bounds.min.y(), size.x(), size.y()), {}, standings[i]});
      bottoms.push_back(bounds.min.z());
    }
    layCells(bottoms);
  }
  whole_ = {};
  for (const Cell& cell : cells_) whole_ |= cell.place;
}

void BlockPlan::layCells(const std::vector<double>& bottoms) {
  constexpr double kOver = 1;  // mm that one block lies over another
  std::vector<std::size_t> upwards(cells_.size());
  std::iota(upwards.begin(), upwards.end(), std::size_t(0));
  std::ranges::stable_sort(upwards, {}, [&](std::size_t i) { return bottoms[i]; });
  for (auto at = upwards.begin(); at != upwards.end(); ++at)
    for (auto below = upwards.begin(); below != at; ++below) {
      const QRectF both = cells_[*at].place & cells_[*below].place;
      if (both.width() > kOver && both.height() > kOver)
        cells_[*at].at[2] = std::max(cells_[*at].at[2], cells_[*below].at[2] + 1);
    }
}

void BlockPlan::refresh() {
  // Another design, or an undo while a boundary is held.
  if (pull_ && (!bench_.design().grid || bench_.design().stock.size() != pull_->from.stock.size()))
    pull_.reset();
  makeCells();
  int layers = grid_ ? int(grid_->sizes[2].size()) : 1;
  for (const Cell& cell : cells_) layers = std::max(layers, cell.at[2] + 1);
  int layer = std::min(layer_, layers - 1);
  if (const Cell* cell = selected(); cell && std::exchange(shown_, cell->id) != cell->id) {
    layer = cell->at[2];
    setAccessibleDescription(tipOf(*cell));
    if (zoom_ > 1 && !room().contains(toWidget(cell->place).center()))
      bring(cell->place.center() - whole_.topLeft(), room().center());
  }
  if (std::exchange(layers_, layers) != layers || std::exchange(layer_, layer) != layer) emit layersChanged();
  update();
}

void BlockPlan::setLayer(int layer) {
  const int next = std::clamp(layer, 0, layers_ - 1);
  if (std::exchange(layer_, next) == next) return;
  emit layersChanged();
  update();
}

const BlockPlan::Cell* BlockPlan::selected() const {
  const auto found = std::ranges::find(cells_, bench_.selection().block, &Cell::id);
  return found == cells_.end() ? nullptr : &*found;
}

QString BlockPlan::wordOf(const std::string& block) const {
  const auto found = std::ranges::find(cells_, block, &Cell::id);
  if (found == cells_.end()) return {};
  // How firmly its blades rest stands in the tip.
  return found->standing.colour == &Colours::success ? tr("cuttable") : found->standing.word;
}

QRectF BlockPlan::room() const { return QRectF(rect()).adjusted(kLeft, kTop, -kEdge, -kEdge); }

double BlockPlan::fitting() const {
  const QRectF seen = room();
  if (whole_.isEmpty()) return 1;
  return std::max(1e-6, std::min(seen.width() / whole_.width(), seen.height() / whole_.height()));
}

std::pair<double, QPointF> BlockPlan::scale() const {
  const QRectF seen = room();
  if (whole_.isEmpty()) return {1, seen.topLeft()};
  const double by = zoom_ * fitting(), width = by * whole_.width(), height = by * whole_.height();
  // In the middle, and the first row at the lower edge; of what is larger no room is left empty.
  const double left = width <= seen.width() ? seen.center().x() - 0.5 * width
                                            : std::clamp(seen.center().x() - by * middle_.x(),
                                                         seen.right() - width, seen.left());
  const double bottom = height <= seen.height() ? seen.center().y() + 0.5 * height
                                                : std::clamp(seen.center().y() + by * middle_.y(),
                                                             seen.bottom(), seen.top() + height);
  return {by, {left, bottom}};
}

void BlockPlan::bring(const QPointF& place, const QPointF& position) {
  const double by = zoom_ * fitting();
  const QPointF off = (position - room().center()) / by;
  middle_ = {place.x() - off.x(), place.y() + off.y()};
  // Not beyond what can be seen, or the way back would be one, too.
  const auto [scale, corner] = this->scale();
  const QPointF seen = room().center() - corner;
  middle_ = {seen.x() / scale, -seen.y() / scale};
  update();
}

void BlockPlan::wheelEvent(QWheelEvent* event) {
  constexpr double kNarrow = 48, kNearest = 400, kDouble = 240;  // px of a block; eighths of a degree
  double narrowest = std::numeric_limits<double>::infinity();
  for (const Cell& cell : cells_) narrowest = std::min({narrowest, cell.place.width(), cell.place.height()});
  const double most = std::max(1.0, kNearest / (fitting() * narrowest));
  const bool meant = zoom_ > 1 || fitting() * narrowest < kNarrow || event->modifiers() & Qt::ControlModifier;
  constexpr double kSame = 1e-6;  // there and back is the same
  double next = std::clamp(zoom_ * std::exp2(event->angleDelta().y() / kDouble), 1.0, most);
  if (next < 1 + kSame) next = 1;
  // What changes nothing here moves what is around.
  if (!meant || cells_.empty() || next == zoom_) return event->ignore();
  const QPointF place = placeAt(event->position());
  zoom_ = next;
  bring(place, event->position());
  event->accept();
}

QRectF BlockPlan::toWidget(const QRectF& place) const {
  const auto [by, corner] = scale();
  return {corner.x() + by * (place.left() - whole_.left()), corner.y() - by * (place.bottom() - whole_.top()),
          by * place.width(), by * place.height()};
}

double BlockPlan::along(std::size_t way, const QPointF& position) const {
  const auto [by, corner] = scale();
  return way == 0 ? (position.x() - corner.x()) / by : (corner.y() - position.y()) / by;
}

QRectF BlockPlan::rectOf(const std::string& block) const {
  const auto found = std::ranges::find(cells_, block, &Cell::id);
  return found == cells_.end() || found->at[2] != layer_ ? QRectF() : toWidget(found->place);
}

QPointF BlockPlan::boundary(std::size_t way, std::size_t index) const {
  if (!grid_ || index + 1 >= grid_->sizes[way].size()) return {};
  const double at = spanOf(*grid_, way, index).second + 0.5 * grid_->gaps[way][index];
  const QRectF place =
      toWidget(way == 0 ? QRectF(at, 0, 0, whole_.height()) : QRectF(0, at, whole_.width(), 0));
  return place.center();
}

const BlockPlan::Cell* BlockPlan::cellAt(const QPointF& position) const {
  for (const Cell& cell : cells_)
    if (cell.at[2] == layer_ && room().contains(position) && toWidget(cell.place).contains(position))
      return &cell;
  return nullptr;
}

std::optional<BlockPlan::Boundary> BlockPlan::boundaryAt(const QPointF& position) const {
  if (!bench_.design().grid || !grid_) return {};
  if (!toWidget(whole_).adjusted(-kReach, -kReach, kReach, kReach).contains(position)) return {};
  constexpr double kShare = 0.25;  // of a block at most: the rest of it is to be clicked
  for (std::size_t way = 0; way < 2; ++way) {
    const double at = along(way, position);
    const std::vector<double>& sizes = grid_->sizes[way];
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
      const double reach = std::min(kReach / scale().first, kShare * std::min(sizes[i], sizes[i + 1]));
      if (at > spanOf(*grid_, way, i).second - reach && at < spanOf(*grid_, way, i + 1).first + reach)
        return Boundary{way, i};
    }
  }
  return {};
}

void BlockPlan::choose(const Cell& cell) {
  const auto cut = std::ranges::find(bench_.design().cuts, cell.id, &Cut::block);
  if (cut == bench_.design().cuts.end())
    return bench_.tell(
        Topic::declined, Severity::info,
        tr("%1 has no cut; there is nothing to be shown of it").arg(QString::fromStdString(cell.id)));
  bench_.select({Selection::Kind::block, -1, cell.id, cut->id});
}

void BlockPlan::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const std::optional<Boundary> boundary = boundaryAt(event->position())) {
    pull_ = Pull{*boundary, bench_.design(),    *grid_, along(boundary->way, event->position()),
                 0,         bench_.newMergeId()};
    return update();
  }
  if (zoom_ > 1) grasped_ = placeAt(event->position());
  if (const Cell* cell = cellAt(event->position())) choose(Cell(*cell));
}

void BlockPlan::mouseMoveEvent(QMouseEvent* event) {
  if (grasped_) return bring(*grasped_, event->position());
  if (!pull_) {
    const std::optional<Boundary> before = std::exchange(hovered_, boundaryAt(event->position()));
    if (hovered_ == before) return;
    setCursor(!hovered_ ? Qt::ArrowCursor : hovered_->way == 0 ? Qt::SplitHCursor : Qt::SplitVCursor);
    return update();
  }
  const auto [way, index] = pull_->boundary;
  const std::vector<double>& sizes = pull_->grid.sizes[way];
  const auto [step, share] = handPace(event->modifiers());
  const double by = (along(way, event->position()) - pull_->began) * share;
  // The size, not the way to it, is a round number.
  const double from = sizes[index], both = from + sizes[index + 1];
  const double size = std::clamp(std::round((from + by) / step) * step, std::min(kLeast, from),
                                 both - std::min(kLeast, sizes[index + 1]));
  if (size - from != pull_->by) pull(size - from, true);
}

void BlockPlan::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  grasped_.reset();
  endPull(false);
}

void BlockPlan::pull(double by, bool live) {
  pull_->by = by;
  pull_->moved = true;
  BlockGrid next = pull_->grid;
  const auto [way, index] = pull_->boundary;
  next.sizes[way][index] += by;
  next.sizes[way][index + 1] -= by;
  const Pull pulled = *pull_;  // a change of the design may end it
  layOut(bench_, tr("Move boundary of blocks"), pulled.from, pulled.grid, next, pulled.mergeId, live);
}

void BlockPlan::endPull(bool givenUp) {
  if (!pull_) return;
  if (pull_->moved) pull(givenUp ? 0 : pull_->by, false);
  pull_.reset();
  update();
}

void BlockPlan::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    if (pull_)
      endPull(true);
    else
      returnKeyboard(*this);
    return;
  }
  if (event->key() == Qt::Key_PageUp || event->key() == Qt::Key_PageDown)
    return setLayer(layer_ + (event->key() == Qt::Key_PageUp ? 1 : -1));
  const int key = event->key();
  const QPoint step((key == Qt::Key_Right) - (key == Qt::Key_Left),
                    (key == Qt::Key_Up) - (key == Qt::Key_Down));
  const Cell* now = selected();
  if (step.isNull() || !now || !grid_) return QWidget::keyPressEvent(event);
  const std::array<int, 3> at = {now->at[0] + step.x(), now->at[1] + step.y(), layer_};
  const auto next = std::ranges::find(cells_, at, &Cell::at);
  if (next != cells_.end()) choose(Cell(*next));
}

QString BlockPlan::tipOf(const Cell& cell) const {
  QString text = QString::fromStdString(cell.id) + ": " + wordOf(cell.id);
  text += "\n" + mm(cell.place.width()) + " × " + mm(cell.place.height());
  if (grid_) text += " × " + mm(grid_->sizes[2][std::size_t(cell.at[2])]);
  text += " mm";
  if (!cell.standing.tip.isEmpty()) text += "\n" + cell.standing.tip;
  return text;
}

bool BlockPlan::event(QEvent* event) {
  // Esc would stop the computation.
  if (event->type() == QEvent::ShortcutOverride && pull_ &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::ToolTip) {
    const QPoint at = static_cast<QHelpEvent*>(event)->pos();
    QString text;
    if (boundaryAt(at))
      text = tr("Pull the boundary: in mm, with Shift by tens, with Ctrl or Alt by tenths; Esc gives up");
    else if (const Cell* cell = cellAt(at))
      text = tipOf(*cell);
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, this);
    return true;
  }
  if (event->type() == QEvent::Leave && std::exchange(hovered_, std::nullopt)) update();
  return QWidget::event(event);
}

/// "3-2" of "column-3-layer-2": shortened in the middle, all of a grid look alike.
static QString shortName(const QString& name) {
  static const QRegularExpression grid("^(?:(?:column|row|layer)-\\d+-?)+$"), words("(?:column|row|layer)-");
  return grid.match(name).hasMatch() ? QString(name).remove(words) : name;
}

void BlockPlan::paintCell(QPainter& painter, const Cell& cell) const {
  const Colours& c = theme_.colours();
  const QRectF place = toWidget(cell.place);
  const QColor colour = c.*cell.standing.colour;
  QColor tint = colour;
  tint.setAlphaF(c.dark ? 0.28f : 0.16f);
  const bool chosen = cell.id == bench_.selection().block;
  painter.setBrush(tint);
  painter.setPen(QPen(chosen ? c.selection : c.secondary, chosen ? 2.5 : 1));
  painter.drawRect(chosen ? place.adjusted(1, 1, -1, -1) : place);
  const QRectF inner = place.adjusted(kPad, 3, -kPad, -3);
  const QFont name = Theme::bodyFont(), small = Theme::secondaryFont();
  const QFontMetrics nameSize(name), wordSize(small);
  const QString word = wordOf(cell.id);
  const QPixmap icon = Theme::pixmap(cell.standing.icon, colour, kIcon, devicePixelRatioF());
  if (inner.width() < kIcon || inner.height() < kIcon) return;
  if (inner.width() < 48 || inner.height() < nameSize.height() + kIcon + 2) {
    painter.drawPixmap(inner.center() - QPointF(kIcon, kIcon) / 2, icon);
    return;
  }
  const auto draw = [&](const QFont& font, const QColor& pen, const QRectF& line, const QString& text) {
    painter.setFont(font);
    painter.setPen(pen);
    painter.drawText(line, Qt::AlignCenter,
                     QFontMetrics(font).elidedText(text, Qt::ElideMiddle, int(line.width())));
  };
  // Icon and word beside each other, else below each other, else the word alone.
  const double wide = kIcon + 4 + wordSize.horizontalAdvance(word) + 2.0;
  const bool beside = wide <= inner.width();
  const bool below = !beside && inner.height() >= nameSize.height() + kIcon + wordSize.height() + 4;
  const double high = nameSize.height() + 2 + (below ? kIcon + 2 + wordSize.height() : kIcon);
  double y = inner.center().y() - 0.5 * high;
  QString own = QString::fromStdString(cell.id);
  if (nameSize.horizontalAdvance(own) > inner.width()) own = shortName(own);
  draw(name, c.text, {inner.left(), y, inner.width(), double(nameSize.height())}, own);
  y += nameSize.height() + 2;
  const QColor pen = cell.standing.colour == &Colours::secondary ? c.secondary : colour;
  if (beside) {
    const double left = inner.center().x() - 0.5 * wide;
    painter.drawPixmap(QPointF(left, y), icon);
    return draw(small, pen, {left + kIcon + 4, y, wide - kIcon - 4, double(kIcon)}, word);
  }
  if (below) {
    painter.drawPixmap(QPointF(inner.center().x() - 0.5 * kIcon, y), icon);
    y += kIcon + 2;
  }
  draw(small, pen, {inner.left(), y, inner.width(), double(wordSize.height())}, word);
}

void BlockPlan::paintSizes(QPainter& painter) const {
  const Colours& c = theme_.colours();
  painter.setFont(Theme::secondaryFont());
  const QFontMetrics metrics(painter.font());
  const QRectF seen = room(), whole = toWidget(whole_) & seen;
  for (std::size_t way = 0; way < 2; ++way)
    for (std::size_t i = 0; i < grid_->sizes[way].size(); ++i) {
      const auto [from, to] = spanOf(*grid_, way, i);
      const QRectF place = toWidget(way == 0 ? QRectF(from, 0, to - from, 1) : QRectF(0, from, 1, to - from));
      const double middle = way == 0 ? place.center().x() : place.center().y();
      if (middle < (way == 0 ? seen.left() : seen.top()) ||
          middle > (way == 0 ? seen.right() : seen.bottom()))
        continue;
      const bool pulled = pull_ && pull_->boundary.way == way &&
                          (pull_->boundary.index == i || pull_->boundary.index + 1 == i);
      painter.setPen(pulled ? c.text : c.secondary);
      const QString text = mm(to - from);
      if (way == 0 && metrics.horizontalAdvance(text) <= place.width())
        painter.drawText(QRectF(place.left(), whole.top() - kTop, place.width(), kTop - 2), Qt::AlignCenter,
                         text);
      if (way == 1 && metrics.height() <= place.height() + 2)
        painter.drawText(QRectF(whole.left() - kLeft, place.center().y() - 10, kLeft - 6, 20),
                         Qt::AlignRight | Qt::AlignVCenter, text);
    }
}

void BlockPlan::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (cells_.empty()) {
    painter.setFont(Theme::secondaryFont());
    painter.setPen(c.secondary);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The block lies around its surface; its place is shown once it is found."));
    return;
  }
  const Cell* chosen = selected();
  painter.save();
  if (zoom_ > 1) painter.setClipRect(room().adjusted(-2, -2, 2, 2));
  for (const Cell& cell : cells_)
    if (cell.at[2] == layer_ && &cell != chosen) paintCell(painter, cell);
  if (chosen && chosen->at[2] == layer_) paintCell(painter, *chosen);
  painter.restore();
  if (grid_) paintSizes(painter);
  const std::optional<Boundary> lit = pull_ ? std::optional(pull_->boundary) : hovered_;
  if (lit && grid_ && lit->index + 1 < grid_->sizes[lit->way].size()) {
    const QPointF middle = boundary(lit->way, lit->index);
    const QRectF whole = toWidget(whole_) & room();
    painter.setPen(QPen(c.selection, 3));
    if (lit->way == 0)
      painter.drawLine(QPointF(middle.x(), whole.top()), QPointF(middle.x(), whole.bottom()));
    else
      painter.drawLine(QPointF(whole.left(), middle.y()), QPointF(whole.right(), middle.y()));
  }
  if (hasFocus()) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(c.selection, 1));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

}  // namespace bw::app
