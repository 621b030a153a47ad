// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include <cstddef>
#include <optional>
#include <vector>

#include "workbench/workbench.h"

namespace bw::app {

// Sections and points of the loft, or key blades of the surface, that the cut selected is of, added and taken
// away, each as an undoable step; what cannot be is told, and false. All count from 0.

/// What a section, key blade or row of poles is called within a sentence: "section 2", or, where it was given
/// a name, "ridge (section 2)"; and as a heading.
QString curveTitle(const Workbench& bench, std::size_t curve);
QString curveHeading(const Workbench& bench, std::size_t curve);

/// The index of the point that is added.
std::optional<std::size_t> addPoint(Workbench& bench, std::size_t section, std::size_t after);
bool removePoint(Workbench& bench, std::size_t section, std::size_t point);
bool addSection(Workbench& bench, std::size_t after);
bool removeSection(Workbench& bench, std::size_t section);
/// Not after the last.
bool addBlade(Workbench& bench, std::size_t after);
bool removeBlade(Workbench& bench, std::size_t blade);
/// The section or key blade once more, after it.
bool repeatEntry(Workbench& bench, std::size_t entry);
/// Gives sections, key blades or rows of poles the shape of one of them.
bool copyShape(Workbench& bench, std::size_t from, const std::vector<std::size_t>& to);

}  // namespace bw::app
