// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw::scene {

/// A colour with components in [0, 1], as shown (sRGB).
struct Rgb {
  double r = 0, g = 0, b = 0;

  static constexpr Rgb hex(unsigned value) {
    return {double((value >> 16) & 255) / 255.0, double((value >> 8) & 255) / 255.0,
            double(value & 255) / 255.0};
  }
  bool operator==(const Rgb&) const = default;
};

/// `a` at t = 0, `b` at t = 1.
constexpr Rgb mix(const Rgb& a, const Rgb& b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// The colours of the picture's parts.
struct Theme {
  Rgb top, bottom;  ///< of the background
  Rgb panel, line, text, secondary;
  Rgb accent, selection, warning, error;
  Rgb foam, foamEdge;
  Rgb target, targetEdge;
  Rgb cut;
  Rgb grip;
  Rgb station;  ///< over the background; over a surface the lines are always dark
  Rgb grid, axisX, axisY, axisZ;
};

constexpr Theme theme(bool dark) {
  const auto either = [dark](unsigned light, unsigned onDark) { return Rgb::hex(dark ? onDark : light); };
  return {.top = either(0xFBFBFA, 0x2A2D32),
          .bottom = either(0xE9ECEF, 0x1B1D20),
          .panel = either(0xFFFFFF, 0x26292E),
          .line = either(0xDADAD6, 0x3A3E45),
          .text = either(0x22252A, 0xE8EAED),
          .secondary = either(0x6B7078, 0x9AA0A8),
          .accent = either(0xD9480F, 0xFF7A3D),
          .selection = either(0x1C7ED6, 0x4DABF7),
          .warning = either(0xE67700, 0xFFA94D),
          .error = either(0xC92A2A, 0xFF6B6B),
          .foam = either(0xFFF6E8, 0xFFF9F0),
          .foamEdge = either(0xADB5BD, 0xADB5BD),
          .target = either(0x9DB2C7, 0x8FA9C4),
          .targetEdge = either(0x6F8296, 0x9FB4CA),
          .cut = either(0xFAF7F1, 0xE9E4DA),
          .grip = either(0x2B2F36, 0x7B838D),
          .station = either(0x4A5058, 0xC6CCD3),
          .grid = either(0xA9AEB5, 0x6C737C),
          .axisX = either(0xC2554D, 0xE0796F),
          .axisY = either(0x4F9A5B, 0x74BD80),
          .axisZ = either(0x4180C4, 0x6BAAEA)};
}

/// Lines over a surface are dark in both themes.
inline constexpr Rgb kLineOverSurface = Rgb::hex(0x22252A);

/// How much of its colour a thing keeps over the background: less if it is out of date.
constexpr double keptColor(bool stale) { return stale ? 0.6 : 1.0; }

}  // namespace bw::scene
