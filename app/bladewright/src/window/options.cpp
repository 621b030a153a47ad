// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/options.h"

#include <QRegularExpression>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/example_design.h"

namespace bw::app {

namespace {

constexpr int kSmallest = 320, kLargest = 8192;
constexpr int kMostChanges = 1000;

}  // namespace

std::optional<Options> parseOptions(const QStringList& arguments, QString* problem) {
  Options options;
  for (qsizetype i = 0; i < arguments.size(); ++i) {
    const QString& word = arguments[i];
    const auto value = [&]() -> std::optional<QString> {
      if (i + 1 < arguments.size()) return arguments[++i];
      *problem = word + " needs a value; see bladewright --help";
      return std::nullopt;
    };
    if (word == "--help" || word == "-h") {
      options.help = true;
    } else if (word == "--version") {
      options.version = true;
    } else if (word == "--quit-after-first-picture") {
      options.quitAfterFirstPicture = true;
    } else if (word == "--time-changes") {
      const auto text = value();
      if (!text) return std::nullopt;
      bool number = false;
      options.timeChanges = text->toInt(&number);
      if (!number || options.timeChanges < 1 || options.timeChanges > kMostChanges) {
        *problem =
            QStringLiteral("--time-changes takes how many changes to time, from 1 to %1, but got \"%2\"")
                .arg(kMostChanges)
                .arg(*text);
        return std::nullopt;
      }
    } else if (word == "--example") {
      const auto text = value();
      if (!text) return std::nullopt;
      std::vector<std::string> names;
      for (const auto* list : {&geometry::exampleList(), &pipeline::designedExamples()})
        for (const geometry::Example& example : *list) names.push_back(example.name);
      if (std::ranges::find(names, text->toStdString()) == names.end()) {
        const std::string nearest = nearestWord(text->toStdString(), names.data(), int(names.size()));
        *problem = QStringLiteral("there is no example \"%1\"; ").arg(*text) +
                   QString::fromStdString(nearest.empty() ? "blade example lists them"
                                                          : "did you mean \"" + nearest + "\"?");
        return std::nullopt;
      }
      options.example = *text;
    } else if (word == "--screenshot") {
      const auto text = value();
      if (!text) return std::nullopt;
      options.screenshot = *text;
    } else if (word == "--size") {
      const auto text = value();
      if (!text) return std::nullopt;
      const QRegularExpressionMatch match = QRegularExpression("^(\\d{1,5})[xX](\\d{1,5})$").match(*text);
      options.size = QSize(match.captured(1).toInt(), match.captured(2).toInt());
      const auto fits = [](int v) { return v >= kSmallest && v <= kLargest; };
      if (!match.hasMatch() || !fits(options.size.width()) || !fits(options.size.height())) {
        *problem = QStringLiteral("--size takes WIDTHxHEIGHT in pixels, each from %1 to %2, but got \"%3\"")
                       .arg(kSmallest)
                       .arg(kLargest)
                       .arg(*text);
        return std::nullopt;
      }
    } else if (word.startsWith('-') && word.size() > 1) {
      static const std::array<std::string, 7> kWords = {
          "--help",        "--version", "--example", "--screenshot", "--size", "--quit-after-first-picture",
          "--time-changes"};
      const std::string nearest = nearestWord(word.toStdString(), kWords.data(), int(kWords.size()));
      *problem =
          QStringLiteral("there is no option %1").arg(word) +
          (nearest.empty() ? QStringLiteral("; see bladewright --help")
                           : QStringLiteral("; did you mean %1?").arg(QString::fromStdString(nearest)));
      return std::nullopt;
    } else if (options.file.isEmpty()) {
      options.file = word;
    } else {
      *problem = QStringLiteral("one file at a time: %1 and %2 were given").arg(options.file, word);
      return std::nullopt;
    }
  }
  if (!options.file.isEmpty() && !options.example.isEmpty()) {
    *problem = QStringLiteral("give either a file or --example, not both: %1 and %2 were given")
                   .arg(options.file, options.example);
    return std::nullopt;
  }
  return options;
}

QString helpText() {
  return QStringLiteral(
      "bladewright [FILE] [options]\n"
      "\n"
      "Opens the window on FILE, a CAD file (STEP, IGES, BREP, DXF) or a design (.bladewright).\n"
      "\n"
      "  --example NAME               open an example of the start page, such as panel-600x670\n"
      "  --screenshot PNG             write a picture of the window once the result stands, then quit\n"
      "  --size WxH                   size of the window in pixels\n"
      "  --quit-after-first-picture   print the seconds from process start to the first picture, then quit\n"
      "  --time-changes N             print the seconds to the new picture of N changes of the station "
      "count, then quit\n"
      "  --version, --help\n");
}

}  // namespace bw::app
