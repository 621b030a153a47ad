// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Named versions: the history of a design, and two of its states side by side.
#include <QAbstractItemView>

#include "bw/core/design/design_versions.h"
#include "controls/fields.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class VersionsTest : public WindowTest {
 protected:
  void open(const char* example = "single-block") {
    window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
    ASSERT_TRUE(window().openExample(example));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }
  VersionPanel& panel() { return window().versionPanel(); }
  VersionList& list() { return panel().list(); }
  view::SceneView& now() { return window().sceneView(); }
  view::SceneView& then() { return *window().besideView().other(); }
  view::SceneView& legend() { return *window().besideView().legend(); }

  /// By the key, a name, Enter.
  void nameVersion(const QString& text) {
    QTest::keyClick(&window(), Qt::Key_V, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().name().hasFocus(); }, kPatience));
    QTest::keyClicks(&panel().name(), text);
    QTest::keyClick(&panel().name(), Qt::Key_Return);
    QTest::qWait(0);
  }
  void change(double tolerance) {
    bench().editDesign("Change tolerance", [=](Design& design) { design.process.tolerance = tolerance; });
    ASSERT_TRUE(settle());
  }
  void lower(double by) {
    bench().editSurface("Lower surface", [=](DesignedSurface& surface) {
      for (SurfacePole& pole : std::get<PolesSurface>(surface.shape).poles)
        pole.height = 200 + by * (pole.height - 200);
    });
    ASSERT_TRUE(settle());
  }
  void click(QWidget* widget) {
    ASSERT_TRUE(widget);
    QTest::mouseClick(widget, Qt::LeftButton);
    QTest::qWait(0);
  }
  void click(int line) {
    const QRect place = list().visualItemRect(list().topLevelItem(line));
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, QPoint(20, place.center().y()));
    QTest::qWait(0);
  }
  QPushButton* button(const QString& text) {
    for (QPushButton* b : panel().findChildren<QPushButton*>())
      if (b->text() == text && b->isVisible()) return b;
    return nullptr;
  }
  /// By the keyboard, from the list that a press on the control over the picture opens.
  void compareWith(int index) {
    ChoiceField& field = window().mapBar().comparison();
    QTest::mouseClick(&field, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return field.view()->isVisible(); }, kPatience));
    QTest::keyClick(field.view(), Qt::Key_Home);
    for (int i = 0; i < field.count() && field.view()->currentIndex().row() != index; ++i)
      QTest::keyClick(field.view(), Qt::Key_Down);
    ASSERT_EQ(field.view()->currentIndex().row(), index);
    QTest::keyClick(field.view(), Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !field.view()->isVisible(); }, kPatience));
    QTest::qWait(20);
    ASSERT_TRUE(computed());
  }
  bool computed() {
    return QTest::qWaitFor([&] { return !window().comparison().busy(); }, kPatience) && settle();
  }
  /// What differs is told once the hand rests.
  bool tells(const QString& line) {
    return QTest::qWaitFor([&] { return panel().shownDifferences().contains(line); }, kPatience);
  }
  static bool same(const scene::Camera& a, const scene::Camera& b) {
    return (a.position - b.position).norm() < 1e-6 && (a.focus - b.focus).norm() < 1e-6 &&
           a.parallel == b.parallel;
  }
};

TEST_F(VersionsTest, StatesAreNamedGoneBackToRenamedAndRemoved) {
  ASSERT_NO_FATAL_FAILURE(open());
  const Design before = bench().design();
  ASSERT_NO_FATAL_FAILURE(nameVersion("as ordered"));
  ASSERT_EQ(bench().design().versions.size(), 1u);
  EXPECT_EQ(withoutVersions(bench().design()), before);
  EXPECT_TRUE(panel().name().text().isEmpty());
  EXPECT_EQ(window().focusWidget(), &now()) << "the keyboard belongs to the picture again";
  EXPECT_EQ(list().topLevelItem(0)->text(VersionList::differs), "as now");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  picture("versions-named");

  ASSERT_NO_FATAL_FAILURE(change(0.5));
  EXPECT_TRUE(tells("Tolerance: 2 mm → 0.5 mm")) << panel().shownDifferences().join('\n').toStdString();
  EXPECT_EQ(list().topLevelItem(0)->text(VersionList::differs), "1 difference");
  // A name that is there is refused where it is typed; another is taken.
  ASSERT_NO_FATAL_FAILURE(nameVersion("as ordered"));
  EXPECT_TRUE(panel().name().refused());
  EXPECT_TRUE(panel().name().refusal().contains("already")) << panel().name().refusal().toStdString();
  picture("versions-refused");
  EXPECT_EQ(bench().design().versions.size(), 1u);
  QTest::keyClick(&panel().name(), Qt::Key_Escape);
  QTest::keyClicks(&panel().name(), "finer");
  panel().name().setFocus();
  ASSERT_NO_FATAL_FAILURE(nameVersion("finer"));
  ASSERT_EQ(bench().design().versions.size(), 2u);

  // Back to the first, and undo to where it was.
  ASSERT_NO_FATAL_FAILURE(click(0));
  EXPECT_EQ(list().chosen(), "as ordered");
  ASSERT_NO_FATAL_FAILURE(click(button("Go back")));
  EXPECT_EQ(bench().design().process.tolerance, 2);
  EXPECT_EQ(bench().design().versions.size(), 2u);
  EXPECT_EQ(withoutVersions(bench().design()), before);
  ASSERT_TRUE(settle());
  window().commands()["edit.undo"]->trigger();
  EXPECT_EQ(bench().design().process.tolerance, 0.5);
  EXPECT_EQ(bench().design().versions.size(), 2u);

  // Another name, by F2; one that is taken is told and stays as it was.
  const auto rename = [this](const QString& text) {
    list().setFocus();
    QTest::keyClick(&list(), Qt::Key_F2);
    const QPointer<QLineEdit> editor = list().viewport()->findChild<QLineEdit*>();
    ASSERT_TRUE(editor);
    QTest::keyClick(editor, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(editor, text);
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !editor || !editor->isVisible(); }, kPatience));
    QTest::qWait(20);
  };
  ASSERT_NO_FATAL_FAILURE(rename("as built"));
  EXPECT_EQ(bench().design().versions[0].name, "as built");
  EXPECT_EQ(list().chosen(), "as built");
  ASSERT_NO_FATAL_FAILURE(rename("finer"));
  EXPECT_EQ(bench().design().versions[0].name, "as built");
  EXPECT_EQ(list().topLevelItem(0)->text(VersionList::name), "as built");
  EXPECT_EQ(list().chosen(), "as built") << "not the one whose name it was to have";
  EXPECT_TRUE(window().banner().text().contains("already")) << window().banner().text().toStdString();

  // Taken away by the key, and back by undo.
  list().setCurrentItem(list().topLevelItem(0));
  list().setFocus();
  QTest::keyClick(&list(), Qt::Key_Delete);
  ASSERT_EQ(bench().design().versions.size(), 1u);
  EXPECT_EQ(bench().design().versions[0].name, "finer");
  window().commands()["edit.undo"]->trigger();
  EXPECT_EQ(bench().design().versions.size(), 2u);
  // All of it is in the file.
  ASSERT_TRUE(bench().saveTo(path("versions.bladewright")));
  EXPECT_EQ(loadDesign(path("versions.bladewright")).value().versions, bench().design().versions);
}

TEST_F(VersionsTest, AreNotLostToAnExportInTheirPlace) {
  ASSERT_NO_FATAL_FAILURE(open());
  ASSERT_NO_FATAL_FAILURE(nameVersion("kept"));
  ASSERT_TRUE(settle());
  fs::create_directories(path("out"));
  ASSERT_TRUE(bench().saveTo(path("out") / "design.bladewright"));
  bench().setEarlierQuestion(
      [](const auto&, const auto&, const auto&) { return Workbench::Earlier::replace; });
  bench().exportAll(path("out"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().exporting(); }, kPatience));
  EXPECT_TRUE(window().banner().text().contains("has named versions, which would be lost"))
      << window().banner().text().toStdString();
  EXPECT_EQ(loadDesign(path("out") / "design.bladewright").value().versions.size(), 1u);
  bench().exportAll(path("other"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().exporting(); }, kPatience));
  EXPECT_TRUE(loadDesign(path("other") / "design.bladewright").value().versions.empty());
  // Nor is what is locked.
  window().commands()["edit.undo"]->trigger();
  ASSERT_TRUE(bench().design().versions.empty());
  PartMarks marks;
  marks.locked.cuts = {bench().design().cuts[0].id};
  bench().document().setMarks(marks);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().saveTo(path("out") / "design.bladewright"));
  bench().exportAll(path("out"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().exporting(); }, kPatience));
  EXPECT_TRUE(window().banner().text().contains("hides or locks parts, which would be lost"))
      << window().banner().text().toStdString();
  EXPECT_EQ(loadDesign(path("out") / "design.bladewright").value().marks, marks);
}

TEST_F(VersionsTest, OneStandsBesideThePresentUnderOneLegend) {
  ASSERT_NO_FATAL_FAILURE(open());
  ASSERT_NO_FATAL_FAILURE(nameVersion("deep"));
  ASSERT_NO_FATAL_FAILURE(lower(0.4));
  window().mapBar().chooseField("curvature");
  const auto alone = now().legendRange();
  ASSERT_TRUE(alone);
  const auto shown = bench().shown()->cut().analysis.value;
  ASSERT_NO_FATAL_FAILURE(click(button("Compare")));
  ASSERT_TRUE(computed());
  EXPECT_EQ(bench().shown()->cut().analysis.value, shown) << "the present result stays";
  EXPECT_EQ(window().besideView().nameThen(), "deep");
  EXPECT_TRUE(then().isVisible());
  QTest::qWait(50);
  for (const Eigen::Vector3d& corner : bench().shown()->cut().setup->block.corners())
    EXPECT_TRUE(now().rect().contains(now().toWidget(corner).toPoint())) << "the block is seen whole";
  EXPECT_NEAR(then().width(), now().width(), 1);
  // Two results, one range, one legend.
  ASSERT_TRUE(then().content().first<scene::CutSurface>());
  EXPECT_NE(then().content().first<scene::CutSurface>()->grid.points,
            now().content().first<scene::CutSurface>()->grid.points);
  EXPECT_EQ(then().legendRange(), now().legendRange());
  EXPECT_EQ(then().sceneStyle().rangeMax, now().sceneStyle().rangeMax);
  EXPECT_FALSE(then().sceneStyle().legend);
  EXPECT_FALSE(now().sceneStyle().legend) << "it would cover a part of it";
  EXPECT_TRUE(legend().isVisible());
  EXPECT_TRUE(QRectF(legend().rect()).contains(legend().legendRect())) << "it is seen whole";
  EXPECT_FALSE(legend().legendRect().isEmpty());
  EXPECT_EQ(legend().legendRange(), now().legendRange());
  EXPECT_TRUE(same(then().camera(), now().camera()));
  QTest::qWait(300);
  picture("versions-compared");

  // Turned in one, both turn; by the keys too.
  for (view::SceneView* view : {&now(), &then()}) {
    const scene::Camera before = now().camera();
    const QPoint middle = view->rect().center() + QPoint(0, view->height() / 3);
    QTest::mousePress(view, Qt::LeftButton, {}, middle);
    for (int i = 1; i <= 6; ++i) QTest::mouseMove(view, middle + QPoint(8 * i, 3 * i));
    QTest::mouseRelease(view, Qt::LeftButton, {}, middle + QPoint(48, 18));
    QTest::qWait(50);
    EXPECT_FALSE(same(before, now().camera()));
    EXPECT_TRUE(same(then().camera(), now().camera()));
  }
  window().commands()["view.top"]->trigger();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return now().parallel() && same(then().camera(), now().camera()); }, kPatience));

  // The numbers of both, and what differs.
  const QStringList numbers = panel().shownNumbers();
  ASSERT_EQ(numbers.size(), 6);
  for (const QString& line : numbers) EXPECT_FALSE(line.contains("–")) << line.toStdString();
  EXPECT_TRUE(numbers[3].startsWith("Radius|"));
  EXPECT_NE(numbers[3].section('|', 1, 1), numbers[3].section('|', 2, 2));
  EXPECT_TRUE(numbers[5].startsWith("Foam|0.24 m³|0.24 m³")) << numbers[5].toStdString();
  ASSERT_EQ(panel().shownDifferences().size(), 1);
  EXPECT_TRUE(panel().shownDifferences()[0].contains("values differ"));

  // A range that the person chose is that of both.
  scene::Style style = window().mapBar().style();
  style.rangeMin = 0.0;
  style.rangeMax = 0.5;
  window().mapBar().setStyle(style);
  emit window().mapBar().styleEdited(style);
  EXPECT_EQ(now().sceneStyle().rangeMax, 0.5);
  EXPECT_EQ(then().sceneStyle().rangeMax, 0.5);
  window().mapBar().chooseField("deviation");
  EXPECT_EQ(then().sceneStyle()[scene::Kind::cut].map, "deviation");
  EXPECT_EQ(then().legendRange(), now().legendRange());

  // The present goes on while it stands; another name is followed; the end of the version is that of it.
  ASSERT_NO_FATAL_FAILURE(change(1));
  EXPECT_TRUE(bench().current());
  bench().editDesign("Rename",
                     [](Design& design) { design = *withVersionRenamed(design, "deep", "deeper"); });
  EXPECT_EQ(window().besideView().nameThen(), "deeper");
  EXPECT_EQ(window().mapBar().comparison().currentText(), "deeper");
  bench().editDesign("Remove", [](Design& design) { design = *withoutVersion(design, "deeper"); });
  EXPECT_EQ(window().comparison().beside(), Beside{});
  EXPECT_FALSE(then().isVisible());
  EXPECT_FALSE(legend().isVisible());
  EXPECT_TRUE(now().sceneStyle().legend) << "alone it has its own again";
  EXPECT_EQ(window().mapBar().comparison().currentIndex(), 0);
  // Another design begins without.
  ASSERT_NO_FATAL_FAILURE(compareWith(1));
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  EXPECT_EQ(window().comparison().beside(), Beside{});
}

TEST_F(VersionsTest, TheTargetStandsBesideTheCut) {
  ASSERT_NO_FATAL_FAILURE(open());
  ASSERT_NO_FATAL_FAILURE(compareWith(1));
  EXPECT_EQ(window().besideView().nameThen(), "Target");
  EXPECT_EQ(window().besideView().nameNow(), "Cut");
  EXPECT_TRUE(then().content().first<TriangleMesh>());
  EXPECT_FALSE(then().content().first<scene::CutSurface>());
  EXPECT_TRUE(then().sceneStyle()[scene::Kind::target].visible);
  EXPECT_FALSE(now().sceneStyle()[scene::Kind::target].visible);
  EXPECT_TRUE(window().mapBar().style()[scene::Kind::target].visible) << "the choice of layers stays";
  QTest::qWait(300);
  picture("target-beside-cut");
  // It follows what is changed.
  const auto heights = [this] { return then().content().first<TriangleMesh>()->points; };
  const auto before = heights();
  ASSERT_NO_FATAL_FAILURE(lower(0.5));
  EXPECT_NE(heights(), before);
  ASSERT_NO_FATAL_FAILURE(compareWith(0));
  EXPECT_FALSE(then().isVisible());
  EXPECT_TRUE(now().sceneStyle()[scene::Kind::target].visible);
}

TEST_F(VersionsTest, TheLastChangeIsSeenBesideWhatWasBefore) {
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_FALSE(window().commands()["compare.before"]->isEnabled()) << "nothing was changed yet";
  ASSERT_NO_FATAL_FAILURE(nameVersion("start"));
  EXPECT_FALSE(window().commands()["compare.before"]->isEnabled()) << "a name changes nothing";
  const auto first = bench().shown();
  ASSERT_NO_FATAL_FAILURE(lower(0.5));
  ASSERT_TRUE(window().commands()["compare.before"]->isEnabled());
  window().commands()["compare.before"]->trigger();
  ASSERT_TRUE(computed());
  EXPECT_TRUE(window().commands()["compare.before"]->isChecked());
  const auto cut = [](const scene::Content& content) {
    return content.first<scene::CutSurface>()->grid.points;
  };
  EXPECT_EQ(cut(then().content()), first->result()->analysis.cut.points) << "the same as it was then";
  const auto between = cut(now().content());
  ASSERT_NO_FATAL_FAILURE(lower(0.5));
  ASSERT_TRUE(computed());
  EXPECT_EQ(cut(then().content()), between);
  picture("last-change");
  window().commands()["edit.undo"]->trigger();
  ASSERT_TRUE(settle());
  ASSERT_TRUE(computed());
  EXPECT_EQ(cut(then().content()), first->result()->analysis.cut.points);
  window().commands()["edit.undo"]->trigger();
  ASSERT_TRUE(settle());
  EXPECT_EQ(window().comparison().beside(), Beside{}) << "there is no change before";
}

TEST_F(VersionsTest, OneWithoutAResultSaysSo) {
  ASSERT_NO_FATAL_FAILURE(open());
  const Design before = bench().design();
  Design missed = before;
  missed.block().placement->origin += Eigen::Vector3d(5000, 0, 0);
  bench().editDesign("Prepare", [&](Design& design) {
    design.versions.push_back({"missed", std::make_shared<const Design>(missed)});
  });
  ASSERT_TRUE(settle());
  ASSERT_NO_FATAL_FAILURE(compareWith(3));
  EXPECT_TRUE(window().comparison().error());
  EXPECT_EQ(window().besideView().nameThen(), "missed: without a result");
  EXPECT_TRUE(now().legendRange());
  window().commands()["tab.versions"]->trigger();
  QTest::qWait(200);
  picture("versions-no-result");
  EXPECT_TRUE(bench().current());
  ASSERT_NO_FATAL_FAILURE(click(button("Compare")));
  EXPECT_EQ(window().comparison().beside(), Beside{});
}

TEST_F(VersionsTest, TheSmallestWindowHasRoomForBoth) {
  makeWindow({960, 600});
  ASSERT_NO_FATAL_FAILURE(open());
  ASSERT_NO_FATAL_FAILURE(nameVersion("as it was ordered by the client in the first place"));
  ASSERT_NO_FATAL_FAILURE(lower(0.5));
  window().commands()["compare.version"]->trigger();
  ASSERT_TRUE(computed());
  QTest::qWait(300);
  EXPECT_EQ(window().size(), QSize(960, 600));
  EXPECT_GE(then().width(), 160);
  EXPECT_GE(now().width(), 160);
  EXPECT_FALSE(legend().isVisible()) << "there is no room for it beside both";
  picture("versions-small");
}

}  // namespace
}  // namespace bw::app
