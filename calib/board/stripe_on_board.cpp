// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "calib/adjust/session_views.h"
#include "calib/board/board_edges.h"
#include "calib/board/board_map.h"
#include "calib/board/board_shift.h"
#include "calib/board/laser_look.h"
#include "calib/board/light_without_print.h"
#include "calib/board/observe_board.h"
#include "calib/start/stripe_planes.h"
#include "core/counted.h"
#include "core/error.h"
#include "core/linear_algebra.h"
#include "core/random.h"
#include "core/robust.h"
#include "extraction/extract_stripes.h"
#include "extraction/image/background.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMinPoints = 15;     // of a line on the board
constexpr double kStartTolerancePx = 1.5;  // of the search for a line
constexpr double kMinTolerancePx = 0.4;    // of its points after the fit
constexpr int kTrials = 400;
constexpr double kAlbedoRatio = 8;    // light to dark squares, the worst assumed
constexpr double kLensBlurPx = 1.2;   // lens and pixel together
constexpr double kMaxShiftPx = 0.03;  // of the centre by an albedo step, before a point is left out

/// A stripe point with its place on the board.
struct PointOnBoard {
  StripePoint point;
  Vector2d p_board;  ///< mm
  double mm_per_px;  ///< across the stripe, on the board
  bool clear;        ///< far enough from the print's edges
};

/// How near (px) an edge may come. Where the albedo is seen through a Gaussian of deviation b, a step of it
/// at distance D shifts the stripe's centre by about b^2 |component of its logarithmic gradient across the
/// stripe| = b ln(ratio) / sqrt(2 pi) |cos| exp(-D^2 / 2 b^2), largest for edges along the stripe and nothing
/// for edges across.
double margin_px(double blur_px, double cosine) {
  const double largest = blur_px * std::log(kAlbedoRatio) / std::sqrt(2 * std::numbers::pi) * cosine;
  return largest > kMaxShiftPx ? blur_px * std::sqrt(2 * std::log(largest / kMaxShiftPx)) : 0;
}

bool near_edge(const StripePoint& point, const Vector2d& p_board, const Eigen::Matrix2d& board_by_pixel,
               const Target& target) {
  // The extraction weighs the albedo with the product of its kernel and the stripe, both of deviation
  // width / (2 sqrt 3); lens and pixels blur besides. In renders of 0.5 and 0.9 mm sheets the points kept are
  // as good as with a margin half as large again, and several times as many.
  const double window_px = point.width / (2 * std::sqrt(3.0)) / std::sqrt(2.0);
  const double blur_px = std::hypot(window_px, kLensBlurPx);
  const Vector2d normal(point.normal_x, point.normal_y);
  const auto edges = nearest_edges(target, p_board);
  return std::any_of(edges.begin(), edges.end(), [&](const PrintEdge& edge) {
    const Vector2d gradient = board_by_pixel.transpose() * edge.across;  // mm across the edge / px
    const double cosine = std::abs(gradient.dot(normal)) / gradient.norm();
    return edge.distance_mm / gradient.norm() < margin_px(blur_px, cosine);
  });
}

std::vector<PointOnBoard> on_board(const std::vector<Stripe>& stripes, const BoardMap& map,
                                   const Target& target) {
  std::vector<PointOnBoard> placed;
  for (const auto& stripe : stripes) {
    for (const auto& point : stripe.points) {
      if (point.flags & kStripeBridged) continue;
      const Vector2d pixel(point.x, point.y), p = map(pixel);
      if (!carries_stripes(target, p)) continue;
      const Eigen::Matrix2d J = map.derivative(pixel);
      placed.push_back(
          {point, p, (J * Vector2d(point.normal_x, point.normal_y)).norm(), !near_edge(point, p, J, target)});
    }
  }
  return placed;
}

/// A straight line on the board.
struct LaserLine {
  Vector2d point, normal;
  double distance_px(const PointOnBoard& p) const {
    return std::abs(normal.dot(p.p_board - point)) / p.mm_per_px;
  }
};

LaserLine line_through(const Vector2d& a, const Vector2d& b) {
  const Vector2d d = (b - a).normalized();
  return {a, {-d.y(), d.x()}};
}

LaserLine fitted(const std::vector<PointOnBoard>& points, const std::vector<std::size_t>& chosen) {
  Vector2d mean = Vector2d::Zero();
  for (const auto i : chosen) mean += points[i].p_board / static_cast<double>(chosen.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto i : chosen) scatter += (points[i].p_board - mean) * (points[i].p_board - mean).transpose();
  return {mean, symmetric_eigen(scatter).vectors.col(0)};
}

std::vector<std::size_t> within(const std::vector<PointOnBoard>& points, const LaserLine& line,
                                double tolerance_px) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (line.distance_px(points[i]) < tolerance_px) chosen.push_back(i);
  return chosen;
}

/// Three times the robust deviation of the chosen points from the line.
double tolerance_px(const std::vector<PointOnBoard>& points, const std::vector<std::size_t>& chosen,
                    const LaserLine& line) {
  std::vector<double> distances;
  distances.reserve(chosen.size());
  for (const auto i : chosen) distances.push_back(line.distance_px(points[i]));
  return std::clamp(3 * kMadToSigma * upper_median(distances), kMinTolerancePx, kStartTolerancePx);
}

/// Clear points decide, so that a row of the squares' edges does not win against the stripe.
double votes(const std::vector<PointOnBoard>& points, const std::vector<std::size_t>& chosen) {
  constexpr double kNearEdge = 0.01;
  double sum = 0;
  for (const auto i : chosen) sum += points[i].clear ? 1 : kNearEdge;
  return sum;
}

/// The line with the most votes (RANSAC with fixed random numbers), refitted to those that belong to it.
std::vector<std::size_t> best_line(const std::vector<PointOnBoard>& points) {
  std::vector<std::size_t> best;
  if (points.size() < kMinPoints) return best;
  Random random(points.size());
  double most = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto a = static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()));
    const auto b = static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()));
    if ((points[a].p_board - points[b].p_board).norm() < 1e-6) continue;
    auto chosen = within(points, line_through(points[a].p_board, points[b].p_board), kStartTolerancePx);
    const double sum = votes(points, chosen);
    if (sum <= most) continue;
    most = sum;
    best = std::move(chosen);
  }
  for (int i = 0; i < 3 && best.size() >= kMinPoints; ++i) {
    const LaserLine line = fitted(points, best);
    best = within(points, line, tolerance_px(points, best, line));
  }
  if (best.size() < kMinPoints) best.clear();
  return best;
}

/// Takes the points near the line out of `points`, and returns those on it.
std::vector<PointOnBoard> take_line(std::vector<PointOnBoard>& points,
                                    const std::vector<std::size_t>& chosen) {
  std::vector<PointOnBoard> line, rest;
  for (const auto i : chosen) line.push_back(points[i]);
  const LaserLine fit = fitted(points, chosen);
  for (const auto& p : points)
    if (fit.distance_px(p) > std::max(kStartTolerancePx, p.point.width)) rest.push_back(p);
  points = std::move(rest);
  return line;
}

/// Where the line lies across the picture: its mean x, or its mean y if it runs along x.
double place_across(const std::vector<StripePoint>& line, bool upright) {
  double sum = 0;
  for (const auto& point : line) sum += upright ? point.x : point.y;
  return sum / static_cast<double>(line.size());
}

void order_lines(std::vector<std::vector<StripePoint>>& lines) {
  double x = 0, y = 0;
  for (const auto& line : lines) {
    for (const auto& point : line) {
      x += std::abs(point.normal_x);
      y += std::abs(point.normal_y);
    }
  }
  std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) {
    return place_across(a, x > y) < place_across(b, x > y);
  });
}

/// What is there instead of a line on the board.
std::string why_no_line(const std::vector<Stripe>& stripes, const std::vector<PointOnBoard>& points,
                        const BoardMap& map, const Target& target) {
  if (!points.empty())
    return fmt::format("no straight stripe on the board ({} on it)", counted(points.size(), "bright point"));
  std::size_t anywhere = 0, near = 0;
  for (const auto& stripe : stripes) {
    anywhere += stripe.points.size();
    for (const auto& point : stripe.points) {
      const Vector2d p = map({point.x, point.y}) - target.middle();
      near += std::abs(p.x()) < target.extent().x() && std::abs(p.y()) < target.extent().y();
    }
  }
  if (anywhere == 0) return "no light on the board; is the laser on in this picture, and bright enough?";
  if (near >= kMinPoints)
    return fmt::format(
        "no light on the board: the line runs beside its squares ({}); hold the board "
        "into the laser, or give target.rim_mm where a broader rim lies in the board's plane",
        counted(near, "point"));
  return fmt::format(
      "no light on the board; the picture's line ({}) is elsewhere: hold the board into "
      "the laser",
      counted(anywhere, "point"));
}

/// A board as one picture shows it.
struct BoardInPicture {
  const std::vector<Vector2d>& corners;
  const Target& target;
  std::optional<BoardMap> map;  ///< nothing where the corners span no board
};

BoardInPicture board_in_picture(const std::vector<Vector2d>& corners, const Target& target) {
  LIGHTSTRIPE_CHECK(static_cast<int>(corners.size()) == target.num_corners(),
                    "every corner of the board is needed");
  return {corners, target, fit_board_map(corners, target)};
}

StripeOnBoard select_on(const BoardInPicture& board, const std::vector<Stripe>& stripes, int laser_planes) {
  StripeOnBoard result;
  if (!board.map) {
    result.reason = "the corners span no board";
    return result;
  }
  auto points = on_board(stripes, *board.map, board.target);
  for (int i = 0; i < laser_planes; ++i) {
    const auto chosen = best_line(points);
    if (chosen.empty()) {
      result.reason = i > 0 ? fmt::format("{} of {} on the board", i, counted(laser_planes, "stripe"))
                            : why_no_line(stripes, points, *board.map, board.target);
      result.planes.clear();
      return result;
    }
    std::vector<StripePoint> kept;
    for (const auto& p : take_line(points, chosen))
      if (p.clear) kept.push_back(p.point);
    if (const auto clear = independent_points(kept).size(); clear < kMinStripePoints)
      result.reason = fmt::format(
          "only {} of the squares' edges; larger squares, or a thinner line, leave more",
          counted(clear, "independent point of it lies clear", "independent points of it lie clear"));
    result.planes.push_back(std::move(kept));
  }
  order_lines(result.planes);
  return result;
}

std::vector<Stripe> lines_on_pattern(ImageView8 image, ExtractionOptions extraction) {
  extraction.on_pattern = true;
  return extract_stripes(image, extraction).stripes;
}

/// The stripe in `light`, which is `image` or its laser light: the line must look like a laser's.
StripeOnBoard find_laser_line(ImageView8 light, ImageView8 image, const BoardInPicture& board,
                              int laser_planes, const ExtractionOptions& extraction) {
  StripeOnBoard result = select_on(board, lines_on_pattern(light, extraction), laser_planes);
  for (const auto& line : result.planes) {
    const std::string why = no_laser_because(image, line, board.corners, *board.map, board.target);
    if (why.empty()) continue;
    result.planes.clear();
    result.reason = why;
    break;
  }
  return result;
}

/// Board and stripe in one picture. Among light squares a stripe is no more than short pieces, and less than
/// the print's own contrast: it is looked for without the print first.
StripeOnBoard find_in_one_picture(ImageView8 image, const BoardInPicture& board, int laser_planes,
                                  const ExtractionOptions& extraction) {
  const auto light = board.map ? light_without_print(image, *board.map, board.target) : std::nullopt;
  if (light) {
    StripeOnBoard result = find_laser_line(light->view(), image, board, laser_planes, extraction);
    if (result.reason.empty()) return result;
  }
  return find_laser_line(image, image, board, laser_planes, extraction);
}

}  // namespace

StripeOnBoard select_stripes(const std::vector<Stripe>& stripes, const std::vector<Vector2d>& corners,
                             const Target& target, int laser_planes) {
  return select_on(board_in_picture(corners, target), stripes, laser_planes);
}

StripeOnBoard find_stripe_in_light(ImageView8 light, const std::vector<Vector2d>& corners,
                                   const Target& target, int laser_planes,
                                   const ExtractionOptions& extraction) {
  return find_laser_line(light, light, board_in_picture(corners, target), laser_planes, extraction);
}

StripeOnBoard find_stripe_on_board(ImageView8 laser, ImageView8 board, const std::vector<Vector2d>& corners,
                                   const Target& target, int laser_planes,
                                   const ExtractionOptions& extraction) {
  const BoardInPicture seen = board_in_picture(corners, target);
  if (board.empty()) return find_in_one_picture(laser, seen, laser_planes, extraction);
  StripeOnBoard result;
  if (board.width != laser.width || board.height != laser.height) {
    result.reason = fmt::format("the laser image has {} x {} pixels, the board image {} x {}", laser.width,
                                laser.height, board.width, board.height);
    return result;
  }
  constexpr double kMovedPx = 1;
  if (const auto shift = board_shift_px(laser, board, corners, target); shift && *shift > kMovedPx) {
    result.reason = fmt::format(
        "the board moved by {:.1f} px between the picture without laser and that with it", *shift);
    return result;
  }
  result = select_on(seen, lines_on_pattern(laser_light(laser, board), extraction), laser_planes);
  if (!result.planes.empty()) return result;
  const auto swapped = select_on(seen, lines_on_pattern(laser_light(board, laser), extraction), laser_planes);
  if (!swapped.planes.empty() && swapped.reason.empty())
    result.reason = "the laser line is in the picture under `board`: swap the patterns of board and laser";
  return result;
}

}  // namespace lightstripe
