// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <string_view>
#include <vector>

#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "verbs.h"

namespace {

using namespace bw::cli;

/// A word after `blade` that is no verb, with the nearest one.
std::string unknownVerbMessage(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands(nullptr)) names.push_back(verb->get_name());
  const std::string nearest = bw::nearestWord(word, names.data(), int(names.size()));
  std::string message = "there is no verb \"" + word + "\"";
  if (!nearest.empty()) return message + "; did you mean \"" + nearest + "\"?";
  message += "; the verbs are";
  for (std::size_t i = 0; i < names.size(); ++i) message += (i ? ", " : " ") + names[i];
  return message;
}

/// The files that the options of the chosen verb read. An option without a value is an error: it is a slip in
/// a script, and would pass for the working folder or for one that was left out.
bw::Result<std::vector<std::filesystem::path>> inputsOf(const CLI::App& verb) {
  std::vector<std::filesystem::path> inputs;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    for (const std::string& value : option->results()) {
      if (value.empty())
        return bw::fail(bw::ErrorCode::badInput, name + " is empty; give it a value or leave it out", name);
      std::error_code error;
      if (name != "--out" && name != "--svg" && std::filesystem::is_regular_file(value, error))
        inputs.emplace_back(value);
    }
  }
  return inputs;
}

/// What was printed must have arrived.
int flushed(const Session& session, int status) {
  if ((std::cout << std::flush) || status > kLimitExceeded) return status;
  return session.complain({bw::ErrorCode::cannotWrite, "cannot write to standard output", "standard output"});
}

int run(int argc, char** argv) {
  Interrupt interrupt;
  Session session;
  session.stop = interrupt.token();
  const auto addCommon = [&session](CLI::App& app) {
    app.add_flag("--json-errors", session.jsonErrors, "Say errors as a JSON object on standard error");
    app.add_flag("--progress", session.progress, "Draw a progress bar on standard error");
    app.add_option("--threads", session.threads, "Worker threads (0 = all); the results do not depend on it")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
  };
  CLI::App app{
      "Bladewright's command line: elastica, surfaces for hot-blade cutting, robot programs.\n"
      "Lengths in mm, angles in rad, times in s.",
      "blade"};
  app.set_version_flag("--version", versionText());
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  Work work;
  addNumericVerbs(app, session, work);
  addInfoVerb(app, session, work);
  addSurfaceVerbs(app, session, work);
  addVaryVerb(app, session, work);
  addMouldsVerb(app, session, work);
  addKeysVerb(app, session, work);
  addSectionsVerb(app, session, work);
  addVersionsVerb(app, session, work);
  addCutsVerb(app, session, work);
  addProgramVerbs(app, session, work);
  addCommon(app);
  for (CLI::App* verb : app.get_subcommands(nullptr)) addCommon(*verb);
  if (argc > 1 && argv[1][0] != '-') {
    const std::string word = argv[1];
    const auto verbs = app.get_subcommands(nullptr);
    if (std::none_of(verbs.begin(), verbs.end(),
                     [&](const CLI::App* verb) { return verb->get_name() == word; }))
      return session.complain({bw::ErrorCode::badInput, unknownVerbMessage(app, word), word});
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return flushed(session, app.exit(e));  // --help, --version
  } catch (const CLI::ParseError& e) {
    session.jsonErrors = session.jsonErrors || std::any_of(argv, argv + argc, [](const char* a) {
                           return std::string(a) == "--json-errors";
                         });
    const auto chosen = app.get_subcommands();
    const std::string verb = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return session.complain(
        {bw::ErrorCode::badInput, std::string(e.what()) + "; see blade" + verb + " --help", "usage"});
  }
  bw::Result<std::vector<std::filesystem::path>> inputs = inputsOf(*app.get_subcommands().front());
  if (!inputs) return session.complain(inputs.error());
  session.inputs = std::move(*inputs);
  return work ? flushed(session, work()) : int(kBadInput);
}

}  // namespace

int main(int argc, char** argv) {
  // "blade help" and "blade help VERB" are "blade --help" and "blade VERB --help".
  char ask[] = "--help";
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    if (argc > 2) argv[1] = argv[2];
    argv[std::min(argc - 1, 2)] = ask;
    argc = std::min(argc, 3);
  }
  // A file that outgrows a limit is a failed write with a message, not a death by signal.
  std::signal(SIGXFSZ, SIG_IGN);
  // So is a result for a reader that went away; a message that nobody reads is no reason to end a job.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "blade: an internal error: " << bw::printable(e.what()) << "\n";
    return kInternal;
  }
}
