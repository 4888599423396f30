// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/line_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/counted.h"
#include "core/error.h"
#include "core/robust.h"
#include "io/atomic_file.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

LabelledLine labelled_line(const nlohmann::json& node) {
  LabelledLine line;
  line.half_width = node.value("half_width", 3.0);
  line.laser = node.at("kind") == "laser";
  for (const auto& point : node.at("points")) {
    const Vector2d next(point.at(0).get<double>(), point.at(1).get<double>());
    if (!line.places.empty()) {
      const Vector2d last = line.places.back();
      const int steps = std::max(1, static_cast<int>(std::ceil((next - last).norm())));
      for (int k = 1; k < steps; ++k) line.places.push_back(last + (next - last) * k / steps);
    }
    line.places.push_back(next);
  }
  return line;
}

double distance(const Vector2d& p, const std::vector<Vector2d>& to) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector2d& q : to) nearest = std::min(nearest, (p - q).squaredNorm());
  return std::sqrt(nearest);
}

std::vector<Vector2d> places_of(const std::vector<Stripe>& stripes) {
  std::vector<Vector2d> places;
  for (const Stripe& stripe : stripes)
    for (const StripePoint& p : stripe.points) places.emplace_back(p.x, p.y);
  return places;
}

double cover_reach(const LabelledLine& line) { return std::max(2.0, 0.7 * line.half_width); }

bool counts(const LabelledLine& line) { return line.laser && line.places.size() >= 2; }

bool is_false(const Vector2d& p, const std::vector<LabelledLine>& labels) {
  return std::none_of(labels.begin(), labels.end(), [&](const LabelledLine& line) {
    return distance(p, line.places) <= std::max(3.0, 1.5 * line.half_width);
  });
}

double grey_at(ImageView8 image, const Vector2d& p) {
  const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.width - 1),
            y = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.height - 1);
  return image(x, y);
}

/// Grey level of a line at a place, and how far it falls to both sides, outside its bar.
struct Relief {
  double top = 0, left = 0, right = 0;
  double smaller() const { return std::min(left, right); }
};

Relief relief_at(ImageView8 image, const Vector2d& p, const Vector2d& along, double half_width) {
  const Vector2d across(-along.y(), along.x());
  const double aside = 1.5 * half_width + 2;
  Relief relief;
  for (const double off : {-1.0, 0.0, 1.0})
    relief.top = std::max(relief.top, grey_at(image, p + off * across));
  relief.left = relief.top - grey_at(image, p - aside * across);
  relief.right = relief.top - grey_at(image, p + aside * across);
  return relief;
}

template <class Value>
double median(std::size_t begin, std::size_t end, const Value& value) {
  std::vector<double> values;
  for (std::size_t i = begin; i < end; ++i) values.push_back(value(i));
  if (values.empty()) return 0;
  return upper_median(values);
}

/// The relief along a stretch of a label, medians.
Relief relief_of(ImageView8 image, const LabelledLine& line, std::size_t begin, std::size_t end) {
  const auto one = [&](std::size_t i) {
    const std::size_t a = i > 2 ? i - 3 : 0, b = std::min(i + 3, line.places.size() - 1);
    return relief_at(image, line.places[i], (line.places[b] - line.places[a]).normalized(), line.half_width);
  };
  return {median(begin, end, [&](std::size_t i) { return one(i).top; }),
          median(begin, end, [&](std::size_t i) { return one(i).left; }),
          median(begin, end, [&](std::size_t i) { return one(i).right; })};
}

/// Why a stretch may have been missed: the first that holds.
std::string reason(const Relief& relief, double beside_px, double half_width, double noise,
                   double strongest) {
  constexpr double kNear = 4, kFaint = 0.1, kEdge = 0.3;  // label widths; of the strongest stretch; flanks
  if (beside_px < kNear * half_width)
    return fmt::format("found {:.1f} px beside the mark, the bar is {:.0f} px wide", beside_px,
                       2 * half_width);
  if (relief.top >= 250) return fmt::format("clipped, a bar of {:.0f} px", 2 * half_width);
  if (relief.smaller() < 3 * noise)
    return fmt::format("hardly out of the noise: {:.0f} grey levels, noise {:.1f}", relief.smaller(), noise);
  if (relief.smaller() < kEdge * std::max(relief.left, relief.right))
    return fmt::format("on an edge: falls by {:.0f} grey levels on one side, {:.0f} on the other",
                       std::max(relief.left, relief.right), relief.smaller());
  if (relief.smaller() < kFaint * strongest)
    return fmt::format("faint: {:.0f} grey levels, {:.0f} % of the strongest stretch", relief.smaller(),
                       100 * relief.smaller() / strongest);
  return fmt::format("{:.0f} grey levels high, the strongest stretch {:.0f}", relief.smaller(), strongest);
}

}  // namespace

std::vector<LabelledPicture> read_labelled_pictures(const fs::path& folder) {
  std::vector<LabelledPicture> pictures;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      try {
        const auto node = nlohmann::json::parse(read_file(entry.path()));
        const fs::path within = entry.path().parent_path();
        LabelledPicture picture{within / node.at("image").get<std::string>(), within.filename().string(), {}};
        for (const auto& line : node.at("lines")) picture.lines.push_back(labelled_line(line));
        pictures.push_back(std::move(picture));
      } catch (const nlohmann::json::exception& error) {
        throw Error(entry.path().string(), "is no file of labels (" + std::string(error.what()) + ")",
                    "write {\"image\": ..., \"lines\": [{\"points\": [[x, y]], \"half_width\": 3, \"kind\": "
                    "\"laser\"}]}");
      }
    }
  if (pictures.empty())
    throw Error(folder.string(), "holds no labelled pictures", "give a folder of <set>/<picture>.json");
  std::sort(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  return pictures;
}

LabelScore score_lines(const std::vector<LabelledLine>& labels, const std::vector<Stripe>& stripes) {
  const std::vector<Vector2d> found = places_of(stripes);
  LabelScore score;
  score.points = static_cast<std::int64_t>(found.size());
  for (const LabelledLine& line : labels) {
    if (!counts(line)) continue;
    score.laser_px += static_cast<double>(line.places.size());
    for (const Vector2d& p : line.places) score.covered_px += distance(p, found) <= cover_reach(line) ? 1 : 0;
    for (const Vector2d& p : found) {
      const double off = distance(p, line.places);
      if (off > cover_reach(line)) continue;
      ++score.near_points;
      score.squares += off * off;
    }
  }
  for (const Vector2d& p : found) score.false_points += is_false(p, labels) ? 1 : 0;
  return score;
}

void explain_score(const std::vector<LabelledLine>& labels, const std::vector<Stripe>& stripes,
                   ImageView8 image, double noise, LabelScore& score) {
  constexpr std::size_t kLeast = 8;  // px or points, to be told
  const std::vector<Vector2d> found = places_of(stripes);
  double strongest = 1;
  for (const LabelledLine& line : labels)
    if (counts(line))
      strongest = std::max(strongest, relief_of(image, line, 0, line.places.size()).smaller());
  for (const LabelledLine& line : labels) {
    if (!counts(line)) continue;
    for (std::size_t begin = 0; begin < line.places.size();) {
      std::size_t end = begin;
      while (end < line.places.size() && distance(line.places[end], found) > cover_reach(line)) ++end;
      if (end - begin >= kLeast) {
        const Vector2d middle = line.places[(begin + end) / 2];
        const double beside =
            median(begin, end, [&](std::size_t i) { return distance(line.places[i], found); });
        score.missed.push_back(
            {static_cast<double>(end - begin),
             fmt::format(
                 "missed {} px at ({:.0f}, {:.0f}): {}", end - begin, middle.x(), middle.y(),
                 reason(relief_of(image, line, begin, end), beside, line.half_width, noise, strongest))});
      }
      begin = end + 1;
    }
  }
  for (const Stripe& stripe : stripes) {
    std::size_t off = 0;
    for (const StripePoint& p : stripe.points) off += is_false({p.x, p.y}, labels) ? 1U : 0U;
    if (off < kLeast) continue;
    const StripePoint& middle = stripe.points[stripe.points.size() / 2];
    const double height =
        median(0, stripe.points.size(), [&](std::size_t i) { return stripe.points[i].intensity; });
    score.false_lines.push_back(
        {static_cast<double>(off),
         fmt::format("{} at ({:.0f}, {:.0f}): a line {:.0f} grey levels high, the strongest stretch "
                     "of the laser {:.0f}",
                     counted(off, "false point"), middle.x, middle.y, height, strongest)});
  }
  for (auto* faults : {&score.missed, &score.false_lines})
    std::stable_sort(faults->begin(), faults->end(),
                     [](const LineFault& a, const LineFault& b) { return a.length_px > b.length_px; });
}

}  // namespace lightstripe
