// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/drawn_design.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "bw/core/design/surface_curves.h"
#include "bw/core/dxf/dxf_curves.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/typed_number.h"
#include "bw/geometry/cad_curves.h"
#include "bw/pipeline/example_design.h"

namespace bw::pipeline {

namespace {

constexpr double kBelow = 150, kAbove = 100;  // mm of foam under and over the surface
constexpr double kLonger = 200;               // mm of a blade than what it cuts
constexpr double kReadable = 1e9;             // parts of a mm that places are rounded to
constexpr double kRounding = 1e-12;           // of a direction: what is left of an axis
constexpr double kWhole = 10;                 // mm to which its length is rounded up

/// The curves that are asked for; an error tells of the first one of them that cannot be used.
Result<std::vector<SpaceCurve>> chosen(const DrawnCurves& all, const DrawnRequest& request) {
  std::vector<SpaceCurve> curves = all.curves;
  std::vector<UnusableCurve> unusable = all.unusable;
  if (!request.names.empty()) {
    const std::vector<DrawnLayer> layers = layersOf(all);
    for (const std::string& wanted : request.names) {
      if (std::ranges::find(layers, wanted, &DrawnLayer::name) != layers.end()) continue;
      std::vector<std::string> names;
      for (const DrawnLayer& layer : layers)
        if (!layer.name.empty()) names.push_back(layer.name);
      const std::string nearest = nearestWord(wanted, names.data(), int(names.size()));
      std::string some;
      for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 10); ++i)
        some += (i ? ", " : "; there are ") + names[i];
      return fail(ErrorCode::badInput,
                  "there is no layer or curve \"" + wanted + "\" in the file" +
                      (nearest.empty() ? some : "; did you mean \"" + nearest + "\"?"),
                  "layer");
    }
    const auto other = [&](const auto& curve) {
      return std::ranges::find(request.names, curve.name) == request.names.end();
    };
    std::erase_if(curves, other);
    std::erase_if(unusable, other);
  }
  if (!request.numbers.empty()) {
    std::vector<int> there;
    for (const SpaceCurve& curve : curves) there.push_back(curve.number);
    for (const UnusableCurve& curve : unusable) there.push_back(curve.number);
    std::ranges::sort(there);
    const int most = there.back();
    const Result<std::vector<int>> numbers = readNumberList(request.numbers, most, "curve", 1);
    if (!numbers) return tl::unexpected<Error>(numbers.error());
    for (const int number : *numbers)
      if (!std::ranges::binary_search(there, number))
        return fail(ErrorCode::badInput,
                    "there is no curve " + std::to_string(number) +
                        " among those of the file; the first is " + std::to_string(there.front()) +
                        ", the last " + std::to_string(most),
                    "curves", number, most);
    const auto other = [&](const auto& curve) {
      return std::ranges::find(*numbers, curve.number) == numbers->end();
    };
    std::erase_if(curves, other);
    std::erase_if(unusable, other);
  }
  if (!unusable.empty()) return tl::unexpected<Error>(unusable.front().why);
  return curves;
}

/// Whether something at or below a place of the design's file is told by an expression.
bool isBound(const Design& design, const std::string& place) {
  const auto first = design.bindings.lower_bound(place);
  return first != design.bindings.end() && first->first.starts_with(place);
}

/// Where the block lies around the surface.
BlockPlacement blockAround(const DrawnSections& drawn) {
  const Eigen::Matrix3d axes = rotationFromAngles(drawn.surface.rotation);
  Eigen::Vector3d min = drawn.bounds.min, max = drawn.bounds.max;
  min.z() = std::floor(min.z() - kBelow);
  max.z() = std::ceil(max.z() + kAbove);
  const auto readable = [](const Eigen::Vector3d& mm) -> Eigen::Vector3d {
    return (mm * kReadable).array().round().matrix() / kReadable;
  };
  return {readable(drawn.surface.origin + axes * min), readable(max - min), drawn.surface.rotation};
}

}  // namespace

Result<DrawnCurves> drawnCurves(const std::string& bytes, const std::string& name,
                                std::optional<LengthUnit> unit, const RunContext& context) {
  if (isDxf(bytes)) {
    Result<DxfCurves> read =
        readDxf(bytes, name, unit ? std::optional(millimetres(*unit)) : std::nullopt, context);
    if (!read) return tl::unexpected<Error>(read.error());
    return DrawnCurves{"DXF", std::move(read->unit), std::move(read->curves), std::move(read->unusable),
                       std::move(read->leftOut)};
  }
  Result<geometry::CadCurves> read = geometry::readCurves(bytes, name, context, {unit});
  if (!read) return tl::unexpected<Error>(read.error());
  return DrawnCurves{
      std::move(read->format), std::move(read->unit), std::move(read->curves), {}, std::move(read->leftOut)};
}

std::vector<DrawnLayer> layersOf(const DrawnCurves& curves) {
  std::map<std::string, int> counts;
  for (const SpaceCurve& curve : curves.curves) ++counts[curve.name];
  for (const UnusableCurve& curve : curves.unusable) ++counts[curve.name];
  std::vector<DrawnLayer> layers;
  for (const auto& [name, count] : counts) layers.push_back({name, count});
  return layers;
}

Result<DrawnDesign> designThrough(const std::string& bytes, const std::string& name,
                                  const DrawnRequest& request, const RunContext& context) {
  const Result<DrawnCurves> curves = drawnCurves(bytes, name, request.unit, context);
  if (!curves) return tl::unexpected<Error>(curves.error());
  return designThrough(*curves, name, request, context);
}

Result<DrawnDesign> designThrough(const DrawnCurves& all, const std::string& name,
                                  const DrawnRequest& request, const RunContext& context) {
  const Result<std::vector<SpaceCurve>> curves = chosen(all, request);
  if (!curves) return tl::unexpected<Error>(curves.error());
  Result<DrawnSections> sections = sectionsThrough(*curves, request.sections, context);
  if (!sections) {
    if (sections.error().code != ErrorCode::cancelled)
      sections.error().message = name + " gives no surface: " + sections.error().message;
    return tl::unexpected<Error>(sections.error());
  }
  Result<Design> begun = exampleDesign(kSingleBlock);
  if (!begun) return tl::unexpected<Error>(begun.error());
  DrawnDesign drawn{std::move(*begun), std::move(*sections), int(curves->size()), all.format,
                    all.unit,          all.leftOut};
  Design& design = drawn.design;
  design.name = std::filesystem::path(name).stem().string();
  design.source().surface = drawn.sections.surface;
  design.block().placement = blockAround(drawn.sections);
  Eigen::Vector3d travel = rotationFromAngles(drawn.sections.surface.rotation).col(1);
  for (double& part : travel) part = std::abs(part) < kRounding ? 0 : part;
  design.cut().direction = travel;
  design.blade.length = std::ceil((drawn.sections.longest + kLonger) / kWhole) * kWhole;
  return drawn;
}

Design withDrawn(const Design& design, const std::vector<DrawnDesign>& earlier, const DrawnDesign& next) {
  Design changed = design;
  changed.source().surface = next.design.source().surface;
  std::erase_if(changed.bindings,
                [](const auto& bound) { return bound.first.starts_with("/sources/0/surface/"); });
  // What a hand has set since stays, and so do expressions.
  const auto follow = [&](auto&& part) {
    const bool asMade = std::ranges::any_of(
        earlier, [&](const DrawnDesign& each) { return part(each.design) == part(design); });
    if (asMade) part(changed) = part(next.design);
  };
  if (!design.grid && !isBound(design, "/stock/0/block"))
    follow([](auto& of) -> auto& { return of.block().placement; });
  if (!isBound(design, "/cuts/0/direction")) follow([](auto& of) -> auto& { return of.cut().direction; });
  if (!isBound(design, "/blade/length")) follow([](auto& of) -> auto& { return of.blade.length; });
  return changed;
}

DrawingLink linkTo(const std::filesystem::path& path, const Fingerprint& content,
                   const std::optional<std::string>& layer, const DrawnDesign& made) {
  const Design& design = made.design;
  return {path,
          layer,
          content,
          surfaceMark(*design.source().surface),
          design.block().placement,
          design.cut().direction.value_or(Eigen::Vector3d::UnitY()),
          design.blade.length};
}

DrawnDesign madeBefore(const DrawingLink& link, const DesignedSurface& surface) {
  DrawnDesign made;
  made.design.source().surface = surface;
  made.design.block().placement = link.block;
  made.design.cut().direction = link.direction;
  made.design.blade.length = link.length;
  return made;
}

Result<FollowedDesign> followDrawing(const Design& design, const RunContext& context) {
  FollowedDesign followed{design};
  const Source& source = design.source();
  if (!source.drawing || !source.surface) return followed;
  const DrawingLink& link = *source.drawing;
  const std::string name = link.path.filename().string();
  const Result<std::string> bytes = readFile(link.path);
  if (!bytes) {
    followed.told =
        "the drawing " + link.path.string() + " cannot be read; the surface that the design holds is cut";
    followed.severity = Severity::warning;
    return followed;
  }
  const Fingerprint content = fingerprintOf(*bytes);
  if (content == link.read) return followed;
  if (!isAsDrawn(link, *source.surface)) {
    followed.told = "the drawing " + name +
                    " has changed, but the surface made of it was changed by hand since; that of the design "
                    "is cut";
    followed.severity = Severity::warning;
    return followed;
  }
  DrawnRequest request;
  if (link.layer) request.names = {*link.layer};
  const Result<DrawnDesign> made = designThrough(*bytes, name, request, context);
  if (!made) return tl::unexpected<Error>(made.error());
  followed.design = withDrawn(design, {madeBefore(link, *source.surface)}, *made);
  followed.design.source().drawing = linkTo(link.path, content, link.layer, *made);
  followNames(design, followed.design);
  followed.told =
      "the drawing has changed since the design was saved and was read again: " + drawnText(*made, name);
  return followed;
}

std::string drawnText(const DrawnDesign& drawn, const std::string& name) {
  const auto counted = [](std::size_t count, const char* one, const char* more) {
    return std::to_string(count) + (count == 1 ? one : more);
  };
  const auto& loft = std::get<SectionsSurface>(drawn.sections.surface.shape);
  std::string text = counted(std::size_t(drawn.curves), " curve of ", " curves of ") + name;
  std::vector<std::string> changes;
  if (drawn.sections.joined > 0)
    changes.push_back(counted(std::size_t(drawn.sections.joined), " joined to others", " joined to others"));
  for (const auto& [list, why] : {std::pair(&drawn.sections.repeated, " left out, there twice: "),
                                  {&drawn.sections.tiny, " left out, shorter than the tolerance: "}})
    if (!list->empty())
      changes.push_back(std::to_string(list->size()) + why + list->front() +
                        (list->size() > 1 ? " and others" : ""));
  for (std::size_t i = 0; i < changes.size(); ++i) text += (i == 0 ? " (" : "; ") + changes[i];
  if (!changes.empty()) text += ")";
  return text + ": the loft of " + std::to_string(loft.sections.size()) + " sections, " +
         std::to_string(loft.sections.front().points.size()) + " points each, lies within " +
         shortText(drawn.sections.deviation) + " mm of them (the farthest is " + drawn.sections.worst + ")";
}

bool holdsCurvesAlone(const std::string& bytes) { return isDxf(bytes) || geometry::namesNoFaces(bytes); }

}  // namespace bw::pipeline
