// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/shape/blade_ends.h"
#include "bw/core/shape/section_tangents.h"
#include "design/design_keys.h"

namespace bw::detail {

using nlohmann::json;

namespace {

constexpr double kFarthest = 1e7;  ///< mm

std::string entryName(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }

/// A pair of numbers, an entry of the member `key`.
bool readPair(ObjectReader& reader, const std::string& key, const std::string& name, const json& entry,
              const char* what, Eigen::Vector2d& out) {
  if (!entry.is_array() || entry.size() != 2) {
    reader.complain(key, reader.path() + "." + name + " must be two numbers " + what);
    return false;
  }
  Eigen::Vector2d pair;
  for (std::size_t i = 0; i < 2; ++i)
    if (!reader.number(key, entryName(name, i), entry[i], pair(Eigen::Index(i)), -kFarthest, kFarthest))
      return false;
  out = pair;
  return true;
}

/// The keys "x" and "y": from and to.
void readRectangle(ObjectReader& reader, Rectangle& over) {
  for (const int axis : {0, 1}) {
    const std::string key(1, char('x' + axis));
    Eigen::Vector2d range(over.min(axis), over.max(axis));
    if (const json* value = reader.member(key))
      if (readPair(reader, key, key, *value, "[from, to] in mm", range) && !(range.y() > range.x()))
        reader.complain(key, reader.path() + "." + key + " must ascend", range.y(), range.x());
    over.min(axis) = range.x();
    over.max(axis) = range.y();
  }
}

bool readPole(ObjectReader& reader, const std::string& name, const json& entry, SurfacePole& pole) {
  if (!entry.is_object()) return reader.number("poles", name, entry, pole.height, -kFarthest, kFarthest);
  ObjectReader inner(entry, reader.path() + "." + name, reader.scope());
  inner.need("height", inner.path() + " needs the key height in mm");
  inner.number("height", pole.height, -kFarthest, kFarthest);
  if (const json* moved = inner.member("moved"))
    readPair(inner, "moved", "moved", *moved, "[dx, dy] in mm", pole.moved);
  return reader.adopt(inner.finish());
}

void readPoles(ObjectReader& reader, PolesSurface& surface) {
  readRectangle(reader, surface.over);
  if (const json* degree = reader.member("degree")) {
    const bool pair = degree->is_array() && degree->size() == 2 && (*degree)[0].is_number_integer() &&
                      (*degree)[1].is_number_integer();
    const double x = pair ? (*degree)[0].get<double>() : 0, y = pair ? (*degree)[1].get<double>() : 0;
    if (std::min(x, y) < 1 || std::max(x, y) > 3)
      reader.complain("degree", reader.path() + ".degree must be two of 1, 2 and 3: along x and along y");
    else
      surface.degreeX = int(x), surface.degreeY = int(y);
  }
  reader.need("poles",
              reader.path() + " needs the key poles: a list of rows along x, each a list of heights in mm");
  const json* rows = reader.member("poles");
  if (!rows) return;
  const std::string grid =
      reader.path() + ".poles must be a list of rows along x, each a list of as many heights";
  const std::size_t count = rows->is_array() ? rows->size() : 0;
  const std::size_t columns = count > 0 && (*rows)[0].is_array() ? (*rows)[0].size() : 0;
  const auto fits = [](std::size_t poles, int degree) {
    return poles > std::size_t(degree) && poles <= std::size_t(PolesSurface::kMost);
  };
  if (columns == 0) return reader.complain("poles", grid);
  if (!fits(count, surface.degreeY) || !fits(columns, surface.degreeX))
    return reader.complain(
        "poles", reader.path() + ".poles has " + std::to_string(count) + " rows of " +
                     std::to_string(columns) + "; there are " + std::to_string(surface.degreeY + 1) + " to " +
                     std::to_string(PolesSurface::kMost) + " rows of " + std::to_string(surface.degreeX + 1) +
                     " to " + std::to_string(PolesSurface::kMost) + ", more than the degree");
  surface.rows = int(count);
  surface.columns = int(columns);
  surface.poles.assign(count * columns, {});
  for (std::size_t r = 0; r < count; ++r) {
    const json& row = (*rows)[r];
    if (!row.is_array() || row.size() != columns) return reader.complain("poles", grid);
    for (std::size_t c = 0; c < columns; ++c)
      if (!readPole(reader, entryName(entryName("poles", r), c), row[c], surface.poles[r * columns + c]))
        return;
  }
}

void readFormula(ObjectReader& reader, FormulaSurface& surface) {
  readRectangle(reader, surface.over);
  reader.need("formula",
              reader.path() + " needs the key formula: z in mm by x and y, such as \"250 + 40*sin(x/100)\"");
  reader.text("formula", surface.formula);
  std::vector<std::string> names = {"x", "y"};
  const std::vector<NamedNumber> none;
  const std::vector<NamedNumber>& numbers = reader.scope() ? reader.scope()->numbers : none;
  for (const NamedNumber& number : numbers) names.push_back(number.name);
  const Result<Expression> expression = Expression::parse(surface.formula, names);
  if (!expression)
    return reader.complain("formula", reader.path() + ".formula, " + expression.error().message,
                           expression.error().value);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (expression->uses(i + 2)) surface.numbers.push_back(numbers[i]);
}

/// Turns the legs at joints until the tangents are those told: once all poles are read.
void readTangents(ObjectReader& reader, const json& points, const json& list, SectionCurve& section) {
  constexpr const char* kKey = "tangents_deg";
  const std::size_t joints = jointCount(section);
  if (joints == 0)
    return reader.complain(kKey, reader.path() +
                                     ".tangents_deg is for cubics alone: a bezier with 4 poles, and 3 more "
                                     "for each further cubic");
  if (!list.is_array() || list.size() != joints)
    return reader.complain(kKey, reader.path() + ".tangents_deg must be a list of " + std::to_string(joints) +
                                     " angles, one for each end of a cubic, or null in place of one that "
                                     "follows the poles");
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (list[joint].is_null()) continue;
    const std::string name = entryName(kKey, joint);
    double degrees = 0;
    if (!reader.number(kKey, name, list[joint], degrees, -360, 360)) return;
    const std::size_t pole = poleOfJoint(joint);
    for (const std::size_t leg : {pole - 1, pole + 1})
      if (leg < points.size() &&
          std::ranges::any_of(points[leg], [](const json& x) { return x.is_string(); }))
        return reader.complain(kKey, reader.path() + "." + name + " turns the poles beside " +
                                         entryName("bezier", pole) +
                                         ", which cannot be told by expressions then; write the numbers of " +
                                         entryName("bezier", leg));
    if (!tangentAt(section, joint))
      return reader.complain(kKey, reader.path() + "." + name + ": the poles beside " +
                                       entryName("bezier", pole) +
                                       " lie on it, so that it has no tangent; move them away from it");
    section = withTangent(std::move(section), joint, degrees);
  }
}

void readSection(ObjectReader& reader, SectionCurve& section) {
  reader.need("y", reader.path() + " needs the key y: its place along the travel, mm");
  reader.number("y", section.y, -kFarthest, kFarthest);
  const json* list = nullptr;
  int kinds = 0;
  for (std::size_t kind = 0; kind < std::size(kSectionKinds); ++kind)
    if (const json* member = reader.member(kSectionKinds[kind])) {
      list = member;
      section.kind = SectionCurve::Kind(kind);
      ++kinds;
    }
  if (kinds != 1)
    return reader.complain("bezier", reader.path() +
                                         " needs one of the keys bezier (2 to 4 poles, and 3 more for each "
                                         "further cubic), spline (points that it goes through) and ducks "
                                         "(points that an elastic spline slides through), each a list of "
                                         "[x, z] in mm");
  const std::string key = kSectionKinds[int(section.kind)];
  const json& points = *list;
  const bool bezier = section.kind == SectionCurve::Kind::bezier;
  if (bezier && points.is_array() && !isBezierCount(points.size()))
    return reader.complain(key, reader.path() + ".bezier has " + std::to_string(points.size()) +
                                    " poles but must have 2, 3 or 4, or 3 more for each further cubic");
  const int most = section.kind == SectionCurve::Kind::ducks ? SectionCurve::kMostDucks : SectionCurve::kMost;
  if (!points.is_array() || points.size() < 2 || points.size() > std::size_t(most))
    return reader.complain(key, reader.path() + "." + key + " must be a list of 2 to " +
                                    std::to_string(most) + " points [x, z]");
  section.points.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!readPair(reader, key, entryName(key, i), points[i], "[x, z] in mm", section.points[i])) return;
  if (const json* tangents = reader.given("tangents_deg")) readTangents(reader, points, *tangents, section);
}

void readSections(ObjectReader& reader, SectionsSurface& surface) {
  int loft = int(surface.loft);
  reader.word("loft", {std::begin(kLoftSpacings), std::end(kLoftSpacings)}, loft);
  surface.loft = LoftSpacing(loft);
  reader.need("sections", reader.path() + " needs the key sections: a list of curves across the travel");
  const json* list = reader.member("sections");
  if (!list) return;
  if (!list->is_array() || list->size() < 2 || list->size() > std::size_t(SectionsSurface::kMost))
    return reader.complain("sections", reader.path() + ".sections must be a list of 2 to " +
                                           std::to_string(SectionsSurface::kMost) + " curves");
  for (std::size_t i = 0; i < list->size(); ++i) {
    ObjectReader inner((*list)[i], reader.path() + "." + entryName("sections", i), reader.scope());
    readSection(inner, surface.sections.emplace_back());
    if (!reader.adopt(inner.finish())) return;
    if (i > 0 && !(surface.sections[i].y > surface.sections[i - 1].y))
      return reader.complain("sections", inner.path() + ".y must lie beyond that of the section before it",
                             surface.sections[i].y, surface.sections[i - 1].y);
  }
}

/// Turns the blade until its ends have their heights: once all else of it is read.
void readEndHeights(ObjectReader& reader, const json& list, KeyBlade& blade) {
  constexpr const char* kKey = "end_heights";
  if (!list.is_array() || list.size() != 2)
    return reader.complain(kKey,
                           reader.path() +
                               ".end_heights must be two heights in mm, [left, right], or null in place "
                               "of one that follows the blade");
  EndHeights heights;
  for (std::size_t end = 0; end < heights.size(); ++end) {
    double height = 0;
    if (list[end].is_null()) continue;
    if (!reader.number(kKey, entryName(kKey, end), list[end], height, -kFarthest, kFarthest)) return;
    heights[end] = height;
  }
  if (!heights[0] && !heights[1]) return;
  const json *angle = reader.member("angle_deg"), *middle = reader.member("middle");
  const auto isText = [](const json& value) { return value.is_string(); };
  if ((angle && isText(*angle)) || (middle && middle->is_array() && std::ranges::any_of(*middle, isText)))
    return reader.complain(kKey, reader.path() +
                                     ".end_heights turns the blade, so that its middle and its angle_deg "
                                     "cannot be told by expressions; write the numbers there");
  const Result<KeyBlade> turned = withEndHeights(blade, heights);
  if (!turned)
    return reader.complain(kKey, reader.path() + ".end_heights: " + turned.error().message,
                           turned.error().value, turned.error().limit);
  blade = *turned;
}

void readBlade(ObjectReader& reader, KeyBlade& blade) {
  for (const char* key : {"y", "middle", "length_mm"})
    reader.need(key, reader.path() + " needs the key " + key);
  reader.number("y", blade.y, -kFarthest, kFarthest);
  if (const json* middle = reader.member("middle"))
    readPair(reader, "middle", "middle", *middle, "[x, z] in mm", blade.middle);
  double degrees = 0;
  reader.number("angle_deg", degrees, -3600, 3600);
  blade.angle = degrees * kDegree;
  double turn = 0;
  constexpr double kMostTurn = KeyBlade::kMostTurn / kDegree;
  reader.number("turn_deg", turn, -kMostTurn, kMostTurn);
  blade.turn = turn * kDegree;
  reader.number("length_mm", blade.length, 1e-3, kFarthest);
  reader.number("bend", blade.bend, -KeyBlade::kMostBend, KeyBlade::kMostBend);
  if (const json* force = reader.member("force"))
    readPair(reader, "force", "force", *force, "[along, across] times the length squared", blade.force);
  if (blade.force.norm() > KeyBlade::kMostForce)
    reader.complain("force", reader.path() + ".force is too large", blade.force.norm(), KeyBlade::kMostForce);
  if (const json* heights = reader.given("end_heights")) readEndHeights(reader, *heights, blade);
}

void readBlades(ObjectReader& reader, BladesSurface& surface) {
  reader.need("blades", reader.path() + " needs the key blades: a list of key blades along the travel");
  const json* list = reader.member("blades");
  if (!list) return;
  if (!list->is_array() || list->size() < 2 || list->size() > std::size_t(BladesSurface::kMost))
    return reader.complain("blades", reader.path() + ".blades must be a list of 2 to " +
                                         std::to_string(BladesSurface::kMost) + " key blades");
  for (std::size_t i = 0; i < list->size(); ++i) {
    ObjectReader inner((*list)[i], reader.path() + "." + entryName("blades", i), reader.scope());
    readBlade(inner, surface.blades.emplace_back());
    if (!reader.adopt(inner.finish())) return;
    if (i > 0 && !(surface.blades[i].y > surface.blades[i - 1].y))
      return reader.complain("blades", inner.path() + ".y must lie beyond that of the blade before it",
                             surface.blades[i].y, surface.blades[i - 1].y);
  }
}

void readFrame(ObjectReader& reader, DesignedSurface& surface) {
  const json* value = reader.member("frame");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".frame", reader.scope());
  Eigen::Vector3d degrees = Eigen::Vector3d::Zero();
  inner.vector3("origin", surface.origin, -kFarthest, kFarthest);
  inner.vector3("rotation_deg", degrees, -360, 360);
  surface.rotation = degrees * kDegree;
  reader.adopt(inner.finish());
}

json pairJson(const Eigen::Vector2d& pair) { return json::array({pair.x(), pair.y()}); }

void writeRectangle(const Rectangle& over, json& object) {
  object["x"] = json::array({over.min.x(), over.max.x()});
  object["y"] = json::array({over.min.y(), over.max.y()});
}

using IsBound = BoundBelow;

void write(const PolesSurface& surface, json& object, const IsBound& isBound) {
  writeRectangle(surface.over, object);
  object["degree"] = json::array({surface.degreeX, surface.degreeY});
  json rows = json::array();
  for (int r = 0; r < surface.rows; ++r) {
    json row = json::array();
    for (int c = 0; c < surface.columns; ++c) {
      const SurfacePole& pole = surface.at(r, c);
      const std::string place = "/poles/" + std::to_string(r) + "/" + std::to_string(c) + "/";
      if (pole.moved.isZero(0) && !isBound(place))
        row.push_back(pole.height);
      else
        row.push_back({{"height", pole.height}, {"moved", pairJson(pole.moved)}});
    }
    rows.push_back(std::move(row));
  }
  object["poles"] = std::move(rows);
}

void write(const FormulaSurface& surface, json& object, const IsBound&) {
  writeRectangle(surface.over, object);
  object["formula"] = surface.formula;
}

/// The tangents that stand for expressions, null for others; null where none does.
json tangentsJson(const SectionCurve& section, const std::string& place, const IsBound& isBound) {
  const std::string list = place + "/tangents_deg/";
  if (!isBound(list)) return {};
  json tangents = json::array();
  bool any = false;
  for (std::size_t joint = 0; joint < jointCount(section); ++joint) {
    tangents.push_back(nullptr);
    const std::string own = list + std::to_string(joint);
    const BoundNumber* bound = isBound(own);
    // What is found for 1 may be that of 10.
    for (char digit = '0'; bound && digit <= '9'; ++digit)
      if (isBound(own + digit) == bound) bound = nullptr;
    const std::optional<double> now = bound ? tangentAt(section, joint, bound->value) : std::nullopt;
    if (!now || !(std::abs(*now - bound->value) <= kTangentMiss)) continue;
    tangents.back() = bound->value;
    any = true;
  }
  return any ? tangents : json();
}

void write(const SectionsSurface& surface, json& object, const IsBound& isBound) {
  object["loft"] = kLoftSpacings[int(surface.loft)];
  json list = json::array();
  for (const SectionCurve& section : surface.sections) {
    json points = json::array();
    for (const Eigen::Vector2d& point : section.points) points.push_back(pairJson(point));
    json tangents = tangentsJson(section, "/sections/" + std::to_string(list.size()), isBound);
    list.push_back({{"y", section.y}, {kSectionKinds[int(section.kind)], std::move(points)}});
    if (!tangents.is_null()) list.back()["tangents_deg"] = std::move(tangents);
  }
  object["sections"] = std::move(list);
}

/// The heights of ends that stand for expressions, null for others; null where none does, or where what tells
/// the middle does.
json endHeightsJson(const KeyBlade& blade, const std::string& place, const IsBound& isBound) {
  if (!isBound(place + "/end_heights/") || isBound(place + "/middle/") || isBound(place + "/angle_deg"))
    return {};
  const Result<std::array<Eigen::Vector2d, 2>> ends = bladeEnds(blade);
  if (!ends) return {};
  json heights = json::array({nullptr, nullptr});
  bool any = false;
  for (const std::size_t end : {0u, 1u}) {
    const BoundNumber* bound = isBound(place + "/end_heights/" + std::to_string(end));
    const double height = (*ends)[end].y();
    if (!bound || !(std::abs(height - bound->value) <= kEndMiss)) continue;
    heights[end] = bound->value;
    any = true;
  }
  return any ? heights : json();
}

void write(const BladesSurface& surface, json& object, const IsBound& isBound) {
  json list = json::array();
  for (const KeyBlade& blade : surface.blades) {
    json heights = endHeightsJson(blade, "/blades/" + std::to_string(list.size()), isBound);
    list.push_back({{"y", blade.y},
                    {"middle", pairJson(blade.middle)},
                    {"angle_deg", degreesThatRead(blade.angle)},
                    {"length_mm", blade.length},
                    {"bend", blade.bend},
                    {"force", pairJson(blade.force)}});
    if (blade.turn != 0 || isBound("/blades/" + std::to_string(list.size() - 1) + "/turn_deg"))
      list.back()["turn_deg"] = degreesThatRead(blade.turn);
    if (!heights.is_null()) list.back()["end_heights"] = std::move(heights);
  }
  object["blades"] = std::move(list);
}

}  // namespace

void readSurface(ObjectReader& reader, std::optional<DesignedSurface>& surface) {
  const json* value = reader.member("surface");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".surface", reader.scope());
  inner.need("type", inner.path() + " needs the key type: poles, formula, sections or blades");
  int kind = -1;
  inner.word("type", {std::begin(kShapeKinds), std::end(kShapeKinds)}, kind);
  DesignedSurface read;
  if (kind == 0) readPoles(inner, std::get<PolesSurface>(read.shape));
  if (kind == 1) readFormula(inner, read.shape.emplace<FormulaSurface>());
  if (kind == 2) readSections(inner, read.shape.emplace<SectionsSurface>());
  if (kind == 3) readBlades(inner, read.shape.emplace<BladesSurface>());
  readFrame(inner, read);
  if (kind < 0 || !reader.adopt(inner.finish())) {
    reader.adopt(inner.finish());
    return;
  }
  surface = std::move(read);
}

json surfaceJson(const DesignedSurface& surface, const IsBound& isBound) {
  json object = {{"type", kShapeKinds[surface.shape.index()]}};
  std::visit([&](const auto& shape) { write(shape, object, isBound); }, surface.shape);
  if (!surface.origin.isZero(0) || !surface.rotation.isZero(0) || isBound("/frame/")) {
    const auto list = [](const Eigen::Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); };
    object["frame"] = {{"origin", list(surface.origin)},
                       {"rotation_deg", list(degreesThatRead(surface.rotation))}};
  }
  return object;
}

namespace {

constexpr std::size_t kMostVariables = 200;

void readVariable(ObjectReader& reader, Variable& variable) {
  reader.need("name", reader.path() + " needs the key name");
  reader.need("value", reader.path() + " needs the key value");
  reader.need("min", reader.path() + " needs the key min, the least value");
  reader.need("max", reader.path() + " needs the key max, the greatest value");
  reader.text("name", variable.name);
  reader.text("unit", variable.unit);
  constexpr double kGreatest = 1e12;
  reader.number("min", variable.min, -kGreatest, kGreatest);
  reader.number("max", variable.max, variable.min, kGreatest);
  reader.number("value", variable.value, variable.min, variable.max);
  if (!isVariableName(variable.name))
    reader.complain("name",
                    reader.path() + ".name is \"" + variable.name +
                        "\" but must be a letter and then letters, digits or _ (40 at most), and not x, y or "
                        "what formulas know already");
}

}  // namespace

void readVariables(ObjectReader& reader, std::vector<Variable>& variables) {
  const json* list = reader.member("variables");
  if (!list) return;
  const std::string path = reader.path() + ".variables";
  if (!list->is_array() || list->size() > kMostVariables)
    return reader.complain(
        "variables", path + " must be a list of " + std::to_string(kMostVariables) + " variables at most");
  for (std::size_t i = 0; i < list->size(); ++i) {
    ObjectReader inner((*list)[i], path + "[" + std::to_string(i) + "]");
    Variable variable;
    readVariable(inner, variable);
    if (!reader.adopt(inner.finish())) return;
    if (std::ranges::find(variables, variable.name, &Variable::name) != variables.end())
      return reader.complain("variables", path + " has \"" + variable.name + "\" twice; rename one");
    variables.push_back(std::move(variable));
  }
}

json variablesJson(const std::vector<Variable>& variables) {
  json list = json::array();
  for (const Variable& v : variables) {
    list.push_back({{"name", v.name}, {"value", v.value}, {"min", v.min}, {"max", v.max}});
    if (!v.unit.empty()) list.back()["unit"] = v.unit;
  }
  return list;
}

}  // namespace bw::detail
