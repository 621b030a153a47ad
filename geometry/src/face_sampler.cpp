// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "model_impl.h"
#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kStarts = 8;  // Newton starts of a global search at most
constexpr double kSideRatio =
    1e-3;  // of the distance: a foot leaning more than this over the border has no side
constexpr std::size_t kLooks = 12;  // at nodes of a grid along each parameter, for a start beside a hole
constexpr double kGridSlack = 0.1;  // of a carrier's size: so far its grid may leave it
constexpr double kSewnGap = 0.1;    // mm: tolerances of edges up to this are no gap
constexpr double kSteepEnd = 0.8;   // of the radius beyond the end of a surface: so far it is bent on
constexpr double kInwards = 1e-4;   // of the way from a pole to the middle of its face: there it has a normal

class FaceSampler final : public SurfaceSampler {
 public:
  explicit FaceSampler(std::shared_ptr<const Target::Impl> target)
      : target_(std::move(target)), table_(target_->searchTable()) {}

  Result<Foot> closest(const Eigen::Vector3d& p, const Foot* seed) override {
    if (!p.allFinite()) {
      return fail(ErrorCode::badInput, "the closest point to a point that is not finite was asked for");
    }
    return guarded(ErrorCode::internal, "the closest point cannot be found", [&]() -> Result<Foot> {
      FaceFoot best;
      int bestFace = -1;
      tried_.clear();
      const auto attempt = [&](int face, const Eigen::Vector2d& uv) {
        tried_.push_back(face);
        const FaceFoot foot = footOnFace(*target_->faces[face], target_->model->edges, p, uv);
        if (foot.distance < best.distance) {
          best = foot;
          bestFace = face;
        }
      };
      if (seed && seed->face >= 0 && seed->face < int(target_->faces.size()) && seed->uv.allFinite()) {
        attempt(seed->face, seed->uv);
      }
      // The seed's foot stands if the nearest sample of the target is one of its own neighbours and no nearer
      // than it, nor is the grid beside that; on a border another face may go on.
      const bool crosses = best.onBorder && target_->faces.size() > 1;
      double nearest = 0;
      const int sample = table_.tree.nearest(p, best.distance + table_.spacing, nearest);
      const auto isItsOwn = [&] {
        const double radius = table_.samples[std::size_t(sample)].radius;
        return nearest >= best.distance && (point(sample) - best.point).norm() <= 2 * radius &&
               !passesNearer(p, sample, best.distance);
      };
      const bool stands = bestFace >= 0 && !crosses && (sample < 0 || isItsOwn());
      if (!stands && sample >= 0) search(p, nearest, sample, attempt);
      tryOthers(p, best.distance, attempt);
      if (bestFace < 0)
        return fail(ErrorCode::internal, "the target has no point that could be the closest one");
      return finish(p, best, bestFace);
    });
  }

  Result<SurfaceJet> at(int faceIndex, const Eigen::Vector2d& uv) const override {
    if (faceIndex < 0 || faceIndex >= int(target_->faces.size()))
      return fail(ErrorCode::badInput,
                  "the target has no face " + std::to_string(faceIndex) + " to evaluate, only " +
                      std::to_string(target_->faces.size()),
                  "face", faceIndex, double(target_->faces.size()) - 1);
    const FaceGeometry& face = *target_->faces[std::size_t(faceIndex)];
    const Eigen::Vector2d place = uv.allFinite() ? face.wrapped(uv) : uv;
    const Eigen::AlignedBox2d range(Eigen::Vector2d(face.u0(), face.v0()),
                                    Eigen::Vector2d(face.u1(), face.v1()));
    const Eigen::Vector2d inside = place.cwiseMax(range.min()).cwiseMin(range.max());
    if (!((place - inside).cwiseAbs().array() <= kSameSize * range.sizes().array()).all())
      return fail(ErrorCode::badInput, "the parameters of a point lie outside those of its face", "uv");
    return guarded(ErrorCode::internal, "the surface cannot be evaluated", [&]() -> Result<SurfaceJet> {
      SurfaceJet jet;
      face.patch().second(inside.x(), inside.y(), jet);
      jet.normal = (target_->flipped ? -1.0 : 1.0) * face.normal(jet);
      if (jet.normal.isZero() || face.pole(jet))
        return fail(ErrorCode::noSolution,
                    "the surface has no tangent plane at this point, such as at a pole", "uv");
      return jet;
    });
  }

  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<FaceSampler>(target_); }

 protected:
  double continued(const Eigen::Vector3d& p, const Foot& foot) const override {
    const double side = target_->flipped ? -1.0 : 1.0;
    const auto above = [&](const FaceFoot& at) { return (p - at.point).dot(at.normal); };
    const auto below = [&](const FaceFoot& at) {
      return !at.normal.isZero() &&
             (p - at.point - above(at) * at.normal).norm() <= kSideRatio * at.distance + kSlack;
    };
    const auto off = [&](const FaceGeometry& face, const FaceFoot& at) {
      return below(at) ? above(at) : offBeyond(face, at, p, above(at));
    };
    const FaceGeometry& ownFace = *target_->faces[std::size_t(foot.face)];
    const FaceFoot own = footOnSurface(ownFace, p, foot.uv);
    double nearest = own.normal.isZero() ? SurfaceSampler::continued(p, foot) : side * off(ownFace, own);
    double away = own.distance;  // of the foot, where none has p above it
    bool known = below(own);
    const auto look = [&](const FaceGeometry& face, bool carries) {
      const FaceFoot there = footOnSurface(face, p, nearGridPlace(face, p));
      const bool better = below(there) ? !known || std::abs(above(there)) < std::abs(nearest)
                                       : carries && !known && !there.normal.isZero() && there.distance < away;
      if (!better) return;
      nearest = side * off(face, there);
      away = there.distance;
      known = known || below(there);
    };
    // A hole may lie over the edge of two faces: then it is the other one that goes on there. Or a surface
    // goes on between several faces that lie on it.
    for (const Neighbour& neighbour : target_->neighbours[std::size_t(foot.face)])
      look(*target_->faces[std::size_t(neighbour.face)], false);
    for (const Carrier& carrier : target_->carriers) {
      const Eigen::Vector3d over = (carrier.bounds.min - p).cwiseMax(p - carrier.bounds.max).cwiseMax(0.0);
      if (over.norm() <= foot.distance + kGridSlack * carrier.bounds.size().norm())
        look(*carrier.surface, true);
    }
    return nearest;
  }

 private:
  /// How far p lies from a surface that bends on as it does at the end of its parameters, as an arc from
  /// there towards p, and where that is steep straight on; `above` the tangent plane there, mm.
  static double offBeyond(const FaceGeometry& face, const FaceFoot& at, const Eigen::Vector3d& p,
                          double above) {
    Jet jet;
    face.patch().second(at.uv.x(), at.uv.y(), jet);
    const Eigen::Vector3d beside = p - at.point - above * at.normal;
    const double way = beside.norm();
    Eigen::Matrix2d metric;
    metric << jet.du.squaredNorm(), jet.du.dot(jet.dv), jet.du.dot(jet.dv), jet.dv.squaredNorm();
    if (way == 0 || face.pole(jet) || !(std::abs(metric.determinant()) > 0)) return above;
    const Eigen::Vector2d step =
        metric.inverse() * Eigen::Vector2d(beside.dot(jet.du), beside.dot(jet.dv)) / way;
    const double bend = at.normal.dot(step.x() * step.x() * jet.duu + 2 * step.x() * step.y() * jet.duv +
                                      step.y() * step.y() * jet.dvv);
    if (!std::isfinite(bend) || bend == 0) return above;
    const double sine = std::min(way * std::abs(bend), kSteepEnd), cosine = std::sqrt(1 - sine * sine);
    const double bent = sine / std::abs(bend);
    const double risen = bend * bent * bent / (1 + cosine) + bend * bent / cosine * (way - bent);
    return cosine * (above - risen);
  }

  /// The place of the nearest of some nodes of a face's grid.
  static Eigen::Vector2d nearGridPlace(const FaceGeometry& face, const Eigen::Vector3d& p) {
    const std::size_t nu = face.gridU().size(), nv = face.gridV().size(),
                      stepU = std::max<std::size_t>(1, nu / kLooks),
                      stepV = std::max<std::size_t>(1, nv / kLooks);
    Eigen::Vector2d place(face.u0(), face.v0());
    double nearest = 1e300;
    for (std::size_t i = 0; i < nu; i += stepU)
      for (std::size_t j = 0; j < nv; j += stepV) {
        const double distance = (face.gridPoint(int(i), int(j)) - p).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        place = {face.gridU()[i], face.gridV()[j]};
      }
    return place;
  }

  /// Newton starts at the samples from which no neighbour is nearer to `p`, the nearest of them first; at
  /// the `sample` nearest to it where there is none, as where a node of the grid beside a face is nearer.
  template <class Attempt>
  void search(const Eigen::Vector3d& p, double nearest, int sample, const Attempt& attempt) {
    found_.clear();
    table_.tree.within(p, nearest + 2 * table_.samples[std::size_t(sample)].radius, found_);
    order_.clear();
    for (const int i : found_) {
      const double d2 = (point(i) - p).squaredNorm();
      if (lowest(i, p, d2)) order_.emplace_back(d2, i);
    }
    std::sort(order_.begin(), order_.end());
    int starts = 0;
    for (const auto& [d2, i] : order_) {
      const SearchTable::Sample& s = table_.samples[std::size_t(i)];
      attempt(s.face, Eigen::Vector2d(s.u, s.v));
      if (++starts == kStarts) break;
    }
    if (starts > 0) return;
    const SearchTable::Sample& s = table_.samples[std::size_t(sample)];
    attempt(s.face, Eigen::Vector2d(s.u, s.v));
  }

  /// Starts on the faces that were not tried and may come nearer to `p` than `distance`, which `attempt`
  /// lowers: the samples of a large face are far from one another, those of a small one beside it are not.
  template <class Attempt>
  void tryOthers(const Eigen::Vector3d& p, const double& distance, const Attempt& attempt) {
    if (target_->faces.size() < 2) return;
    struct Others {
      const FaceSampler& sampler;
      const Eigen::Vector3d& p;
      const double& distance;
      const Attempt& attempt;

      bool intersectVolume(const Eigen::AlignedBox3d& box) const {
        return box.exteriorDistance(p) < distance - kSlack;
      }
      bool intersectObject(int index) const {
        const SearchTable::Face& face = sampler.table_.faces[std::size_t(index)];
        if (face.count == 0 || !intersectVolume(face.box) || sampler.tried(index)) return false;
        const auto first = sampler.table_.points.begin() + face.first;
        const auto from = [&](const Eigen::Vector3d& q) { return (q - p).squaredNorm(); };
        const auto nearest = std::ranges::min_element(first, first + face.count, {}, from);
        if ((*nearest - p).norm() - 2 * face.spacing >= distance) return false;
        const SearchTable::Sample& s =
            sampler.table_.samples[std::size_t(nearest - sampler.table_.points.begin())];
        attempt(index, Eigen::Vector2d(s.u, s.v));
        return false;  // go on
      }
    };
    Others others{*this, p, distance, attempt};
    Eigen::BVIntersect(table_.tower, others);
  }

  bool tried(int face) const { return std::ranges::find(tried_, face) != tried_.end(); }

  /// Whether a line of the grid through that sample passes nearer to p than `distance`. Where this is little
  /// beside the grid's finer way, nothing that the grid shows of the surface has two feet so near.
  bool passesNearer(const Eigen::Vector3d& p, int index, double distance) const {
    const SearchTable::Sample& s = table_.samples[std::size_t(index)];
    if (s.i < 0 || 2 * distance < s.fine) return false;
    const FaceGeometry& face = *target_->faces[std::size_t(s.face)];
    const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
    for (const auto& [i, j] : {std::pair(s.i - 1, s.j), std::pair(s.i + 1, s.j), std::pair(s.i, s.j - 1),
                               std::pair(s.i, s.j + 1)}) {
      if (i < 0 || j < 0 || i >= nu || j >= nv || !face.gridInside(i, j)) continue;
      const Eigen::Vector3d &a = point(index), &b = face.gridPoint(i, j);
      const Eigen::Vector3d place = a + nearestOnSegment(p, a, b) * (b - a);
      if ((place - p).squaredNorm() < distance * distance) return true;
    }
    return false;
  }

  bool lowest(int index, const Eigen::Vector3d& p, double d2) const {
    const SearchTable::Sample& s = table_.samples[std::size_t(index)];
    if (s.i < 0) {
      for (const int other : {index - 1, index + 1}) {
        if (other < 0 || other >= int(table_.samples.size())) continue;
        const SearchTable::Sample& o = table_.samples[std::size_t(other)];
        if (o.face == s.face && o.i < 0 && o.j == s.j && (point(other) - p).squaredNorm() < d2) return false;
      }
      return true;
    }
    const FaceGeometry& face = *target_->faces[s.face];
    const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
    for (int a = std::max(s.i - 1, 0); a <= std::min(s.i + 1, nu - 1); ++a) {
      for (int b = std::max(s.j - 1, 0); b <= std::min(s.j + 1, nv - 1); ++b) {
        if ((face.gridPoint(a, b) - p).squaredNorm() < d2) return false;
      }
    }
    return true;
  }

  const Eigen::Vector3d& point(int i) const { return table_.points[std::size_t(i)]; }

  Foot finish(const Eigen::Vector3d& p, const FaceFoot& best, int faceIndex) const {
    const FaceGeometry& face = *target_->faces[faceIndex];
    Foot foot;
    foot.face = faceIndex;
    foot.uv = best.uv;
    foot.point = best.point;
    foot.distance = best.distance;
    foot.normal = best.normal.squaredNorm() > 0.5 ? best.normal : face.normal(best.uv.x(), best.uv.y());
    if (foot.normal.squaredNorm() < 0.5) {
      // A pole has no normal of its own: take one a little towards the middle of the face.
      const Eigen::Vector2d middle(0.5 * (face.u0() + face.u1()), 0.5 * (face.v0() + face.v1()));
      const Eigen::Vector2d inner = best.uv + kInwards * (middle - best.uv);
      foot.normal = face.normal(inner.x(), inner.y());
      if (foot.normal.squaredNorm() < 0.5) foot.normal = Eigen::Vector3d::UnitZ();
    }
    if (target_->flipped) foot.normal = -foot.normal;
    if (!best.onBorder) return foot;
    const Eigen::Vector3d r = p - best.point;
    const double lean = (r - r.dot(foot.normal) * foot.normal).norm();
    const bool free = best.edge < 0 || target_->freeEdge(best.edge) || atFreeEdge(face, best.point);
    if (free || lean <= sewnGap(best.edge)) foot.onBoundary = lean > kSideRatio * best.distance + kSlack;
    return foot;
  }

  /// mm between two faces that were sewn together along an edge although a gap is between them; less is none.
  double sewnGap(int edge) const {
    const double tolerance = target_->model->edges[std::size_t(edge)].tolerance;
    return tolerance > kSewnGap ? tolerance : 0;
  }

  /// Whether an edge of this face alone begins or ends at a point of its border.
  bool atFreeEdge(const FaceGeometry& face, const Eigen::Vector3d& point) const {
    return std::ranges::any_of(face.trims(), [&](const TrimEdge& trim) {
      if (!target_->freeEdge(trim.edge)) return false;
      const EdgeGeometry& edge = target_->model->edges[std::size_t(trim.edge)];
      return !edge.degenerate() && std::min((edge.points.front() - point).norm(),
                                            (edge.points.back() - point).norm()) <= kSlack + edge.tolerance;
    });
  }

  std::shared_ptr<const Target::Impl> target_;
  const SearchTable& table_;
  std::vector<int> found_, tried_;
  std::vector<std::pair<double, int>> order_;
};

}  // namespace

const SearchTable& Target::Impl::searchTable() const {
  std::call_once(tableOnce, [this] {
    auto made = std::make_unique<SearchTable>();
    std::vector<Eigen::Vector3d> points;
    const auto add = [&](int face, int i, int j, double u, double v, const Eigen::Vector3d& p, double radius,
                         double fine) {
      made->samples.push_back({face, i, j, u, v, radius, fine});
      made->spacing = std::max(made->spacing, radius);
      made->faces.back().spacing = std::max(made->faces.back().spacing, radius);
      points.push_back(p);
    };
    for (int f = 0; f < int(faces.size()); ++f) {
      const Bounds& range = model->info.faceList[std::size_t(indices[std::size_t(f)])].bounds;
      made->faces.push_back({int(points.size()), 0, 0, {range.min, range.max}});
      const FaceGeometry& face = *faces[f];
      const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
      for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
          if (!face.gridInside(i, j)) continue;
          const Eigen::Vector3d& p = face.gridPoint(i, j);
          double radius2 = 0, fine2 = 1e300;
          for (const auto& [a, b] :
               {std::pair(i - 1, j), std::pair(i + 1, j), std::pair(i, j - 1), std::pair(i, j + 1)}) {
            if (a >= 0 && b >= 0 && a < nu && b < nv) {
              const double way2 = (face.gridPoint(a, b) - p).squaredNorm();
              radius2 = std::max(radius2, way2);
              fine2 = std::min(fine2, way2);
            }
          }
          add(f, i, j, face.gridU()[i], face.gridV()[j], p, std::sqrt(radius2), std::sqrt(fine2));
        }
      }
      if (face.natural()) continue;
      for (const TrimEdge& trim : face.trims()) {
        if (trim.edge < 0) continue;
        const EdgeGeometry& edge = model->edges[trim.edge];
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
          const Eigen::Vector2d uv = face.wrapped(trim.value(std::clamp(edge.t[i], trim.first, trim.last)));
          const Eigen::Vector3d& p = edge.points[i];
          const double before = i > 0 ? (edge.points[i - 1] - p).norm() : 0.0;
          const double after = i + 1 < edge.points.size() ? (edge.points[i + 1] - p).norm() : 0.0;
          const double radius = std::max(before, after);
          add(f, -1, int(&trim - face.trims().data()), uv.x(), uv.y(), p, radius, radius);
        }
      }
    }
    for (std::size_t f = 0; f < made->faces.size(); ++f)
      made->faces[f].count =
          (f + 1 < faces.size() ? made->faces[f + 1].first : int(points.size())) - made->faces[f].first;
    std::vector<int> all(faces.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const SearchTable::Face& face : made->faces) boxes.push_back(face.box);
    made->tower.init(all.begin(), all.end(), boxes.begin(), boxes.end());
    made->points = points;
    made->tree = PointTree(std::move(points));
    table = std::move(made);
  });
  return *table;
}

std::unique_ptr<SurfaceSampler> Target::sampler() const { return std::make_unique<FaceSampler>(impl_); }

}  // namespace bw::geometry
