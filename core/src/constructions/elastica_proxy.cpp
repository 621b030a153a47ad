// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/fit/elastica_fit.h"
#include "fit/fit_guess.h"

namespace bw {

Result<ProxyPrediction> predictElastica(const PlanarCurve& curve) {
  const PlanarCurve::Quadrature& q = curve.quadrature();
  const double length = curve.length();
  // κ projected on 1, x, y over arc length, in units of the length.
  const fit::FitTarget target(curve);
  const fit::AffineCurvature law = fit::fitAffineCurvature(target);
  const auto lawAt = [&](const Eigen::Vector2d& p) {
    return law.curvatureAt((p - target.centre) / length) / length;
  };
  // What is left of the curvature, integrated to an angle and then to a displacement.
  double angle = 0, worst = 0, before = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < q.point.size(); ++i) {
    const double rest = lawAt(q.point[i]) - q.curvature[i];
    const double half = rest * q.weight[i] / 2;
    const Eigen::Vector2d normal(-q.tangent[i].y(), q.tangent[i].x());
    const double step = q.arc[i] - before;
    shift += step * angle * normal;
    angle += half;
    worst = std::max(worst, std::abs(shift.dot(normal)));
    angle += half;
    before = q.arc[i];
  }
  const Eigen::Vector2d start = curve.value(curve.start());
  const Eigen::Vector2d tangent = curve.tangent(curve.start());
  const Result<Elastica> guess = Elastica::make(start, std::atan2(tangent.y(), tangent.x()), lawAt(start),
                                                law.force / (length * length), length);
  if (!guess) return tl::unexpected<Error>(guess.error());
  return ProxyPrediction{worst, *guess};
}

Result<BezierProxy> elasticaOfBezier(const CubicPoles& poles) {
  const Result<PlanarCurve> curve = PlanarCurve::bezier({poles.begin(), poles.end()});
  if (!curve) return tl::unexpected<Error>(curve.error());
  const Result<ProxyPrediction> prediction = predictElastica(*curve);
  if (!prediction) return tl::unexpected<Error>(prediction.error());
  FitOptions options;
  options.length = FitOptions::Length::exact;
  options.endpoints = true;
  options.tangents = true;
  const Result<FitResult> fit = fitElastica(*curve, options);
  if (!fit) return tl::unexpected<Error>(fit.error());
  if (fit->status == FitStatus::infeasible)
    return fail(
        ErrorCode::noSolution,
        "no elastica near this Bézier curve has its ends, end tangents and length; make the angles of its "
        "control polygon less acute",
        "poles");
  BezierProxy proxy;
  proxy.elastica = fit->elastica;
  proxy.deviation = fit->hausdorff;
  proxy.predicted = prediction->deviation;
  proxy.length = curve->length();
  const PlanarCurve::Quadrature& q = curve->quadrature();
  for (std::size_t i = 0; i < q.weight.size(); ++i)
    proxy.bezierEnergy += 0.5 * q.weight[i] * q.curvature[i] * q.curvature[i];
  return proxy;
}

}  // namespace bw
