// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <string_view>

#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e15;

Result<Elastica> anchoredFromJson(const json& object, double length, const std::string& path) {
  ObjectReader reader(object, path);
  Elastica::Anchor anchor;
  for (const char* key : {"at", "point", "angle", "curvature", "force"})
    reader.need(key, path + " needs the key " + key);
  reader.number("at", anchor.at, -kHuge, kHuge);
  readPoint(reader, "point", anchor.point);
  reader.number("angle", anchor.angle, -kHuge, kHuge);
  reader.number("curvature", anchor.curvature, -kHuge, kHuge);
  readPoint(reader, "force", anchor.force);
  reader.number("straight", anchor.straight, 0, kHuge);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  return Elastica::makeAnchored(anchor, length);
}

}  // namespace

ordered_json elasticaToJson(const Elastica& e) {
  ordered_json object;
  object["start"] = e.start();
  object["start_angle"] = e.startAngle();
  object["start_curvature"] = e.startCurvature();
  object["force"] = e.force();
  object["length"] = e.length();
  if (const Elastica::Anchor* a = e.anchor())
    object["anchor"] = {{"at", a->at},       {"point", a->point},
                        {"angle", a->angle}, {"curvature", a->curvature},
                        {"force", a->force}, {"straight", a->straight}};
  if (const std::optional<ControlParameters> p = e.controlParameters())
    object["control_parameters"] = {{"k", p->k},     {"s0", p->s0}, {"l", p->l}, {"S", p->S},
                                    {"phi", p->phi}, {"x", p->x},   {"y", p->y}};
  else
    object["control_parameters"] = nullptr;
  return object;
}

Result<Elastica> elasticaFromJson(const json& object, const std::string& path) {
  ObjectReader reader(object, path);
  const json* control = reader.given("control_parameters");
  const json* anchor = reader.given("anchor");
  const bool regular = object.is_object() && object.contains("start");
  Eigen::Vector2d start = Eigen::Vector2d::Zero(), force = Eigen::Vector2d::Zero();
  double angle = 0, curvature = 0, length = 0;
  if (regular || anchor || !control) {
    if (regular || !anchor) readPoint(reader, "start", start);
    reader.number("start_angle", angle, -kHuge, kHuge);
    reader.number("start_curvature", curvature, -kHuge, kHuge);
    if (regular || !anchor) readPoint(reader, "force", force);
    reader.number("length", length, 0, kHuge);
    for (const char* key : {"start_angle", "start_curvature", "length"})
      if (regular || !anchor || key == std::string_view("length"))
        reader.need(key, path + " needs the key " + key);
    if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
    if (!anchor) return Elastica::make(start, angle, curvature, force, length);
    Result<Elastica> held = anchoredFromJson(*anchor, length, path + ".anchor");
    if (!held || !regular) return held;
    // What stands beside the anchor must tell the same curve.
    constexpr double kSame = 1e-6;
    const double miss =
        std::max({(held->start() - start).norm() / length, std::abs(held->startAngle() - angle),
                  std::abs(held->startCurvature() - curvature) * length / (1 + std::abs(curvature) * length),
                  (held->force() - force).norm() / (1e-300 + force.norm())});
    if (!(miss <= kSame))
      return fail(ErrorCode::badInput,
                  path + ".anchor tells another curve than " + path +
                      ".start, start_angle, start_curvature and force; leave one of them out.",
                  path + ".anchor", miss, kSame);
    return held;
  }
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  ObjectReader inner(*control, path + ".control_parameters");
  ControlParameters p;
  const std::pair<const char*, double*> members[] = {{"k", &p.k},     {"s0", &p.s0}, {"l", &p.l}, {"S", &p.S},
                                                     {"phi", &p.phi}, {"x", &p.x},   {"y", &p.y}};
  for (const auto& [key, out] : members) {
    inner.number(key, *out, -kHuge, kHuge);
    inner.need(key, inner.path() + " needs the key " + key);
  }
  if (Result<void> ok = inner.finish(); !ok) return passOn(ok.error());
  return Elastica::fromControlParameters(p);
}

}  // namespace bw::cases
