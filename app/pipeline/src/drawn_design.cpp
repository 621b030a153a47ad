// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/drawn_design.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bw/core/dxf/dxf_curves.h"
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

struct Curves {
  std::string format, unit;
  std::vector<SpaceCurve> curves;
  std::vector<std::string> leftOut;
};

Result<Curves> curvesOf(const std::string& bytes, const std::string& name, std::optional<LengthUnit> unit,
                        const RunContext& context) {
  if (isDxf(bytes)) {
    Result<DxfCurves> read = readDxf(bytes, name, unit ? std::optional(millimetres(*unit)) : std::nullopt);
    if (!read) return tl::unexpected<Error>(read.error());
    return Curves{"DXF", std::move(read->unit), std::move(read->curves), std::move(read->leftOut)};
  }
  Result<geometry::CadCurves> read = geometry::readCurves(bytes, name, context, {unit});
  if (!read) return tl::unexpected<Error>(read.error());
  return Curves{std::move(read->format), std::move(read->unit), std::move(read->curves),
                std::move(read->leftOut)};
}

/// Leaves the curves that are asked for.
Result<void> choose(std::vector<SpaceCurve>& curves, const DrawnRequest& request) {
  if (!request.names.empty()) {
    for (const std::string& wanted : request.names) {
      if (std::ranges::find(curves, wanted, &SpaceCurve::name) != curves.end()) continue;
      std::vector<std::string> names;
      for (const SpaceCurve& curve : curves)
        if (!curve.name.empty() && std::ranges::find(names, curve.name) == names.end())
          names.push_back(curve.name);
      const std::string nearest = nearestWord(wanted, names.data(), int(names.size()));
      std::string some;
      for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 10); ++i)
        some += (i ? ", " : "; there are ") + names[i];
      return fail(ErrorCode::badInput,
                  "there is no layer or curve \"" + wanted + "\" in the file" +
                      (nearest.empty() ? some : "; did you mean \"" + nearest + "\"?"),
                  "layer");
    }
    std::erase_if(curves, [&](const SpaceCurve& curve) {
      return std::ranges::find(request.names, curve.name) == request.names.end();
    });
  }
  if (!request.numbers.empty()) {
    int most = 0;
    for (const SpaceCurve& curve : curves) most = std::max(most, curve.number);
    const Result<std::vector<int>> numbers = readNumberList(request.numbers, most, "curve", 1);
    if (!numbers) return tl::unexpected<Error>(numbers.error());
    for (const int number : *numbers)
      if (std::ranges::find(curves, number, &SpaceCurve::number) == curves.end())
        return fail(ErrorCode::badInput,
                    "there is no curve " + std::to_string(number) +
                        " among those of the file; the first is " + std::to_string(curves.front().number) +
                        ", the last " + std::to_string(most),
                    "curves", number, most);
    std::erase_if(curves, [&](const SpaceCurve& curve) {
      return std::ranges::find(*numbers, curve.number) == numbers->end();
    });
  }
  return {};
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

Result<DrawnDesign> designThrough(const std::string& bytes, const std::string& name,
                                  const DrawnRequest& request, const RunContext& context) {
  Result<Curves> read = curvesOf(bytes, name, request.unit, context);
  if (!read) return tl::unexpected<Error>(read.error());
  if (Result<void> ok = choose(read->curves, request); !ok) return tl::unexpected<Error>(ok.error());
  Result<DrawnSections> sections = sectionsThrough(read->curves, request.sections, context);
  if (!sections) {
    if (sections.error().code != ErrorCode::cancelled)
      sections.error().message = name + " gives no surface: " + sections.error().message;
    return tl::unexpected<Error>(sections.error());
  }
  Result<Design> begun = exampleDesign(kSingleBlock);
  if (!begun) return tl::unexpected<Error>(begun.error());
  DrawnDesign drawn{std::move(*begun), std::move(*sections), int(read->curves.size()),
                    read->format,      read->unit,           std::move(read->leftOut)};
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
