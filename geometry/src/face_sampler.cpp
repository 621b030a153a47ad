// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "face_sampler.h"

#include <algorithm>
#include <cmath>

#include "closest_point.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr int kStarts = 8;                   // Newton starts of a global search at most
constexpr std::size_t kCandidates = 4000;    // samples looked at in a global search at most
constexpr double kSideRatio = 1e-3;          // of the distance: a foot leaning more than this over the border has no side

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
      const auto attempt = [&](int face, const Eigen::Vector2d& uv) {
        const FaceFoot foot = footOnFace(*target_->faces[face], target_->model->edges, p, uv);
        if (foot.distance < best.distance) {
          best = foot;
          bestFace = face;
        }
      };
      if (seed && seed->face >= 0 && seed->face < int(target_->faces.size()) && seed->uv.allFinite()) {
        attempt(seed->face, seed->uv);
      }
      // The seed's foot stands unless some sample of the target is nearer, or a neighbouring face may go on from its border.
      const bool crosses = best.onBorder && best.edge >= 0 && !target_->freeEdge(best.edge);
      double nearest = 0;
      const int sample = table_.tree.nearest(p, crosses ? 1e300 : best.distance * (1 - 1e-12), nearest);
      if (sample >= 0) search(p, nearest, attempt);
      if (bestFace < 0) return fail(ErrorCode::internal, "the target has no point that could be the closest one");
      return finish(p, best, bestFace);
    });
  }

  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<FaceSampler>(target_); }

 private:
  template <class Attempt>
  void search(const Eigen::Vector3d& p, double nearest, const Attempt& attempt) {
    found_.clear();
    table_.tree.within(p, nearest + table_.spacing, found_);
    order_.clear();
    for (const int i : found_) order_.emplace_back((point(i) - p).squaredNorm(), i);
    const std::size_t keep = std::min(order_.size(), kCandidates);
    std::partial_sort(order_.begin(), order_.begin() + std::ptrdiff_t(keep), order_.end());
    chosen_.clear();
    for (std::size_t k = 0; k < keep && int(chosen_.size()) < kStarts; ++k) {
      const int i = order_[k].second;
      const SearchTable::Sample& s = table_.samples[std::size_t(i)];
      const bool near = std::any_of(chosen_.begin(), chosen_.end(), [&](int c) {
        return table_.samples[std::size_t(c)].face == s.face && (point(c) - point(i)).norm() < 2.5 * table_.spacing;
      });
      if (near) continue;
      chosen_.push_back(i);
      attempt(s.face, Eigen::Vector2d(s.u, s.v));
    }
  }

  const Eigen::Vector3d& point(int i) const { return table_.points[std::size_t(i)]; }

  Foot finish(const Eigen::Vector3d& p, const FaceFoot& best, int faceIndex) const {
    const FaceGeometry& face = *target_->faces[faceIndex];
    Foot foot;
    foot.face = faceIndex;
    foot.uv = best.uv;
    foot.point = best.point;
    foot.distance = best.distance;
    foot.normal = face.normal(best.uv.x(), best.uv.y());
    if (foot.normal.squaredNorm() < 0.5) {
      // A pole has no normal of its own: take one a little towards the middle of the face.
      const Eigen::Vector2d middle(0.5 * (face.u0() + face.u1()), 0.5 * (face.v0() + face.v1()));
      const Eigen::Vector2d inner = best.uv + 1e-4 * (middle - best.uv);
      foot.normal = face.normal(inner.x(), inner.y());
      if (foot.normal.squaredNorm() < 0.5) foot.normal = Eigen::Vector3d::UnitZ();
    }
    if (target_->flipped) foot.normal = -foot.normal;
    if (best.onBorder && (best.edge < 0 || target_->freeEdge(best.edge))) {
      const Eigen::Vector3d r = p - best.point;
      const double lean = (r - r.dot(foot.normal) * foot.normal).norm();
      foot.onBoundary = lean > kSideRatio * best.distance + 1e-6;
    }
    return foot;
  }

  std::shared_ptr<const Target::Impl> target_;
  const SearchTable& table_;
  std::vector<int> found_, chosen_;
  std::vector<std::pair<double, int>> order_;
};

}  // namespace

const SearchTable& Target::Impl::searchTable() const {
  std::call_once(tableOnce, [this] {
    auto made = std::make_unique<SearchTable>();
    std::vector<Eigen::Vector3d> points;
    const auto add = [&](int face, double u, double v, const Eigen::Vector3d& p) {
      made->samples.push_back({face, u, v});
      points.push_back(p);
    };
    double spacing2 = 0;
    for (int f = 0; f < int(faces.size()); ++f) {
      const FaceGeometry& face = *faces[f];
      const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
      for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
          if (!face.gridInside(i, j)) continue;
          const Eigen::Vector3d& p = face.gridPoint(i, j);
          add(f, face.gridU()[i], face.gridV()[j], p);
          if (i > 0) spacing2 = std::max(spacing2, (face.gridPoint(i - 1, j) - p).squaredNorm());
          if (j > 0) spacing2 = std::max(spacing2, (face.gridPoint(i, j - 1) - p).squaredNorm());
        }
      }
      if (face.natural()) continue;
      for (const TrimEdge& trim : face.trims()) {
        if (trim.edge < 0) continue;
        const EdgeGeometry& edge = model->edges[trim.edge];
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
          const Eigen::Vector2d uv = face.wrapped(trim.value(std::clamp(edge.t[i], trim.first, trim.last)));
          add(f, uv.x(), uv.y(), edge.points[i]);
        }
      }
    }
    made->spacing = std::sqrt(spacing2);
    made->points = points;
    made->tree = PointTree(std::move(points));
    table = std::move(made);
  });
  return *table;
}

std::unique_ptr<SurfaceSampler> makeSampler(std::shared_ptr<const Target::Impl> target) {
  return std::make_unique<FaceSampler>(std::move(target));
}

}  // namespace bw::geometry
