// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/section_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bw::app {

namespace {

constexpr int kSamples = 241;

QPointF toPoint(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

QPolygonF toPolygon(const std::vector<Eigen::Vector2d>& points) {
  QPolygonF polygon;
  polygon.reserve(qsizetype(points.size()));
  for (const Eigen::Vector2d& p : points) polygon << toPoint(p);
  return polygon;
}

/// The outline of a box in a plane: the polygon of the crossings of its edges.
QPolygonF boxInPlane(const Box& box, const Frame& frame) {
  const std::array<Eigen::Vector3d, 8> corners = box.corners();
  std::vector<Eigen::Vector2d> points;
  for (int a = 0; a < 8; ++a)
    for (int axis = 1; axis < 8; axis *= 2) {
      const int b = a | axis;
      if (b == a) continue;
      const Eigen::Vector3d p = frame.toLocal(corners[std::size_t(a)]),
                            q = frame.toLocal(corners[std::size_t(b)]);
      if ((p.z() < 0) == (q.z() < 0) || p.z() == q.z()) continue;
      const double t = p.z() / (p.z() - q.z());
      points.push_back((p + t * (q - p)).head<2>());
    }
  if (points.size() < 3) return {};
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) center += p / double(points.size());
  std::sort(points.begin(), points.end(), [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return std::atan2(p.y() - center.y(), p.x() - center.x()) <
           std::atan2(q.y() - center.y(), q.x() - center.x());
  });
  return toPolygon(points);
}

QRectF boundsOf(std::initializer_list<const QPolygonF*> polygons) {
  QRectF bounds;
  for (const QPolygonF* polygon : polygons)
    if (!polygon->isEmpty())
      bounds = bounds.isNull() ? polygon->boundingRect() : bounds.united(polygon->boundingRect());
  return bounds;
}

}  // namespace

SectionDrawing makeSectionDrawing(const Sweep& sweep, int index, double exaggeration) {
  SectionDrawing drawing;
  const auto& stations = sweep.poses;
  if (index < 0 || std::size_t(index) >= stations.size()) return drawing;
  const BladePose& station = stations[std::size_t(index)];
  const PlanarCurve& target = sweep.fits[std::size_t(index)].target;
  drawing.station = index;
  drawing.target = toPolygon(target.sample(kSamples));
  drawing.elastica = toPolygon(station.cut.sample(kSamples));
  drawing.blade = toPolygon(station.blade.sample(kSamples));
  // The same frame axes for all stations: neighbours are drawn as they lie in the plane of this one.
  const auto neighbour = [&](int i) {
    QPolygonF polygon;
    if (i < 0 || std::size_t(i) >= stations.size()) return polygon;
    const BladePose& other = stations[std::size_t(i)];
    for (const Eigen::Vector2d& p : other.cut.sample(65))
      polygon << toPoint(station.frame.toLocal(other.frame.toWorld(p)).head<2>());
    return polygon;
  };
  drawing.before = neighbour(index - 1);
  drawing.after = neighbour(index + 1);
  drawing.foam = boxInPlane(sweep.block, station.frame);
  if (exaggeration != 1) {
    for (QPointF& p : drawing.elastica) {
      const Eigen::Vector2d q(p.x(), p.y());
      const Eigen::Vector2d foot = target.value(target.nearestParameter(q));
      p = toPoint(foot + exaggeration * (q - foot));
    }
  }
  const double length = station.blade.length();
  std::vector<double> arcs(kSamples);
  std::vector<Elastica::State> states(kSamples);
  for (int i = 0; i < kSamples; ++i) arcs[std::size_t(i)] = length * i / (kSamples - 1);
  station.blade.at(arcs, states);
  for (int i = 0; i < kSamples; ++i)
    drawing.curvature << QPointF(arcs[std::size_t(i)], states[std::size_t(i)].curvature);
  const double overhang = station.extension * station.cut.length();
  drawing.cutFrom = overhang;
  drawing.cutTo = length - overhang;
  drawing.bounds = boundsOf({&drawing.target, &drawing.elastica, &drawing.blade, &drawing.foam});
  return drawing;
}

}  // namespace bw::app
