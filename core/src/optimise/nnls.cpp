// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/nnls.h"

#include <Eigen/QR>

#include <algorithm>
#include <vector>

namespace bw::optimise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A component or a gain up to this part of the matrix (and of 1) is rounding.
constexpr double kZero = 1e-13;

}  // namespace

VectorXd nonNegativeLeastSquares(const MatrixXd& A, const VectorXd& b) {
  const Index count = A.cols();
  VectorXd u = VectorXd::Zero(count);
  std::vector<Index> passive;  // the components that may be above zero
  const double tolerance = kZero * (1 + A.norm());
  // Every set is visited at most once, in practice about one a component.
  for (Index round = 0; round < 3 * count + 10; ++round) {
    const VectorXd gain = A.transpose() * (b - A * u);
    Index enter = -1;
    for (Index i = 0; i < count; ++i) {
      if (std::find(passive.begin(), passive.end(), i) != passive.end()) continue;
      if (gain[i] > tolerance && (enter < 0 || gain[i] > gain[enter])) enter = i;
    }
    if (enter < 0) break;
    passive.push_back(enter);
    while (!passive.empty()) {
      MatrixXd part(A.rows(), static_cast<Index>(passive.size()));
      for (std::size_t k = 0; k < passive.size(); ++k) part.col(static_cast<Index>(k)) = A.col(passive[k]);
      const VectorXd x = part.colPivHouseholderQr().solve(b);
      double share = 1;  // of the way to x on which all components stay above zero
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double have = u[passive[k]];
        if (x[static_cast<Index>(k)] <= 0) share = std::min(share, have / (have - x[static_cast<Index>(k)]));
      }
      if (!(share >= 0)) share = 0;
      for (std::size_t k = 0; k < passive.size(); ++k)
        u[passive[k]] += share * (x[static_cast<Index>(k)] - u[passive[k]]);
      if (share >= 1) break;
      std::erase_if(passive, [&](Index i) {
        if (u[i] > tolerance) return false;
        u[i] = 0;
        return true;
      });
    }
  }
  return u;
}

}  // namespace bw::optimise
