// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/track/track_stripes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "extraction/workspace.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

using scenes::Canvas;
using scenes::Curve;
using scenes::make_line;

constexpr int kWidth = 480, kHeight = 360;

Image8 render(const std::vector<Curve>& curves, std::uint64_t seed) {
  Canvas canvas(kWidth, kHeight, 12);
  for (const Curve& curve : curves) canvas.add(curve);
  return canvas.exposed(1.5, 0, seed);
}

Curve upper(double shift) { return make_line(40, 80 + shift, 300, 110 + shift, 120, 1.8); }
Curve lower(double shift) { return make_line(200 + shift, 200, 230 + shift, 340, 90, 1.8); }

/// A frame searched by an earlier one, and the same frame searched without.
struct Tracked {
  bool in_windows = false;
  ExtractionResult found, full;
};

Tracked track(const Image8& before, const Image8& now) {
  ExtractionWorkspace workspace;
  Tracked t;
  extract_stripes(before.view(), {}, workspace, t.found);
  const TrackReference reference = reference_of(workspace, t.found, before.view());
  t.in_windows = track_stripes(now.view(), {}, reference, workspace, t.found);
  t.full = extract_stripes(now.view());
  return t;
}

/// Share of the full search's points that the tracked one has within 0.01 px.
double equal_share(const Tracked& t) {
  double count = 0, equal = 0;
  for (const Stripe& stripe : t.full.stripes)
    for (const StripePoint& p : stripe.points) {
      ++count;
      double nearest = 1e9;
      for (const Stripe& other : t.found.stripes)
        for (const StripePoint& q : other.points)
          nearest = std::min(nearest, std::hypot(q.x - p.x, q.y - p.y));
      equal += nearest <= 0.01 ? 1 : 0;
    }
  return count > 0 ? equal / count : 0;
}

TEST(TrackStripes, PointsAreThoseOfTheFullSearchWhileLinesMoveALittle) {
  double shares = 0;
  for (int k = 0; k < 8; ++k) {
    const Tracked t = track(render({upper(0), lower(0)}, 1),
                            render({upper(0.7 * k), lower(-0.5 * k)}, static_cast<std::uint64_t>(k) + 2));
    EXPECT_TRUE(t.in_windows) << k;
    EXPECT_EQ(t.found.stripes.size(), t.full.stripes.size());
    shares += equal_share(t) / 8;
  }
  EXPECT_GT(shares, 0.999);
}

TEST(TrackStripes, ALineThatAppearsIsFoundInTheSameFrame) {
  const Tracked t = track(render({upper(0)}, 1), render({upper(0), lower(0)}, 2));
  EXPECT_TRUE(t.in_windows);
  ASSERT_EQ(t.found.stripes.size(), 2U);
  EXPECT_GT(equal_share(t), 0.999);
}

TEST(TrackStripes, AJumpIsFoundAgainInTheSameFrame) {
  const Tracked t = track(render({upper(0), lower(0)}, 1), render({upper(140), lower(0)}, 2));
  EXPECT_FALSE(t.in_windows);  // the full search was done
  ASSERT_EQ(t.found.stripes.size(), 2U);
  EXPECT_EQ(equal_share(t), 1);
}

TEST(TrackStripes, ALineThatIsGoneBringsTheFullSearch) {
  const Tracked t = track(render({upper(0), lower(0)}, 1), render({lower(0)}, 2));
  EXPECT_FALSE(t.in_windows);
  EXPECT_EQ(t.found.stripes.size(), 1U);
}

TEST(TrackStripes, WithoutLinesOrOfAnotherSizeAReferenceIsNone) {
  EXPECT_FALSE(track(render({}, 1), render({upper(0)}, 2)).in_windows);
  const Tracked t = track(Image8(320, 200, 12), render({upper(0)}, 2));
  EXPECT_FALSE(t.in_windows);
  EXPECT_EQ(t.found.stripes.size(), 1U);
}

TEST(TrackStripes, TheResultDoesNotDependOnWhatTheMemoryHeldBefore) {
  const Image8 first = render({upper(0), lower(0)}, 1), now = render({upper(2), lower(1)}, 2),
               other = render({upper(100), lower(-90)}, 3);
  ExtractionWorkspace kept, fresh;
  ExtractionResult a, b;
  extract_stripes(first.view(), {}, kept, a);
  const TrackReference reference = reference_of(kept, a, first.view());
  extract_stripes(other.view(), {}, kept, a);
  ASSERT_TRUE(track_stripes(now.view(), {}, reference, kept, a));
  ASSERT_TRUE(track_stripes(now.view(), {}, reference, fresh, b));
  ASSERT_EQ(a.stripes.size(), b.stripes.size());
  for (std::size_t k = 0; k < a.stripes.size(); ++k) {
    ASSERT_EQ(a.stripes[k].points.size(), b.stripes[k].points.size());
    for (std::size_t i = 0; i < a.stripes[k].points.size(); ++i) {
      EXPECT_EQ(a.stripes[k].points[i].x, b.stripes[k].points[i].x);
      EXPECT_EQ(a.stripes[k].points[i].sigma_px, b.stripes[k].points[i].sigma_px);
    }
  }
}

TEST(SearchWindows, OpenCellsAroundPlacesAndNothingElse) {
  SearchWindows windows;
  windows.reset(100, 50);
  windows.open(20, 20, 3);
  windows.settle();
  EXPECT_TRUE(windows.is_open(20, 20));
  EXPECT_TRUE(windows.is_open(17, 23));
  EXPECT_FALSE(windows.is_open(40, 20));
  EXPECT_FALSE(windows.is_open(-1, 20));
  ASSERT_EQ(windows.spans(20).size(), 1U);
  EXPECT_EQ(windows.spans(20)[0].begin, 16);
  EXPECT_EQ(windows.spans(20)[0].end, 24);
  EXPECT_TRUE(windows.spans(40).empty());
  SearchWindows wider;
  wider.widen(windows, 1);
  EXPECT_EQ(wider.spans(12)[0].begin, 8);
  EXPECT_EQ(wider.spans(12)[0].end, 32);
  EXPECT_TRUE(wider.spans(40).empty());
}

}  // namespace
}  // namespace lightstripe
