// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>
#include <QObject>
#include <QSettings>
#include <QStringList>

#include <filesystem>
#include <vector>

namespace bw::model {

enum class ThemeChoice { system, light, dark };
/// Which CAD program the mouse buttons follow.
enum class MouseChoice { rhino, blender, solidworks };

/// How handles move.
struct HandleHabits {
  bool symmetric = false;  ///< with their mirror images
  bool snapping = false;   ///< from line to line of a grid
  double grid = 10;        ///< mm, its spacing
  bool meeting = false;    ///< in line with blocks and with other points
  bool operator==(const HandleHabits&) const = default;
};

/// What is remembered between starts; kept in the user's configuration folder.
class Settings : public QObject {
  Q_OBJECT

 public:
  explicit Settings(QObject* parent = nullptr);

  /// From now on nothing is written to the settings and files opened do not become recent ones: for a run
  /// that must leave no trace.
  void forgetAll() { remembers_ = false; }

  ThemeChoice theme() const;
  void setTheme(ThemeChoice theme);
  MouseChoice mouse() const;
  void setMouse(MouseChoice mouse);

  /// Newest first; files that are gone are left out.
  std::vector<std::filesystem::path> recentFiles() const;
  void addRecentFile(const std::filesystem::path& file);
  void clearRecentFiles();

  /// The folder where the last file of that use ("open", "export") was; at first that of designs, or home.
  QString folder(const QString& use) const;
  void setFolder(const QString& use, const QString& folder);

  /// Words of the kinds of files that exports leave out; none at first.
  QStringList leftOut() const;
  void setLeftOut(const QStringList& words);

  HandleHabits handles() const;
  void setHandles(const HandleHabits& habits);

  /// Whether a linked file that changes is read again by itself; it is at first.
  bool followsFile() const;
  void setFollowsFile(bool on);

  QByteArray layout(const QString& part) const;
  void setLayout(const QString& part, const QByteArray& state);

  /// Where autosaved copies lie.
  static std::filesystem::path recoveryFolder();

 signals:
  void recentFilesChanged();

 private:
  void store(const QString& key, const QVariant& value);

  QSettings store_;
  bool remembers_ = true;
};

}  // namespace bw::model
