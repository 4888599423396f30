// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pictures whose lines people have marked, and how well extracted lines cover them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/stripe.h"

namespace lightstripe {

/// One marked piece of a line.
struct LabelledLine {
  std::vector<Eigen::Vector2d> places;  ///< px, at most 1 px apart
  double half_width = 3;                ///< px, of the visible bar
  bool laser = false;                   ///< else it counts neither as missed nor as false
};

struct LabelledPicture {
  std::filesystem::path file;
  std::string set;  ///< its folder's name
  std::vector<LabelledLine> lines;
};

/// Every <set>/<picture>.json of a folder, by name: {"image": file, "lines": [{"points": [[x, y] ...],
/// "half_width": px, "kind": "laser" | "ignore"} ...]}. An Error where the folder has none, or one is no such
/// file.
std::vector<LabelledPicture> read_labelled_pictures(const std::filesystem::path& folder);

/// What is wrong with one picture, in the words of the page.
struct LineFault {
  double length_px = 0;
  std::string text;
};

struct LabelScore {
  double laser_px = 0, covered_px = 0;
  std::int64_t points = 0, false_points = 0, near_points = 0;
  double squares = 0;  ///< px^2, of the near points' distances to their label
  std::vector<LineFault> missed, false_lines;

  bool has_laser() const { return laser_px > 0; }
  double cover() const { return has_laser() ? covered_px / laser_px : 1.0; }
  bool complete() const { return cover() >= 0.95; }
  bool missed_all() const { return cover() < 0.05; }
  bool has_false_lines() const {
    return false_points > 8 && static_cast<double>(false_points) > 0.02 * static_cast<double>(points);
  }
};

/// A label is covered where a point lies within max(2 px, 0.35 of the full width), a point is false farther
/// than max(3 px, 0.75 of the full width) from every label.
LabelScore score_lines(const std::vector<LabelledLine>& labels, const std::vector<Stripe>& stripes);

/// Says of each stretch that was missed, and of each line that is false, what it looks like in the picture.
void explain_score(const std::vector<LabelledLine>& labels, const std::vector<Stripe>& stripes,
                   ImageView8 image, double noise, LabelScore& score);

}  // namespace lightstripe
