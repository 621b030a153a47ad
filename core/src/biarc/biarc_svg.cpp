// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/biarc/biarc.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

constexpr int kDigits = 6;
/// Size of the picture's longer side, in its own units, and the margin in them.
constexpr double kExtent = 1000, kMargin = 40;

class Picture {
 public:
  Picture(const Eigen::Vector2d& low, const Eigen::Vector2d& high) : low_(low), high_(high) {
    const double longest = (high - low).maxCoeff();
    scale_ = longest > 0 ? kExtent / longest : 1;
  }
  Eigen::Vector2d place(const Eigen::Vector2d& p) const {
    return {kMargin + (p.x() - low_.x()) * scale_, kMargin + (high_.y() - p.y()) * scale_};
  }
  std::string text(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d q = place(p);
    return shortText(q.x(), kDigits) + " " + shortText(q.y(), kDigits);
  }
  std::string circle(const Eigen::Vector2d& p, double radius, const char* style) const {
    const Eigen::Vector2d q = place(p);
    return "<circle cx=\"" + shortText(q.x(), kDigits) + "\" cy=\"" + shortText(q.y(), kDigits) + "\" r=\"" +
           shortText(radius) + "\" " + style + "/>\n";
  }
  double scale() const { return scale_; }
  std::string head() const {
    const Eigen::Vector2d size = (high_ - low_) * scale_ + Eigen::Vector2d::Constant(2 * kMargin);
    const std::string width = shortText(size.x(), kDigits), height = shortText(size.y(), kDigits);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height + "\" width=\"" +
           width + "\" height=\"" + height + "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  }

 private:
  Eigen::Vector2d low_, high_;
  double scale_ = 1;
};

/// One arc as a path; SVG draws at most half a turn unambiguously, so a longer one is drawn as two halves.
std::string pathOf(const CircularArc& arc, const Picture& picture, const char* colour) {
  std::string path = "<path d=\"M" + picture.text(arc.start);
  if (arc.straight()) {
    path += "L" + picture.text(arc.end());
  } else {
    const std::string radius = shortText(std::abs(*arc.radius()) * picture.scale(), kDigits);
    const char* sweep = arc.turning > 0 ? " 0 0 0 " : " 0 0 1 ";
    const int parts = std::abs(arc.turning) > kPi / 2 ? 4 : 1;
    for (int i = 1; i <= parts; ++i)
      path += "A" + radius + " " + radius + sweep + picture.text(arc.pointAt(arc.length * i / parts));
  }
  return path + "\" stroke=\"" + colour + "\"/>\n";
}

}  // namespace

std::string biarcSvg(const BiarcCurve& curve, const std::vector<Eigen::Vector2d>& data) {
  Eigen::Vector2d low = curve.points.empty() ? Eigen::Vector2d::Zero() : curve.points[0], high = low;
  const auto include = [&](const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const Eigen::Vector2d& p : data) include(p);
  for (const CircularArc& arc : curve.arcs)
    for (int i = 0; i <= 8; ++i) include(arc.pointAt(arc.length * i / 8));
  const Picture picture(low, high);
  std::string svg = picture.head();
  svg += "<g fill=\"#6b7280\">\n";
  for (const Eigen::Vector2d& p : data) svg += picture.circle(p, 3, "");
  svg += "</g>\n<g fill=\"none\" stroke-width=\"2\" stroke-linecap=\"round\">\n";
  for (std::size_t i = 0; i < curve.arcs.size(); ++i)
    svg += pathOf(curve.arcs[i], picture, i % 2 == 0 ? "#0f62a8" : "#c2410c");
  svg += "</g>\n<g stroke=\"#111827\" stroke-width=\"1.5\">\n";
  for (std::size_t i = 1; i < curve.arcs.size(); i += 2)
    svg += picture.circle(curve.arcs[i].start, 3, "fill=\"#fff\"");
  for (const Eigen::Vector2d& p : curve.points) svg += picture.circle(p, 5, "fill=\"#fff\"");
  return svg + "</g>\n</svg>\n";
}

}  // namespace bw
