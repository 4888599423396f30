// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe view`: a cloud on disk -> one page to look at it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "measure/reference_shape.h"
#include "report/cloud_view.h"

namespace lightstripe {

struct ViewJob {
  std::filesystem::path cloud;          ///< .ply or .pcd
  std::filesystem::path page;           ///< empty: the cloud's name with .html
  std::filesystem::path scan;           ///< its pictures are linked to; empty: none
  std::filesystem::path rig;            ///< empty: the scan's, if there is one
  std::string nominal;                  ///< outline whose deviation colours the points; empty: none
  ObjectKind kind = ObjectKind::kRail;  ///< of the outline
  std::int64_t max_points = kMaxViewPoints;
};

struct ViewPage {
  std::filesystem::path file;
  std::int64_t total = 0;  ///< points of the cloud
  std::size_t shown = 0;   ///< points of the page
  std::size_t bytes = 0;
};

/// Nothing is written where the cloud has no points. An Error where a file is wrong or the page would replace
/// an input.
ViewPage write_view_page(const ViewJob& job);

}  // namespace lightstripe
