// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_select.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "base/work_meter.h"

namespace bw::biarc {

namespace {

/// Points of a leaf of the tree.
constexpr int kLeaf = 8;
/// Distances are told to this, in units of the chain's size: below is rounding.
constexpr double kRounding = 1e-13;
/// Work (`WorkMeter`) of a question for a distance, the boxes and leaves looked at in one more unit, and the
/// part of what is left that the order may take.
constexpr std::int64_t kQueryWork = 4, kLooks = 4;
constexpr double kShare = 0.5;

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double square = edge.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0;
  return (p - a - t * edge).norm();
}

/// Boxes along the principal axes of a chain's parts. The distance to a segment is convex, so that none of
/// the points in a box lies farther than the farthest of its corners; along a smooth chain the boxes are thin
/// and this is near.
class ChordTree {
 public:
  explicit ChordTree(const Points& chain) : chain_(chain) {
    leaves_ = 1;
    while (leaves_ * kLeaf < std::ssize(chain)) leaves_ *= 2;
    boxes_.resize(std::size_t(2 * leaves_));
    for (int node = 2 * leaves_ - 1; node >= 1; --node) boxes_[std::size_t(node)] = boxOf(node);
  }

  /// The largest distance of the points first … last from the segment between `a` and `b`; charges its work.
  double farthest(int first, int last, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    Query query{first, last, a, b};
    int low = leaves_ + first / kLeaf, high = leaves_ + last / kLeaf, size = kLeaf;
    for (; low < high; low /= 2, high /= 2) size *= 2;
    const int begin = low * size - leaves_ * kLeaf;
    if (first <= last) search({low, begin, begin + size}, std::numeric_limits<double>::max(), query);
    detail::chargeWork(kQueryWork + query.looks / kLooks);
    return query.worst;
  }

 private:
  struct Box {
    Eigen::Vector2d corners[4];
    bool empty = true;
  };
  struct Node {
    int index, begin, end;
  };
  struct Query {
    int first, last;
    Eigen::Vector2d a, b;
    double worst = 0;
    std::int64_t looks = 0;
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
    Eigen::Vector2d sum(0, 0);
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
    for (auto i = from; i < to; ++i) {
      const Eigen::Vector2d v = chain_[std::size_t(i)] - origin;
      sum += v;
      moments += v * v.transpose();
    }
    moments -= sum * sum.transpose() / double(to - from);
    const double angle = 0.5 * std::atan2(2 * moments(0, 1), moments(0, 0) - moments(1, 1));
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
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

  double boundOf(const Node& node, Query& query) const {
    double bound = 0;
    const Box& box = boxes_[std::size_t(node.index)];
    if (node.end <= query.first || node.begin > query.last || box.empty) return bound;
    ++query.looks;
    for (const Eigen::Vector2d& corner : box.corners)
      bound = std::max(bound, distanceToSegment(corner, query.a, query.b));
    return bound;
  }

  /// The child that may hold the farther point goes first, so that the other is mostly passed over, to
  /// whichever side the distances grow.
  void search(const Node& node, double bound, Query& query) const {
    if (bound <= query.worst + kRounding) return;
    if (node.end - node.begin <= kLeaf) {
      ++query.looks;
      const int stop = std::min({node.end - 1, query.last, int(chain_.size()) - 1});
      for (int i = std::max(node.begin, query.first); i <= stop; ++i)
        query.worst = std::max(query.worst, distanceToSegment(chain_[std::size_t(i)], query.a, query.b));
      return;
    }
    const int middle = (node.begin + node.end) / 2;
    Node near{2 * node.index, node.begin, middle}, far{2 * node.index + 1, middle, node.end};
    double nearBound = boundOf(near, query), farBound = boundOf(far, query);
    if (nearBound > farBound) {
      std::swap(near, far);
      std::swap(nearBound, farBound);
    }
    search(far, farBound, query);
    search(near, nearBound, query);
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
  const WorkMeter meter = WorkMeter::share(kShare);
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
  for (int i = 0; i < size && !detail::workExhausted(); ++i) offer(i);
  int left = size;
  while (left > 2 && !queue.empty() && !detail::workExhausted()) {
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
  const Points rest = without(std::size_t(std::clamp<std::ptrdiff_t>(drops, 0, std::ssize(drops_))));
  return selectByIndex(rest, closed_, std::min(std::max(count, 2), int(rest.size())));
}

Points TubeOrder::within(double epsilon) {
  find();
  const std::ptrdiff_t most = std::ssize(chain_) - (closed_ ? 3 : 2);
  std::ptrdiff_t drops = 0;
  while (drops < std::min(most, std::ssize(drops_)) && drops_[std::size_t(drops)].cost <= epsilon) ++drops;
  return without(std::size_t(std::max<std::ptrdiff_t>(drops, 0)));
}

}  // namespace bw::biarc
