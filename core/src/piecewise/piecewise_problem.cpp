// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "piecewise/piecewise_problem.h"

#include <cmath>

#include "bw/core/base/units.h"
#include "fit/fit_guess.h"
#include "fit/fit_projection.h"

namespace bw::piecewise {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using fit::ConstrainedFit;
using fit::FitConstraints;
using fit::FitNorm;
using fit::FitSolution;
using fit::FitTarget;

constexpr double kTurn = 2 * kPi;
// Pieces with more quadrature nodes than the first number are fitted on a Gauss rule with the second.
constexpr std::size_t kManyPieceNodes = 48;
constexpr int kPieceNodes = 24;

// Tension at the middle of a piece (times its length squared) is bounded: beyond exp(√400) the far end of a
// straight piece hangs on digits that the numbers of its start do not have.
constexpr double kMostTension = 400;

// The gap at a joint lies in a disc. A box around it, larger by this factor, keeps steps from running along
// the disc's edge as if it were straight.
constexpr double kBox = 1.1;

// Names of the bounds on the curvature of a piece, beyond those of all other constraints: so many are kept
// for each piece.
constexpr int kFirstBoundName = 100000;
constexpr int kBoundNames = 1000;

using Row = Eigen::Matrix<double, 7, 1>;

FitConstraints boundsOf(const FitTarget& target, std::optional<double> maxCurvature) {
  FitConstraints constraints;
  if (maxCurvature) constraints.maxCurvature = *maxCurvature * target.length;
  return constraints;
}

// The best fit under the bound: from the free fit, or else from a line.
std::optional<FitSolution> bounded(const FitTarget& target, const FitConstraints& constraints,
                                   const FitSolution& free) {
  ConstrainedFit problem(target, constraints, FitNorm::L2);
  if (problem.violation(free.placement) <= 0) return free;
  std::vector<fit::Placement> starts{free.placement};
  if (const auto line = fit::ProjectedFit(target, {}).place({0, 0, 0})) starts.push_back(line->placement);
  int iterations = free.iterations;
  for (const fit::Placement& start : starts) {
    FitSolution solution = problem.solve(start);
    solution.iterations = iterations += solution.iterations;
    if (solution.feasible) return solution;
  }
  return std::nullopt;
}

}  // namespace

std::shared_ptr<const Piece> makePiece(const PlanarCurve& curve, double from, double to,
                                       std::optional<double> maxCurvature) {
  const Result<PlanarCurve> part = curve.subCurve(from, to);
  if (!part) return nullptr;
  // Smooth parts need few nodes; a chain of points keeps all of them for the end of its fit.
  const bool many = part->quadrature().arc.size() > kManyPieceNodes;
  const bool chain = part->kind() == PlanarCurve::Kind::points || part->degree() == 1;
  FitTarget target = many && !chain ? FitTarget(*part, kPieceNodes) : FitTarget(*part);
  std::optional<FitTarget> thinned;
  if (many && chain) thinned.emplace(*part, kPieceNodes);
  const FitTarget& coarse = thinned ? *thinned : target;
  const fit::AffineCurvature law = fitAffineCurvature(target);
  const std::vector<fit::Shape> starts{guessByLength(coarse, law).placement.shape, shapeFromLaw(coarse, law),
                                       shapeFromAngles(coarse)};
  std::optional<FitSolution> free = freeFit(target, coarse, {}, starts, true);
  if (free && maxCurvature) free = bounded(target, boundsOf(target, maxCurvature), *free);
  if (!free) return nullptr;
  return std::make_shared<Piece>(Piece{*part, std::move(target), *free});
}

// An end of a piece in the frame of the first piece's target, lengths in those of the curve, curvature in
// pieces per length.
struct PiecewiseProblem::End {
  Vector2d point;
  double angle = 0, curvature = 0;
  Row gradientX = Row::Zero(), gradientY = Row::Zero(), gradientAngle = Row::Zero(),
      gradientCurvature = Row::Zero();
};

PiecewiseProblem::PiecewiseProblem(const std::vector<std::shared_ptr<const Piece>>& pieces, double length,
                                   const PiecewiseOptions& options)
    : pieces_(pieces), length_(length), options_(options), turns_(pieces.size(), 0.0) {
  for (const auto& piece : pieces) {
    fits_.emplace_back(piece->target, boundsOf(piece->target, options.maxCurvature), FitNorm::L2);
    ends_.emplace_back(std::vector<double>{-0.5, 0.5});
  }
}

VectorXd PiecewiseProblem::start() const {
  VectorXd v(unknowns());
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    v.segment(7 * static_cast<Index>(i), 7) = fit::toVector(pieces_[i]->free.placement);
  return v;
}

bool PiecewiseProblem::objective(const VectorXd& v, optimise::LeastSquaresModel* model, double& value) {
  value = 0;
  if (model != nullptr) {
    model->halfGradient = VectorXd::Zero(unknowns());
    model->gaussNewton = Eigen::MatrixXd::Zero(unknowns(), unknowns());
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Index at = 7 * static_cast<Index>(i);
    double own = 0;
    if (!fits_[i].objective(v.segment(at, 7), model != nullptr ? &part_ : nullptr, own)) return false;
    const double scale = pieces_[i]->target.length / length_;
    value += scale * scale * own;
    if (model == nullptr) continue;
    model->halfGradient.segment(at, 7) = scale * scale * part_.halfGradient;
    model->gaussNewton.block(at, at, 7, 7) = scale * scale * part_.gaussNewton;
  }
  if (model != nullptr) model->value = value;
  return std::isfinite(value);
}

PiecewiseProblem::End PiecewiseProblem::endOf(const VectorXd& all, std::size_t piece, bool atStart) {
  const Index at = 7 * static_cast<Index>(piece);
  const double* v = all.data() + at;
  const FitTarget& target = pieces_[piece]->target;
  const fit::ShapeEvaluator& ends = ends_[piece];
  const std::size_t end = atStart ? 0 : 1;
  const double scale = target.length / length_;
  const Vector2d factor = scale * std::exp(v[3]) * fit::direction(v[4]);
  const Vector2d placed = fit::turned(factor, ends.point(end));
  const Vector2d across = fit::quarterTurn(placed);
  End out;
  out.point =
      (target.centre - pieces_.front()->target.centre) / length_ + scale * Vector2d(v[5], v[6]) + placed;
  out.angle = v[4] + ends.angle(end);
  const double unit = 1 / (scale * static_cast<double>(pieces_.size()) * std::exp(v[3]));
  out.curvature = ends.curvature(end) * unit;
  for (int j = 0; j < 3; ++j) {
    const Vector2d derivative = fit::turned(factor, ends.pointDerivative(end, j));
    out.gradientX[j] = derivative.x();
    out.gradientY[j] = derivative.y();
    out.gradientAngle[j] = ends.angleDerivative(end, j);
    out.gradientCurvature[j] = ends.curvatureDerivative(end, j) * unit;
  }
  out.gradientX[3] = placed.x();
  out.gradientY[3] = placed.y();
  out.gradientX[4] = across.x();
  out.gradientY[4] = across.y();
  out.gradientX[5] = out.gradientY[6] = scale;
  out.gradientAngle[4] = 1;
  out.gradientCurvature[3] = -out.curvature;
  return out;
}

void PiecewiseProblem::chooseBranches(const VectorXd& v) {
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    ends_[i].evaluate(v.segment<3>(7 * static_cast<Index>(i)), false);
  const auto angle = [&](std::size_t i, std::size_t end) {
    return v[7 * static_cast<Index>(i) + 4] + ends_[i].angle(end);
  };
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
    turns_[i] = kTurn * std::round((angle(i, 1) - angle(i + 1, 0)) / kTurn);
  const std::size_t last = pieces_.size() - 1;
  startTurn_ = kTurn * std::round((angle(0, 0) - pieces_.front()->target.startAngle) / kTurn);
  endTurn_ = kTurn * std::round((angle(last, 1) - pieces_.back()->target.endAngle) / kTurn);
}

bool PiecewiseProblem::constraints(const VectorXd& v, optimise::Constraints& out) {
  out.clear(unknowns());
  if (!v.allFinite()) return false;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (!ends_[i].evaluate(v.segment<3>(7 * static_cast<Index>(i)), true)) return false;
  }
  struct Meeting {
    End left, right;
  };
  std::vector<Meeting> joints;
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
    joints.push_back({endOf(v, i, false), endOf(v, i + 1, true)});
  int name = 0;
  // A difference of the neighbours' ends: zero, or within a tolerance.
  const auto addMeeting = [&](std::size_t joint, double value, const Row& left, const Row& right, double sign,
                              int own) {
    auto gradient = out.add(value, own);
    gradient.segment<7>(7 * static_cast<Index>(joint)) = sign * left;
    gradient.segment<7>(7 * static_cast<Index>(joint) + 7) = -sign * right;
  };
  const auto meet = [&](std::size_t joint, double value, const Row& left, const Row& right, double sign) {
    addMeeting(joint, value, left, right, sign, name++);
  };
  const auto each = [&](auto&& take) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto& [left, right] = joints[i];
      const Vector2d gap = left.point - right.point;
      if (options_.position == 0) {
        take(i, gap.x(), left.gradientX, right.gradientX, 0.0);
        take(i, gap.y(), left.gradientY, right.gradientY, 0.0);
      }
      take(i, left.angle - right.angle - turns_[i], left.gradientAngle, right.gradientAngle, options_.angle);
      if (options_.curvature)
        take(i, left.curvature - right.curvature, left.gradientCurvature, right.gradientCurvature, 0.0);
    }
  };
  each([&](std::size_t i, double value, const Row& left, const Row& right, double tolerance) {
    if (tolerance == 0) meet(i, value, left, right, 1);
  });
  for (const bool atStart : {true, false}) {
    if (!options_.endpoints && !options_.tangents) break;
    const std::size_t piece = atStart ? 0 : pieces_.size() - 1;
    const FitTarget& target = pieces_[piece]->target;
    const End end = endOf(v, piece, atStart);
    const Index at = 7 * static_cast<Index>(piece);
    if (options_.endpoints) {
      const Vector2d goal = (target.centre - pieces_.front()->target.centre +
                             target.length * (atStart ? target.start : target.end)) /
                            length_;
      out.add(end.point.x() - goal.x(), name++).segment<7>(at) = end.gradientX;
      out.add(end.point.y() - goal.y(), name++).segment<7>(at) = end.gradientY;
    }
    if (options_.tangents) {
      const double goal = atStart ? target.startAngle + startTurn_ : target.endAngle + endTurn_;
      out.add(end.angle - goal, name++).segment<7>(at) = end.gradientAngle;
    }
  }
  out.equalities = out.size();
  each([&](std::size_t i, double value, const Row& left, const Row& right, double tolerance) {
    if (tolerance == 0) return;
    meet(i, value - tolerance, left, right, 1);
    meet(i, -value - tolerance, left, right, -1);
  });
  // The disc itself: across the gap the bound is curved like its edge.
  for (std::size_t i = 0; options_.position > 0 && i < joints.size(); ++i) {
    const auto& [left, right] = joints[i];
    const Vector2d gap = left.point - right.point;
    const double size = gap.norm();
    const Vector2d outward = size > 0 ? Vector2d(gap / size) : Vector2d::Zero();
    meet(i, size - options_.position / length_, outward.x() * left.gradientX + outward.y() * left.gradientY,
         outward.x() * right.gradientX + outward.y() * right.gradientY, 1);
    const std::size_t disc = out.size() - 1;
    // The box.
    const double room = kBox * options_.position / length_;
    for (const double sign : {1.0, -1.0}) {
      const int names = -4 * static_cast<int>(i);
      addMeeting(i, sign * gap.x() - room, left.gradientX, right.gradientX, sign, names - (sign > 0 ? 1 : 2));
      addMeeting(i, sign * gap.y() - room, left.gradientY, right.gradientY, sign, names - (sign > 0 ? 3 : 4));
    }
    if (!(size > 0)) continue;
    optimise::Constraints::Hessian edge{disc, 1 / size, VectorXd::Zero(unknowns())};
    const Index at = 7 * static_cast<Index>(i);
    edge.row.segment<7>(at) = outward.x() * left.gradientY - outward.y() * left.gradientX;
    edge.row.segment<7>(at + 7) = outward.y() * right.gradientX - outward.x() * right.gradientY;
    out.hessians.push_back(std::move(edge));
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Index at = 7 * static_cast<Index>(i) + 1;
    out.add(-v[at] / kMostTension - 1, name++)[at] = -1 / kMostTension;
  }
  for (std::size_t i = 0; options_.maxCurvature && i < pieces_.size(); ++i) {
    const Index at = 7 * static_cast<Index>(i);
    if (!fits_[i].constraints(v.segment(at, 7), bounds_)) return false;
    for (std::size_t k = 0; k < bounds_.size(); ++k) {
      const int own = kFirstBoundName + kBoundNames * static_cast<int>(i) + bounds_.names[k];
      out.add(bounds_.values[k], own).segment<7>(at) = bounds_.gradient(k);
    }
  }
  return true;
}

}  // namespace bw::piecewise
