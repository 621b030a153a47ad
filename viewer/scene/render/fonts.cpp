// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/fonts.h"

#include <vtkTextProperty.h>

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

namespace bw::scene {

namespace {

struct Typeface {
  std::string regular, bold;
};

/// Looked up at the places where Debian, Fedora and Arch put them; reading all fonts of a system would take
/// too long.
Typeface findTypeface() {
  struct Place {
    const char *folder, *regular, *bold;
  };
  constexpr std::array<Place, 9> kPlaces{{
      {"/usr/share/fonts/opentype/inter", "Inter-Regular.otf", "Inter-SemiBold.otf"},
      {"/usr/share/fonts/truetype/inter", "Inter-Regular.ttf", "Inter-SemiBold.ttf"},
      {"/usr/share/fonts/inter", "Inter-Regular.otf", "Inter-SemiBold.otf"},
      {"/usr/share/fonts/truetype/noto", "NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
      {"/usr/share/fonts/google-noto", "NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
      {"/usr/share/fonts/noto", "NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
      {"/usr/share/fonts/truetype/dejavu", "DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
      {"/usr/share/fonts/dejavu-sans-fonts", "DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
      {"/usr/share/fonts/TTF", "DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
  }};
  for (const Place& place : kPlaces) {
    const std::filesystem::path folder(place.folder);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder / place.regular, ignored) &&
        std::filesystem::is_regular_file(folder / place.bold, ignored)) {
      return {(folder / place.regular).string(), (folder / place.bold).string()};
    }
  }
  return {};
}

}  // namespace

void useInterfaceFont(vtkTextProperty* property, bool bold) {
  static const Typeface kTypeface = findTypeface();
  if (kTypeface.regular.empty()) {
    property->SetFontFamilyToArial();
    property->SetBold(bold);
    return;
  }
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile((bold ? kTypeface.bold : kTypeface.regular).c_str());
}

}  // namespace bw::scene
