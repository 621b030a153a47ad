// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The strict RAPID reader and the checker. A line "@@ path" begins a file; text before the first one is the
// module T_ROB1/M.mod.

#include <cstddef>
#include <cstdint>

#include "bw/robotio/rapid/rapid.h"
#include "bw/robotio/text/program_text.h"
#include "require.h"

namespace {

bw::robotio::Program split(std::string_view text) {
  bw::robotio::Program program;
  std::string path = "T_ROB1/M.mod";
  while (!text.empty()) {
    std::size_t mark = text.substr(0, 3) == "@@ " ? 0 : text.find("\n@@ ");
    if (mark != 0) {
      const std::size_t end = mark == std::string_view::npos ? text.size() : mark + 1;
      program.push_back({path, std::string(text.substr(0, end))});
      text.remove_prefix(end);
      continue;
    }
    const std::size_t end = std::min(text.find('\n'), text.size());
    path = std::string(text.substr(3, end - 3));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return program;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bw::robotio::Program program = split({reinterpret_cast<const char*>(data), size});
  const bw::Result<bw::Motion> motion = bw::robotio::readRapid(program);
  const bw::Findings findings = bw::robotio::checkRapid(program);
  for (const bw::Finding& finding : findings) {
    const auto& breach = std::get<bw::ProgramBreach>(finding.cause);
    FUZZ_REQUIRE(!breach.text.empty() && !breach.place.empty());
  }
  FUZZ_REQUIRE(motion ? bw::robotio::writeCsv(*motion).has_value() : !motion.error().message.empty());
  return 0;
}
