// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "occt.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Type.hxx>
#include <Standard_Version.hxx>

#include "bw/geometry/version.h"

namespace bw::geometry {

void silenceOcct() {
  static const bool done = [] {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    return true;
  }();
  static_cast<void>(done);
}

std::string failureText(const Standard_Failure& failure) {
  std::string text = failure.DynamicType()->Name();
  const char* detail = failure.GetMessageString();
  if (detail && *detail) text += std::string(" (") + detail + ")";
  return text;
}

std::string libraryVersions() { return "OpenCASCADE " OCC_VERSION_COMPLETE "\n"; }

}  // namespace bw::geometry
