// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One session, calibrated in 30 environments: where memory lies, how it is aligned and what it held before,
// the number of threads, the locale, and the length of the environment must not reach the rig.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "rendered_session.h"

namespace lightstripe {
namespace {

constexpr int kRuns = 30;

/// Whether this system lets a process run with its memory always at the same place (containers may not).
bool fixed_addresses_allowed() { return run_shell("setarch -R true").exit_code == 0; }

/// The lists have lengths without a common divisor but 1, so that 30 runs mix them.
std::string environment(int run, bool fixed_addresses) {
  constexpr std::array<const char*, 4> kLocales{"LC_ALL=C", "LC_ALL=C.UTF-8", "LC_ALL=de_DE.UTF-8",
                                                "LC_ALL=tr_TR.UTF-8 LANGUAGE=tr"};
  // What malloc returns: filled with a pattern, from one arena, out of line with BLAS' vectors, each block by
  // mmap.
  constexpr std::array<const char*, 5> kMemory{
      "MALLOC_PERTURB_=165", "MALLOC_ARENA_MAX=1", "MALLOC_TOP_PAD_=4112",
      "GLIBC_TUNABLES=glibc.malloc.tcache_count=0", "MALLOC_MMAP_THRESHOLD_=4096 MALLOC_PERTURB_=90"};
  constexpr std::array<const char*, 3> kBlas{"OPENBLAS_NUM_THREADS=1",
                                             "OPENBLAS_NUM_THREADS=4 OMP_NUM_THREADS=4", "OMP_NUM_THREADS=2"};
  const auto at = [run](const auto& list) { return list[static_cast<std::size_t>(run) % list.size()]; };
  // The stack begins below the environment: its length moves every variable on it.
  const std::string padding(static_cast<std::size_t>(run * 37), 'x');
  const std::string wrapper = fixed_addresses && run % 7 < 3 ? "setarch -R " : "";
  return fmt::format("{}env PADDING={} {} {} {} ", wrapper, padding, at(kLocales), at(kMemory), at(kBlas));
}

TEST(Calibrate, GivesTheSameBytesInThirtyEnvironments) {
  const TemporaryFolder folder;
  testing::RenderedSession session;
  session.poses = testing::well_spread_poses(session.target);
  testing::write_pictures(session, folder.path(), "solo");
  testing::write_session(session, folder.path(), {"solo"});
  const bool fixed = fixed_addresses_allowed();
  std::string first;
  for (int run = 0; run < kRuns; ++run) {
    const std::string where = environment(run, fixed);
    const CommandResult done =
        run_shell(fmt::format("{}{} calibrate {} -o {} --threads {}", where, LIGHTSTRIPE_COMMAND,
                              quoted(folder / "session.yaml"), quoted(folder / "rig.yaml"), 1 + run % 6));
    ASSERT_EQ(done.exit_code, 0) << where << done.err;
    const std::string rig = text_of(folder / "rig.yaml");
    ASSERT_THAT(rig, ::testing::HasSubstr("solo"));
    if (run == 0) first = rig;
    EXPECT_EQ(rig, first) << "run " << run << ": " << where;
  }
}

}  // namespace
}  // namespace lightstripe
