// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/theme.h"

#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QPainter>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleFactory>
#include <QStyleHints>
#include <QSvgRenderer>

namespace bw::app {

namespace {

constexpr double kDarkLuminance = 0.5;

Colours lightColours() {
  Colours c;
  c.background = "#F6F6F4";
  c.panel = "#FFFFFF";
  c.line = "#DADAD6";
  c.field = "#FFFFFF";
  c.text = "#22252A";
  c.secondary = "#646971";
  c.disabled = "#A9ADB2";
  c.accent = "#D9480F";
  c.selection = "#1C7ED6";
  c.success = "#2B8A3E";
  c.warning = "#B35900";
  c.error = "#C92A2A";
  return c;
}

Colours darkColours() {
  Colours c;
  c.background = "#1E2023";
  c.panel = "#26292E";
  c.line = "#3A3E45";
  c.field = "#1E2023";
  c.text = "#E8EAED";
  c.secondary = "#9AA0A8";
  c.disabled = "#61666E";
  c.accent = "#FF7A3D";
  c.selection = "#4DABF7";
  c.success = "#69C47C";
  c.warning = "#FFA94D";
  c.error = "#FF8787";
  c.dark = true;
  return c;
}

/// Fusion with the small things that a stylesheet cannot say.
class Style : public QProxyStyle {
 public:
  Style() : QProxyStyle(QStyleFactory::create("Fusion")) {}

  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override {
    switch (metric) {
      case PM_SmallIconSize:
      case PM_ButtonIconSize:
      case PM_ToolBarIconSize:
        return 20;
      default:
        return QProxyStyle::pixelMetric(metric, option, widget);
    }
  }

  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* data) const override {
    switch (hint) {
      case SH_Slider_AbsoluteSetButtons:  // a click sets the slider there, as the hand expects
        return Qt::LeftButton;
      case SH_DialogButtonBox_ButtonsHaveIcons:  // the system's pictures are of another hand
        return 0;
      case SH_ToolTip_WakeUpDelay:
        return 500;
      default:
        return QProxyStyle::styleHint(hint, option, widget, data);
    }
  }
};

QPalette paletteOf(const Colours& c) {
  QPalette p;
  p.setColor(QPalette::Window, c.background);
  p.setColor(QPalette::WindowText, c.text);
  p.setColor(QPalette::Base, c.field);
  p.setColor(QPalette::AlternateBase, c.background);
  p.setColor(QPalette::Text, c.text);
  p.setColor(QPalette::Button, c.panel);
  p.setColor(QPalette::ButtonText, c.text);
  p.setColor(QPalette::ToolTipBase, c.panel);
  p.setColor(QPalette::ToolTipText, c.text);
  p.setColor(QPalette::PlaceholderText, c.secondary);
  p.setColor(QPalette::Highlight, c.selection);
  p.setColor(QPalette::HighlightedText, c.dark ? QColor("#101214") : QColor("#FFFFFF"));
  p.setColor(QPalette::Link, c.selection);
  p.setColor(QPalette::Light, c.panel);
  p.setColor(QPalette::Midlight, c.line);
  p.setColor(QPalette::Mid, c.line);
  p.setColor(QPalette::Dark, c.line);
  p.setColor(QPalette::Shadow, c.line);
  for (QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, c.disabled);
  return p;
}

/// The rules of the stylesheet; @words are replaced by colours.
constexpr char kSheet[] = R"(
QMainWindow, QDialog { background: @background; }
QMainWindow::separator { background: @line; width: 1px; height: 1px; }
QMainWindow::separator:hover { background: @selection; }
QToolTip { background: @panel; color: @text; border: 1px solid @line; padding: 4px 6px; }

QMenuBar { background: @panel; border-bottom: 1px solid @line; padding: 2px 4px; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @hover; }
QMenu { background: @panel; border: 1px solid @line; padding: 4px; }
QMenu::item { padding: 5px 24px 5px 8px; border-radius: 4px; }
QMenu::item:selected { background: @hover; color: @text; }
QMenu::item:disabled { color: @disabled; }
QMenu::separator { height: 1px; background: @line; margin: 4px 8px; }
QMenu::icon { padding-left: 4px; }

QStatusBar { background: @panel; border-top: 1px solid @line; color: @secondary; }
QStatusBar::item { border: none; }

QDockWidget { titlebar-close-icon: none; }
QWidget#start { background: @background; }
QScrollArea, QScrollArea > QWidget > QWidget#page { background: @panel; border: none; }
QWidget#panel { background: @panel; border: none; }
QFrame#line { background: @line; border: none; min-height: 1px; max-height: 1px; }
QFrame#vline { background: @line; border: none; min-width: 1px; max-width: 1px; }

QLabel#secondary { color: @secondary; }
QLabel#title { color: @text; }

QAbstractSpinBox, QLineEdit, QComboBox {
  background: @field; color: @text; border: 1px solid @line; border-radius: 4px; padding: 2px 6px; min-height: 22px;
  selection-background-color: @selection; selection-color: @onSelection; }
QAbstractSpinBox:hover, QLineEdit:hover, QComboBox:hover { border-color: @secondary; }
QAbstractSpinBox:focus, QLineEdit:focus, QComboBox:focus { border-color: @selection; }
QAbstractSpinBox:disabled, QLineEdit:disabled, QComboBox:disabled { color: @disabled; background: @background; }
QComboBox { padding-right: 20px; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow { image: url(@chevron); width: 14px; height: 14px; }
QComboBox QAbstractItemView { background: @panel; border: 1px solid @line; outline: none; padding: 4px;
  selection-background-color: @hover; selection-color: @text; }

QPushButton { background: @panel; color: @text; border: 1px solid @line; border-radius: 4px; padding: 4px 12px; min-height: 20px; }
QPushButton:hover { border-color: @secondary; }
QPushButton:focus { border-color: @selection; }
QPushButton:pressed { background: @hover; }
QPushButton:disabled { color: @disabled; }
QPushButton#primary { background: @accent; color: @onAccent; border-color: @accent; font-weight: 600; }
QPushButton#primary:hover { background: @accentHover; border-color: @accentHover; }
QPushButton#primary:focus { border-color: @text; }
QPushButton#primary:disabled { background: @background; color: @disabled; border-color: @line; }
QToolButton { background: transparent; border: 1px solid transparent; border-radius: 4px; padding: 3px; color: @text; }
QToolButton:hover { background: @hover; }
QToolButton:focus { border-color: @selection; }
QToolButton:checked { background: @checked; color: @text; }
QToolButton:disabled { color: @disabled; }
QToolButton::menu-indicator { image: none; }
QToolButton#stepHead { border-radius: 0; padding: 8px 16px; text-align: left; }

QCheckBox { spacing: 8px; }
QCheckBox:disabled { color: @disabled; }
QCheckBox::indicator { width: 16px; height: 16px; border: 1px solid @secondary; border-radius: 3px; background: @field; }
QCheckBox::indicator:hover, QCheckBox:focus::indicator { border-color: @selection; }
QCheckBox::indicator:checked { background: @selection; border-color: @selection; image: url(@tick); }
QCheckBox::indicator:disabled { border-color: @line; }

QSlider::groove:horizontal { height: 2px; background: @line; border-radius: 1px; }
QSlider::sub-page:horizontal { background: @selection; border-radius: 1px; }
QSlider::handle:horizontal { width: 12px; height: 12px; margin: -6px 0; border-radius: 7px; background: @panel; border: 1px solid @secondary; }
QSlider::handle:horizontal:hover, QSlider:focus::handle:horizontal { border-color: @selection; }

QProgressBar { background: @line; border: none; border-radius: 1px; min-height: 3px; max-height: 3px; }
QProgressBar::chunk { background: @selection; border-radius: 1px; }

QTabWidget::pane { border: none; border-top: 1px solid @line; background: @panel; }
QTabWidget::tab-bar { left: 8px; }
QTabBar { background: @panel; qproperty-drawBase: 0; }
QTabBar::tab { background: transparent; color: @secondary; padding: 7px 12px; border: none; border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: @text; }
QTabBar::tab:selected { color: @text; border-bottom-color: @selection; }
QTabBar::tab:focus { color: @selection; }

QListWidget, QListView { background: @panel; border: none; outline: none; }
QListView::item { padding: 6px 8px; border-bottom: 1px solid @line; color: @text; }
QListView::item:hover { background: @hover; }
QListView::item:selected { background: @checked; color: @text; }

QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle { background: @line; border-radius: 3px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 32px; }
QScrollBar::handle:horizontal { min-width: 32px; }
QScrollBar::handle:hover { background: @disabled; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QSplitter::handle { background: @line; }
)";

QColor mixed(const QColor& a, const QColor& b, double t) {
  return QColor::fromRgbF(float(a.redF() + t * (b.redF() - a.redF())),
                          float(a.greenF() + t * (b.greenF() - a.greenF())),
                          float(a.blueF() + t * (b.blueF() - a.blueF())));
}

}  // namespace

Theme::Theme(QObject* parent) : QObject(parent), colours_(lightColours()) {
  systemDark_ = QApplication::palette().color(QPalette::Window).lightnessF() < kDarkLuminance;
  QApplication::setStyle(new Style);
  QApplication::setFont(bodyFont());
}

void Theme::apply(model::ThemeChoice choice) {
  const bool dark =
      choice == model::ThemeChoice::dark || (choice == model::ThemeChoice::system && systemDark_);
  colours_ = dark ? darkColours() : lightColours();
  const Colours& c = colours_;
  QApplication::setPalette(paletteOf(c));

  QString sheet = QString::fromLatin1(kSheet);
  const auto put = [&](const char* word, const QColor& colour) {
    sheet.replace(QLatin1Char('@') + QLatin1String(word), colour.name());
  };
  // Longer words first: "@accentHover" begins with "@accent".
  put("accentHover", mixed(c.accent, dark ? Qt::white : Qt::black, 0.12));
  put("onAccent", dark ? QColor("#1E1206") : QColor("#FFFFFF"));
  put("onSelection", dark ? QColor("#0B1620") : QColor("#FFFFFF"));
  put("background", c.background);
  put("secondary", c.secondary);
  put("selection", c.selection);
  put("disabled", c.disabled);
  put("checked", mixed(c.panel, c.selection, dark ? 0.28 : 0.16));
  put("accent", c.accent);
  put("field", c.field);
  put("panel", c.panel);
  put("hover", mixed(c.panel, c.text, 0.07));
  put("line", c.line);
  put("text", c.text);
  sheet.replace("@chevron", dark ? ":/icons/chevron-down-dark.svg" : ":/icons/chevron-down-light.svg");
  sheet.replace("@tick", dark ? ":/icons/tick-dark.svg" : ":/icons/tick-light.svg");
  qApp->setStyleSheet(sheet);
  emit changed();
}

QPixmap Theme::pixmap(const QString& name, const QColor& colour, int size, qreal pixelRatio) const {
  QFile file(":/icons/" + name + ".svg");
  if (!file.open(QIODevice::ReadOnly)) return {};
  QByteArray svg = file.readAll();
  svg.replace("currentColor", colour.name().toLatin1());
  QSvgRenderer renderer(svg);
  QPixmap pixmap(QSize(size, size) * pixelRatio);
  pixmap.setDevicePixelRatio(pixelRatio);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  renderer.render(&painter, QRectF(0, 0, size, size));
  return pixmap;
}

QIcon Theme::icon(const QString& name) const {
  QIcon icon;
  for (qreal ratio : {1.0, 2.0}) {
    icon.addPixmap(pixmap(name, colours_.text, 20, ratio), QIcon::Normal, QIcon::Off);
    icon.addPixmap(pixmap(name, colours_.selection, 20, ratio), QIcon::Normal, QIcon::On);
    icon.addPixmap(pixmap(name, colours_.disabled, 20, ratio), QIcon::Disabled, QIcon::Off);
  }
  return icon;
}

QFont Theme::bodyFont() {
  QFont font = QFontDatabase::systemFont(QFontDatabase::GeneralFont);
  const QStringList families = QFontDatabase::families();
  // A desktop that names no font of its own ("Sans") gets the quiet ones first.
  if (!families.contains(font.family()) || font.family() == "Sans Serif")
    for (const char* family : {"Inter", "Noto Sans", "DejaVu Sans"})
      if (families.contains(QLatin1String(family))) {
        font.setFamily(QLatin1String(family));
        break;
      }
  font.setPointSize(10);
  return font;
}

QFont Theme::secondaryFont() {
  QFont font = bodyFont();
  font.setPointSize(9);
  return font;
}

QFont Theme::titleFont() {
  QFont font = bodyFont();
  font.setPointSize(12);
  font.setWeight(QFont::DemiBold);
  return font;
}

}  // namespace bw::app
