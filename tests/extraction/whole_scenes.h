// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whole scenes for the tests of extraction: the paper's four kinds, a rail with reflections, a checkerboard.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "stripe_scenes.h"

namespace lightstripe::scenes {

struct Scene {
  Canvas canvas;
  std::vector<Curve> truth;
};

/// The paper's four kinds of scene, rebuilt: two lines on a wheel, crossed lines on a plate, three on a pipe,
/// five on a rail.
inline Scene paper_scene(int kind, double sigma = 3.0) {
  Scene scene{Canvas(960, 700, 4.0), {}};
  const auto add = [&](const std::function<CurvePoint(double)>& at) {
    scene.truth.push_back(make_curve(at));
  };
  if (kind == 0) {
    for (const double y : {220.0, 450.0})
      add([=](double u) {
        const double x = 60 + 840 * u;
        return CurvePoint{x, y - 90 * std::exp(-std::pow((x - 330) / 60, 2)) + 40 * u * u,
                          90 + 70 * std::sin(7 * u), sigma};
      });
    scene.canvas.add_blob(600, 330, 14, 9, 0.5, 400);
    scene.canvas.add_blob(250, 560, 7, 7, 0, 400);
  } else if (kind == 1) {
    add([=](double u) { return CurvePoint{80 + 800 * u, 120 + 450 * u, 150, sigma}; });
    add([=](double u) { return CurvePoint{870 - 780 * u, 90 + 500 * u, 130, sigma}; });
  } else if (kind == 2) {
    for (const double y : {180.0, 340.0, 500.0})
      add([=](double u) {
        const double x = 100 + 760 * u, c = (x - 480) / 420;
        return CurvePoint{x, y + 120 * (1 - std::sqrt(1 - 0.8 * c * c)), 170 * (1 - 0.7 * c * c), sigma};
      });
  } else {
    for (int k = 0; k < 5; ++k)
      add([=](double u) {
        const double y = 40 + 620 * u, bend = 1 / (1 + std::exp(-(y - 300) / 18));
        return CurvePoint{130 + 150 * k + 70 * bend + 20 * std::sin(3 * u + k), y,
                          60 + 25 * k + 40 * std::cos(9 * u), sigma};
      });
    scene.canvas.add_blob(60, 80, 18, 6, 0.3, 300);
  }
  for (const Curve& curve : scene.truth) scene.canvas.add(curve);
  return scene;
}

/// A rail's section seen from one side: foot, web, head; broken by occlusions, brightness varying five times,
/// with `blobs` saturated reflections anywhere in the picture.
inline Scene rail_scene(std::uint64_t seed, int blobs, double sigma = 1.8) {
  Scene scene{Canvas(960, 700, 6.0), {}};
  Random random(seed);
  const double shift_x = random.uniform(-30, 30), shift_y = random.uniform(-20, 20),
               phase = random.uniform(0, 6);
  // A chain of straight pieces and round corners; consecutive pieces share their ends.
  struct Piece {
    double x0, y0, x1, y1;
  };
  const std::vector<Piece> outline{
      {120, 590, 380, 560}, {400, 540, 420, 330}, {380, 290, 300, 262}, {290, 240, 300, 170}};
  const auto peak = [&](double u) { return 130 + 90 * std::sin(2.5 * u + phase); };
  double run = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Piece p = outline[k];
    const double start = run;
    scene.truth.push_back(make_curve([&](double u) {
      return CurvePoint{p.x0 + u * (p.x1 - p.x0) + shift_x, p.y0 + u * (p.y1 - p.y0) + shift_y,
                        peak(start + u), sigma};
    }));
    run += 1;
  }
  // The running surface, with a round corner of 40 px that turns by a right angle.
  scene.truth.push_back(make_curve([&](double u) {
    const double corner = 40 * 1.5707963267948966, length = corner + 420, s = u * length;
    const double a = std::min(s, corner) / 40;
    const double x = 305 + 40 * (1 - std::cos(a)) + std::max(0.0, s - corner), y = 150 - 40 * std::sin(a);
    return CurvePoint{x + shift_x, y + shift_y + 12 * std::pow(std::max(0.0, s - corner) / 420, 2),
                      peak(run + u), sigma};
  }));
  for (const Curve& curve : scene.truth) scene.canvas.add(curve);
  for (int k = 0; k < blobs; ++k) {
    const double a = random.uniform(2.5, 20), b = a * random.uniform(0.35, 1.0);
    scene.canvas.add_blob(random.uniform(20, 940), random.uniform(20, 680), a, b, random.uniform(0, 3.1),
                          500);
  }
  return scene;
}

/// A laser line over a checkerboard; `black` = share of the light that black squares give back.
/// `ambient`: grey level of white squares without the laser (0: a difference picture).
inline Scene checkerboard_scene(double angle, double black, double ambient, double sigma = 1.6) {
  Scene scene{Canvas(960, 700, ambient * 0.5), {}};
  const double c = std::cos(angle), s = std::sin(angle);
  scene.truth.push_back(make_line(480 - 250 * c, 350 - 250 * s, 480 + 250 * c, 350 + 250 * s, 180, sigma));
  Canvas stripe(960, 700, 0);
  stripe.add(scene.truth[0]);
  for (int y = 0; y < 700; ++y)
    for (int x = 0; x < 960; ++x) {
      // Squares of 45 px, turned by 0.2 rad, their edges blurred by 0.8 px.
      const double u = x * 0.980 + y * 0.199, v = -x * 0.199 + y * 0.980;
      const double wave = std::sin(u * 3.14159265 / 45) * std::sin(v * 3.14159265 / 45);
      const double white = 0.5 * std::erfc(-wave * 45 / 3.14159265 / 1.1);
      const double reflectance = black + (1 - black) * white;
      const double gradient = 0.6 + 0.4 * x / 960.0;
      const bool board = std::abs(x - 480) < 300 && std::abs(y - 350) < 260;
      scene.canvas.grey(x, y) = (board ? ambient * gradient * reflectance : 0.4 * ambient) +
                                (board ? reflectance : 0.0) * stripe.grey(x, y) + 2;
    }
  return scene;
}

}  // namespace lightstripe::scenes
