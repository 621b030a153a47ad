// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "step_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "bw/core/text/distinct_names.h"
#include "bw/core/text/printable.h"

namespace bw::geometry {

namespace {

std::string ref(int id) { return "#" + std::to_string(id); }

template <class Items, class Text>
std::string list(const Items& items, const Text& text) {
  std::string result = "(";
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) result += ',';
    result += text(items[i]);
  }
  return result + ")";
}

std::string triple(const Eigen::Vector3d& p) {
  return "(" + stepReal(p.x()) + "," + stepReal(p.y()) + "," + stepReal(p.z()) + ")";
}

std::string integer(int i) { return std::to_string(i); }

}  // namespace

void packKnots(const std::vector<double>& flat, std::vector<double>& knots, std::vector<int>& counts) {
  for (const double k : flat) {
    if (!knots.empty() && knots.back() == k) {
      ++counts.back();
    } else {
      knots.push_back(k);
      counts.push_back(1);
    }
  }
}

std::string stepReal(double value) {
  if (value == 0) return "0.";
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e);
  if (mantissa.find('.') == std::string::npos) mantissa += '.';
  return e == std::string::npos ? mantissa : mantissa + "E" + text.substr(e + 1);
}

std::string stepString(const std::string& utf8) {
  static const char* const kHex = "0123456789ABCDEF";
  std::string result = "'";
  std::string wide;  // pending letters in hexadecimal
  int digits = 0;    // of each of them
  const auto flush = [&] {
    if (!wide.empty()) result += (digits == 8 ? "\\X4\\" : "\\X2\\") + wide + "\\X0\\";
    wide.clear();
  };
  const auto letter = [&](std::uint32_t code) {
    const int own = code < 0x10000 ? 4 : 8;
    if (own != digits) flush();
    digits = own;
    for (int shift = 4 * digits - 4; shift >= 0; shift -= 4) wide += kHex[(code >> shift) & 15];
  };
  for (std::size_t i = 0; i < utf8.size();) {
    const auto c = static_cast<unsigned char>(utf8[i]);
    const int size = c < 0x80 ? 1 : (c >> 5) == 6 ? 2 : (c >> 4) == 14 ? 3 : (c >> 3) == 30 ? 4 : 0;
    if (size == 1) {
      flush();
      if (c == '\'') {
        result += "''";
      } else if (c == '\\') {
        result += "\\\\";
      } else {
        result += c < 0x20 || c == 0x7f ? ' ' : char(c);
      }
      ++i;
      continue;
    }
    std::uint32_t code = size == 2 ? c & 31u : size == 3 ? c & 15u : c & 7u;
    bool good = size > 0 && i + size <= utf8.size();
    for (int k = 1; good && k < size; ++k) {
      const auto next = static_cast<unsigned char>(utf8[i + k]);
      good = (next >> 6) == 2;
      code = (code << 6) | (next & 63u);
    }
    if (!good || code > 0x10ffff) {
      flush();
      result += '?';
      ++i;
      continue;
    }
    letter(code);
    i += size;
  }
  flush();
  return result + "'";
}

std::vector<std::string> stepNames(const std::vector<std::string>& names) {
  return distinctNames(
      names, [](const std::string& name, const std::string& behind) { return printable(name) + behind; });
}

int StepText::add(const std::string& entity) {
  ++count_;
  body_ += ref(count_) + "=" + entity + ";\n";
  return count_;
}

int StepText::point(const Eigen::Vector3d& p) { return add("CARTESIAN_POINT(''," + triple(p) + ")"); }

int StepText::direction(const Eigen::Vector3d& d) { return add("DIRECTION(''," + triple(d) + ")"); }

int StepText::placement(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                        const Eigen::Vector3d& reference) {
  const int p = point(origin), a = direction(axis), r = direction(reference);
  return add("AXIS2_PLACEMENT_3D(''," + ref(p) + "," + ref(a) + "," + ref(r) + ")");
}

int StepText::vertex(const Eigen::Vector3d& p) {
  const int id = point(p);
  return add("VERTEX_POINT(''," + ref(id) + ")");
}

int StepText::splineCurve(int degree, const std::vector<double>& knots,
                          const std::vector<Eigen::Vector3d>& poles, const std::string& name) {
  std::vector<int> ids;
  for (const auto& p : poles) ids.push_back(point(p));
  std::vector<double> distinct;
  std::vector<int> counts;
  packKnots(knots, distinct, counts);
  return add("B_SPLINE_CURVE_WITH_KNOTS(" + stepString(name) + "," + integer(degree) + "," + list(ids, ref) +
             ",.UNSPECIFIED.,.F.,.F.," + list(counts, integer) + "," + list(distinct, stepReal) +
             ",.UNSPECIFIED.)");
}

int StepText::splineSurface(const SplineSurface& surface) {
  std::vector<std::vector<int>> ids(std::size_t(surface.polesU));
  for (int i = 0; i < surface.polesU; ++i) {
    for (int j = 0; j < surface.polesV; ++j) {
      ids[i].push_back(point(surface.poles[std::size_t(j) * surface.polesU + i]));
    }
  }
  std::vector<double> u, v;
  std::vector<int> countsU, countsV;
  packKnots(surface.knotsU, u, countsU);
  packKnots(surface.knotsV, v, countsV);
  const auto row = [](const std::vector<int>& r) { return list(r, ref); };
  return add("B_SPLINE_SURFACE_WITH_KNOTS(''," + integer(surface.degreeU) + "," + integer(surface.degreeV) +
             "," + list(ids, row) + ",.UNSPECIFIED.,.F.,.F.,.F.," + list(countsU, integer) + "," +
             list(countsV, integer) + "," + list(u, stepReal) + "," + list(v, stepReal) + ",.UNSPECIFIED.)");
}

int StepText::edge(int start, int end, int curve) {
  return add("EDGE_CURVE(''," + ref(start) + "," + ref(end) + "," + ref(curve) + ",.T.)");
}

int StepText::shell(int surface, const std::vector<Side>& border, const std::string& name) {
  const std::string quoted = stepString(name);
  std::vector<int> sides;
  for (const Side& side : border) {
    sides.push_back(add("ORIENTED_EDGE('',*,*," + ref(side.edge) + (side.forward ? ",.T.)" : ",.F.)")));
  }
  const int loop = add("EDGE_LOOP(''," + list(sides, ref) + ")");
  const int bound = add("FACE_OUTER_BOUND(''," + ref(loop) + ",.T.)");
  const int face = add("ADVANCED_FACE(" + quoted + ",(" + ref(bound) + ")," + ref(surface) + ",.T.)");
  return add("OPEN_SHELL(" + quoted + ",(" + ref(face) + "))");
}

std::string StepText::file(const std::vector<int>& shells, const std::string& name) {
  return fileOf(add("SHELL_BASED_SURFACE_MODEL(" + stepString(name) + "," + list(shells, ref) + ")"),
                "MANIFOLD_SURFACE_SHAPE_REPRESENTATION", name);
}

std::string StepText::curveFile(const std::vector<Wire>& wires, const std::string& name) {
  const int units = metric();
  Shared common = shared();
  std::vector<std::string> layers;
  for (const Wire& wire : wires)
    if (std::ranges::find(layers, wire.layer) == layers.end()) layers.push_back(wire.layer);
  std::vector<Part> all;
  for (const std::string& layer : layers) {
    std::vector<Part> parts;
    std::vector<int> sets;
    for (const Wire& wire : wires) {
      if (wire.layer != layer) continue;
      const std::string quoted = stepString(wire.name);
      sets.push_back(add("GEOMETRIC_CURVE_SET(" + quoted + "," + list(wire.curves, ref) + ")"));
      Part part{wire.name};
      part.placement = placement();
      part.shape = add("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION(" + quoted + ",(" +
                       ref(part.placement) + "," + ref(sets.back()) + ")," + ref(units) + ")");
      part.definition = product(wire.name, common);
      shapeOf(part.definition, part.shape);
      parts.push_back(std::move(part));
    }
    if (layer.empty()) {
      all.insert(all.end(), parts.begin(), parts.end());
      continue;
    }
    add("PRESENTATION_LAYER_ASSIGNMENT(" + stepString(layer) + ",''," + list(sets, ref) + ")");
    all.push_back(assembly(parts, layer, units, common));
  }
  assembly(all, name, units, common);
  return whole(name);
}

int StepText::placement() {
  return placement(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());
}

int StepText::metric() {
  const int length = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const int angle = add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const int solid = add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  const int accuracy = add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07)," + ref(length) +
                           ",'distance_accuracy_value','largest gap at the borders')");
  return add("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((" + ref(accuracy) +
             "))GLOBAL_UNIT_ASSIGNED_CONTEXT((" + ref(length) + "," + ref(angle) + "," + ref(solid) +
             "))REPRESENTATION_CONTEXT('',''))");
}

StepText::Shared StepText::shared() {
  Shared all;
  all.application = add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
  add("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000," +
      ref(all.application) + ")");
  all.product = add("PRODUCT_CONTEXT(''," + ref(all.application) + ",'mechanical')");
  return all;
}

int StepText::product(const std::string& name, Shared& shared) {
  const std::string quoted = stepString(name);
  const int id = add("PRODUCT(" + quoted + "," + quoted + ",'',(" + ref(shared.product) + "))");
  add("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(" + ref(id) + "))");
  const int formation = add("PRODUCT_DEFINITION_FORMATION('',''," + ref(id) + ")");
  if (shared.definition == 0)
    shared.definition =
        add("PRODUCT_DEFINITION_CONTEXT('part definition'," + ref(shared.application) + ",'design')");
  return add("PRODUCT_DEFINITION('design',''," + ref(formation) + "," + ref(shared.definition) + ")");
}

void StepText::shapeOf(int definition, int shape) {
  const int definitionShape = add("PRODUCT_DEFINITION_SHAPE('',''," + ref(definition) + ")");
  add("SHAPE_DEFINITION_REPRESENTATION(" + ref(definitionShape) + "," + ref(shape) + ")");
}

StepText::Part StepText::assembly(const std::vector<Part>& parts, const std::string& name, int metric,
                                  Shared& shared) {
  Part all{name};
  all.placement = placement();
  std::vector<int> places = {all.placement};
  for (std::size_t i = 0; i < parts.size(); ++i) places.push_back(placement());
  all.shape =
      add("SHAPE_REPRESENTATION(" + stepString(name) + "," + list(places, ref) + "," + ref(metric) + ")");
  all.definition = product(name, shared);
  shapeOf(all.definition, all.shape);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    const int use =
        add("NEXT_ASSEMBLY_USAGE_OCCURRENCE('" + integer(int(i) + 1) + "'," + stepString(part.name) + ",''," +
            ref(all.definition) + "," + ref(part.definition) + ",$)");
    const int useShape = add("PRODUCT_DEFINITION_SHAPE('',''," + ref(use) + ")");
    const int way =
        add("ITEM_DEFINED_TRANSFORMATION('',''," + ref(part.placement) + "," + ref(places[i + 1]) + ")");
    const int relation = add("(REPRESENTATION_RELATIONSHIP('',''," + ref(part.shape) + "," + ref(all.shape) +
                             ")REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(" + ref(way) +
                             ")SHAPE_REPRESENTATION_RELATIONSHIP())");
    add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(" + ref(relation) + "," + ref(useShape) + ")");
  }
  return all;
}

std::string StepText::fileOf(int model, const std::string& representation, const std::string& name) {
  const int units = metric();
  const int place = placement();
  const int shape = add(representation + "(" + stepString(name) + ",(" + ref(place) + "," + ref(model) +
                        ")," + ref(units) + ")");
  Shared common = shared();
  shapeOf(product(name, common), shape);
  return whole(name);
}

std::string StepText::whole(const std::string& name) const {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME(" + stepString(name) +
         ",'',(''),(''),'Bladewright','Bladewright','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n" +
         body_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace bw::geometry
