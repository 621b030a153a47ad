// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bw::geometry {

/// The kinds of CAD files that are read.
enum class CadFormat { step, iges, brep, unknown };

/// The kind that the content is of; unknown if none.
CadFormat formatOfContent(std::string_view bytes);
/// The kind that a file's suffix promises; unknown if none.
CadFormat formatOfSuffix(const std::string& name);
/// "STEP", "IGES", "BREP"; "CAD" for unknown.
const char* formatName(CadFormat format);

/// Why OCCT must not be given this text: cut short, tables that claim more than there is, entities of one
/// number. OCCT reads on over such faults and may crash or never return. Empty if nothing is found.
std::string faultOf(std::string_view bytes, CadFormat format);

/// Without the UTF-8 byte order mark that some programs put first.
std::string_view withoutMark(std::string_view text);
std::string lowerCase(std::string_view text);
std::string_view trimmedLeft(std::string_view text);
/// Without the blanks and zero bytes at its end.
std::string_view trimmedRight(std::string_view text);

/// "mm", "cm", "m", "inch", … for a unit as a file calls it; "mm (assumed)" for none.
std::string unitName(std::string text);

/// mm in a unit of `unitName`; 0 for one that is not known.
double unitLength(const std::string& name);

/// Which entities of a STEP text refer to which, as written, whatever becomes of them in a reader.
class StepReferences {
 public:
  explicit StepReferences(std::string_view text);

  /// Numbers of the entities that refer to `entity`.
  std::vector<int> usersOf(int entity) const;

 private:
  std::vector<std::pair<int, int>> uses_;  // the one referred to and the one that refers, sorted
};

}  // namespace bw::geometry
