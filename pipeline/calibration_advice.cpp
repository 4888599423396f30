// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "calib/board/observe_board.h"
#include "core/error.h"
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

}  // namespace

std::string calibration_advice(const Session& session, const SessionObservations& seen) {
  if (folders_are_swapped(session, seen))
    return "; the board is seen in the pictures under `laser`: swap the patterns of board and laser";
  const auto moved = std::count_if(seen.rejected.begin(), seen.rejected.end(), [](const auto& image) {
    return image.reason.find("the board moved by") != std::string::npos;
  });
  if (moved > 1)
    return fmt::format(
        "; in {} pairs the board moved between the picture without laser and that with it: are "
        "they pictures of one pose?",
        moved);
  const auto [reason, count] = commonest_reason(seen.rejected);
  if (2 * static_cast<int>(seen.rejected.size()) < seen.images) return "";
  return fmt::format("; of {} images that were left out {}: {}", seen.rejected.size(),
                     count == seen.rejected.size() ? "all" : std::to_string(count), reason);
}

}  // namespace lightstripe
