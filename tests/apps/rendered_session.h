// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Calibration sessions on disk whose boards stand as a test wants them: pictures by
// tests/calib/rendered_board.h.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "../calib/rendered_board.h"
#include "command_line.h"
#include "io/images.h"

namespace lightstripe::testing {

/// One sensor before a board of 11 x 8 corners, half a metre away, its laser from below.
struct RenderedSession {
  Camera camera{480, 360, 825, 824, 242, 178, {-0.09, 0.1}};
  Target target{TargetType::kCheckerboard, 11, 8, 10, 10};
  std::vector<Plane> lasers{laser_at(0)};
  std::vector<Rigid3> poses;
  BoardLook look{.dark = 25,
                 .light = 110,
                 .background = 40,
                 .laser_peak = 140,
                 .laser_sigma_mm = 0.5,
                 .laser_dark_albedo = 0.15};
  std::string calibration = "lens: brown4, board_warp: true";

  /// A sheet that crosses the line of sight `shift_mm` from half a metre, turned about it.
  static Plane laser_at(double shift_mm, double turn_deg = 0) {
    const Eigen::Vector3d n =
        Eigen::AngleAxisd(turn_deg * kDegree, Eigen::Vector3d::UnitZ()) *
        Eigen::Vector3d(0.02, std::cos(40 * kDegree), std::sin(40 * kDegree)).normalized();
    return {n, n.z() * 500 + shift_mm};
  }
};

/// Boards on both sides of half a metre, tilted to different sides; each is crossed by laser_at(0).
inline std::vector<Rigid3> well_spread_poses(const Target& target) {
  const double tilts[][5]{{25, 10, 5, 0, 0},    {-28, 8, -12, 10, 15}, {12, -27, 20, -12, -12},
                          {-8, 26, -5, 8, 25},  {30, -18, 10, 4, -25}, {-22, -22, -20, -10, 8},
                          {5, 34, 15, 15, -10}, {-34, 4, 0, -15, -5}};
  std::vector<Rigid3> poses;
  for (const auto& t : tilts)
    poses.push_back(board_pose(target, {t[3], -0.8 * t[4], 500 + t[4]}, t[0], t[1], t[2]));
  return poses;
}

/// Pictures <folder>/<sensor>/board|laser/<i>.png. The noise depends on the place in the list.
inline void write_pictures(const RenderedSession& session, const std::filesystem::path& folder,
                           const std::string& sensor) {
  for (std::size_t i = 0; i < session.poses.size(); ++i) {
    const auto file = fmt::format("{}.png", i);
    const auto picture = [&](std::uint64_t seed, std::span<const Plane> lasers) {
      return render_board(session.camera, session.target, session.poses[i], session.look, seed, lasers);
    };
    write_image(folder / sensor / "board" / file, picture(2 * i + 1, {}));
    write_image(folder / sensor / "laser" / file, picture(2 * i + 2, session.lasers));
  }
}

inline void write_session(const RenderedSession& session, const std::filesystem::path& folder,
                          const std::vector<std::string>& sensors) {
  std::string text =
      fmt::format("target: {{type: checkerboard, inner_corners: [{}, {}], square: {}}}\nsensors:\n",
                  session.target.columns, session.target.rows, session.target.pitch_x);
  for (const auto& sensor : sensors)
    text +=
        fmt::format("  - {{name: {0}, board: {0}/board/*.png, laser: {0}/laser/*.png, laser_planes: {1}}}\n",
                    sensor, session.lasers.size());
  write_text(folder / "session.yaml", text + "calibration: {" + session.calibration + "}\n");
}

inline CommandResult calibrate_in(const std::filesystem::path& folder) {
  return run_lightstripe("calibrate " + quoted(folder / "session.yaml") + " -o " +
                         quoted(folder / "rig.yaml"));
}

}  // namespace lightstripe::testing
