// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/design.h"

#include <array>
#include <nlohmann/json.hpp>

#include "bw/core/files/file_set.h"
#include "bw/core/text/json_reader.h"
#include "design/job_json.h"

namespace bw {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string toBase64(const std::string& bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? unsigned(static_cast<unsigned char>(bytes[k])) : 0u;
    };
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += kAlphabet[word >> 18 & 63];
    text += kAlphabet[word >> 12 & 63];
    text += i + 1 < bytes.size() ? kAlphabet[word >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kAlphabet[word & 63] : '=';
  }
  return text;
}

std::optional<std::string> fromBase64(const std::string& text) {
  std::array<int, 256> value;
  value.fill(-1);
  for (int i = 0; i < 64; ++i) value[static_cast<unsigned char>(kAlphabet[i])] = i;
  if (text.size() % 4 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    const bool last = i + 4 == text.size();
    const int padding = last ? (text[i + 3] == '=') + (text[i + 2] == '=' && text[i + 3] == '=') : 0;
    unsigned word = 0;
    for (int k = 0; k < 4; ++k) {
      int v = value[static_cast<unsigned char>(text[i + std::size_t(k)])];
      if (k >= 4 - padding) v = 0;
      if (v < 0) return std::nullopt;
      word = word << 6 | unsigned(v);
    }
    bytes += char(word >> 16 & 255);
    if (padding < 2) bytes += char(word >> 8 & 255);
    if (padding < 1) bytes += char(word & 255);
  }
  return bytes;
}

}  // namespace

Result<Design> parseDesign(std::string_view text) {
  const Result<json> object = parseJsonText(text, "design");
  if (!object) {
    Error error = object.error();
    error.message += "; a design is what Bladewright saved, a CAD file is opened as a surface";
    return tl::unexpected<Error>(std::move(error));
  }
  ObjectReader reader(*object, "design");
  Design design;
  int version = 0;
  if (Result<void> ok = reader.version("bladewright_design", version, Design::kVersion, 0); !ok)
    return tl::unexpected<Error>(ok.error());
  if (version == 0)
    reader.complain(
        "bladewright_design",
        "this is not a Bladewright design: the key bladewright_design with the version is missing");
  reader.text("name", design.name);
  if (const json* source = reader.member("source")) {
    ObjectReader inner(*source, "design.source");
    std::string path, base64, fingerprint;
    inner.text("path", path);
    inner.text("base64", base64);
    inner.text("fingerprint", fingerprint);
    design.source.path = path;
    if (std::optional<std::string> bytes = fromBase64(base64))
      design.source.bytes = std::move(*bytes);
    else
      inner.complain("base64", "design.source.base64 is damaged; embed the CAD file again");
    design.source.saved = fingerprintFrom(fingerprint);
    if (!design.source.saved && !fingerprint.empty())
      inner.complain("fingerprint",
                     "design.source.fingerprint is damaged; remove it or save the design again");
    if (Result<void> ok = inner.finish(); !ok) reader.adopt(inner);
  }
  if (const json* job = reader.member("job")) {
    int threads = 0;  // of the machine that it was saved on
    Result<Job> read = jobFromJson(*job, "design.job", threads);
    if (!read) return tl::unexpected<Error>(read.error());
    design.job = std::move(*read);
  }
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return design;
}

std::string designToJson(const Design& design) {
  nlohmann::ordered_json object;
  object["bladewright_design"] = Design::kVersion;
  object["name"] = design.name;
  object["source"] = {{"path", design.source.path.generic_string()}};
  if (!design.source.bytes.empty()) object["source"]["base64"] = toBase64(design.source.bytes);
  if (design.source.bytes.empty() && design.source.saved)
    object["source"]["fingerprint"] = fingerprintText(*design.source.saved);
  object["job"] = jobToJsonObject(design.job);
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void noteSource(Design& design) {
  if (!design.source.bytes.empty())
    design.source.saved.reset();
  else if (const Result<Fingerprint> now = fingerprintOfFile(design.source.path))
    design.source.saved = *now;
}

Result<Design> loadDesign(const fs::path& file) {
  const Result<std::string> text = readFile(file, kLargestText);
  if (!text) return tl::unexpected<Error>(text.error());
  Result<Design> design = parseDesign(*text);
  if (!design) {
    Error error = design.error();
    error.message = file.filename().string() + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
  }
  if (design->source.bytes.empty() && !design->source.path.empty() && design->source.path.is_relative())
    design->source.path = (file.parent_path() / design->source.path).lexically_normal();
  return design;
}

Result<void> saveDesign(const Design& design, const fs::path& file) {
  Design stored = design;
  if (stored.source.bytes.empty() && stored.source.path.is_absolute()) {
    std::error_code error;
    const fs::path folder = fs::absolute(file, error).parent_path();
    const fs::path relative = stored.source.path.lexically_relative(folder);
    if (!relative.empty()) stored.source.path = relative;
  }
  const std::string text = designToJson(stored);
  if (text.size() > kLargestText)
    return fail(ErrorCode::cannotWrite,
                file.string() + " would have " + std::to_string(text.size() >> 20) +
                    " MB, but designs above " + std::to_string(kLargestText >> 20) +
                    " MB cannot be opened again; link the CAD file (" +
                    std::to_string(stored.source.bytes.size() >> 20) + " MB) instead of embedding it",
                file.string(), double(text.size()), double(kLargestText));
  return writeFile(file, text);
}

}  // namespace bw
