// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "bw/cases/cases.h"
#include "bw/pipeline/pipeline.h"
#include "session.h"

namespace bw::cli {

/// A verb's work, run after all options are parsed; returns the exit status.
using Work = std::function<int()>;

/// Each adds its verbs to `app`; the chosen one puts its work into `work`.
void addBiarcVerb(CLI::App& app, const Session& session, Work& work);
void addNumericVerbs(CLI::App& app, const Session& session, Work& work);
void addInfoVerb(CLI::App& app, const Session& session, Work& work);
void addSurfaceVerbs(CLI::App& app, const Session& session, Work& work);
void addVaryVerb(CLI::App& app, const Session& session, Work& work);
void addMouldsVerb(CLI::App& app, const Session& session, Work& work);
void addKeysVerb(CLI::App& app, const Session& session, Work& work);
void addSectionsVerb(CLI::App& app, const Session& session, Work& work);
void addVersionsVerb(CLI::App& app, const Session& session, Work& work);
void addCutsVerb(CLI::App& app, const Session& session, Work& work);
void addProgramVerbs(CLI::App& app, const Session& session, Work& work);

/// The options of a verb and its work with them: `run` gets the session and the options.
template <class Options, class Run>
void onChosen(CLI::App& verb, const Session& session, Work& work, const std::shared_ptr<Options>& options,
              Run run) {
  verb.callback([&session, &work, options, run] {
    work = [&session, options, run] { return run(session, *options); };
  });
}

/// Writes the answer of cases to `out` and says what the first that failed has to say; the exit status.
int tellAnswer(const Session& session, const std::string& out, const Result<cases::CaseAnswer>& answer);
/// True for the name of a table of points.
bool isPointTable(const std::string& file);

/// Adds the switch --despite-errors, which has robot programs of a design with errors written and marked.
void addDespiteErrors(CLI::App& verb, bool& despiteErrors);

/// "1 block", "2 blocks".
inline std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// Name, version and the versions of the libraries.
std::string versionText();

}  // namespace bw::cli
