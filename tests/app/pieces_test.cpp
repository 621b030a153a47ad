// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Three pieces of a workshop, made from the start page with the mouse and the keyboard alone: a block with a
// ripple, a block with two crossing cuts and the crease between them, and a wall of three blocks.
#include <QAbstractItemView>
#include <QElapsedTimer>
#include <QScrollArea>
#include <QToolButton>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../drawings/pdf_text.h"
#include "bw/core/text/number_text.h"
#include "controls/fields.h"
#include "window_fixture.h"
#include "workflow/grid_fields.h"
#include "workflow/surface_fields.h"
#include "workflow/variable_fields.h"

namespace bw::app {
namespace {

constexpr double kMadeWithin = 600;  // s

class Pieces : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    window().questions().exportFolder = [this] {
      ++asked_;
      return QString::fromStdString(folder().string());
    };
    begun_.start();
    ASSERT_TRUE(window().onStartPage());
  }

  fs::path folder() const { return path("piece"); }

  /// Brings a widget into sight, opening what it is folded away in, as a person does who looks for it.
  void reach(QWidget& widget) {
    if (window().blockPanel().isAncestorOf(&widget) && !window().blockPanel().isVisible())
      QTest::keyClick(&window(), Qt::Key_7, Qt::ControlModifier);
    for (QToolButton* fold : window().workflow().findChildren<QToolButton*>()) {
      if (widget.isVisible() || !fold->isCheckable() || fold->isChecked() || !fold->isVisible()) continue;
      press(*fold);
      if (!widget.isVisible()) press(*fold);  // not there
    }
    QTest::qWait(50);  // until what was folded away has its place
    ASSERT_TRUE(widget.isVisible()) << "there is no way to " << widget.accessibleName().toStdString();
    // What a result brings above it may push it out of sight again.
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          for (QWidget* at = widget.parentWidget(); at; at = at->parentWidget())
            if (auto* area = qobject_cast<QScrollArea*>(at)) area->ensureWidgetVisible(&widget);
          return !widget.visibleRegion().isEmpty();
        },
        kPatience));
    ASSERT_TRUE(widget.isEnabled());
  }

  void press(QWidget& widget) {
    for (QWidget* at = widget.parentWidget(); at; at = at->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(at)) area->ensureWidgetVisible(&widget);
    QTest::qWait(0);
    QTest::mouseClick(&widget, Qt::LeftButton);
  }

  void pressButton(const QString& text) {
    QAbstractButton* found = nullptr;
    for (auto* button : window().findChildren<QAbstractButton*>())
      if (button->text() == text && button->isVisibleTo(&window()) && !button->window()->isHidden())
        found = button;
    ASSERT_TRUE(found) << text.toStdString();
    ASSERT_NO_FATAL_FAILURE(reach(*found));
    press(*found);
  }

  /// The fields of the workflow and of the panel of blocks.
  template <class Field>
  QList<Field*> fields() {
    return window().workflow().findChildren<Field*>() + window().blockPanel().findChildren<Field*>();
  }

  /// Types into the field of that name, as a person does who clicks into it.
  template <class Field = NumberField>
  void type(const QString& name, const QString& text) {
    Field* found = nullptr;
    for (auto* field : fields<Field>())
      if (field->accessibleName() == name && !field->isHidden()) found = field;
    ASSERT_TRUE(found) << name.toStdString();
    ASSERT_NO_FATAL_FAILURE(reach(*found));
    QTest::mouseClick(found, Qt::LeftButton);
    QTest::keyClick(found, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(found, text);
    QTest::keyClick(found, Qt::Key_Return);
    EXPECT_FALSE(found->refused()) << found->refusal().toStdString();
  }

  /// Chooses with the keyboard from the list that a press opens.
  void choose(const QString& name, const QString& item) {
    ChoiceField* found = nullptr;
    for (auto* field : fields<ChoiceField>())
      if (field->accessibleName() == name && !field->isHidden()) found = field;
    ASSERT_TRUE(found) << name.toStdString();
    ASSERT_NO_FATAL_FAILURE(reach(*found));
    const int index = found->findText(item);
    ASSERT_GE(index, 0) << item.toStdString();
    QTest::mouseClick(found, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return found->view()->isVisible(); }, kPatience));
    QTest::keyClick(found->view(), Qt::Key_Home);
    for (int i = 0; i < index; ++i) QTest::keyClick(found->view(), Qt::Key_Down);
    QTest::keyClick(found->view(), Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !found->view()->isVisible(); }, kPatience));
    EXPECT_EQ(found->currentIndex(), index);
  }

  void stands() {
    ASSERT_TRUE(settleInFull());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  /// Every blade rests in its shape by itself, or is held in it, and nothing is said to be wrong.
  void isGood() {
    ASSERT_TRUE(bench().shown()->complete());
    for (const pipeline::BlockEvaluation& block : bench().shown()->blocks)
      for (const pipeline::CutEvaluation& cut : block.cuts)
        for (std::size_t i = 0; i < cut.result()->size(); ++i) {
          const Rest rest = cut.result()->station(i).rest;
          EXPECT_TRUE(rest == Rest::certain || rest == Rest::held) << cut.id << ", station " << i + 1;
        }
    for (const Message& message : bench().messages())
      EXPECT_EQ(message.severity, Severity::info) << message.text.toStdString();
  }

  /// File ▸ Export everything…, by its keys.
  void exportEverything() {
    QTest::keyClick(QApplication::focusWidget() ? QApplication::focusWidget() : &window(), Qt::Key_E,
                    Qt::ControlModifier);
    ASSERT_EQ(asked_, 1);
    ASSERT_TRUE(settle());
    ASSERT_TRUE(fs::exists(folder() / "report.json"));
    EXPECT_LT(double(begun_.elapsed()) / 1000, kMadeWithin);
  }

  std::string read(const fs::path& name) {
    const Result<std::string> text = readFile(folder() / name, 1 << 28);
    EXPECT_TRUE(text) << name;
    return text.value_or(std::string());
  }

  /// What the folder of a piece holds, and that it is true.
  void holdsAll(const std::vector<std::string>& strips, std::size_t blocks) {
    const nlohmann::json report = nlohmann::json::parse(read("report.json"));
    for (const nlohmann::json& issue : report["issues"]) EXPECT_NE(issue["severity"], "error") << issue;
    ASSERT_EQ(report["blocks"].size(), blocks);
    for (const char* name : {"report.html", "report.pdf", "pictures/deviation.png", "design.bladewright"})
      EXPECT_GT(read(name).size(), 1000u) << name;
    for (const std::string& strip : strips)
      for (const char* program : {"T_ROB1/BladeLeft.mod", "T_ROB2/BladeRight.mod"})
        EXPECT_NE(read("programs/" + strip + "/" + program).find("MODULE"), std::string::npos) << strip;
    for (const char* name : {"surface.step", "parts.step", "blocks.step"})
      EXPECT_TRUE(read(name).starts_with("ISO-10303-21")) << name;
    const std::string parts = read("parts.step");
    std::size_t solids = 0;
    for (std::size_t at = 0; (at = parts.find("= MANIFOLD_SOLID_BREP(", at)) != std::string::npos; ++at)
      ++solids;
    EXPECT_EQ(solids, blocks);
    // What is left and what is cut off make the block, in the report and in the list of the workshop.
    double whole = 0, left = 0;
    for (const nlohmann::json& block : report["blocks"]) {
      const nlohmann::json& part = block["part"];
      double removed = 0;
      for (const nlohmann::json& cut : part["cuts"]) removed += cut["removed_mm3"].get<double>();
      EXPECT_NEAR(part["left_mm3"].get<double>() + removed, part["block_mm3"].get<double>(),
                  1e-6 * whole + 1);
      whole += part["block_mm3"].get<double>();
      left += part["left_mm3"].get<double>();
    }
    EXPECT_GT(left, 0.1 * whole);
    EXPECT_LT(left, 0.9 * whole);
    std::istringstream list(read("cut-list.csv"));
    std::string line, total;
    std::size_t lines = 0;
    while (std::getline(list, line)) {
      ++lines;
      total = line;
    }
    EXPECT_EQ(lines, blocks + 2) << "a head, a line a block, and all";
    EXPECT_NE(total.find("," + fixedText(whole * 1e-6, 3) + "," + fixedText(left * 1e-6, 3) + ","),
              std::string::npos)
        << total;
    const auto pages = drawings::pagesOf(read("drawings.pdf"));
    ASSERT_EQ(pages.size(), blocks);
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::string text = drawings::textOf(pages[i]);
      EXPECT_NE(text.find("Label: " + report["blocks"][i]["id"].get<std::string>()), std::string::npos)
          << text;
      EXPECT_NE(text.find("run " + report["run"].get<std::string>()), std::string::npos);
    }
  }

  QElapsedTimer begun_;
  int asked_ = 0;
};

TEST_F(Pieces, BeginOnTheStartPageByKeysToo) {
  const auto& cards = window().startPage().cards();
  for (const ExampleCard* card : cards) EXPECT_TRUE(card->hasPicture()) << card->text().toStdString();
  picture("pieces-start");
  window().resize(960, 600);
  picture("pieces-start-small");
  QTest::keyClick(&window(), Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(window().onStartPage());
  EXPECT_EQ(bench().design().stock.size(), 3u);
  ASSERT_NO_FATAL_FAILURE(stands());
}

TEST_F(Pieces, ABlockWithARipple) {
  ASSERT_NO_FATAL_FAILURE(pressButton("New single block"));
  ASSERT_NO_FATAL_FAILURE(stands());
  ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "ripple = 20 mm, 0 to 40"));
  ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "waves = 1,5"));
  ASSERT_NO_FATAL_FAILURE(choose("Surface", "Formula"));
  ASSERT_NO_FATAL_FAILURE(
      type<FormulaField>("Formula", "300 - 60*((x - 300)/300)^2 + ripple*sin(2*pi*waves*y/800)"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_EQ(find<FormulaField>("Formula")->cursorPosition(), 0) << "its beginning is seen";
  ASSERT_NO_FATAL_FAILURE(type("ripple", "2,5 cm"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_EQ(std::get<FormulaSurface>(bench().source().surface->shape).numbers[0].value, 25);
  picture("piece-ripple");
  isGood();
  ASSERT_NO_FATAL_FAILURE(exportEverything());
  picture("piece-ripple-exported");
  holdsAll({"strip-0"}, 1);
}

TEST_F(Pieces, ABlockWithTwoCrossingCuts) {
  ASSERT_NO_FATAL_FAILURE(pressButton("New single block"));
  ASSERT_NO_FATAL_FAILURE(stands());
  ASSERT_NO_FATAL_FAILURE(type("Size Y", "600"));
  ASSERT_NO_FATAL_FAILURE(choose("Surface", "Formula"));
  ASSERT_NO_FATAL_FAILURE(type("y to", "600"));
  ASSERT_NO_FATAL_FAILURE(
      type<FormulaField>("Formula", "120 + 0.35*x + 40*sin(pi*x/600) + 12*sin(2*pi*y/600)"));
  ASSERT_NO_FATAL_FAILURE(stands());
  ASSERT_NO_FATAL_FAILURE(pressButton("Add cut"));
  ASSERT_NO_FATAL_FAILURE(stands());
  picture("piece-cuts-added");
  ASSERT_NO_FATAL_FAILURE(choose("Surface", "Formula"));
  ASSERT_NO_FATAL_FAILURE(
      type<FormulaField>("Formula", "120 + 0.35*y + 40*sin(pi*y/600) + 12*cos(2*pi*x/600)"));
  ASSERT_NO_FATAL_FAILURE(choose("Direction", "X"));
  ASSERT_NO_FATAL_FAILURE(choose("Turned by, " + QString::fromStdString(bench().cut().id), "90°"));
  ASSERT_NO_FATAL_FAILURE(stands());
  picture("piece-cuts");
  theme().apply(model::ThemeChoice::dark);
  picture("piece-cuts-dark");
  bench().select({Selection::Kind::block, -1, bench().cut().block, bench().cut().id});
  picture("piece-cuts-inspector-dark");
  theme().apply(model::ThemeChoice::light);
  picture("piece-cuts-inspector");
  bench().select({Selection::Kind::result, -1, bench().cut().block, bench().cut().id});
  EXPECT_EQ(bench().shown()->blocks.front().together.value->creases.size(), 1u);
  isGood();
  ASSERT_NO_FATAL_FAILURE(exportEverything());
  picture("piece-cuts-exported");
  holdsAll({"strip-0", "strip-1"}, 1);
}

TEST_F(Pieces, AWallOfThreeBlocks) {
  ASSERT_NO_FATAL_FAILURE(pressButton("New wall"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_EQ(bench().shown()->blocks.size(), 3u);
  picture("piece-wall-begun");
  isGood();
  // A fourth block, without it again, and undone.
  const Design before = bench().design();
  const int begun = bench().document().undoStack().index();
  ASSERT_NO_FATAL_FAILURE(type("Columns", "4"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_EQ(bench().shown()->blocks.size(), 4u);
  isGood();
  ASSERT_NO_FATAL_FAILURE(type("Columns", "3"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_EQ(bench().shown()->blocks.size(), 3u);
  isGood();
  bench().document().undoStack().setIndex(begun);
  EXPECT_EQ(bench().design(), before);
  ASSERT_NO_FATAL_FAILURE(stands());
  ASSERT_NO_FATAL_FAILURE(choose("Surface", "Formula"));
  ASSERT_NO_FATAL_FAILURE(type<FormulaField>("Formula", "250 - 50*cos(pi*x/600) + 20*sin(pi*y/800)"));
  ASSERT_NO_FATAL_FAILURE(stands());
  picture("piece-wall");
  isGood();
  EXPECT_LT(bench().shown()->joints.value->gapMax(), 0.1);
  ASSERT_NO_FATAL_FAILURE(exportEverything());
  picture("piece-wall-exported");
  holdsAll({"column-1/strip-0", "column-2/strip-1", "column-3/strip-2"}, 3);
}

TEST_F(Pieces, AWallOfASingleBlock) {
  ASSERT_NO_FATAL_FAILURE(pressButton("New single block"));
  ASSERT_NO_FATAL_FAILURE(stands());
  const Design before = bench().design();
  ASSERT_NO_FATAL_FAILURE(choose("Surface", "Formula"));
  ASSERT_NO_FATAL_FAILURE(type<FormulaField>("Formula", "250 - 50*cos(pi*x/600)"));
  ASSERT_NO_FATAL_FAILURE(type("Columns", "3"));
  ASSERT_NO_FATAL_FAILURE(stands());
  ASSERT_EQ(bench().shown()->blocks.size(), 3u);
  EXPECT_EQ(std::get<FormulaSurface>(bench().source().surface->shape).over.max.x(), 1800);
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, sizes", "600; 50 cm; 600"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_EQ(bench().design().stock[2].placement->origin.x(), 1100);
  EXPECT_EQ(std::get<FormulaSurface>(bench().source().surface->shape).over.max.x(), 1700);
  picture("piece-wall-sizes");
  ASSERT_NO_FATAL_FAILURE(type("Columns", "1"));
  ASSERT_NO_FATAL_FAILURE(stands());
  EXPECT_FALSE(bench().design().grid);
  EXPECT_EQ(bench().design().stock.size(), 1u);
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(Pieces, AVariableIsTakenChangedRefusedAndRemoved) {
  ASSERT_NO_FATAL_FAILURE(pressButton("New single block"));
  ASSERT_NO_FATAL_FAILURE(stands());
  ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "wave = 0,5 m"));
  ASSERT_EQ(bench().design().variables.size(), 1u);
  EXPECT_EQ(bench().design().variables[0], (Variable{"wave", 500, 0, 1000, "mm"}));
  ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "lean = 5°; -10 to 10"));
  ASSERT_EQ(bench().design().variables.size(), 2u);
  EXPECT_EQ(bench().design().variables[1].unit, "°");
  EXPECT_EQ(bench().design().variables[1].min, -10);
  // The same name again changes it.
  ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "wave = 20 mm, 10 to 30"));
  ASSERT_EQ(bench().design().variables.size(), 2u);
  EXPECT_EQ(bench().design().variables[0], (Variable{"wave", 20, 10, 30, "mm"}));
  QTest::qWait(50);
  auto* fresh = find<NewVariableField>("New variable");
  ASSERT_TRUE(fresh);
  EXPECT_EQ(fresh->text(), "");
  for (const char* text :
       {"wave", "x = 3", "sin = 3", "2wave = 3", "wave = ", "wave = 5, 10 to 30", "wave = 5 kg"}) {
    fresh->setFocus();
    fresh->selectAll();
    QTest::keyClicks(fresh, text);
    QTest::keyClick(fresh, Qt::Key_Return);
    EXPECT_TRUE(fresh->refused()) << text;
    QTest::keyClick(fresh, Qt::Key_Escape);
  }
  // One that a formula needs stays, and it is said why.
  ASSERT_NO_FATAL_FAILURE(choose("Surface", "Formula"));
  ASSERT_NO_FATAL_FAILURE(type<FormulaField>("Formula", "300 + wave"));
  const auto remove = [this](const QString& name) {
    QTest::qWait(50);
    auto* button = find<QToolButton>("Remove " + name);
    ASSERT_TRUE(button);
    press(*button);
  };
  ASSERT_NO_FATAL_FAILURE(remove("wave"));
  EXPECT_EQ(bench().design().variables.size(), 2u);
  ASSERT_FALSE(window().banner().notices().empty());
  EXPECT_TRUE(window().banner().notices().back().text.startsWith("wave stays, because a formula"));
  picture("variable-needed");
  ASSERT_NO_FATAL_FAILURE(remove("lean"));
  ASSERT_EQ(bench().design().variables.size(), 1u);
  EXPECT_EQ(bench().design().variables[0].name, "wave");
  bench().document().undoStack().setIndex(0);
  EXPECT_TRUE(bench().design().variables.empty());
}

}  // namespace
}  // namespace bw::app
