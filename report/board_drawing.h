// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A calibration target as a drawing to scale: for `lightstripe generate board`.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/board.h"

namespace lightstripe {

/// Black shapes on white paper; mm from the upper left corner, y down.
struct BoardDrawing {
  struct Rectangle {
    double x = 0, y = 0, width = 0, height = 0;
  };
  struct Disc {
    double x = 0, y = 0, diameter = 0;
  };
  double width_mm = 0, height_mm = 0;  ///< of the page
  std::vector<Rectangle> rectangles;
  std::vector<Disc> discs;
  std::vector<std::string> lines;   ///< text at the foot: the description that a session needs, and a scale
  Eigen::Vector2d origin_mm{0, 0};  ///< the target's first corner
};

/// The target with its rim, its description printed below it, and a bar of 50 mm to measure the print by. An
/// AprilGrid is drawn as Kalibr's, `aprilgrid_file` being its description. Circles of unknown diameter get
/// half of the distance to their neighbours.
BoardDrawing draw_target(const Target& target, const std::string& aprilgrid_file = "");

/// The target as a file of the format that its name's ending says, .svg or .pdf (no name: .svg). `target` as
/// read_target() takes it; empty: a checkerboard of 11 x 8 inner corners, 10 mm.
std::string board_file_text(const std::string& target, const std::filesystem::path& file);

std::string to_svg(const BoardDrawing& drawing);
std::string to_pdf(const BoardDrawing& drawing);

}  // namespace lightstripe
