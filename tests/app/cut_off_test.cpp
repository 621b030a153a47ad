// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// No word of the window is cut off, however small the window is.
#include <QAbstractButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QTabBar>
#include <QToolButton>

#include <set>

#include "bw/core/design/design_versions.h"
#include "controls/fields.h"
#include "plots/motion_view.h"
#include "window_fixture.h"
#include "workflow/workflow_panel.h"

namespace bw::app {
namespace {

class NothingIsCutOff : public WindowTest {
 protected:
  static std::string nameOf(const QWidget& widget) {
    const auto* label = qobject_cast<const QLabel*>(&widget);
    const auto* button = qobject_cast<const QAbstractButton*>(&widget);
    const QString text = label ? label->text() : button ? button->text() : widget.accessibleName();
    return (QString(widget.metaObject()->className()) + " \"" + text + "\"").toStdString();
  }

  /// Scrolls the widget into sight; its part that its panels show, in its own coordinates.
  static QRect seenPart(QWidget& widget) {
    for (QWidget* at = widget.parentWidget(); at; at = at->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(at)) {
        // By its corners: a line that is typed into would only bring its cursor into sight.
        for (const QPoint& corner : {QPoint(), QPoint(widget.width(), widget.height())}) {
          const QPoint place = widget.mapTo(area->widget(), corner);
          area->ensureVisible(place.x(), place.y(), 0, 0);
        }
      }
    QRect seen = widget.rect();
    for (QWidget *at = &widget, *above = at->parentWidget(); above;
         at = above, above = above->parentWidget()) {
      const QPoint place = widget.mapTo(above, QPoint());
      seen &= above->rect().translated(-place);
      if (at->isWindow()) break;
    }
    return seen;
  }

  /// Widgets that paint their own text.
  static void expectWhole(QWidget& widget) {
    SCOPED_TRACE(nameOf(widget));
    const QRect seen = seenPart(widget);
    EXPECT_EQ(seen.width(), widget.width()) << "a side is hidden";
    if (widget.height() < 200) {
      EXPECT_EQ(seen.height(), widget.height()) << "its top or bottom is hidden";
    }
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) {
      if (label->text().isEmpty()) return;
      const QRect room = label->contentsRect();
      if (label->wordWrap()) {
        EXPECT_LE(label->heightForWidth(label->width()), label->height());
      } else if (label->textFormat() != Qt::RichText && !label->text().startsWith('<')) {
        EXPECT_LE(label->fontMetrics().size(0, label->text()).width(), room.width());
      }
    } else if (const auto* tool = qobject_cast<const QToolButton*>(&widget)) {
      EXPECT_LE(tool->sizeHint().width(), tool->width());
    } else if (const auto* head = qobject_cast<const StepHead*>(&widget)) {
      EXPECT_LE(head->textWidth(), head->width());
    } else if (qobject_cast<const QAbstractButton*>(&widget)) {
      EXPECT_LE(widget.sizeHint().width(), widget.width());
    } else if (const auto* choice = qobject_cast<const ChoiceField*>(&widget)) {
      EXPECT_LE(choice->fontMetrics().horizontalAdvance(choice->shownText()), choice->textWidth())
          << choice->shownText().toStdString();
    } else if (const auto* line = qobject_cast<const QLineEdit*>(&widget)) {
      EXPECT_LE(line->fontMetrics().horizontalAdvance(line->displayText()),
                line->width() - 16 - line->textMargins().right())
          << line->displayText().toStdString();
    } else if (const auto* bar = qobject_cast<const QTabBar*>(&widget)) {
      for (int tab = 0; tab < bar->count(); ++tab)
        EXPECT_TRUE(bar->rect().contains(bar->tabRect(tab))) << bar->tabText(tab).toStdString();
    }
  }

  void expectAllWhole(const char* state) {
    SCOPED_TRACE(state);
    // Not a state on its way to the next one: new widths go from layout to layout by posted requests.
    QTest::qWait(20);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
    for (QWidget* widget : window().findChildren<QWidget*>()) {
      if (!widget->isVisible() || widget->inherits("QTabBarToolButton") ||
          widget->objectName() == "qt_toolbar_ext_button")
        continue;
      if (qobject_cast<QLabel*>(widget) || qobject_cast<QAbstractButton*>(widget) ||
          qobject_cast<ChoiceField*>(widget) || qobject_cast<QLineEdit*>(widget) ||
          qobject_cast<QTabBar*>(widget))
        expectWhole(*widget);
    }
  }

  void tryStates() {
    expectAllWhole("start page");
    openPanel(10);
    for (QToolButton* fold : window().workflow().findChildren<QToolButton*>())
      if (fold->isCheckable() && !fold->isChecked()) fold->click();
    expectAllWhole("panel");
    picture("cut-off-panel-" + std::to_string(window().width()));
    for (const char* map : {"curvature", "stress", "speed"}) {
      window().commands()[QString("map.") + map]->trigger();
      ASSERT_TRUE(settle());
      expectAllWhole(map);
    }
    for (const auto& [kind, name] : {std::pair{Selection::Kind::surface, "surface"},
                                     {Selection::Kind::block, "block"},
                                     {Selection::Kind::blade, "blade"},
                                     {Selection::Kind::station, "station"}}) {
      bench().select({kind, kind == Selection::Kind::station ? 3 : -1});
      expectAllWhole(name);
    }
    bench().editDesign("Prepare", [](Design& design) {
      design.cut().direction = Eigen::Vector3d(0.1, 1, 0);
      design.block().placement = BlockPlacement{{-1234.5, -10, -200}, {1700, 1700, 600}, {0.1, 0.2, 0.3}};
      design.cut().face.kind = FaceChoice::Kind::nearest;
      design.cut().sections.spacing = 25;
    });
    ASSERT_TRUE(settle());
    for (const char* tab : {"tab.section", "tab.motion", "tab.messages", "tab.blocks", "tab.versions"}) {
      window().commands()[tab]->trigger();
      expectAllWhole(tab);
    }
    picture("cut-off-block-" + std::to_string(window().width()));
    bench().editDesign("Name", [](Design& design) { design = *withVersion(design, "as ordered"); });
    bench().editDesign("Change", [](Design& design) { design.process.tolerance = 1; });
    window().commands()["compare.version"]->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window().comparison().busy(); }, kPatience));
    ASSERT_TRUE(settle());
    QTest::qWait(200);
    expectAllWhole("compared");
    EXPECT_LE(window().besideView().mapTo(&window(), QPoint(window().besideView().width(), 0)).x(),
              window().sideTabs().mapTo(&window(), QPoint()).x())
        << "the panel lies over the picture";
    picture("cut-off-compared-" + std::to_string(window().width()));
    window().commands()["compare.version"]->trigger();
    window().showMeasurePage();
    expectAllWhole("measure page");
    picture("cut-off-measure-" + std::to_string(window().width()));
  }
};

/// Looks at every picture that the window draws of a label: the shortest moment of a cut one is seen.
class PaintedLabels : public QObject {
 public:
  PaintedLabels() { qApp->installEventFilter(this); }
  std::set<std::string> cut;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    const auto* label = event->type() == QEvent::Paint ? qobject_cast<QLabel*>(watched) : nullptr;
    if (label && !label->wordWrap() && label->textFormat() != Qt::RichText &&
        !label->text().startsWith('<') &&
        label->fontMetrics().size(0, label->text()).width() > label->contentsRect().width())
      cut.insert(label->text().toStdString());
    return false;
  }
};

TEST_F(NothingIsCutOff, WhileTheFirstResultComes) {
  makeWindow({1920, 1080});
  const PaintedLabels painted;
  // The display may uncover the window at any moment.
  QObject::connect(&window().bench(), &Workbench::changed, &window(), [this] {
    QExposeEvent uncovered(window().rect());
    QCoreApplication::sendEvent(window().windowHandle(), &uncovered);
  });
  for (const char* example : {"single-block", "three-block-wall"}) {
    ASSERT_TRUE(window().openExample(example));
    ASSERT_TRUE(settleInFull());
  }
  for (const std::string& text : painted.cut) ADD_FAILURE() << text;
}

TEST_F(NothingIsCutOff, AndThePanelKeepsItsWidth) {
  for (const QSize& size : {QSize(960, 600), QSize(1920, 1080)}) {
    makeWindow(size);
    for (const char* example : {"single-block", "two-crossing-cuts", "twist", "key-blade-fan"}) {
      SCOPED_TRACE(example);
      ASSERT_TRUE(window().openExample(example));
      QTest::qWait(20);
      QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
      const int width = window().workflow().width();
      const int left = window().sceneView().mapTo(&window(), QPoint()).x();
      ASSERT_TRUE(settleInFull());
      QTest::qWait(20);
      QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
      for (QLabel* label : window().workflow().findChildren<QLabel*>())
        if (label->isVisible()) expectWhole(*label);
      EXPECT_EQ(window().workflow().width(), width);
      EXPECT_EQ(window().sceneView().mapTo(&window(), QPoint()).x(), left) << "the picture jumped";
      EXPECT_LE(window().sceneView().mapTo(&window(), QPoint(window().sceneView().width(), 0)).x(),
                window().sideTabs().mapTo(&window(), QPoint()).x())
          << "the panel lies over the picture";
    }
    picture("panel-width-" + std::to_string(size.width()));
  }
}

TEST_F(NothingIsCutOff, OnASmallScreen) {
  makeWindow({960, 600});
  ASSERT_EQ(window().size(), QSize(960, 600));
  tryStates();
}

TEST_F(NothingIsCutOff, OnALargeScreen) {
  makeWindow({1920, 1080});
  tryStates();
}

}  // namespace
}  // namespace bw::app
