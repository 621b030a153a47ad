// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/tube_order.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/work_meter.h"

namespace bw::detail {

namespace {

/// Points of a leaf of the tree.
constexpr int kLeaf = 8;
/// Distances are told to this, in units of the chain's size: below is rounding.
constexpr double kRounding = 1e-13;
/// Work (`WorkMeter`) of the order, for each point.
constexpr std::int64_t kPointWork = 15;

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double square = edge.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0;
  return (p - a - t * edge).norm();
}

/// Boxes along the chords of a chain's parts. The distance to a segment is convex, so that none of the points
/// in a box lies farther than the farthest of its corners; along a smooth chain the boxes are thin and this
/// is near.
class ChordTree {
 public:
  explicit ChordTree(const Points& chain) : chain_(chain) {
    leaves_ = 1;
    while (leaves_ * kLeaf < std::ssize(chain)) leaves_ *= 2;
    boxes_.resize(std::size_t(2 * leaves_));
    for (int node = 2 * leaves_ - 1; node >= 1; --node) boxes_[std::size_t(node)] = boxOf(node);
  }

  /// The largest distance of the points first … last from the segment between `a` and `b`.
  double farthest(int first, int last, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    double worst = 0;
    if (first <= last) search(1, 0, leaves_ * kLeaf, first, last, a, b, worst);
    return worst;
  }

 private:
  struct Box {
    Eigen::Vector2d corners[4];
    bool empty = true;
  };

  Box boxOf(int node) const {
    // The points below a node of the implicit binary tree.
    int begin = node, end = node + 1;
    while (begin < leaves_) {
      begin *= 2;
      end *= 2;
    }
    const auto size = std::ssize(chain_);
    const auto from = std::min<std::ptrdiff_t>(std::ptrdiff_t(begin - leaves_) * kLeaf, size);
    const auto to = std::min<std::ptrdiff_t>(std::ptrdiff_t(end - leaves_) * kLeaf, size);
    Box box;
    if (from >= to) return box;
    box.empty = false;
    const Eigen::Vector2d origin = chain_[std::size_t(from)];
    const Eigen::Vector2d chord = chain_[std::size_t(to - 1)] - origin;
    const Eigen::Vector2d along = chord.norm() > 0 ? chord.normalized() : Eigen::Vector2d::UnitX();
    const Eigen::Vector2d across(-along.y(), along.x());
    Eigen::Vector2d low(0, 0), high(0, 0);
    for (auto i = from; i < to; ++i) {
      const Eigen::Vector2d v = chain_[std::size_t(i)] - origin;
      const Eigen::Vector2d own(along.dot(v), across.dot(v));
      low = low.cwiseMin(own);
      high = high.cwiseMax(own);
    }
    for (int k = 0; k < 4; ++k)
      box.corners[k] = origin + (k % 2 ? high : low).x() * along + (k / 2 ? high : low).y() * across;
    return box;
  }

  void search(int node, int begin, int end, int first, int last, const Eigen::Vector2d& a,
              const Eigen::Vector2d& b, double& worst) const {
    if (end <= first || begin > last || boxes_[std::size_t(node)].empty) return;
    double bound = 0;
    for (const Eigen::Vector2d& corner : boxes_[std::size_t(node)].corners)
      bound = std::max(bound, distanceToSegment(corner, a, b));
    if (bound <= worst + kRounding) return;
    if (end - begin <= kLeaf) {
      const int stop = std::min({end - 1, last, int(chain_.size()) - 1});
      for (int i = std::max(begin, first); i <= stop; ++i)
        worst = std::max(worst, distanceToSegment(chain_[std::size_t(i)], a, b));
      return;
    }
    const int middle = (begin + end) / 2;
    search(2 * node, begin, middle, first, last, a, b, worst);
    search(2 * node + 1, middle, end, first, last, a, b, worst);
  }

  const Points& chain_;
  int leaves_ = 1;
  std::vector<Box> boxes_;
};

}  // namespace

void TubeOrder::find() {
  if (known_) return;
  known_ = true;
  const int size = int(chain_.size());
  chargeWork(kPointWork * size);
  const ChordTree tree(chain_);
  std::vector<int> before(chain_.size()), after(chain_.size()), version(chain_.size(), 0);
  for (int i = 0; i < size; ++i) {
    before[std::size_t(i)] = (i + size - 1) % size;
    after[std::size_t(i)] = (i + 1) % size;
  }
  const auto cost = [&](int i) {
    const int a = before[std::size_t(i)], b = after[std::size_t(i)];
    const Eigen::Vector2d &p = chain_[std::size_t(a)], &q = chain_[std::size_t(b)];
    if (a < b) return tree.farthest(a + 1, b - 1, p, q);
    return std::max(tree.farthest(a + 1, size - 1, p, q), tree.farthest(0, b - 1, p, q));
  };
  struct Candidate {
    double cost;
    int point, version;
    bool operator<(const Candidate& other) const {
      return cost != other.cost ? cost > other.cost : point > other.point;
    }
  };
  std::priority_queue<Candidate> queue;
  const auto offer = [&](int i) {
    if (closed_ || (i != 0 && i != size - 1)) queue.push({cost(i), i, ++version[std::size_t(i)]});
  };
  for (int i = 0; i < size; ++i) offer(i);
  int left = size;
  while (left > 2 && !queue.empty()) {
    const Candidate next = queue.top();
    queue.pop();
    const std::size_t i = std::size_t(next.point);
    if (next.version != version[i]) continue;
    drops_.push_back({next.point, next.cost});
    version[i] = -1;
    --left;
    const int a = before[i], b = after[i];
    after[std::size_t(a)] = b;
    before[std::size_t(b)] = a;
    if (left > 2) {
      offer(a);
      offer(b);
    }
  }
}

Points TubeOrder::without(std::size_t drops) const {
  std::vector<char> dropped(chain_.size(), 0);
  for (std::size_t i = 0; i < drops; ++i) dropped[std::size_t(drops_[i].point)] = 1;
  Points result;
  for (std::size_t i = 0; i < chain_.size(); ++i)
    if (!dropped[i]) result.push_back(chain_[i]);
  return result;
}

Points TubeOrder::last(int count) {
  find();
  const std::ptrdiff_t drops = std::ssize(chain_) - std::max(count, 2);
  return without(std::size_t(std::clamp<std::ptrdiff_t>(drops, 0, std::ssize(drops_))));
}

Points TubeOrder::within(double epsilon) {
  find();
  const std::ptrdiff_t most = std::ssize(chain_) - (closed_ ? 3 : 2);
  std::ptrdiff_t drops = 0;
  while (drops < std::min(most, std::ssize(drops_)) && drops_[std::size_t(drops)].cost <= epsilon) ++drops;
  return without(std::size_t(std::max<std::ptrdiff_t>(drops, 0)));
}

}  // namespace bw::detail
