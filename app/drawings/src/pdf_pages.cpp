// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "pdf_pages.h"

#include <hpdf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "bw/core/text/printable.h"

namespace bw::drawings {

namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr const char* kEllipsis = "\xe2\x80\xa6";
/// Longer texts are cut before they are measured: nothing on a page has room for them.
constexpr std::size_t kMostBytes = 2000;

/// What code page 1252 has at 0x80 to 0x9f; 0 where nothing.
constexpr std::array<std::uint16_t, 32> kUpper = {
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

/// The bytes of the first character of a well-formed text that is not empty.
std::size_t lengthOfFirst(std::string_view text) {
  const auto c = static_cast<unsigned char>(text.front());
  return std::min<std::size_t>(text.size(), c < 0x80 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4);
}

char windowsByte(std::uint32_t code) {
  if ((code >= 0x20 && code < 0x7f) || (code >= 0xa0 && code <= 0xff)) return char(code);
  const auto* const found = std::ranges::find(kUpper, code);
  return code != 0 && found != kUpper.end() ? char(0x80 + (found - kUpper.begin())) : '?';
}

/// Where the fonts are that the file carries: a folder for each system that we know of.
constexpr std::array<const char*, 3> kFontFolders = {"/usr/share/fonts/truetype/dejavu",
                                                     "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF"};

/// The file of a font; empty where it is not installed.
std::string fontFile(const char* name) {
  std::error_code error;
  for (const char* folder : kFontFolders) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (std::filesystem::is_regular_file(file, error)) return file.string();
  }
  return {};
}

HPDF_REAL points(double mm) { return HPDF_REAL(mm * kPointsPerMm); }

/// libharu takes dashes as whole numbers up to 2.3, as real ones since 2.4.
template <class Number, class Phase>
void setDash(HPDF_STATUS (*set)(HPDF_Page, const Number*, HPDF_UINT, Phase), HPDF_Page page,
             const std::vector<int>& dash) {
  const std::vector<Number> numbers(dash.begin(), dash.end());
  set(page, numbers.empty() ? nullptr : numbers.data(), HPDF_UINT(numbers.size()), 0);
}

}  // namespace

std::string windowsBytes(std::string_view utf8) {
  const std::string safe = printable(utf8);
  std::string out;
  for (std::string_view rest = safe; !rest.empty();) {
    const std::size_t length = lengthOfFirst(rest);
    std::uint32_t code = static_cast<unsigned char>(rest.front());
    if (length > 1) code &= 0x7fu >> length;
    for (std::size_t i = 1; i < length; ++i) code = code << 6 | (static_cast<unsigned char>(rest[i]) & 0x3fu);
    out += windowsByte(code);
    rest.remove_prefix(length);
  }
  return out;
}

struct PdfPages::Impl {
  HPDF_Doc doc = nullptr;
  HPDF_Page page = nullptr;
  HPDF_Font plain = nullptr, bold = nullptr;
  HPDF_STATUS failure = HPDF_OK;  ///< the first that libharu told
  Paper paper;
  bool utf8 = false;  ///< how letters are told to it

  /// libharu calls this in its own frames: it only takes note.
  static void note(HPDF_STATUS error, HPDF_STATUS, void* self) {
    HPDF_STATUS& failure = static_cast<Impl*>(self)->failure;
    if (failure == HPDF_OK) failure = error == HPDF_OK ? HPDF_STATUS(HPDF_INVALID_OBJECT) : error;
  }
  bool ready() const { return failure == HPDF_OK && page; }
  HPDF_Font font(const Letters& letters) const { return letters.bold ? bold : plain; }
  std::string bytesOf(std::string_view words) const { return utf8 ? printable(words) : windowsBytes(words); }
  /// False where the fonts are not there.
  bool loadFonts() {
    const std::string plainFile = fontFile("DejaVuSans.ttf"), boldFile = fontFile("DejaVuSans-Bold.ttf");
    if (plainFile.empty() || boldFile.empty()) return false;
    HPDF_UseUTFEncodings(doc);
    HPDF_SetCompressionMode(doc, HPDF_COMP_ALL);  // the fonts take half a MB otherwise
    const auto load = [this](const std::string& file) -> HPDF_Font {
      const char* name = HPDF_LoadTTFontFromFile(doc, file.c_str(), HPDF_TRUE);
      return name ? HPDF_GetFont(doc, name, "UTF-8") : nullptr;
    };
    plain = load(plainFile);
    bold = load(boldFile);
    utf8 = plain && bold;
    return utf8;
  }
  void path(const std::vector<Point>& along) const {
    HPDF_Page_MoveTo(page, points(along.front().x()), points(along.front().y()));
    for (std::size_t i = 1; i < along.size(); ++i)
      HPDF_Page_LineTo(page, points(along[i].x()), points(along[i].y()));
  }
};

PdfPages::PdfPages(const std::string& title, const Paper& paper) : impl_(std::make_unique<Impl>()) {
  impl_->paper = paper;
  impl_->doc = HPDF_New(&Impl::note, impl_.get());
  if (!impl_->doc) {
    Impl::note(HPDF_FAILD_TO_ALLOC_MEM, 0, impl_.get());
    return;
  }
  if (!paper.allLetters || !impl_->loadFonts()) {
    impl_->plain = HPDF_GetFont(impl_->doc, "Helvetica", "WinAnsiEncoding");
    impl_->bold = HPDF_GetFont(impl_->doc, "Helvetica-Bold", "WinAnsiEncoding");
  }
  if (!impl_->plain || !impl_->bold) Impl::note(HPDF_INVALID_FONT, 0, impl_.get());
  HPDF_SetInfoAttr(impl_->doc, HPDF_INFO_TITLE, windowsBytes(title).c_str());
}

PdfPages::~PdfPages() {
  if (impl_->doc) HPDF_Free(impl_->doc);
}

void PdfPages::begin() {
  if (impl_->failure != HPDF_OK) return;
  impl_->page = HPDF_AddPage(impl_->doc);
  if (!impl_->page) return Impl::note(HPDF_INVALID_PAGE, 0, impl_.get());
  HPDF_Page_SetWidth(impl_->page, points(impl_->paper.width));
  HPDF_Page_SetHeight(impl_->page, points(impl_->paper.height));
  HPDF_Page_SetLineCap(impl_->page, HPDF_ROUND_END);
  HPDF_Page_SetLineJoin(impl_->page, HPDF_ROUND_JOIN);
}

void PdfPages::line(const std::vector<Point>& along, const Pen& pen, bool closed) {
  if (!impl_->ready() || along.size() < 2) return;
  HPDF_Page_SetLineWidth(impl_->page, points(pen.width));
  HPDF_Page_SetGrayStroke(impl_->page, HPDF_REAL(pen.grey));
  setDash(&HPDF_Page_SetDash, impl_->page, pen.dash);
  impl_->path(along);
  if (closed)
    HPDF_Page_ClosePathStroke(impl_->page);
  else
    HPDF_Page_Stroke(impl_->page);
}

void PdfPages::rectangle(const Rectangle& r, const Pen& pen) {
  line({r.low, {r.high.x(), r.low.y()}, r.high, {r.low.x(), r.high.y()}}, pen, true);
}

void PdfPages::fill(const std::vector<Point>& along, double grey) {
  if (!impl_->ready() || along.size() < 3) return;
  HPDF_Page_SetGrayFill(impl_->page, HPDF_REAL(grey));
  impl_->path(along);
  HPDF_Page_ClosePath(impl_->page);
  HPDF_Page_Fill(impl_->page);
}

void PdfPages::text(const Point& at, std::string_view words, const Letters& letters) {
  const double width = widthOf(words, letters);
  if (!impl_->ready() || words.empty()) return;
  const double back = letters.align == Align::left ? 0 : letters.align == Align::centre ? width / 2 : width;
  const HPDF_Page page = impl_->page;
  if (letters.colour) {
    const auto& [red, green, blue] = *letters.colour;
    HPDF_Page_SetRGBFill(page, HPDF_REAL(red), HPDF_REAL(green), HPDF_REAL(blue));
  } else {
    HPDF_Page_SetGrayFill(page, HPDF_REAL(letters.grey));
  }
  HPDF_Page_BeginText(page);
  HPDF_Page_SetFontAndSize(page, impl_->font(letters), HPDF_REAL(letters.size));
  if (letters.upright)
    HPDF_Page_SetTextMatrix(page, 0, 1, -1, 0, points(at.x()), points(at.y() - back));
  else
    HPDF_Page_SetTextMatrix(page, 1, 0, 0, 1, points(at.x() - back), points(at.y()));
  HPDF_Page_ShowText(page, impl_->bytesOf(words).c_str());
  HPDF_Page_EndText(page);
}

void PdfPages::picture(const Rectangle& r, const std::string& png) {
  if (!impl_->ready()) return;
  // Packed, as a picture of the report would take some MB each.
  HPDF_SetCompressionMode(impl_->doc, impl_->utf8 ? HPDF_COMP_ALL : HPDF_COMP_IMAGE);
  const HPDF_Image image = HPDF_LoadPngImageFromMem(
      impl_->doc, reinterpret_cast<const HPDF_BYTE*>(png.data()), HPDF_UINT(png.size()));
  if (!impl_->ready() || !image) return Impl::note(HPDF_INVALID_IMAGE, 0, impl_.get());
  HPDF_Page_DrawImage(impl_->page, image, points(r.low.x()), points(r.low.y()), points(r.width()),
                      points(r.height()));
}

double PdfPages::widthOf(std::string_view words, const Letters& letters) {
  if (impl_->failure != HPDF_OK || words.empty()) return 0;
  const std::string bytes = impl_->bytesOf(words);
  const HPDF_TextWidth width = HPDF_Font_TextWidth(
      impl_->font(letters), reinterpret_cast<const HPDF_BYTE*>(bytes.data()), HPDF_UINT(bytes.size()));
  return width.width * 1e-3 * letters.size / kPointsPerMm;  // widths are told for a thousand points
}

std::string PdfPages::fitted(std::string_view words, const Letters& letters, double width) {
  std::string text = printable(words);
  if (text.size() <= kMostBytes && widthOf(text, letters) <= width) return text;
  std::vector<std::string> signs;
  for (std::string_view rest = text; !rest.empty(); rest.remove_prefix(lengthOfFirst(rest)))
    signs.emplace_back(rest.substr(0, lengthOfFirst(rest)));
  // A third of it is the end: names are told apart by that.
  const auto shortened = [&](std::size_t kept) {
    std::string begin, end;
    for (std::size_t k = 0; k < kept - kept / 3; ++k) begin += signs[k];
    for (std::size_t k = signs.size() - kept / 3; k < signs.size(); ++k) end += signs[k];
    while (!begin.empty() && begin.back() == ' ') begin.pop_back();
    return begin + kEllipsis + end;
  };
  std::size_t kept = 0;
  while (kept + 1 < signs.size()) {
    const std::string longer = shortened(kept + 1);
    if (longer.size() > kMostBytes || widthOf(longer, letters) > width) break;
    ++kept;
  }
  return shortened(kept);
}

std::vector<std::string> PdfPages::wrapped(std::string_view words, const Letters& letters, double width,
                                           int most) {
  std::vector<std::string> lines;
  std::string rest = printable(words.substr(0, kMostBytes));
  while (!rest.empty() && int(lines.size()) + 1 < most) {
    std::size_t end = std::string::npos;
    for (std::size_t at = rest.find(' '); widthOf(rest.substr(0, at), letters) <= width;
         at = rest.find(' ', at + 1)) {
      end = at;
      if (at == std::string::npos) break;
    }
    if (widthOf(rest, letters) <= width) {
      lines.push_back(rest);
      return lines;
    }
    if (end == std::string::npos) break;  // a word that is longer than the line
    lines.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  if (!rest.empty()) lines.push_back(fitted(rest, letters, width));
  return lines;
}

Result<std::string> PdfPages::bytes() {
  std::string out;
  if (impl_->failure == HPDF_OK) HPDF_SaveToStream(impl_->doc);
  if (impl_->failure == HPDF_OK) {
    out.resize(HPDF_GetStreamSize(impl_->doc));
    HPDF_UINT32 size = HPDF_UINT32(out.size());
    HPDF_ResetStream(impl_->doc);
    if (size > 0) HPDF_ReadFromStream(impl_->doc, reinterpret_cast<HPDF_BYTE*>(out.data()), &size);
    out.resize(size);
  }
  if (impl_->failure != HPDF_OK || out.empty())
    return fail(ErrorCode::internal,
                "the pages could not be made: libharu tells error " + std::to_string(impl_->failure) +
                    "; report this with the design",
                "pdf", double(impl_->failure));
  return out;
}

}  // namespace bw::drawings
