// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/live_row.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "bw/core/curve/same_curve.h"
#include "sweep/row_problem.h"
#include "sweep/row_station.h"

namespace bw {

using sweep::Station;

namespace {

constexpr int kSteps = 3;        // with one linearisation
constexpr double kStill = 0.02;  // mm: a step of the grips that need not be taken,
constexpr double kNone = 1e-3;   // and one that is none, where something that is asked for is missed
constexpr double kSameAxes = 1e-9;
constexpr int kMostStrides = 80;
constexpr double kShorter = 0.4, kLeastStride = 0.5;  // times the stride; mm

/// A section on its way from one curve to another.
class Way {
 public:
  Way(const PlanarCurve& from, const PlanarCurve& to) : from_(from), to_(to) {}

  /// mm that a place of it goes at most.
  double length() const {
    constexpr int kPlaces = 9;
    double longest = 0;
    for (int k = 0; k < kPlaces; ++k) {
      const double place = double(k) / (kPlaces - 1);
      longest = std::max(longest, (at(to_, place) - at(from_, place)).norm());
    }
    return longest;
  }
  /// The section after a share of the way, as a chain of points.
  Result<PlanarCurve> after(double share) const {
    constexpr int kPlaces = 65;
    std::vector<Eigen::Vector2d> chain;
    for (int k = 0; k < kPlaces; ++k) {
      const double place = double(k) / (kPlaces - 1);
      chain.emplace_back((1 - share) * at(from_, place) + share * at(to_, place));
    }
    return PlanarCurve::points(std::move(chain));
  }

 private:
  static Eigen::Vector2d at(const PlanarCurve& curve, double place) {
    return curve.value(std::lerp(curve.start(), curve.end(), place));
  }
  PlanarCurve from_, to_;
};

}  // namespace

struct LiveRow::Work {
  using Slopes = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Work(Sweep begin, RunContext running) : sweep(std::move(begin)), context(std::move(running)) {}

  Sweep sweep;
  RunContext context;
  std::optional<sweep::Row> row;
  std::vector<Station> stations;
  std::unique_ptr<sweep::RowProblem> problem;
  Slopes slopes;  ///< of the residuals, where the row was linearised last
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> normal;
  std::vector<double> residuals;

  /// Puts the problem together anew: it holds block and planes.
  void pose() {
    problem.reset();
    row.emplace(sweep, context);
    std::vector<Station*> all;
    for (Station& station : stations) all.push_back(&station);
    problem = std::make_unique<sweep::RowProblem>(*row, std::move(all));
  }
  bool linearise();
  bool isStill();
  bool settle();
  bool meets() const;
  bool put();
};

/// Linearises the row where it is.
bool LiveRow::Work::linearise() {
  ceres::CRSMatrix found;
  if (!problem->evaluate(residuals, &found)) return false;
  slopes = Eigen::Map<const Slopes>(found.num_rows, found.num_cols, Eigen::Index(found.values.size()),
                                    found.rows.data(), found.cols.data(), found.values.data());
  const Eigen::SparseMatrix<double> square = Slopes(slopes.transpose()) * slopes;
  normal.compute(square);
  return normal.info() == Eigen::Success;
}

/// Steps of Newton's method whose derivatives stay those of the last linearisation, until the grips are
/// still; where such a step leads nowhere, the row is linearised anew. False where that does not still them.
bool LiveRow::Work::isStill() {
  std::optional<double> cost = problem->evaluate(residuals);
  if (!cost) return false;
  for (const bool anew : {false, true}) {
    if (anew && !linearise()) return false;
    for (int k = 0; k < kSteps; ++k) {
      const Eigen::VectorXd step = normal.solve(
          slopes.transpose() * Eigen::VectorXd::Map(residuals.data(), Eigen::Index(residuals.size())));
      const double longest = step.lpNorm<Eigen::Infinity>();
      if (longest < kNone || (longest < kStill && meets())) return true;
      const std::vector<Station> before = stations;
      double share = 1;
      std::optional<double> next;
      constexpr double kLeastShare = 0.1;
      for (; share > kLeastShare; share /= 2) {
        for (std::size_t i = 0; i < stations.size(); ++i)
          sweep::Vector6::Map(stations[i].numbers) -= share * step.segment<6>(6 * Eigen::Index(i));
        next = problem->evaluate(residuals);
        if (next && *next <= *cost) break;
        next.reset();
        std::ranges::copy(before, stations.begin());
        if (!anew) break;
      }
      if (!next) {
        cost = problem->evaluate(residuals);
        if (!cost) return false;
        break;
      }
      cost = next;
    }
  }
  return false;
}

/// True if the parts that cut have the ends, tangents and lengths that are asked for.
bool LiveRow::Work::meets() const {
  return std::ranges::all_of(stations, [this](const Station& station) { return row->meets(station); });
}

/// Lays the blades on their sections. Where they are nearly straight, so that a little less length bends them
/// much, plain steps lead nowhere, and damped ones take their place. False where these do not find what is
/// asked for: then the row is better found anew.
bool LiveRow::Work::settle() {
  if (isStill()) return true;
  problem->settle();
  return meets() && linearise();
}

/// Puts the blades into the row.
bool LiveRow::Work::put() {
  std::vector<char> good(stations.size());
  const Result<void> ok = parallelFor(context, int(stations.size()), [&](int k) {
    const auto i = std::size_t(k);
    const Station& station = stations[i];
    const std::optional<Elastica> light = row->light(station);
    if (!light) return;
    const Result<Elastica> cut = light->segment(station.feet.front(), station.feet.back());
    if (!cut) return;
    BladePose& pose = sweep.poses[i];
    pose.cut = *cut;
    pose.blade = *light;
    pose.before = station.feet.front();
    if (station.branch)
      pose.heavy = station.branch->blade();
    else
      pose.heavy.reset();
    sweep.fits[i].fit.elastica = *cut;
    sweep.fits[i].fit.hausdorff = station.distance();
    good[i] = 1;
  });
  return ok && std::ranges::count(good, 0) == 0;
}

LiveRow::LiveRow(std::unique_ptr<Work> work) : work_(std::move(work)) {}
LiveRow::LiveRow(LiveRow&& other) noexcept = default;
LiveRow& LiveRow::operator=(LiveRow&& other) noexcept = default;
LiveRow::~LiveRow() = default;

const Sweep& LiveRow::sweep() const { return work_->sweep; }

std::optional<LiveRow> LiveRow::of(const Sweep& row, const RunContext& context) {
  if (row.request.extend != Extension::none) return {};  // its sections hold the grips
  auto work = std::make_unique<Work>(row, context);
  const sweep::Row looking(work->sweep, work->context);
  std::vector<std::optional<Station>> found(row.poses.size());
  const Result<void> ok = parallelFor(
      context, int(found.size()), [&](int i) { found[std::size_t(i)] = looking.following(std::size_t(i)); });
  if (!ok) return {};
  if (!std::ranges::all_of(found, [](const auto& station) { return station.has_value(); })) return {};
  sweep::unwrap(found, 0.25 * row.request.blade.length);
  for (std::optional<Station>& station : found) work->stations.push_back(std::move(*station));
  work->pose();
  if (!work->linearise()) return {};
  return LiveRow(std::move(work));
}

double LiveRow::wayTo(const Sweep& row, const std::vector<Section>& sections) {
  double longest = 0;
  std::size_t i = 0;
  for (const Section& section : sections) {
    if (section.chosen < 0) continue;
    if (i == row.fits.size()) return std::numeric_limits<double>::infinity();
    const PlanarCurve& from = row.fits[i++].target;
    if (sameCurve(from, section.curve())) continue;
    longest = std::max(longest, Way(from, section.curve()).length());
  }
  return i == row.fits.size() ? longest : std::numeric_limits<double>::infinity();
}

bool LiveRow::follow(const std::vector<Section>& sections, const Box& block, const PlaneFamily& planes,
                     const RunContext& context) {
  Work& work = *work_;
  work.context = context;
  std::vector<const Section*> chosen;
  for (const Section& section : sections)
    if (section.chosen >= 0) chosen.push_back(&section);
  if (chosen.size() != work.stations.size()) return false;
  bool posed = work.sweep.block == block && work.sweep.planes == planes;
  std::vector<char> stays(chosen.size());  // stations whose sections are those that they have
  std::vector<std::optional<Way>> ways(chosen.size());
  double longest = 0;
  work.sweep.block = block;
  work.sweep.planes = planes;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    BladePose& pose = work.sweep.poses[i];
    const Frame& frame = chosen[i]->frame;
    if ((frame.x - pose.frame.x).norm() + (frame.y - pose.frame.y).norm() > kSameAxes) return false;
    posed = posed && pose.travel == chosen[i]->travel;
    pose.index = chosen[i]->index;
    pose.travel = chosen[i]->travel;
    pose.frame = frame;
    const PlanarCurve& section = work.sweep.fits[i].target;
    stays[i] = sameCurve(section, chosen[i]->curve());
    if (stays[i]) continue;
    longest = std::max(longest, ways[i].emplace(section, chosen[i]->curve()).length());
  }
  if (!posed)
    work.pose();
  else if (std::ranges::count(stays, 0) == 0)
    return true;
  // A hand that is fast takes blades with it all the same, in strides that become shorter where they do not
  // follow.
  const double length = work.sweep.request.blade.length;
  double stride = longest > kStride * length ? kStride * length / longest : 1;
  bool anew = !posed;
  double done = 0;
  for (int tried = 0; done < 1; ++tried) {
    const double next = done + stride < 1 ? done + stride : 1;
    std::atomic<bool> fits = true;
    const std::vector<Station> before = work.stations;
    const auto lay = [&](double share) {
      return parallelFor(context, int(chosen.size()), [&](int k) {
        const auto i = std::size_t(k);
        if (stays[i] && !anew) return;
        if (share == 1) {
          work.sweep.fits[i].target = chosen[i]->curve();
        } else if (!stays[i]) {
          const Result<PlanarCurve> section = ways[i]->after(share);
          if (section)
            work.sweep.fits[i].target = *section;
          else
            fits = false;
        }
        work.row->take(work.stations[i], i);
        if (work.stations[i].sectionLength > length) fits = false;
      });
    };
    if (!lay(next) || !fits) return false;
    if (work.settle()) {
      done = next;
      anew = false;
      continue;
    }
    stride *= kShorter;
    if (context.stopped() || stride * longest < kLeastStride || tried == kMostStrides) return false;
    std::ranges::copy(before, work.stations.begin());
    if (!lay(done) || !work.linearise()) return false;
  }
  return work.put();
}

}  // namespace bw
