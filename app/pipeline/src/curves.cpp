// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "block_layout.h"
#include "bw/core/base/units.h"
#include "bw/core/text/distinct_names.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/pipeline/requests.h"
#include "make_files.h"

namespace bw::pipeline {

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kNear = 1;  // mm between a border and the plane between two blocks

/// A border of a cut surface.
struct Side {
  const char* name;
  Points points;
  bool seam = false;
};
using Sides = std::array<Side, 4>;

Sides sidesOf(const SurfaceGrid& grid) {
  Sides sides = {{{"start", {}}, {"end", {}}, {"left", {}}, {"right", {}}}};
  for (int c = 0; c < grid.columns; ++c) {
    sides[0].points.push_back(grid.at(0, c));
    sides[1].points.push_back(grid.at(grid.rows - 1, c));
  }
  for (int r = 0; r < grid.rows; ++r) {
    sides[2].points.push_back(grid.at(r, 0));
    sides[3].points.push_back(grid.at(r, grid.columns - 1));
  }
  return sides;
}

constexpr const char* kNames = "-names";  // after the layer whose curves they are of
constexpr double kLetters = 12;           // mm, the height of names

constexpr std::size_t kLongest = 255;    // bytes of a text that release 12 reads
constexpr const char* kLeftOut = "...";  // in the place of what is too long

/// The letters of a UTF-8 text as DXF of any release has them. By their numbers those other than ASCII and
/// what programs would take for a sign: `%%`, `^` and `\`. A number has four digits; of letters beyond them
/// programs make one, two or nothing, so that these are told as they are written down.
std::vector<std::string> dxfLetters(const std::string& utf8) {
  const auto hexadecimal = [](std::uint32_t code) {
    std::string text;
    for (int shift = code > 0xfffff ? 20 : code > 0xffff ? 16 : 12; shift >= 0; shift -= 4)
      text += "0123456789ABCDEF"[(code >> shift) & 15];
    return text;
  };
  std::vector<std::string> letters;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t size = first < 0x80 ? 1 : (first >> 5) == 6 ? 2 : (first >> 4) == 14 ? 3 : 4;
    std::uint32_t code = size == 1 ? first : first & (0xffu >> (size + 1));
    for (std::size_t k = 1; k < size && i + k < utf8.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(utf8[i + k]) & 63u);
    i += size;
    if (code > 0xffff)
      letters.push_back("(U+" + hexadecimal(code) + ")");
    else if (code > 0x7e || code == '^' || code == '\\' || (code == '%' && utf8.substr(i, 1) == "%"))
      letters.push_back("\\U+" + hexadecimal(code));
    else
      letters.emplace_back(1, char(code));
  }
  return letters;
}

/// A name with what is put behind it as a text of DXF; of one that is too long the middle is left out.
std::string dxfName(const std::string& name, const std::string& behind) {
  const std::vector<std::string> letters = dxfLetters(printable(name));
  std::string text;
  for (const std::string& letter : letters) text += letter;
  if (text.size() + behind.size() > kLongest) {
    const std::size_t room = kLongest - behind.size() - std::string(kLeftOut).size();
    std::string head, tail;
    for (auto letter = letters.rbegin(); tail.size() + letter->size() <= room / 2; ++letter)
      tail.insert(0, *letter);
    for (auto letter = letters.begin(); head.size() + letter->size() <= room - tail.size(); ++letter)
      head += *letter;
    text = head + kLeftOut + tail;
  }
  return text + behind;
}

/// The names of the curves of a layer.
std::vector<std::string> dxfNames(const CurveLayer& layer) {
  std::vector<std::string> names;
  for (const geometry::NamedCurve& curve : layer.curves) names.push_back(curve.name);
  return distinctNames(names, dxfName);
}

/// Where the name of a curve stands, and how it is turned about z, degrees.
struct NamePlace {
  Eigen::Vector3d at;
  double turn = 0;
};
NamePlace placeOfName(const Points& points) {
  const std::size_t middle = points.size() / 2, from = middle > 0 ? middle - 1 : 0;
  const Eigen::Vector3d along = points[middle] - points[from];
  double turn = toDegrees(std::atan2(along.y(), along.x()));
  if (turn > 90) turn -= 180;  // it is not read upside down
  if (turn <= -90) turn += 180;
  return {points[middle], along.head<2>().norm() > 0 ? turn : 0};
}

/// The side that lies along a plane; null if none does.
Side* sideAlong(Sides& sides, const Boundary& plane) {
  Side* nearest = nullptr;
  double least = kNear + plane.apart / 2;
  for (Side& side : sides) {
    double farthest = 0;
    for (const Eigen::Vector3d& p : side.points)
      farthest = std::max(farthest, std::abs((p - plane.point).dot(plane.normal)));
    if (farthest <= least) nearest = &side, least = farthest;
  }
  return nearest;
}

}  // namespace

std::vector<CurveLayer> curvesOf(const Evaluation& e) {
  CurveLayer seams{"seam", {}}, outlines{"outline", {}}, creases{"crease", {}};
  const std::vector<Strip> strips = stripsOf(e);
  std::vector<Sides> sides;
  for (const Strip& strip : strips) sides.push_back(sidesOf(strip.cut->analysis.value->cut));
  if (e.joints.value)
    for (const Joint& joint : e.joints.value->joints) {
      const CutEvaluation &first = *strips[joint.first].cut, &second = *strips[joint.second].cut;
      const auto boundary = boundaryOf(first.block(), second.block(), jointRequest(e.design).apart);
      if (!boundary) continue;
      Side* own = sideAlong(sides[joint.first], *boundary);
      Side* other = sideAlong(sides[joint.second], *boundary);
      if (!own || !other) continue;
      own->seam = other->seam = true;
      seams.curves.push_back({first.id + " | " + second.id, own->points});
    }
  for (std::size_t i = 0; i < strips.size(); ++i)
    for (Side& side : sides[i])
      if (!side.seam)
        outlines.curves.push_back({strips[i].cut->id + " " + side.name, std::move(side.points)});
  for (const BlockEvaluation& block : e.blocks)
    if (block.together.value)
      for (const Crease& crease : block.together.value->creases)
        for (std::size_t i = 0; i < crease.curves.size(); ++i)
          creases.curves.push_back({block.cuts[crease.first].id + " | " + block.cuts[crease.second].id +
                                        (i > 0 ? " (" + std::to_string(i + 1) + ")" : std::string()),
                                    crease.curves[i]});
  std::vector<CurveLayer> layers = {std::move(seams), std::move(outlines), std::move(creases)};
  std::erase_if(layers, [](const CurveLayer& layer) { return layer.curves.empty(); });
  return layers;
}

std::string dxfText(const std::vector<CurveLayer>& layers) {
  std::string text;
  // A code and its value, a line each.
  const auto put = [&text](int code, const std::string& value) {
    text += std::to_string(code) + "\n" + value + "\n";
  };
  const auto coordinates = [&put](const Eigen::Vector3d& p) {
    for (int axis = 0; axis < 3; ++axis) put(10 * (axis + 1), fixedText(p[axis], 6));
  };
  const auto section = [&put](const char* name) {
    put(0, "SECTION");
    put(2, name);
  };
  section("HEADER");
  put(9, "$ACADVER");
  put(1, "AC1009");
  put(0, "ENDSEC");
  section("TABLES");
  put(0, "TABLE");
  put(2, "LAYER");
  put(70, std::to_string(2 * layers.size()));
  int colour = 0;
  for (const CurveLayer& layer : layers) {
    ++colour;
    for (const std::string& name : {layer.name, layer.name + kNames}) {
      put(0, "LAYER");
      put(2, name);
      put(70, "0");
      put(62, std::to_string(colour));
      put(6, "CONTINUOUS");
    }
  }
  put(0, "ENDTAB");
  put(0, "ENDSEC");
  section("ENTITIES");
  for (const CurveLayer& layer : layers)
    for (const geometry::NamedCurve& curve : layer.curves) {
      put(0, "POLYLINE");
      put(8, layer.name);
      put(66, "1");
      put(70, "8");  // in space
      coordinates(Eigen::Vector3d::Zero());
      for (const Eigen::Vector3d& p : curve.points) {
        put(0, "VERTEX");
        put(8, layer.name);
        put(70, "32");
        coordinates(p);
      }
      put(0, "SEQEND");
      put(8, layer.name);
    }
  for (const CurveLayer& layer : layers) {
    const std::vector<std::string> names = dxfNames(layer);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Points& points = layer.curves[i].points;
      if (points.empty()) continue;
      const NamePlace place = placeOfName(points);
      put(0, "TEXT");
      put(8, layer.name + kNames);
      coordinates(place.at);
      put(40, fixedText(kLetters, 1));
      put(1, names[i]);
      put(50, fixedText(place.turn, 3));
    }
  }
  put(0, "ENDSEC");
  put(0, "EOF");
  return text;
}

}  // namespace bw::pipeline
