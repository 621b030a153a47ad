// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <png.h>

#include <algorithm>
#include <string>

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
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = png_uint_32(picture.width);
  image.height = png_uint_32(picture.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;  // a fifth of the time, for files that are a fifteenth larger
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr))
    return fail(ErrorCode::internal,
                std::string("The picture could not be encoded as PNG: ") + image.message + ".");
  bytes.resize(size);
  return bytes;
}

}  // namespace bw::scene
