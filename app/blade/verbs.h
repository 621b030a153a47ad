// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

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
void addProgramVerbs(CLI::App& app, const Session& session, Work& work);

/// Adds the switch --despite-errors, which has robot programs of a design with errors written and marked.
std::shared_ptr<bool> addDespiteErrors(CLI::App& verb);

/// Name, version and the versions of the libraries.
std::string versionText();

}  // namespace bw::cli
