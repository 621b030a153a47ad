// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The CAD file of an open design: replaced, read again, moved away, changed by others.
#include "window_fixture.h"

namespace bw::app {
namespace {

class SourceFile : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    ASSERT_TRUE(writeFile(source(), geometry::exampleStep("saddle").value()));
    window().openFile(QString::fromStdString(source().string()));
    bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 17; });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  fs::path source() const { return path("roof.step"); }

  double width() { return bench().shown()->cut().target.value->bounds().size().maxCoeff(); }

  /// As a CAD program saves: another file renamed over the old one.
  void saveByRename(const std::string& bytes) {
    ASSERT_TRUE(writeFile(path("roof.step.tmp"), bytes));
    fs::rename(path("roof.step.tmp"), source());
  }

  bool told(const QString& word) {
    return QTest::qWaitFor(
        [&] { return window().banner().isVisible() && window().banner().text().contains(word); }, kPatience);
  }

  std::string banner() { return window().banner().text().toStdString(); }

  /// All that the labels of the workflow say.
  QString facts() {
    QString all;
    for (const QLabel* label : window().workflow().findChildren<QLabel*>())
      if (label->isVisible()) all += label->text() + "\n";
    return all;
  }

  QLabel* labelWith(const QString& words) {
    for (QLabel* label : window().workflow().findChildren<QLabel*>())
      if (label->isVisible() && label->text().contains(words)) return label;
    return nullptr;
  }

  QCheckBox* followBox() { return window().findChild<QCheckBox*>("followFile"); }

  QPushButton* inputButton(const QString& text) {
    for (QPushButton* b : window().workflow().findChildren<QPushButton*>())
      if (b->text() == text) return b;
    return nullptr;
  }
};

TEST_F(SourceFile, IsReplacedUnderTheSameSettings) {
  const double before = width();
  const fs::path other = path("other.step");
  ASSERT_TRUE(writeFile(other, geometry::exampleStep("panel-600x670").value()));
  window().questions().openSurface = [&] { return QString::fromStdString(other.string()); };
  QPushButton* replace = inputButton("Replace…");
  ASSERT_TRUE(replace && replace->isEnabled());
  window().workflow().ensureWidgetVisible(replace);
  picture("replace-surface");
  QTest::mouseClick(replace, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().document().design()->source().path, other);
  EXPECT_EQ(bench().design().cut().sections.stations, 17);
  EXPECT_NE(width(), before);
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo replace surface");
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(width(), before);
  bench().document().undoStack().undo();
  EXPECT_NE(bench().design().cut().sections.stations, 17) << "the history before was lost";
}

TEST_F(SourceFile, ThatChangesIsNoticedAndReloaded) {
  bench().setFollowsFile(false);
  const double before = width();
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("roof.step has changed on disk"));
  picture("source-changed");
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_NE(width(), before);
  EXPECT_EQ(bench().design().cut().sections.stations, 17);
  EXPECT_FALSE(window().banner().isVisible());
  EXPECT_EQ(bench().document().undoStack().count(), 1);
  // Again, written in place this time.
  std::ofstream(source()) << geometry::exampleStep("saddle").value();
  ASSERT_TRUE(told("roof.step has changed on disk"));
  // An edit reads it too: the notice no longer holds.
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 18; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(width(), before);
  EXPECT_FALSE(window().banner().isVisible());
}

TEST_F(SourceFile, ThatChangedIsReadWhereItIsChosenOnceMore) {
  bench().setFollowsFile(false);
  const double before = width();
  window().questions().openSurface = [&] { return QString::fromStdString(source().string()); };
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("roof.step has changed on disk"));
  QTest::mouseClick(inputButton("Replace…"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_NE(width(), before) << "the warning went, the old surface stayed";
  EXPECT_FALSE(window().banner().isVisible());
  EXPECT_EQ(bench().document().undoStack().count(), 1) << "the design is the same";
}

TEST_F(SourceFile, ThatChangesIsReadAgainByItself) {
  const double before = width();
  const Design design = bench().design();
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("roof.step has changed on disk and was read again at ")) << banner();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  const double other = width();
  EXPECT_NE(other, before);
  EXPECT_EQ(bench().design(), design) << "what is not saved stays";
  EXPECT_TRUE(bench().document().modified());
  EXPECT_TRUE(facts().contains("Read again at " + bench().readAgainAt().toString("HH:mm:ss")))
      << facts().toStdString();
  ASSERT_TRUE(followBox() && followBox()->isVisible() && followBox()->isChecked());
  window().workflow().ensureWidgetVisible(followBox());
  const QLabel* line = labelWith("Read again at");
  ASSERT_TRUE(line);
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return line->height() >= line->heightForWidth(line->width()); }, kPatience))
      << "its lines are cut off";
  picture("source-read-again");
  // The history is that of the person alone: it leads back over the settings, on what was read last.
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_NE(bench().design().cut().sections.stations, 17);
  EXPECT_EQ(width(), other);
  bench().document().undoStack().redo();
  ASSERT_TRUE(settle());
  // Written in place, and once more renamed over it.
  const auto readAgain = [&](double wanted) {
    return QTest::qWaitFor([&] { return !bench().runner().busy() && bench().current() && width() == wanted; },
                           kPatience);
  };
  std::ofstream(source()) << geometry::exampleStep("saddle").value();
  EXPECT_TRUE(readAgain(before));
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  EXPECT_TRUE(readAgain(other));
  EXPECT_EQ(bench().document().undoStack().count(), 1);
}

TEST_F(SourceFile, ThatIsNoSurfaceOrHalfOfOneIsToldAndTheDesignStays) {
  const double before = width();
  const Design design = bench().design();
  const std::string whole = geometry::exampleStep("panel-600x670").value();
  for (const std::string& bytes : {whole.substr(0, whole.size() / 2), std::string("no surface at all\n")}) {
    window().banner().outdate(Topic::source);
    ASSERT_NO_FATAL_FAILURE(saveByRename(bytes));
    ASSERT_TRUE(told("cannot be used as it is now")) << banner();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(bench().current()) << "the result was lost";
    EXPECT_EQ(width(), before);
    EXPECT_EQ(bench().design(), design);
    for (const Message& message : bench().messages()) EXPECT_NE(message.severity, Severity::error);
  }
  picture("source-unreadable");
  EXPECT_EQ(window().banner().action()->text(), "Try again");
  ASSERT_NO_FATAL_FAILURE(saveByRename(whole));
  ASSERT_TRUE(told("was read again at")) << banner();
  ASSERT_TRUE(settle());
  EXPECT_NE(width(), before);
  EXPECT_EQ(window().banner().notices().size(), 1u) << "what was told before no longer holds";
}

TEST_F(SourceFile, ThatVanishesIsToldAndReadWhenItIsThereAgain) {
  const double before = width();
  fs::remove(source());
  ASSERT_TRUE(told("is no longer there")) << banner();
  EXPECT_TRUE(bench().current());
  EXPECT_EQ(width(), before);
  ASSERT_TRUE(writeFile(source(), geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("was read again at")) << banner();
  ASSERT_TRUE(settle());
  EXPECT_NE(width(), before);
  EXPECT_EQ(bench().design().cut().sections.stations, 17);
}

TEST_F(SourceFile, IsLeftWhereTheSwitchIsOff) {
  const double before = width();
  ASSERT_TRUE(followBox());
  window().workflow().ensureWidgetVisible(followBox());
  QTest::mouseClick(followBox(), Qt::LeftButton, {}, QPoint(8, followBox()->height() / 2));
  EXPECT_FALSE(bench().followsFile());
  EXPECT_FALSE(model::Settings().followsFile()) << "it is remembered";
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("roof.step has changed on disk.")) << banner();
  ASSERT_TRUE(settle());
  EXPECT_EQ(width(), before);
  // What waits is read as the switch goes on.
  QTest::mouseClick(followBox(), Qt::LeftButton, {}, QPoint(8, followBox()->height() / 2));
  ASSERT_TRUE(told("was read again at")) << banner();
  ASSERT_TRUE(settle());
  EXPECT_NE(width(), before);
  EXPECT_EQ(window().banner().notices().size(), 1u);
}

TEST_F(SourceFile, ThatIsOnlyTouchedIsNotTold) {
  model::SourceWatch watch;
  QSignalSpy changed(&watch, &model::SourceWatch::changed);
  watch.watch(source());
  fs::last_write_time(source(), fs::file_time_type::clock::now() + std::chrono::hours(1));
  watch.look();
  ASSERT_FALSE(watch.resting());
  ASSERT_TRUE(QTest::qWaitFor([&] { return watch.resting(); }, kPatience));
  EXPECT_EQ(changed.count(), 0);
  ASSERT_NO_FATAL_FAILURE(saveByRename("ISO-10303-21; other"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return changed.count() > 0; }, kPatience));
  QSignalSpy gone(&watch, &model::SourceWatch::gone);
  fs::remove(source());
  ASSERT_TRUE(QTest::qWaitFor([&] { return gone.count() > 0; }, kPatience));
}

TEST_F(SourceFile, ThatChangesWhileItIsReadIsTold) {
  model::SourceWatch watch;
  QSignalSpy changed(&watch, &model::SourceWatch::changed), back(&watch, &model::SourceWatch::back);
  watch.watch(source());
  const Fingerprint read = fingerprintOf(geometry::exampleStep("saddle").value());
  watch.accept(read);
  EXPECT_EQ(changed.count(), 0);
  ASSERT_NO_FATAL_FAILURE(saveByRename("ISO-10303-21; other"));
  watch.accept(read);
  EXPECT_EQ(changed.count(), 1);
  // A drive that goes and comes back.
  watch.accept(fingerprintOf("ISO-10303-21; other"));
  fs::rename(source(), path("away.step"));
  QSignalSpy gone(&watch, &model::SourceWatch::gone);
  ASSERT_TRUE(QTest::qWaitFor([&] { return gone.count() > 0; }, kPatience));
  fs::rename(path("away.step"), source());
  ASSERT_TRUE(QTest::qWaitFor([&] { return back.count() > 0; }, kPatience));
  EXPECT_EQ(changed.count(), 1);
}

TEST_F(SourceFile, IsNotStoredBesideResultsOfAnother) {
  const pipeline::Evaluation evaluation = *bench().shown();
  EXPECT_TRUE(pipeline::storedDesign(evaluation));
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  const Result<Design> stored = pipeline::storedDesign(evaluation);
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().code, ErrorCode::cannotRead);
  EXPECT_NE(stored.error().message.find("was changed after"), std::string::npos) << stored.error().message;
}

TEST_F(SourceFile, ThatMovedIsLocated) {
  const fs::path design = path("roof.bladewright"), moved = path("moved.step");
  window().questions().saveDesign = [&](const QString&) { return QString::fromStdString(design.string()); };
  ASSERT_TRUE(window().save());
  fs::rename(source(), moved);
  ASSERT_TRUE(told("is no longer there"));
  window().commands()["file.close"]->trigger();
  window().openFile(QString::fromStdString(design.string()));
  ASSERT_TRUE(settle());
  ASSERT_EQ(window().banner().action()->text(), "Locate…") << window().banner().text().toStdString();
  EXPECT_TRUE(inputButton("Locate…")->isVisible());
  picture("locate-surface");
  window().questions().openSurface = [&] { return QString::fromStdString(moved.string()); };
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(bench().design().cut().sections.stations, 17);
  EXPECT_EQ(bench().document().design()->source().path, moved);
}

TEST_F(SourceFile, ThatMovedIsLocatedByTheNoticeAlone) {
  const fs::path moved = path("moved.step");
  fs::rename(source(), moved);
  ASSERT_TRUE(told("is no longer there"));
  EXPECT_TRUE(inputButton("Locate…")->isVisible());
  EXPECT_FALSE(inputButton("Reload")->isVisible());
  EXPECT_TRUE(window().commands()["file.locate"]->isEnabled());
  EXPECT_FALSE(window().commands()["file.reload"]->isEnabled());
  int asked = 0;
  window().questions().openSurface = [&] {
    ++asked;
    return QString::fromStdString(moved.string());
  };
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  EXPECT_EQ(asked, 1) << "the button of the notice does nothing";
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(bench().document().design()->source().path, moved);
  EXPECT_FALSE(window().banner().isVisible()) << window().banner().text().toStdString();
  EXPECT_FALSE(inputButton("Locate…")->isVisible());
  EXPECT_TRUE(inputButton("Reload")->isEnabled());
}

TEST_F(SourceFile, ThatLiesElsewhereIsBroughtIntoThePicture) {
  bench().setFollowsFile(false);
  const view::SceneView& view = window().sceneView();
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.resting(); }, kPatience));
  const scene::Camera before = view.camera();
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("saddle").value() + "\n"));
  ASSERT_TRUE(told("roof.step has changed on disk"));
  bench().reloadSource();
  ASSERT_TRUE(settle());
  EXPECT_EQ(view.camera().position, before.position) << "a reload moved the camera without need";
  // Another surface, while the picture shows nothing at all.
  window().sceneView().fitBounds(Bounds{Eigen::Vector3d::Constant(1e5), Eigen::Vector3d::Constant(1.001e5)},
                                 false);
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("roof.step has changed on disk"));
  bench().reloadSource();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const QPointF middle = view.toWidget(bench().shown()->cut().target.value->bounds().center());
        return QRectF(view.rect()).contains(middle);
      },
      kPatience));
}

TEST_F(SourceFile, ThatChangedSinceTheSaveIsToldOnOpening) {
  const fs::path design = path("roof.bladewright");
  window().questions().saveDesign = [&](const QString&) { return QString::fromStdString(design.string()); };
  ASSERT_TRUE(window().save());
  window().commands()["file.close"]->trigger();
  window().openFile(QString::fromStdString(design.string()));
  ASSERT_TRUE(settle());
  EXPECT_FALSE(window().banner().isVisible()) << window().banner().text().toStdString();
  window().commands()["file.close"]->trigger();
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  window().openFile(QString::fromStdString(design.string()));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(window().banner().text().contains("roof.step has changed since the design was saved"))
      << window().banner().text().toStdString();
  const auto tells = [&] {
    for (const Message& message : bench().messages())
      if (message.finding && message.finding->kind() == FindingKind::source) return true;
    return false;
  };
  EXPECT_TRUE(tells());
  // Another evaluation takes neither away, nor does a reload; a save does.
  QTest::keyClick(&window(), Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(tells());
  EXPECT_TRUE(window().banner().isVisible()) << "a reload took the notice away";
  bench().editDesign("Change stations", [](Design& d) { d.cut().sections.stations = 18; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(tells());
  EXPECT_TRUE(window().banner().isVisible());
  ASSERT_TRUE(window().save());
  ASSERT_TRUE(settle());
  EXPECT_FALSE(tells());
  EXPECT_FALSE(window().banner().isVisible());
}

TEST_F(SourceFile, KeptInTheDesignIsReloadedAsAStep) {
  QCheckBox* keep = nullptr;
  for (QCheckBox* box : window().workflow().findChildren<QCheckBox*>())
    if (box->text().startsWith("Keep the geometry")) keep = box;
  ASSERT_TRUE(keep);
  window().workflow().ensureWidgetVisible(keep);
  QTest::mouseClick(keep, Qt::LeftButton, {}, QPoint(8, keep->height() / 2));
  ASSERT_TRUE(settle());
  const double before = width();
  ASSERT_NO_FATAL_FAILURE(saveByRename(geometry::exampleStep("panel-600x670").value()));
  ASSERT_TRUE(told("roof.step has changed on disk"));
  QTest::keyClick(&window(), Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(settle());
  EXPECT_NE(width(), before);
  EXPECT_FALSE(bench().document().design()->source().bytes.empty());
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(width(), before);
}

}  // namespace
}  // namespace bw::app
