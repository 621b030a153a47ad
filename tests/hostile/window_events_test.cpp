// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Random events on the window, from a fixed seed: mouse, keys, wheel, sizes, drops, steps back and forth,
// typed numbers, every command. Nothing crashes, and the design stays one that can be saved and read.
#include <QDrag>
#include <QPointer>

#include <array>
#include <cstdlib>
#include <iostream>
#include <random>

#include "bw/core/design/design.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

constexpr int kEvents = 600;  ///< of one round
constexpr unsigned kSeed = 20261122;

int rounds() {
  const char* text = std::getenv("BW_HOSTILE");
  return std::max(1, text ? std::atoi(text) : 1);
}

class RandomEvents : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    files_ = {path("saddle.step"),   path("garbage.step"),        path("missing.step"),
              path("a.bladewright"), path("garbage.bladewright"), folder_.path().toStdString()};
    ASSERT_TRUE(writeFile(files_[0], geometry::exampleStep("saddle").value()));
    ASSERT_TRUE(writeFile(files_[1], "ISO-10303-21; and then nothing"));
    ASSERT_TRUE(writeFile(files_[4], "{\"bladewright_design\": 1, \"job\": {\"stations\": 1e999}}"));
    answerQuestions();
    // Dialogs and menus that an event opened are left, by whatever way.
    QObject::connect(&closer_, &QTimer::timeout, [this] {
      QDrag::cancel();
      if (QWidget* popup = QApplication::activePopupWidget()) {
        popup->close();
      } else if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget())) {
        chance(2) ? dialog->reject() : dialog->accept();
      }
    });
    closer_.start(20);
  }

  int chance(int n) { return int(random_() % unsigned(n)); }
  template <class List>
  const auto& any(const List& list) {
    return list[std::size_t(chance(int(std::size(list))))];
  }

  void answerQuestions() {
    Questions& q = window().questions();
    const auto file = [this] { return chance(3) ? QString::fromStdString(any(files_).string()) : QString(); };
    q.openSurface = q.openDesign = file;
    q.saveDesign = [this](const QString&) { return QString::fromStdString(files_[3].string()); };
    q.savePicture = [this](const QString&) { return QString::fromStdString(path("a.png").string()); };
    q.exportFolder = [this] { return QString::fromStdString(path("out").string()); };
    q.pictureSize = [this](const QSize&) { return QSize(16 + chance(300), 16 + chance(300)); };
    q.unsaved = [this](const QString&) { return Questions::Unsaved(chance(3)); };
    q.changedOnDisk = [this](const QString&) { return Questions::Changed(chance(3)); };
    q.replaceFile = q.discardCopy = [this](const QString&) { return chance(2) == 0; };
    q.earlierExport = [this](const auto&, const auto&, const auto&) { return Workbench::Earlier(chance(3)); };
  }

  /// Something that is in sight, most often the deepest thing under a random point.
  QWidget* target() {
    QWidget* root = &window();
    const QPoint at(chance(std::max(1, root->width())), chance(std::max(1, root->height())));
    QWidget* widget = root->childAt(at);
    return widget ? widget : root;
  }

  Qt::KeyboardModifiers modifiers() {
    static constexpr std::array kAll = {Qt::NoModifier,    Qt::NoModifier,      Qt::NoModifier,
                                        Qt::ShiftModifier, Qt::ControlModifier, Qt::AltModifier};
    return any(kAll);
  }

  void mouse() {
    QWidget* widget = target();
    const auto at = [&] { return QPoint(chance(widget->width() + 1), chance(widget->height() + 1)); };
    static constexpr std::array kButtons = {Qt::LeftButton, Qt::LeftButton, Qt::RightButton,
                                            Qt::MiddleButton};
    const Qt::MouseButton button = any(kButtons);
    const QPointer<QWidget> alive = widget;
    if (chance(6) == 0) return QTest::mouseDClick(widget, button, modifiers(), at());
    QTest::mousePress(widget, button, modifiers(), at());
    for (int moves = chance(5); moves > 0 && alive; --moves) QTest::mouseMove(widget, at());
    if (alive) QTest::mouseRelease(widget, button, {}, at());
  }

  void key() {
    static constexpr std::array kKeys = {
        Qt::Key_Return, Qt::Key_Escape, Qt::Key_Tab,   Qt::Key_Backtab, Qt::Key_Space,  Qt::Key_Up,
        Qt::Key_Down,   Qt::Key_Left,   Qt::Key_Right, Qt::Key_Home,    Qt::Key_End,    Qt::Key_PageUp,
        Qt::Key_Delete, Qt::Key_F1,     Qt::Key_F5,    Qt::Key_F,       Qt::Key_X,      Qt::Key_P,
        Qt::Key_I,      Qt::Key_Z,      Qt::Key_Y,     Qt::Key_S,       Qt::Key_W,      Qt::Key_L,
        Qt::Key_K,      Qt::Key_1,      Qt::Key_4,     Qt::Key_Comma,   Qt::Key_Period, Qt::Key_Minus};
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus && focus->window() == &window() ? focus : &window(), any(kKeys), modifiers());
  }

  void number() {
    std::vector<NumberField*> fields;
    for (NumberField* field : window().findChildren<NumberField*>())
      if (field->isVisible() && field->isEnabled()) fields.push_back(field);
    if (fields.empty()) return;
    static const std::array<const char*, 20> kTexts = {
        "0,5",   "12,5",      "1/4",          "0.2cm",
        "-3",    "1e12",      "1e3",          "5-7",
        "600/4", "2*85+10",   "1e-9",         "nan",
        "inf",   "",          "1e999",        "((",
        "0x1F2", "3 mm 4 mm", "\u00b2\u00bd", "99999999999999999999"};
    NumberField* field = any(fields);
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, QString::fromUtf8(any(kTexts)));
    static constexpr std::array kEnds = {Qt::Key_Return, Qt::Key_Tab, Qt::Key_Escape};
    QTest::keyClick(field, any(kEnds));
  }

  void wheel() {
    QWidget* widget = target();
    const QPointF at(chance(widget->width() + 1), chance(widget->height() + 1));
    const QPoint turn(0, (chance(2) ? 120 : -120) * (1 + chance(4)));
    QWheelEvent event(at, widget->mapToGlobal(at), {}, turn, Qt::NoButton, modifiers(), Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(widget, &event);
  }

  void drop() {
    QMimeData mime;
    if (chance(5))
      mime.setUrls({QUrl::fromLocalFile(QString::fromStdString(any(files_).string()))});
    else
      mime.setText("no file");
    const QPoint at(chance(window().width()), chance(window().height()));
    QDragEnterEvent enter(at, Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &enter);
    QDropEvent event(QPointF(at), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &event);
  }

  void command() {
    QAction* action = any(window().commands().all());
    if (action->isEnabled()) action->trigger();
  }

  void history() {
    QUndoStack& stack = bench().document().undoStack();
    for (int steps = 1 + chance(4); steps > 0; --steps) chance(2) ? stack.undo() : stack.redo();
  }

  void event() {
    switch (chance(16)) {
      case 0:
      case 1:
      case 2:
      case 3:
        return mouse();
      case 4:
      case 5:
      case 6:
      case 7:
        return key();
      case 8:
      case 9:
        return number();
      case 10:
        return wheel();
      case 11:
        if (chance(4) == 0) window().resize(300 + chance(1700), 200 + chance(1300));
        return;
      case 12:
        if (chance(3) == 0) drop();
        return;
      case 13:
        return command();
      default:
        return history();
    }
  }

  /// A design that is written and read again is the same; steps back and forth end where they began.
  void expectConsistent() {
    model::Document& document = bench().document();
    const std::string text = designToJson(*document.design());
    const Result<Design> read = parseDesign(text);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(designToJson(*read), text);
    QUndoStack& stack = document.undoStack();
    const int index = stack.index();
    stack.setIndex(0);
    stack.setIndex(index);
    ASSERT_EQ(designToJson(*document.design()), text) << "the history does not lead back";
  }

  std::mt19937 random_{kSeed};
  std::vector<fs::path> files_;
  QTimer closer_;
};

TEST_F(RandomEvents, NeitherCrashTheWindowNorSpoilTheDesign) {
  const int events = kEvents * rounds();
  window().openExample("saddle");
  int designs = 0;
  for (int i = 1; i <= events; ++i) {
    SCOPED_TRACE(i);
    event();
    if (i % 4 == 0) QApplication::processEvents();
    // A command or a drop may have closed the window or the design: on with the next.
    if (!window().isVisible()) window().show();
    if (bench().document().empty() && chance(10) == 0 && !window().onMeasurePage()) {
      window().openExample("saddle");
      ++designs;
    }
    if (i % 50 == 0) {
      ASSERT_NO_FATAL_FAILURE(expectConsistent());
    }
  }
  bench().runner().cancel();
  ASSERT_TRUE(settle());
  ASSERT_NO_FATAL_FAILURE(expectConsistent());
  // It still works.
  window().resize(1280, 800);
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  window().openExample("panel-600x670");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  std::cout << "hostile window events: " << events << " events from seed " << kSeed << ", " << designs + 1
            << " designs opened, no crash, every design read back as it was written\n";
}

}  // namespace
}  // namespace bw::app
