// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

class vtkTextProperty;

namespace bw::scene {

/// Sets the typeface that the windows of the desktop use too: Inter, Noto Sans or DejaVu Sans, whichever is
/// installed; otherwise VTK's own.
void useInterfaceFont(vtkTextProperty* property, bool bold);

}  // namespace bw::scene
