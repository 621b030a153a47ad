// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "seen_lines.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace bw::drawings {

namespace {

constexpr int kPixels = 600;          ///< along the longer side of a depth buffer
constexpr double kSharp = 0.978;      ///< cosine of 12°: flatter edges of the mesh are no lines
constexpr double kSamePlace = 1e-4;   ///< mm within which points of neighbouring faces are one
constexpr double kSlack = 0.003;      ///< of the extent, by which a line may lie below what hides it
constexpr std::size_t kShortRun = 4;  ///< samples; what is seen or hidden for less is rounding
constexpr double kNothing = -std::numeric_limits<double>::infinity();

using Link = std::pair<int, int>;

/// Links between numbered places as the longest lines: they end where not exactly two links meet.
std::vector<std::vector<int>> chained(const std::vector<Link>& links) {
  std::map<int, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < links.size(); ++i) {
    at[links[i].first].push_back(i);
    at[links[i].second].push_back(i);
  }
  std::vector<char> used(links.size(), 0);
  std::vector<std::vector<int>> chains;
  const auto walk = [&](int from, std::size_t link) {
    std::vector<int> chain = {from};
    for (;;) {
      used[link] = 1;
      const int next = links[link].first == chain.back() ? links[link].second : links[link].first;
      chain.push_back(next);
      const std::vector<std::size_t>& on = at[next];
      if (on.size() != 2) break;
      const auto free = std::ranges::find_if(on, [&](std::size_t i) { return !used[i]; });
      if (free == on.end()) break;
      link = *free;
    }
    chains.push_back(std::move(chain));
  };
  for (const auto& [place, on] : at)
    if (on.size() != 2)
      for (const std::size_t link : on)
        if (!used[link]) walk(place, link);
  for (std::size_t i = 0; i < links.size(); ++i)
    if (!used[i]) walk(links[i].first, i);
  return chains;
}

/// Numbers of places; points at one place have one.
std::vector<int> joinedPlaces(const std::vector<Eigen::Vector3d>& points) {
  std::map<std::array<long long, 3>, int> cells;
  std::vector<int> joined(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<long long, 3> cell = {};
    for (int k = 0; k < 3; ++k) cell[std::size_t(k)] = std::llround(points[i][k] / kSamePlace);
    // A place may lie at the border of its cell.
    int found = -1;
    for (int n = 0; n < 27 && found < 0; ++n) {
      const auto it = cells.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
      if (it != cells.end()) found = it->second;
    }
    if (found < 0) cells[cell] = found = int(i);
    joined[i] = found;
  }
  return joined;
}

/// Points along a line, none farther from the next than `step`.
std::vector<Eigen::Vector3d> stepped(const Polyline& line, double step) {
  constexpr int kMost = 20 * kPixels;
  std::vector<Eigen::Vector3d> points = {line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const int n = int(std::clamp(std::ceil((line[i] - line[i - 1]).norm() / step), 1.0, double(kMost)));
    for (int k = 1; k <= n; ++k) points.push_back(line[i - 1] + (line[i] - line[i - 1]) * (double(k) / n));
  }
  return points;
}

/// Takes runs that are too short to be more than rounding for what is around them.
void steady(std::vector<char>& flags) {
  for (std::size_t i = 0; i < flags.size();) {
    std::size_t end = i;
    while (end < flags.size() && flags[end] == flags[i]) ++end;
    if (end - i < kShortRun && i > 0 && end < flags.size())
      std::fill(flags.begin() + std::ptrdiff_t(i), flags.begin() + std::ptrdiff_t(end), flags[i - 1]);
    i = end;
  }
}

double apart(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

}  // namespace

View View::from(const Eigen::Vector3d& toward) {
  View view;
  view.toward = toward.normalized();
  view.right = Eigen::Vector3d::UnitZ().cross(view.toward).normalized();
  view.up = view.toward.cross(view.right);
  return view;
}

Solid::Solid(TriangleMesh mesh) : mesh_(std::move(mesh)), joined_(joinedPlaces(mesh_.points)) {
  // At each edge between two triangles their normals there: of the surfaces, which are smooth where triangles
  // are not.
  std::map<Link, std::vector<std::array<Eigen::Vector3d, 2>>> sides;
  for (const std::array<int, 3>& t : mesh_.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = std::size_t(t[k]), b = std::size_t(t[(k + 1) % 3]);
      if (joined_[a] == joined_[b]) continue;
      const bool turned = joined_[a] > joined_[b];
      sides[std::minmax(joined_[a], joined_[b])].push_back(
          {mesh_.normals[turned ? b : a], mesh_.normals[turned ? a : b]});
    }
  std::vector<Link> links;
  for (const auto& [edge, normals] : sides) {
    const bool flat = normals.size() == 2 && (normals[0][0].dot(normals[1][0]) > kSharp ||
                                              normals[0][1].dot(normals[1][1]) > kSharp);
    if (!flat) links.push_back(edge);
  }
  for (const std::vector<int>& chain : chained(links)) {
    Polyline& line = edges_.emplace_back();
    for (const int place : chain) line.push_back(mesh_.points[std::size_t(place)]);
  }
}

std::vector<Polyline> Solid::outlines(const View& view) const {
  // Where the normal, linear over each triangle, is across the view. Faces that are seen exactly from their
  // side count as seen, so that they have no such line.
  constexpr double kAcross = 1e-6;
  std::map<Link, int> numbers;
  Polyline crossings;
  std::vector<Link> links;
  for (const std::array<int, 3>& t : mesh_.triangles) {
    std::vector<int> found;
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t a = std::size_t(t[k]), b = std::size_t(t[(k + 1) % 3]);
      if (joined_[a] > joined_[b]) std::swap(a, b);
      const double from = mesh_.normals[a].dot(view.toward) + kAcross,
                   to = mesh_.normals[b].dot(view.toward) + kAcross;
      if ((from < 0) == (to < 0)) continue;
      const auto [it, fresh] = numbers.try_emplace({joined_[a], joined_[b]}, int(crossings.size()));
      if (fresh)
        crossings.push_back(mesh_.points[a] + (mesh_.points[b] - mesh_.points[a]) * (from / (from - to)));
      found.push_back(it->second);
    }
    if (found.size() == 2 && found[0] != found[1]) links.push_back(std::minmax(found[0], found[1]));
  }
  std::vector<Polyline> lines;
  for (const std::vector<int>& chain : chained(links)) {
    Polyline& line = lines.emplace_back();
    for (const int place : chain) line.push_back(crossings[std::size_t(place)]);
  }
  return lines;
}

bool Solid::contains(const Eigen::Vector3d& p) const {
  // A ray in a direction that no edge of a block has; odd crossings are inside.
  const Eigen::Vector3d ray = Eigen::Vector3d(0.3127, 0.5471, 0.7764).normalized();
  int crossed = 0;
  for (const std::array<int, 3>& t : mesh_.triangles) {
    const Eigen::Vector3d& a = mesh_.points[std::size_t(t[0])];
    const Eigen::Vector3d u = mesh_.points[std::size_t(t[1])] - a, v = mesh_.points[std::size_t(t[2])] - a;
    const Eigen::Vector3d across = ray.cross(v);
    const double det = u.dot(across);
    if (std::abs(det) < 1e-12) continue;
    const double first = (p - a).dot(across) / det;
    const Eigen::Vector3d other = (p - a).cross(u);
    const double second = ray.dot(other) / det;
    if (first >= 0 && second >= 0 && first + second <= 1 && v.dot(other) / det > 0) ++crossed;
  }
  return crossed % 2 == 1;
}

DepthBuffer::DepthBuffer(const TriangleMesh& mesh, const View& view) : view_(view) {
  std::vector<Eigen::Vector3d> flat;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
  for (const Eigen::Vector3d& p : mesh.points) {
    flat.emplace_back(p.dot(view.right), p.dot(view.up), view.depth(p));
    low = low.cwiseMin(flat.back());
    high = high.cwiseMax(flat.back());
  }
  if (flat.empty()) return;
  const double extent = std::max({high.x() - low.x(), high.y() - low.y(), 1e-6});
  pixel_ = extent / kPixels;
  slack_ = kSlack * std::max(extent, high.z() - low.z());
  corner_ = low.head<2>() - Point::Constant(2 * pixel_);
  columns_ = int((high.x() - corner_.x()) / pixel_) + 3;
  rows_ = int((high.y() - corner_.y()) / pixel_) + 3;
  depths_.assign(std::size_t(columns_) * std::size_t(rows_), kNothing);
  for (const std::array<int, 3>& t : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> c;
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = flat[std::size_t(t[k])];
      c[k].head<2>() = (c[k].head<2>() - corner_) / pixel_;
    }
    const Point u = (c[1] - c[0]).head<2>(), v = (c[2] - c[0]).head<2>();
    const double det = u.x() * v.y() - u.y() * v.x();
    if (std::abs(det) < 1e-9) continue;
    const auto [left, right] = std::minmax({c[0].x(), c[1].x(), c[2].x()});
    const auto [bottom, top] = std::minmax({c[0].y(), c[1].y(), c[2].y()});
    for (int row = std::max(0, int(bottom - 0.5)); row < rows_ && row <= int(top); ++row)
      for (int column = std::max(0, int(left - 0.5)); column < columns_ && column <= int(right); ++column) {
        const Point d = Point(column + 0.5, row + 0.5) - c[0].head<2>();
        const double first = (d.x() * v.y() - d.y() * v.x()) / det,
                     second = (u.x() * d.y() - u.y() * d.x()) / det;
        if (first < -1e-9 || second < -1e-9 || first + second > 1 + 1e-9) continue;
        double& depth = depths_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
        depth = std::max(depth, c[0].z() + first * (c[1].z() - c[0].z()) + second * (c[2].z() - c[0].z()));
      }
  }
}

DepthBuffer::Reach DepthBuffer::about(const Point& p) const {
  const int column = int(std::floor((p.x() - corner_.x()) / pixel_)),
            row = int(std::floor((p.y() - corner_.y()) / pixel_));
  Reach reach = {-kNothing, kNothing};
  for (int r = row - 1; r <= row + 1; ++r)
    for (int c = column - 1; c <= column + 1; ++c) {
      const bool within = r >= 0 && c >= 0 && r < rows_ && c < columns_;
      const double depth =
          within ? depths_[std::size_t(r) * std::size_t(columns_) + std::size_t(c)] : kNothing;
      reach.low = std::min(reach.low, depth);
      reach.high = std::max(reach.high, depth);
    }
  return reach;
}

SeenLines DepthBuffer::lines(const std::vector<Polyline>& lines) const {
  SeenLines out;
  for (const Polyline& line : lines) {
    if (line.size() < 2) continue;
    const std::vector<Eigen::Vector3d> points = stepped(line, pixel_);
    std::vector<char> seen;
    for (const Eigen::Vector3d& p : points)
      seen.push_back(view_.depth(p) + slack_ >= about(view_.flat(p)).low);
    steady(seen);
    for (std::size_t i = 0; i < points.size();) {
      std::vector<Point> run;
      std::size_t end = i;
      for (; end < points.size() && seen[end] == seen[i]; ++end) run.push_back(view_.flat(points[end]));
      if (end < points.size()) run.push_back(view_.flat(points[end]));
      if (run.size() > 1) (seen[i] ? out.seen : out.hidden).push_back(simplified(run, 0.3 * pixel_));
      i = end;
    }
  }
  return out;
}

std::vector<std::vector<Point>> DepthBuffer::onSurface(const std::vector<Polyline>& lines) const {
  std::vector<std::vector<Point>> out;
  for (const Polyline& line : lines) {
    if (line.size() < 2) continue;
    const std::vector<Eigen::Vector3d> points = stepped(line, pixel_);
    std::vector<char> on;
    for (const Eigen::Vector3d& p : points) {
      const Reach reach = about(view_.flat(p));
      const double depth = view_.depth(p);
      on.push_back(depth + slack_ >= reach.low && depth - slack_ <= reach.high);
    }
    steady(on);
    for (std::size_t i = 0; i < points.size();) {
      std::vector<Point> run;
      std::size_t end = i;
      for (; end < points.size() && on[end] == on[i]; ++end) run.push_back(view_.flat(points[end]));
      if (on[i] && run.size() > 1) out.push_back(simplified(run, 0.3 * pixel_));
      i = end;
    }
  }
  return out;
}

std::vector<Point> simplified(const std::vector<Point>& line, double within) {
  if (line.size() < 3) return line;
  std::vector<char> kept(line.size(), 0);
  kept.front() = kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double most = within;
    std::size_t worst = 0;
    for (std::size_t i = from + 1; i < to; ++i)
      if (const double off = apart(line[i], line[from], line[to]); off > most) {
        most = off;
        worst = i;
      }
    if (worst == 0) continue;
    kept[worst] = 1;
    open.emplace_back(from, worst);
    open.emplace_back(worst, to);
  }
  std::vector<Point> out;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) out.push_back(line[i]);
  return out;
}

}  // namespace bw::drawings
