// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/hand_over.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

/// One line into the result's own memory, with growing x or y.
void copy_line(const LineSet& lines, const LineRange& r, const PixelPlace& origin,
               std::vector<StripePoint>& points) {
  points.assign(lines.points.begin() + static_cast<std::ptrdiff_t>(r.begin),
                lines.points.begin() + static_cast<std::ptrdiff_t>(r.end));
  if (origin.x != 0 || origin.y != 0)
    for (StripePoint& p : points) {
      p.x += origin.x;
      p.y += origin.y;
    }
  const double dx = points.back().x - points.front().x, dy = points.back().y - points.front().y;
  if ((std::abs(dx) >= std::abs(dy) ? dx : dy) >= 0) return;
  std::reverse(points.begin(), points.end());
  for (StripePoint& p : points) {
    p.normal_x = -p.normal_x;
    p.normal_y = -p.normal_y;
  }
}

}  // namespace

void resize_stripes(std::size_t count, ExtractionWorkspace& w, std::vector<Stripe>& stripes) {
  for (; stripes.size() > count; stripes.pop_back()) w.spare.push_back(std::move(stripes.back()));
  for (; stripes.size() < count && !w.spare.empty(); w.spare.pop_back())
    stripes.push_back(std::move(w.spare.back()));
  stripes.resize(count);
}

void hand_over(ExtractionWorkspace& w, int max_lines, const PixelPlace& origin, ExtractionResult& result) {
  w.order.clear();
  for (std::size_t g = 0; g < w.groups.count; ++g)
    for (const LineRange& r : w.groups.all[g].lines.lines) w.order.push_back({g, r});
  std::sort(w.order.begin(), w.order.end(), [](const PlacedLine& a, const PlacedLine& b) {
    if (a.range.size() != b.range.size()) return a.range.size() > b.range.size();
    return a.group != b.group ? a.group < b.group : a.range.begin < b.range.begin;
  });
  if (max_lines > 0 && w.order.size() > static_cast<std::size_t>(max_lines))
    w.order.resize(static_cast<std::size_t>(max_lines));
  resize_stripes(w.order.size(), w, result.stripes);
  for (std::size_t k = 0; k < w.order.size(); ++k)
    copy_line(w.groups.all[w.order[k].group].lines, w.order[k].range, origin, result.stripes[k].points);
}

}  // namespace lightstripe
