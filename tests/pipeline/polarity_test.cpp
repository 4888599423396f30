// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// `polarity: dark` of a scan or session file is an option of the extraction.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "extraction/options.h"
#include "io/session_file.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScan = "rig: rig.yaml\nframes: {gauge: scan/*.png}\n";

Scan scan_of(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "polarity_scan.yaml";
  std::ofstream(file) << text;
  return read_scan(file);
}

Polarity polarity_of(const Scan& scan) {
  ExtractionOptions options;
  read_subtree(scan.extraction, options);
  return options.polarity;
}

TEST(Polarity, OfAScanIsAnOptionOfItsExtraction) {
  EXPECT_EQ(polarity_of(scan_of(kScan)), Polarity::kBright);
  EXPECT_EQ(polarity_of(scan_of(std::string(kScan) + "polarity: dark\n")), Polarity::kDark);
  const Scan both = scan_of(std::string(kScan) + "polarity: dark\nextraction: {stripe_width: 6}\n");
  EXPECT_EQ(polarity_of(both), Polarity::kDark);
  ExtractionOptions options;
  read_subtree(both.extraction, options);
  EXPECT_EQ(options.stripe_width, 6.0);
  EXPECT_EQ(polarity_of(scan_of(scan_to_yaml(both))), Polarity::kDark);
}

TEST(Polarity, IsGivenOnceAndIsBrightOrDark) {
  EXPECT_THROW(scan_of(std::string(kScan) + "polarity: dark\nextraction: {polarity: dark}\n"), Error);
  EXPECT_THROW(polarity_of(scan_of(std::string(kScan) + "polarity: grey\n")), Error);
}

}  // namespace
}  // namespace lightstripe
