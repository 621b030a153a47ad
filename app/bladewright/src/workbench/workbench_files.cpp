// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Designs, surfaces and results as files.
#include "bw/geometry/export.h"
#include "bw/pipeline/earlier_files.h"
#include "workbench/examples.h"
#include "workbench/workbench.h"

namespace bw::app {

namespace fs = std::filesystem;

Result<void> Workbench::openFile(const fs::path& file) {
  const auto refuse = [this](const Error& error) -> Result<void> {
    tell({Severity::error, QString::fromStdString(error.message), {}, {}});
    return tl::unexpected<Error>(error);
  };
  if (lowerSuffix(file) == ".bladewright") {
    if (Result<void> opened = document_.open(file); !opened) return refuse(opened.error());
  } else {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
      return refuse({ErrorCode::cannotRead,
                     tr("there is no file %1").arg(QString::fromStdString(file.string())).toStdString(),
                     file.string()});
    Design design;
    const fs::path absolute = fs::absolute(file, error);
    design.name = file.stem().string();
    design.source.path = error ? file : absolute;
    if (Result<Blade> blade = bladePreset(design.job.blade.name)) design.job.blade = *blade;
    document_.start(std::move(design));
  }
  settings_.addRecentFile(file);
  return {};
}

Result<void> Workbench::openExample(const std::string& name) {
  Result<Design> design = exampleDesign(name);
  if (!design) {
    tell({Severity::error, QString::fromStdString(design.error().message), {}, {}});
    return tl::unexpected<Error>(design.error());
  }
  document_.start(std::move(*design));
  return {};
}

bool Workbench::saveTo(const fs::path& file) {
  if (Result<void> saved = document_.saveAs(file); !saved) {
    tell({Severity::error, QString::fromStdString(saved.error().message), {}, {}});
    return false;
  }
  settings_.addRecentFile(file);
  return true;
}

void Workbench::write(const fs::path& folder, const QString& name, bool everything) {
  exporting_ = true;
  exportProblem_.clear();
  const std::shared_ptr<const Design> design = document_.design();
  const auto findings = std::make_shared<Issues>();
  const auto removals = std::make_shared<std::size_t>(0);
  const auto task = [folder, everything, findings, removals](pipeline::Evaluation evaluation,
                                                             const RunContext& context) -> Result<void> {
    Result<FileSet> files;
    if (everything) {
      files = pipeline::resultFiles(evaluation, context);
      *findings = evaluation.programs;
    } else {
      const Result<Cell> cell = loadCell(evaluation.design.job.cell);
      if (!cell) return tl::unexpected<Error>(cell.error());
      files = pipeline::programFiles(evaluation, *cell, evaluation.design.job.programs,
                                     evaluation.design.name, {}, *findings);
      // Nothing is left to write where the only program is refused.
      if (files && files->paths().empty() && !findings->empty())
        return fail(ErrorCode::badInput, findings->front().message, "programs");
    }
    if (!files) return tl::unexpected<Error>(files.error());
    if (context.stopped()) return stoppedError();
    const Source& source = evaluation.design.source;
    const Result<std::vector<fs::path>> removed = pipeline::commitAfresh(
        *files, folder, source.bytes.empty() ? std::vector{source.path} : std::vector<fs::path>());
    if (!removed) return tl::unexpected<Error>(removed.error());
    *removals = removed->size();
    return {};
  };
  runner_.submit(name, task, [this, folder, design, findings, removals](const Result<void>& done) {
    exporting_ = false;
    if (done) {
      exported_ = design;
      exportFolder_ = folder;
      tellWritten(*findings, *removals);
    } else if (done.error().code == ErrorCode::cancelled) {
      tell({Severity::info, tr("The export was stopped; nothing was written."), {}, {}});
    } else {
      exportProblem_ = QString::fromStdString(done.error().message);
      tell({Severity::error, exportProblem_, {}, {}});
    }
    emit stateChanged();
  });
  emit stateChanged();
}

void Workbench::tellWritten(const Issues& findings, std::size_t removed) {
  QString written = tr("Written to %1").arg(QString::fromStdString(exportFolder_.string()));
  if (removed > 0)
    written += removed == 1 ? tr(" (1 file of an earlier run was removed)")
                            : tr(" (%1 files of an earlier run were removed)").arg(removed);
  // A change that came while the files were written has findings of its own.
  if (exported_ == document_.design()) {
    exportFindings_ = findings;
    emit messagesChanged();
  }
  if (findings.empty()) return tell({Severity::info, written, {}, {}});
  if (findings.front().kind == pipeline::kProgramIssue) {
    return tell({findings.front().severity,
                 tr("%1, but %2.").arg(written, QString::fromStdString(findings.front().message)),
                 {},
                 {}});
  }
  QString first = QString::fromStdString(findings.front().message);
  if (!first.isEmpty()) first[0] = first[0].toUpper();
  const QString more =
      findings.size() > 1 ? tr(" The messages hold all %1 findings.").arg(findings.size()) : QString();
  tell({Severity::warning,
        tr("%1. The check of the programs warns: %2.%3").arg(written, first, more),
        {},
        {}});
}

void Workbench::exportAll(const fs::path& folder) { write(folder, tr("Writing files"), true); }

void Workbench::exportPrograms(const fs::path& folder) { write(folder, tr("Writing programs"), false); }

}  // namespace bw::app
