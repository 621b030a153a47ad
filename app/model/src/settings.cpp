// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/settings.h"

#include <QDir>
#include <QStandardPaths>

#include <algorithm>
#include <array>
#include <system_error>

namespace bw::model {

namespace fs = std::filesystem;

namespace {

constexpr int kRecentFiles = 10;
constexpr double kWidestGrid = 1000;  // mm

/// Words of the choices, in their order; the first stands for a word that is not among them.
constexpr std::array kThemeWords = {"system", "light", "dark"};
constexpr std::array kMouseWords = {"rhino", "blender", "solidworks"};

template <class Choice>
Choice choiceFrom(const QVariant& word, const std::array<const char*, 3>& words) {
  const auto found = std::ranges::find(words, word.toString());
  return found == words.end() ? Choice() : Choice(found - words.begin());
}

}  // namespace

Settings::Settings(QObject* parent)
    : QObject(parent),
      store_(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("bladewright"),
             QStringLiteral("bladewright")) {}

void Settings::store(const QString& key, const QVariant& value) {
  if (remembers_) store_.setValue(key, value);
}

ThemeChoice Settings::theme() const { return choiceFrom<ThemeChoice>(store_.value("theme"), kThemeWords); }

void Settings::setTheme(ThemeChoice theme) { store("theme", kThemeWords[std::size_t(theme)]); }

MouseChoice Settings::mouse() const { return choiceFrom<MouseChoice>(store_.value("mouse"), kMouseWords); }

void Settings::setMouse(MouseChoice mouse) { store("mouse", kMouseWords[std::size_t(mouse)]); }

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
  if (!folder.isEmpty() && QDir(folder).exists()) return folder;
  // What belongs to designs begins where these are.
  return use == "design" ? QDir::homePath() : this->folder("design");
}

void Settings::setFolder(const QString& use, const QString& folder) { store("folder/" + use, folder); }

QStringList Settings::leftOut() const { return store_.value("export/left-out").toStringList(); }

void Settings::setLeftOut(const QStringList& words) { store("export/left-out", words); }

HandleHabits Settings::handles() const {
  const HandleHabits usual;
  HandleHabits habits{store_.value("handles/symmetric", usual.symmetric).toBool(),
                      store_.value("handles/snapping", usual.snapping).toBool(),
                      store_.value("handles/grid", usual.grid).toDouble(),
                      store_.value("handles/meeting", usual.meeting).toBool()};
  // A number that somebody wrote there by hand may be none.
  if (!(habits.grid > 0 && habits.grid <= kWidestGrid)) habits.grid = usual.grid;
  return habits;
}

void Settings::setHandles(const HandleHabits& habits) {
  store("handles/symmetric", habits.symmetric);
  store("handles/snapping", habits.snapping);
  store("handles/grid", habits.grid);
  store("handles/meeting", habits.meeting);
}

bool Settings::followsFile() const { return store_.value("follow-file", true).toBool(); }

void Settings::setFollowsFile(bool on) { store("follow-file", on); }

QByteArray Settings::layout(const QString& part) const {
  return store_.value("layout/" + part).toByteArray();
}

void Settings::setLayout(const QString& part, const QByteArray& state) { store("layout/" + part, state); }

fs::path Settings::recoveryFolder() {
  return fs::path(QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation).toStdString()) /
         "bladewright" / "recovery";
}

}  // namespace bw::model
