// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "pose_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "seen_lines.h"

namespace bw::drawings {

namespace {

const Eigen::Vector3d kEye(0.45, -0.8, 0.5);
constexpr double kShortestArrow = 7;  ///< mm on the page
constexpr double kLetterRoom = 4;     ///< mm about the picture, for the letters at the grips

/// From the file's frame to the coordinates of a box.
Eigen::Vector3d vectorIn(const Box& box, const Eigen::Vector3d& v) {
  return {v.dot(box.frame.x), v.dot(box.frame.y), v.dot(box.frame.normal)};
}

/// Whether something at `p` is hidden by a box with a corner at 0: the way to the eye passes through it.
bool hiddenBy(const Eigen::Vector3d& size, const Eigen::Vector3d& p, const Eigen::Vector3d& toward) {
  double from = 1e-6, to = 1e300;
  for (int k = 0; k < 3; ++k) {
    const double a = -p[k] / toward[k], b = (size[k] - p[k]) / toward[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return to - from > 1e-6 * size.norm();
}

bool within(const Eigen::Vector3d& size, const Eigen::Vector3d& p) {
  const double slack = 1e-3 * size.norm();
  return (p.array() >= -slack).all() && ((size - p).array() >= -slack).all();
}

/// Points along a line, `count` for each of its pieces.
Polyline finer(const Polyline& line, int count) {
  Polyline out = {line.front()};
  for (std::size_t i = 1; i < line.size(); ++i)
    for (int k = 1; k <= count; ++k)
      out.push_back(line[i - 1] + (line[i] - line[i - 1]) * (double(k) / count));
  return out;
}

/// Fits points into a rectangle.
class Fit {
 public:
  Fit(const Rectangle& room, const std::vector<Point>& points) {
    Point low = points.front(), high = points.front();
    for (const Point& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Point size = (high - low).cwiseMax(1e-9);
    scale_ = std::min(room.width() / size.x(), room.height() / size.y());
    shift_ = room.center() - scale_ * 0.5 * (low + high);
  }
  Point operator()(const Point& p) const { return scale_ * p + shift_; }
  double scale() const { return scale_; }

 private:
  double scale_ = 1;
  Point shift_ = Point::Zero();
};

/// The side to which a way along the ground points, where it points to one.
const char* sideOf(const Eigen::Vector3d& way) {
  constexpr double kAlong = 0.999;  // within 2.5°
  const Eigen::Vector3d unit = way.normalized();
  if (unit.x() > kAlong) return "right";
  if (unit.x() < -kAlong) return "left";
  if (unit.y() > kAlong) return "back";
  if (unit.y() < -kAlong) return "front";
  if (unit.z() > kAlong) return "top";
  if (unit.z() < -kAlong) return "bottom";
  return nullptr;
}

/// A component of a way, to a thousandth.
std::string component(double value) { return shortText(std::round(1e3 * value) / 1e3, 3); }

/// The side to which a way points most.
const char* mostlyTo(const Eigen::Vector3d& way) {
  int axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  return sideOf(way[axis] * Eigen::Vector3d::Unit(axis));
}

}  // namespace

void drawHead(PdfPages& pages, const Point& tip, const Point& way, double length, double width) {
  const Point along = way.normalized(), across(-along.y(), along.x());
  pages.fill({tip, tip - length * along + 0.5 * width * across, tip - length * along - 0.5 * width * across},
             0);
}

std::string travelText(const DrawnBlock& block, const DrawnCut& cut) {
  const Box lies = lying(block.placed, cut.pose);
  const Eigen::Vector3d way = vectorIn(lies, cut.direction);
  std::string text;
  if (const char* to = sideOf(way))
    text = "from " + std::string(sideOf(-way)) + " to " + to;
  else
    text = "along " + component(way.x()) + ", " + component(way.y()) + ", " + component(way.z()) +
           " (right, back, up)";
  if (cut.blade.size() > 1)
    text += ", blade end L (left robot) at the " +
            std::string(mostlyTo(vectorIn(lies, cut.blade.front() - cut.blade.back())));
  return text;
}

void drawPose(PdfPages& pages, const Rectangle& room, const DrawnBlock& block, const DrawnCut& cut,
              const Mark& mark) {
  const Box lies = lying(block.placed, cut.pose);
  const View view = View::from(kEye);
  const Eigen::Vector3d& size = lies.size;
  const std::array<Eigen::Vector3d, 8> corners = Box{Frame{}, size}.corners();
  Polyline blade;
  for (const Eigen::Vector3d& p : cut.blade) blade.push_back(lies.frame.toLocal(p));
  std::vector<Point> all;
  for (const Eigen::Vector3d& p : corners) all.push_back(view.flat(p));
  for (const Eigen::Vector3d& p : blade) all.push_back(view.flat(p));
  const Point edge = Point::Constant(kLetterRoom);
  const Fit fit({room.low + edge, room.high - edge}, all);
  const auto place = [&](const Eigen::Vector3d& p) { return fit(view.flat(p)); };

  // Edges away from the eye begin at its far corner, which is that at 0 but for y.
  const std::size_t farthest = 2;
  for (const bool front : {false, true})
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t b = a | (std::size_t(1) << k);
        if (b == a || (a != farthest && b != farthest) != front) continue;
        pages.line({place(corners[a]), place(corners[b])}, front ? Pen{0.35, 0, {}} : Pen{0.13, 0.5, {2, 2}});
      }
  for (const Polyline& across : cut.across) {
    std::vector<Point> run;
    for (const Eigen::Vector3d& p : finer(across, 4)) {
      const Eigen::Vector3d local = lies.frame.toLocal(p);
      if (within(size, local)) {
        run.push_back(place(local));
        continue;
      }
      pages.line(simplified(run, 0.02), {0.13, 0.55, {}});
      run.clear();
    }
    pages.line(simplified(run, 0.02), {0.13, 0.55, {}});
  }
  // The blade; dashed where the block hides it.
  if (blade.size() > 1) {
    const Polyline points = finer(blade, 8);
    for (std::size_t i = 0; i < points.size();) {
      const auto hidden = [&](std::size_t k) {
        return hiddenBy(size, points[k], view.toward) && !within(size, points[k]);
      };
      const bool away = hidden(i);
      std::vector<Point> run;
      std::size_t end = i;
      for (; end < points.size() && hidden(end) == away; ++end) run.push_back(place(points[end]));
      if (end < points.size()) run.push_back(place(points[end]));
      pages.line(simplified(run, 0.02), away ? Pen{0.3, 0.3, {1, 2}} : Pen{0.6, 0, {}});
      i = end;
    }
  }
  drawMark(
      pages,
      [&] {
        std::array<Mark::Triangle, 3> turned = mark.triangles(block.placed.size, 5 / fit.scale());
        for (Mark::Triangle& triangle : turned) {
          for (Eigen::Vector3d& p : triangle.corners)
            p = lies.frame.toLocal(block.placed.frame.toWorld(p.head<2>(), p.z()));
          triangle.out = vectorIn(lies, block.placed.frame.toWorld(triangle.out.head<2>(), triangle.out.z()) -
                                            block.placed.frame.origin);
        }
        return turned;
      }(),
      view.toward, true, place);

  // The travel, over the middle of the top.
  const Eigen::Vector3d way = vectorIn(lies, cut.direction);
  const double reach = 0.28 * way.cwiseAbs().dot(size);
  const Eigen::Vector3d middle(0.5 * size.x(), 0.5 * size.y(), size.z());
  Point from = place(middle - reach * way), to = place(middle + reach * way);
  if (const double length = (to - from).norm(); length > 1e-3 && length < kShortestArrow) {
    const Point centre = 0.5 * (from + to), half = (0.5 * kShortestArrow / length) * (to - from);
    from = centre - half;
    to = centre + half;
  }
  if ((to - from).norm() > 0.5) {
    const Point along = (to - from).normalized();
    pages.line({from, to - 2 * along}, {1.4, 1, {}});
    pages.line({from, to - 2 * along}, {0.7, 0, {}});
    drawHead(pages, to, along, 3.2, 2.6);
  }
  if (blade.size() > 1) {
    const Letters letters{7.5, true, Align::centre};
    const Point left = place(blade.front()), right = place(blade.back());
    const Point out = (left - right).norm() > 0 ? Point((left - right).normalized()) : Point(-1, 0);
    const auto write = [&](const Point& at, const char* letter) {
      std::vector<Point> around;
      for (int i = 0; i < 24; ++i)
        around.push_back(at + 1.5 * Point(std::cos(i * kPi / 12), std::sin(i * kPi / 12)));
      pages.fill(around, 1);
      pages.text(at - Point(0, 0.95), letter, letters);  // half of a letter over its base line
    };
    write(left + 2.3 * out, "L");
    write(right - 2.3 * out, "R");
  }
}

}  // namespace bw::drawings
