// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/legend/legend.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bw/core/sweep/maps.h"
#include "bw/core/text/number_text.h"

namespace bw::scene {

namespace {

constexpr int kBins = 64;
constexpr double kMaxBar = 360;  ///< device-independent pixels
constexpr double kMinBar = 60;
constexpr double kTickLine = 14;  ///< between two numbers beside the bar

/// Each value of a map counts as much as the area that it stands for, mm², or, of creases, the length, mm.
void everyValue(const ShownMap& map, const std::function<void(double value, double area)>& see) {
  for (const Row* row : map.rows) {
    const std::vector<double>& values = row->field()->values;
    for (std::size_t i = 0; i < values.size(); ++i) see(values[i], row->areas[i]);
  }
  // Those of creases as much as the length.
  for (const auto& [id, creases] : map.creases)
    for (std::size_t c = 0; c < creases->curves.size(); ++c) {
      const Polyline& curve = creases->curves[c];
      for (std::size_t k = 0; k < curve.size(); ++k) {
        const double before = k > 0 ? (curve[k] - curve[k - 1]).norm() : 0,
                     after = k + 1 < curve.size() ? (curve[k + 1] - curve[k]).norm() : 0;
        see(creases->off[c][k], 0.5 * (before + after));
      }
    }
}

std::vector<double> histogram(const ShownMap& map, int bins) {
  std::vector<double> count(std::size_t(bins), 0.0);
  const auto& [low, high] = map.colors.range;
  const double scale = bins / (high - low);
  everyValue(map, [&, from = low](double value, double area) {
    const double x = (value - from) * scale;
    if (x >= 0 && x <= bins) count[std::size_t(std::min(int(x), bins - 1))] += area;
  });
  return count;
}

std::string spanText(const FieldSummary& summary, int decimals, bool sign, const std::string& unit) {
  // Values far below the ticks keep a digit that counts.
  const double largest = std::max(std::abs(summary.min), std::abs(summary.max));
  if (largest > 0) decimals = std::max(decimals, std::min(6, int(std::ceil(-std::log10(largest)))));
  const std::string low = tickText(summary.min, decimals, sign), high = tickText(summary.max, decimals, sign);
  const std::string glue = unit.empty() || unit == "\u00b0" ? "" : " ";
  return low + " \u2026 " + high + glue + unit;
}

/// How much of the area has values in [low, high].
double areaShare(const ShownMap& map, double low, double high) {
  double within = 0, whole = 0;
  everyValue(map, [&](double value, double area) {
    if (!std::isfinite(value)) return;
    whole += area;
    if (value >= low && value <= high) within += area;
  });
  return whole > 0 ? within / whole : 0;
}

/// A share in per cent. 100 % is said only where it is true, and 0 % where there is none.
std::string shareText(double share, bool all) {
  const double said = all ? 100 : share > 0 ? std::clamp(100 * share, 0.1, 99.9) : 0;
  const bool nearly = (said > 99 && said < 100) || (said > 0 && said < 1);
  return fixedText(said, nearly ? 1 : 0) + " % ";
}
std::string shareText(const ShownMap& map, double low, double high) {
  return shareText(areaShare(map, low, high), low <= map.summary.min && map.summary.max <= high);
}

}  // namespace

void Legend::update(int width, int height, const Style& style, const ShownMap* shown,
                    const std::optional<double>& covered, unsigned contentVersion) {
  if (!shown || !style.legend) {
    key_.reset();
    canvas_.begin(height);
    canvas_.end();
    card_ = bar_ = std::nullopt;
    return;
  }
  std::vector<ItemId> rows;
  for (const Row* row : shown->rows) rows.push_back(row->id);
  for (const auto& [id, creases] : shown->creases) rows.push_back(id);
  const std::tuple key(width, height, style.dark, style.pixelRatio, shown->colors, rows, contentVersion);
  if (key == key_) return;
  key_ = key;
  draw(width, height, style, *shown, covered);
}

void Legend::draw(int width, int height, const Style& style, const ShownMap& shown,
                  const std::optional<double>& covered) {
  const Field& field = *shown.field;
  const FieldSummary& summary = shown.summary;
  const ColorMap& map = shown.colors;
  const Theme& colors = theme(style.dark);
  const double px = style.pixelRatio;
  const auto pixels = [px](double v) { return std::round(v * px); };
  const bool deviation = mapRule(field.name) == MapRule::banded;
  const Ticks ticks = legendTicks(field.name, map.range);
  const bool inWords = mapRule(field.name) == MapRule::words;
  const auto textAt = [&](double v) {
    return inWords ? std::string(mapWord(field.name, v)) : tickText(v, ticks.decimals, deviation);
  };
  const TextLook title{13 * px, true, colors.text}, label{12 * px, false, colors.text},
      small{11 * px, false, colors.secondary};

  // Texts below the bar: what the data span, and how much of them is good.
  std::vector<std::string> notes;
  if (inWords)
    for (const double v : ticks.values) {
      if (areaShare(shown, v - 0.5, v + 0.5) > 0)
        notes.push_back(shareText(shown, v - 0.5, v + 0.5) + textAt(v));
    }
  else
    notes.push_back(spanText(summary, ticks.decimals + 1, deviation, field.unit));
  if (deviation) {
    notes.push_back(shareText(shown, -map.tolerance, map.tolerance) + "within \u00b1" +
                    shortText(map.tolerance) + " mm");
    // Its line is kept while a hand moves something, so that the legend stays as it is.
    notes.push_back(covered ? shareText(*covered, *covered == 1) + "covered" : std::string());
  } else if (map.limit) {
    notes.push_back(shareText(shown, 0, *map.limit) + "within " +
                    (field.unit.empty() ? "the limit" : shortText(*map.limit, 3) + " " + field.unit));
  }

  const double margin = pixels(16), padding = pixels(12), gap = pixels(4), histogramWidth = pixels(44),
               barWidth = pixels(14);
  const double tick = pixels(5), labelGap = pixels(9);
  std::vector<double> marks;
  if (deviation && map.tolerance > 0) marks = {-map.tolerance, map.tolerance};
  if (map.limit) marks = {*map.limit};
  double labelWidth = 0;
  for (const double v : ticks.values) labelWidth = std::max(labelWidth, canvas_.textWidth(textAt(v), label));
  for (const double v : marks)
    labelWidth = std::max(labelWidth, canvas_.textWidth(tickText(v, ticks.decimals + 1, deviation), small));
  double inner = histogramWidth + gap + barWidth + labelGap + labelWidth;
  const double titleWidth = canvas_.textWidth(field.title, title);
  const double unitWidth = field.unit.empty() ? 0 : pixels(6) + canvas_.textWidth(field.unit, small);
  inner = std::max(inner, titleWidth + unitWidth);
  for (const std::string& note : notes)
    if (!note.empty()) inner = std::max(inner, canvas_.textWidth(note, small));
  inner = std::ceil(inner);

  const double head = pixels(13) + pixels(20), noteStep = pixels(17),
               foot = pixels(18) + noteStep * double(notes.size() - 1) + pixels(6);
  const double cardWidth = inner + 2 * padding;
  const double room = height - 2 * margin - 2 * padding - head - foot;
  const double barHeight = std::floor(std::min(room, kMaxBar * px));
  canvas_.begin(height);
  if (barHeight < kMinBar * px || cardWidth + 2 * margin > width) {
    canvas_.end();
    card_ = bar_ = std::nullopt;
    return;
  }
  const double cardHeight = head + barHeight + foot + 2 * padding;
  const PixelRect card{width - margin - cardWidth, std::round(0.5 * (height - cardHeight)), cardWidth,
                       cardHeight};
  const PixelRect bar{card.x + padding + histogramWidth + gap, card.y + padding + head, barWidth, barHeight};
  card_ = card;
  bar_ = bar;

  const double hair = std::max(1.0, pixels(1));
  canvas_.roundedRect({card.x - hair, card.y - hair, card.width + 2 * hair, card.height + 2 * hair},
                      pixels(7), colors.line, 0.55);
  canvas_.roundedRect(card, pixels(6), colors.panel, 0.9);
  canvas_.text(field.title, card.x + padding, card.y + padding + pixels(7), Align::left, title);
  if (!field.unit.empty()) {
    canvas_.text(field.unit, card.x + padding + titleWidth + pixels(6), card.y + padding + pixels(7),
                 Align::left, small);
  }

  const auto [low, high] = map.range;
  const auto yOf = [&](double v) { return bar.y + bar.height * (high - v) / (high - low); };

  // The bar in strips of a pixel, so that a step in the map is a step here.
  for (double y = 0; y < bar.height; y += 1) {
    canvas_.rect({bar.x, bar.y + y, bar.width, 1}, map.at(high - (y + 0.5) / bar.height * (high - low)));
  }
  // Pointed ends say that the data go on beyond the range.
  const double tip = pixels(7), middle = bar.x + 0.5 * bar.width;
  if (summary.max > high) {
    canvas_.triangle(bar.x, bar.y - hair, bar.x + bar.width, bar.y - hair, middle, bar.y - hair - tip,
                     map.at(high));
  }
  if (summary.min < low) {
    const double end = bar.y + bar.height + hair;
    canvas_.triangle(bar.x, end, middle, end + tip, bar.x + bar.width, end, map.at(low));
  }

  // The histogram grows to the left of the bar.
  const int bins = std::max(8, std::min(kBins, int(bar.height / (3 * px))));
  const std::vector<double> count = histogram(shown, bins);
  const double most = *std::max_element(count.begin(), count.end());
  for (int i = 0; i < bins && most > 0; ++i) {
    const double share = count[std::size_t(i)] / most;
    if (share <= 0) continue;
    const double y0 = std::round(bar.y + bar.height * (1 - double(i + 1) / bins)),
                 y1 = std::round(bar.y + bar.height * (1 - double(i) / bins));
    const double length = std::max(hair, std::round(share * histogramWidth));
    canvas_.rect({bar.x - gap - length, y0, length, std::max(hair, y1 - y0 - hair)}, colors.secondary, 0.5);
  }

  const auto lineAt = [&](double v) {
    return std::clamp(std::round(yOf(v) - 0.5 * hair), bar.y, bar.y + bar.height - hair);
  };
  // Marks of what is allowed: across the bar and the histogram.
  const auto inside = [&](double v) { return v >= low && v <= high; };
  for (const double v : marks) {
    if (!inside(v)) continue;
    canvas_.rect({bar.x - gap - histogramWidth, lineAt(v), histogramWidth + gap + bar.width + tick, hair},
                 colors.text, 0.85);
  }
  // A short bar has room for few numbers: every second, fifth … tick has one, zero among them.
  const double lineHeight = pixels(kTickLine), spacing = ticks.step / (high - low) * bar.height;
  long stride = 1;
  for (const long next : {2, 5, 10, 20, 50, 100})
    if (double(stride) * spacing < lineHeight) stride = next;
  std::vector<double> numbered;
  for (const double v : ticks.values) {
    canvas_.rect({bar.x + bar.width, lineAt(v), tick, hair}, colors.secondary, 0.9);
    if (std::lround(v / ticks.step) % stride != 0) continue;
    numbered.push_back(v);
    canvas_.text(textAt(v), bar.x + bar.width + labelGap + (inWords ? 0 : labelWidth), yOf(v),
                 inWords ? Align::left : Align::right, label);
  }
  // Tolerances that are no round tick get a number of their own where there is room for it.
  for (const double v : marks) {
    const bool crowded = std::any_of(numbered.begin(), numbered.end(),
                                     [&](double t) { return std::abs(yOf(t) - yOf(v)) < lineHeight; });
    if (inside(v) && !crowded) {
      canvas_.text(tickText(v, ticks.decimals + 1, deviation), bar.x + bar.width + labelGap + labelWidth,
                   yOf(v), Align::right, small);
      numbered.push_back(v);
    }
  }
  double y = bar.y + bar.height + pixels(18);
  for (const std::string& note : notes) {
    if (!note.empty()) canvas_.text(note, card.x + padding, y, Align::left, small);
    y += noteStep;
  }
  canvas_.end();
}

}  // namespace bw::scene
