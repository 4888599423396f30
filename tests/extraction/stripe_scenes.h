// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Analytic stripes on analytic backgrounds, with known centres: what the tests of extraction look at.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/image.h"
#include "core/random.h"
#include "core/stripe.h"
#include "extraction/lines/line_set.h"

namespace lightstripe::scenes {

/// A sample of a stripe's true centre line; samples of one curve lie at most 0.25 px apart.
struct CurvePoint {
  double x = 0, y = 0;
  double peak = 100;  ///< grey levels
  double sigma = 2;   ///< px, standard deviation across
};
using Curve = std::vector<CurvePoint>;

/// x = fx(u), y = fy(u), u in [0, 1]; peak and sigma by position as well.
inline Curve make_curve(const std::function<CurvePoint(double)>& at, int samples = 6000) {
  Curve curve;
  for (int i = 0; i < samples; ++i) curve.push_back(at(static_cast<double>(i) / (samples - 1)));
  return curve;
}

inline Curve make_line(double x0, double y0, double x1, double y1, double peak, double sigma) {
  return make_curve([=](double u) {
    return CurvePoint{x0 + u * (x1 - x0), y0 + u * (y1 - y0), peak, sigma};
  });
}

/// 1 far inside an edge, 0 far beyond it, 0.5 at it: the lens blurs it by 0.8 px.
inline double lit_inside_edge(double inside) { return 0.5 * std::erfc(-inside / (0.8 * std::sqrt(2.0))); }

/// A straight edge through (x, y); its outer side is where the normal, of any length, points to.
struct Edge {
  double x = 0, y = 0;
  double normal_x = 1, normal_y = 0;

  double beyond(double u, double v) const {
    return ((u - x) * normal_x + (v - y) * normal_y) / std::hypot(normal_x, normal_y);
  }
};

/// Grey values before noise: linear light, not clipped.
struct Canvas {
  Image<double> grey;
  double background;  ///< where nothing is drawn

  Canvas(int width, int height, double level) : grey(width, height, level), background(level) {}

  /// 1 inside a curve's ends, 0 beyond, 0.5 at them.
  static double lit(const Curve& curve, double x, double y) {
    const auto inside = [&](const CurvePoint& end, const CurvePoint& further_in) {
      const double dx = further_in.x - end.x, dy = further_in.y - end.y;
      if (std::hypot(x - end.x, y - end.y) > 30) return 1.0;
      return lit_inside_edge(((x - end.x) * dx + (y - end.y) * dy) / std::hypot(dx, dy));
    };
    return inside(curve.front(), curve[1]) * inside(curve.back(), curve[curve.size() - 2]);
  }

  /// Adds a stripe with a Gaussian profile over the distance to its curve (segment by segment, exact).
  void add(const Curve& curve) {
    Image<double> nearest(grey.width, grey.height, 1e18);
    Image<double> value(grey.width, grey.height, 0.0);
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      const CurvePoint &a = curve[i], &b = curve[i + 1];
      const int reach = static_cast<int>(6 * a.sigma) + 2;
      const int x0 = std::max(0, static_cast<int>(a.x) - reach),
                x1 = std::min(grey.width - 1, static_cast<int>(a.x) + reach);
      const int y0 = std::max(0, static_cast<int>(a.y) - reach),
                y1 = std::min(grey.height - 1, static_cast<int>(a.y) + reach);
      const double dx = b.x - a.x, dy = b.y - a.y, length2 = std::max(dx * dx + dy * dy, 1e-12);
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
          const double along = ((x - a.x) * dx + (y - a.y) * dy) / length2;
          // The stripe ends like an edge that the lens blurs by 0.8 px, not like a round cap of its own
          // width.
          const bool over_end = (i == 0 && along < 0) || (i + 2 == curve.size() && along > 1);
          const double t = over_end ? along : std::clamp(along, 0.0, 1.0);
          const double ex = x - a.x - t * dx, ey = y - a.y - t * dy, d2 = ex * ex + ey * ey;
          if (d2 >= nearest(x, y)) continue;
          nearest(x, y) = d2;
          value(x, y) = a.peak * std::exp(-0.5 * d2 / (a.sigma * a.sigma)) * lit(curve, x, y);
        }
    }
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) grey.pixels[i] += value.pixels[i];
  }

  /// Takes the share `lost` of all light over the background beyond the edge: 1 cuts stripes off, less is a
  /// stain.
  void darken_beyond(const Edge& edge, double lost = 1) {
    for (int y = 0; y < grey.height; ++y)
      for (int x = 0; x < grey.width; ++x) {
        const double share = 1 - lost + lost * lit_inside_edge(-edge.beyond(x, y));
        grey(x, y) = background + (grey(x, y) - background) * share;
      }
  }

  /// A bright ellipse with soft edges (0.7 px).
  void add_blob(double x, double y, double radius_a, double radius_b, double angle, double peak) {
    for (int v = 0; v < grey.height; ++v)
      for (int u = 0; u < grey.width; ++u) {
        const double c = std::cos(angle), s = std::sin(angle);
        const double p = ((u - x) * c + (v - y) * s) / radius_a, q = (-(u - x) * s + (v - y) * c) / radius_b;
        const double distance = (std::sqrt(p * p + q * q) - 1) * std::min(radius_a, radius_b);
        grey(u, v) += peak * 0.5 * std::erfc(distance / 1.0);
      }
  }

  /// 8-bit pixels with read noise and shot noise (variance = gain * grey), clipped.
  Image8 exposed(double read_noise, double shot_gain, std::uint64_t seed) const {
    Image8 out(grey.width, grey.height);
    Random random(seed);
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
      const double level = grey.pixels[i];
      const double noise = std::sqrt(read_noise * read_noise + shot_gain * std::max(level, 0.0));
      const double noisy = noise > 0 ? level + noise * random.gaussian() : level;
      out.pixels[i] = static_cast<std::uint8_t>(std::clamp(std::lround(noisy), 0L, 255L));
    }
    return out;
  }
};

/// One line of points 1 px apart along y = 0, `width` px wide.
inline LineSet level_line(std::size_t count, double width) {
  LineSet lines;
  for (std::size_t i = 0; i < count; ++i) {
    StripePoint& p = lines.points.emplace_back();
    p.x = static_cast<double>(i), p.normal_y = 1, p.width = width;
  }
  lines.lines.push_back({0, count});
  return lines;
}

/// How well extracted stripes cover known curves.
struct Score {
  double completeness = 0;  ///< share of the curve samples with a point within `near` px
  int points = 0;
  int false_points = 0;  ///< farther than `far` px from every curve
  double rms_px = 0;     ///< of the near points' distances to their curve
};

/// Distance to the nearest segment of the curves.
inline double distance_to(const std::vector<Curve>& curves, double x, double y) {
  double best = 1e18;
  for (const Curve& curve : curves)
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      const CurvePoint &a = curve[i], &b = curve[i + 1];
      if (std::abs(a.x - x) > 40 || std::abs(a.y - y) > 40) continue;
      const double dx = b.x - a.x, dy = b.y - a.y, length2 = std::max(dx * dx + dy * dy, 1e-12);
      const double t = std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0.0, 1.0);
      best = std::min(best, std::hypot(x - a.x - t * dx, y - a.y - t * dy));
    }
  return best;
}

inline Score score(const std::vector<Curve>& curves, const std::vector<Stripe>& stripes, double near = 1.5,
                   double far = 2.0) {
  Score s;
  double sum = 0;
  int used = 0;
  for (const Stripe& stripe : stripes)
    for (const StripePoint& p : stripe.points) {
      const double d = distance_to(curves, p.x, p.y);
      ++s.points;
      if (d > far) ++s.false_points;
      if (d > near) continue;
      sum += d * d;
      ++used;
    }
  s.rms_px = used > 0 ? std::sqrt(sum / used) : 0;
  std::size_t covered = 0, total = 0;
  for (const Curve& curve : curves)
    for (std::size_t i = 0; i < curve.size(); i += 4) {
      ++total;
      bool found = false;
      for (const Stripe& stripe : stripes) {
        for (const StripePoint& p : stripe.points)
          if (std::abs(p.x - curve[i].x) <= near && std::abs(p.y - curve[i].y) <= near &&
              std::hypot(p.x - curve[i].x, p.y - curve[i].y) <= near) {
            found = true;
            break;
          }
        if (found) break;
      }
      covered += found ? 1U : 0U;
    }
  s.completeness = total > 0 ? static_cast<double>(covered) / static_cast<double>(total) : 0;
  return s;
}

/// Figure 5 of Chen, Zhang, Sun 2013: one vertical Gaussian stripe from edge to edge.
inline constexpr int kFigure5Size = 512;
inline constexpr double kFigure5Centre = 256, kFigure5Sigma = 2.5;  // px

/// `noise_share`: standard deviation of the noise, as a share of full scale.
inline Image8 figure5_stripe(double noise_share, Random random) {
  Image8 image(kFigure5Size, kFigure5Size);
  for (int y = 0; y < kFigure5Size; ++y)
    for (int x = 0; x < kFigure5Size; ++x) {
      const double d = (x - kFigure5Centre) / kFigure5Sigma;
      const double level = 255 * std::exp(-0.5 * d * d) + 255 * noise_share * random.gaussian();
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  return image;
}

}  // namespace lightstripe::scenes
