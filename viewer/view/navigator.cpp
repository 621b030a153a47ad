// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "navigator.h"

namespace bw::view {

Drag dragFor(Navigation navigation, Qt::MouseButton button, Qt::KeyboardModifiers keys) {
  const bool shift = keys.testFlag(Qt::ShiftModifier), control = keys.testFlag(Qt::ControlModifier);
  // The left button serves those who have no other.
  if (button == Qt::LeftButton) return keys.testFlag(Qt::AltModifier) && shift ? Drag::pan : Drag::orbit;
  const bool middle = button == Qt::MiddleButton, right = button == Qt::RightButton;
  switch (navigation) {
    case Navigation::rhino:
      if (middle) return Drag::pan;
      if (right) return shift ? Drag::pan : control ? Drag::zoom : Drag::orbit;
      break;
    case Navigation::blender:
      if (middle) return shift ? Drag::pan : control ? Drag::zoom : Drag::orbit;
      break;
    case Navigation::solidworks:
      if (middle) return control ? Drag::pan : shift ? Drag::zoom : Drag::orbit;
      if (right) return Drag::pan;
      break;
  }
  return Drag::none;
}

}  // namespace bw::view
