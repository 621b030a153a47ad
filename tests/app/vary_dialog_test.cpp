// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A variable over a range, from the button below the variables to the value that is taken over.
#include <QClipboard>
#include <QPointer>

#include <csignal>

#include "bw/pipeline/exit_status.h"
#include "window/desktop.h"
#include "window_fixture.h"
#include "workflow/vary_dialog.h"

namespace bw::app {
namespace {

class Vary : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    window().openExample("ripple-along");
    bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 9; });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    button(window().workflow(), "Vary…")->click();
    dialog_ = window().findChild<VaryDialog*>();
    ASSERT_TRUE(dialog_);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog_));
  }

  void TearDown() override {
    delete dialog_;
    WindowTest::TearDown();
  }

  static QPushButton* button(QWidget& in, const QString& text) {
    for (QPushButton* one : in.findChildren<QPushButton*>())
      if (one->text() == text) return one;
    return nullptr;
  }
  NumberField* field(int index) { return dialog_->findChildren<NumberField*>()[index]; }
  void type(int index, const QString& text) {
    NumberField* one = field(index);
    // What is typed is taken when the focus goes, which only an active window has.
    dialog_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(dialog_));
    one->setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return one->hasFocus(); }, kPatience));
    one->selectAll();
    QTest::keyClicks(one, text);
    QTest::keyClick(one, Qt::Key_Tab);
  }
  bool computed() {
    return QTest::qWaitFor([&] { return !dialog_->computing(); }, kPatience);
  }
  QString cell(int row, int column) { return dialog_->table().item(row, column)->text(); }

  VaryDialog* dialog_ = nullptr;
};

TEST_F(Vary, TellsWhatTheDesignComesToWithEachValueAndTakesOne) {
  type(0, "10");
  type(1, "20");
  type(2, "3");
  EXPECT_EQ(field(0)->value(), 10);
  EXPECT_EQ(field(1)->value(), 20);
  EXPECT_EQ(field(2)->value(), 3);
  button(*dialog_, "Compute")->click();
  EXPECT_TRUE(dialog_->computing());
  EXPECT_FALSE(button(*dialog_, "Compute")->isEnabled());
  ASSERT_TRUE(computed());
  ASSERT_EQ(dialog_->table().rowCount(), 3);
  EXPECT_EQ(cell(0, 0), "10");
  EXPECT_EQ(cell(1, 0), "15");
  EXPECT_EQ(cell(2, 0), "20");
  for (int row = 0; row < 3; ++row) {
    const auto picture = dialog_->table().item(row, 0)->data(Qt::DecorationRole).value<QPixmap>();
    ASSERT_FALSE(picture.isNull()) << row;
    if (row > 0) {
      EXPECT_NE(picture.toImage(),
                dialog_->table().item(row - 1, 0)->data(Qt::DecorationRole).value<QPixmap>().toImage());
    }
  }
  dialog_->grab().save(QString::fromStdString(BW_TEST_OUTPUT "/window/vary.png"));
  button(*dialog_, "Copy table")->click();
  EXPECT_TRUE(QApplication::clipboard()->text().startsWith("amplitude,status,deviation_max_mm,"));
  EXPECT_EQ(QApplication::clipboard()->text().count('\n'), 4);
  EXPECT_FALSE(button(*dialog_, "Take this value")->isEnabled());
  const_cast<QTableWidget&>(dialog_->table()).selectRow(1);
  button(*dialog_, "Take this value")->click();
  EXPECT_EQ(bench().design().variables[0].value, 15);
  ASSERT_TRUE(settle());
  // The line tells what the design then comes to.
  const double deviation = bench().shown()->cut().analysis.value->summary.deviationMax;
  EXPECT_NEAR(cell(1, 2).split(' ').first().toDouble(), deviation, 0.01 * deviation);
  bench().document().undoStack().undo();
  EXPECT_NE(bench().design().variables[0].value, 15);
}

TEST_F(Vary, IsStoppedWithWhatItHasAndLeavesTheDesignAsItIs) {
  const Design before = bench().design();
  type(2, "100");
  button(*dialog_, "Compute")->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return dialog_->table().rowCount() > 0; }, kPatience));
  button(*dialog_, "Stop")->click();
  ASSERT_TRUE(computed());
  EXPECT_LT(dialog_->table().rowCount(), 100);
  EXPECT_TRUE(button(*dialog_, "Compute")->isEnabled());
  EXPECT_EQ(bench().design(), before);
  EXPECT_TRUE(bench().current()) << "the result stands";
  // What the window computes besides goes on.
  button(*dialog_, "Compute")->click();
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 11; });
  button(*dialog_, "Stop")->click();
  ASSERT_TRUE(computed());
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_EQ(bench().shown()->result()->size(), 11u);
  // Closed while it computes.
  button(*dialog_, "Compute")->click();
  dialog_->close();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().runner().busy(); }, kPatience));
  dialog_ = nullptr;
}

/// The program goes on until `end` ends it, as its main function does, while the dialog computes.
class VaryEnds : public Vary {
 protected:
  int runUntil(const std::function<void()>& end) {
    type(2, QString::number(pipeline::VaryRange::kMost));
    button(*dialog_, "Compute")->click();
    EXPECT_TRUE(QTest::qWaitFor([&] { return dialog_->table().rowCount() > 0; }, kPatience));
    EXPECT_TRUE(dialog_->computing());
    EXPECT_LT(dialog_->table().rowCount(), pipeline::VaryRange::kMost / 2);
    left_ = dialog_;
    dialog_ = nullptr;
    QTimer::singleShot(0, end);
    return QApplication::exec();
  }
  /// What main does then.
  void destroy() {
    QElapsedTimer clock;
    clock.start();
    window_.reset();
    EXPECT_LT(clock.elapsed(), kPatience / 4) << "it is not waited for all of the values";
    EXPECT_FALSE(left_);
  }
  QPointer<VaryDialog> left_;
};

TEST_F(VaryEnds, BySignal) {
  {
    const EndOfSession ending(window());
    EXPECT_EQ(runUntil([] { ::raise(SIGTERM); }), pipeline::kInterrupted);
  }
  EXPECT_TRUE(bench().runner().busy()) << "what is computed does not hold up the end";
  destroy();
}

TEST_F(VaryEnds, WithTheWindow) {
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  EXPECT_EQ(runUntil([this] { EXPECT_TRUE(window().close()); }), 0);
  EXPECT_FALSE(left_) << "it goes with the window that it belongs to";
  destroy();
}

TEST_F(Vary, RefusesARangeThatIsNone) {
  type(0, "20");
  type(1, "20");
  button(*dialog_, "Compute")->click();
  EXPECT_FALSE(dialog_->computing());
  type(1, "1000");
  button(*dialog_, "Compute")->click();
  EXPECT_FALSE(dialog_->computing()) << "beyond the range of the variable";
}

}  // namespace
}  // namespace bw::app
