// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/design/design.h"
#include "bw/core/design/variables.h"
#include "bw/core/text/json_reader.h"

namespace bw::detail {

// The keys of each part of a design: a job has them all in one object, a design those of each part in one of
// its own.

/// CAD files that stand in the document already, by what `base64_as` calls them.
using EmbeddedFiles = std::map<std::string, SharedBytes>;

/// A design from the document of its file, and the document of a design; in both numbers may be expressions.
Result<Design> designFrom(const nlohmann::json& object, int* version = nullptr);
nlohmann::ordered_json designJson(const Design& design);
/// What a version holds, which messages call `path`: a design without versions, whose embedded file may be
/// one of those.
Result<Design> designFrom(const nlohmann::json& object, const std::string& path, const EmbeddedFiles& files);

/// versions: they share the embedded files of the design, which is read before them, and of each other.
void readVersions(ObjectReader& reader, Design& design);
nlohmann::ordered_json versionsJson(const Design& design);

/// hidden, locked: of the parts that are read before them.
void readMarks(ObjectReader& reader, Design& design);
void writeMarks(const Design& design, nlohmann::ordered_json& object);

/// Degrees that are read as exactly this angle again, where there are such: as any that was read has.
double degreesThatRead(double angle);
Eigen::Vector3d degreesThatRead(const Eigen::Vector3d& angles);

void readVariables(ObjectReader& reader, std::vector<Variable>& variables);
nlohmann::json variablesJson(const std::vector<Variable>& variables);
void readSurface(ObjectReader& reader, std::optional<DesignedSurface>& surface);  ///< surface
/// Tells of something at or below a place in an object, such as "/frame", that stands for an expression, the
/// first; null where nothing does.
using BoundBelow = std::function<const BoundNumber*(const std::string& place)>;
/// What stands for an expression is written although its number may be the usual one.
nlohmann::json surfaceJson(const DesignedSurface& surface, const BoundBelow& isBound);

/// curve_names: of the curves of its surface, which is read before them.
void readCurveNames(ObjectReader& reader, Source& source);
void writeCurveNames(const Source& source, nlohmann::json& object);

/// drawing: of a surface that is read before it.
void readDrawing(ObjectReader& reader, Source& source);
void writeDrawing(const Source& source, nlohmann::json& object);

void readSourceKeys(ObjectReader& reader, Source& source);            ///< unit, sewing
void readPlacement(ObjectReader& reader, StockBlock& block);          ///< block
void readGrid(ObjectReader& reader, std::optional<BlockGrid>& grid);  ///< grid
void readCutKeys(ObjectReader& reader, Cut& cut);       ///< face, near, direction, planes, stations, sections
void readBlockCutKeys(ObjectReader& reader, Cut& cut);  ///< face_up, turn_deg, keep, order, blade_length
void readProcessKeys(ObjectReader& reader, Process& process);  ///< fit, and the table of its numbers
void readOutputKeys(ObjectReader& reader, Output& output);     ///< programs, cell
/// blade: an error where the default preset is needed and not there. `object` is that of the reader.
Result<void> readBladeKeys(ObjectReader& reader, const nlohmann::json& object, Blade& blade);

void writeSourceKeys(const Source& source, nlohmann::json& object);
void writePlacement(const StockBlock& block, nlohmann::json& object);
/// `isBound` is that of the whole design.
nlohmann::json gridJson(const BlockGrid& grid, const BoundBelow& isBound);
void writeCutKeys(const Cut& cut, nlohmann::json& object);
/// What is as usual is left out, but for what `isBound` of the cut.
void writeBlockCutKeys(const Cut& cut, nlohmann::json& object, const BoundBelow& isBound);
void writeProcessKeys(const Process& process, nlohmann::json& object);

}  // namespace bw::detail
