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

#include "controls/paint.h"
#include "controls/style_sheet.h"

namespace bw::app {

namespace {

constexpr double kDarkLuminance = 0.5;
constexpr int kIconSize = 20, kTickSize = 10;

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

  QString sheet = QString::fromLatin1(kStyleSheet);
  const auto put = [&](const char* word, const QColor& colour) {
    sheet.replace(QLatin1Char('@') + QLatin1String(word), colour.name());
  };
  // Longer words first: "@accentHover" begins with "@accent".
  put("accentHover", mixed(c.accent, dark ? Qt::white : Qt::black, 0.12));
  put("onAccent", dark ? QColor("#1E1206") : QColor("#FFFFFF"));
  put("onSelection", dark ? QColor("#0B1620") : QColor("#FFFFFF"));
  put("background", c.background);
  put("secondaryPale", mixed(c.panel, c.secondary, kStaleOpacity));
  put("secondary", c.secondary);
  put("selection", c.selection);
  put("disabled", c.disabled);
  put("checked", mixed(c.panel, c.selection, dark ? 0.28 : 0.16));
  put("accent", c.accent);
  put("field", c.field);
  put("panel", c.panel);
  put("hover", mixed(c.panel, c.text, 0.07));
  put("line", c.line);
  put("errorPale", mixed(c.panel, c.error, kStaleOpacity));
  put("pale", mixed(c.panel, c.text, kStaleOpacity));
  put("error", c.error);
  put("text", c.text);
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
