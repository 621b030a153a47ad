// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/blade/blade_numbers.h"

#include <array>

namespace bw {

namespace {

constexpr std::array<BladeNumber, 10> kBlade = {{
    {{&Blade::length, "length", "Blade length", "mm", 10, Blade::kLongest, 10, 2, 10,
      "Free length between the two grips", "Change blade length"}},
    {{&Blade::outerDiameter, "outer_diameter", "Outer diameter", "mm", 0, 100, 0.05, 3, 0.1, "",
      "Change diameter"},
     false},
    {{&Blade::innerDiameter, "inner_diameter", "Inner diameter", "mm", 0, 100, 0, 3, 0.1, "",
      "Change diameter"},
     false,
     true,
     false},
    {{&Blade::width, "width", "Width", "mm", 0, 200, 0.05, 3, 0.5, "Along the cutting direction",
      "Change blade width"},
     true,
     false,
     false},
    {{&Blade::thickness, "thickness", "Thickness", "mm", 0, 50, 0.01, 3, 0.1, "In the plane of bending",
      "Change blade thickness"},
     true,
     false,
     false},
    {{&Blade::youngModulus, "young_modulus", "Young's modulus", "N/mm²", 1, 2e6, 1, 1, 1000,
      "At the working temperature", "Change Young's modulus"}},
    {{&Blade::yieldStress, "yield_stress", "Yield stress", "N/mm²", 1e-2, 1e5, 1e-2, 2, 10,
      "At the working temperature", "Change yield stress"}},
    {{&Blade::safety, "safety", "Safety factor", "", 1, 10, 1, 3, 0.1, "The yield stress is divided by this",
      "Change safety factor"}},
    {{&Blade::temperature, "temperature", "Temperature", "°C", -50, 1500, -50, 1, 10,
      "Of the blade at the cut", "Change temperature"}},
    {{&Blade::thermalExpansion, "thermal_expansion", "Expansion", "·10⁻⁶/K", 0, 1e-3, 0, 3, 0.5,
      "Mean thermal expansion from 20 °C to the working temperature", "Change thermal expansion", 1e6}},
}};

}  // namespace

std::span<const BladeNumber> bladeNumbers() { return kBlade; }

}  // namespace bw
