// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "face_groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bw::geometry {

namespace {

constexpr int kProbes = 5;  // points of an edge at which its faces' normals are compared

struct Side {
  int face = -1;
  const TrimEdge* trim = nullptr;

  Eigen::Vector3d normal(const CadModel::Impl& model, double share) const {
    const Eigen::Vector2d uv = trim->value(trim->first + share * (trim->last - trim->first));
    return model.faces[face]->normal(uv.x(), uv.y());
  }
};

bool smooth(const CadModel::Impl& model, const Side& a, const Side& b) {
  const double least = std::cos(kSmoothJoin);
  for (int k = 0; k < kProbes; ++k) {
    const double share = (k + 0.5) / kProbes;
    const Eigen::Vector3d na = a.normal(model, share), nb = b.normal(model, share);
    // A pole has no normal and says nothing.
    if (na.squaredNorm() > 0 && nb.squaredNorm() > 0 && na.dot(nb) < least) return false;
  }
  return true;
}

}  // namespace

std::vector<FaceGroup> smoothGroups(const CadModel::Impl& model) {
  const int count = int(model.faces.size());
  std::vector<std::vector<Side>> sides(model.edges.size());
  for (int i = 0; i < count; ++i) {
    if (!model.faces[i]) continue;
    for (const TrimEdge& trim : model.faces[i]->trims()) {
      if (trim.edge >= 0 && !trim.curve.IsNull()) sides[trim.edge].push_back({i, &trim});
    }
  }
  std::vector<int> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const std::vector<Side>& pair : sides) {
    if (pair.size() != 2 || pair[0].face == pair[1].face) continue;
    if (!smooth(model, pair[0], pair[1])) continue;
    const int a = root(pair[0].face), b = root(pair[1].face);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<FaceGroup> groups;
  std::vector<int> groupOf(count, -1);
  for (int i = 0; i < count; ++i) {
    if (!model.faces[i]) continue;
    int& group = groupOf[root(i)];
    if (group < 0) {
      group = int(groups.size());
      groups.emplace_back();
    }
    groups[group].faces.push_back(i);
    groups[group].area += model.faces[i]->area();
    const Bounds& bounds = model.info.faceList[i].bounds;
    groups[group].bounds.add(bounds.min);
    groups[group].bounds.add(bounds.max);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const FaceGroup& a, const FaceGroup& b) { return a.area > b.area; });
  for (std::size_t g = 0; g < groups.size(); ++g) groups[g].index = int(g);
  return groups;
}

}  // namespace bw::geometry
