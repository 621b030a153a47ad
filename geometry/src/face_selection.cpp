// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "bw/core/text/number_text.h"
#include "bw/geometry/cad_model.h"
#include "model_impl.h"

namespace bw::geometry {

namespace {

constexpr double kThin =
    0.01;  // mm; a face thinner than this cannot be cut, nor told from a fault of its file
constexpr std::size_t kNamesTold = 8;  // in an error about a name

/// The width of a face: its area over half its border.
double widthOf(const FaceGeometry& face, const std::vector<EdgeGeometry>& edges) {
  double border = 0;
  for (const TrimEdge& trim : face.trims()) {
    const auto& points = edges[trim.edge].points;
    for (std::size_t i = 1; i < points.size(); ++i) border += (points[i] - points[i - 1]).norm();
  }
  return border > 0 ? 2 * face.area() / border : std::sqrt(face.area());
}

constexpr double kMuchLeft =
    0.01;  // of the face that is cut: more than this in other faces of a sheet is a warning

/// Planes, cylinders and cones: what the sides, holes and roundings of a part mostly are.
bool plain(const std::string& type) { return type == "plane" || type == "cylinder" || type == "cone"; }

FaceName nameOf(const FaceInfo& face) { return {face.index, face.name, face.type, face.area}; }

double distanceToBounds(const Bounds& bounds, const Eigen::Vector3d& p) {
  return (p - p.cwiseMax(bounds.min).cwiseMin(bounds.max)).norm();
}

class Chooser {
 public:
  Chooser(const CadModel& model, Findings* findings)
      : model_(model), impl_(model.impl()), findings_(findings), count_(int(impl_.faces.size())) {}

  Result<void> usable(int i) const {
    if (!impl_.faces[i]) {
      return fail(ErrorCode::badInput,
                  "face " + std::to_string(i) + " of " + impl_.name + " cannot be used (" +
                      impl_.faceFault[i] + "); choose another face",
                  "face", i);
    }
    const double width = widthOf(*impl_.faces[i], impl_.edges);
    if (!(width >= kThin)) {
      return fail(ErrorCode::badInput,
                  "face " + std::to_string(i) + " of " + impl_.name + " is only " + shortText(width) +
                      " mm wide, less than the tolerance of " + shortText(kThin) + " mm; choose another face",
                  "face", width, kThin);
    }
    return {};
  }

  Result<std::vector<int>> largest() const {
    int best = -1, widest = -1;  // the one taken, and the largest of any kind
    for (int i = 0; i < count_; ++i) {
      if (!impl_.faces[i]) continue;
      const double area = impl_.faces[i]->area();
      if (widest < 0 || area > impl_.faces[widest]->area()) widest = i;
      if (plain(info(i).type) || !usable(i)) continue;
      if (best < 0 || area > impl_.faces[best]->area()) best = i;
    }
    if (widest < 0)
      return fail(ErrorCode::badInput, impl_.name + " has no face that can be used", impl_.name);
    if (best < 0) best = widest;
    if (auto ok = usable(best); !ok) {
      ok.error().message += "; it is the largest: check the unit of the file, read as " + impl_.info.readAs;
      return tl::unexpected(ok.error());
    }
    if (count_ > 1) {
      const double left = sheetBeside(best);
      tell(LargestFace{nameOf(info(best)), count_,
                       best != widest ? std::optional(nameOf(info(widest))) : std::nullopt, left},
           left > kMuchLeft * info(best).area ? Severity::warning : Severity::info);
    }
    return std::vector<int>{best};
  }

  Result<std::vector<int>> all() const {
    std::vector<int> result(std::size_t(count_), 0);
    std::iota(result.begin(), result.end(), 0);
    return usableOf(result);
  }

  /// Those of some faces that can be used, each once; tells how many cannot. An error if none can.
  Result<std::vector<int>> usableOf(const std::vector<int>& indices) const {
    std::vector<int> result;
    std::set<int> useless;
    for (const int i : indices) {
      if (!usable(i))
        useless.insert(i);
      else if (std::find(result.begin(), result.end(), i) == result.end())
        result.push_back(i);
    }
    if (!useless.empty() && !result.empty()) tell(FacesLeftOut{int(useless.size()), kThin});
    if (useless.size() == 1 && result.empty()) return tl::unexpected(usable(indices.front()).error());
    if (result.empty()) {
      return fail(ErrorCode::badInput,
                  "the faces of " + impl_.name + " are thinner than the tolerance of " + shortText(kThin) +
                      " mm; check the unit of the file",
                  impl_.name, 0.0, kThin);
    }
    return result;
  }

  Result<std::vector<int>> listed(const std::vector<int>& indices) const {
    if (indices.empty()) {
      return fail(ErrorCode::badInput,
                  "no face is chosen; give an index from 0 to " + std::to_string(count_ - 1), "face");
    }
    std::vector<int> result;
    for (const int i : indices) {
      if (i < 0 || i >= count_) {
        return fail(ErrorCode::badInput,
                    "face " + std::to_string(i) + " does not exist: " + impl_.name + " has " +
                        (count_ == 1 ? "one face, of index 0"
                                     : std::to_string(count_) + " faces, 0 to " + std::to_string(count_ - 1)),
                    "face", i, count_ - 1);
      }
      if (auto ok = usable(i); !ok) return tl::unexpected(ok.error());
      if (std::find(result.begin(), result.end(), i) == result.end()) result.push_back(i);
    }
    return result;
  }

  Result<std::vector<int>> named(const std::vector<std::string>& names) const {
    std::vector<int> indices;
    for (const std::string& name : names) {
      const std::size_t before = indices.size();
      for (int i = 0; i < count_; ++i) {
        if (info(i).name == name) indices.push_back(i);
      }
      if (indices.size() == before) return noSuchName(name);
    }
    return usableOf(indices);
  }

  Result<std::vector<int>> group(int index) const {
    const auto& groups = impl_.info.groups;
    if (index < 0 || index >= int(groups.size())) {
      return fail(
          ErrorCode::badInput,
          "group " + std::to_string(index) + " does not exist: the faces of " + impl_.name + " form " +
              (groups.size() == 1
                   ? "one group, 0"
                   : std::to_string(groups.size()) + " groups, 0 to " + std::to_string(groups.size() - 1)),
          "face", index, double(groups.size()) - 1);
    }
    return usableOf(groups[index].faces);
  }

  Result<std::vector<int>> nearest(const Eigen::Vector3d& point) const {
    if (!point.allFinite()) return fail(ErrorCode::badInput, "the point to be near to is not finite", "near");
    std::vector<std::pair<double, int>> order;  // lower bounds of the distance
    for (int i = 0; i < count_; ++i) {
      if (usable(i)) order.emplace_back(distanceToBounds(info(i).bounds, point), i);
    }
    std::sort(order.begin(), order.end());
    int best = -1;
    double distance = 1e300;
    for (const auto& [least, i] : order) {
      if (least > distance) break;
      const auto face = Target::make(model_, {FaceChoice::Kind::indices, {i}});
      if (!face) continue;
      const auto foot = face->sampler()->closest(point, nullptr);
      if (!foot || !(foot->distance < distance)) continue;
      distance = foot->distance;
      best = i;
    }
    if (best < 0) return fail(ErrorCode::badInput, impl_.name + " has no face that can be used", impl_.name);
    tell(NearestFace{nameOf(info(best)), point, distance});
    return std::vector<int>{best};
  }

 private:
  const FaceInfo& info(int i) const { return impl_.info.faceList[i]; }

  /// mm² of the other faces, where all belong to sheets: a solid has sides that nobody wants to cut.
  double sheetBeside(int face) const {
    if (std::ranges::find(impl_.inSolid, true) != impl_.inSolid.end()) return 0;
    double area = 0;
    for (int i = 0; i < count_; ++i)
      if (i != face && usable(i)) area += info(i).area;
    return area;
  }

  void tell(Cause cause, Severity severity = Severity::info) const {
    if (findings_) findings_->push_back({severity, std::move(cause), {}, {}});
  }

  tl::unexpected<Error> noSuchName(const std::string& name) const {
    std::vector<std::string> names;
    for (const FaceInfo& face : impl_.info.faceList) {
      if (!face.name.empty() && std::find(names.begin(), names.end(), face.name) == names.end())
        names.push_back(face.name);
    }
    std::string text = "no face of " + impl_.name + " is named \"" + name + "\"; ";
    if (names.empty()) {
      text += "its faces have no names: take the largest, all, one by its number, or the nearest to a point";
    } else {
      text += "the names are ";
      for (std::size_t i = 0; i < names.size() && i < kNamesTold; ++i)
        text += (i ? ", \"" : "\"") + names[i] + "\"";
      if (names.size() > kNamesTold) text += " and " + std::to_string(names.size() - kNamesTold) + " more";
    }
    names.insert(names.end(), {"largest", "all"});
    const std::string close = nearestWord(name, names.data(), int(names.size()));
    if (!close.empty()) text += "; did you mean \"" + close + "\"?";
    return fail(ErrorCode::badInput, text, "face");
  }

  const CadModel& model_;
  const CadModel::Impl& impl_;
  Findings* findings_;
  int count_;
};

}  // namespace

Result<std::vector<int>> CadModel::choose(const FaceChoice& choice, Findings* findings) const {
  const Chooser chooser(*this, findings);
  switch (choice.kind) {
    case FaceChoice::Kind::largest:
      return chooser.largest();
    case FaceChoice::Kind::all:
      return chooser.all();
    case FaceChoice::Kind::indices:
      return chooser.listed(choice.indices);
    case FaceChoice::Kind::named:
      return chooser.named(choice.names);
    case FaceChoice::Kind::group:
      return chooser.group(choice.group);
    case FaceChoice::Kind::nearest:
      return chooser.nearest(choice.point);
  }
  return fail(ErrorCode::badInput, "no face is chosen", "face");
}

}  // namespace bw::geometry
