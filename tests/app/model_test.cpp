// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <filesystem>
#include <fstream>

#include "bw/core/design/design_versions.h"
#include "bw/geometry/export.h"
#include "bw/model/change.h"
#include "bw/model/document.h"
#include "bw/model/evaluation_runner.h"
#include "bw/model/history.h"
#include "bw/model/settings.h"
#include "bw/model/step_state.h"
#include "patience.h"

namespace bw::model {
namespace {

namespace fs = std::filesystem;

/// The test panel with few stations.
Design panelDesign(int stations = 12) {
  Design design;
  design.name = "Panel";
  design.source().path = "panel.step";
  design.source().bytes = geometry::exampleStep("panel-600x670").value();
  design.cut().sections.stations = stations;
  design.blade.length = 1000;
  return design;
}

Design noisyDesign() {
  Design design = panelDesign();
  design.source().bytes = "this is not CAD";
  return design;
}

TEST(Document, UndoesAndRedoesEditsByName) {
  Document document({});
  document.start(panelDesign());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 30; });
  document.editDesign("Change tolerance", -1, [](Design& design) { design.process.tolerance = 0.5; });
  EXPECT_EQ(document.undoStack().undoText(), "Change tolerance");
  document.undoStack().undo();
  EXPECT_EQ(document.design()->process.tolerance, Process().tolerance);
  EXPECT_EQ(document.design()->cut().sections.stations, 30);
  document.undoStack().undo();
  EXPECT_EQ(document.design()->cut().sections.stations, 12);
  EXPECT_FALSE(document.modified());
  document.undoStack().redo();
  EXPECT_EQ(document.design()->cut().sections.stations, 30);
  EXPECT_TRUE(document.modified());
}

TEST(Document, MergesTheMovesOfOneDrag) {
  Document document({});
  document.start(panelDesign());
  for (int n = 13; n < 40; ++n)
    document.editDesign("Change stations", 1, [n](Design& design) { design.cut().sections.stations = n; });
  for (int n = 40; n < 50; ++n)
    document.editDesign("Change stations", 2, [n](Design& design) { design.cut().sections.stations = n; });
  EXPECT_EQ(document.undoStack().count(), 2);
  document.undoStack().undo();
  EXPECT_EQ(document.design()->cut().sections.stations, 39);
}

TEST(Document, TellsTheDesignBeforeTheLastChange) {
  Document document({});
  document.start(panelDesign());
  EXPECT_EQ(designBefore(document), nullptr);
  const auto name = [&](const char* words) {
    document.edit(*withVersion(*document.design(), words), "Name");
  };
  name("start");
  EXPECT_EQ(designBefore(document), nullptr) << "a name changes nothing of it";
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 30; });
  for (int n = 1; n < 10; ++n)  // one drag
    document.editDesign("Change lead", 1, [n](Design& design) { design.process.lead = n; });
  name("end");
  ASSERT_TRUE(designBefore(document));
  EXPECT_EQ(designBefore(document)->cut().sections.stations, 30);
  EXPECT_EQ(designBefore(document)->process.lead, Process().lead);
  document.undoStack().undo();
  document.undoStack().undo();
  EXPECT_EQ(designBefore(document)->cut().sections.stations, 12);
  document.undoStack().undo();
  EXPECT_EQ(designBefore(document), nullptr);
}

TEST(Document, DropsAnEditThatChangesNothing) {
  Document document({});
  document.start(panelDesign());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 12; });
  EXPECT_EQ(document.undoStack().count(), 0);
}

TEST(Document, SavesAndOpensAgainTheSameDesign) {
  QTemporaryDir folder;
  const fs::path file = fs::path(folder.path().toStdString()) / "a.bladewright";
  Document document({});
  document.start(panelDesign());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 17; });
  ASSERT_TRUE(document.saveAs(file));
  EXPECT_FALSE(document.modified());
  EXPECT_EQ(document.title(), "a");
  Document other({});
  ASSERT_TRUE(other.open(file));
  EXPECT_EQ(designToJson(*other.design()), designToJson(*document.design()));
}

TEST(Document, KeepsItsDesignWhenAFileCannotBeOpened) {
  QTemporaryDir folder;
  const fs::path file = fs::path(folder.path().toStdString()) / "broken.bladewright";
  std::ofstream(file) << "{\"bladewright_design\": 1, ";
  Document document({});
  document.start(panelDesign());
  const auto before = document.design();
  EXPECT_FALSE(document.open(file));
  EXPECT_FALSE(document.open(file.string() + "-missing"));
  EXPECT_EQ(document.design(), before);
}

TEST(EvaluationRunner, BringsTheResultToTheInterfaceThread) {
  EvaluationRunner runner;
  const auto design = std::make_shared<const Design>(panelDesign());
  QThread* thread = nullptr;
  QObject::connect(
      &runner, &EvaluationRunner::finished, &runner, [&] { thread = QThread::currentThread(); },
      Qt::DirectConnection);
  runner.evaluate(design);
  EXPECT_TRUE(runner.busy());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  EXPECT_EQ(thread, QThread::currentThread());
  ASSERT_FALSE(runner.error()) << runner.error()->message;
  ASSERT_TRUE(runner.evaluation() && runner.evaluation()->cut().analysis.value);
  EXPECT_EQ(runner.evaluation()->cut().sweep.value->poses.size(), 12u);
  EXPECT_EQ(runner.evaluatedDesign(), design);
}

TEST(EvaluationRunner, UsesEarlierStagesAgain) {
  EvaluationRunner runner;
  runner.evaluate(std::make_shared<const Design>(panelDesign(12)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  const auto first = runner.evaluation();
  runner.evaluate(std::make_shared<const Design>(panelDesign(14)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  ASSERT_TRUE(first && runner.evaluation());
  EXPECT_EQ(runner.evaluation()->source.value, first->source.value);
  EXPECT_NE(runner.evaluation()->cut().analysis.value, first->cut().analysis.value);
}

TEST(EvaluationRunner, RecomputesOnlyWhatHangsOnTheSetting) {
  EvaluationRunner runner;
  const auto evaluate = [&runner](const Design& design) {
    runner.evaluate(std::make_shared<const Design>(design));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
    return runner.evaluation();
  };
  Design design = panelDesign();
  const auto first = evaluate(design);
  ASSERT_TRUE(first && first->cut().analysis.value);
  design.process.cuttingSpeed *= 2;
  const auto faster = evaluate(design);
  EXPECT_EQ(faster->cut().sweep.value, first->cut().sweep.value);
  EXPECT_NE(faster->cut().analysis.value, first->cut().analysis.value);
  EXPECT_NEAR(faster->cut().motion.value->cuttingTime(), 0.5 * first->cut().motion.value->cuttingTime(),
              kTimeUnit);
  design.process.tolerance *= 2;
  const auto looser = evaluate(design);
  EXPECT_EQ(looser->cut().sections.value, faster->cut().sections.value);
  EXPECT_NE(looser->cut().analysis.value, faster->cut().analysis.value);
  design.output.programs = {"csv"};
  const auto other = evaluate(design);
  EXPECT_EQ(other->cut().analysis.value, looser->cut().analysis.value);
  design.cut().face = {FaceChoice::Kind::all, {}};
  const auto faces = evaluate(design);
  EXPECT_EQ(faces->source.value, first->source.value);
  EXPECT_NE(faces->cut().target.value, first->cut().target.value);
}

TEST(EvaluationRunner, ShowsOnlyTheNewestOfManyEdits) {
  EvaluationRunner runner;
  QSignalSpy finished(&runner, &EvaluationRunner::finished);
  for (int n = 10; n <= 40; ++n) runner.evaluate(std::make_shared<const Design>(panelDesign(n)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  ASSERT_TRUE(runner.evaluation() && runner.evaluation()->cut().analysis.value);
  EXPECT_EQ(runner.evaluation()->cut().sweep.value->poses.size(), 40u);
  EXPECT_EQ(finished.count(), 1);
}

TEST(EvaluationRunner, FollowsADragWithoutStarving) {
  EvaluationRunner runner;
  QSignalSpy sketched(&runner, &EvaluationRunner::sketched);
  runner.evaluate(std::make_shared<const Design>(panelDesign(10)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  // Edits keep coming until a result arrives in between.
  int stations = 10;
  const bool followed = QTest::qWaitFor(
      [&] {
        stations = stations < 30 ? stations + 1 : 11;
        runner.evaluate(std::make_shared<const Design>(panelDesign(stations)), true);
        return sketched.count() > 3;
      },
      kPatience);
  EXPECT_TRUE(followed) << "nothing came before the drag ended";
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  EXPECT_EQ(runner.evaluation()->cut().sweep.value->poses.size(), std::size_t(stations));
}

TEST(EvaluationRunner, FollowsADragThatCannotBeSketched) {
  EvaluationRunner runner;
  QSignalSpy finished(&runner, &EvaluationRunner::finished);
  runner.evaluate(std::make_shared<const Design>(panelDesign(10)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  // Another choice of faces is none that a sketch goes on from; the hand moves faster than all is computed.
  int stations = 10;
  const bool followed = QTest::qWaitFor(
      [&] {
        stations = stations < 30 ? stations + 1 : 11;
        Design design = panelDesign(stations);
        design.cut().face = {FaceChoice::Kind::all, {}};
        runner.evaluate(std::make_shared<const Design>(design), true);
        return finished.count() > 1;
      },
      kPatience);
  EXPECT_TRUE(followed) << "no result came before the drag ended";
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
}

TEST(EvaluationRunner, StopsOnRequest) {
  EvaluationRunner runner;
  QSignalSpy finished(&runner, &EvaluationRunner::finished), cancelled(&runner, &EvaluationRunner::cancelled);
  Design design = panelDesign(2000);
  runner.evaluate(std::make_shared<const Design>(design));
  runner.cancel();
  EXPECT_EQ(cancelled.count(), 1);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  EXPECT_EQ(finished.count(), 0);
  EXPECT_FALSE(runner.evaluation());
}

TEST(EvaluationRunner, TellsWhyAFileCannotBeRead) {
  EvaluationRunner runner;
  runner.evaluate(std::make_shared<const Design>(noisyDesign()));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  ASSERT_TRUE(runner.error());
  EXPECT_FALSE(runner.error()->message.empty());
  EXPECT_FALSE(runner.lastComplete());
}

TEST(EvaluationRunner, RefusesATaskWithoutAResult) {
  EvaluationRunner runner;
  bool ran = false;
  std::optional<Result<void>> outcome;
  runner.submit(
      "Writing",
      [&](pipeline::Evaluation, const RunContext&) -> Result<void> {
        ran = true;
        return {};
      },
      [&](const Result<void>& done) { outcome = done; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return outcome.has_value(); }, kPatience));
  EXPECT_FALSE(ran);
  EXPECT_FALSE(*outcome);
}

TEST(Change, NamesWhatDiffersBetweenTwoEvaluations) {
  EvaluationRunner runner;
  const auto evaluated = [&](const Design& design) {
    runner.evaluate(std::make_shared<const Design>(design));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
    return runner.evaluation();
  };
  Design design = panelDesign();
  const std::string cut = design.cut().id;
  const auto first = evaluated(design);
  ASSERT_TRUE(first && first->result());

  const Change all = difference(nullptr, first.get());
  EXPECT_EQ(all.cuts.at(cut), kAspectsOfCut);
  EXPECT_TRUE(all.any(Aspect::source));

  design.output.programs = {"csv"};
  const auto programs = evaluated(design);
  EXPECT_NE(programs, first);
  EXPECT_FALSE(difference(first.get(), programs.get()).any(kAspectsOfCut | Aspect::source));

  design.process.lead += 5;
  const auto lead = evaluated(design);
  EXPECT_EQ(difference(programs.get(), lead.get()).cuts.at(cut), Aspect::motion | Aspect::checks)
      << "the way into the row as well";

  design.cut().sections.stations = 15;
  const auto stations = evaluated(design);
  const Change more = difference(lead.get(), stations.get());
  EXPECT_EQ(more.cuts.at(cut), Aspect::poses | Aspect::motion | Aspect::checks);
  EXPECT_FALSE(more.any(Aspect::source | Aspect::target | Aspect::block));
  EXPECT_TRUE(more.any(Aspect::poses, Selection{.block = design.block().id, .cut = cut}));
  EXPECT_FALSE(more.any(Aspect::poses, Selection{.cut = "another"}));
}

TEST(StepStates, FollowFromWhatIsThere) {
  StepFacts facts;
  facts.design = std::make_shared<const Design>();
  EXPECT_EQ(stepStates(facts)[int(Step::process)].kind, StepState::Kind::idle);

  EvaluationRunner runner;
  facts.design = std::make_shared<const Design>(panelDesign());
  runner.evaluate(facts.design);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience));
  facts.evaluated = runner.evaluatedDesign();
  facts.evaluation = runner.evaluation();
  StepStates states = stepStates(facts);
  EXPECT_EQ(states[int(Step::input)].kind, StepState::Kind::done);
  EXPECT_EQ(states[int(Step::output)].text, "Ready to export");

  facts.exported = exportKey(*facts.evaluation);
  EXPECT_EQ(stepStates(facts)[int(Step::output)].kind, StepState::Kind::done);
  facts.design = std::make_shared<const Design>(panelDesign(20));
  states = stepStates(facts);
  EXPECT_EQ(states[int(Step::process)].kind, StepState::Kind::stale);
  EXPECT_EQ(states[int(Step::output)].kind, StepState::Kind::stale);
  facts.busy = true;
  facts.busyStep = "fitting";
  facts.progress = 0.7;
  states = stepStates(facts);
  EXPECT_EQ(states[int(Step::process)].kind, StepState::Kind::running);
  EXPECT_EQ(states[int(Step::process)].progress, 0.7);

  facts = {};
  facts.design = std::make_shared<const Design>(noisyDesign());
  facts.evaluated = facts.design;
  facts.evaluation = std::make_shared<const pipeline::Evaluation>();
  facts.error = Error{ErrorCode::cannotRead, "no"};
  EXPECT_EQ(stepStates(facts)[int(Step::input)].kind, StepState::Kind::error);
}

TEST(Settings, RemembersTenFilesNewestFirst) {
  QTemporaryDir folder;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder.path());
  Settings settings;
  std::vector<fs::path> files;
  for (int i = 0; i < 12; ++i) {
    files.push_back(fs::path(folder.path().toStdString()) / (std::to_string(i) + ".step"));
    std::ofstream(files.back()) << "x";
    settings.addRecentFile(files.back());
  }
  settings.addRecentFile(files[5]);
  const std::vector<fs::path> recent = settings.recentFiles();
  ASSERT_EQ(recent.size(), 10u);
  EXPECT_EQ(recent.front(), files[5]);
  fs::remove(files[11]);
  EXPECT_EQ(settings.recentFiles().size(), 9u);
}

TEST(Settings, RemembersNothingOnceToldToForget) {
  QTemporaryDir folder;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder.path());
  const fs::path file = fs::path(folder.path().toStdString()) / "a.step";
  std::ofstream(file) << "x";
  Settings settings;
  settings.setTheme(ThemeChoice::dark);
  settings.forgetAll();
  settings.addRecentFile(file);
  settings.setTheme(ThemeChoice::light);
  settings.setLayout("columns", "wide");
  Settings next;
  EXPECT_TRUE(next.recentFiles().empty());
  EXPECT_EQ(next.theme(), ThemeChoice::dark);
  EXPECT_TRUE(next.layout("columns").isEmpty());
}

TEST(Settings, FoldersBeginWhereTheDesignsAre) {
  QTemporaryDir folder, designs;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder.path());
  Settings settings;
  EXPECT_EQ(settings.folder("export"), QDir::homePath());
  settings.setFolder("design", designs.path());
  EXPECT_EQ(settings.folder("export"), designs.path());
  settings.setFolder("export", folder.path());
  EXPECT_EQ(settings.folder("export"), folder.path());
  EXPECT_EQ(settings.folder("design"), designs.path());
}

}  // namespace
}  // namespace bw::model

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  QCoreApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
