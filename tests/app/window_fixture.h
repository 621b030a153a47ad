// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QCursor>
#include <QDropEvent>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QTest>

#include <filesystem>
#include <fstream>

#include "bw/core/files/file_set.h"
#include "bw/geometry/export.h"
#include "patience.h"
#include "window/main_window.h"
#include "window/options.h"

namespace bw::app {

namespace fs = std::filesystem;

/// A window on settings of its own.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    settings_ = std::make_unique<model::Settings>();
    settings_->setTheme(model::ThemeChoice::light);
    theme().apply(model::ThemeChoice::light);
    makeWindow({1440, 900});
  }

  void TearDown() override {
    if (window_) window_->questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  }

  static Theme& theme() {
    static Theme theme;
    return theme;
  }

  void makeWindow(const QSize& size) {
    window_ = std::make_unique<MainWindow>(*settings_, theme(), fs::path());
    window_->questions().showFolder = [](const QString&) {};
    window_->resize(size);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    // Shortcuts reach the active window only.
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  }

  MainWindow& window() { return *window_; }
  Workbench& bench() { return window_->bench(); }
  fs::path path(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }

  /// Waits until the result of the newest design stands.
  bool settle() {
    return QTest::qWaitFor([&] { return !bench().runner().busy(); }, kPatience);
  }

  /// Waits besides until nothing more is added to that result, where there is one.
  bool settleInFull() {
    return settle() &&
           QTest::qWaitFor([&] { return !bench().sweep() || bench().shownCut()->margins.value != nullptr; },
                           kPatience);
  }

  void openPanel(int stations = 20) {
    window().openExample("panel-600x670");
    bench().editDesign("Prepare", [stations](Design& design) { design.cut().sections.stations = stations; });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    bench().document().undoStack().clear();
  }

  std::size_t stationCount() { return bench().sweep() ? bench().sweep()->sweep.poses.size() : 0; }

  template <class T>
  T* find(const QString& accessibleName) {
    for (T* widget : window_->findChildren<T*>())
      if (widget->accessibleName() == accessibleName && widget->isVisible()) return widget;
    return nullptr;
  }

  /// Puts the cursor on a handle; its place then.
  QPoint hover(int handle) {
    view::SceneView& view = window_->sceneView();
    QPoint at;
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          // Panels that get other texts may still take room from the view.
          const auto place = [&] {
            return view.toWidget(view.sceneStyle().handles.points[std::size_t(handle)]).toPoint();
          };
          if (!view.resting()) return false;
          at = place();
          // A cursor that stands there already, from the window of another test, tells of no move.
          if (QCursor::pos() == view.mapToGlobal(at)) QTest::mouseMove(&view, at + QPoint(2, 0));
          QTest::mouseMove(&view, at);
          return view.sceneStyle().handles.lit == handle && place() == at;
        },
        kPatience))
        << handle << " is not lit, but " << view.sceneStyle().handles.lit;
    return at;
  }

  /// The window as the user sees it, kept for the eye.
  QImage picture(const std::string& name) {
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return window_->onStartPage() || window_->sceneView().resting(); }, kPatience));
    QTest::qWait(0);
    const QImage image = window_->grab().toImage();
    fs::create_directories(BW_TEST_OUTPUT "/window");
    const char* scale = qEnvironmentVariableIsSet("QT_SCALE_FACTOR") ? "-200" : "";
    image.save(QString::fromStdString(BW_TEST_OUTPUT "/window/" + name + scale + ".png"));
    return image;
  }

  /// Runs something that opens a dialog and answers that dialog once it stands.
  void answer(const std::function<void()>& open, const std::string& pictureName,
              const std::function<void(QDialog&)>& reply) {
    QDialog* met = nullptr;
    QTimer timer;
    timer.setInterval(20);
    QObject::connect(&timer, &QTimer::timeout, [&] {
      auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (!dialog || met || !dialog->isVisible()) return;
      met = dialog;
      fs::create_directories(BW_TEST_OUTPUT "/window");
      const char* scale = qEnvironmentVariableIsSet("QT_SCALE_FACTOR") ? "-200" : "";
      dialog->grab().save(QString::fromStdString(BW_TEST_OUTPUT "/window/" + pictureName + scale + ".png"));
      reply(*dialog);
    });
    timer.start();
    open();
    EXPECT_TRUE(met) << "no dialog came";
  }

  QTemporaryDir folder_;
  std::unique_ptr<model::Settings> settings_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace bw::app
