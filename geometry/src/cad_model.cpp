// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/cad_model.h"

#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bw/core/files/file_set.h"
#include "bw/geometry/sections.h"
#include "cad_reader.h"
#include "model_impl.h"
#include "occt.h"
#include "spline_face.h"

namespace bw::geometry {

namespace {

constexpr int kNormalProbes = 5;  // points of an edge at which its faces' normals are compared

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
  for (int k = 0; k < kNormalProbes; ++k) {
    const double share = (k + 0.5) / kNormalProbes;
    const Eigen::Vector3d na = a.normal(model, share), nb = b.normal(model, share);
    // A pole has no normal and says nothing.
    if (na.squaredNorm() > 0 && nb.squaredNorm() > 0 && na.dot(nb) < least) return false;
  }
  return true;
}

/// Puts the faces that can be computed with into groups: two belong together if they share an edge along
/// which their outer normals differ by no more than kSmoothJoin. Largest area first.
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

Result<std::shared_ptr<const CadModel::Impl>> build(ReadShape read, const std::string& name,
                                                    const RunContext& context, const ReadOptions& options) {
  auto impl = std::make_shared<CadModel::Impl>();
  impl->name = name;
  impl->shape = read.shape;
  CadInfo& info = impl->info;
  info.format = read.format;
  info.unit = read.unit;
  info.readAs = options.unit ? lengthUnitName(*options.unit) : read.unit;
  info.unitLength = unitLength(info.unit);
  info.readAsLength = options.unit ? millimetres(*options.unit) : info.unitLength;
  info.sewing = options.sewing;
  info.healing = read.healing;
  info.leftOut = read.leftOut;

  const std::vector<TopoDS_Shape>& faces = read.faces;
  TopTools_IndexedMapOfShape edges, shells, solids;
  TopExp::MapShapes(read.shape, TopAbs_EDGE, edges);
  TopExp::MapShapes(read.shape, TopAbs_SHELL, shells);
  TopExp::MapShapes(read.shape, TopAbs_SOLID, solids);
  info.faces = int(faces.size());
  info.edges = edges.Extent();
  info.shells = shells.Extent();
  info.solids = solids.Extent();

  TopTools_IndexedDataMapOfShapeListOfShape solidOf;
  TopExp::MapShapesAndAncestors(read.shape, TopAbs_FACE, TopAbs_SOLID, solidOf);

  impl->edges.reserve(std::size_t(edges.Extent()));
  for (int i = 1; i <= edges.Extent(); ++i) impl->edges.emplace_back(TopoDS::Edge(edges(i)));

  const int count = int(faces.size());
  impl->faces.resize(std::size_t(count));
  impl->faceFault.resize(std::size_t(count));
  impl->inSolid.assign(std::size_t(count), false);
  for (int i = 0; i < count; ++i)
    impl->inSolid[i] = solidOf.Contains(faces[i]) && !solidOf.FindFromKey(faces[i]).IsEmpty();
  info.faceList.resize(std::size_t(count));
  const auto done = parallelFor(context, count, [&](int i) {
    FaceInfo& face = info.faceList[i];
    face.index = i;
    face.type = "other";
    face.name = read.names[i];
    try {
      impl->faces[i] = FaceGeometry::make(TopoDS::Face(faces[i]), i,
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
      info.leftOut.push_back("face " + std::to_string(i) + " is left out: " + impl->faceFault[i]);
    }
  }
  if (!info.bounds.valid() || !info.bounds.min.allFinite() || !info.bounds.max.allFinite()) {
    return fail(ErrorCode::badInput,
                name + " cannot be used: none of its " + std::to_string(count) +
                    " faces has finite bounds; trim the surface in the CAD program and export it again",
                name);
  }
  info.groups = smoothGroups(*impl);
  for (const FaceGroup& group : info.groups) {
    for (const int i : group.faces) info.faceList[i].group = group.index;
  }
  return impl;
}

constexpr int kAcross = 5;            // sections of a face in each main direction
constexpr int kCurvatureProbes = 33;  // points of a section

/// The height of an arc of this curvature over a chord as long as the face.
double rise(double curvature, double size) { return std::abs(curvature) * size * size / 8; }

void addBending(const FaceGeometry& geometry, FaceInfo& face) {
  const CurvatureRange range = geometry.curvatureRange();
  face.curvatureMin = range.min;
  face.curvatureMax = range.max;
  const double size = face.bounds.size().norm(), greater = std::max(std::abs(range.min), std::abs(range.max));
  face.curved = rise(greater, size) <= kCurvedTolerance        ? "flat"
                : rise(range.lesser, size) <= kCurvedTolerance ? "singly"
                                                               : "doubly";
  face.minRadius = greater > 0 ? 1 / greater : 0;
}

/// Sections across the main directions of the block that the face alone would get.
void addSections(const CadModel& model, FaceInfo& face, const RunContext& context) {
  const auto target = Target::make(model, {FaceChoice::Kind::indices, {face.index}});
  if (!target) return;
  Findings ignored;
  auto setup = resolveSetup(*target, {}, ignored);
  if (!setup) return;
  RunContext alone;
  alone.stop = context.stop;
  alone.threads = 1;
  for (const Eigen::Vector3d& direction : {setup->block.frame.x, setup->block.frame.y}) {
    setup->planes = PlaneFamily::across(setup->block, direction);
    const auto sections = cutSections(*target, *setup, {kAcross, {}}, alone, ignored);
    if (!sections) continue;
    FaceSections facts;
    facts.direction = direction;
    facts.shortest = 1e300;
    double tightest = 0;
    for (const Section& section : *sections) {
      if (section.chosen < 0) continue;
      const PlanarCurve& curve = section.curve();
      const double length = curve.length();
      facts.shortest = std::min(facts.shortest, length);
      facts.longest = std::max(facts.longest, length);
      const double from = curve.start(), step = (curve.end() - from) / (kCurvatureProbes - 1);
      for (int i = 0; i < kCurvatureProbes; ++i) {
        const double curvature = std::abs(curve.curvature(from + i * step));
        if (std::isfinite(curvature)) tightest = std::max(tightest, curvature);
      }
    }
    facts.minRadius = tightest > 0 ? 1 / tightest : 0;
    face.sections.push_back(facts);
  }
}

}  // namespace

Result<std::shared_ptr<const CadModel::Impl>> modelOf(const TopoDS_Face& face, const std::string& name) {
  RunContext alone;
  alone.threads = 1;
  return build({face, "designed", "mm", {}, {}, {face}, {name}}, name, alone, {});
}

CadModel::CadModel(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Result<CadModel> CadModel::read(const std::filesystem::path& file, const RunContext& context,
                                const ReadOptions& options) {
  auto bytes = readFile(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return readBytes(*bytes, file.string(), context, options);
}

Result<CadModel> CadModel::readBytes(const std::string& bytes, const std::string& name,
                                     const RunContext& context, const ReadOptions& options) {
  auto read = readShape(bytes, name, options, context);
  if (!read) return tl::unexpected(read.error());
  return guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<CadModel> {
    auto impl = build(std::move(*read), name, context, options);
    if (!impl) return tl::unexpected(impl.error());
    return CadModel(std::move(*impl));
  });
}

Result<CadModel> CadModel::of(const SplineSurface& surface, const std::string& name) {
  silenceOcct();
  return guarded(ErrorCode::badInput, "no face can be made of " + name, [&]() -> Result<CadModel> {
    if (Result<void> ok = checkSplineSurface(surface); !ok) return tl::unexpected(ok.error());
    auto impl = modelOf(faceOf(surface), name);
    if (!impl) return tl::unexpected(impl.error());
    return CadModel(std::move(*impl));
  });
}

const CadInfo& CadModel::info() const { return impl_->info; }

Result<CadInfo> CadModel::infoInFull(const RunContext& context) const {
  CadInfo info = impl_->info;
  const auto done = parallelFor(context, int(info.faceList.size()), [&](int i) {
    FaceInfo& face = info.faceList[i];
    if (!impl_->faces[i]) return;
    try {
      addBending(*impl_->faces[i], face);
      addSections(*this, face, context);
    } catch (const Standard_Failure&) {
      // A surface without second derivatives keeps a range of zero.
    }
  });
  if (!done) return tl::unexpected(done.error());
  return info;
}

}  // namespace bw::geometry
