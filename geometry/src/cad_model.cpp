// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/cad_model.h"

#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <algorithm>

#include "bw/core/file_set.h"
#include "bw/core/number_text.h"
#include "cad_reader.h"
#include "model_impl.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr double kThin =
    0.01;  // mm; a face thinner than this cannot be cut, nor told from a fault of its file

/// The width of a face: its area over half its border.
double widthOf(const FaceGeometry& face, const std::vector<EdgeGeometry>& edges) {
  double border = 0;
  for (const TrimEdge& trim : face.trims()) {
    const auto& points = edges[trim.edge].points;
    for (std::size_t i = 1; i < points.size(); ++i) border += (points[i] - points[i - 1]).norm();
  }
  return border > 0 ? 2 * face.area() / border : std::sqrt(face.area());
}

Result<std::shared_ptr<const CadModel::Impl>> build(ReadShape read, const std::string& name,
                                                    const RunContext& context) {
  auto impl = std::make_shared<CadModel::Impl>();
  impl->name = name;
  impl->shape = read.shape;
  CadInfo& info = impl->info;
  info.format = read.format;
  info.unit = read.unit;
  info.healing = read.healing;

  TopTools_IndexedMapOfShape faces, edges, shells, solids;
  TopExp::MapShapes(read.shape, TopAbs_FACE, faces);
  TopExp::MapShapes(read.shape, TopAbs_EDGE, edges);
  TopExp::MapShapes(read.shape, TopAbs_SHELL, shells);
  TopExp::MapShapes(read.shape, TopAbs_SOLID, solids);
  info.faces = faces.Extent();
  info.edges = edges.Extent();
  info.shells = shells.Extent();
  info.solids = solids.Extent();

  TopTools_IndexedDataMapOfShapeListOfShape solidOf;
  TopExp::MapShapesAndAncestors(read.shape, TopAbs_FACE, TopAbs_SOLID, solidOf);

  impl->edges.reserve(std::size_t(edges.Extent()));
  for (int i = 1; i <= edges.Extent(); ++i) impl->edges.emplace_back(TopoDS::Edge(edges(i)));

  const int count = faces.Extent();
  impl->faces.resize(std::size_t(count));
  impl->faceFault.resize(std::size_t(count));
  impl->inSolid.assign(std::size_t(count), false);
  for (int i = 0; i < count; ++i)
    impl->inSolid[i] = solidOf.Contains(faces(i + 1)) && !solidOf.FindFromKey(faces(i + 1)).IsEmpty();
  info.faceList.resize(std::size_t(count));
  const auto done = parallelFor(context, count, [&](int i) {
    FaceInfo& face = info.faceList[i];
    face.index = i;
    face.type = "other";
    try {
      impl->faces[i] = FaceGeometry::make(TopoDS::Face(faces(i + 1)), i,
                                          [&](const TopoDS_Edge& e) { return edges.FindIndex(e) - 1; });
      face.type = impl->faces[i]->patch().type();
      face.area = impl->faces[i]->area();
      face.bounds = impl->faces[i]->bounds(impl->edges);
    } catch (const Standard_Failure& failure) {
      impl->faces[i] = nullptr;
      impl->faceFault[i] = failureText(failure);
    }
  });
  if (!done) return tl::unexpected(done.error());
  for (const FaceInfo& face : info.faceList) {
    if (!face.bounds.valid()) continue;
    info.bounds.add(face.bounds.min);
    info.bounds.add(face.bounds.max);
  }
  for (int i = 0; i < count; ++i) {
    if (!impl->faces[i]) {
      info.healing.push_back("face " + std::to_string(i) + " is left out: " + impl->faceFault[i]);
    }
  }
  if (!info.bounds.valid() || !info.bounds.min.allFinite() || !info.bounds.max.allFinite()) {
    return fail(ErrorCode::badInput,
                name + " cannot be used: none of its " + std::to_string(count) +
                    " faces has finite bounds; trim the surface in the CAD program and export it again",
                name);
  }
  return impl;
}

}  // namespace

CadModel::CadModel(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Result<CadModel> CadModel::read(const std::filesystem::path& file, const RunContext& context) {
  auto bytes = readFile(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return readBytes(*bytes, file.string(), context);
}

Result<CadModel> CadModel::readBytes(const std::string& bytes, const std::string& name,
                                     const RunContext& context) {
  auto read = readShape(bytes, name, context);
  if (!read) return tl::unexpected(read.error());
  return guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<CadModel> {
    auto impl = build(std::move(*read), name, context);
    if (!impl) return tl::unexpected(impl.error());
    return CadModel(std::move(*impl));
  });
}

const CadInfo& CadModel::info() const { return impl_->info; }

CadInfo CadModel::infoWithCurvatures() const {
  CadInfo info = impl_->info;
  for (FaceInfo& face : info.faceList) {
    if (!impl_->faces[face.index]) continue;
    try {
      const auto range = impl_->faces[face.index]->curvatureRange();
      face.curvatureMin = range[0];
      face.curvatureMax = range[1];
    } catch (const Standard_Failure&) {
      // A surface without second derivatives keeps a range of zero.
    }
  }
  return info;
}

Result<std::vector<int>> CadModel::choose(const FaceChoice& choice) const {
  const int count = int(impl_->faces.size());
  const auto usable = [&](int i) -> Result<void> {
    if (!impl_->faces[i]) {
      return fail(ErrorCode::badInput,
                  "face " + std::to_string(i) + " of " + impl_->name + " cannot be used (" +
                      impl_->faceFault[i] + "); choose another face",
                  "face", i);
    }
    const double width = widthOf(*impl_->faces[i], impl_->edges);
    if (!(width >= kThin)) {
      return fail(ErrorCode::badInput,
                  "face " + std::to_string(i) + " of " + impl_->name + " is only " + shortText(width) +
                      " mm wide, less than the tolerance of " + shortText(kThin) + " mm; choose another face",
                  "face", width, kThin);
    }
    return {};
  };
  std::vector<int> result;
  if (choice.kind == FaceChoice::Kind::largest) {
    int best = -1;
    for (int i = 0; i < count; ++i) {
      if (!impl_->faces[i]) continue;
      if (best < 0 || impl_->faces[i]->area() > impl_->faces[best]->area()) best = i;
    }
    if (best < 0)
      return fail(ErrorCode::badInput, impl_->name + " has no face that can be used", impl_->name);
    if (auto ok = usable(best); !ok) {
      ok.error().message += "; it is the largest: check the unit of the file, read as " + impl_->info.unit;
      return tl::unexpected(ok.error());
    }
    result.push_back(best);
    return result;
  }
  if (choice.kind == FaceChoice::Kind::all) {
    for (int i = 0; i < count; ++i) {
      if (usable(i)) result.push_back(i);
    }
    if (result.empty()) {
      return fail(ErrorCode::badInput,
                  "all faces of " + impl_->name + " are thinner than the tolerance of " + shortText(kThin) +
                      " mm; check the unit of the file",
                  impl_->name, 0.0, kThin);
    }
    return result;
  }
  if (choice.indices.empty()) {
    return fail(ErrorCode::badInput,
                "no face is chosen; give an index from 0 to " + std::to_string(count - 1), "face");
  }
  for (const int i : choice.indices) {
    if (i < 0 || i >= count) {
      return fail(ErrorCode::badInput,
                  "face " + std::to_string(i) + " does not exist: " + impl_->name + " has " +
                      (count == 1 ? "one face, of index 0"
                                  : std::to_string(count) + " faces, 0 to " + std::to_string(count - 1)),
                  "face", i, count - 1);
    }
    if (auto ok = usable(i); !ok) return tl::unexpected(ok.error());
    if (std::find(result.begin(), result.end(), i) == result.end()) result.push_back(i);
  }
  return result;
}

}  // namespace bw::geometry
