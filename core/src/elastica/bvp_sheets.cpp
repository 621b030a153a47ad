// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_sheets.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elastica/bvp_taut.h"

namespace bw::detail {

namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;
/// Beyond this phase the start values do not tell the end well.
constexpr double kTaut = 14;
/// Solutions that miss their ends by more, in lengths and rad, hang on digits that no number here has.
constexpr double kLargestMiss = 1e-10;
/// A taut blade's tangents lie within this of its chord, rad.
constexpr double kLargestBend = 3.0;
/// √f L of a blade that counts as taut.
constexpr double kLeastTaut = 12;

/// Carlson's R_F(x, y, z) and R_D(x, y, z) in one duplication.
struct Carlson {
  double f, d;
};
Carlson carlson(double x, double y, double z) {
  constexpr double kSpread = 1.5e-3;  // series to fifth order: errors of about kSpread^6
  constexpr int kMaxSteps = 60;
  double sum = 0, share = 1;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double mean = (x + y + z) / 3;
    const double spread = std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)});
    if (spread <= kSpread * mean) break;
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double shift = rx * ry + ry * rz + rz * rx;
    sum += share / (rz * (z + shift));
    share *= 0.25;
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
  }
  Carlson result{};
  {
    const double mean = (x + y + z) / 3;
    const double u = (mean - x) / mean, v = (mean - y) / mean, w = -(u + v);
    const double e2 = u * v - w * w, e3 = u * v * w;
    result.f = (1 + (e2 / 24 - 0.1 - 3 * e3 / 44) * e2 + e3 / 14) / std::sqrt(mean);
  }
  {
    const double mean = (x + y + 3 * z) / 5;
    const double u = (mean - x) / mean, v = (mean - y) / mean, w = (mean - z) / mean;
    const double ea = u * v, eb = w * w, ec = ea - eb, ed = ea - 6 * eb, ee = ed + ec + ec;
    const double series = 1 + ed * (-3.0 / 14 + 0.25 * 9.0 / 22 * ed - 1.5 * 3.0 / 26 * w * ee) +
                          w * (ee / 6 + w * (-9.0 / 22 * ec + w * 3.0 / 26 * ea));
    result.d = 3 * sum + share * series / (mean * std::sqrt(mean));
  }
  return result;
}

/// ∫ dh / √(k² − sin² h) and ∫ sin² h dh / √(k² − sin² h).
struct Integrals {
  double time = 0, square = 0;
  Integrals operator+(const Integrals& o) const { return {time + o.time, square + o.square}; }
  Integrals operator-(const Integrals& o) const { return {time - o.time, square - o.square}; }
  Integrals operator*(double s) const { return {s * time, s * square}; }
};

/// One modulus: k² and k² − 1, the latter without cancellation.
struct Modulus {
  double square = 1, excess = 0;
};

/// The integrals from 0 to h in [−π/2, π/2], |sin h| ≤ k.
Integrals quarter(const Modulus& k, double h) {
  const double s = std::sin(h), c = std::cos(h);
  const double below = std::max(k.excess + c * c, 0.0);
  const Carlson r = carlson(k.square * c * c, below, k.square);
  return {s * r.f, k.square * s * s * s * r.d / 3};
}

/// The integrals up to the turning point of a swing (k < 1).
Integrals swing(const Modulus& k) {
  const double root = std::sqrt(k.square);
  const Carlson r = carlson(-k.square * k.excess, 0, k.square);
  return {root * r.f, k.square * k.square * root * r.d / 3};
}

/// The integrals from 0 to π/2 for a pendulum that goes over (k > 1).
Integrals overTop(const Modulus& k) {
  const Carlson r = carlson(0, k.excess, k.square);
  return {r.f, k.square * r.d / 3};
}

/// The integrals from 0 to any h for a pendulum that goes over (k > 1), or within its swing.
Integrals upTo(const Modulus& k, double h) {
  const double turns = std::round(h / kPi);
  Integrals result = quarter(k, h - turns * kPi);
  if (turns != 0) result = result + overTop(k) * (2 * turns);
  return result;
}

/// A shape in the sheets: swinging pendulums by inflections and first direction, and those that turn one way
/// only.
struct Sheet {
  int inflections = 0;  ///< 0: one way only
  int direction = 1;    ///< of the first swing
};

/// What all swinging sheets share at one force angle a and one level t.
struct Node {
  double a = 0, t = 0;
  Integrals start{}, end{}, whole{};
  double startRate = 0, endRate = 0;  ///< |κ|/√f at the ends
  Modulus modulus;
};

struct Image {
  double x = 0, y = 0;  ///< the end in the frame of the start, the length 1
  double root = 0;      ///< √f
};

/// The pendulum's angle against the force is a at the start and a + turning at the end (half angles inside).
class Sheets {
 public:
  explicit Sheets(double turning) : turning_(turning) {}

  Node swingingNode(double a, double t) const {
    const double b = a + turning_;
    const double sa = std::sin(0.5 * a), sb = std::sin(0.5 * b);
    const double ca = std::cos(0.5 * a), cb = std::cos(0.5 * b);
    // 1 − k² = (1 − k_min²) sech² t: the sheets' edges at t = 0 are smooth, and k → 1 is far away.
    const double left = std::min(ca * ca, cb * cb);
    const double sech = 1 / std::cosh(t);
    Modulus k;
    k.excess = -left * sech * sech;
    k.square = 1 + k.excess;
    Node node{.a = a, .t = t, .modulus = k};
    node.start = quarter(k, 0.5 * a);
    node.end = quarter(k, 0.5 * b);
    node.whole = swing(k);
    const double tanh = std::tanh(t);
    const double gap = left * tanh * tanh;  // k² − k_min²
    node.startRate =
        2 * std::sqrt(std::max(gap + (std::abs(sa) >= std::abs(sb) ? 0.0 : sb * sb - sa * sa), 0.0));
    node.endRate =
        2 * std::sqrt(std::max(gap + (std::abs(sb) >= std::abs(sa) ? 0.0 : sa * sa - sb * sb), 0.0));
    return node;
  }

  Node oneWayNode(double a, double t) const {
    const double b = a + turning_;
    const double ha = 0.5 * a, hb = 0.5 * b;
    const double ca = std::cos(ha), cb = std::cos(hb);
    const bool over = std::floor((hb + 0.5 * kPi) / kPi) != std::floor((ha + 0.5 * kPi) / kPi);
    const double left = over ? 0.0 : std::min(ca * ca, cb * cb);  // 1 − k_min²
    const double sinh = std::sinh(t);
    const double gap = 1 / (sinh * sinh);
    Modulus k;
    k.excess = gap - left;
    k.square = 1 + k.excess;
    Node node{.a = a, .t = t, .modulus = k};
    node.start = upTo(k, ha);
    node.end = upTo(k, hb);
    node.startRate = 2 * std::sqrt(gap + (ca * ca - left));
    node.endRate = 2 * std::sqrt(gap + (cb * cb - left));
    return node;
  }

  static Image image(const Node& node, const Sheet& sheet) {
    const double parity = sheet.inflections % 2 ? -1 : 1;
    const Integrals whole =
        (node.end * parity - node.start) * double(sheet.direction) + node.whole * (2.0 * sheet.inflections);
    const double along = whole.time - 2 * whole.square;
    const double across = sheet.direction * (node.startRate - parity * node.endRate);
    const double c = std::cos(node.a), s = std::sin(node.a);
    return {(c * along + s * across) / whole.time, (c * across - s * along) / whole.time, whole.time};
  }

  static UnitShape shape(const Node& node, const Sheet& sheet) {
    const double root = image(node, sheet).root;
    return {sheet.direction * node.startRate * root, root * root * std::cos(node.a),
            -root * root * std::sin(node.a)};
  }

  /// Holds the shape where it lies nearest to rest against the force: at an inflection, or where it points
  /// along it; of these, where it is nearest to the middle.
  static Elastica::Anchor anchor(const Node& node, const Sheet& sheet) {
    const Modulus& k = node.modulus;
    const double root = image(node, sheet).root, direction = sheet.direction;
    const bool wave = k.excess <= 0;
    const Integrals half = wave ? swing(k) : overTop(k);
    const Integrals first = half - node.start * direction;  // the way to the first such place
    const double turn = std::round((0.5 * root - first.time) / (2 * half.time));
    // Swinging sheets have the inflections that they count; those that turn one way only may have them
    // outside.
    const double place = sheet.inflections > 0 ? std::clamp(turn, 0.0, sheet.inflections - 1.0)
                         : wave                ? std::min(turn, 0.0)
                                               : turn;
    const Integrals way = first + half * (2 * std::max(place, wave ? -1.0 : place));
    const double side = wave && std::fmod(std::abs(std::max(place, -1.0)), 2.0) == 1 ? -1 : 1;
    const double delta =
        std::sqrt(std::max(-k.excess, 0.0));  // cos of the half angle against the force there
    const double angle =
        wave ? direction * side * (kPi - 2 * std::asin(std::min(delta, 1.0))) : kPi * (1 + 2 * place);
    const double rate = wave ? 0 : 2 * std::sqrt(k.excess);
    const double along = way.time - 2 * way.square, across = direction * (node.startRate - rate);
    const double c = std::cos(node.a), s = std::sin(node.a);
    Elastica::Anchor result;
    result.at = way.time / root;
    result.point = {(c * along + s * across) / root, (c * across - s * along) / root};
    result.angle = angle - node.a;
    result.curvature = direction * rate * root;
    const double sine = wave ? -direction * side * 2 * std::sqrt(k.square) * delta : 0;
    result.force = {root * root * (wave ? 2 * delta * delta - 1 : -1), root * root * sine};
    return result;
  }

 private:
  double turning_;
};

std::vector<double> levels(double first, double step, double linear, double last) {
  std::vector<double> result;
  for (double t = first; t < linear; t += step) result.push_back(t);
  for (double t = linear; t < last; t *= 1.3) result.push_back(t);
  return result;
}

/// Collects roots by cells of a grid in (a, t).
class Search {
 public:
  Search(const UnitProblem& problem, std::vector<UnitSolution>& out)
      : problem_(problem), sheets_(problem.turning), out_(out) {}

  void swinging(int maxInflections) {
    const double width = 2 * kPi - problem_.turning;
    if (!(width > 1e-9)) return;
    constexpr int kAngles = 49;  // odd: where both ends lie equally high the sheets have an edge
    const std::vector<double> ts = levels(0, 0.15, 3.0, 90.0);
    grid(kAngles, ts, [&](int i, double t) {
      // Denser towards the ends, where the pendulum starts or ends at the top.
      const double u = double(i) / (kAngles - 1);
      const double v = std::clamp(u - std::sin(2 * kPi * u) / (2 * kPi) * 0.8, 1e-6, 1 - 1e-6);
      return sheets_.swingingNode(-kPi + v * width, t);
    });
    for (int n = 1; n <= maxInflections; ++n)
      for (const int direction : {1, -1}) cells({n, direction}, false);
  }

  /// See `tautShape`; the turning is not negative.
  std::optional<UnitSolution> taut() const {
    const double start = -std::atan2(problem_.end.y(), problem_.end.x());  // tangents against the chord
    const double end = start + problem_.turning;
    const double missing = 1 - problem_.end.norm();
    if (!(std::abs(start) < kLargestBend && std::abs(end) < kLargestBend) || start * end == 0)
      return std::nullopt;
    const double root = tautRoot(start, end, missing);
    if (!(root > kLeastTaut)) return std::nullopt;
    if (std::optional<UnitSolution> loose = looselyJoinedBends(problem_, start)) return loose;
    const bool oneWay = start * end < 0;
    const Sheet sheet{oneWay ? 0 : 1, oneWay || start < 0 ? 1 : -1};
    // Against the force, which pulls back along the chord.
    const double a = start + (start > 0 || oneWay ? -kPi : kPi);
    double low = 1e-3, high = 0.5 * root + 50;
    for (int i = 0; i < 40 && high - low > 1e-3; ++i) {
      const double t = 0.5 * (low + high);
      (Sheets::image(node(oneWay, a, t), sheet).root < root ? low : high) = t;
    }
    return settleTaut(sheet, oneWay, a, 0.5 * (low + high));
  }

  void oneWay() {
    if (!(problem_.turning > 1e-12)) return;
    constexpr int kAngles = 65;
    std::vector<double> ts = levels(0.02, 0.2, 3.0, 90.0);
    grid(kAngles, ts,
         [&](int i, double t) { return sheets_.oneWayNode(-kPi + 2 * kPi * i / (kAngles - 1), t); });
    cells({0, 1}, true);
  }

 private:
  template <class Make>
  void grid(int angles, const std::vector<double>& ts, Make&& make) {
    columns_ = int(ts.size());
    rows_ = angles;
    nodes_.clear();
    for (int i = 0; i < angles; ++i)
      for (const double t : ts) nodes_.push_back(make(i, t));
  }
  const Node& node(int i, int j) const { return nodes_[std::size_t(i * columns_ + j)]; }

  void cells(const Sheet& sheet, bool oneWay) {
    images_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) images_[i] = Sheets::image(nodes_[i], sheet);
    for (int i = 0; i + 1 < rows_; ++i)
      for (int j = 0; j + 1 < columns_; ++j) {
        const std::size_t k = std::size_t(i * columns_ + j);
        const Image* corner[4] = {&images_[k], &images_[k + 1], &images_[k + std::size_t(columns_)],
                                  &images_[k + std::size_t(columns_) + 1]};
        double lowX = INFINITY, highX = -INFINITY, lowY = INFINITY, highY = -INFINITY;
        for (const Image* c : corner) {
          lowX = std::min(lowX, c->x);
          highX = std::max(highX, c->x);
          lowY = std::min(lowY, c->y);
          highY = std::max(highY, c->y);
        }
        const double margin = 0.3 * std::max(highX - lowX, highY - lowY) + 1e-9;
        const double x = problem_.end.x(), y = problem_.end.y();
        if (!(x > lowX - margin && x < highX + margin && y > lowY - margin && y < highY + margin)) continue;
        for (const int half : {0, 1}) {
          const Image& o = half ? *corner[3] : *corner[0];
          const Image& p = half ? *corner[2] : *corner[1];  // along t
          const Image& q = half ? *corner[1] : *corner[2];  // along a
          const double px = p.x - o.x, py = p.y - o.y, qx = q.x - o.x, qy = q.y - o.y;
          const double det = px * qy - py * qx;
          double u = ((x - o.x) * qy - (y - o.y) * qx) / det, v = (px * (y - o.y) - py * (x - o.x)) / det;
          constexpr double kOutside = 0.8;
          const double flat = 0.05 * (std::hypot(px, py) * std::hypot(qx, qy));
          if (std::abs(det) > flat) {
            if (u < -kOutside || v < -kOutside || u + v > 1 + kOutside) continue;
          }
          if (!std::isfinite(u) || !std::isfinite(v)) u = v = 0.3;
          u = std::clamp(u, 0.0, 1.0);
          v = std::clamp(v, 0.0, 1.0);
          const double da = node(i + 1, j).a - node(i, j).a, dt = node(i, j + 1).t - node(i, j).t;
          const double a = half ? node(i + 1, j).a - v * da : node(i, j).a + v * da;
          const double t = half ? node(i, j + 1).t - u * dt : node(i, j).t + u * dt;
          attempt(sheet, oneWay, a, t);
        }
      }
  }

  void attempt(const Sheet& sheet, bool oneWay, double a, double t) {
    const Node start = node(oneWay, a, t);
    const UnitShape shape = Sheets::shape(start, sheet);
    if (!shape.allFinite()) return;
    const std::optional<UnitSolution> found =
        phaseOf(shape) < kTaut ? settle(problem_, shape, 14) : settleTaut(sheet, oneWay, a, t);
    if (!found) return;
    for (const UnitSolution& other : out_)
      if (sameShape(other.shape, found->shape)) return;
    out_.push_back(*found);
  }

  Node node(bool oneWay, double a, double t) const {
    return oneWay ? sheets_.oneWayNode(a, t) : sheets_.swingingNode(a, t);
  }

  /// Newton's method in the sheet itself, where the force angle and the level keep their digits however taut
  /// the blade is.
  std::optional<UnitSolution> settleTaut(const Sheet& sheet, bool oneWay, double a, double t) const {
    const auto miss = [&](double angle, double level) {
      const Image image = Sheets::image(node(oneWay, angle, level), sheet);
      return Vector2d(image.x - problem_.end.x(), image.y - problem_.end.y());
    };
    constexpr int kRounds = 25;
    constexpr double kDifference = 1e-6;
    const double first = oneWay ? -1e9 : -kPi, last = oneWay ? 1e9 : kPi - problem_.turning;
    Vector2d r = miss(a, t);
    for (int round = 0; round < kRounds && r.allFinite(); ++round) {
      if (r.norm() < 1e-12) break;
      const double ha = a + kDifference < last ? kDifference : -kDifference;
      const double ht = kDifference * (1 + t);
      const Vector2d da = (miss(a + ha, t) - r) / ha, dt = (miss(a, t + ht) - r) / ht;
      const double det = da.x() * dt.y() - da.y() * dt.x();
      double stepA = -(r.x() * dt.y() - r.y() * dt.x()) / det;
      double stepT = -(da.x() * r.y() - da.y() * r.x()) / det;
      if (!std::isfinite(stepA) || !std::isfinite(stepT)) return std::nullopt;
      const double scale = std::max({std::abs(stepA) / 0.3, std::abs(stepT) / (0.2 + 0.3 * t), 1.0});
      stepA /= scale;
      stepT /= scale;
      const double oldA = a, oldT = t;
      double share = 1;
      Vector2d next = r;
      for (int half = 0; half < 6; ++half, share *= 0.5) {
        a = std::clamp(oldA + share * stepA, first + 1e-12, last - 1e-12);
        t = std::clamp(oldT + share * stepT, 1e-9, 300.0);
        next = miss(a, t);
        if (next.norm() < r.norm()) break;
      }
      if (!(next.norm() < r.norm())) break;
      r = next;
    }
    if (!(r.norm() < 1e-9)) return std::nullopt;
    const Node end = node(oneWay, a, t);
    UnitSolution result;
    result.shape = Sheets::shape(end, sheet);
    result.turning = problem_.turning;
    // Far from the single loop no stretch is so taut that the start would not tell the end.
    constexpr double kNearLoop = 1e-3;
    if (std::abs(end.modulus.excess) > kNearLoop)
      if (const std::optional<UnitSolution> settled = settle(problem_, result.shape, 4);
          settled && sameShape(settled->shape, result.shape))
        return settled;
    result.anchor = Sheets::anchor(end, sheet);
    result.error = missOf(*result.anchor);
    if (!(result.error < kLargestMiss)) return std::nullopt;
    return result;
  }

  /// How far the curve held there is from both grips.
  double missOf(const Elastica::Anchor& anchor) const {
    const Result<Elastica> held = Elastica::makeAnchored(anchor, 1);
    if (!held) return INFINITY;
    const Elastica::State end = held->at(1);
    return std::max({held->start().norm(), std::abs(held->startAngle()), (end.point - problem_.end).norm(),
                     std::abs(end.angle - problem_.turning)});
  }

  static bool sameShape(const UnitShape& a, const UnitShape& b) {
    constexpr double kSame = 1e-6;
    const double size = 1 + std::abs(a(0)) + std::sqrt(std::hypot(a(1), a(2)));
    return std::abs(a(0) - b(0)) < kSame * size && (a - b).tail<2>().norm() < kSame * size * size;
  }

  const UnitProblem& problem_;
  Sheets sheets_;
  std::vector<UnitSolution>& out_;
  int rows_ = 0, columns_ = 0;
  std::vector<Node> nodes_;
  std::vector<Image> images_;
};

}  // namespace

namespace {

UnitSolution mirrorOf(UnitSolution solution) {
  solution.shape = mirrored(solution.shape);
  solution.turning = -solution.turning;
  if (solution.anchor) {
    solution.anchor->point.y() *= -1;
    solution.anchor->angle *= -1;
    solution.anchor->curvature *= -1;
    solution.anchor->force.y() *= -1;
  }
  if (solution.bends) {
    solution.bends->first *= -1;
    solution.bends->second *= -1;
  }
  // x, y, ψ by κ, f_t, f_n: what changes sign in the mirror.
  const Eigen::Vector3d rows(1, -1, -1), columns(-1, 1, -1);
  solution.jacobian = (rows.asDiagonal() * solution.jacobian * columns.asDiagonal()).eval();
  return solution;
}

}  // namespace

std::optional<UnitSolution> tautShape(const UnitProblem& problem) {
  std::vector<UnitSolution> none;
  if (problem.turning >= 0) return Search(problem, none).taut();
  const UnitProblem turned = problem.mirrored();
  const std::optional<UnitSolution> found = Search(turned, none).taut();
  return found ? std::optional(mirrorOf(*found)) : std::nullopt;
}

std::vector<UnitSolution> allShapes(const UnitProblem& problem, int maxInflections) {
  const bool mirror = problem.turning < 0;
  const UnitProblem turned = mirror ? problem.mirrored() : problem;
  std::vector<UnitSolution> result;
  Search search(turned, result);
  search.oneWay();
  search.swinging(maxInflections);
  if (mirror)
    for (UnitSolution& solution : result) solution = mirrorOf(solution);
  // So taut that the cells do not reach it.
  if (const std::optional<UnitSolution> taut = tautShape(problem)) {
    const bool known = std::any_of(result.begin(), result.end(), [&](const UnitSolution& other) {
      return (other.shape - taut->shape).norm() < 1e-4 * taut->shape.norm();
    });
    if (!known) result.push_back(*taut);
  }
  return result;
}

}  // namespace bw::detail
