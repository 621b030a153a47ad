// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/drawing_link.h"

#include "design/design_keys.h"

namespace bw {

using nlohmann::json;

namespace {

constexpr double kFarthest = 1e7;  // mm

std::string textOf(const DesignedSurface& surface) {
  return detail::surfaceJson(surface, [](const std::string&) -> const BoundNumber* { return nullptr; })
      .dump();
}

std::optional<Fingerprint> readMark(ObjectReader& reader, const char* key) {
  std::string text;
  reader.need(key, reader.path() + " needs the key " + key);
  reader.text(key, text);
  const std::optional<Fingerprint> mark = fingerprintFrom(text);
  if (!mark && !text.empty())
    reader.complain(key, reader.path() + "." + key + " is damaged; take the key drawing out");
  return mark;
}

}  // namespace

Fingerprint surfaceMark(const DesignedSurface& surface) {
  // Degrees in a file are not always the angles that they came from: as it is read from there.
  const std::string text = textOf(surface);
  const json object = {{"surface", json::parse(text)}};
  ObjectReader reader(object, "surface");
  std::optional<DesignedSurface> read;
  detail::readSurface(reader, read);
  return fingerprintOf(reader.finish() && read ? textOf(*read) : text);
}

bool isAsDrawn(const DrawingLink& link, const DesignedSurface& surface) {
  return link.surface == surfaceMark(surface);
}

void detail::readDrawing(ObjectReader& reader, Source& source) {
  const json* value = reader.member("drawing");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".drawing");
  if (!source.surface)
    inner.complain("drawing", reader.path() + " has the key drawing but no surface that was made of it");
  DrawingLink link;
  std::string path, layer;
  inner.need("path", inner.path() + " needs the key path: where the drawing lies");
  inner.text("path", path);
  link.path = path;
  const bool one = inner.has("layer");
  inner.text("layer", layer);
  if (one) link.layer = layer;
  link.read = readMark(inner, "fingerprint").value_or(Fingerprint());
  link.surface = readMark(inner, "surface").value_or(Fingerprint());
  StockBlock block;
  readPlacement(inner, block);
  link.block = block.placement;
  inner.vector3("direction", link.direction, -kFarthest, kFarthest);
  inner.number("blade_length", link.length, 0, kFarthest);
  if (reader.adopt(inner.finish())) source.drawing = std::move(link);
}

void detail::writeDrawing(const Source& source, json& object) {
  if (!source.drawing) return;
  const DrawingLink& link = *source.drawing;
  json written = {{"path", link.path.generic_string()},
                  {"fingerprint", fingerprintText(link.read)},
                  {"surface", fingerprintText(link.surface)}};
  if (link.layer) written["layer"] = *link.layer;
  writePlacement({.placement = link.block}, written);
  written["direction"] = {link.direction.x(), link.direction.y(), link.direction.z()};
  written["blade_length"] = link.length;
  object["drawing"] = std::move(written);
}

}  // namespace bw
