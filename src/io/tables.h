// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Comma-separated tables: travel.csv, poses.csv, stripes.csv, profiles.csv. Locale-free, strict, with line
// numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/profile.h"
#include "core/rig.h"
#include "core/stripe.h"
#include "core/transform.h"

namespace lightstripe {

/// A cell as it stands, or in quotes where it would be misread. A text that a spreadsheet would run as a
/// formula gets an apostrophe ahead.
std::string csv_cell(std::string_view text);

/// image (file name) -> position. `column` is "travel_mm" or "angle_deg". Duplicate images, NaN, short rows:
/// Error with line.
std::map<std::string, double> read_image_travel(const std::filesystem::path& path, std::string_view column);

/// frame -> travel, mm or degrees by the column found ("travel_mm" or "angle_deg" as `column` says). A row
/// whose travel is an empty cell is one that the encoder did not read: left out.
std::map<std::int64_t, double> read_frame_travel(const std::filesystem::path& path, std::string_view column);

/// frame -> pose (world_from_camera or world_from_rig); quaternions must have unit length to 1e-3.
std::map<std::int64_t, Rigid3> read_poses(const std::filesystem::path& path);

/// image (file name) -> base_from_tool of a robot or CMM, mm, by the columns image,qw,qx,qy,qz,x,y,z.
std::map<std::string, Rigid3> read_image_poses(const std::filesystem::path& path);

/// One row a point of stripes.csv; `image` as given on the command line (quoted where it holds a comma or a
/// quote).
inline constexpr std::string_view kStripesHeader =
    "image,line,x,y,normal_x,normal_y,width,strength,sigma_px,flags\n";
void append_stripes(std::string& out, std::string_view image, const std::vector<Stripe>& stripes);

/// One row a point of profiles.csv; `sensor` is the index of the sensor in the rig, as in the cloud.
inline constexpr std::string_view kProfilesHeader = "frame,travel,sensor,line,x,y,z,u,v,sigma\n";
void append_profile(std::string& out, const Profile& profile);

/// profiles.csv back to profiles in the order in which their frames first appear; intensity is not kept
/// there. An Error names file and line: a missing column, a short row, no number, one frame with two travels.
std::vector<Profile> read_profiles(const std::filesystem::path& path);

}  // namespace lightstripe
