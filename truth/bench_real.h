// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The methods on labelled real pictures and on speckle, for docs/real_pictures.md.
#pragma once

#include <filesystem>
#include <vector>

#include "extraction/options.h"
#include "report/real_pictures_page.h"

namespace lightstripe {

/// Every method on every labelled picture, in the order of the methods; times are medians of `repeat`.
std::vector<MethodScore> bench_labelled(const std::filesystem::path& folder, const ExtractionOptions& options,
                                        int repeat);

/// The default method on the labelled pictures as other cameras would have taken them (other_cameras.h), each
/// camera's name in the place of the method's; no times.
std::vector<MethodScore> bench_other_cameras(const std::filesystem::path& folder,
                                             const ExtractionOptions& options);

/// Contrast 0.15, 0.3, 0.5 by grain 0.8, 1.6 px by stripes of a standard deviation of 2, 4 px.
std::vector<SpeckleScore> bench_speckle(const ExtractionOptions& options, int pictures);

}  // namespace lightstripe
