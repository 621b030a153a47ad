// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How far a hand may go: what is found of it, and when the runner shows that.
#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "bw/model/evaluation_runner.h"
#include "bw/pipeline/reach.h"
#include "bw/pipeline/region.h"
#include "bw/pipeline/sketch.h"
#include "patience.h"
#include "pulled_example.h"
#include "sample_wall.h"

namespace bw::pipeline {
namespace {

using test::designed, test::evaluated, test::pulled;

TEST(Reach, ARegionIsSoughtAllAround) {
  const Design design = test::sampleWall(1, 1, 9, false);
  const auto moved = [&design](const Eigen::Vector2d& by) {
    Design there = design;
    std::vector<Eigen::Vector2d>& points =
        std::get<SectionsSurface>(there.source().surface->shape).sections[1].points;
    points[points.size() / 2] += by;
    return there;
  };
  const std::shared_ptr<const Evaluation> first = evaluated(design);
  RegionSearch search(first, moved);
  EXPECT_TRUE(search.region().rays.empty());
  double known = 0;
  while (search.look({})) {
    double all = 0;
    for (const Region::Ray& ray : search.region().rays) all += ray.free;
    EXPECT_GE(all, known) << "it only grows";
    known = all;
  }
  const std::vector<Region::Ray> rays = search.region().rays;
  ASSERT_EQ(rays.size(), 2 * RegionSearch::kLines);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const double angle = kPi * double(k) / double(RegionSearch::kLines);
    EXPECT_LT((rays[k].way - Eigen::Vector2d(std::cos(angle), std::sin(angle))).norm(), 1e-12);
    EXPECT_GT(rays[k].free, 0);
    EXPECT_TRUE(rays[k].bar != Bar::none || rays[k].free == RegionSearch::kFarthest);
  }
  // As far as along that way alone, but for what it is sought less closely.
  ReachSearch up(
      first,
      [&](double by) {
        return moved({0, by});
      },
      RegionSearch::kFarthest);
  while (up.look({})) {
  }
  for (const std::size_t end : {0, 1}) {
    const double far = std::abs(up.reach().ends[end].free);
    const Region::Ray& ray = rays[RegionSearch::kLines / 2 + (end == 0 ? RegionSearch::kLines : 0)];
    EXPECT_NEAR(ray.free, far, ReachSearch::kWithin + RegionSearch::kWithinShare * far);
    EXPECT_EQ(ray.bar, up.reach().ends[end].bar);
  }
  // Where nothing is to be cut as it is nothing is said.
  Design tight = design;
  tight.blade.length = 500;
  RegionSearch none(first, [&tight](const Eigen::Vector2d&) { return tight; });
  while (none.look({})) {
  }
  EXPECT_TRUE(none.region().rays.empty());
}

TEST(Reach, SketchesComeBeforeTheEvaluationOfADrag) {
  model::EvaluationRunner runner;
  QSignalSpy finished(&runner, &model::EvaluationRunner::finished),
      sketched(&runner, &model::EvaluationRunner::sketched);
  const auto order = [&](double up, bool live) {
    runner.evaluate(std::make_shared<const Design>(pulled(up)), live);
  };
  order(0, false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  EXPECT_EQ(finished.count(), 1);
  EXPECT_FALSE(runner.sketch());
  for (int step = 1; step <= 5; ++step) {
    order(step, true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return sketched.count() == step; }, kPatience));
    ASSERT_TRUE(runner.sketch());
    EXPECT_EQ(runner.sketch()->design, pulled(step));
    EXPECT_EQ(finished.count(), 1) << "while the hand moves nothing else is computed";
  }
  // It rests: all of it follows, in place of the sketch.
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  EXPECT_EQ(finished.count(), 2);
  EXPECT_FALSE(runner.sketch());
  EXPECT_EQ(runner.evaluation()->design.source().surface, pulled(5).source().surface);
  // A design that is not live does without; one that is, and is let go at once, too.
  order(6, true);
  order(7, false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  EXPECT_FALSE(runner.sketch());
  EXPECT_EQ(runner.evaluation()->design.source().surface, pulled(7).source().surface);
  runner.clear();
  EXPECT_FALSE(runner.sketch());
}

/// However long the evaluation of what the hand holds may take, it is known before how far that goes.
TEST(Reach, TheReachOfAHandIsFoundBeforeWhatItHoldsIsEvaluated) {
  model::EvaluationRunner runner;
  runner.evaluate(std::make_shared<const Design>(pulled(0)), false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  constexpr double kFarthest = 400;
  std::optional<Reach> known;
  QObject::connect(&runner, &model::EvaluationRunner::finished, [&] { known = runner.reach(); });
  const auto slowly = [](double by) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return pulled(by);
  };
  runner.seekReach(slowly, kFarthest);
  runner.evaluate(std::make_shared<const Design>(pulled(350)), true);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  ASSERT_TRUE(known);
  EXPECT_EQ(known->now, Bar::none);
  for (const Reach::End& end : known->ends)
    EXPECT_TRUE(end.bar != Bar::none || std::abs(end.free) == kFarthest) << end.free;
}

/// Of a hand that rests between its moves each move stops the evaluation of the one before.
TEST(Reach, IsFoundAlsoWhereAMoveStoppedAnEvaluation) {
  model::EvaluationRunner runner;
  runner.evaluate(std::make_shared<const Design>(pulled(0)), false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  const auto around = [](const Eigen::Vector2d& by) { return pulled(by.y()); };
  for (int move = 1; move <= 6; ++move) {
    runner.evaluate(std::make_shared<const Design>(pulled(move)), true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return runner.sketch() && runner.sketch()->design == pulled(move); },
                                kPatience));
    QTest::qWait(220 + 20 * move);  // its evaluation begins
    // Sought is what an order that is at work does not look for.
    runner.evaluate(std::make_shared<const Design>(pulled(move + 0.5)), true);
    runner.seekReach(pulled, 20);
    runner.seekRegion(around);
    ASSERT_TRUE(QTest::qWaitFor([&] { return runner.reach() && runner.region(); }, kPatience)) << move;
    runner.endReach();
  }
}

/// Looked at are both ways a little, then the one that is wanted, to its end.
TEST(Reach, TheWayThatIsWantedIsLookedAtFirst) {
  constexpr double kFarthest = 400;
  for (const std::size_t wanted : {0, 1}) {
    ReachSearch search(evaluated(pulled(0)), pulled, kFarthest);
    search.aim(wanted == 0 ? -kFarthest : kFarthest);
    const Reach::End& other = search.reach().ends[1 - wanted];
    bool more = search.look({}) && search.look({});
    while (more && search.reach().ends[wanted].bar == Bar::none) {
      EXPECT_EQ(std::abs(other.free), ReachSearch::kNear);
      more = search.look({});
    }
    EXPECT_NE(search.reach().ends[wanted].bar, Bar::none) << "else nothing is asked";
    EXPECT_EQ(other.bar, Bar::none);
    while (search.look({})) {
    }
    EXPECT_GT(std::abs(other.free), ReachSearch::kNear);
  }
}

/// A hand that goes beyond its border at once is shown as far as is known, and led back before it is shown
/// there.
TEST(Reach, AHandIsNotShownBeyondWhatIsKnown) {
  model::EvaluationRunner runner;
  runner.evaluate(std::make_shared<const Design>(pulled(0)), false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  constexpr double kFarthest = 400;
  runner.seekReach(pulled, kFarthest);
  ASSERT_TRUE(QTest::qWaitFor([&] { return runner.reach().has_value(); }, kPatience));
  int shown = 0, beyond = 0;
  const auto heightOf = [](const Design& design) {
    return std::get<PolesSurface>(design.source().surface->shape).at(2, 1).height;
  };
  const double from = heightOf(pulled(0));
  QObject::connect(&runner, &model::EvaluationRunner::sketched, [&] {
    if (!runner.sketch()) return;
    ++shown;
    beyond += heightOf(runner.sketch()->design) - from > runner.reach()->ends[1].free + 1e-9;
  });
  double by = kFarthest;
  QObject::connect(&runner, &model::EvaluationRunner::reached, [&] {
    if (!runner.reach()) return;
    const Reach::End& end = runner.reach()->ends[1];
    const double may = end.bar == Bar::none ? kFarthest : end.free;
    if (std::exchange(by, may) != may) runner.evaluate(std::make_shared<const Design>(pulled(may)), true);
  });
  runner.aimReach(kFarthest);
  runner.evaluate(std::make_shared<const Design>(pulled(kFarthest)), true);
  ASSERT_TRUE(QTest::qWaitFor([&] { return shown > 0 && !runner.busy(); }, kPatience));
  EXPECT_EQ(beyond, 0) << "of " << shown;
  EXPECT_LT(by, kFarthest) << "else nothing is asked";
}

TEST(Reach, AHandThatTakesHoldPutsOffWhatIsAddedToAResult) {
  model::EvaluationRunner runner;
  runner.evaluate(std::make_shared<const Design>(pulled(0)), false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  const auto added = [&] { return runner.evaluation()->cut().lengths.value != nullptr; };
  EXPECT_FALSE(added());
  // Pressed and let go of before that begins.
  runner.seekReach(pulled, 20);
  runner.endReach();
  EXPECT_TRUE(QTest::qWaitFor(added, kPatience));
  // Borders are sure before that comes: with a hand on it both are told of.
  runner.evaluate(std::make_shared<const Design>(pulled(1)), false);
  runner.seekReach(pulled, 20);
  bool addedFirst = false;
  const auto sure = [&] {
    const std::optional<Reach>& reach = runner.reach();
    return reach && reach->knows(-20) && reach->knows(20);
  };
  QObject::connect(&runner, &model::EvaluationRunner::finished,
                   [&] { addedFirst = addedFirst || (added() && !sure()); });
  ASSERT_TRUE(QTest::qWaitFor([&] { return sure() && added(); }, kPatience));
  EXPECT_FALSE(addedFirst);
}

/// Sketches lose on their way what an evaluation finds again: of this block they say that nothing keeps the
/// blades once a pole is some 4 mm up, where every one is certain.
TEST(Reach, ABorderThatAnEvaluationDoesNotBarIsNone) {
  const Design design = test::sampleWall(1, 1, 17);
  const auto pulledBy = [&](double up) { return test::pulledWall(design, up); };
  const auto evaluated = [&](double up) {
    return std::make_shared<const Evaluation>(evaluate(pulledBy(up), nullptr, {}).evaluation);
  };
  const auto barOfEvaluation = [&](double up) {
    const auto there = evaluated(up);
    if (!there->complete()) return Bar::noBlade;
    const std::optional<Sketch> sketch = Sketcher(there).draw(pulledBy(up), {});
    return sketch ? barOf(*sketch) : Bar::noBlade;
  };
  constexpr double kFarthest = 20;
  ReachSearch search(evaluated(0), pulledBy, kFarthest);
  // What is told first is little, and free in truth.
  ASSERT_TRUE(search.look({}) && search.look({}));
  for (const Reach::End& end : search.reach().ends) {
    EXPECT_EQ(std::abs(end.free), ReachSearch::kNear);
    EXPECT_EQ(end.bar, Bar::none);
    EXPECT_EQ(barOfEvaluation(end.free), Bar::none);
    EXPECT_TRUE(search.reach().knows(end.free));
    EXPECT_FALSE(search.reach().knows(4 * end.free));
  }
  EXPECT_LT(search.reach().ends[0].free, search.reach().ends[1].free);
  while (search.look({}) || search.confirm({})) {
  }
  EXPECT_FALSE(search.looking());
  EXPECT_FALSE(search.unsure());
  ASSERT_EQ(search.reach().now, Bar::none);
  for (const Reach::End& end : search.reach().ends) {
    SCOPED_TRACE(end.free);
    EXPECT_EQ(barOfEvaluation(end.free), Bar::none);
    if (end.bar == Bar::none) {
      EXPECT_EQ(std::abs(end.free), kFarthest);
    }
    EXPECT_GT(std::abs(end.free), 4) << "where sketches lost sight of them";
    EXPECT_TRUE(search.reach().knows(std::copysign(kFarthest, end.free)));
  }
  // What is wanted not far beyond a border of sketches takes one evaluation.
  ReachSearch wanted(evaluated(0), pulledBy, kFarthest);
  while (wanted.look({})) {
  }
  ASSERT_TRUE(wanted.unsure());
  const double border = wanted.reach().ends[1].free, aim = border + 2;
  ASSERT_LT(aim, kFarthest);
  EXPECT_FALSE(wanted.reach().knows(aim));
  wanted.aim(aim);
  ASSERT_TRUE(wanted.confirm({}));
  EXPECT_TRUE(wanted.reach().knows(aim));
  EXPECT_GE(wanted.reach().ends[1].free, aim);
}

}  // namespace
}  // namespace bw::pipeline
