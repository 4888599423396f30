// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// OpenCV's dictionaries of markers by name.
#pragma once

#include <opencv2/aruco.hpp>
#include <string>

namespace lightstripe {

/// Throws an Error where there is none of that name.
cv::Ptr<cv::aruco::Dictionary> aruco_dictionary(const std::string& name);

}  // namespace lightstripe
