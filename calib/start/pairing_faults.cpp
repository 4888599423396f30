// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/pairing_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/counted.h"

namespace lightstripe {
namespace {

/// For each stripe the place in the list of the board that it is tried with; none: it has no partner.
using Partners = std::vector<std::optional<std::size_t>>;

Partners shifted(std::size_t n, int by) {
  Partners partners(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto j = static_cast<std::ptrdiff_t>(i) + by;
    if (j >= 0 && j < static_cast<std::ptrdiff_t>(n)) partners[i] = static_cast<std::size_t>(j);
  }
  return partners;
}

Partners reversed(std::size_t n) {
  Partners partners(n);
  for (std::size_t i = 0; i < n; ++i) partners[i] = n - 1 - i;
  return partners;
}

/// How many stripes lie in one plane if they are cut with these boards.
std::size_t agreeing_with(const InitialValues& values, const std::vector<StripeInSpace>& stripes,
                          const Partners& partners) {
  std::vector<StripeInSpace> moved;
  for (std::size_t i = 0; i < stripes.size(); ++i) {
    if (!partners[i]) continue;
    auto stripe = stripe_in_space(values, stripes[i].view, stripes[*partners[i]].view, stripes[i].plane);
    if (stripe.points.size() >= kMinStripePoints) moved.push_back(std::move(stripe));
  }
  if (moved.size() < kMinStripePoints) return 0;
  return stripes_in_one_plane(moved).size();
}

const std::string& image_of(const InitialValues& values, const StripeInSpace& stripe) {
  return values.session.views[stripe.view].image;
}

/// n.X = d seen by a camera whose picture is turned or mirrored.
Plane flipped(const Plane& plane, double x, double y) {
  return {{x * plane.normal.x(), y * plane.normal.y(), plane.normal.z()}, plane.offset};
}

struct Flip {
  double x, y;
  const char* words;
};
constexpr std::array<Flip, 3> kFlips{{{-1, -1, "turned by 180 degrees"},
                                      {-1, 1, "mirrored left to right"},
                                      {1, -1, "mirrored top to bottom"}}};

}  // namespace

std::string guess_pairing(const InitialValues& values, const std::vector<StripeInSpace>& stripes,
                          std::size_t agreeing) {
  constexpr std::size_t kMin = 4;
  const std::size_t n = stripes.size();
  if (n < kMin || !values.session.views[stripes.front().view].laser_apart) return "";
  const auto convincing = [&](std::size_t count, const Partners& partners) {
    const auto tried = static_cast<std::size_t>(
        std::count_if(partners.begin(), partners.end(), [](const auto& p) { return p.has_value(); }));
    return count >= kMin && 3 * count >= 2 * tried && 2 * count >= 3 * agreeing;
  };
  for (const int by : {1, -1, 2, -2, 3, -3}) {
    const Partners partners = shifted(n, by);
    if (!convincing(agreeing_with(values, stripes, partners), partners)) continue;
    const std::size_t i = by > 0 ? 0 : static_cast<std::size_t>(-by);
    return fmt::format(
        "the laser picture of {} fits the board of {}, and so on: are the files shifted by {}?",
        image_of(values, stripes[i]), image_of(values, stripes[*partners[i]]),
        std::abs(by) == 1 ? "one" : std::to_string(std::abs(by)));
  }
  const Partners backwards = reversed(n);
  if (convincing(agreeing_with(values, stripes, backwards), backwards))
    return fmt::format(
        "the laser picture of {} fits the board of {}, and so on: is one of the two lists in reversed order?",
        image_of(values, stripes.front()), image_of(values, stripes.back()));
  return "";
}

std::string guess_partner(const InitialValues& values, const StripeInSpace& stripe, const Plane& laser) {
  constexpr double kFits = 0.0015;      // of the range
  constexpr std::ptrdiff_t kReach = 2;  // views before and behind: farther ones fit by chance
  const auto& session = values.session;
  const auto& own = session.views[stripe.view];
  if (!own.laser_apart) return "";
  std::string partner;
  double best = kFits;
  for (std::size_t i = 0; i < session.views.size(); ++i) {
    const auto& view = session.views[i];
    const auto apart = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(stripe.view);
    if (apart == 0 || std::abs(apart) > kReach || view.sensor != own.sensor || view.pose < 0) continue;
    const auto moved = stripe_in_space(values, stripe.view, i, stripe.plane);
    if (moved.points.size() < kMinStripePoints) continue;
    const double share = distance_to(laser, moved) / moved.points.front().norm();
    if (share > best) continue;
    best = share;
    partner = view.image;
  }
  return partner.empty() ? "" : fmt::format("; it fits the board of {}: were files mixed up?", partner);
}

void refuse_flipped_pictures(const InitialValues& values, const std::vector<StripeInSpace>& stripes,
                             const std::vector<const StripeInSpace*>& kept, const Plane& laser,
                             const std::string& name) {
  constexpr double kNear = 0.01;  // of the range: the camera's centre is not the picture's
  std::vector<const StripeInSpace*> off;
  for (const auto& stripe : stripes)
    if (std::find(kept.begin(), kept.end(), &stripe) == kept.end()) off.push_back(&stripe);
  if (off.size() < 2) return;
  for (const auto& flip : kFlips) {
    const Plane seen = flipped(laser, flip.x, flip.y);
    std::string images;
    std::size_t count = 0;
    for (const auto* stripe : off) {
      if (distance_to(seen, *stripe) > kNear * stripe->points.front().norm()) continue;
      if (++count <= 3) images += (images.empty() ? "" : ", ") + image_of(values, *stripe);
    }
    if (count < 2 || 2 * count < off.size()) continue;
    throw NotUsable(fmt::format(
        "{}: {} of {} look {} ({}{}): their stripes lie in the laser plane of the others seen that "
        "way; give all pictures as the camera took them",
        name, count, counted(stripes.size(), "picture"), flip.words, images, count > 3 ? ", ..." : ""));
  }
}

}  // namespace lightstripe
