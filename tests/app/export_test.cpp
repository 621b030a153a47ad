// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Exports: ordered at any time, of which result they are, and whose they are.
#include <QFileDialog>
#include <QLineEdit>
#include <QTimer>

#include "../drawings/pdf_text.h"
#include "controls/numbers.h"
#include "window_fixture.h"
#include "workflow/export_blocks.h"
#include "workflow/output_fields.h"

namespace bw::app {
namespace {

class Exports : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    window().questions().exportFolder = [&] {
      ++asked_;
      return QString::fromStdString(folder().string());
    };
  }

  /// A design that is linked to its file.
  void openLinked() {
    ASSERT_TRUE(writeFile(source(), geometry::exampleStep("panel-600x670").value()));
    ASSERT_TRUE(window().openFile(QString::fromStdString(source().string())));
    bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 17; });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  void exportAll() {
    window().exportEverything();
    ASSERT_TRUE(settle());
    ASSERT_TRUE(fs::exists(folder() / "report.json"));
  }

  fs::path source() const { return path("roof.step"); }
  fs::path folder() const { return path("out"); }
  std::string outputState() { return bench().stepStates()[int(model::Step::output)].text.toStdString(); }

  bool told(const QString& words) {
    for (const Notice& notice : window().banner().notices())
      if (notice.text.contains(words)) return true;
    return false;
  }

  bool listsFiles() {
    for (QLabel* label : window().workflow().findChildren<QLabel*>())
      if (label->isVisible() && label->text().contains("Last export")) return true;
    return false;
  }

  QPushButton* outputButton(const QString& text) {
    for (QPushButton* b : window().workflow().findChildren<QPushButton*>())
      if (b->text() == text) return b;
    return nullptr;
  }

  QCheckBox* outputCheck(const QString& text) {
    for (QCheckBox* box : window().workflow().findChildren<QCheckBox*>())
      if (box->text() == text) return box;
    return nullptr;
  }

  void typeTolerance(const QString& text) {
    auto* tolerance = find<NumberField>("Tolerance");
    ASSERT_TRUE(tolerance);
    tolerance->setFocus();
    tolerance->selectAll();
    QTest::keyClicks(tolerance, text);
  }

  int asked_ = 0;
};

TEST_F(Exports, LeaveWhatIsStillToBeAddedToTheResult) {
  openPanel();
  const auto shown = [this] { return bench().shownCut(); };
  ASSERT_FALSE(shown()->lengths.value) << "the result is shown before all is known of it";
  // Before anything is added, and once more while it is.
  bench().exportPrograms(path("first"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().exporting(); }, kPatience));
  EXPECT_FALSE(shown()->lengths.value);
  ASSERT_TRUE(QTest::qWaitFor([&] { return shown()->run.value || shown()->lengths.value; }, kPatience));
  bench().exportAll(path("second"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().exporting(); }, kPatience));
  ASSERT_TRUE(fs::exists(path("second") / "report.json"));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return shown()->run.value && shown()->lengths.value && shown()->margins.value; }, kPatience));
  EXPECT_TRUE(bench().current());
}

TEST_F(Exports, AreWrittenWithWhatIsBeingTypedByKeyAndByMouse) {
  openPanel();
  ASSERT_NO_FATAL_FAILURE(typeTolerance("2.5"));
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_E, Qt::ControlModifier);
  EXPECT_EQ(asked_, 1) << "the key did nothing";
  EXPECT_TRUE(told("as soon as it stands"));
  ASSERT_TRUE(settle());
  const Result<Design> first = loadDesign(folder() / pipeline::kDesignFile);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(first->process.tolerance, 2.5);
  EXPECT_EQ(outputState(), "Exported");
  EXPECT_FALSE(told("as soon as it stands"));

  window().questions().earlierExport = [](const auto&, const auto&, const auto&) {
    return Workbench::Earlier::replace;
  };
  QPushButton* button = outputButton("Export everything…");
  ASSERT_TRUE(button);
  ASSERT_NO_FATAL_FAILURE(typeTolerance("2.75"));
  window().workflow().ensureWidgetVisible(button);
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(asked_, 2) << "the button did nothing";
  ASSERT_TRUE(settle());
  EXPECT_EQ(loadDesign(folder() / pipeline::kDesignFile)->process.tolerance, 2.75);
}

TEST_F(Exports, TellThatNothingWasWrittenWhereNoResultComes) {
  openPanel();
  auto* length = find<NumberField>("Blade length");
  ASSERT_TRUE(length);
  length->setFocus();
  length->selectAll();
  QTest::keyClicks(length, "500");
  QTest::keyClick(length, Qt::Key_E, Qt::ControlModifier);
  EXPECT_EQ(asked_, 1);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(bench().current());
  EXPECT_TRUE(told("Nothing was exported"));
  EXPECT_FALSE(fs::exists(folder()));
  EXPECT_FALSE(window().commands()["file.export"]->isEnabled());
  // It does not come later, with another result.
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Exports, TellThatErrorsHoldProgramsBackUntilTheyAreMended) {
  ASSERT_TRUE(window().openExample("single-block"));
  bench().editDesign("Shorter blade", [](Design& design) { design.blade.length = 690; });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  ASSERT_TRUE(hasErrors(bench().shown()->findings()));
  EXPECT_EQ(outputState(), "Programs held back");
  ASSERT_NO_FATAL_FAILURE(exportAll());
  EXPECT_EQ(outputState(), "Exported, not all programs");
  EXPECT_EQ(bench().stepStates()[int(model::Step::output)].kind, model::StepState::Kind::warning);
  EXPECT_TRUE(told("no RAPID program"));
  bench().document().undoStack().undo();
  EXPECT_FALSE(told("no RAPID program")) << "it is of the design before";
  ASSERT_TRUE(settle());
  EXPECT_EQ(outputState(), "Older export");
}

TEST_F(Exports, StayThoseOfTheResultWhenItIsSaved) {
  openLinked();
  exportAll();
  EXPECT_EQ(outputState(), "Exported");
  const std::size_t findings = bench().messages().size();
  window().questions().saveDesign = [&](const QString&) {
    return QString::fromStdString(path("roof.bladewright").string());
  };
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  ASSERT_TRUE(settle());
  EXPECT_EQ(outputState(), "Exported");
  EXPECT_EQ(bench().messages().size(), findings) << "the findings of the programs went";
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(outputState(), "Older export");
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(outputState(), "Exported");
  bench().editDesign("Choose programs", [](Design& design) { design.output.programs = {"csv"}; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(outputState(), "Older export");
}

TEST_F(Exports, AreOlderThanASurfaceThatIsReadAgain) {
  openLinked();
  exportAll();
  ASSERT_TRUE(writeFile(source(), geometry::exampleStep("saddle").value()));
  QTest::keyClick(&window(), Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  EXPECT_EQ(outputState(), "Older export");
}

TEST_F(Exports, BelongToTheirDesign) {
  openLinked();
  exportAll();
  EXPECT_TRUE(listsFiles());
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  window().openExample("saddle");
  ASSERT_TRUE(settle());
  EXPECT_FALSE(listsFiles()) << "the files of another design";
  EXPECT_TRUE(bench().exportFolder().empty());

  // One that ends when another design is open; nobody is asked about it.
  int questions = 0;
  window().questions().earlierExport = [&](const auto&, const auto&, const auto&) {
    ++questions;
    return Workbench::Earlier::replace;
  };
  window().exportEverything();
  ASSERT_TRUE(bench().exporting());
  window().openExample("sphere-cap");
  ASSERT_TRUE(settle());
  EXPECT_EQ(questions, 0);
  EXPECT_FALSE(bench().exporting());
  EXPECT_FALSE(listsFiles());
  EXPECT_NE(outputState(), "Exported");
}

TEST_F(Exports, ReplaceEvenIfTheDesignHasNoResultByThen) {
  openPanel();
  exportAll();
  const std::string before = readFile(folder() / "report.json").value();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  ASSERT_TRUE(settle());
  window().questions().earlierExport = [](const auto&, const auto&, const auto&) {
    return Workbench::Earlier::replace;
  };
  window().exportEverything();
  bench().editDesign("Change blade length", [](Design& design) { design.blade.length = 500; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().runner().error());
  EXPECT_NE(readFile(folder() / "report.json").value(), before) << "the files were made, and given up";
  EXPECT_FALSE(told("has no finished result"));
}

TEST_F(Exports, HaveTheSamePicturesHoweverTheWindowIsLaidOut) {
  openPanel();
  exportAll();
  for (const char* panel : {"panel.workflow", "panel.inspector", "panel.bottom"})
    window().commands()[panel]->trigger();
  window().resize(1440, 640);
  picture("wide-view");
  const scene::Camera before = window().sceneView().camera();
  window().questions().earlierExport = [](const auto&, const auto&, const auto&) {
    return Workbench::Earlier::newFolder;
  };
  window().exportEverything();
  ASSERT_TRUE(settle());
  ASSERT_EQ(bench().exportFolder(), path("out 2"));
  EXPECT_EQ(window().sceneView().camera().position, before.position);
  for (const char* name : {"deviation.png", "deviation-top.png", "angle.png", "curvature.png"}) {
    const QImage first(QString::fromStdString((folder() / "pictures" / name).string())),
        second(QString::fromStdString((path("out 2") / "pictures" / name).string()));
    ASSERT_EQ(first.size(), QSize(1280, 800));
    EXPECT_EQ(first, second) << name;
    second.save(QString(BW_TEST_OUTPUT "/window/report-%1").arg(name));
  }
}

TEST_F(Exports, TellWhereFilesHoldOtherSectionsThanTheScreen) {
  // Of the bottle's thread the tracer loses a turn; OpenCASCADE, which confirms what is written, does not.
  Design design;
  design.source().path = fs::path(BW_FOREIGN_DATA) / "occ/bottle.brep";
  design.cut().face = {FaceChoice::Kind::indices, {1}};
  design.cut().direction = Eigen::Vector3d::UnitY();
  design.cut().sections.stations = 5;
  design.block().placement = BlockPlacement{{0, -8, 51.5}, {9, 16, 2}, Eigen::Vector3d::Zero()};
  design.blade = bladePreset("steel-rod-1").value();
  design.blade.length = 100;
  design.process.clearance = 0;
  design.output.programs = {"csv"};
  ASSERT_TRUE(saveDesign(design, path("thread.bladewright")));
  ASSERT_TRUE(window().openFile(QString::fromStdString(path("thread.bladewright").string())));
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().sweep());
  const std::size_t seen = bench().sweep()->size();
  ASSERT_NO_FATAL_FAILURE(exportAll());
  EXPECT_TRUE(told("not what the screen shows"));
  EXPECT_TRUE(std::ranges::any_of(bench().messages(), [](const Message& message) {
    return message.finding && message.finding->kind() == FindingKind::sectionRoute;
  }));
  const Result<Design> written = loadDesign(folder() / pipeline::kDesignFile);
  ASSERT_TRUE(written);
  EXPECT_EQ(bench().sweep()->size(), seen) << "the screen stays as it was";
}

TEST_F(Exports, GoToTheFolderThatIsTold) {
  ASSERT_NO_FATAL_FAILURE(openLinked());
  auto* field = window().workflow().findChild<FolderField*>();
  ASSERT_TRUE(field);
  window().workflow().ensureWidgetVisible(field);
  const auto type = [&](const std::string& text) {
    field->setFocus();
    field->selectAll();
    QTest::keyClick(field, Qt::Key_Delete);
    QTest::keyClicks(field, QString::fromStdString(text));
    QTest::keyClick(field, Qt::Key_Return);
  };
  type("somewhere");
  EXPECT_TRUE(field->refused());
  type(source().string());
  EXPECT_TRUE(field->refused()) << "a file";
  type((folder() / "in/there").string());
  EXPECT_TRUE(field->refused()) << "in no folder";
  picture("export-folder-refused");
  ASSERT_TRUE(outputButton("Export everything…"));
  const fs::path told = path("told");
  type(told.string());
  EXPECT_FALSE(field->refused());
  QPushButton* button = outputButton("Export everything");
  ASSERT_TRUE(button);
  picture("export-folder");
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(fs::exists(told / "report.json"));
  EXPECT_EQ(asked_, 0);
  // Chosen, emptied.
  QTest::mouseClick(outputButton("Choose folder…"), Qt::LeftButton);
  EXPECT_EQ(asked_, 1);
  EXPECT_EQ(bench().exportTo(), folder());
  EXPECT_EQ(field->text().toStdString(), folder().string());
  type("");
  EXPECT_TRUE(bench().exportTo().empty());
  EXPECT_TRUE(outputButton("Export everything…"));
}

TEST_F(Exports, OfProgramsNeedAFormat) {
  openPanel();
  EXPECT_TRUE(window().commands()["file.programs"]->isEnabled());
  bench().editDesign("Choose programs", [](Design& design) { design.output.programs.clear(); });
  ASSERT_TRUE(settle());
  EXPECT_FALSE(window().commands()["file.programs"]->isEnabled());
  EXPECT_FALSE(outputButton("Export programs…")->isEnabled());
  EXPECT_TRUE(window().commands()["file.export"]->isEnabled());
}

TEST_F(Exports, WriteTheKindsOfFilesThatAreChosen) {
  openPanel();
  for (const char* kind : {"Meshes", "Tables", "Report with pictures"}) {
    auto* box = outputCheck(kind);
    ASSERT_TRUE(box) << kind;
    EXPECT_TRUE(box->isChecked());
    EXPECT_FALSE(box->toolTip().isEmpty());
    window().workflow().ensureWidgetVisible(box);
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Space);
    EXPECT_FALSE(box->isChecked());
  }
  EXPECT_FALSE(outputCheck("Drawings and cut list")->isEnabled()) << "of a surface of a file in one block";
  picture("export-panel");
  ASSERT_TRUE(outputButton("Export what is chosen…"));
  EXPECT_EQ(window().commands()["file.export"]->text(), "&Export what is chosen…");
  exportAll();
  for (const char* gone :
       {"mesh.obj", "mesh.stl", "stations.csv", "deviation.csv", "report.html", "report.pdf", "pictures"})
    EXPECT_FALSE(fs::exists(folder() / gone)) << gone;
  for (const char* there : {"surface.step", "surface.iges", "design.bladewright", "sweep.json",
                            "programs/strip-0/T_ROB1/BladeLeft.mod"})
    EXPECT_TRUE(fs::exists(folder() / there)) << there;
  EXPECT_EQ(outputState(), "Exported in part");
  // What was chosen is remembered.
  bench().document().undoStack().setIndex(0);
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  makeWindow({1440, 900});
  EXPECT_FALSE(bench().wanted().has(pipeline::FileKind::meshes));
  EXPECT_TRUE(bench().wanted().has(pipeline::FileKind::surface));
  EXPECT_FALSE(outputCheck("Tables")->isChecked());
}

TEST_F(Exports, WriteTheBlocksThatAreChosenAndTellHowEachStands) {
  ASSERT_TRUE(window().openExample("three-block-wall"));
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  for (const pipeline::BlockEvaluation& evaluated : bench().shown()->blocks) {
    const std::string& block = evaluated.id;
    const BlockStanding standing = standingOf(bench(), block);
    EXPECT_EQ(standing.word, "certain") << block;
    EXPECT_EQ(standing.time, timeText(evaluated.cuts.front().motion.value->cuttingTime())) << block;
    EXPECT_TRUE(standing.tip.startsWith("33 stations in 1 cut: 33 certain, 0 held"))
        << standing.tip.toStdString();
  }
  auto* second = find<QCheckBox>("Export column-2");
  ASSERT_TRUE(second);
  window().workflow().ensureWidgetVisible(second);
  QTest::mouseClick(second, Qt::LeftButton, {}, QPoint(8, second->height() / 2));
  EXPECT_EQ(bench().wanted().blocks, (std::vector<std::string>{"column-1", "column-3"}));
  picture("export-blocks");
  exportAll();
  EXPECT_EQ(outputState(), "Exported in part");
  EXPECT_FALSE(fs::exists(folder() / "programs/column-2"));
  EXPECT_TRUE(fs::exists(folder() / "programs/column-3/strip-2/T_ROB1/BladeLeft.mod"));
  EXPECT_EQ(drawings::pagesOf(readFile(folder() / "drawings.pdf", 1 << 24).value()).size(), 2u);
  const std::string list = readFile(folder() / "cut-list.csv").value();
  EXPECT_EQ(list.find("column-2"), std::string::npos);
  EXPECT_EQ(readFile(folder() / "parts.step", 1 << 26).value().find("'column-2'"), std::string::npos);
  // None is nothing to write; another design has all of its own.
  for (const char* block : {"Export column-1", "Export column-3"}) find<QCheckBox>(block)->click();
  EXPECT_FALSE(window().commands()["file.export"]->isEnabled());
  EXPECT_FALSE(outputButton("Export what is chosen…") && outputButton("Export what is chosen…")->isEnabled());
  ASSERT_TRUE(window().openExample("bump"));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().canExport());
  EXPECT_EQ(standingOf(bench(), bench().block().id).word, "certain");
  bench().editDesign("Change blade length", [](Design& design) { design.blade.length = 500; });
  EXPECT_EQ(standingOf(bench(), bench().block().id).word, "out of date");
  ASSERT_TRUE(settle());
  EXPECT_NE(standingOf(bench(), bench().block().id).word, "certain");
}

using FolderForFiles = WindowTest;

TEST_F(FolderForFiles, IsMadeWhereANewOneIsTyped) {
  const fs::path made = path("ripple");
  ASSERT_FALSE(fs::exists(made));
  int asked = 0;
  QTimer typing;
  QObject::connect(&typing, &QTimer::timeout, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog || asked > 0) return;
    ++asked;
    auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
    if (!name) return dialog->reject();
    name->setFocus();
    name->setText(QString::fromStdString(made.string()));
    QTest::keyClick(name, Qt::Key_Return);
    // It would wait for us with another question.
    QTimer::singleShot(2000, dialog, &QDialog::reject);
  });
  typing.start(20);
  const QString folder = window().questions().exportFolder();
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(fs::path(folder.toStdString()), made);
  EXPECT_TRUE(fs::is_directory(made));
}

}  // namespace
}  // namespace bw::app
