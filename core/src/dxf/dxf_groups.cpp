// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "dxf/dxf_groups.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>

namespace bw::dxf {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr int kComment = 999;
constexpr unsigned char kLongCode = 0xff;  // before release 13: a code of two bytes follows

/// What a value is in a binary file.
enum class Kind { text, real, chunk, flag, int16, int32, int64 };

/// The values of the codes up to `last`, from where the row before ends.
struct Codes {
  int last;
  std::optional<Kind> kind;  ///< none: there are no such codes
};
constexpr Codes kCodes[] = {{-1, {}},           {9, Kind::text},     {59, Kind::real},    {79, Kind::int16},
                            {89, {}},           {99, Kind::int32},   {109, Kind::text},   {149, Kind::real},
                            {159, {}},          {169, Kind::int64},  {179, Kind::int16},  {209, {}},
                            {239, Kind::real},  {269, {}},           {289, Kind::int16},  {299, Kind::flag},
                            {309, Kind::text},  {319, Kind::chunk},  {369, Kind::text},   {389, Kind::int16},
                            {399, Kind::text},  {409, Kind::int16},  {419, Kind::text},   {429, Kind::int32},
                            {439, Kind::text},  {459, Kind::int32},  {469, Kind::real},   {481, Kind::text},
                            {998, {}},          {1003, Kind::text},  {1004, Kind::chunk}, {1009, Kind::text},
                            {1059, Kind::real}, {1070, Kind::int16}, {1071, Kind::int32}};

std::optional<Kind> kindOf(int code) {
  if (code == kComment) return Kind::text;
  const auto* row = std::ranges::lower_bound(kCodes, code, {}, &Codes::last);
  return row == std::end(kCodes) ? std::nullopt : row->kind;
}

std::size_t bytesOf(Kind kind) {
  switch (kind) {
    case Kind::real:
    case Kind::int64:
      return 8;
    case Kind::int32:
      return 4;
    case Kind::int16:
      return 2;
    default:
      return 1;
  }
}

/// So many bytes as a number, the lowest first.
std::uint64_t wholeOf(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i) value = value << 8 | std::uint8_t(bytes[i - 1]);
  return value;
}

double numberOf(Kind kind, std::string_view bytes) {
  const std::uint64_t bits = wholeOf(bytes);
  switch (kind) {
    case Kind::real:
      return std::bit_cast<double>(bits);
    case Kind::int64:
      return double(std::int64_t(bits));
    case Kind::int32:
      return std::int32_t(std::uint32_t(bits));
    case Kind::int16:
      return std::int16_t(std::uint16_t(bits));
    default:
      return double(bits);
  }
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t from = text.find_first_not_of(kBlank);
  return from == std::string_view::npos ? std::string_view()
                                        : text.substr(from, text.find_last_not_of(kBlank) - from + 1);
}

Groups::Groups(std::string_view bytes, const std::string& name)
    : rest_(bytes), name_(name), size_(bytes.size()) {
  if (bytes.starts_with(kBinaryMark)) {
    rest_.remove_prefix(kBinaryMark.size());
    // A section, code 0, comes first, or a comment, code 999: codes of two bytes have a second one of 0,
    // or 3.
    const auto at = [&](std::size_t i) { return i < rest_.size() ? std::uint8_t(rest_[i]) : 0; };
    codeBytes_ = at(0) == kLongCode || (at(0) == 0 && at(1) != 0) ? 1 : 2;
  } else if (bytes.starts_with(kByteOrderMark)) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

std::string Groups::words(std::size_t place) const {
  return (binary() ? "byte " : "line ") + std::to_string(place);
}

tl::unexpected<Error> Groups::damaged(std::size_t place, const std::string& what) const {
  return fail(ErrorCode::cannotRead,
              "cannot read " + name_ + ": " + words(place) + " " + what +
                  "; the file is damaged: export it again as ASCII DXF",
              name_, double(place));
}

tl::unexpected<Error> Groups::cutShort() const {
  return fail(ErrorCode::cannotRead,
              "cannot read " + name_ +
                  ": the DXF file is cut short (its end mark is missing); copy or export it again",
              name_);
}

Result<Group> Groups::next() {
  for (;;) {
    if (rest_.empty()) return cutShort();
    Result<Group> group = binary() ? nextOfBinary() : nextOfText();
    if (!group || group->code != kComment) return group;
  }
}

std::string_view Groups::takeLine() {
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++line_;
  return line;
}

Result<Group> Groups::nextOfText() {
  Group group;
  group.place = line_ + 1;
  const std::string_view code = trimmed(takeLine());
  const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), group.code);
  if (error != std::errc{} || end != code.data() + code.size())
    return damaged(group.place,
                   "has \"" + std::string(code.substr(0, 20)) + "\" where the code of a group stands");
  if (rest_.empty()) return cutShort();
  group.value = takeLine();
  return group;
}

Result<Group> Groups::nextOfBinary() {
  Group group;
  group.place = size_ - rest_.size() + 1;
  const auto take = [this](std::size_t count) -> std::optional<std::string_view> {
    if (rest_.size() < count) return {};
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  };
  std::optional<std::string_view> code = take(codeBytes_);
  if (code && codeBytes_ == 1 && std::uint8_t(code->front()) == kLongCode) code = take(2);
  if (!code) return cutShort();
  group.code = code->size() == 1 ? int(wholeOf(*code)) : std::int16_t(wholeOf(*code));
  const std::optional<Kind> kind = kindOf(group.code);
  if (!kind)
    return damaged(group.place, "has " + std::to_string(group.code) +
                                    " where the code of a group stands, and DXF has no such code");
  if (*kind == Kind::text) {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) return cutShort();
    group.value = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return group;
  }
  const std::optional<std::string_view> bytes = take(bytesOf(*kind));
  if (!bytes) return cutShort();
  if (*kind == Kind::chunk) {
    if (!take(wholeOf(*bytes))) return cutShort();
    return group;
  }
  group.number = numberOf(*kind, *bytes);
  return group;
}

}  // namespace bw::dxf
