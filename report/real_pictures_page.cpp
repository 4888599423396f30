// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/real_pictures_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/robust.h"

namespace lightstripe {
namespace {

/// The different values of a member, in the order in which they come.
template <class Member>
std::vector<std::string> names(const std::vector<MethodScore>& scores, const Member& member) {
  std::vector<std::string> all;
  for (const MethodScore& s : scores)
    if (std::find(all.begin(), all.end(), s.*member) == all.end()) all.push_back(s.*member);
  return all;
}

/// Sums over the pictures of one set, or of all.
struct Tally {
  int pictures = 0, lit = 0, complete = 0, missed = 0, with_false = 0;
  double cover = 0, squares = 0, near = 0, slowest = 1e9;
  std::vector<double> times_ms;

  void add(const MethodScore& s) {
    ++pictures;
    with_false += s.score.has_false_lines() ? 1 : 0;
    times_ms.push_back(s.median_ms);
    if (s.median_ms > 0) slowest = std::min(slowest, s.steger_ms / s.median_ms);
    squares += s.score.squares;
    near += static_cast<double>(s.score.near_points);
    if (!s.score.has_laser()) return;
    ++lit;
    complete += s.score.complete() ? 1 : 0;
    missed += s.score.missed_all() ? 1 : 0;
    cover += s.score.cover();
  }
  double found_percent() const { return lit > 0 ? 100 * cover / lit : 100.0; }
  std::string row(const std::string& set, const std::string& method) {
    return fmt::format("| {} | {} | {} of {} | {} | {:.1f} % | {} of {} | {} | {:.2f} | {:.1f} |\n", set,
                       method, complete, lit, missed, found_percent(), with_false, pictures,
                       near > 0 ? fmt::format("{:.2f}", std::sqrt(squares / near)) : "",
                       upper_median(times_ms), slowest);
  }
};

std::string picture_table(const std::vector<MethodScore>& scores) {
  std::string text =
      R"(| set | method | complete | missed | labelled length found | with false lines | rms px | ms | least times faster than opencv-steger-kept |
|---|---|---:|---:|---:|---:|---:|---:|---:|
)";
  std::vector<std::string> sets = names(scores, &MethodScore::set);
  sets.insert(sets.begin(), "all");
  for (const std::string& set : sets)
    for (const std::string& method : names(scores, &MethodScore::method)) {
      Tally tally;
      for (const MethodScore& s : scores)
        if (s.method == method && (set == "all" || s.set == set)) tally.add(s);
      if (tally.pictures > 0) text += tally.row(set, method);
    }
  return text;
}

std::string camera_table(const std::vector<MethodScore>& cameras) {
  std::string text =
      "| camera | complete | missed | labelled length found | with false lines "
      "|\n|---|---:|---:|---:|---:|\n";
  for (const std::string& camera : names(cameras, &MethodScore::method)) {
    Tally tally;
    for (const MethodScore& s : cameras)
      if (s.method == camera) tally.add(s);
    text += fmt::format("| {} | {} of {} | {} | {:.1f} % | {} of {} |\n", camera, tally.complete, tally.lit,
                        tally.missed, tally.found_percent(), tally.with_false, tally.pictures);
  }
  return text;
}

std::string speckle_table(const std::vector<SpeckleScore>& speckle) {
  std::string text =
      R"(| contrast | grain px | stripe s px | complete | false points | rms px | with smoothing | actual / predicted variance | with smoothing |
|---:|---:|---:|---:|---:|---:|---:|---:|---:|
)";
  for (const SpeckleScore& s : speckle)
    text += fmt::format("| {:.2f} | {:.1f} | {:.0f} | {:.1f} % | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} |\n",
                        s.contrast, s.grain_px, s.sigma_px, 100 * s.completeness, s.false_points, s.rms_px,
                        s.smooth_rms_px, s.variance_ratio, s.smooth_variance_ratio);
  return text;
}

/// What is wrong with a picture: its longest faults.
std::string faults_of(const LabelScore& score) {
  constexpr std::size_t kTold = 3;
  std::string text;
  const auto add = [&](const std::vector<LineFault>& faults) {
    for (std::size_t i = 0; i < std::min(kTold, faults.size()); ++i)
      text += (text.empty() ? "" : "; ") + faults[i].text;
    if (faults.size() > kTold) text += fmt::format("; {} more", faults.size() - kTold);
  };
  if (!score.complete()) add(score.missed);
  if (score.has_false_lines()) add(score.false_lines);
  return text.empty() ? "many stretches of less than 8 px" : text;
}

std::string hard_pictures(const std::vector<MethodScore>& scores) {
  std::string text = "| picture | found | false points | what it looks like there |\n|---|---:|---:|---|\n";
  const std::string first = scores.empty() ? "" : scores.front().method;
  int told = 0;
  for (const MethodScore& s : scores) {
    if (s.method != first || (s.score.complete() && !s.score.has_false_lines())) continue;
    ++told;
    text += fmt::format("| {}/{} | {:.1f} % | {} | {} |\n", s.set, s.picture, 100 * s.score.cover(),
                        s.score.false_points, faults_of(s.score));
  }
  return told > 0 ? text : "Nothing: every picture is complete and without false lines.\n";
}

}  // namespace

std::string real_pictures_page(const std::vector<MethodScore>& scores,
                               const std::vector<MethodScore>& cameras,
                               const std::vector<SpeckleScore>& speckle) {
  return R"(# Real pictures

Made by `lightstripe bench --labels FOLDER -o docs/real_pictures.md`: every extraction method with its default options on
pictures of public rigs whose lines were marked by hand, and on rendered speckle. The pictures are not part of this project.

A picture is complete when 95 % of its marked length has a point within max(2 px, 0.35 of the bar's width), missed below 5 %;
it has false lines when more than 2 % of its points, and more than 8, lie farther than max(3 px, 0.75 of the width) from every mark.
The marks hold to about a pixel: rms px compares methods, it is no error of theirs. Times are medians on one thread.

## By set and method

)" + picture_table(scores) +
         R"(
## As other cameras would have taken them

The default method on the same pictures, changed as another camera, lens or codec would have: what hangs on the cameras that were
marked shows here. Overexposed pictures have lost what the rows call missing; grey ones have no colour to tell the laser by.

)" + camera_table(cameras) +
         R"(
## Speckle

A curved line of 480 rows, 150 grey levels high, default options, several pictures a row; rms across the line against the known centre.
The variance that `sigma_px` predicts should be the actual one: 1.

)" + speckle_table(speckle) +
         "\n## What remains hard\n\nOf the default method, picture by picture:\n\n" + hard_pictures(scores);
}

}  // namespace lightstripe
