// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <exception>

#include "bw/scene/scene.h"

namespace bw::scene {

Result<std::string> pngBytes(const Picture& picture) {
  const std::size_t row = std::size_t(std::max(0, picture.width)) * 3;
  if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != row * std::size_t(picture.height)) {
    return fail(ErrorCode::badInput, "The picture holds " + std::to_string(picture.rgb.size()) +
                                         " bytes, which does not fit its size of " +
                                         std::to_string(picture.width) + " × " +
                                         std::to_string(picture.height) + " pixels.");
  }
  try {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(picture.width, picture.height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int y = 0; y < picture.height; ++y) {
      const auto source = picture.rgb.begin() + std::ptrdiff_t(std::size_t(picture.height - 1 - y) * row);
      std::copy(source, source + std::ptrdiff_t(row),
                static_cast<unsigned char*>(image->GetScalarPointer(0, y, 0)));
    }
    const auto writer = vtkSmartPointer<vtkPNGWriter>::New();
    writer->WriteToMemoryOn();
    writer->SetInputData(image);
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    if (!bytes || bytes->GetNumberOfValues() == 0)
      return fail(ErrorCode::internal, "The picture could not be encoded as PNG.");
    return std::string(reinterpret_cast<const char*>(bytes->GetPointer(0)),
                       std::size_t(bytes->GetNumberOfValues()));
  } catch (const std::exception& error) {
    return fail(ErrorCode::internal,
                std::string("The picture could not be encoded as PNG: ") + error.what() + ".");
  }
}

}  // namespace bw::scene
