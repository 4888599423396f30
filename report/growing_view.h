// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The page of a cloud that is still growing: written anew every few seconds, and reloaded by the browser.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/reconstruct_job.h"
#include "report/cloud_view.h"

namespace lightstripe {

class GrowingView {
 public:
  /// `page`: the file; `every`: time between two pages.
  GrowingView(std::filesystem::path page, std::string title, std::vector<std::string> sensors,
              std::chrono::milliseconds every = std::chrono::seconds(5));
  /// Of a job's cloud, named by its file.
  GrowingView(const ReconstructJob& job, const std::filesystem::path& page);

  /// Takes the section's points, ever fewer of them as the scan grows, and writes the page when it is due.
  void add(const Profile& profile);

 private:
  static constexpr std::size_t kMostPoints = 200'000;
  void write();

  std::filesystem::path page_;
  CloudView view_;
  std::chrono::milliseconds every_;
  std::chrono::steady_clock::time_point written_;
  std::int64_t step_ = 1;  ///< every so many points one is kept
};

/// Makes a job that follows a recording show it in `view`, which has to live as long as the job.
void show_growth(ReconstructJob& job, GrowingView& view);

}  // namespace lightstripe
