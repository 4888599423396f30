// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What this program computes beside what others publish: docs/conformance.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lightstripe {

struct ConformanceLine {
  std::string quantity, unit, source;
  std::string certainty;  ///< V: two independent sources agree; S: a single one; own: our own calculation
  double reference = 0, ours = 0, tolerance = 0;

  bool met() const;
};

/// What needs nothing but the built-in outlines.
std::vector<ConformanceLine> conformance_of_outlines();
/// What needs files of reference profiles and recordings: `reference/conicity` and `data/miniprof` in
/// `folder`.
std::vector<ConformanceLine> conformance_of_files(const std::filesystem::path& folder);

/// As a table of Markdown.
std::string conformance_table(const std::vector<ConformanceLine>& lines);
/// The whole page; `folder` empty: without the second table.
std::string conformance_page(const std::filesystem::path& folder);

}  // namespace lightstripe
