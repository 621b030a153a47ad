// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/dxf/dxf_curves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "dxf/dxf_groups.h"
#include "dxf/fit_curve.h"

namespace bw {

namespace {

using dxf::Group;
using dxf::Groups;
using dxf::trimmed;
using Points = std::vector<Eigen::Vector3d>;

constexpr std::string_view kBinaryName = "AutoCAD Binary DXF";
constexpr double kStraight = 1e-9;   // bulges below are none
constexpr double kAxis = 1.0 / 64;   // of the arbitrary axis algorithm
constexpr double kWholeTurn = 1e-9;  // rad by which an arc may miss one
constexpr double kTurn = 2 * kPi;
constexpr std::size_t kMostKinds = 20;          // of entities that are left out, told by name
constexpr std::size_t kMostGroups = 1'000'000;  // of an entity
constexpr std::size_t kLookEvery = 10'000;      // groups, for a wish to stop
constexpr int kDeepest = 32;                    // blocks within each other
constexpr double kInsertion = 20;               // values that one counts as
constexpr double kMostInserted = 2e7;           // values of all blocks, as often as they are inserted
constexpr std::string_view kRead[] = {"LINE", "LWPOLYLINE", "POLYLINE", "VERTEX", "SEQEND",
                                      "ARC",  "CIRCLE",     "ELLIPSE",  "SPLINE", "INSERT"};
constexpr int kClosed = 1;                   // among the flags of a spline
constexpr std::string_view kOwnLayer = "0";  // in a block: that of what inserts it

/// An entity: its groups up to the next one.
struct Entity {
  std::string_view type;
  std::size_t place = 0;  ///< of the group that tells its type
  std::vector<Group> groups;
};

/// What may be inserted, once or often.
struct Block {
  Entity head;
  std::vector<Entity> entities;
};

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

struct Unit {
  int code;
  const char* name;
  double mm;
};
constexpr Unit kUnits[] = {{0, "mm (assumed)", 1}, {1, "inch", 25.4}, {2, "foot", 304.8},
                           {3, "mile", 1609344},   {4, "mm", 1},      {5, "cm", 10},
                           {6, "m", 1000},         {7, "km", 1e6},    {9, "mil", 0.0254},
                           {10, "yard", 914.4},    {13, "um", 1e-3},  {14, "dm", 100}};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name, std::optional<double> unit,
         const RunContext& context)
      : groups_(bytes, name), name_(name), asked_(unit), context_(context) {}

  Result<DxfCurves> read() {
    // The section that groups are of, and the entity that is being gathered.
    std::string_view section;
    bool named = true;
    Entity entity;
    std::string_view variable;
    for (std::size_t count = 0;; ++count) {
      const Result<Group> group = groups_.next();
      if (!group) return tl::unexpected<Error>(group.error());
      if (count % kLookEvery == 0) {
        if (context_.stopped()) return stoppedError();
        context_.report(groups_.share(), "reading curves");
      }
      const std::string_view value = trimmed(group->value);
      if (group->code == 0) {
        if (section == "ENTITIES")
          if (Result<void> ok = take(entity); !ok) return tl::unexpected<Error>(ok.error());
        if (section == "BLOCKS") gather(std::move(entity));
        entity = {value, group->place, {}};
        if (value == "EOF") break;
        if (value == "SECTION") {
          section = {};
          named = false;
        } else if (value == "ENDSEC") {
          section = {};
        }
        continue;
      }
      if (!named && group->code == 2) {
        section = value;
        named = true;
        continue;
      }
      if (section == "HEADER") {
        if (group->code == 9) variable = value;
        if (group->code == 70 && variable == "$INSUNITS")
          if (Result<void> ok = takeUnit(*group); !ok) return tl::unexpected<Error>(ok.error());
      }
      if (section != "ENTITIES" && section != "BLOCKS") continue;
      // Of what is left out only the space counts that it lies in.
      if (std::ranges::find(kRead, entity.type) == std::end(kRead) && group->code != 67 &&
          entity.type != "BLOCK")
        continue;
      if (entity.groups.size() == kMostGroups)
        return fail(ErrorCode::badInput,
                    name_ + " cannot be used: what begins in " + groups_.words(entity.place) +
                        " has more than " + std::to_string(kMostGroups) +
                        " values; export it as a spline, or more coarsely",
                    name_, double(entity.place), double(kMostGroups));
      entity.groups.push_back(*group);
    }
    if (polyline_) return damaged(entity.place, "ends the file within a polyline");
    return finish();
  }

 private:
  tl::unexpected<Error> damaged(std::size_t place, const std::string& what) const {
    return groups_.damaged(place, what);
  }
  /// Where the type of an entity is told, in words.
  std::string placeOf(const Entity& entity) const {
    return groups_.words(groups_.placeOfValue(entity.place));
  }

  Result<void> takeUnit(const Group& group) {
    const Result<double> code = number(group);
    if (!code) return tl::unexpected<Error>(code.error());
    const auto* unit = std::ranges::find_if(kUnits, [&](const Unit& known) { return known.code == *code; });
    if (unit != std::end(kUnits)) {
      unit_ = *unit;
      return {};
    }
    if (asked_) {
      unit_.name = "another unit";
      return {};
    }
    return fail(ErrorCode::badInput,
                name_ + " states its lengths in the unit " + shortText(*code) +
                    " of DXF, which is not known; give the unit that they are in",
                "unit", *code);
  }

  Result<double> number(const Group& group) const {
    if (group.number && !std::isfinite(*group.number))
      return damaged(group.place, "has a number that is not finite");
    const std::optional<double> value = group.number ? group.number : parseNumber(trimmed(group.value));
    if (!value)
      return damaged(
          groups_.placeOfValue(group.place),
          "has \"" + std::string(trimmed(group.value).substr(0, 20)) + "\" where a finite number stands");
    return *value;
  }

  /// The number of a code; the last one where there are several.
  Result<double> number(const Entity& entity, int code, double otherwise) const {
    const auto found = std::find_if(entity.groups.rbegin(), entity.groups.rend(),
                                    [&](const Group& group) { return group.code == code; });
    return found == entity.groups.rend() ? Result<double>(otherwise) : number(*found);
  }
  Result<int> whole(const Entity& entity, int code, int otherwise) const {
    const Result<double> value = number(entity, code, otherwise);
    if (!value) return tl::unexpected<Error>(value.error());
    return *value >= -1e9 && *value <= 1e9 ? int(*value) : otherwise;
  }
  Result<Eigen::Vector3d> point(const Entity& entity, int code, const Eigen::Vector3d& otherwise) const {
    Eigen::Vector3d p = otherwise;
    for (int axis = 0; axis < 3; ++axis) {
      const Result<double> value = number(entity, code + 10 * axis, p[axis]);
      if (!value) return tl::unexpected<Error>(value.error());
      p[axis] = *value;
    }
    return p;
  }
  std::string_view textOf(const Entity& entity, int code) const {
    const auto found = std::ranges::find(entity.groups, code, &Group::code);
    return found == entity.groups.end() ? std::string_view() : trimmed(found->value);
  }
  std::string layerOf(const Entity& entity) const {
    const std::string_view own = textOf(entity, 8);
    return std::string(depth_ > 0 && own == kOwnLayer ? layer_ : own);
  }

  /// An entity of the section of blocks, which are read where they are inserted.
  void gather(Entity entity) {
    if (entity.type == "BLOCK") {
      // Names of blocks are the same in capitals.
      block_ = &blocks_[lowerCase(textOf(entity, 2))];
      block_->head = std::move(entity);
      block_->entities.clear();
    } else if (entity.type == "ENDBLK" || entity.type == "ENDSEC") {
      block_ = nullptr;
    } else if (block_) {
      block_->entities.push_back(std::move(entity));
    }
  }

  /// The plane of an entity, whose numbers are told in it.
  struct Plane {
    Eigen::Matrix3d axes;
    Eigen::Vector3d at(const Eigen::Vector3d& p) const { return axes * p; }
  };
  Result<Plane> planeOf(const Entity& entity) const {
    const Result<Eigen::Vector3d> extrusion = point(entity, 210, Eigen::Vector3d::UnitZ());
    if (!extrusion) return tl::unexpected<Error>(extrusion.error());
    if (!(extrusion->norm() > 0) || !std::isfinite(extrusion->norm()))
      return damaged(entity.place,
                     "begins a " + std::string(entity.type) + " whose extrusion is no direction");
    const Eigen::Vector3d z = extrusion->normalized();
    const bool upright = std::abs(z.x()) < kAxis && std::abs(z.y()) < kAxis;
    Plane plane;
    plane.axes.col(2) = z;
    plane.axes.col(0) = (upright ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ()).cross(z).normalized();
    plane.axes.col(1) = z.cross(plane.axes.col(0));
    return plane;
  }

  Result<void> take(const Entity& entity) {
    const std::string_view type = entity.type;
    if (type == "SECTION" || type == "ENDSEC") return {};
    if (type == "SEQEND" && !polyline_) return {};  // of the attributes of what is inserted
    if (polyline_) {
      if (type == "VERTEX") return takeVertex(entity);
      if (type == "SEQEND") return endPolyline();
      return damaged(entity.place, "begins a " + std::string(type.substr(0, 20)) + " within a polyline");
    }
    const Result<int> paper = whole(entity, 67, 0);
    if (!paper) return tl::unexpected<Error>(paper.error());
    if (type == "POLYLINE") {
      polyline_ = Polyline{entity, {}, {}};
      paperPolyline_ = *paper == 1;
      return {};
    }
    if (*paper == 1) {
      ++left_["entity of a layout"];
      return {};
    }
    if (type == "LINE") return takeLine(entity);
    if (type == "LWPOLYLINE") return takeLightPolyline(entity);
    if (type == "ARC" || type == "CIRCLE") return takeArc(entity);
    if (type == "ELLIPSE") return takeEllipse(entity);
    if (type == "SPLINE") return takeSpline(entity);
    if (type == "INSERT") return takeInsert(entity);
    const std::string kind(type.substr(0, 40));
    ++left_[left_.size() < kMostKinds || left_.contains(kind) ? kind : "other entity"];
    return {};
  }

  /// The number of the curve that comes next.
  int nextNumber() const { return int(found_.curves.size() + found_.unusable.size()) + 1; }
  Result<void> count(std::size_t points) {
    points_ += points;
    if (std::size_t(nextNumber()) <= DxfCurves::kMost && points_ <= DxfCurves::kMostPoints) return {};
    return fail(ErrorCode::badInput,
                name_ + " holds more than " + std::to_string(DxfCurves::kMost) + " curves, or " +
                    std::to_string(DxfCurves::kMostPoints) +
                    " points of curves; export those that are needed alone",
                name_, double(nextNumber()), double(DxfCurves::kMost));
  }

  Result<void> add(SpaceCurve curve, const Entity& entity) {
    curve.number = nextNumber();
    curve.name = layerOf(entity);
    // Weights stay whatever the block is stretched by: an arc becomes one of an ellipse.
    for (Eigen::Vector3d& pole : curve.poles) pole = asked_.value_or(unit_.mm) * (placement_ * pole);
    if (Result<void> ok = count(curve.poles.size()); !ok) return ok;
    if (Result<void> ok = checkSpaceCurve(curve); !ok) {
      Error error = ok.error();
      error.message = name_ + ": " + error.message + " (" + placeOf(entity) + ")";
      found_.unusable.push_back({curve.number, curve.name, std::move(error)});
      return {};
    }
    found_.curves.push_back(std::move(curve));
    return {};
  }

  /// A curve of which nothing can be made: "curve 3, a circle on the layer holes (line 16), is closed; …".
  Result<void> leave(const Entity& entity, const std::string& what, const std::string& why) {
    if (Result<void> ok = count(0); !ok) return ok;
    const int number = nextNumber();
    const std::string layer = layerOf(entity);
    found_.unusable.push_back({number, layer,
                               fail(ErrorCode::badInput,
                                    name_ + " cannot be used: curve " + std::to_string(number) + ", " + what +
                                        (layer.empty() ? "" : " on the layer " + printable(layer)) + " (" +
                                        placeOf(entity) + "), " + why,
                                    name_, double(entity.place))
                                   .value()});
    return {};
  }

  Result<void> closed(const Entity& entity, const std::string& what) {
    return leave(entity, what,
                 "is closed; a section is open, from one side of the block to the other: cut it open, or "
                 "leave it out");
  }

  tl::unexpected<Error> refuseInsert(const Entity& entity, const std::string& why) const {
    return fail(ErrorCode::badInput,
                name_ + " cannot be used: " + placeOf(entity) + " inserts the block \"" +
                    printable(std::string(textOf(entity, 2).substr(0, 60))) + "\", " + why,
                name_, double(entity.place));
  }

  /// A block: its entities as often as rows and columns tell, stretched, turned and put to their place.
  Result<void> takeInsert(const Entity& entity) {
    const auto found = blocks_.find(lowerCase(textOf(entity, 2)));
    if (found == blocks_.end())
      return refuseInsert(entity,
                          "which the file does not hold; explode it in the CAD program and export again");
    if (depth_ == kDeepest)
      return refuseInsert(entity, "more than " + std::to_string(kDeepest) +
                                      " deep in others, or in itself; explode it in the CAD program");
    const Block& block = found->second;
    const Result<Plane> plane = planeOf(entity);
    const auto place = point(entity, 10, Eigen::Vector3d::Zero()),
               base = point(block.head, 10, Eigen::Vector3d::Zero());
    const auto scaleX = number(entity, 41, 1), scaleY = number(entity, 42, 1), scaleZ = number(entity, 43, 1),
               turn = number(entity, 50, 0), across = number(entity, 44, 0), up = number(entity, 45, 0);
    const auto columns = whole(entity, 70, 1), rows = whole(entity, 71, 1);
    if (!plane) return tl::unexpected<Error>(plane.error());
    for (const auto* one : {&place, &base})
      if (!*one) return tl::unexpected<Error>(one->error());
    for (const auto* one : {&scaleX, &scaleY, &scaleZ, &turn, &across, &up})
      if (!*one) return tl::unexpected<Error>(one->error());
    for (const auto* one : {&columns, &rows})
      if (!*one) return tl::unexpected<Error>(one->error());
    if (*scaleX == 0 || *scaleY == 0)
      return damaged(entity.place, "begins an INSERT with a scale of nothing");

    const Eigen::Affine3d outer = placement_;
    const std::string outerLayer = std::exchange(layer_, layerOf(entity));
    ++depth_;
    Result<void> done = {};
    for (int row = 0; done && row < std::max(1, *rows); ++row)
      for (int column = 0; done && column < std::max(1, *columns); ++column) {
        // Rows and columns run along the axes that are turned, at distances that are not stretched.
        placement_ = outer * Eigen::Affine3d(plane->axes) * Eigen::Translation3d(*place) *
                     Eigen::AngleAxisd(fromDegrees(*turn), Eigen::Vector3d::UnitZ()) *
                     Eigen::Translation3d(column * *across, row * *up, 0) *
                     Eigen::Scaling(*scaleX, *scaleY, *scaleZ) * Eigen::Translation3d(-*base);
        done = takeBlock(entity, block);
      }
    --depth_;
    placement_ = outer;
    layer_ = outerLayer;
    return done;
  }

  Result<void> takeBlock(const Entity& insert, const Block& block) {
    inserted_ += kInsertion;
    for (const Entity& entity : block.entities) inserted_ += 1 + double(entity.groups.size());
    if (inserted_ > kMostInserted)
      return refuseInsert(insert, "whose contents, as often as blocks are inserted, come to more than " +
                                      shortText(kMostInserted) +
                                      " values; export what is needed of it alone");
    for (const Entity& entity : block.entities)
      if (Result<void> ok = take(entity); !ok) return ok;
    if (polyline_) return damaged(block.head.place, "begins a block that ends within a polyline");
    return {};
  }

  Result<void> takeLine(const Entity& entity) {
    const auto from = point(entity, 10, Eigen::Vector3d::Zero()),
               to = point(entity, 11, Eigen::Vector3d::Zero());
    if (!from) return tl::unexpected<Error>(from.error());
    if (!to) return tl::unexpected<Error>(to.error());
    return add(polylineThrough({*from, *to}), entity);
  }

  Result<void> takeArc(const Entity& entity) {
    const Result<Plane> plane = planeOf(entity);
    const auto center = point(entity, 10, Eigen::Vector3d::Zero());
    const auto radius = number(entity, 40, 0), from = number(entity, 50, 0), to = number(entity, 51, 360);
    if (!plane) return tl::unexpected<Error>(plane.error());
    if (!center) return tl::unexpected<Error>(center.error());
    for (const auto* one : {&radius, &from, &to})
      if (!*one) return tl::unexpected<Error>(one->error());
    if (entity.type == "CIRCLE") return closed(entity, "a circle");
    if (!(*radius > 0)) return damaged(entity.place, "begins an arc without a radius");
    return addTurn(entity, "an arc of a whole turn", plane->at(*center), *radius * plane->axes.col(0),
                   *radius * plane->axes.col(1), fromDegrees(*from), fromDegrees(*to));
  }

  Result<void> takeEllipse(const Entity& entity) {
    const auto center = point(entity, 10, Eigen::Vector3d::Zero()),
               axis = point(entity, 11, Eigen::Vector3d::Zero());
    const auto normal = point(entity, 210, Eigen::Vector3d::UnitZ());
    const auto ratio = number(entity, 40, 1), from = number(entity, 41, 0), to = number(entity, 42, kTurn);
    for (const auto* one : {&center, &axis, &normal})
      if (!*one) return tl::unexpected<Error>(one->error());
    for (const auto* one : {&ratio, &from, &to})
      if (!*one) return tl::unexpected<Error>(one->error());
    if (!(axis->norm() > 0) || !(normal->norm() > 0) || !(*ratio > 0))
      return damaged(entity.place, "begins an ellipse without axes");
    return addTurn(entity, "a whole ellipse", *center, *axis, *ratio * normal->normalized().cross(*axis),
                   *from, *to);
  }

  Result<void> addTurn(const Entity& entity, const std::string& whole, const Eigen::Vector3d& center,
                       const Eigen::Vector3d& a, const Eigen::Vector3d& b, double from, double to) {
    double turn = std::fmod(to - from, kTurn);
    if (turn <= kWholeTurn) turn += kTurn;
    if (turn >= kTurn - kWholeTurn) return closed(entity, whole);
    from = std::fmod(from, kTurn);
    return add(ellipticArc(center, a, b, from, from + turn), entity);
  }

  /// Points of a polyline in a plane, each with the bulge of what leads on from it.
  Result<void> addBulged(const Entity& entity, const Plane& plane, Points points, std::vector<double> bulges,
                         bool isClosed) {
    if (isClosed && points.size() > 1) return closed(entity, "a polyline");
    if (points.size() < 2) {
      ++left_["polyline of one point"];
      return {};
    }
    const bool straight =
        std::all_of(bulges.begin(), bulges.end() - 1, [](double b) { return std::abs(b) < kStraight; });
    if (straight) {
      for (Eigen::Vector3d& p : points) p = plane.at(p);
      return add(polylineThrough(std::move(points)), entity);
    }
    SpaceCurve curve;
    curve.degree = 2;
    curve.knots = {0, 0, 0};
    curve.poles = {points.front()};
    curve.weights = {1};
    double knot = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Eigen::Vector3d &p = points[i], &q = points[i + 1];
      const double bulge = bulges[i];
      SpaceCurve piece;
      if (std::abs(bulge) < kStraight || (q - p).norm() == 0) {
        piece.poles = {p, (p + q) / 2, q};
        piece.weights = {1, 1, 1};
      } else {
        const Eigen::Vector3d across(p.y() - q.y(), q.x() - p.x(), 0);
        const Eigen::Vector3d center = (p + q) / 2 + (1 - bulge * bulge) / (4 * bulge) * across;
        const Eigen::Vector3d a = p - center, b(-a.y(), a.x(), 0);
        piece =
            ellipticArc(center, a, bulge > 0 ? b : Eigen::Vector3d(-b), 0, 4 * std::atan(std::abs(bulge)));
        piece.poles.back() = q;
      }
      curve.poles.insert(curve.poles.end(), piece.poles.begin() + 1, piece.poles.end());
      curve.weights.insert(curve.weights.end(), piece.weights.begin() + 1, piece.weights.end());
      for (std::size_t k = 2; k < piece.poles.size(); k += 2)
        curve.knots.insert(curve.knots.end(), 2, ++knot);
    }
    curve.knots.push_back(knot);
    for (Eigen::Vector3d& p : curve.poles) p = plane.at(p);
    return add(std::move(curve), entity);
  }

  Result<void> takeLightPolyline(const Entity& entity) {
    const Result<Plane> plane = planeOf(entity);
    const Result<double> height = number(entity, 38, 0);
    const Result<int> flags = whole(entity, 70, 0);
    if (!plane) return tl::unexpected<Error>(plane.error());
    if (!height) return tl::unexpected<Error>(height.error());
    if (!flags) return tl::unexpected<Error>(flags.error());
    Points points;
    std::vector<double> bulges;
    for (const Group& group : entity.groups) {
      if (group.code != 10 && group.code != 20 && group.code != 42) continue;
      const Result<double> value = number(group);
      if (!value) return tl::unexpected<Error>(value.error());
      if (group.code == 10) {
        points.emplace_back(*value, 0, *height);
        bulges.push_back(0);
      } else if (points.empty()) {
        return damaged(group.place, "tells of a vertex before the first one");
      } else {
        (group.code == 20 ? points.back().y() : bulges.back()) = *value;
      }
    }
    return addBulged(entity, *plane, std::move(points), std::move(bulges), *flags & 1);
  }

  Result<void> takeVertex(const Entity& entity) {
    const Result<Eigen::Vector3d> p = point(entity, 10, Eigen::Vector3d::Zero());
    const Result<double> bulge = number(entity, 42, 0);
    const Result<int> flags = whole(entity, 70, 0);
    if (!p) return tl::unexpected<Error>(p.error());
    if (!bulge) return tl::unexpected<Error>(bulge.error());
    if (!flags) return tl::unexpected<Error>(flags.error());
    constexpr int kFramePoint = 16;  // of a polyline that was fitted
    if (*flags & kFramePoint) return {};
    if (polyline_->points.size() > SpaceCurve::kMostPoles)
      return fail(ErrorCode::badInput,
                  name_ + " cannot be used: curve " + std::to_string(nextNumber()) + " has more than " +
                      std::to_string(SpaceCurve::kMostPoles) +
                      " points; export it as a spline, or more coarsely",
                  name_, double(SpaceCurve::kMostPoles + 1), double(SpaceCurve::kMostPoles));
    polyline_->points.push_back(*p);
    polyline_->bulges.push_back(*bulge);
    return {};
  }

  Result<void> endPolyline() {
    Polyline polyline = std::move(*polyline_);
    polyline_.reset();
    if (paperPolyline_) {
      ++left_["entity of a layout"];
      return {};
    }
    const Result<int> flags = whole(polyline.head, 70, 0);
    if (!flags) return tl::unexpected<Error>(flags.error());
    constexpr int kInSpace = 8, kMesh = 16, kFaces = 64;
    if (*flags & (kMesh | kFaces)) {
      ++left_["mesh"];
      return {};
    }
    Plane plane{Eigen::Matrix3d::Identity()};
    if (*flags & kInSpace) {
      std::ranges::fill(polyline.bulges, 0.0);
    } else {
      const Result<Plane> own = planeOf(polyline.head);
      const Result<double> height = number(polyline.head, 30, 0);
      if (!own) return tl::unexpected<Error>(own.error());
      if (!height) return tl::unexpected<Error>(height.error());
      plane = *own;
      for (Eigen::Vector3d& p : polyline.points) p.z() = *height;
    }
    return addBulged(polyline.head, plane, std::move(polyline.points), std::move(polyline.bulges),
                     *flags & 1);
  }

  Result<void> takeSpline(const Entity& entity) {
    const Result<int> degree = whole(entity, 71, 3);
    if (!degree) return tl::unexpected<Error>(degree.error());
    SpaceCurve curve;
    curve.degree = *degree;
    Points fitPoints;
    for (const Group& group : entity.groups) {
      // x, y and z of poles (10, 20, 30) and of fit points (11, 21, 31); knots (40) and weights (41).
      const bool isFit = group.code % 10 == 1, isPoint = group.code >= 10 && group.code <= 31;
      if (group.code % 10 > 1 || !(isPoint || group.code == 40 || group.code == 41)) continue;
      const Result<double> value = number(group);
      if (!value) return tl::unexpected<Error>(value.error());
      if (!isPoint) {
        (isFit ? curve.weights : curve.knots).push_back(*value);
        continue;
      }
      Points& points = isFit ? fitPoints : curve.poles;
      if (group.code < 20) {
        points.emplace_back(*value, 0, 0);
      } else if (points.empty()) {
        return damaged(group.place,
                       std::string("tells of a ") + (isFit ? "fit point" : "pole") + " before the first one");
      } else {
        points.back()[group.code / 10 - 1] = *value;
      }
    }
    if (curve.poles.empty() && !fitPoints.empty()) return takeFitPoints(entity, std::move(fitPoints));
    if (std::ranges::all_of(curve.weights, [](double w) { return w == 1; })) curve.weights.clear();
    return add(std::move(curve), entity);
  }

  /// A spline that is told by the points that it goes through alone.
  Result<void> takeFitPoints(const Entity& entity, Points points) {
    const auto told = whole(entity, 74, int(points.size())), flags = whole(entity, 70, 0);
    const auto start = point(entity, 12, Eigen::Vector3d::Zero()),
               end = point(entity, 13, Eigen::Vector3d::Zero());
    for (const auto* one : {&told, &flags})
      if (!*one) return tl::unexpected<Error>(one->error());
    for (const auto* one : {&start, &end})
      if (!*one) return tl::unexpected<Error>(one->error());
    if (*told != int(points.size()))
      return damaged(entity.place, "begins a spline that tells of " + std::to_string(*told) +
                                       " fit points and has " + std::to_string(points.size()));
    std::optional<SpaceCurve> curve =
        dxf::curveThrough({std::move(points), *start, *end, (*flags & kClosed) != 0});
    if (curve) return add(std::move(*curve), entity);
    const bool isClosed = (*flags & kClosed) != 0;
    return leave(entity, isClosed ? "a closed spline" : "a spline",
                 std::string("is told by fewer than ") + (isClosed ? "three" : "two") +
                     " different points; draw it again, or leave it out");
  }

  Result<DxfCurves> finish() {
    found_.unit = unit_.name;
    for (const auto& [what, count] : left_)
      found_.leftOut.push_back(std::to_string(count) + " × " + printable(what));
    if (!found_.curves.empty()) return std::move(found_);
    if (!found_.unusable.empty()) return tl::unexpected<Error>(found_.unusable.front().why);
    std::string held;
    for (const std::string& what : found_.leftOut) held += (held.empty() ? ", only " : ", ") + what;
    return fail(ErrorCode::badInput,
                name_ + " cannot be used: it holds no curves" + held +
                    "; export the section curves as lines, arcs, polylines or splines",
                name_, 0, 1);
  }

  struct Polyline {
    Entity head;
    Points points;
    std::vector<double> bulges;
  };

  Groups groups_;
  const std::string& name_;
  std::map<std::string, Block> blocks_;
  Block* block_ = nullptr;                                   // that is being gathered
  Eigen::Affine3d placement_ = Eigen::Affine3d::Identity();  // of the block that is being read
  std::string layer_;                                        // of what inserts it
  int depth_ = 0;                                            // blocks that it lies in
  double inserted_ = 0;                                      // values of blocks so far
  std::optional<double> asked_;
  const RunContext& context_;
  Unit unit_ = kUnits[0];
  std::optional<Polyline> polyline_;
  bool paperPolyline_ = false;
  std::map<std::string, int> left_;
  std::size_t points_ = 0;
  DxfCurves found_;
};

}  // namespace

bool isDxf(std::string_view bytes) {
  if (bytes.starts_with(kBinaryName)) return true;
  const std::string name;
  Groups groups(bytes, name);
  const Result<Group> first = groups.next();
  return first && first->code == 0 && trimmed(first->value) == "SECTION";
}

Result<DxfCurves> readDxf(std::string_view bytes, const std::string& name, std::optional<double> unit,
                          const RunContext& context) {
  if (bytes.starts_with(kBinaryName) && !bytes.starts_with(dxf::kBinaryMark))
    return fail(
        ErrorCode::cannotRead,
        "cannot read " + name +
            ": what a binary DXF file begins with is damaged, as by a transfer as text; copy it again, "
            "or export it as ASCII DXF",
        name);
  if (!isDxf(bytes))
    return fail(ErrorCode::cannotRead,
                "cannot read " + name + ": it is no DXF file; export it again from the CAD program", name);
  return Reader(bytes, name, unit, context).read();
}

}  // namespace bw
