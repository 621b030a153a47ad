// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is typed into any field of the window is meant, or is refused in words.
#include <clocale>

#include "bw/core/base/units.h"
#include "every_field.h"
#include "workflow/grid_fields.h"
#include "workflow/kerf_table_field.h"
#include "workflow/output_fields.h"
#include "workflow/variable_fields.h"

namespace bw::app {
namespace {

struct Typed {
  QString text;
  double value;
};

/// Texts that mean a number within the limits of a field, and that number.
std::vector<Typed> meantTexts(const NumberField& field) {
  const NumberRange& range = field.range();
  const bool whole = range.decimals == 0;
  double v = 0;
  for (double candidate : {37.5, 3.25, 2.0, 0.75})
    if (const double c = whole ? std::ceil(candidate) : candidate;
        c > range.min && c < range.max && c != field.value()) {
      v = c;
      break;
    }
  const auto text = [](double value) { return QString::number(value, 'g', 15); };
  const auto comma = [](QString t) { return t.replace('.', ','); };
  std::vector<Typed> typed = {{text(v), v},
                              {comma(text(v)), v},
                              {"+" + comma(text(v)), v},
                              {QString::number(v, 'e', 3), v},
                              {comma(QString::number(v, 'E', 3)), v},
                              {text(4 * v) + "/4", v},
                              {"2*" + text(v / 4) + "+" + text(v / 2), v},
                              {"(" + text(v + 2) + " - 2)", v},
                              {"  " + text(v) + "  ", v}};
  if (range.min <= -1) typed.push_back({"-1", -1}), typed.push_back({QString(QChar(0x2212)) + "1", -1});
  if (range.min <= 0.5 && !whole) typed.push_back({"0,5", 0.5}), typed.push_back({"1/2", 0.5});
  if (range.max >= 1000 && range.min <= 1000)
    typed.push_back({"1e3", 1000}), typed.push_back({"1 000", 1000});
  if (range.max >= 1234.5 && !whole)
    typed.push_back({"1.234,5", 1234.5}), typed.push_back({"1,234.5", 1234.5});
  if (range.unit == "mm") {
    typed.insert(typed.end(), {{text(v / 10) + "cm", v},
                               {comma(text(v / 1000)) + " m", v},
                               {text(v / 25.4) + " in", v},
                               {text(v / 25.4) + " IN", v},
                               {text(4 * v / 10) + "/4 cm", v}});
  } else if (range.unit == QChar(0xb0)) {
    typed.insert(typed.end(), {{text(v * kPi / 180) + " rad", v}, {text(v) + QChar(0xb0), v}});
  } else if (range.unit == "mm/s") {
    typed.insert(typed.end(), {{text(v / 10) + " cm/s", v}, {text(v * 0.06) + " m/min", v}});
  }
  return typed;
}

TEST(NumberKeys, StepOverWhatIsLeftOut) {
  NumberField field({1, 20, 0, 1, {}});
  field.setCheck(
      [](double v) { return v < 3 || (v > 5 && v < 8) ? QStringLiteral("It was left out") : QString(); });
  field.show(5);
  const auto after = [&](Qt::Key key) {
    QTest::keyClick(&field, key);
    return field.value();
  };
  EXPECT_EQ(after(Qt::Key_Up), 8);
  EXPECT_EQ(after(Qt::Key_Down), 5);
  EXPECT_EQ(after(Qt::Key_PageUp), 15);
  EXPECT_EQ(after(Qt::Key_PageDown), 5);
  EXPECT_EQ(after(Qt::Key_PageDown), 3) << "as far as there is something";
  EXPECT_EQ(after(Qt::Key_Down), 3);
}

class TypedFields : public EveryFieldTest {
 protected:
  void expectTaken(NumberField& field, const Typed& typed) {
    typeOver(field, typed.text);
    ASSERT_EQ(field.text(), typed.text) << "the field dropped letters";
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_FALSE(field.refused()) << typed.text.toStdString() << ": " << field.refusal().toStdString();
    EXPECT_NEAR(field.value(), typed.value, 1e-9 * std::max(1.0, std::abs(typed.value)))
        << typed.text.toStdString();
    if (window().onMeasurePage()) return;
    EXPECT_TRUE(window().sceneView().hasFocus()) << "the keyboard stayed in the field";
  }

  void expectRefused(TypedField& field, const QString& text) {
    const QString before = field.text();
    const int changes = bench().document().undoStack().index();
    typeOver(field, text);
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_TRUE(field.refused()) << text.toStdString() << " became " << field.text().toStdString();
    EXPECT_EQ(field.text(), text) << "the text did not stay";
    EXPECT_EQ(bench().document().undoStack().index(), changes) << text.toStdString() << " changed the design";
    ASSERT_TRUE(field.note());
    if (!field.visibleRegion().isEmpty()) {
      EXPECT_TRUE(field.note()->isVisible());
    }
    EXPECT_TRUE(QRect(QPoint(), window().size()).contains(field.note()->geometry()));
    EXPECT_TRUE(field.hasFocus());
    QTest::keyClick(&field, Qt::Key_Escape);
    EXPECT_FALSE(field.refused());
    EXPECT_EQ(field.text(), before) << "Esc did not bring the value back";
    EXPECT_FALSE(field.note()->isVisible());
    EXPECT_TRUE(window().onMeasurePage() || window().sceneView().hasFocus());
  }

  void tryLengths(LengthsField& field) {
    // Two blocks have two sizes and one gap.
    const bool gaps = field.accessibleName().endsWith("gaps");
    for (const auto& [text, shown] :
         {std::pair("300; 310", "300; 310"), std::pair("30,5", "30.5"), std::pair("30 cm, 310", "300; 310"),
          std::pair("30.5 cm", "305"), std::pair("300,5;310", "300.5; 310"),
          std::pair("=100 + 3; 310", "103; 310"), std::pair("=29", "29")}) {
      if (gaps && QString(shown).contains(';')) {
        expectRefused(field, text);
        continue;
      }
      typeOver(field, text);
      QTest::keyClick(&field, Qt::Key_Return);
      EXPECT_FALSE(field.refused()) << text << ": " << field.refusal().toStdString();
      EXPECT_EQ(field.text(), shown);
      EXPECT_TRUE(window().sceneView().hasFocus());
    }
    for (const char* text :
         {"", "abc", "1;2;3", "-5", "5 kg", "1e9", "300;", "nan", "=", "=abc", "=1/0", "=-5"})
      expectRefused(field, text);
  }

  void tryField(TypedField& typed) {
    if (auto* field = qobject_cast<NumberField*>(&typed)) {
      const double before = field->value();
      // The ends of the legend give way to each other.
      if (auto* other = find<NumberField>("Upper end of the legend");
          other && field->accessibleName().startsWith("Lower"))
        expectTaken(*other, {"1e5", 1e5});
      if (auto* other = find<NumberField>("Lower end of the legend");
          other && field->accessibleName().startsWith("Upper"))
        expectTaken(*other, {"-1e5", -1e5});
      for (const Typed& text : meantTexts(*field)) {
        if (text.value < field->range().min || text.value > field->range().max) continue;
        expectTaken(*field, text);
      }
      const bool limited = field->range().max < 1e12;
      const QStringList nonsense = {"abc",
                                    "5-",
                                    "=abc",
                                    "=",
                                    "--3",
                                    "5 kg",
                                    "1,234",
                                    "12 34",
                                    "1.2.3",
                                    "5;",
                                    limited ? "1e12" : "x",
                                    "1/0",
                                    "1e999",
                                    "nan",
                                    "0x10"};
      for (const QString& text : nonsense) expectRefused(*field, text);
      if (field->placeholderText().isEmpty()) expectRefused(*field, "");
      EXPECT_FALSE(field->refused());
      if (before != field->value()) typeOver(*field, QString::number(before, 'g', 17));
      QTest::keyClick(field, Qt::Key_Return);
    } else if (auto* lengths = qobject_cast<LengthsField*>(&typed)) {
      tryLengths(*lengths);
    } else if (auto* fresh = qobject_cast<NewVariableField*>(&typed)) {
      for (const char* text : {"wave", "wave = ", "x = 3", "wave = 5 kg"}) expectRefused(*fresh, text);
    } else if (auto* kerf = qobject_cast<KerfTableField*>(&typed)) {
      for (const auto& [text, shown] :
           {std::pair("5: 4.2, 20: 2.6", "5: 4.2, 20: 2.6"), std::pair("5: 4,2; 20: 2,6", "5: 4.2, 20: 2.6"),
            std::pair("0.3 m/min: 0.42 cm; 20: 2.5", "5: 4.2, 20: 2.5"), std::pair("", "")}) {
        typeOver(*kerf, text);
        QTest::keyClick(kerf, Qt::Key_Return);
        EXPECT_FALSE(kerf->refused()) << text << ": " << kerf->refusal().toStdString();
        EXPECT_EQ(kerf->text(), shown);
        EXPECT_EQ(find<NumberField>("Kerf")->isEnabled(), QString(text).isEmpty());
        EXPECT_TRUE(window().sceneView().hasFocus());
      }
      EXPECT_EQ(bench().design().process.kerf, 2.5) << "that of the fastest point stays";
      for (const char* text : {"abc", "5", "5: 4.2", "20: 2.6, 5: 4.2", "5: 4.2, 20: 60", "5: 4.2, 20",
                               "5: 4,2,20: 2,6", "-5: 4, 20: 2", "5 kg: 4, 20: 2"})
        expectRefused(*kerf, text);
    } else if (auto* name = qobject_cast<VersionName*>(&typed)) {
      typeOver(*name, " Fl\u00e4che 1,5 ");
      QTest::keyClick(name, Qt::Key_Return);
      ASSERT_EQ(bench().design().versions.size(), 1u);
      EXPECT_EQ(bench().design().versions[0].name, "Fl\u00e4che 1,5");
      expectRefused(*name, "Fl\u00e4che 1,5");
    } else if (auto* folder = qobject_cast<FolderField*>(&typed)) {
      const std::string there = path("").parent_path().string();
      for (const std::string& text : {there, there + "/new, 1.5"}) {
        typeOver(*folder, QString::fromStdString(text));
        QTest::keyClick(folder, Qt::Key_Return);
        EXPECT_FALSE(folder->refused()) << text << ": " << folder->refusal().toStdString();
        EXPECT_EQ(bench().exportTo(), std::filesystem::path(text));
        EXPECT_TRUE(window().sceneView().hasFocus());
      }
      for (const char* text : {"folder", "/proc/self/stat", "/no/such/place"}) expectRefused(*folder, text);
    } else {
      auto& list = dynamic_cast<ListField&>(typed);
      list.setCount(8);
      const std::pair<const char*, std::vector<int>> lists[] = {
          {"5-7", {5, 6, 7}}, {"1, 3, 5-7", {1, 3, 5, 6, 7}}, {"0;2 4", {0, 2, 4}}, {"3", {3}}};
      for (const auto& [text, numbers] : lists) {
        list.setCount(8);
        typeOver(list, text);
        EXPECT_EQ(list.text(), text);
        QTest::keyClick(&list, Qt::Key_Return);
        EXPECT_EQ(bench().design().cut().face.indices, numbers) << text;
        EXPECT_TRUE(window().sceneView().hasFocus());
      }
      for (const char* text : {"", "abc", "7-5", "1.5", "-3", "0-99", "1,,2", "1,", "1e1"}) {
        list.setCount(8);
        expectRefused(list, text);
      }
    }
  }
};

TEST_F(TypedFields, ReadWhatIsMeantAndRefuseTheRestInWords) {
  visitFields([&](TypedField& f) { tryField(f); });
}

TEST_F(TypedFields, DoTheSameInGermany) {
  const QLocale before;
  QLocale::setDefault(QLocale("de_DE"));
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  visitFields([&](TypedField& f) { tryField(f); });
  std::setlocale(LC_ALL, "C");
  QLocale::setDefault(before);
}

TEST_F(TypedFields, DoTheSameInTurkey) {
  const QLocale before;
  QLocale::setDefault(QLocale("tr_TR"));
  std::setlocale(LC_ALL, "tr_TR.UTF-8");
  visitFields([&](TypedField& f) { tryField(f); });
  std::setlocale(LC_ALL, "C");
  QLocale::setDefault(before);
}

TEST_F(TypedFields, GiveTheKeyboardBackAfterEnter) {
  openPanel();
  auto* clearance = find<NumberField>("Clearance");
  ASSERT_TRUE(clearance);
  typeOver(*clearance, "60");
  QTest::keyClick(clearance, Qt::Key_Return);
  EXPECT_EQ(bench().design().process.clearance, 60);
  view::SceneView& scene = window().sceneView();
  ASSERT_TRUE(scene.hasFocus());
  const scene::Camera before = scene.camera();
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_2);
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return (scene.camera().position - before.position).norm() > 1; }, kPatience))
      << "2 is the top view again";
  EXPECT_EQ(bench().design().process.clearance, 60);
  EXPECT_EQ(clearance->text(), "60");
}

TEST_F(TypedFields, GiveTheKeyboardBackAfterAChoice) {
  openPanel();
  auto* mode = find<ChoiceField>("Stations");
  ASSERT_TRUE(mode);
  mode->setFocus();
  mode->showPopup();
  mode->hidePopup();
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().sceneView().hasFocus(); }, kPatience));
}

TEST_F(TypedFields, TakeWhatIsTypedBeforeACommand) {
  openPanel();
  auto* tolerance = find<NumberField>("Tolerance");
  typeOver(*tolerance, "0,5");
  const QString file = QString::fromStdString(path("typed.bladewright").string());
  window().questions().saveDesign = [file](const QString&) { return file; };
  QTest::keyClick(tolerance, Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bench().design().process.tolerance, 0.5);
  EXPECT_FALSE(bench().document().modified()) << "what was typed is not in the file";
  typeOver(*tolerance, "0,25");
  // A press on something that takes no keyboard counts as leaving the field.
  QTest::mouseClick(&window().sectionView(), Qt::LeftButton, {}, {5, 5});
  EXPECT_EQ(bench().design().process.tolerance, 0.25);
  typeOver(*tolerance, "0,75");
  int asked = 0;
  window().questions().unsaved = [&](const QString&) {
    ++asked;
    return Questions::Unsaved::cancel;
  };
  EXPECT_FALSE(window().close());
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(bench().design().process.tolerance, 0.75);
}

TEST_F(TypedFields, ExportNothingWhileANumberIsRefused) {
  openPanel();
  bool asked = false;
  window().questions().exportFolder = [&] {
    asked = true;
    return QString();
  };
  auto* tolerance = find<NumberField>("Tolerance");
  typeOver(*tolerance, "1,234");
  QTest::keyClick(tolerance, Qt::Key_E, Qt::ControlModifier);
  EXPECT_FALSE(asked);
  EXPECT_TRUE(tolerance->refused());
  EXPECT_TRUE(window().banner().text().contains("Tolerance")) << window().banner().text().toStdString();
  EXPECT_TRUE(tolerance->hasFocus());
  picture("refused");
  QTest::keyClick(tolerance, Qt::Key_Escape);
  QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
  EXPECT_TRUE(asked);
}

TEST_F(TypedFields, HoldUpAnExportWhereTheyAreFoldedAwayToo) {
  openPanel();
  bool asked = false;
  window().questions().exportFolder = [&] {
    asked = true;
    return QString();
  };
  QToolButton* fold = nullptr;
  for (QToolButton* button : window().workflow().findChildren<QToolButton*>())
    if (button->text() == "Fit and lead") fold = button;
  ASSERT_TRUE(fold);
  fold->click();
  auto* lead = find<NumberField>("Lead");
  ASSERT_TRUE(lead);
  typeOver(*lead, "abc");
  QTest::keyClick(lead, Qt::Key_Tab);
  fold->click();
  window().commands()["panel.workflow"]->trigger();
  ASSERT_FALSE(lead->isVisible());
  QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
  EXPECT_FALSE(asked) << "exported with the old number";
  EXPECT_TRUE(lead->isVisible());
  EXPECT_TRUE(lead->hasFocus());
  EXPECT_TRUE(QTest::qWaitFor([&] { return !lead->visibleRegion().isEmpty(); }, kPatience));
  picture("refused-folded");
  QTest::keyClick(lead, Qt::Key_Escape);
  EXPECT_FALSE(window().banner().isVisible()) << window().banner().text().toStdString();
  // On a page of the inspector that is not shown.
  bench().select({Selection::Kind::blade, -1});
  NumberField* length = nullptr;
  for (NumberField* field : window().inspector().findChildren<NumberField*>())
    if (field->accessibleName() == "Blade length" && field->isVisible()) length = field;
  ASSERT_TRUE(length);
  typeOver(*length, "abc");
  QTest::keyClick(length, Qt::Key_Tab);
  bench().select({});
  QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
  EXPECT_FALSE(asked);
  EXPECT_TRUE(length->isVisible() && length->hasFocus());
  QTest::keyClick(length, Qt::Key_Escape);
  QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
  EXPECT_TRUE(asked);
}

TEST_F(TypedFields, HoldUpNoExportWhereTheyAreNoNumberOfTheDesign) {
  openPanel();
  bench().selectStation(3);
  int asked = 0;
  window().questions().exportFolder = [&] {
    ++asked;
    return QString();
  };
  for (const char* name : {"Lower end of the legend", "Station"}) {
    auto* field = find<NumberField>(name);
    ASSERT_TRUE(field) << name;
    typeOver(*field, "abc");
    QTest::keyClick(field, Qt::Key_Tab);
    ASSERT_TRUE(field->refused()) << name;
  }
  QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
  EXPECT_EQ(asked, 1);
}

TEST_F(TypedFields, KeepARefusedTextThatWasLeft) {
  openPanel();
  auto* tolerance = find<NumberField>("Tolerance");
  typeOver(*tolerance, "1,234");
  QTest::keyClick(tolerance, Qt::Key_Tab);
  EXPECT_FALSE(tolerance->hasFocus());
  EXPECT_EQ(tolerance->text(), "1,234");
  EXPECT_TRUE(tolerance->refused());
  EXPECT_TRUE(tolerance->note()->isVisible()) << "the sentence went with the keyboard";
  bench().editDesign("Change clearance", [](Design& design) { design.process.clearance = 60; });
  EXPECT_EQ(tolerance->text(), "1,234") << "another change took the text away";
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  EXPECT_EQ(tolerance->text(), "0.75");
  EXPECT_FALSE(tolerance->refused());
  // Another design begins with its own numbers.
  typeOver(*tolerance, "x");
  QTest::keyClick(tolerance, Qt::Key_Tab);
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  window().openExample("saddle");
  EXPECT_FALSE(tolerance->refused());
  ASSERT_TRUE(settle());
}

TEST_F(TypedFields, DropTheTypingBeforeTheyStopTheComputation) {
  openPanel();
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 3000; });
  ASSERT_TRUE(bench().runner().busy());
  auto* tolerance = find<NumberField>("Tolerance");
  typeOver(*tolerance, "7");
  QTest::keyClick(tolerance, Qt::Key_Escape);
  EXPECT_EQ(tolerance->text(), "2");
  EXPECT_TRUE(bench().runner().busy()) << "one Esc did two things";
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().stale());
}

TEST_F(TypedFields, ShowWhatTheyHold) {
  openPanel();
  for (NumberField* field : window().findChildren<NumberField*>()) {
    if (!field->isVisible() || field->range().unit.isEmpty()) continue;
    const QLabel* unit = field->findChild<QLabel*>("unit");
    // An empty one stands for another number, and says so.
    EXPECT_EQ(unit->isVisible(), !field->text().isEmpty()) << field->accessibleName().toStdString();
    EXPECT_TRUE(!field->text().isEmpty() || !field->placeholderText().isEmpty());
    EXPECT_FALSE(unit->text().isEmpty());
  }
  auto* tolerance = find<NumberField>("Tolerance");
  typeOver(*tolerance, "0,0015");
  QTest::keyClick(tolerance, Qt::Key_Return);
  EXPECT_EQ(bench().design().process.tolerance, 0.0015);
  EXPECT_EQ(tolerance->text(), "0.0015");
  auto* clearance = find<NumberField>("Clearance");
  typeOver(*clearance, "12,34");
  QTest::keyClick(clearance, Qt::Key_Return);
  EXPECT_EQ(clearance->text(), "12.34");
  // A number with more digits than are shown keeps them when it is confirmed.
  bench().editDesign("Change clearance", [](Design& design) { design.process.clearance = 100.0 / 3; });
  EXPECT_GT(clearance->text().size(), 2);
  EXPECT_EQ(clearance->cursorPosition(), 0) << "a narrow field shows the leading digits";
  typeOver(*clearance, clearance->text());
  QTest::keyClick(clearance, Qt::Key_Return);
  EXPECT_EQ(bench().design().process.clearance, 100.0 / 3);
}

TEST_F(TypedFields, KeepADirectionAsItWasTyped) {
  openPanel();
  bench().editDesign("Change direction",
                     [](Design& design) { design.cut().direction = Eigen::Vector3d(0.5, 2, 0); });
  auto* x = find<NumberField>("Direction X");
  ASSERT_TRUE(x);
  typeOver(*x, "1");
  QTest::keyClick(x, Qt::Key_Return);
  EXPECT_EQ(x->text(), "1");
  EXPECT_EQ(find<NumberField>("Direction Y")->text(), "2");
  typeOver(*x, "0");
  QTest::keyClick(x, Qt::Key_Return);
  auto* y = find<NumberField>("Direction Y");
  typeOver(*y, "0");
  QTest::keyClick(y, Qt::Key_Return);
  EXPECT_TRUE(y->refused()) << "no way to travel";
  EXPECT_EQ(bench().design().cut().direction->y(), 2);
}

TEST_F(TypedFields, RefuseALegendThatRunsBackwards) {
  openPanel();
  auto* lower = find<NumberField>("Lower end of the legend");
  auto* upper = find<NumberField>("Upper end of the legend");
  typeOver(*upper, "5");
  QTest::keyClick(upper, Qt::Key_Return);
  typeOver(*lower, "7");
  QTest::keyClick(lower, Qt::Key_Return);
  EXPECT_TRUE(lower->refused());
  EXPECT_EQ(lower->text(), "7");
  EXPECT_EQ(*window().sceneView().sceneStyle().rangeMax, 5);
}

TEST_F(TypedFields, HoldUpADialogUntilItsNumbersStand) {
  openPanel();
  QSize size;
  answer(
      [&] {
        size = window().questions().pictureSize({1600, 1000});
      },
      "picture-size-refused",
      [](QDialog& dialog) {
        const auto fields = dialog.findChildren<NumberField*>();
        ASSERT_EQ(fields.size(), 2);
        typeOver(*fields[0], "1,234");
        QTest::keyClick(fields[0], Qt::Key_Return);
        EXPECT_TRUE(dialog.isVisible()) << "Enter closed the dialog over a refused number";
        for (QPushButton* button : dialog.findChildren<QPushButton*>())
          if (button->objectName() == "primary") button->click();
        EXPECT_TRUE(dialog.isVisible()) << "the button closed the dialog over a refused number";
        QTest::keyClick(fields[0], Qt::Key_Escape);
        EXPECT_TRUE(dialog.isVisible()) << "the first Esc belongs to the field";
        typeOver(*fields[0], "4*600");
        QTest::keyClick(fields[0], Qt::Key_Return);
        EXPECT_FALSE(dialog.isVisible());
        dialog.close();
      });
  EXPECT_EQ(size, QSize(2400, 1000));
}

TEST_F(TypedFields, FollowTheTypingOnThePageOfMeasurements) {
  openPanel();
  window().showMeasurePage();
  auto* distance = find<NumberField>("Distance 1");
  ASSERT_TRUE(distance);
  const double before = distance->value();
  typeOver(*distance, "600");
  EXPECT_EQ(distance->value(), 600) << "the length follows while it is typed";
  type(*distance, "kg");
  QTest::keyClick(distance, Qt::Key_Tab);
  EXPECT_TRUE(distance->refused());
  EXPECT_EQ(distance->value(), before) << "a part of a refused text counts";
}

}  // namespace
}  // namespace bw::app
