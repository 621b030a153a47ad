// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw::cases {

/// What a numeric verb of the command line answers.
struct CaseAnswer {
  std::string json;  ///< one result, or {"results": […]} for {"cases": […]}; ends with a line feed
  int failed = 0;    ///< how many cases hold an "error" instead of a result
  std::optional<Error> first;  ///< the first case's error, if any
  bool limited = false;        ///< a result is there, but a stated bound or tolerance is not met
};

/// `blade elastica`: cases {elastica, at} to points, angles, curvatures, energy, … One failing case never
/// ends the others. Cases run in parallel; the text does not depend on the number of threads except for
/// "seconds".
Result<CaseAnswer> elasticaCases(std::string_view json, const RunContext& context);

/// `blade fit`: cases {curve, options} to the fitted elastica and its residuals.
Result<CaseAnswer> fitCases(std::string_view json, const RunContext& context);

/// A `fit` case for a chain of points as text: two numbers a line, separated by comma, semicolon, tab or
/// blank; '#' starts a comment; one header line is skipped. Errors name the line.
Result<std::string> fitCaseFromCsv(std::string_view text);

/// `blade piecewise`: cases {curve, splits | pieces | tolerance, options} to a chain of elastica and its
/// joints.
Result<CaseAnswer> piecewiseCases(std::string_view json, const RunContext& context);

/// `blade biarc`: cases {points, arcs | points_kept | tolerance, options} to arcs and measures. If `pictures`
/// is given it receives one SVG text a case, empty for a case that failed.
Result<CaseAnswer> biarcCases(std::string_view json, const RunContext& context,
                              std::vector<std::string>* pictures = nullptr);

/// A `biarc` case for a chain of points, from such a text as `fitCaseFromCsv` takes.
Result<std::string> biarcCaseFromCsv(std::string_view text);

/// `blade discrete`: cases {start, end, start_angle, end_angle, length, segments, …} to a polyline of least
/// bending.
Result<CaseAnswer> discreteCases(std::string_view json, const RunContext& context);

/// `blade relax`: cases {curve, tolerance, …} to the spline of least bending energy near the curve.
Result<CaseAnswer> relaxCases(std::string_view json, const RunContext& context);

/// `blade length`: cases {distance, height, angle} to the blade's length, or {measurements, blade, …} to a
/// calibrated one.
Result<CaseAnswer> lengthCases(std::string_view json, const RunContext& context);

/// `blade bvp`: cases {start, end, start_angle, end_angle, length, options} to the equilibria of a clamped
/// blade.
Result<CaseAnswer> bvpCases(std::string_view json, const RunContext& context);

/// `blade spline`: cases {points, kind, …} to an elastica chain, a cubic spline or a chain of Béziers, or
/// {poles} to the elastica near a cubic Bézier.
Result<CaseAnswer> splineCases(std::string_view json, const RunContext& context);

}  // namespace bw::cases
