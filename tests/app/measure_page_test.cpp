// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "bw/core/base/units.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class MeasurePageTest : public WindowTest {
 protected:
  MeasurePage& page() { return window().measurePage(); }

  void type(const QString& field, const QString& text) {
    auto* number = find<NumberField>(field);
    ASSERT_TRUE(number) << field.toStdString();
    number->setFocus();
    number->selectAll();
    QTest::keyClicks(number, text);
  }

  void typeMeasurement(int row, double distance, double degrees, double height) {
    const auto text = [](double v) { return QString::number(v, 'f', 3); };
    type(QString("Distance %1").arg(row), text(distance));
    type(QString("Angle %1").arg(row), text(degrees));
    type(QString("Height %1").arg(row), text(height));
  }

  QPushButton* button(const QString& text) {
    for (QPushButton* b : window().findChildren<QPushButton*>())
      if (b->text() == text && b->isVisible()) return b;
    return nullptr;
  }

  static double hangs(double length, double distance, double degrees) {
    return bladeHeight(length, {distance, 0, fromDegrees(degrees)}).value().height;
  }
};

TEST_F(MeasurePageTest, MeasuresTheBladeOfTheDesignWhileTyping) {
  openPanel();
  auto* open = find<QPushButton>("Measure the blade length");
  ASSERT_TRUE(open);
  window().workflow().ensureWidgetVisible(open);
  QTest::mouseClick(open, Qt::LeftButton);
  ASSERT_TRUE(window().onMeasurePage());
  EXPECT_FALSE(page().outcome().length);
  EXPECT_FALSE(page().useButton()->isEnabled());
  EXPECT_FALSE(window().commands()["view.fit"]->isEnabled());
  picture("measure-empty");

  typeMeasurement(1, 760, 25, 135);
  ASSERT_TRUE(page().outcome().length) << page().outcome().problem.toStdString();
  const BladeLength expected = bladeLength({760, 135, fromDegrees(25)}).value();
  EXPECT_NEAR(page().outcome().length->length.value, expected.length, 1e-6);
  EXPECT_EQ(find<QLabel>("Blade length at the cut")->text(),
            QString::number(expected.length, 'f', 2) + " mm");
  EXPECT_EQ(find<QLabel>(QString("1") + QChar(0xb0) + " more angle")->text(),
            "+" + QString::number(fromDegrees(expected.byAngle), 'f', 2) + " mm");
  EXPECT_TRUE(page().message().isEmpty()) << page().message().toStdString();
  picture("measure");

  const double before = bench().design().blade.length;
  QTest::mouseClick(page().useButton(), Qt::LeftButton);
  EXPECT_FALSE(window().onMeasurePage());
  EXPECT_NEAR(bench().design().blade.length, expected.length, 0.005 + 1e-9);
  EXPECT_EQ(bench().document().undoStack().count(), 1);
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo use measured blade length");
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(bench().design().blade.length, before);
  ASSERT_TRUE(settle());
}

TEST_F(MeasurePageTest, CombinesSeveralMeasurements) {
  openPanel();
  QTest::keyClick(&window(), Qt::Key_L, Qt::ControlModifier);
  ASSERT_TRUE(window().onMeasurePage());
  constexpr double kLength = 812;
  const double wrong[] = {0.3, -0.4, 0.2, -0.1};
  for (int i = 0; i < 4; ++i) {
    if (i > 0) {
      ASSERT_TRUE(button("Add measurement"));
      QTest::mouseClick(button("Add measurement"), Qt::LeftButton);
      EXPECT_EQ(QApplication::focusWidget(), find<NumberField>(QString("Height %1").arg(i + 1)));
    }
    const double distance = 780 - 10 * i, degrees = 20 + 5 * i;
    typeMeasurement(i + 1, distance, degrees,
                    std::round(1000 * (hangs(kLength, distance, degrees) + wrong[i])) / 1000);
  }
  EXPECT_EQ(page().table().chosen(), 3);
  ASSERT_TRUE(page().outcome().length) << page().outcome().problem.toStdString();
  const CalibrationResult& result = *page().outcome().length;
  EXPECT_NEAR(result.length.value, kLength, 1);
  ASSERT_TRUE(result.length.low && result.length.high);
  EXPECT_LT(*result.length.low, kLength);
  EXPECT_GT(*result.length.high, kLength);
  EXPECT_TRUE(find<QLabel>("Confidence interval")->text().startsWith("95 % sure: "));
  picture("measure-several");
  window().commands()["theme.dark"]->trigger();
  picture("measure-dark");

  // Without the second row the first, third and fourth remain, in this order.
  auto* remove = find<QToolButton>("Remove measurement 2");
  ASSERT_TRUE(remove);
  QTest::mouseClick(remove, Qt::LeftButton);
  const auto rows = page().table().rows();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].distance, 760);
  EXPECT_EQ(page().outcome().measured, 3);
  EXPECT_EQ(page().table().chosen(), 2);
  QTest::mouseClick(find<QToolButton>("Draw measurement 1"), Qt::LeftButton);
  EXPECT_EQ(page().drawing().content().distance, 780);
}

TEST_F(MeasurePageTest, TellsWhenNoBladeFits) {
  openPanel();
  window().commands()["blade.measure"]->trigger();
  typeMeasurement(1, 760, 25, 135);
  ASSERT_TRUE(page().outcome().length);
  type("Height 1", "4000");
  EXPECT_FALSE(page().outcome().length);
  EXPECT_FALSE(page().useButton()->isEnabled());
  EXPECT_TRUE(page().drawing().content().outdated);
  // The number, and the remedy with the limit.
  EXPECT_TRUE(page().message().startsWith("Measurement 1: ")) << page().message().toStdString();
  EXPECT_TRUE(page().message().contains("4000 mm")) << page().message().toStdString();
  EXPECT_TRUE(page().message().contains("measure less than")) << page().message().toStdString();
  EXPECT_EQ(find<QLabel>("Blade length at the cut")->text(), QString(QChar(0x2013)));
  picture("measure-no-blade");
  type("Height 1", "135");
  EXPECT_TRUE(page().message().isEmpty());
  EXPECT_TRUE(page().useButton()->isEnabled());
}

TEST_F(MeasurePageTest, ANumberThatIsRefusedIsNotPassedOver) {
  openPanel();
  window().commands()["blade.measure"]->trigger();
  typeMeasurement(1, 760, 25, 135);
  auto* height = find<NumberField>("Height 1");
  QTest::keyClick(height, Qt::Key_Tab);
  ASSERT_TRUE(page().useButton()->isEnabled());
  type("Height 1", "-10");
  QTest::keyClick(height, Qt::Key_Tab);
  ASSERT_TRUE(height->refused());
  EXPECT_FALSE(page().useButton()->isEnabled()) << "what stands there is of the number before";
  EXPECT_FALSE(find<QLabel>("Blade length at the cut")->isEnabled());
  picture("measure-refused");
  // Esc takes it back, wherever the keyboard is, and leaves the page where there is nothing to take back.
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  EXPECT_FALSE(height->refused());
  EXPECT_TRUE(page().isVisible());
  EXPECT_TRUE(page().useButton()->isEnabled());
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  EXPECT_FALSE(page().isVisible());
}

TEST_F(MeasurePageTest, CorrectsTheTemperatureOfTheMeasurement) {
  openPanel();
  window().commands()["blade.measure"]->trigger();
  typeMeasurement(1, 760, 25, 135);
  const double warm = page().outcome().length->length.value;
  type("Temperature 1", "20");
  const Blade& blade = bench().design().blade;
  const double growth = 1 + blade.thermalExpansion * (blade.temperature - 20);
  ASSERT_GT(growth, 1.001);
  EXPECT_NEAR(page().outcome().length->length.value, warm * growth, 1e-9 * warm);
  EXPECT_NEAR(page().outcome().length->reference.value, warm, 1e-9 * warm);
}

TEST_F(MeasurePageTest, TakesHingedEndsAndKnownErrorsByKeyboard) {
  openPanel();
  QTest::keyClick(&window(), Qt::Key_L, Qt::ControlModifier);
  auto* ends = find<ChoiceField>("Ends");
  ASSERT_TRUE(ends);
  ends->setFocus();
  QTest::keyClick(ends, Qt::Key_Down);
  EXPECT_FALSE(find<NumberField>("Angle 1"));
  type("Distance 1", "700");
  type("Height 1", "180");
  ASSERT_TRUE(page().outcome().length);
  EXPECT_NEAR(page().outcome().length->length.value, bladeLength({700, 180, {}}).value().length, 1e-6);
  EXPECT_FALSE(page().outcome().length->length.error);
  type("Error of the height", "0.5");
  ASSERT_TRUE(page().outcome().length && page().outcome().length->length.error);
  EXPECT_GT(*page().outcome().length->length.error, 0);
  picture("measure-hinged");
}

TEST_F(MeasurePageTest, WalksThroughTheFieldsByTab) {
  openPanel();
  QTest::keyClick(&window(), Qt::Key_L, Qt::ControlModifier);
  QTest::mouseClick(button("Add measurement"), Qt::LeftButton);
  find<NumberField>("Distance 1")->setFocus();
  for (const char* next : {"Angle 1", "Height 1", "Temperature 1"}) {
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
    EXPECT_EQ(QApplication::focusWidget()->accessibleName(), next);
  }
  // The buttons of the line may take part, the next line follows before anything else.
  for (int i = 0; i < 4 && QApplication::focusWidget()->accessibleName() != "Distance 2"; ++i)
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
  EXPECT_EQ(QApplication::focusWidget()->accessibleName(), "Distance 2");
  EXPECT_EQ(page().table().chosen(), 1);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  EXPECT_FALSE(window().onMeasurePage());
  EXPECT_FALSE(window().onStartPage());
}

TEST_F(MeasurePageTest, MeasuresWithoutADesign) {
  ASSERT_TRUE(window().onStartPage());
  QTest::mouseClick(button(QString("Measure a blade") + QChar(0x2026)), Qt::LeftButton);
  ASSERT_TRUE(window().onMeasurePage());
  typeMeasurement(1, 760, 25, 135);
  EXPECT_TRUE(page().outcome().length);
  EXPECT_FALSE(page().useButton()->isEnabled());
  QTest::mouseClick(button("Back"), Qt::LeftButton);
  EXPECT_TRUE(window().onStartPage());
  // What was typed is there again, now for a design.
  openPanel();
  window().commands()["blade.measure"]->trigger();
  EXPECT_TRUE(page().outcome().length);
  EXPECT_TRUE(page().useButton()->isEnabled());
}

TEST_F(MeasurePageTest, FitsASmallScreen) {
  makeWindow({1280, 800});
  openPanel();
  window().commands()["blade.measure"]->trigger();
  for (int i = 2; i <= 4; ++i) QTest::mouseClick(button("Add measurement"), Qt::LeftButton);
  for (int i = 1; i <= 4; ++i) typeMeasurement(i, 776 - 10 * i, 25, hangs(800, 776 - 10 * i, 25) + 0.1 * i);
  EXPECT_EQ(window().size(), QSize(1280, 800));
  EXPECT_LE(window().minimumSizeHint().width(), 1280);
  EXPECT_LE(window().minimumSizeHint().height(), 800);
  picture("measure-small");
}

TEST_F(MeasurePageTest, EditsTheThermalExpansion) {
  openPanel();
  bench().select({Selection::Kind::blade, -1});
  type("Expansion", "17.5");
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
  EXPECT_NEAR(bench().design().blade.thermalExpansion, 17.5e-6, 1e-12);
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo change thermal expansion");
  picture("inspector-blade");
}

TEST(MeasuredBlade, NamesRowsAsThePageCountsThem) {
  Blade blade;
  MeasurementSheet sheet;
  // The second row has no height yet and is left out; the third is wrong.
  sheet.rows = {{700, 0.4, 190, 350}, {650, 0.4, 0, 350}, {700, 0.4, 5000, 350}};
  const MeasurementOutcome outcome = evaluateSheet(sheet, blade);
  EXPECT_EQ(outcome.measured, 2);
  EXPECT_FALSE(outcome.length);
  EXPECT_TRUE(outcome.problem.startsWith("Measurement 3: ")) << outcome.problem.toStdString();
  EXPECT_TRUE(outcome.rows[0].lengthAtCut);
  EXPECT_TRUE(outcome.rows[1].expected);
}

}  // namespace
}  // namespace bw::app
