// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/cad_curves.h"

#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>

#include "cad_reader.h"
#include "isolated.h"
#include "occt.h"

namespace bw::geometry {

namespace {

void appendNumbers(std::string& bytes, const double* first, std::size_t count) {
  appendText(bytes, {reinterpret_cast<const char*>(first), count * sizeof(double)});
}

std::string packed(const Result<CadCurves>& read) {
  std::string bytes;
  if (!read) {
    appendText(bytes, std::to_string(int(read.error().code)));
    appendText(bytes, read.error().message);
    return bytes;
  }
  appendText(bytes, "");
  appendText(bytes, read->format);
  appendText(bytes, read->unit);
  appendText(bytes, std::to_string(read->faces));
  appendText(bytes, std::to_string(read->leftOut.size()));
  for (const std::string& line : read->leftOut) appendText(bytes, line);
  for (const SpaceCurve& curve : read->curves) {
    appendText(bytes, curve.name);
    appendText(bytes, std::to_string(curve.number) + " " + std::to_string(curve.degree));
    appendNumbers(bytes, curve.knots.data(), curve.knots.size());
    appendNumbers(bytes, curve.poles.empty() ? nullptr : curve.poles.front().data(), 3 * curve.poles.size());
    appendNumbers(bytes, curve.weights.data(), curve.weights.size());
  }
  return bytes;
}

Result<CadCurves> unpackedCurves(std::string_view bytes, const std::string& name) {
  const auto broken = [&] {
    return unreadable(name, "what was read of it is incomplete; the memory may not suffice");
  };
  std::string code, text;
  if (!takeText(bytes, code)) return broken();
  if (!code.empty()) {
    if (!takeText(bytes, text)) return broken();
    return fail(ErrorCode(std::stoi(code)), text, name);
  }
  CadCurves read;
  if (!takeText(bytes, read.format) || !takeText(bytes, read.unit) || !takeText(bytes, text)) return broken();
  read.faces = std::stoi(text);
  if (!takeText(bytes, text)) return broken();
  read.leftOut.resize(std::stoul(text));
  for (std::string& line : read.leftOut)
    if (!takeText(bytes, line)) return broken();
  while (!bytes.empty()) {
    SpaceCurve& curve = read.curves.emplace_back();
    std::string knots, poles, weights;
    if (!takeText(bytes, curve.name) || !takeText(bytes, text) || !takeText(bytes, knots) ||
        !takeText(bytes, poles) || !takeText(bytes, weights))
      return broken();
    curve.number = std::stoi(text);
    curve.degree = std::stoi(text.substr(text.find(' ')));
    const auto take = [](const std::string& from, auto& all) {
      constexpr std::size_t kEach = sizeof(all.front());
      all.resize(from.size() / kEach);
      if (!all.empty()) std::memcpy(static_cast<void*>(all.data()), from.data(), all.size() * kEach);
    };
    take(knots, curve.knots);
    take(poles, curve.poles);
    take(weights, curve.weights);
  }
  return read;
}

/// The curve of an edge as it is; nothing, with why in `fault`, where it has none.
std::optional<SpaceCurve> curveOf(const TopoDS_Edge& edge, double scale, std::string& fault) {
  double first = 0, last = 0;
  const Handle(Geom_Curve) whole = BRep_Tool::Curve(edge, first, last);
  if (whole.IsNull()) {
    fault = "it has no curve in space";
    return {};
  }
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last)) {
    fault = "it has no end; trim it";
    return {};
  }
  const Handle(Geom_BSplineCurve) spline =
      GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(whole, first, last));
  if (spline->IsPeriodic()) spline->SetNotPeriodic();
  SpaceCurve curve;
  curve.degree = spline->Degree();
  const TColStd_Array1OfReal& knots = spline->KnotSequence();
  curve.knots.assign(knots.begin(), knots.end());
  for (int i = 1; i <= spline->NbPoles(); ++i) {
    curve.poles.push_back(scale * toEigen(spline->Pole(i)));
    if (spline->IsRational()) curve.weights.push_back(spline->Weight(i));
  }
  return curve;
}

Result<CadCurves> read(std::string_view text, const std::string& name, CadFormat format,
                       const ReadOptions& options) {
  return guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<CadCurves> {
    const Result<ReadShape> raw = readRaw(text, name, format);
    if (!raw) return tl::unexpected(raw.error());
    CadCurves found;
    found.format = raw->format;
    found.unit = raw->unit;
    found.faces = int(facesOf(raw->shape).size());
    double scale = 1;
    if (options.unit) {
      const Result<double> larger = scaleTo(*options.unit, raw->unit, name);
      if (!larger) return tl::unexpected(larger.error());
      scale = *larger;
    }
    std::map<const TopoDS_TShape*, std::string> names;
    for (const auto& [shape, own] : raw->namedCurves)
      for (TopExp_Explorer at(shape, TopAbs_EDGE); at.More(); at.Next())
        names.emplace(at.Current().TShape().get(), own);
    int count = 0;
    TopTools_MapOfShape met;
    if (!raw->shape.IsNull())
      for (TopExp_Explorer at(raw->shape, TopAbs_EDGE, TopAbs_FACE); at.More(); at.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(at.Current());
        if (!met.Add(edge) || BRep_Tool::Degenerated(edge)) continue;
        if (++count > CadCurves::kMost) continue;
        std::string fault;
        std::optional<SpaceCurve> curve = curveOf(edge, scale, fault);
        if (!curve) {
          found.leftOut.push_back("curve " + std::to_string(count) + " is left out: " + fault);
          continue;
        }
        curve->number = count;
        if (const auto own = names.find(edge.TShape().get()); own != names.end()) curve->name = own->second;
        found.curves.push_back(std::move(*curve));
      }
    if (count > CadCurves::kMost)
      return fail(ErrorCode::badInput,
                  name + " holds " + std::to_string(count) + " curves; " + std::to_string(CadCurves::kMost) +
                      " are read: export those that are needed alone",
                  name, double(count), double(CadCurves::kMost));
    if (found.curves.empty()) {
      std::string what = "it holds no curves";
      if (found.faces > 0)
        what += " beside its " + std::to_string(found.faces) + (found.faces == 1 ? " face" : " faces") +
                "; use it as a surface, or export curves alone";
      else
        what += found.leftOut.empty() ? "; export the section curves from the CAD program"
                                      : " that can be used; " + found.leftOut.front();
      return fail(ErrorCode::badInput, name + " cannot be used: " + what, name, 0, 1);
    }
    return found;
  });
}

/// Words of STEP entities, without what stands in quotes: whether one of `words` is in them.
bool namesAny(std::string_view text, std::initializer_list<std::string_view> words) {
  while (!text.empty()) {
    const std::size_t quote = text.find('\'');
    const std::string_view open = text.substr(0, quote);
    for (const std::string_view word : words)
      if (open.find(word) != std::string_view::npos) return true;
    if (quote == std::string_view::npos) break;
    const std::size_t end = text.find('\'', quote + 1);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return false;
}

/// Types of IGES entities of which the translator makes curves, and faces.
constexpr int kIgesCurves[] = {100, 102, 104, 106, 110, 112, 126, 130};
constexpr std::pair<int, int> kIgesFaces[] = {{108, 108}, {114, 114}, {118, 122}, {128, 128},
                                              {140, 168}, {180, 186}, {190, 198}, {502, 514}};

bool igesCurvesAlone(std::string_view text) {
  bool curves = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string_view line = text.substr(at, end == std::string_view::npos ? end : end - at);
    at = end == std::string_view::npos ? text.size() : end + 1;
    if (line.size() < 73 || line[72] != 'D') continue;
    const std::string_view digits = trimmedLeft(line.substr(0, 8));
    int type = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), type);
    for (const auto& [first, last] : kIgesFaces)
      if (type >= first && type <= last) return false;
    curves = curves || std::ranges::find(kIgesCurves, type) != std::end(kIgesCurves);
  }
  return curves;
}

}  // namespace

bool namesNoFaces(std::string_view bytes) {
  bytes = withoutMark(bytes);
  const CadFormat format = formatOfContent(bytes);
  if (format == CadFormat::iges) return igesCurvesAlone(bytes);
  return format == CadFormat::step && !namesAny(bytes, {"FACE"}) &&
         namesAny(bytes, {"CURVE", "LINE", "CIRCLE", "ELLIPSE"});
}

Result<CadCurves> readCurves(const std::string& bytes, const std::string& name, const RunContext& context,
                             const ReadOptions& options) {
  const Result<std::string> back = readApart(
      bytes, name, context,
      [&](std::string_view text, CadFormat format) { return packed(read(text, name, format, options)); });
  if (!back) return tl::unexpected(back.error());
  return unpackedCurves(*back, name);
}

}  // namespace bw::geometry
