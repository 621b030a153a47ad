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

#include <functional>
#include <map>

namespace bw::app {

namespace {

// The rules of the window's stylesheet; @words are replaced by the colours of the theme.
constexpr char kStyleSheet[] = R"(
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

QStatusBar { background: @panel; border-top: 1px solid @line; }
QStatusBar QLabel { color: @secondary; }
QStatusBar::item { border: none; }

QDockWidget { titlebar-close-icon: none; }
QWidget#start { background: @background; }
QScrollArea, QScrollArea > QWidget > QWidget#page { background: @panel; border: none; }
QWidget#panel { background: @panel; border: none; }
QFrame#line { background: @line; border: none; min-height: 1px; max-height: 1px; }
QFrame#vline { background: @line; border: none; min-width: 1px; max-width: 1px; }

QWidget#floating { background: @panel; border: 1px solid @line; border-radius: 6px; }
QLabel#secondary { color: @secondary; }
QLabel#title { color: @text; }
bw--app--ValueLabel { qproperty-errorColour: @error; }
bw--app--ValueLabel[broken="true"] { color: @error; }
bw--app--ValueLabel[stale="true"] { color: @pale; }
QStatusBar bw--app--ValueLabel[stale="true"] { color: @secondaryPale; }
bw--app--ValueLabel[broken="true"][stale="true"] { color: @errorPale; }

QLineEdit, QComboBox {
  background: @field; color: @text; border: 1px solid @line; border-radius: 4px; padding: 2px 6px; min-height: 22px;
  selection-background-color: @selection; selection-color: @onSelection; }
QLineEdit:hover, QComboBox:hover { border-color: @secondary; }
QLineEdit:focus, QComboBox:focus { border-color: @selection; }
QLineEdit:disabled, QComboBox:disabled { color: @disabled; background: @background; }
bw--app--TypedField { qproperty-errorColour: @error; }
QLineEdit[refused="true"], QLineEdit[refused="true"]:focus { border-color: @error; }
QLabel#unit { color: @secondary; background: transparent; }
QLabel#unit:disabled { color: @disabled; }
QLabel#told { color: @selection; background: transparent; }
QLabel#told:disabled { color: @disabled; }
QLabel#refusal { background: @panel; color: @error; border: 1px solid @error; border-radius: 4px; padding: 4px 8px; }
QComboBox { padding-right: 2px; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow { image: url(@chevron); width: 14px; height: 14px; }
QComboBox QAbstractItemView { background: @panel; border: 1px solid @line; outline: none; padding: 4px;
  selection-background-color: @hover; selection-color: @text; }

QPushButton { background: @panel; color: @text; border: 1px solid @line; border-radius: 4px; padding: 4px 12px; min-height: 20px; }
QPushButton:hover { border-color: @secondary; }
QPushButton:focus { border-color: @selection; }
QPushButton:pressed { background: @hover; }
QPushButton:checked { background: @checked; }
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
QTabBar::tab { background: transparent; color: @secondary; padding: 7px 6px; border: none; border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: @text; }
QTabBar::tab:selected { color: @text; border-bottom-color: @selection; }
QTabBar::tab:focus { color: @selection; }

QListWidget, QListView { background: @panel; border: none; outline: none; }
QListView::item { padding: 6px 8px; border-bottom: 1px solid @line; color: @text; }
QListView::item:hover { background: @hover; }
QListView::item:selected { background: @checked; color: @text; }

QTreeView { background: @panel; border: none; outline: none; show-decoration-selected: 0; }
QTreeView::item { padding: 2px 0; }
QTreeView::item:hover { background: @hover; }
QTreeView::item:selected { background: @checked; color: @text; }

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

constexpr double kDarkLuminance = 0.5;
constexpr int kIconSize = 20, kTickSize = 10;

/// A colour of the theme: its word in the stylesheet, and what it is in both looks.
struct ThemeColour {
  const char* word;
  QColor Colours::*member;
  const char *light, *dark;
};
constexpr ThemeColour kColours[] = {{"background", &Colours::background, "#F6F6F4", "#1E2023"},
                                    {"panel", &Colours::panel, "#FFFFFF", "#26292E"},
                                    {"line", &Colours::line, "#DADAD6", "#3A3E45"},
                                    {"field", &Colours::field, "#FFFFFF", "#1E2023"},
                                    {"text", &Colours::text, "#22252A", "#E8EAED"},
                                    {"secondary", &Colours::secondary, "#646971", "#9AA0A8"},
                                    {"disabled", &Colours::disabled, "#A9ADB2", "#61666E"},
                                    {"accent", &Colours::accent, "#D9480F", "#FF7A3D"},
                                    {"selection", &Colours::selection, "#1C7ED6", "#4DABF7"},
                                    {"success", &Colours::success, "#2B8A3E", "#69C47C"},
                                    {"warning", &Colours::warning, "#B35900", "#FFA94D"},
                                    {"error", &Colours::error, "#C92A2A", "#FF8787"}};

Colours coloursOf(bool dark) {
  Colours colours;
  for (const auto& [word, member, inLight, inDark] : kColours) colours.*member = dark ? inDark : inLight;
  colours.dark = dark;
  return colours;
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
  const auto set = [&p](const QColor& colour, std::initializer_list<QPalette::ColorRole> roles) {
    for (const QPalette::ColorRole role : roles) p.setColor(role, colour);
  };
  set(c.background, {QPalette::Window, QPalette::AlternateBase});
  set(c.field, {QPalette::Base});
  set(c.text, {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText});
  set(c.panel, {QPalette::Button, QPalette::ToolTipBase, QPalette::Light});
  set(c.secondary, {QPalette::PlaceholderText});
  set(c.selection, {QPalette::Highlight, QPalette::Link});
  set(c.dark ? QColor("#101214") : QColor("#FFFFFF"), {QPalette::HighlightedText});
  set(c.line, {QPalette::Midlight, QPalette::Mid, QPalette::Dark, QPalette::Shadow});
  for (QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, c.disabled);
  return p;
}

QColor mixed(const QColor& a, const QColor& b, double t) {
  return QColor::fromRgbF(float(a.redF() + t * (b.redF() - a.redF())),
                          float(a.greenF() + t * (b.greenF() - a.greenF())),
                          float(a.blueF() + t * (b.blueF() - a.blueF())));
}

/// The icon with a tick on a disc in its lower right corner.
QPixmap ticked(QPixmap icon, const Colours& colours) {
  const QRectF disc(kIconSize - kTickSize, kIconSize - kTickSize, kTickSize, kTickSize);
  QPainter painter(&icon);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colours.panel, 1));
  painter.setBrush(colours.selection);
  painter.drawEllipse(disc);
  painter.setPen(QPen(colours.panel, 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  const QPointF corner = disc.topLeft();
  painter.drawPolyline(
      QPolygonF({corner + QPointF(2.8, 5.2), corner + QPointF(4.4, 6.8), corner + QPointF(7.3, 3.5)}));
  return icon;
}

}  // namespace

Theme::Theme(QObject* parent) : QObject(parent), colours_(coloursOf(false)) {
  systemDark_ = QApplication::palette().color(QPalette::Window).lightnessF() < kDarkLuminance;
  QApplication::setStyle(new Style);
  QApplication::setFont(bodyFont());
}

void Theme::apply(model::ThemeChoice choice) {
  const bool dark =
      choice == model::ThemeChoice::dark || (choice == model::ThemeChoice::system && systemDark_);
  colours_ = coloursOf(dark);
  const Colours& c = colours_;
  QApplication::setPalette(paletteOf(c));

  // Longer words first: "@accentHover" begins with "@accent".
  std::map<QString, QColor, std::greater<>> words = {
      {"accentHover", mixed(c.accent, dark ? Qt::white : Qt::black, 0.12)},
      {"onAccent", dark ? QColor("#1E1206") : QColor("#FFFFFF")},
      {"onSelection", dark ? QColor("#0B1620") : QColor("#FFFFFF")},
      {"secondaryPale", mixed(c.panel, c.secondary, kStaleOpacity)},
      {"checked", mixed(c.panel, c.selection, dark ? 0.28 : 0.16)},
      {"hover", mixed(c.panel, c.text, 0.07)},
      {"errorPale", mixed(c.panel, c.error, kStaleOpacity)},
      {"pale", mixed(c.panel, c.text, kStaleOpacity)}};
  for (const ThemeColour& colour : kColours) words[colour.word] = c.*colour.member;
  QString sheet = QString::fromLatin1(kStyleSheet);
  for (const auto& [word, colour] : words) sheet.replace(QLatin1Char('@') + word, colour.name());
  sheet.replace("@chevron", dark ? ":/icons/chevron-down-dark.svg" : ":/icons/chevron-down-light.svg");
  sheet.replace("@tick", dark ? ":/icons/tick-dark.svg" : ":/icons/tick-light.svg");
  qApp->setStyleSheet(sheet);
  emit changed();
}

QPixmap Theme::pixmap(const QString& name, const QColor& colour, int size, qreal pixelRatio) {
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
    icon.addPixmap(pixmap(name, colours_.text, kIconSize, ratio), QIcon::Normal, QIcon::Off);
    icon.addPixmap(ticked(pixmap(name, colours_.selection, kIconSize, ratio), colours_), QIcon::Normal,
                   QIcon::On);
    icon.addPixmap(ticked(pixmap(name, colours_.disabled, kIconSize, ratio), colours_), QIcon::Disabled,
                   QIcon::On);
    icon.addPixmap(pixmap(name, colours_.disabled, kIconSize, ratio), QIcon::Disabled, QIcon::Off);
  }
  return icon;
}

QIcon Theme::tick() const {
  QIcon icon;
  for (qreal ratio : {1.0, 2.0}) {
    QPixmap nothing(QSize(kIconSize, kIconSize) * ratio);
    nothing.setDevicePixelRatio(ratio);
    nothing.fill(Qt::transparent);
    icon.addPixmap(nothing, QIcon::Normal, QIcon::Off);
    icon.addPixmap(nothing, QIcon::Disabled, QIcon::Off);
    icon.addPixmap(pixmap("check", colours_.selection, kIconSize, ratio), QIcon::Normal, QIcon::On);
    icon.addPixmap(pixmap("check", colours_.disabled, kIconSize, ratio), QIcon::Disabled, QIcon::On);
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
