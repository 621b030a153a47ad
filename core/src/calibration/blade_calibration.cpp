// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "base/work_meter.h"
#include "bw/core/calibration/blade_length.h"
#include "bw/core/text/number_text.h"

namespace bw {
namespace {

constexpr int kMaxIterations = 100;
/// The solver goes on to rounding, relatively: a few iterations more than measurements need.
constexpr double kRounding = 1e-16;
/// Stands for 0 where it is divided by.
constexpr double kTiny = 1e-300;
/// Directions of the unknowns (each in units of its own error) that the measurements determine worse than
/// this by comparison are not determined.
constexpr double kDeterminate = 1e-10;
constexpr double kLargestExpansion = 0.5;

enum Unknown { kLength, kHeightOffset, kAngleOffset, kUnknowns };

/// What the measurements ask for, in numbers of the solver.
struct Task {
  std::vector<CalibrationMeasurement> measurements;
  std::vector<double> stretch;  ///< length at the measurement's over that at the working temperature
  std::vector<double> sigma;    ///< standard deviation of the height, or 1
  std::vector<Unknown> unknowns;
};

BladeMeasurement corrected(const CalibrationMeasurement& m, double angleOffset) {
  BladeMeasurement held = m.held;
  if (held.angle) *held.angle -= angleOffset;
  return held;
}

/// All weighted residuals, and their derivatives with respect to the unknowns.
class Residuals : public ceres::CostFunction {
 public:
  explicit Residuals(const Task& task) : task_(task) {
    set_num_residuals(int(task.measurements.size()));
    mutable_parameter_block_sizes()->push_back(int(task.unknowns.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::size_t n = task_.unknowns.size();
    double values[kUnknowns] = {0, 0, 0};
    for (std::size_t j = 0; j < n; ++j) values[task_.unknowns[j]] = parameters[0][j];
    for (std::size_t i = 0; i < task_.measurements.size(); ++i) {
      if (detail::workExhausted()) return false;
      const CalibrationMeasurement& m = task_.measurements[i];
      const Result<BladeHeight> hung =
          bladeHeight(values[kLength] * task_.stretch[i], corrected(m, values[kAngleOffset]), false);
      if (!hung) return false;
      residuals[i] = (hung->height + values[kHeightOffset] - m.held.height) / task_.sigma[i];
      if (!jacobians || !jacobians[0]) continue;
      const double slopes[kUnknowns] = {task_.stretch[i] / hung->blade.byHeight, 1,
                                        hung->blade.byAngle / hung->blade.byHeight};
      for (std::size_t j = 0; j < n; ++j)
        jacobians[0][i * n + j] = slopes[task_.unknowns[j]] / task_.sigma[i];
    }
    return true;
  }

 private:
  const Task& task_;
};

Error named(Error error, std::size_t index) {
  const std::string where = "measurements[" + std::to_string(index) + "]";
  error.message = where + ": " + error.message;
  error.where = error.where.empty() ? where : where + "." + error.where;
  return error;
}

Result<void> check(const std::vector<CalibrationMeasurement>& measurements,
                   const CalibrationOptions& options) {
  if (!(options.confidence > 0 && options.confidence < 1))
    return fail(ErrorCode::badInput, "the confidence must lie between 0 and 1, for instance 0.95",
                "confidence", options.confidence);
  if (!std::isfinite(options.referenceTemperature))
    return fail(ErrorCode::badInput, "the reference temperature must be a finite number of °C",
                "reference_temperature");
  const std::size_t unknowns = 1u + (options.heightOffset ? 1u : 0u) + (options.angleOffset ? 1u : 0u);
  if (measurements.size() < unknowns)
    return fail(ErrorCode::badInput,
                std::to_string(measurements.size()) + " measurements cannot tell " +
                    std::to_string(unknowns) + " numbers; add measurements or estimate fewer",
                "measurements", double(measurements.size()), double(unknowns));
  std::size_t known = 0;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const CalibrationMeasurement& m = measurements[i];
    for (const double error : {m.heightError, m.angleError, m.distanceError})
      if (!(error >= 0 && std::isfinite(error)))
        return fail(
            ErrorCode::badInput,
            "measurements[" + std::to_string(i) + "]: an error must be a standard deviation, 0 or more",
            "measurements[" + std::to_string(i) + "]", error, 0);
    if (m.heightError + m.angleError + m.distanceError > 0) ++known;
  }
  if (known != 0 && known != measurements.size())
    return fail(ErrorCode::badInput,
                "only " + std::to_string(known) + " of " + std::to_string(measurements.size()) +
                    " measurements carry errors; give an error to all of them or to none",
                "measurements", double(known), double(measurements.size()));
  return {};
}

Result<double> stretchOf(const Blade& blade, double temperature, std::size_t index) {
  const double stretch = thermalStretch(blade, temperature);
  if (!(std::abs(stretch - 1) < kLargestExpansion))
    return fail(
        ErrorCode::badInput,
        "measurements[" + std::to_string(index) + "]: the temperature must be one of a solid blade, in °C",
        "measurements[" + std::to_string(index) + "].temperature", temperature);
  return stretch;
}

/// A confidence interval about each unknown, from the covariance.
struct Spread {
  bool known = false;
  double quantile = 0;
  double scale = 1;

  Estimate around(double value, double variance) const {
    Estimate estimate{value, {}, {}, {}};
    if (!known) return estimate;
    const double error = scale * std::sqrt(variance);
    estimate.error = error;
    estimate.low = value - quantile * error;
    estimate.high = value + quantile * error;
    return estimate;
  }
};

}  // namespace

double thermalStretch(const Blade& blade, double temperature) {
  const auto growth = [&](double t) { return 1 + blade.thermalExpansion * (t - 20); };
  return growth(temperature) / growth(blade.temperature);
}

Result<CalibrationResult> calibrateBlade(const std::vector<CalibrationMeasurement>& measurements,
                                         const Blade& blade, const CalibrationOptions& options) {
  if (Result<void> ok = check(measurements, options); !ok) return tl::unexpected<Error>(ok.error());
  const std::size_t count = measurements.size();
  Task task;
  task.measurements = measurements;
  task.unknowns = {kLength};
  if (options.heightOffset) task.unknowns.push_back(kHeightOffset);
  if (options.angleOffset) task.unknowns.push_back(kAngleOffset);
  const std::size_t n = task.unknowns.size();

  CalibrationResult result;
  result.items.resize(count);
  bool weighted = false;
  double weightSum = 0, weightedLength = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const CalibrationMeasurement& m = measurements[i];
    const Result<BladeLength> single = bladeLength(m.held);
    if (!single) return tl::unexpected<Error>(named(single.error(), i));
    const Result<double> stretch = stretchOf(blade, m.temperature.value_or(blade.temperature), i);
    if (!stretch) return tl::unexpected<Error>(stretch.error());
    task.stretch.push_back(*stretch);
    result.items[i].singleLength = single->length / *stretch;
    if (!(single->byHeight > 0))
      return fail(ErrorCode::badInput,
                  "measurements[" + std::to_string(i) +
                      "]: a straight blade does not tell its length; bring the ends closer, so that it sags",
                  "measurements[" + std::to_string(i) + "].height", m.held.height);
    // The errors of all three readings, as one of the height.
    const double variance = std::pow(m.heightError, 2) +
                            std::pow(m.angleError * single->byAngle / single->byHeight, 2) +
                            std::pow(m.distanceError * single->byDistance / single->byHeight, 2);
    weighted = weighted || variance > 0;
    task.sigma.push_back(variance > 0 ? std::sqrt(variance) : 1);
    const double weight = std::pow(task.sigma[i] * single->byHeight, -2);
    weightSum += weight;
    weightedLength += weight * result.items[i].singleLength;
  }

  // The mean of the single lengths is the answer to first order; every blade must reach over its distance.
  double values[kUnknowns] = {weightedLength / weightSum, 0, 0};
  const double mean = values[kLength];
  for (std::size_t i = 0; i < count; ++i)
    if (!bladeHeight(mean * task.stretch[i], measurements[i].held, false))
      return fail(ErrorCode::noSolution,
                  "measurements[" + std::to_string(i) + "] alone gives a length of " +
                      shortText(result.items[i].singleLength, 6) +
                      " mm, which contradicts the mean of all, " + shortText(mean, 6) +
                      " mm; check its distance, height and angle",
                  "measurements[" + std::to_string(i) + "]", result.items[i].singleLength, mean);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(n));
  x[0] = mean;
  Residuals residuals(task);
  ceres::Problem::Options problemOptions;
  problemOptions.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problemOptions);
  problem.AddResidualBlock(&residuals, nullptr, x.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = kMaxIterations;
  solver.function_tolerance = kRounding;
  solver.gradient_tolerance = kRounding;
  solver.parameter_tolerance = 10 * kRounding;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable() || summary.termination_type != ceres::CONVERGENCE)
    return fail(ErrorCode::noSolution,
                "the least squares did not settle; check the measurements that contradict the others",
                "measurements");
  result.iterations = int(summary.iterations.size()) - 1;

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(count, n);
  Eigen::VectorXd r(count);
  const double* parameters[] = {x.data()};
  double* jacobians[] = {jacobian.data()};
  if (!residuals.Evaluate(parameters, r.data(), jacobians))
    return fail(ErrorCode::internal, "the calibrated blade cannot be evaluated", "measurements");
  // Scaled to unit columns, so that mm and rad compare.
  const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseMax(kTiny).cwiseInverse();
  const Eigen::MatrixXd normal = scale.asDiagonal() * (jacobian.transpose() * jacobian) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal);
  if (!(eigen.eigenvalues()[0] > kDeterminate))
    return fail(ErrorCode::badInput,
                "the measurements cannot tell the length from the offsets; measure at different distances "
                "and angles, "
                "or estimate fewer numbers",
                "measurements");
  const Eigen::MatrixXd covariance = scale.asDiagonal() * normal.inverse() * scale.asDiagonal();

  for (std::size_t j = 0; j < n; ++j) values[task.unknowns[j]] = x[Eigen::Index(j)];
  result.degreesOfFreedom = int(count) - int(n);
  const int free = result.degreesOfFreedom;
  const double chiSquared = r.squaredNorm();
  result.sigma = free > 0 ? std::sqrt(chiSquared / free) : 0;
  Spread spread;
  const double tail = 0.5 + 0.5 * options.confidence;
  if (weighted) {
    spread = {true, boost::math::quantile(boost::math::normal(), tail), 1};
    if (free > 0)
      result.plausibility =
          boost::math::cdf(boost::math::complement(boost::math::chi_squared(free), chiSquared));
  } else if (free > 0) {
    spread = {true, boost::math::quantile(boost::math::students_t(free), tail), result.sigma};
  }
  const double reference = thermalStretch(blade, options.referenceTemperature);
  result.length = spread.around(values[kLength], covariance(0, 0));
  result.reference = spread.around(values[kLength] * reference, covariance(0, 0) * reference * reference);
  for (std::size_t j = 1; j < n; ++j) {
    const Estimate estimate =
        spread.around(values[task.unknowns[j]], covariance(Eigen::Index(j), Eigen::Index(j)));
    (task.unknowns[j] == kHeightOffset ? result.heightOffset : result.angleOffset) = estimate;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Result<BladeHeight> hung =
        bladeHeight(values[kLength] * task.stretch[i], corrected(measurements[i], values[kAngleOffset]));
    if (!hung) return tl::unexpected<Error>(named(hung.error(), i));
    result.items[i].weightedResidual = -r[Eigen::Index(i)];
    result.items[i].residual = -r[Eigen::Index(i)] * task.sigma[i];
    result.items[i].blade = hung->blade;
  }
  return result;
}

}  // namespace bw
