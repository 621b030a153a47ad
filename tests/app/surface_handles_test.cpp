// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A designed surface in the hand: its poles are pulled with the mouse in the 3D view.

#include "window/surface_handles.h"

#include "bw/core/constructions/spline_constructions.h"
#include "handles_fixture.h"
#include "workflow/export_blocks.h"

namespace bw::app {
namespace {

class SurfaceHandlesTest : public HandlesTest {
 protected:
  double height(int row, int column) {
    return std::get<PolesSurface>(bench().design().source().surface->shape).at(row, column).height;
  }
  /// Waits until what follows the hand is the design of now.
  bool followed() {
    return QTest::qWaitFor([&] { return bench().sketch() && bench().sketch()->design == bench().design(); },
                           kPatience);
  }

  static constexpr int kPole = 2 * 4 + 1;  // pole 2 of row 3
};

TEST_F(SurfaceHandlesTest, APoleThatIsPulledTakesSurfaceBladesAndNumbersWithIt) {
  open("single-block");
  ASSERT_EQ(handles().points.size(), 24u);
  const double before = height(2, 1);
  const QPoint from = hover(kPole);
  picture("handle-hovered");
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  for (int i = 1; i <= 10; ++i) {
    QTest::mouseMove(&view(), from - QPoint(0, 3 * i));
    QTest::qWait(5);
  }
  EXPECT_GT(height(2, 1), before + 5);
  EXPECT_EQ(height(2, 1), std::round(height(2, 1))) << "whole mm";
  ASSERT_TRUE(followed());
  EXPECT_FALSE(bench().stale());
  EXPECT_NE(bench().row(), nullptr);
  EXPECT_EQ(standingOf(bench(), bench().block().id).word, "being changed") << "not all limits are known";
  // What is drawn is the sketch: its surface, its blades.
  const auto* cut = view().content().first<scene::CutSurface>();
  ASSERT_TRUE(cut && bench().sketchedCut());
  EXPECT_EQ(cut->grid.points, bench().sketchedCut()->look->cut.points);
  // The numbers, too: those of the result that is gone would be pale.
  const auto number = [&](const QString& name) {
    for (const ValueLabel* label : window().inspector().findChildren<ValueLabel*>())
      if (label->accessibleName() == name && label->isVisible()) return label->text();
    return QString();
  };
  EXPECT_EQ(number("Surface shown"), lengthText(bench().sketchedCut()->look->deviationMax));
  EXPECT_EQ(number("Smallest radius"), radiusText(bench().sketchedCut()->look->minRadius));
  // The hand rests: all of it is there, and how far it may go on.
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return !handles().ways.empty() && (handles().ways[0].endsAtFrom || handles().ways[0].endsAtTo); },
      kPatience));
  picture("handle-pulled");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 30));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_FALSE(bench().sketch());
  EXPECT_EQ(standingOf(bench(), bench().block().id).word, "certain");
  EXPECT_EQ(view().content().first<scene::CutSurface>()->grid.points, bench().sweep()->analysis.cut.points);
  picture("handle-released");
  // One step back for the whole pull.
  bench().document().undoStack().undo();
  EXPECT_EQ(height(2, 1), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
}

TEST_F(SurfaceHandlesTest, BlocksTellWhatIsWrongAsTheHandHasThem) {
  open("three-block-wall");
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 1e-4; });
  ASSERT_TRUE(settle());
  const auto places = handles().points;
  const auto left = std::ranges::min_element(places, {}, [](const Eigen::Vector3d& p) { return p.x(); });
  const QPoint from = hover(int(left - places.begin()));
  const Design before = bench().design();
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  for (int i = 1; i <= 3; ++i) QTest::mouseMove(&view(), from - QPoint(0, 3 * i));
  // At first it is shown as far as it is known to be free, which is where it was.
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return bench().sketch() && bench().sketch()->design != before; }, kPatience));
  // Nothing is within so little, and grips give way for it.
  const BlockStanding standing = standingOf(bench(), bench().shown()->blocks[0].id);
  EXPECT_STREQ(standing.icon, "error");
  EXPECT_TRUE(standing.word.startsWith("off by ") || standing.word.startsWith("grip at "))
      << standing.word.toStdString();
  picture("blocks-while-pulled");
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from);
}

TEST_F(SurfaceHandlesTest, ThePageOfABlockGivesWayToThatOfAHandle) {
  open("single-block");
  bench().select({Selection::Kind::block, -1});
  QTest::mouseClick(&view(), Qt::LeftButton, {}, hover(kPole));
  EXPECT_EQ(bench().selection().kind, Selection::Kind::surface);
  // Numbers of the result are watched meanwhile.
  bench().select({Selection::Kind::result, -1});
  QTest::mouseClick(&view(), Qt::LeftButton, {}, hover(kPole + 1));
  EXPECT_EQ(bench().selection().kind, Selection::Kind::result);
}

TEST_F(SurfaceHandlesTest, TheSectionIsThatOfTheHandle) {
  open("single-block");
  const auto beside = [&](int handle) {
    const double y = handles().points[std::size_t(handle)].y();
    const auto& poses = bench().sweep()->sweep.poses;
    return int(std::ranges::min_element(
                   poses, {}, [&](const BladePose& pose) { return std::abs(pose.frame.origin.y() - y); }) -
               poses.begin());
  };
  const int station = beside(kPole);
  ASSERT_GT(station, 5);
  ASSERT_LT(bench().selection().station, 0);
  ASSERT_EQ(window().sectionView().shownStation(), 0);
  const QPoint from = hover(kPole);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  EXPECT_EQ(window().sectionView().shownStation(), station);
  EXPECT_LT(bench().selection().station, 0) << "what was selected stays so";
  EXPECT_FALSE(bench().moving());
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view(), from - QPoint(0, 3 * i));
  ASSERT_TRUE(followed());
  EXPECT_EQ(window().sectionView().shownStation(), station);
  picture("handle-and-its-section");
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from);
  ASSERT_TRUE(settle());
  // Where a station is selected, that goes along.
  bench().selectStation(2);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, hover(kPole + 4));
  EXPECT_EQ(bench().selection().station, beside(kPole + 4));
}

TEST_F(SurfaceHandlesTest, TheSectionIsThatOfTheBlockBesideTheHandle) {
  open("three-block-wall");
  ASSERT_EQ(bench().shown()->blocks.size(), 3u);
  const std::string first = bench().selection().cut;
  // Of the points of a section, which lie on the boundaries.
  const auto places = handles().points;
  const auto [left, right] =
      std::ranges::minmax_element(places, {}, [](const Eigen::Vector3d& p) { return p.x(); });
  const auto expectCut = [&](int handle, std::size_t block) {
    const pipeline::BlockEvaluation& beside = bench().shown()->blocks[block];
    QTest::mousePress(&view(), Qt::LeftButton, {}, hover(handle));
    EXPECT_EQ(bench().selection().cut, beside.cuts[0].id);
    EXPECT_EQ(bench().selection().block, beside.id);
    const QPoint from = at(handle);
    for (int i = 1; i <= 3; ++i) QTest::mouseMove(&view(), from - QPoint(0, 3 * i));
    ASSERT_TRUE(followed());
    EXPECT_TRUE(bench().sketchedCut());
    QTest::keyClick(&view(), Qt::Key_Escape);
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, from);
    ASSERT_TRUE(settle());
  };
  expectCut(int(right - places.begin()), 2);
  expectCut(int(left - places.begin()), 0);
  EXPECT_EQ(bench().selection().cut, first);
  // Between two that of the one selected stays.
  const Box& lies = bench().shown()->blocks[0].cuts[0].block();
  const auto between = std::ranges::find_if(places, [&](const Eigen::Vector3d& p) {
    return std::abs(lies.frame.toLocal(p).x() - lies.size.x()) < 1e-6;
  });
  ASSERT_NE(between, places.end());
  expectCut(int(between - places.begin()), 0);
}

TEST_F(SurfaceHandlesTest, AKeyBladeIsPulledByItsMiddle) {
  open("key-blade-fan");
  ASSERT_EQ(handles().points.size(), 12u) << "middles, and the ends of each";
  const auto blade = [&](std::size_t i) {
    return std::get<BladesSurface>(bench().design().source().surface->shape).blades[i];
  };
  const KeyBlade before = blade(1);
  const QPoint from = at(1);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view(), from - QPoint(0, 2 * i));
  EXPECT_GT(blade(1).middle.y(), before.middle.y() + 2);
  EXPECT_EQ(blade(1).middle.x(), before.middle.x());
  EXPECT_EQ(handles().text.find("Middle of key blade 2: "), 0u) << handles().text;
  ASSERT_TRUE(followed());
  EXPECT_NE(bench().row(), nullptr);
  picture("handle-key-blade");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 10));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  bench().document().undoStack().undo();
  EXPECT_EQ(blade(1), before);
}

TEST_F(SurfaceHandlesTest, NothingIsWrittenOfWhatAHandHolds) {
  open("single-block");
  int asked = 0;
  window().questions().exportFolder = [&] {
    ++asked;
    return QString();
  };
  const QPoint from = at(0);
  ASSERT_EQ(view().handleAt(from), 0);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  for (int i = 1; i <= 4; ++i) QTest::mouseMove(&view(), from - QPoint(0, 3 * i));
  ASSERT_TRUE(view().holding());
  window().commands()["file.export"]->trigger();
  EXPECT_EQ(asked, 0);
  EXPECT_TRUE(window().banner().text().contains("Let go")) << window().banner().text().toStdString();
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 12));
  window().commands()["file.export"]->trigger();
  EXPECT_EQ(asked, 1);
  ASSERT_TRUE(settle());
}

TEST_F(SurfaceHandlesTest, AnEndOfAKeyBladeTurnsItAboutTheOther) {
  open("key-blade-fan");
  const auto blade = [&](std::size_t i) {
    return std::get<BladesSurface>(bench().design().source().surface->shape).blades[i];
  };
  const KeyBlade before = blade(1);
  constexpr int kRight = 4 + 2 * 1 + 1;
  const Eigen::Vector3d left = handles().points[kRight - 1], right = handles().points[kRight];
  const QPoint from = at(kRight);
  ASSERT_EQ(view().handleAt(from), kRight);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view(), from - QPoint(0, 2 * i));
  EXPECT_EQ(handles().text.find("+x end of key blade 2: "), 0u) << handles().text;
  const double height = handles().points[kRight].z();
  EXPECT_GT(height, right.z() + 2);
  EXPECT_NEAR(height, std::round(height), 1e-6) << "whole mm";
  EXPECT_NEAR((handles().points[kRight - 1] - left).norm(), 0, 1e-6) << "the other end stays";
  EXPECT_NEAR((handles().points[kRight] - left).norm(), (right - left).norm(), 1e-6) << "the blade, too";
  EXPECT_GT(blade(1).angle, before.angle);
  EXPECT_EQ(blade(1).length, before.length);
  EXPECT_EQ(blade(1).bend, before.bend);
  EXPECT_EQ(blade(1).force, before.force);
  ASSERT_TRUE(followed());
  picture("handle-key-blade-end");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 10));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  bench().document().undoStack().undo();
  EXPECT_EQ(blade(1), before);
  // With its mirror image both ends rise by as much, and so does the middle alone.
  window().commands()["handles.symmetric"]->trigger();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at(kRight));
  const double whole = std::floor(right.z() + 1e-6) + 1;
  QTest::keyClick(&view(), Qt::Key_Up);
  EXPECT_NEAR(handles().points[kRight].z(), whole, 1e-6);
  EXPECT_NEAR(handles().points[kRight - 1].z() - left.z(), whole - right.z(), 1e-6);
  EXPECT_NEAR(blade(1).middle.y() - before.middle.y(), whole - right.z(), 0.05);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(blade(1), before);
  // A key blade more and less, from its menu.
  const std::size_t bound = bench().design().bindings.size();
  window().commands()["handles.addSection"]->trigger();
  EXPECT_EQ(handles().points.size(), 15u);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Add key blade");
  EXPECT_EQ(bench().design().bindings.size(), bound) << "the expressions of the others stay";
  EXPECT_EQ(handles().chosen, std::vector<int>{2}) << "the new one is chosen";
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("handle-key-blade-added");
  EXPECT_EQ(window().commands()["handles.removeSection"]->text(), "&Remove key blade");
  window().commands()["handles.removeSection"]->trigger();
  EXPECT_EQ(handles().points.size(), 12u);
  EXPECT_EQ(bench().design().bindings.size(), bound);
}

TEST_F(SurfaceHandlesTest, AJointOfCubicsTakesItsLegsWithIt) {
  open("three-block-wall");
  Design chain = bench().design();
  auto& sections = std::get<SectionsSurface>(chain.source().surface->shape).sections;
  for (SectionCurve& section : sections) {
    std::vector<Eigen::Vector2d> poles = {section.points.front()};
    const std::vector<CubicPoles> cubics = bezierChain(section.points).value();
    for (const CubicPoles& cubic : cubics) poles.insert(poles.end(), cubic.begin() + 1, cubic.end());
    section = {section.y, SectionCurve::Kind::bezier, poles};
  }
  bench().editDesign("Chains", [&](Design& design) { design = chain; });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  ASSERT_EQ(handles().points.size(), 30u);
  const QPoint from = at(3);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  QTest::mouseMove(&view(), from - QPoint(0, 8));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 8));
  const auto& now = std::get<SectionsSurface>(bench().design().source().surface->shape).sections[0].points;
  const double up = now[3].y() - sections[0].points[3].y();
  EXPECT_GT(up, 2);
  for (const std::size_t leg : {2, 4}) EXPECT_NEAR(now[leg].y() - sections[0].points[leg].y(), up, 1e-9);
  EXPECT_EQ(now[1], sections[0].points[1]);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << "no kink is left";
}

TEST_F(SurfaceHandlesTest, AHandleStopsWhereItsBladesEndAndSaysWhy) {
  open("single-block");
  const QPoint from = at(kPole);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  const auto& reach = bench().runner().reach();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return reach && reach->ends[1].bar != pipeline::Bar::none && reach->ends[0].free < -10; },
      kPatience));
  // Far beyond what any blade can do.
  QTest::mouseMove(&view(), from - QPoint(0, 200));
  ASSERT_TRUE(QTest::qWaitFor([&] { return handles().stopped; }, kPatience));
  QTest::qWait(600);  // the border is found ever more closely
  picture("handle-stopped");
  EXPECT_NE(handles().text.find("Goes no farther"), std::string::npos) << handles().text;
  // Until an evaluation has told it, the reason is not told as one that is known.
  const auto closer = [&] {
    return handles().text.find("being looked at more closely") != std::string::npos;
  };
  EXPECT_TRUE(QTest::qWaitFor([&] { return reach->ends[1].known == !closer(); }, 100));
  ASSERT_TRUE(QTest::qWaitFor([&] { return reach->ends[1].known && !closer(); }, kPatience));
  EXPECT_NE(handles().text.find("Goes no farther"), std::string::npos) << handles().text;
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 200));
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().sweep());
  // What it stopped at can be cut.
  for (const Rest rest : bench().sweep()->rest.stations) EXPECT_NE(rest, Rest::lost);
  EXPECT_LE(bench().sweep()->analysis.summary.deviationMax, bench().design().process.tolerance);
  EXPECT_GE(bench().sweep()->analysis.summary.minRadius, bench().design().blade.minRadius());
}

TEST_F(SurfaceHandlesTest, WhereAPointMayGoInItsPlaneIsShadedAroundIt) {
  open("three-block-wall");
  ASSERT_TRUE(lookFromFront());
  constexpr int kPoint = 3;
  const Design before = bench().design();
  const QPoint from = at(kPoint), to = from + QPoint(14, -10);
  ASSERT_EQ(view().handleAt(from), kPoint);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  EXPECT_TRUE(handles().region.corners.empty()) << "it has not moved";
  QTest::mouseMove(&view(), from + QPoint(8, -6));
  QTest::mouseMove(&view(), to);
  ASSERT_NE(bench().design(), before) << "the point is in the hand";
  const auto& region = bench().runner().region();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return region && region->rays.size() == 2 * pipeline::RegionSearch::kLines; }, kPatience));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return std::ranges::any_of(handles().region.ends, [](char ends) { return ends != 0; }); },
      kPatience));
  picture("handle-region");
  // All of it lies in the plane of the section, around where the point was.
  const scene::HandleRegion shown = handles().region;
  ASSERT_EQ(shown.corners.size(), region->rays.size());
  ASSERT_EQ(shown.ends.size(), shown.corners.size());
  const double y = handles().points[kPoint].y();
  for (const Eigen::Vector3d& corner : shown.corners) EXPECT_NEAR(corner.y(), y, 1e-9);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(handles().region.corners.empty());
}

TEST_F(SurfaceHandlesTest, AHandleLetGoOfBeforeItsBorderIsKnownGoesBackToIt) {
  open("single-block");
  const Design before = bench().design();
  const double from = height(2, 1);
  const QPoint place = at(kPole);
  // Pressed, pulled far beyond what any blade can do and let go of at once.
  const auto throwUp = [&] {
    QTest::mousePress(&view(), Qt::LeftButton, {}, place);
    QTest::mouseMove(&view(), place - QPoint(0, 200));
    ASSERT_FALSE(bench().runner().reach() && bench().runner().reach()->knows(400)) << "not yet known";
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, place - QPoint(0, 200));
  };
  throwUp();
  const double thrown = height(2, 1);
  ASSERT_GT(thrown, from + 50);
  ASSERT_TRUE(QTest::qWaitFor([&] { return height(2, 1) < thrown && settle(); }, kPatience));
  EXPECT_GT(height(2, 1), from + 1);
  EXPECT_EQ(height(2, 1), std::round(height(2, 1))) << "whole mm";
  // Told as soon as its border is sure.
  picture("handle-goes-back");
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().statusBar()->currentMessage().contains(" went back: "); },
                              kPatience));
  picture("handle-went-back");
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  for (const Rest rest : bench().sweep()->rest.stations) EXPECT_NE(rest, Rest::lost);
  EXPECT_LE(bench().sweep()->analysis.summary.deviationMax, bench().design().process.tolerance);
  EXPECT_GE(bench().sweep()->analysis.summary.minRadius, bench().design().blade.minRadius());
  // The way there and back is one step.
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
  ASSERT_TRUE(settle());
  // What is done before it goes back stands.
  throwUp();
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  QTest::qWait(300);
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().runner().busy());
  throwUp();
  QTest::keyClick(&view(), Qt::Key_Up);
  EXPECT_EQ(bench().document().undoStack().count(), 2) << "the key moves on its own";
}

TEST_F(SurfaceHandlesTest, AHandleThatWentBackNeverLeapsToWhereTheHandWas) {
  open("three-block-wall");
  constexpr std::size_t kSection = 1, kPlace = 2;
  const auto up = [this] {
    return std::get<SectionsSurface>(bench().design().source().surface->shape)
        .sections[kSection]
        .points[kPlace]
        .y();
  };
  const int handle = 4 * int(kSection) + int(kPlace);
  const double from = up();
  const QPoint place = at(handle);
  QTest::mousePress(&view(), Qt::LeftButton, {}, place);
  QTest::mouseMove(&view(), place - QPoint(0, 60));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, place - QPoint(0, 60));
  const double thrown = up();
  ASSERT_GT(thrown, from + 60);
  ASSERT_TRUE(QTest::qWaitFor([&] { return up() < thrown; }, kPatience));
  double highest = 0;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        highest = std::max(highest, up());
        return window().statusBar()->currentMessage().contains(" went back: ");
      },
      kPatience));
  EXPECT_LT(highest, thrown);
  EXPECT_GE(up(), from);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  // Where it came to rest nothing is lost, at the stations or between them.
  for (const Finding& finding : bench().shown()->findings()) {
    EXPECT_TRUE(finding.severity != Severity::error) << words::sentence(finding, words::Reader::window);
  }
}

TEST_F(SurfaceHandlesTest, SeveralStopWhereTheirCommonWayEnds) {
  open("single-block");
  const int other = 3 * 4 + 2;
  const auto border = [&](const std::vector<int>& moved) {
    pipeline::ReachSearch search(
        bench().shown(),
        [design = bench().design(), moved](double by) {
          Design pulled = design;
          for (const int pole : moved)
            std::get<PolesSurface>(pulled.source().surface->shape).poles[std::size_t(pole)].height += by;
          return pulled;
        },
        400);
    while (search.look({})) {
    }
    return search.reach().ends[1].free;
  };
  const double alone = border({other}), together = border({kPole, other});
  ASSERT_GT(std::abs(alone - together), 2) << "one of them has another way";
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at(kPole));
  const QPoint from = at(other);
  // Beyond the border of both, wherever that is seen.
  const Eigen::Vector3d beyond = handles().points[std::size_t(other)] + Eigen::Vector3d(0, 0, together + 50);
  const QPoint to = view().toWidget(beyond).toPoint();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::ShiftModifier, from);
  QTest::mouseMove(&view(), to);
  const auto& reach = bench().runner().reach();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return handles().stopped && reach && std::abs(reach->ends[1].free - together) < 0.6; },
      kPatience))
      << (reach ? reach->ends[1].free : -1) << " of " << together << ", alone " << alone;
  EXPECT_EQ(handles().ways.size(), 2u) << "of each";
  EXPECT_NE(handles().text.find("2 handles together: "), std::string::npos) << handles().text;
  picture("handles-stopped-together");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_LE(bench().sweep()->analysis.summary.deviationMax, bench().design().process.tolerance);
}

TEST_F(SurfaceHandlesTest, EscapeGivesAPullUp) {
  open("single-block");
  const Design before = bench().design();
  const QPoint from = at(kPole);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  QTest::mouseMove(&view(), from - QPoint(0, 40));
  EXPECT_NE(bench().design(), before);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(view().holding());
  // The hand may go on: nothing hangs on it.
  QTest::mouseMove(&view(), from - QPoint(0, 80));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 80));
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  const auto* cut = view().content().first<scene::CutSurface>();
  ASSERT_TRUE(cut && bench().sweep());
  EXPECT_EQ(cut->grid.points, bench().sweep()->analysis.cut.points) << "no sketch stays behind";
}

TEST_F(SurfaceHandlesTest, SeveralPolesMoveTogetherFineAndCoarse) {
  open("single-block");
  const double a = height(2, 1), b = height(3, 2);
  const int other = 3 * 4 + 2;
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at(kPole));
  QTest::mousePress(&view(), Qt::LeftButton, Qt::ShiftModifier, at(other));
  const QPoint from = at(other);
  QTest::mouseMove(&view(), from);
  QMouseEvent coarse(QEvent::MouseMove, from - QPoint(0, 25), view().mapToGlobal(from - QPoint(0, 25)),
                     Qt::NoButton, Qt::LeftButton, Qt::ShiftModifier);
  QApplication::sendEvent(&view(), &coarse);
  EXPECT_GT(height(3, 2), b);
  EXPECT_NEAR(std::remainder(height(3, 2), 10), 0, 1e-9);
  EXPECT_NEAR(height(3, 2) - b, height(2, 1) - a, 1e-9) << "by as much";
  QMouseEvent fine(QEvent::MouseMove, from - QPoint(0, 25), view().mapToGlobal(from - QPoint(0, 25)),
                   Qt::NoButton, Qt::LeftButton, Qt::ControlModifier);
  const double coarsely = height(3, 2) - b;
  QApplication::sendEvent(&view(), &fine);
  EXPECT_LT(height(3, 2) - b, 0.3 * coarsely);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from);
  ASSERT_TRUE(settle());
}

TEST_F(SurfaceHandlesTest, AnotherDesignBeginsWithNoneChosenAndAMapOfItsOwn) {
  open("two-crossing-cuts");
  window().commands()["map.crease"]->trigger();
  ASSERT_EQ(view().sceneStyle()[scene::Kind::cut].map, "crease");
  open("single-block");
  EXPECT_EQ(view().sceneStyle()[scene::Kind::cut].map, "deviation") << "it has no crease";
  window().commands()["map.angle"]->trigger();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, hover(kPole));
  ASSERT_FALSE(window().surfaceHandles().chosen().empty());
  open("bump");
  EXPECT_TRUE(window().surfaceHandles().chosen().empty());
  EXPECT_EQ(view().sceneStyle()[scene::Kind::cut].map, "angle") << "the map of all stays";
}

TEST_F(SurfaceHandlesTest, AreThereForWhatIsDesignedOnly) {
  window().openExample("saddle");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(handles().points.empty());
  EXPECT_TRUE(window().commands()["view.handles"]->isEnabled()) << "for those of the block";
  open("twist");
  EXPECT_EQ(handles().points.empty(), !window().surfaceHandles().possible());
  open("single-block");
  window().commands()["view.handles"]->trigger();
  EXPECT_TRUE(handles().points.empty());
  // What was a handle turns the view again.
  const Eigen::Vector3d eye = view().camera().position;
  const Design before = bench().design();
  const QPoint from = view().rect().center();
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  QTest::mouseMove(&view(), from + QPoint(60, 20));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from + QPoint(60, 20));
  EXPECT_NE(view().camera().position, eye);
  EXPECT_EQ(bench().design(), before);
}

}  // namespace
}  // namespace bw::app
