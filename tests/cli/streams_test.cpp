// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Readers and terminals that go away.

#include <gtest/gtest.h>

#include "process.h"

namespace bw::test {

TEST(Streams, AClosedMessagePipeDoesNotEndAJob) {
  const Folder folder;
  const std::string job = folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10)"));
  const Finished run =
      shell("\"$BLADE\" rationalize '" + example("panel-600x670") + "' --job '" + job + "' --out '" +
            folder / "out" + "' 2>&1 | head -n 1 >/dev/null; echo ${PIPESTATUS[0]}");
  EXPECT_EQ(run.out, "0\n");
  EXPECT_EQ(blade({"check", folder / "out"}).status, 0);
  const Finished closed = shell("\"$BLADE\" rationalize '" + example("panel-600x670") + "' --job '" + job +
                                "' --out '" + folder / "closed" + "' --progress 2>&-; echo $?");
  EXPECT_EQ(closed.out, "0\n");
}

TEST(Streams, AResultThatNobodyTakesIsStatusFour) {
  // The reader has gone before the program begins.
  const Finished gone =
      shell("exec 3> >(true); wait $!; \"$BLADE\" info '" + example("panel-600x670") + "' 2>&1 >&3; echo $?");
  EXPECT_NE(gone.out.find("cannot write to standard output"), std::string::npos) << gone.out;
  EXPECT_NE(gone.out.find("4\n"), std::string::npos) << gone.out;
}

TEST(Streams, HangUpIsLikeTermination) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 1200, "blade": {"length": 6000}})");
  for (const int signal : {SIGHUP, SIGTERM}) {
    const Finished run =
        blade({"rationalize", example("wavy-wall"), "--job", job, "--out", folder / "out", "--progress"}, {},
              "sections", signal);
    EXPECT_EQ(run.status, 130) << signal << run.err;
    EXPECT_EQ(folder.files(), std::vector<std::string>{"job.json"});
  }
}

TEST(Streams, AJobThatOutlivesItsTerminalIsLeftAlone) {
  const Folder folder;
  const std::string job =
      folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10, "programs": [])"));
  const Finished run = shell("trap '' HUP; \"$BLADE\" rationalize '" + example("panel-600x670") +
                             "' --job '" + job + "' --out '" + folder / "out" +
                             "' 2>/dev/null & writer=$!; kill -HUP $writer; wait $writer; echo $?");
  EXPECT_EQ(run.out, "0\n");
}

}  // namespace bw::test
