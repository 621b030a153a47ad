// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "elastica/elastica_json.h"

#include "base/json_reader.h"

namespace bw {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e15;

void readVector2(ObjectReader& reader, const std::string& key, Eigen::Vector2d& out) {
  const json* value = reader.member(key);
  const bool good =
      value && value->is_array() && value->size() == 2 && (*value)[0].is_number() && (*value)[1].is_number();
  if (good) out = {(*value)[0].get<double>(), (*value)[1].get<double>()};
  if (!good || !out.allFinite())
    reader.complain(key, reader.path() + "." + key + " must be two finite numbers [x, y]");
}

}  // namespace

ordered_json elasticaToJson(const Elastica& e) {
  ordered_json object;
  object["start"] = {e.start().x(), e.start().y()};
  object["start_angle"] = e.startAngle();
  object["start_curvature"] = e.startCurvature();
  object["force"] = {e.force().x(), e.force().y()};
  object["length"] = e.length();
  if (const std::optional<ControlParameters> p = e.controlParameters())
    object["control_parameters"] = {{"k", p->k},     {"s0", p->s0}, {"l", p->l}, {"S", p->S},
                                    {"phi", p->phi}, {"x", p->x},   {"y", p->y}};
  else
    object["control_parameters"] = nullptr;
  return object;
}

Result<Elastica> elasticaFromJson(const json& object, const std::string& path) {
  ObjectReader reader(object, path);
  const json* control = reader.member("control_parameters");
  const bool regular = object.is_object() && object.contains("start");
  Eigen::Vector2d start = Eigen::Vector2d::Zero(), force = Eigen::Vector2d::Zero();
  double angle = 0, curvature = 0, length = 0;
  if (regular || !control || control->is_null()) {
    readVector2(reader, "start", start);
    reader.number("start_angle", angle, -kHuge, kHuge);
    reader.number("start_curvature", curvature, -kHuge, kHuge);
    readVector2(reader, "force", force);
    reader.number("length", length, 0, kHuge);
    for (const char* key : {"start_angle", "start_curvature", "length"})
      if (!reader.has(key)) reader.complain(key, path + " needs the key " + key);
    if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
    return Elastica::make(start, angle, curvature, force, length);
  }
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  ObjectReader inner(*control, path + ".control_parameters");
  ControlParameters p;
  const std::pair<const char*, double*> members[] = {{"k", &p.k},     {"s0", &p.s0}, {"l", &p.l}, {"S", &p.S},
                                                     {"phi", &p.phi}, {"x", &p.x},   {"y", &p.y}};
  for (const auto& [key, out] : members) {
    inner.number(key, *out, -kHuge, kHuge);
    if (!inner.has(key)) inner.complain(key, inner.path() + " needs the key " + key);
  }
  if (Result<void> ok = inner.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return Elastica::fromControlParameters(p);
}

ordered_json errorToJson(const Error& error) {
  ordered_json object = {
      {"code", errorCodeName(error.code)}, {"message", error.message}, {"where", error.where}};
  object["value"] = error.value ? ordered_json(*error.value) : ordered_json(nullptr);
  object["limit"] = error.limit ? ordered_json(*error.limit) : ordered_json(nullptr);
  return {{"error", object}};
}

}  // namespace bw
