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
  Rgb cut, cutEdge;
  Rgb grip;
  Rgb station;  ///< over the background; over a surface the lines are always dark
  Rgb grid, axisX, axisY, axisZ;
};

inline constexpr Theme kLight{.top = Rgb::hex(0xFBFBFA),
                              .bottom = Rgb::hex(0xE9ECEF),
                              .panel = Rgb::hex(0xFFFFFF),
                              .line = Rgb::hex(0xDADAD6),
                              .text = Rgb::hex(0x22252A),
                              .secondary = Rgb::hex(0x6B7078),
                              .accent = Rgb::hex(0xD9480F),
                              .selection = Rgb::hex(0x1C7ED6),
                              .warning = Rgb::hex(0xE67700),
                              .error = Rgb::hex(0xC92A2A),
                              .foam = Rgb::hex(0xFFF6E8),
                              .foamEdge = Rgb::hex(0xADB5BD),
                              .target = Rgb::hex(0x9DB2C7),
                              .targetEdge = Rgb::hex(0x6F8296),
                              .cut = Rgb::hex(0xFAF7F1),
                              .cutEdge = Rgb::hex(0x5C636B),
                              .grip = Rgb::hex(0x2B2F36),
                              .station = Rgb::hex(0x4A5058),
                              .grid = Rgb::hex(0xA9AEB5),
                              .axisX = Rgb::hex(0xC2554D),
                              .axisY = Rgb::hex(0x4F9A5B),
                              .axisZ = Rgb::hex(0x4180C4)};

inline constexpr Theme kDark{.top = Rgb::hex(0x2A2D32),
                             .bottom = Rgb::hex(0x1B1D20),
                             .panel = Rgb::hex(0x26292E),
                             .line = Rgb::hex(0x3A3E45),
                             .text = Rgb::hex(0xE8EAED),
                             .secondary = Rgb::hex(0x9AA0A8),
                             .accent = Rgb::hex(0xFF7A3D),
                             .selection = Rgb::hex(0x4DABF7),
                             .warning = Rgb::hex(0xFFA94D),
                             .error = Rgb::hex(0xFF6B6B),
                             .foam = Rgb::hex(0xFFF9F0),
                             .foamEdge = Rgb::hex(0xADB5BD),
                             .target = Rgb::hex(0x8FA9C4),
                             .targetEdge = Rgb::hex(0x9FB4CA),
                             .cut = Rgb::hex(0xE9E4DA),
                             .cutEdge = Rgb::hex(0x2B2F36),
                             .grip = Rgb::hex(0x7B838D),
                             .station = Rgb::hex(0xC6CCD3),
                             .grid = Rgb::hex(0x6C737C),
                             .axisX = Rgb::hex(0xE0796F),
                             .axisY = Rgb::hex(0x74BD80),
                             .axisZ = Rgb::hex(0x6BAAEA)};

/// Lines over a surface are dark in both themes.
inline constexpr Rgb kLineOverSurface = Rgb::hex(0x22252A);

/// How much of its colour a thing keeps over the background: less if it is out of date.
constexpr double keptColor(bool stale) { return stale ? 0.6 : 1.0; }

constexpr const Theme& theme(bool dark) { return dark ? kDark : kLight; }

}  // namespace bw::scene
