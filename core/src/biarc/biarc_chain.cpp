// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_chain.h"

#include <ceres/jet.h>
#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw::biarc {

namespace {

using Jet = ceres::Jet<double, kBiarcUnknowns>;

template <class T>
struct Arcs {
  BiarcShape<T> shape;
  T jointX, jointY;
  double alpha = 0, beta = 0;
};

double valueOf(double x) { return x; }
double valueOf(const Jet& x) { return x.a; }

/// Both arcs from x0, y0, τ0, z, x1, y1, τ1.
template <class T>
Arcs<T> arcsOf(const T* u) {
  using std::atan2, std::cos, std::exp, std::sin, std::sqrt;
  const T dx = u[4] - u[0], dy = u[5] - u[1];
  const T length = sqrt(dx * dx + dy * dy), direction = atan2(dy, dx);
  const auto wrapped = [](const T& angle) { return angle + (wrapAngle(valueOf(angle)) - valueOf(angle)); };
  const T alpha = wrapped(direction - u[2]), beta = wrapped(u[6] - direction);
  const T share = 1.0 / (1.0 + exp(-u[3]));
  Arcs<T> arcs{biarcShape(length, alpha, beta, share), u[0], u[1], valueOf(alpha), valueOf(beta)};
  const T middle = u[2] + arcs.shape.firstTurning / 2.0;
  arcs.jointX = u[0] + arcs.shape.firstChord * cos(middle);
  arcs.jointY = u[1] + arcs.shape.firstChord * sin(middle);
  return arcs;
}

}  // namespace

BiarcChain::BiarcChain(std::vector<BiarcNode> nodes, bool closed, double steepest)
    : nodes_(std::move(nodes)), closed_(closed) {
  arcs_.reserve(std::size_t(2 * biarcs()));
  for (int k = 0; k < biarcs(); ++k) {
    const BiarcNode& a = nodes_[std::size_t(k)];
    const BiarcNode& b = nodes_[std::size_t(k + 1) % nodes_.size()];
    const double u[kBiarcUnknowns] = {a[0], a[1], a[2], a[3], b[0], b[1], b[2]};
    const Arcs<double> arcs = arcsOf(u);
    const BiarcShape<double>& shape = arcs.shape;
    steepest_ = std::max({steepest_, std::abs(arcs.alpha), std::abs(arcs.beta)});
    if (!(steepest_ < steepest && shape.firstLength > 0 && shape.secondLength > 0 &&
          std::isfinite(shape.firstLength + shape.secondLength))) {
      valid_ = false;
      faulty_ = k;
      return;
    }
    arcs_.push_back({a.head<2>(), a[2], shape.firstTurning, shape.firstLength});
    arcs_.push_back(
        {{arcs.jointX, arcs.jointY}, a[2] + shape.firstTurning, shape.secondTurning, shape.secondLength});
  }
}

void BiarcChain::derivatives(int biarc, ArcDerivatives& first, ArcDerivatives& second) const {
  const BiarcNode& a = nodes_[std::size_t(biarc)];
  const BiarcNode& b = nodes_[std::size_t(biarc + 1) % nodes_.size()];
  const Jet u[kBiarcUnknowns] = {Jet(a[0], 0), Jet(a[1], 1), Jet(a[2], 2), Jet(a[3], 3),
                                 Jet(b[0], 4), Jet(b[1], 5), Jet(b[2], 6)};
  const Arcs<Jet> arcs = arcsOf(u);
  const BiarcShape<Jet>& shape = arcs.shape;
  first = {u[0].v,
           u[1].v,
           u[2].v,
           (shape.firstTurning / shape.firstLength).v,
           shape.firstTurning.v,
           shape.firstLength.v};
  second = {arcs.jointX.v,
            arcs.jointY.v,
            (u[2] + shape.firstTurning).v,
            (shape.secondTurning / shape.secondLength).v,
            shape.secondTurning.v,
            shape.secondLength.v};
}

namespace {

double squaredDistance(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Eigen::Vector2d& p) {
  const double x = std::max({low.x() - p.x(), 0.0, p.x() - high.x()});
  const double y = std::max({low.y() - p.y(), 0.0, p.y() - high.y()});
  return x * x + y * y;
}

}  // namespace

ArcTree::ArcTree(const std::vector<CircularArc>& arcs, bool closed) : closed_(closed) {
  pieces_.reserve(arcs.size());
  std::vector<Box> leaves;
  leaves.reserve(arcs.size());
  for (const CircularArc& arc : arcs) {
    const Eigen::Vector2d tangent(std::cos(arc.startAngle), std::sin(arc.startAngle));
    pieces_.push_back({arc.start, tangent, arc.end(), arc.curvature(), arc.turning, arc.length});
    const Piece& piece = pieces_.back();
    Box box{piece.start.cwiseMin(piece.end), piece.start.cwiseMax(piece.end)};
    // The extreme points of an arc are its ends and those where the tangent is along an axis.
    const double quarter = kPi / 2;
    const double from = std::min(arc.startAngle, arc.endAngle());
    const double to = std::max(arc.startAngle, arc.endAngle());
    for (double angle = std::ceil(from / quarter) * quarter; angle < to && !arc.straight();
         angle += quarter) {
      const Eigen::Vector2d p = arc.pointAt((angle - arc.startAngle) / arc.curvature());
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
    leaves.push_back(box);
  }
  boxes_.resize(arcs.empty() ? 0 : 2 * arcs.size() - 1);
  if (!arcs.empty()) build(0, 0, int(arcs.size()), leaves);
}

void ArcTree::build(std::size_t node, int begin, int end, const std::vector<Box>& leaves) {
  if (end - begin == 1) {
    boxes_[node] = leaves[std::size_t(begin)];
    return;
  }
  const int middle = (begin + end) / 2;
  const std::size_t left = node + 1, right = node + std::size_t(2 * (middle - begin));
  build(left, begin, middle, leaves);
  build(right, middle, end, leaves);
  boxes_[node] = {boxes_[left].low.cwiseMin(boxes_[right].low),
                  boxes_[left].high.cwiseMax(boxes_[right].high)};
}

ArcFoot ArcTree::onPiece(int arc, const Eigen::Vector2d& p) const {
  const Piece& piece = pieces_[std::size_t(arc)];
  const Eigen::Vector2d v = p - piece.start;
  const double x = piece.tangent.dot(v);
  const double y = piece.tangent.x() * v.y() - piece.tangent.y() * v.x();
  const double k = piece.curvature, bend = std::abs(k);
  // The foot on the whole circle; exact for a line, without cancellation near one.
  double s = x;
  if (bend > 0) {
    double angle = std::atan2(bend * x, 1 - k * y);
    if (angle < 0 && angle + 2 * kPi <= std::abs(piece.turning)) angle += 2 * kPi;
    s = angle / bend;
  }
  ArcFoot foot;
  foot.arc = arc;
  if (s >= 0 && s <= piece.length) {
    const double e = y - 0.5 * k * v.squaredNorm();
    foot.s = s;
    foot.side = 2 * e / (1 + std::sqrt(std::max(0.0, 1 - 2 * k * e)));
    foot.distance = std::abs(foot.side);
    return foot;
  }
  const double toStart = v.norm(), toEnd = (p - piece.end).norm();
  const bool atEnd = toEnd < toStart;
  foot.s = atEnd ? piece.length : 0;
  foot.distance = atEnd ? toEnd : toStart;
  const int last = int(pieces_.size()) - 1;
  if (!closed_ && atEnd && arc == last) foot.end = 1;
  if (!closed_ && !atEnd && arc == 0) foot.end = -1;
  // Between two arcs the normal is common: what is left is rounding.
  const double cross = atEnd ? 1 : y;
  foot.side = std::copysign(foot.distance, cross);
  if (atEnd && foot.end == 0) {
    const double c = std::cos(piece.turning), d = std::sin(piece.turning);
    const Eigen::Vector2d t(c * piece.tangent.x() - d * piece.tangent.y(),
                            d * piece.tangent.x() + c * piece.tangent.y());
    const Eigen::Vector2d w = p - piece.end;
    foot.side = std::copysign(foot.distance, t.x() * w.y() - t.y() * w.x());
  }
  return foot;
}

void ArcTree::search(std::size_t node, int begin, int end, const Eigen::Vector2d& p, ArcFoot& best) const {
  if (end - begin == 1) {
    const ArcFoot foot = onPiece(begin, p);
    if (foot.distance < best.distance) best = foot;
    return;
  }
  const int middle = (begin + end) / 2;
  const std::size_t left = node + 1, right = node + std::size_t(2 * (middle - begin));
  const double toLeft = squaredDistance(boxes_[left].low, boxes_[left].high, p);
  const double toRight = squaredDistance(boxes_[right].low, boxes_[right].high, p);
  const bool leftFirst = toLeft <= toRight;
  for (const bool isLeft : {leftFirst, !leftFirst}) {
    if ((isLeft ? toLeft : toRight) >= best.distance * best.distance) continue;
    if (isLeft)
      search(left, begin, middle, p, best);
    else
      search(right, middle, end, p, best);
  }
}

ArcFoot ArcTree::nearest(const Eigen::Vector2d& p, int seed) const {
  ArcFoot best = onPiece(std::clamp(seed, 0, int(pieces_.size()) - 1), p);
  search(0, 0, int(pieces_.size()), p, best);
  return best;
}

}  // namespace bw::biarc
