// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "controls/number_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The place of a number in the file of the design, a JSON pointer; empty while no expression can stand
/// there.
using NumberPlace = std::function<std::string()>;

/// Lets a field take expressions over the variables of the design for the number at `place`, and shows the
/// one that stands there. The number must stand in the file in the unit of the field.
void bindNumber(Workbench& bench, NumberField* field, const NumberPlace& place);

/// `value`, or what the expression at a place came to, where it is that within `within`: of numbers that
/// follow from others, rounded.
double asBound(const Workbench& bench, const NumberPlace& place, double value, double within);

/// What an expression, without its =, comes to over the variables of the design, or why it comes to nothing.
Result<double> valueOver(const Workbench& bench, const std::string& text);

/// The places in the file of a number of the cut, and of the block selected; `key` begins with a slash.
NumberPlace placeInCut(const Workbench& bench, const std::string& key);
NumberPlace placeInBlock(const Workbench& bench, const std::string& key);
/// That of a number of the cut of that id.
NumberPlace placeOfCut(const Workbench& bench, const std::string& cut, const std::string& key);
/// Those in the surface designed that the cut selected is of, and of the height of a pole of it.
NumberPlace placeInSurface(const Workbench& bench, const std::string& key);
NumberPlace placeOfPole(const Workbench& bench, int row, int column);

}  // namespace bw::app
