// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Keys of the pages, the guide, what tells that something is on, that it is broken or old, and which words it
// uses.
#include <QComboBox>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBrowser>
#include <algorithm>

#include "window_fixture.h"

namespace bw::app {
namespace {

class WindowKeys : public WindowTest {
 protected:
  static QString focusName() {
    const QWidget* widget = QApplication::focusWidget();
    return widget ? widget->objectName() : QString();
  }
  /// The colour of a label's letters: of the pixel that is least like the ground, its icon left out.
  static QColor ink(QLabel& label) {
    const QImage image = label.grab(label.contentsRect()).toImage();
    const QColor ground = image.pixelColor(0, 0);
    const auto contrast = [&](const QColor& c) {
      return std::abs(c.red() - ground.red()) + std::abs(c.green() - ground.green()) +
             std::abs(c.blue() - ground.blue());
    };
    QColor most = ground;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (contrast(image.pixelColor(x, y)) > contrast(most)) most = image.pixelColor(x, y);
    return most;
  }
  static bool red(const QColor& c) { return c.red() - std::max(c.green(), c.blue()) > 60; }
  static void press(Qt::Key key) { QTest::keyClick(QApplication::focusWidget(), key); }
};

TEST_F(WindowKeys, LeadThroughTheStartPage) {
  ASSERT_TRUE(window().onStartPage());
  EXPECT_EQ(focusName(), "primary") << "the keyboard has no place on the first page";
  const auto& cards = window().startPage().cards();
  press(Qt::Key_Right);
  EXPECT_EQ(qobject_cast<QPushButton*>(QApplication::focusWidget())->text(), "Open design…");
  press(Qt::Key_Left);
  press(Qt::Key_Down);
  EXPECT_EQ(QApplication::focusWidget(), cards[0]);
  press(Qt::Key_Right);
  EXPECT_EQ(QApplication::focusWidget(), cards[1]);
  press(Qt::Key_Down);
  EXPECT_EQ(QApplication::focusWidget(), cards[5]) << "four in a row";
  press(Qt::Key_Up);
  press(Qt::Key_Left);
  press(Qt::Key_Left);
  EXPECT_EQ(QApplication::focusWidget(), cards[0]) << "the first of a row has none before it";
  press(Qt::Key_Tab);
  EXPECT_EQ(QApplication::focusWidget(), cards[1]);
  picture("start-keys");
  press(Qt::Key_Return);
  EXPECT_FALSE(window().onStartPage());
  EXPECT_TRUE(window().sceneView().hasFocus());
  ASSERT_TRUE(settle());
}

TEST_F(WindowKeys, OpenTheQuestionForAFileByEnter) {
  bool asked = false;
  window().questions().openSurface = [&] {
    asked = true;
    return QString();
  };
  press(Qt::Key_Return);
  EXPECT_TRUE(asked);
}

TEST_F(WindowKeys, OpenTheGuideAndTheListOfKeys) {
  QTest::keyClick(&window(), Qt::Key_F1);
  GuideWindow& guide = window().guide();
  ASSERT_TRUE(guide.isVisible());
  EXPECT_FALSE(guide.isModal()) << "it is read beside the work";
  EXPECT_TRUE(guide.guide().toPlainText().contains("the workflow")) << "the guide is not in the program";
  const QString keys = guide.keys().toPlainText();
  for (const QAction* action : window().commands().all())
    for (const QKeySequence& key : action->shortcuts()) {
      EXPECT_TRUE(keys.contains(key.toString(QKeySequence::NativeText))) << key.toString().toStdString();
      EXPECT_TRUE(keys.contains(commandText(*action))) << commandText(*action).toStdString();
    }
  QTest::qWait(0);
  fs::create_directories(BW_TEST_OUTPUT "/window");
  guide.grab().save(BW_TEST_OUTPUT "/window/guide.png");
  const QList<QTextBrowser*> pages = guide.findChildren<QTextBrowser*>();
  QTextBrowser& page = **std::ranges::find(pages, &guide.guide());
  EXPECT_EQ(page.horizontalScrollBar()->maximum(), 0) << "a picture is wider than the page";
  for (const char* picture : {"hanging-blade.svg", "two-shapes.svg"})
    EXPECT_TRUE(page.loadResource(QTextDocument::ImageResource, QUrl(picture)).isValid()) << picture;
  ASSERT_TRUE(page.find("Will it be there"));
  QScrollBar& rail = *page.verticalScrollBar();
  rail.setValue(rail.value() + page.viewport()->height() / 2);
  guide.grab().save(BW_TEST_OUTPUT "/window/guide-shapes.png");
  guide.findChild<QTabWidget*>()->setCurrentIndex(1);
  guide.grab().save(BW_TEST_OUTPUT "/window/keys.png");
  guide.close();
}

TEST_F(WindowKeys, TickWhatIsOn) {
  openPanel();
  const auto grey = [](const QAction& action, QIcon::State state) {
    return action.icon()
        .pixmap({20, 20}, 1.0, QIcon::Normal, state)
        .toImage()
        .convertToFormat(QImage::Format_Alpha8);
  };
  for (const QAction* action : window().commands().all()) {
    if (!action->isCheckable()) continue;
    EXPECT_FALSE(action->icon().isNull()) << action->objectName().toStdString();
    EXPECT_NE(grey(*action, QIcon::On), grey(*action, QIcon::Off))
        << action->objectName().toStdString() << " tells by its colour alone whether it is on";
  }
  EXPECT_TRUE(window().commands()["map.deviation"]->isChecked());
  window().commands()["map.angle"]->trigger();
  EXPECT_FALSE(window().commands()["map.deviation"]->isChecked());
  EXPECT_TRUE(window().commands()["map.angle"]->isChecked());
  window().commands()["map.angle"]->trigger();
  EXPECT_TRUE(window().commands()["map.angle"]->isChecked())
      << "a map cannot be switched off by choosing it again";
  for (QMenu* menu : window().findChildren<QMenu*>())
    if (menu->title() == "Th&eme" || menu->title() == "&Map") {
      menu->popup({100, 100});
      menu->grab().save(
          QString(BW_TEST_OUTPUT "/window/menu-%1.png").arg(QString(menu->title()).remove('&')));
      menu->hide();
    }
}

TEST_F(WindowKeys, LeaveAPresetItsNameWhenTheLengthChanges) {
  openPanel();
  auto* preset = find<ChoiceField>("Blade");
  auto* length = find<NumberField>("Blade length");
  ASSERT_TRUE(preset && length);
  const int before = preset->currentIndex();
  const std::string name = bench().design().blade.name;
  ASSERT_NE(name, "custom");
  length->setFocus();
  length->selectAll();
  QTest::keyClicks(length, "905");
  QTest::keyClick(length, Qt::Key_Return);
  EXPECT_EQ(bench().design().blade.length, 905);
  EXPECT_EQ(preset->currentIndex(), before);
  EXPECT_EQ(bench().design().blade.name, name);
  // The remedy for a short blade changes no more than the length either.
  bench().editDesign("Change blade length", [](Design& design) { design.blade.length = 500; });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(window().banner().action()->isVisible());
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  EXPECT_EQ(preset->currentIndex(), before);
  EXPECT_EQ(bench().design().blade.name, name);
  // Another tool is no preset, whatever it calls itself.
  bench().editDesign("Change", [](Design& design) { design.blade.yieldStress *= 2; });
  EXPECT_EQ(preset->currentText(), "Custom");
  ASSERT_TRUE(settle());
}

TEST_F(WindowKeys, ShowBrokenNumbersInRedWithAnIconAndOldOnesPale) {
  openPanel();
  const auto valueOf = [&](const QString& name) {
    for (ValueLabel* label : window().inspector().findChildren<ValueLabel*>())
      if (label->accessibleName() == name && label->isVisible()) return label;
    return static_cast<ValueLabel*>(nullptr);
  };
  ASSERT_TRUE(valueOf("Surface shown"));
  EXPECT_FALSE(valueOf("Surface shown")->broken());
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.001; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(valueOf("Surface shown")->broken());
  EXPECT_TRUE(valueOf("Within tolerance")->broken());
  EXPECT_FALSE(valueOf("Steepest cut")->broken());
  ASSERT_GE(window().summaryLine().labels().size(), 5u);
  EXPECT_TRUE(window().summaryLine().labels()[1]->broken());
  EXPECT_FALSE(window().summaryLine().labels()[4]->broken());
  ValueLabel &deviation = *window().summaryLine().labels()[1], &bend = *window().summaryLine().labels()[4];
  const QColor loud = ink(deviation), calm = ink(bend);
  EXPECT_TRUE(red(loud)) << loud.name().toStdString();
  EXPECT_FALSE(red(calm)) << calm.name().toStdString();
  EXPECT_TRUE(red(ink(*valueOf("Surface shown")))) << ink(*valueOf("Surface shown")).name().toStdString();
  picture("broken-numbers");
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 4000; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return valueOf("Surface shown")->stale(); }, kPatience));
  EXPECT_TRUE(window().summaryLine().labels()[1]->stale());
  EXPECT_TRUE(red(ink(deviation))) << ink(deviation).name().toStdString();
  EXPECT_GT(ink(deviation).green(), loud.green() + 40) << "as loud as before";
  EXPECT_GT(ink(bend).green(), calm.green() + 30) << "as dark as before";
  picture("stale-numbers");
  bench().document().undoStack().setIndex(0);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(valueOf("Surface shown")->stale());
  EXPECT_FALSE(valueOf("Surface shown")->broken());
}

TEST_F(WindowKeys, TellTheStressOfTheBladeThatWasCutWith) {
  openPanel();
  bench().select({Selection::Kind::blade, -1});
  const auto valueOf = [&](const QString& name) {
    for (ValueLabel* label : window().inspector().findChildren<ValueLabel*>())
      if (label->accessibleName() == name && label->isVisible()) return label;
    return static_cast<ValueLabel*>(nullptr);
  };
  ASSERT_TRUE(valueOf("Largest stress") && valueOf("Rigidity"));
  const QString stress = valueOf("Largest stress")->text(), rigidity = valueOf("Rigidity")->text();
  bench().editDesign("Change", [](Design& design) {
    design.cut().sections.stations = 4000;
    design.blade.youngModulus *= 2;
    design.blade.yieldStress *= 2;
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return valueOf("Largest stress")->stale(); }, kPatience));
  EXPECT_EQ(valueOf("Largest stress")->text(), stress) << "the radius of one blade, the strength of another";
  EXPECT_NE(valueOf("Rigidity")->text(), rigidity);
  EXPECT_FALSE(valueOf("Rigidity")->stale()) << "a number of the present design is never old";
  bench().document().undoStack().setIndex(0);
  ASSERT_TRUE(settle());
}

TEST_F(WindowKeys, SpeakNoWordOfTheCommandLine) {
  openPanel();
  bench().editDesign("Change block", [](Design& design) {
    design.block().placement = BlockPlacement{{5000, 0, 0}, {100, 100, 100}, Eigen::Vector3d::Zero()};
  });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().runner().error());
  QStringList texts = {window().banner().text()};
  for (int i = 0; i < window().messageList().count(); ++i) texts << window().messageList().item(i)->text();
  for (const QAction* action : window().commands().all()) texts << action->text() << action->toolTip();
  for (const QWidget* widget : window().findChildren<QWidget*>()) {
    texts << widget->toolTip() << widget->accessibleName() << widget->accessibleDescription();
    if (const auto* label = qobject_cast<const QLabel*>(widget)) texts << label->text();
    if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) texts << button->text();
    if (const auto* choice = qobject_cast<const QComboBox*>(widget))
      for (int i = 0; i < choice->count(); ++i) texts << choice->itemText(i);
  }
  static const QRegularExpression code(
      "(^|[ (])--[a-z]|[a-z]_[a-z]|\"auto\"|blade (check|render|export|rationalize)");
  for (const QString& text : texts) EXPECT_FALSE(text.contains(code)) << text.toStdString();
  QTest::keyClick(&window(), Qt::Key_F1);
  static const QRegularExpression inGuide("\"auto\"|SIG[A-Z]+|status [0-9]|blade [a-z]+ ?,.*render");
  for (const QTextBrowser* page : window().guide().findChildren<QTextBrowser*>()) {
    const auto found = inGuide.match(page->toPlainText());
    EXPECT_FALSE(found.hasMatch()) << found.captured().toStdString();
  }
  window().guide().close();
}

}  // namespace
}  // namespace bw::app
