// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Hands that do anything: random edits, keys and clicks on designs of every kind. Whatever they did, the
// design that is saved is the one that is opened, undo leads back to where they began, and the window stands.
//
// BW_MONKEY_ACTIONS and BW_MONKEY_SEED make them busier, or others.

#include <cstdlib>
#include <random>

#include "bw/core/design/design.h"
#include "controls/fields.h"
#include "controls/number_field.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

int setting(const char* name, int fallback) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : fallback;
}

class Monkey : public WindowTest, public testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    random_.seed(std::uint32_t(setting("BW_MONKEY_SEED", 11)) ^
                 std::uint32_t(std::hash<std::string>()(GetParam())));
    Questions& questions = window().questions();
    questions.unsaved = [](const QString&) { return Questions::Unsaved::discard; };
    questions.openSurface = questions.openDesign = questions.exportFolder = [] { return QString(); };
    questions.saveDesign = questions.savePicture = [](const QString&) { return QString(); };
    questions.pictureSize = [](const QSize&) { return QSize(); };
  }

  int upTo(int last) { return std::uniform_int_distribution<int>(0, last)(random_); }

  template <class Widget>
  Widget* any() {
    std::vector<Widget*> seen;
    for (Widget* widget : window().template findChildren<Widget*>())
      if (widget->isVisible() && widget->isEnabled()) seen.push_back(widget);
    return seen.empty() ? nullptr : seen[std::size_t(upTo(int(seen.size()) - 1))];
  }

  void type() {
    auto* field = any<NumberField>();
    if (!field) return;
    static const char* const kTexts[] = {"0",    "1",      "-1",    "17",   "250",  "650",
                                         "0,5",  "1e3",    "=",     "=1/0", "3 cm", "-3.25",
                                         "1e99", "=650/2", "width", "..",   "12;13"};
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, kTexts[upTo(int(std::size(kTexts)) - 1)]);
    QTest::keyClick(field, upTo(5) == 0 ? Qt::Key_Escape : Qt::Key_Return);
  }

  void choose() {
    if (auto* field = any<ChoiceField>(); field && field->count() > 0) {
      const int index = upTo(field->count() - 1);
      field->setCurrentIndex(index);
      emit field->activated(index);
    }
  }

  void press() {
    auto* button = any<QAbstractButton>();
    static const QStringList kLeave = {"File", "Close", "Quit"};
    if (button && !kLeave.contains(button->text())) button->click();
  }

  void command() {
    std::vector<QAction*> actions;
    for (QAction* action : window().findChildren<QAction*>())
      for (const char* kind : {"edit.undo", "edit.redo", "edit.cancel", "view.", "motion.", "station.",
                               "panel.", "tab.", "design.", "input."})
        if (action->isEnabled() && action->objectName().startsWith(kind)) actions.push_back(action);
    if (!actions.empty()) actions[std::size_t(upTo(int(actions.size()) - 1))]->trigger();
  }

  void drag() {
    view::SceneView& view = window().sceneView();
    const auto place = [&] { return QPoint(upTo(view.width() - 1), upTo(view.height() - 1)); };
    const std::vector<Eigen::Vector3d>& handles = view.sceneStyle().handles.points;
    const QPoint from = handles.empty() || upTo(3) == 0
                            ? place()
                            : view.toWidget(handles[std::size_t(upTo(int(handles.size()) - 1))]).toPoint();
    const Qt::MouseButton button = upTo(4) == 0 ? Qt::RightButton : Qt::LeftButton;
    const Qt::KeyboardModifiers keys = upTo(3) == 0   ? Qt::ShiftModifier
                                       : upTo(3) == 0 ? Qt::ControlModifier
                                                      : Qt::NoModifier;
    QTest::mousePress(&view, button, keys, from);
    for (int i = upTo(3); i > 0; --i) QTest::mouseMove(&view, from + QPoint(upTo(60) - 30, upTo(60) - 30));
    if (upTo(6) == 0) QTest::keyClick(&view, Qt::Key_Escape);
    QTest::mouseRelease(&view, button, keys, from);
  }

  void act() {
    switch (upTo(9)) {
      case 0:
        return press();
      case 1:
      case 2:
        return choose();
      case 3:
      case 4:
        return command();
      case 5:
        return drag();
      case 6:
        QTest::qWait(upTo(30));
        return;
      default:
        return type();
    }
  }

  /// What is saved is what is opened, directions of travel as long as 1.
  void saveAndOpen(int action) {
    const fs::path file = path("monkey.bladewright");
    const Design design = bench().design();
    const Result<void> saved = saveDesign(design, file);
    ASSERT_TRUE(saved) << action << ": " << saved.error().message;
    const Result<Design> opened = loadDesign(file);
    ASSERT_TRUE(opened) << action << ": " << opened.error().message;
    Design kept = design;
    // Those that expressions tell stay as told.
    const auto bound = [&](std::size_t cut) {
      const std::string place = "/cuts/" + std::to_string(cut) + "/direction/";
      const auto first = design.bindings.lower_bound(place);
      return first != design.bindings.end() && first->first.starts_with(place);
    };
    for (std::size_t i = 0; i < kept.cuts.size(); ++i)
      if (kept.cuts[i].direction && !bound(i)) kept.cuts[i].direction->normalize();
    EXPECT_EQ(designToJson(*opened), designToJson(kept)) << action;
  }

  std::mt19937 random_;
};

TEST_P(Monkey, DoesNoHarm) {
  ASSERT_TRUE(window().openExample(QString::fromStdString(GetParam())));
  ASSERT_TRUE(settle());
  const std::string before = designToJson(bench().design());
  const int actions = setting("BW_MONKEY_ACTIONS", 120);
  // A dialog that comes up is given up.
  QTimer timer;
  timer.setInterval(20);
  QObject::connect(&timer, &QTimer::timeout, [] {
    if (QWidget* modal = QApplication::activeModalWidget()) modal->close();
    if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
  });
  timer.start();
  for (int i = 0; i < actions; ++i) {
    act();
    QCoreApplication::processEvents();
    if (window().onStartPage()) {
      ASSERT_TRUE(window().openExample(QString::fromStdString(GetParam())));
    } else if (i % 20 == 19 && !bench().document().empty()) {
      saveAndOpen(i);
      if (HasFatalFailure()) return;
    }
  }
  // All that was done can be taken back.
  if (window().sceneView().holding()) window().sceneView().letGo();
  bench().document().undoStack().setIndex(0);
  ASSERT_TRUE(settle());
  EXPECT_EQ(designToJson(bench().design()), before);
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
}

INSTANTIATE_TEST_SUITE_P(, Monkey,
                         testing::Values("single-block", "ripple-along", "key-blade-fan", "three-block-wall",
                                         "two-crossing-cuts", "saddle"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace bw::app
