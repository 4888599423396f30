// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "calib/board/observe_board.h"
#include "core/counted.h"
#include "core/error.h"
#include "core/robust.h"
#include "io/images.h"

namespace lightstripe {
namespace {

/// Of several equally frequent ones the first.
std::pair<std::string, std::size_t> commonest_reason(const std::vector<RejectedImage>& rejected) {
  std::map<std::string, std::size_t> count;
  std::pair<std::string, std::size_t> commonest;
  for (const auto& image : rejected) ++count[image.reason];
  for (const auto& image : rejected)
    if (count[image.reason] > commonest.second) commonest = {image.reason, count[image.reason]};
  return commonest;
}

/// Whether the laser's pictures show the board where the board's do not.
bool folders_are_swapped(const Session& session, const SessionObservations& seen) {
  constexpr int kLooks = 3;
  int looked_at = 0, boards = 0;
  for (const auto& picture : seen.pictures) {
    if (picture.laser.empty() || !picture.corners.empty() || looked_at == kLooks) continue;
    ++looked_at;
    try {
      boards +=
          static_cast<int>(detect_board(read_image(picture.laser, Channel::kGray), session.target).found);
    } catch (const Error&) {
      continue;
    }
  }
  return 2 * boards > looked_at;
}

bool moved_within_pair(const std::string& reason) {
  return reason.find("the board moved by") != std::string::npos;
}

/// The picture without laser whose board lies as in this one: its place in the list, within a few pixels.
std::optional<std::size_t> partner_of(const std::vector<Eigen::Vector2d>& corners,
                                      const SessionObservations& seen, const std::string& sensor) {
  constexpr double kSamePx = 3;
  for (std::size_t i = 0; i < seen.pictures.size(); ++i) {
    const auto& other = seen.pictures[i];
    if (other.sensor != sensor || other.corners.size() != corners.size()) continue;
    std::vector<double> distances;
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (is_seen(corners[k]) && is_seen(other.corners[k]))
        distances.push_back((corners[k] - other.corners[k]).norm());
    if (!distances.empty() && upper_median(distances) < kSamePx) return i;
  }
  return std::nullopt;
}

/// Which board the laser pictures show instead of their own: the first such pair, and whether most are as
/// far apart in the list; empty where most of those looked at show none of the boards.
std::string other_partners(const Session& session, const SessionObservations& seen) {
  constexpr int kLooks = 8;
  int looked_at = 0;
  std::vector<std::ptrdiff_t> steps;
  std::string first;
  for (std::size_t i = 0; i < seen.pictures.size() && looked_at < kLooks; ++i) {
    const auto& picture = seen.pictures[i];
    if (!moved_within_pair(picture.reason)) continue;
    ++looked_at;
    const BoardDetection board = detect_board(read_image(picture.laser, Channel::kGray), session.target);
    const auto partner =
        board.found ? partner_of(board.corners, seen, picture.sensor) : std::optional<std::size_t>();
    if (!partner) continue;
    steps.push_back(static_cast<std::ptrdiff_t>(*partner) - static_cast<std::ptrdiff_t>(i));
    if (first.empty())
      first = fmt::format("laser picture {} fits board picture {}", picture.laser.filename().string(),
                          seen.pictures[*partner].board.filename().string());
  }
  if (2 * static_cast<int>(steps.size()) <= looked_at) return "";
  const auto alike = std::count(steps.begin(), steps.end(), steps.front());
  if (4 * alike < 3 * static_cast<std::ptrdiff_t>(steps.size())) return first + ": are the pairs mixed up?";
  return first + fmt::format(": are the files shifted by {}?", std::abs(steps.front()));
}

}  // namespace

std::string calibration_advice(const Session& session, const SessionObservations& seen) {
  if (folders_are_swapped(session, seen))
    return "; the board is seen in the pictures under `laser`: swap the patterns of board and laser";
  const auto moved = std::count_if(seen.rejected.begin(), seen.rejected.end(),
                                   [](const auto& image) { return moved_within_pair(image.reason); });
  if (moved > 1) {
    const std::string guess = other_partners(session, seen);
    return fmt::format("; in {} the board moved between the picture without laser and that with it: {}",
                       counted(moved, "pair"), guess.empty() ? "are they pictures of one pose?" : guess);
  }
  const auto [reason, count] = commonest_reason(seen.rejected);
  if (2 * static_cast<int>(seen.rejected.size()) < seen.images) return "";
  return fmt::format("; of {} left out {}: {}",
                     counted(seen.rejected.size(), "image that was", "images that were"),
                     count == seen.rejected.size() ? "all" : std::to_string(count), reason);
}

}  // namespace lightstripe
