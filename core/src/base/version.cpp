// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/version.h"

#include <ceres/version.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

namespace bw {

#define BW_TEXT2(x) #x
#define BW_TEXT(x) BW_TEXT2(x)

std::string libraryVersions() {
  return "Eigen " BW_TEXT(EIGEN_WORLD_VERSION) "." BW_TEXT(EIGEN_MAJOR_VERSION) "." BW_TEXT(EIGEN_MINOR_VERSION) "\n"
         "Ceres Solver " CERES_VERSION_STRING "\n"
         "Boost " BOOST_LIB_VERSION "\n"
         "oneTBB " TBB_VERSION_STRING "\n"
         "JSON for Modern C++ " BW_TEXT(NLOHMANN_JSON_VERSION_MAJOR) "." BW_TEXT(NLOHMANN_JSON_VERSION_MINOR) "\n";
}

}  // namespace bw
