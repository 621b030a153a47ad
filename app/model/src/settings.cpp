// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/settings.h"

#include <QDir>
#include <QStandardPaths>

#include <algorithm>
#include <system_error>

namespace bw::model {

namespace fs = std::filesystem;

namespace {

constexpr int kRecentFiles = 10;

template <class Choice>
Choice choiceFrom(const QString& word, const QStringList& words, Choice fallback) {
  const qsizetype i = words.indexOf(word);
  return i < 0 ? fallback : Choice(i);
}

const QStringList& themeWords() {
  static const QStringList words = {"system", "light", "dark"};
  return words;
}

const QStringList& mouseWords() {
  static const QStringList words = {"rhino", "blender", "solidworks"};
  return words;
}

}  // namespace

Settings::Settings(QObject* parent)
    : QObject(parent),
      store_(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("bladewright"),
             QStringLiteral("bladewright")) {}

void Settings::store(const QString& key, const QVariant& value) {
  if (remembers_) store_.setValue(key, value);
}

ThemeChoice Settings::theme() const {
  return choiceFrom(store_.value("theme").toString(), themeWords(), ThemeChoice::system);
}

void Settings::setTheme(ThemeChoice theme) { store("theme", themeWords()[int(theme)]); }

MouseChoice Settings::mouse() const {
  return choiceFrom(store_.value("mouse").toString(), mouseWords(), MouseChoice::rhino);
}

void Settings::setMouse(MouseChoice mouse) { store("mouse", mouseWords()[int(mouse)]); }

std::vector<fs::path> Settings::recentFiles() const {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const QString& text : store_.value("recent").toStringList())
    if (fs::path file = text.toStdString(); fs::is_regular_file(file, ignored))
      files.push_back(std::move(file));
  return files;
}

void Settings::addRecentFile(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  const QString text = QString::fromStdString((error ? file : absolute).lexically_normal().string());
  QStringList list = store_.value("recent").toStringList();
  list.removeAll(text);
  list.prepend(text);
  store("recent", list.mid(0, kRecentFiles));
  emit recentFilesChanged();
}

void Settings::clearRecentFiles() {
  if (remembers_) store_.remove("recent");
  emit recentFilesChanged();
}

QString Settings::folder(const QString& use) const {
  const QString folder = store_.value("folder/" + use).toString();
  return folder.isEmpty() || !QDir(folder).exists() ? QDir::homePath() : folder;
}

void Settings::setFolder(const QString& use, const QString& folder) { store("folder/" + use, folder); }

QByteArray Settings::layout(const QString& part) const {
  return store_.value("layout/" + part).toByteArray();
}

void Settings::setLayout(const QString& part, const QByteArray& state) { store("layout/" + part, state); }

fs::path Settings::recoveryFolder() {
  return fs::path(QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation).toStdString()) /
         "bladewright" / "recovery";
}

}  // namespace bw::model
