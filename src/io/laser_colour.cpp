// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/laser_colour.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "core/image.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

// A line of light covers at least this share of a picture; fewer bright pixels are noise or dead ones.
constexpr double kTopShare = 2e-4;
constexpr std::int64_t kTopPixels = 16;
constexpr int kClipped = 250;      // grey levels; cameras and codecs stop a little short of 255
constexpr int kClippedBand = 5;    // grey levels below the top that a clipped plane holds
constexpr int kLeastClipped = 64;  // grey levels; no camera's range ends below
constexpr int kDarkestCast = 15;   // grey levels by which the background may be of the opposite colour
constexpr int kWhite = 200;        // grey levels of two planes
constexpr int kCoreReach = 10;     // px from a coloured rim into a white core, kCoreSteps times
constexpr int kCoreSteps = 3;
constexpr int kMargin = 4;  // px around what was found: the foot of the stripe

cv::Mat square(int reach) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
}

/// Some 40000 pixels, evenly spread, which are enough for a statistic.
template <class T>
std::vector<T> sampled(const cv::Mat& picture) {
  std::vector<T> samples;
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(picture.total()) / 40000)));
  for (int y = step / 2; y < picture.rows; y += step)
    for (int x = step / 2; x < picture.cols; x += step) samples.push_back(picture.at<T>(y, x));
  return samples;
}

double usual_level(const cv::Mat& level) {
  auto sizes = sampled<std::int16_t>(level);
  if (sizes.empty()) return 0;
  for (std::int16_t& size : sizes) size = static_cast<std::int16_t>(std::abs(size));
  return kMadToSigma * upper_median(sizes);
}

double median_level(const cv::Mat& plane) {
  auto levels = sampled<std::uint8_t>(plane);
  return levels.empty() ? 0 : upper_median(levels);
}

double top_level(const cv::Mat& level) {
  std::array<std::int64_t, 512> counts{};
  for (int y = 0; y < level.rows; ++y) {
    const auto* row = level.ptr<std::int16_t>(y);
    for (int x = 0; x < level.cols; ++x) ++counts[static_cast<std::size_t>(std::clamp<int>(row[x], 0, 511))];
  }
  const auto wanted = std::max(
      kTopPixels, static_cast<std::int64_t>(std::llround(kTopShare * static_cast<double>(level.total()))));
  std::int64_t above = 0;
  for (int k = 511; k > 0; --k) {
    above += counts[static_cast<std::size_t>(k)];
    if (above >= wanted) return k;
  }
  return 0;
}

cv::Mat larger_of_others(const ColourPlanes& bgr, std::size_t plane) {
  cv::Mat larger;
  cv::max(bgr.at((plane + 1) % 3), bgr.at((plane + 2) % 3), larger);
  return larger;
}

/// Lenses and demosaicing give the edges of grey things coloured fringes, faint against the edge itself: that
/// is so many times as strong.
constexpr int kEdgeOverFringe = 10;

cv::Mat is_fringe(const ColourPlanes& bgr, std::size_t plane, const cv::Mat& level) {
  constexpr int kReach = 3;  // px
  const cv::Mat others = larger_of_others(bgr, plane);
  cv::Mat brightest, darkest, edge, colour;
  cv::dilate(others, brightest, square(kReach));
  cv::erode(others, darkest, square(kReach));
  cv::subtract(brightest, darkest, edge, cv::noArray(), CV_32F);
  level.convertTo(colour, CV_32F);
  return colour < 1.0 / kEdgeOverFringe * edge;
}

/// Where the plane's range ends: at 255, or lower (video range, a tone curve), where that level is so much
/// more common than those below it as only an end of the range makes it.
int clipped_level(const cv::Mat& plane) {
  constexpr int kPile = 4;  // times the band below; the round top of a line reaches 2.4
  std::array<std::int64_t, 256> counts{};
  for (int y = 0; y < plane.rows; ++y) {
    const auto* row = plane.ptr<std::uint8_t>(y);
    for (int x = 0; x < plane.cols; ++x) ++counts[row[x]];
  }
  int top = 255;
  while (top > 0 && counts[static_cast<std::size_t>(top)] == 0) --top;
  if (top >= kClipped || top < kLeastClipped) return kClipped;
  const auto band = [&](int highest) {
    std::int64_t sum = 0;
    for (int k = highest; k > highest - kClippedBand; --k) sum += counts[static_cast<std::size_t>(k)];
    return sum;
  };
  const bool piled = band(top) >= std::max(kTopPixels, kPile * band(top - kClippedBand));
  return piled ? top - kClippedBand : kClipped;
}

struct LaserMasks {
  cv::Mat sure, faint, core;  ///< CV_8U, 0 or 255; not widened
};

LaserMasks masks_of(const ColourRise& rise, const cv::Mat& plane) {
  LaserMasks m;
  m.sure = rise.level >= std::max({0.2 * rise.top, 5.0 * rise.noise, 6.0});
  m.faint = rise.level >= std::max({0.02 * rise.top, 3.0 * rise.noise, 3.0});
  const cv::Mat clipped = (plane >= clipped_level(plane)) | rise.bleached;
  cv::Mat reached;
  cv::dilate(m.sure, reached, square(kCoreReach));
  m.core = clipped & reached;
  for (int step = 1; step < kCoreSteps; ++step) {
    cv::dilate(m.core, reached, square(kCoreReach));
    m.core = clipped & reached;
  }
  return m;
}

/// A colour's picture in which the line's core is as bright as the darker one of its rims.
cv::Mat filled_rise(const ColourRise& rise, const cv::Mat& core) {
  cv::Mat filled = rise.level.clone(), closed;
  cv::morphologyEx(rise.level, closed, cv::MORPH_CLOSE, square(kCoreReach));
  closed.copyTo(filled, core);
  return filled;
}

constexpr int kTrackJump = 3;      // px from row to row along one line
constexpr int kShortestRun = 6;    // rows that a run must have to count
constexpr int kMostContrast = 60;  // grey levels; more colour does not make it more of a line

/// Length times contrast of the runs of rows whose strongest bumps lie one below the other; a bump has fallen
/// `reach` px to both sides.
double track_score(const cv::Mat& filled, const cv::Mat& plane, double least, int reach) {
  double score = 0, run_score = 0;
  int run = 0, last_x = -100, last_bump = 0;
  const auto end_run = [&] {
    if (run >= kShortestRun) score += run_score;
    run = 0;
    run_score = 0;
  };
  for (int y = 0; y < filled.rows; ++y) {
    const auto* rise = filled.ptr<std::int16_t>(y);
    const auto* raw = plane.ptr<std::uint8_t>(y);
    int best = 0, best_x = -100;
    for (int x = reach; x < filled.cols - reach; ++x) {
      const int bump = rise[x] - std::max(rise[x - reach], rise[x + reach]);
      if (bump <= best) continue;
      best = bump;
      best_x = x;
    }
    bool coloured = best >= least;
    if (coloured) {
      const auto [low, high] = std::minmax_element(raw + best_x - reach, raw + best_x + reach + 1);
      coloured = kEdgeOverFringe * best >= *high - *low;
    }
    if (!coloured || std::abs(best_x - last_x) > kTrackJump) end_run();
    if (coloured) {
      ++run;
      run_score += std::min({best, last_bump, kMostContrast});
    }
    last_x = coloured ? best_x : -100;
    last_bump = coloured ? best : 0;
  }
  end_run();
  return score;
}

/// Scatter of a plane over the places of a mask.
double scatter(const cv::Mat& plane, const cv::Mat& mask) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(plane, mean, deviation, mask);
  return deviation[0];
}

/// How much the other two planes vary where the laser is, other than with its light, over the laser's top:
/// what is printed or grows there in room light, which the laser's own plane shows as well. That varies
/// beside the laser as much; a core that the light has bleached does not.
double texture_under_laser(const ColourPlanes& bgr, std::size_t plane, const ColourRise& rise,
                           const cv::Mat& sure) {
  constexpr int kBeside = 3;  // margins
  cv::Mat others = larger_of_others(bgr, plane), where, beside;
  cv::blur(others, others, {3, 3});
  cv::dilate(sure, where, square(kMargin));
  cv::dilate(sure, beside, square(kBeside * kMargin));
  beside.setTo(0, where);
  double n = 0, e = 0, o = 0, ee = 0, eo = 0, oo = 0;
  for (int y = 0; y < where.rows; ++y)
    for (int x = 0; x < where.cols; ++x) {
      if (where.at<std::uint8_t>(y, x) == 0) continue;
      const double light = rise.level.at<std::int16_t>(y, x), other = others.at<std::uint8_t>(y, x);
      n += 1, e += light, o += other, ee += light * light, eo += light * other, oo += other * other;
    }
  const double var_light = n * ee - e * e, cov = n * eo - e * o;
  if (var_light <= 0) return 0;
  const double rest = (n * oo - o * o - cov * cov / var_light) / (n * n);
  return std::min(std::sqrt(std::max(0.0, rest)), scatter(others, beside)) / std::max(rise.top, 1.0);
}

/// Light that has outgrown the camera's range loses its colour wherever the camera, its tone curve or a blur
/// of the optics puts the top: the plane is at its brightest there, the rims on both sides are more coloured,
/// and the other planes show more of the light than the rims have colour. A dark grain or a dirty spot on the
/// line is darker by as much as it lacks in colour; white grains of wood are not that bright. `around`: mean
/// of the larger of the other planes.
cv::Mat bleached_places(const cv::Mat& plane, const cv::Mat& larger, const cv::Mat& around,
                        const cv::Mat& level, double top) {
  constexpr double kFaded = 0.7, kDarker = 0.15;       // of the colour of the rims
  constexpr double kLeastRim = 12, kLeastShare = 0.4;  // grey levels; of the line's most coloured places
  if (top < kLeastRim) return cv::Mat::zeros(level.size(), CV_8U);  // a colour that the picture has not
  cv::Mat rims, brightest, drop, light;
  cv::morphologyEx(level, rims, cv::MORPH_CLOSE, square(kCoreReach));
  cv::dilate(plane, brightest, square(kCoreReach));
  cv::subtract(brightest, plane, drop, cv::noArray(), CV_16S);
  cv::subtract(larger, around, light, cv::noArray(), CV_16S);
  return (rims >= std::max(kLeastRim, kLeastShare * top)) & (level <= kFaded * rims) &
         (drop <= kDarker * rims) & (light >= rims);
}

/// White light has no colour to tell: there it takes that of the rims on both sides.
void fill_white(const cv::Mat& white, cv::Mat& level) {
  if (cv::countNonZero(white) == 0) return;
  cv::Mat closed = level.clone();
  closed.setTo(-255, white);
  cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, square(kCoreReach));
  closed.setTo(0, white & (closed < 0));
  closed.copyTo(level, white);
}

/// `other` as it would be if the light around had no more of it than of a plane of that `usual` level. What
/// is nearly white stays: there both are clipped.
cv::Mat without_cast(const cv::Mat& other, double usual) {
  constexpr double kLeastLight = 30;  // grey levels; darker surroundings have no colour of their own
  constexpr double kLeastGain = 0.4;  // beyond it the plane holds little but noise
  constexpr double kWhitish = 180, kEnd = 240;  // grey levels: where the correction fades out
  const double light = median_level(other);
  if (light < kLeastLight) return other;
  const double gain = std::max(kLeastGain, usual / light);
  if (gain >= 1) return other;
  cv::Mat table(1, 256, CV_8U), out;
  for (int k = 0; k < 256; ++k) {
    const double white = std::clamp((k - kWhitish) / (kEnd - kWhitish), 0.0, 1.0);
    table.at<std::uint8_t>(k) = static_cast<std::uint8_t>(std::lround(k * (white + (1 - white) * gain)));
  }
  cv::LUT(other, table, out);
  return out;
}

}  // namespace

cv::Mat larger_other(const ColourPlanes& bgr, std::size_t plane) {
  const double usual = median_level(bgr.at(plane));
  cv::Mat larger;
  cv::max(without_cast(bgr.at((plane + 1) % 3), usual), without_cast(bgr.at((plane + 2) % 3), usual), larger);
  return larger;
}

ColourRise colour_rise(const ColourPlanes& bgr, std::size_t plane) {
  const cv::Mat larger = larger_other(bgr, plane);
  cv::Mat difference, around;
  cv::subtract(bgr.at(plane), larger, difference, cv::noArray(), CV_16S);
  // Beside a white core in red bloom the blue would rise as well, from far below to nought.
  cv::max(difference, cv::Scalar::all(-kDarkestCast), difference);
  ColourRise rise;
  cv::blur(difference, rise.level, {3, 3});
  const int reach = std::max(15, std::max(difference.cols, difference.rows) / 16);
  cv::blur(difference, around, {2 * reach + 1, 2 * reach + 1});
  rise.level -= around;
  const cv::Mat unfilled = rise.level.clone();
  fill_white((bgr.at(plane) >= kWhite) & (larger >= kWhite), rise.level);
  rise.noise = usual_level(rise.level);
  rise.top = top_level(rise.level);
  cv::blur(larger, around, {2 * reach + 1, 2 * reach + 1});
  rise.bleached = bleached_places(bgr.at(plane), larger, around, unfilled, rise.top);
  return rise;
}

LaserColour where_laser_colour(const ColourPlanes& bgr, std::size_t plane) {
  const ColourRise rise = colour_rise(bgr, plane);
  LaserMasks m = masks_of(rise, bgr.at(plane));
  const cv::Mat fringe = is_fringe(bgr, plane, rise.level);
  m.sure.setTo(0, fringe);
  m.faint.setTo(0, fringe);
  cv::Mat sure, faint;
  cv::dilate(m.sure | m.core, sure, square(kMargin));
  cv::dilate(m.faint | m.core, faint, square(kMargin));
  LaserColour colour;
  colour.where.reserve(sure.total());
  colour.rise.reserve(sure.total());
  for (int y = 0; y < sure.rows; ++y) {
    const auto *s = sure.ptr<std::uint8_t>(y), *f = faint.ptr<std::uint8_t>(y),
               *core = m.core.ptr<std::uint8_t>(y);
    const auto* level = rise.level.ptr<std::int16_t>(y);
    for (int x = 0; x < sure.cols; ++x) {
      colour.where.push_back(s[x] != 0   ? LaserPlace::kSure
                             : f[x] != 0 ? LaserPlace::kFaint
                                         : LaserPlace::kNone);
      colour.rise.push_back(core[x] != 0 ? kClippedRise
                                         : static_cast<std::uint8_t>(std::clamp<int>(level[x], 0, 254)));
    }
  }
  return colour;
}

LaserVote vote_for_laser(const ColourPlanes& bgr) {
  constexpr int kLargest = 500;            // px; larger pictures are looked at in halves
  constexpr double kLeastBump = 10;        // grey levels
  constexpr double kLeastShare = 0.3;      // of the brightest colour; less is the core's own tint
  constexpr double kLeastScore = 12 * 12;  // a dozen rows of a faint line
  constexpr double kClippedShare = 0.05, kUnclipped = 0.01;  // of the line's pixels
  // A texture is told along a line, not by a dozen rows.
  constexpr double kTextured = 0.5, kTexturedScore = 10 * kLeastScore;  // of the laser's top
  constexpr double kTexturedTop = 30;  // grey levels; less colour is no better seen in the excess
  ColourPlanes small = bgr;
  const int halves = std::max(bgr[0].cols, bgr[0].rows) > kLargest ? 2 : 1;
  if (halves == 2)
    for (std::size_t k = 0; k < 3; ++k) cv::resize(bgr.at(k), small.at(k), {}, 0.5, 0.5, cv::INTER_AREA);
  const std::array<ColourRise, 3> rises = {colour_rise(small, 0), colour_rise(small, 1),
                                           colour_rise(small, 2)};
  const double largest = std::max({rises[0].top, rises[1].top, rises[2].top});
  LaserVote best;
  for (const std::size_t plane : {2U, 1U, 0U}) {
    const ColourRise& rise = rises.at(plane);
    if (rise.top < kLeastBump) continue;
    const LaserMasks masks = masks_of(rise, small.at(plane));
    const double least = std::max({kLeastBump, 6.0 * rise.noise, kLeastShare * largest});
    cv::Mat filled = filled_rise(rise, masks.core);
    filled.setTo(0, is_fringe(small, plane, filled));
    double score = 0;
    for (const int reach : {6, 16})
      score = std::max({score, track_score(filled, small.at(plane), least, reach),
                        track_score(filled.t(), small.at(plane).t(), least, reach)});
    if (score < kLeastScore || score <= best.score) continue;
    const int clipped = cv::countNonZero(masks.core), lit = cv::countNonZero(masks.sure | masks.core);
    best = {static_cast<int>(plane), score, clipped > kClippedShare * lit, false};
    best.textured = score > kTexturedScore && rise.top > kTexturedTop && clipped <= kUnclipped * lit &&
                    texture_under_laser(small, plane, rise, masks.sure) > kTextured;
  }
  return best;
}

}  // namespace lightstripe
