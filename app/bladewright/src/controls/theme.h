// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <QIcon>
#include <QObject>
#include <QPixmap>
#include <QString>

#include <cmath>

#include "bw/core/base/finding.h"
#include "bw/model/settings.h"

namespace bw::app {

/// The colours of the window, the same words in both themes.
struct Colours {
  QColor background, panel, line, field;
  QColor text, secondary, disabled;
  QColor accent;  ///< the glowing blade, the primary button and the playhead only
  QColor selection;
  QColor success, warning, error;
  bool dark = false;
};

/// 8 px grid.
inline constexpr int kGap = 8;
inline constexpr int kGroupGap = 16;
inline constexpr int kStepGap = 24;

/// Light or dark look: palette, stylesheet and icons made from one set of colours. One object for the
/// program, handed down to whoever paints.
class Theme : public QObject {
  Q_OBJECT

 public:
  explicit Theme(QObject* parent = nullptr);

  const Colours& colours() const { return colours_; }
  bool dark() const { return colours_.dark; }
  /// Applies the look to the whole program. `system` follows the desktop's palette as it was at the start.
  void apply(model::ThemeChoice choice);

  /// A line icon of resources/icons in the theme's text colour: dimmed when disabled, with a tick when on.
  QIcon icon(const QString& name) const;
  /// A tick when on, and nothing when off.
  QIcon tick() const;
  /// The same as a pixmap of `size` device-independent pixels in any colour.
  static QPixmap pixmap(const QString& name, const QColor& colour, int size = 20, qreal pixelRatio = 2.0);

  /// 9 pt secondary, 10 pt body, 12 pt semibold title; numbers in tabular figures.
  static QFont secondaryFont();
  static QFont bodyFont();
  static QFont titleFont();

 signals:
  void changed();

 private:
  bool systemDark_ = false;
  Colours colours_;
};

/// Results out of date stay visible, so faint.
inline constexpr double kStaleOpacity = 0.6;

/// The largest of 1, 2, 5 · 10ⁿ that is not above `value`; 0 for values ≤ 0.
inline double roundBelow(double value) {
  if (!(value > 0)) return 0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : {5.0, 2.0})
    if (step * power <= value) return step * power;
  return power;
}

/// The colour and icon of a severity.
inline QColor severityColour(Severity severity, const Colours& colours) {
  return severity == Severity::error     ? colours.error
         : severity == Severity::warning ? colours.warning
                                         : colours.selection;
}
inline QString severityIcon(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

}  // namespace bw::app
