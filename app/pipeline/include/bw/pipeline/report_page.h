// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bw/drawings/report.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

using drawings::ReportPicture;

/// The report of a result for people: verdict, pictures, numbers beside their limits, the parameters that
/// made them, findings, stations, and what each of `files` beside it is. Without a sweep it tells the
/// findings alone.
drawings::Report reportOf(const Evaluation& evaluation, const std::vector<ReportPicture>& pictures,
                          const std::vector<std::filesystem::path>& files);

/// A report as one HTML page that holds its pictures itself: no scripts, no fonts from elsewhere. Equal input
/// gives equal bytes.
std::string reportHtml(const drawings::Report& report);

/// Bytes as text for people: "812 bytes", "48 kB", "3.1 MB".
std::string sizeText(std::uintmax_t bytes);

}  // namespace bw::pipeline
