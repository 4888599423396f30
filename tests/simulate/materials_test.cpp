// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What real surfaces and colour cameras do to a stripe: glow, texture, white cores.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "simulate/exposure.h"

namespace lightstripe {
namespace {

World ground_of(const Material& material) {
  World world;
  world.ground = GroundObject{0, material};
  return world;
}

Imaging dark_room() {
  Imaging imaging = noise_free();
  imaging.dark_level = 0;
  return imaging;
}

/// Light left and right of the stripe (image x = world x, the camera looks straight down).
std::pair<double, double> sides_of(const Image<float>& image) {
  std::pair<double, double> out{0, 0};
  const int middle = image.height / 2;
  for (int x = 0; x < image.width; ++x)
    (x < image.width / 2 ? out.first : out.second) += double{image(x, middle)};
  return out;
}

TEST(Materials, GlowIsATailOnTheSideAwayFromTheCamera) {
  SceneSensor scene_sensor = looking_down();
  scene_sensor.position = {-300, 0, 400};
  scene_sensor.up = {0, 0, 1};
  const SimulatedSensor sensor = make_sensor(scene_sensor);
  const View view = lit_view(sensor, 0);
  Material plain{0.8}, waxy{0.8};
  waxy.glow = {0.5, 3};
  const SurfaceHit hit{0, {0, 0, 1}, waxy}, matt{0, {0, 0, 1}, plain};
  const auto added = [&](double x) {
    return laser_level(ground_of(waxy), view, dark_room(), {x, 0, 0}, hit) -
           laser_level(ground_of(plain), view, dark_room(), {x, 0, 0}, matt);
  };
  const double peak = laser_level(ground_of(plain), view, dark_room(), {0, 0, 0}, matt);
  EXPECT_NEAR(added(3) / peak, 0.5 * std::exp(-1), 0.02);  // the camera stands at x < 0
  EXPECT_NEAR(added(6) / added(3), std::exp(-1), 0.02);
  EXPECT_LT(added(-3) / peak, 1e-4);
}

TEST(Materials, TextureHasItsContrastAndStaysWithTheSurface) {
  Material stained{0.5};
  stained.texture = {0.2, 3};
  const SimulatedSensor sensor = make_sensor(looking_down(400, 300));
  Imaging imaging = dark_room();
  imaging.blur_sigma_px = 0;
  imaging.light = {0, 0, 1};
  const Image<float> image = rendered(ground_of(stained), {&sensor, {}, 100, 0}, imaging);
  double mean = 0, square = 0;
  const auto count = static_cast<double>(image.pixels.size());
  for (const float value : image.pixels) {
    mean += double{value} / count;
    square += double{value} * double{value} / count;
  }
  // 44 x 33 grains
  EXPECT_NEAR(std::sqrt(square - mean * mean) / mean / 0.2, 1, 0.1);
  const View moved{&sensor, {Eigen::Quaterniond::Identity(), Eigen::Vector3d(10, 0, 0)}, 100, 0};
  const Image<float> later = rendered(ground_of(stained), moved, imaging);
  EXPECT_NEAR(double{later(100, 100)}, double{image(130, 100)}, 0.5);  // 3 px a mm
}

TEST(Materials, AnOverexposedRedLaserHasAWhiteCoreAndARedRim) {
  const SimulatedSensor sensor = make_sensor(looking_down());
  Imaging imaging = dark_room();
  imaging.colour.pictures = Pictures::kRgb;
  imaging.colour.crosstalk = 0.2;
  imaging.exposure = 20;
  const World world = ground_of(Material{0.8});
  const View view = lit_view(sensor, 0);
  const Light light = render_light(world, view, make_ray_grid(sensor, blur_margin(imaging) + 1), imaging);
  const auto rgb = expose_rgb(light.total, light.laser, imaging, 1, 1);
  const int y = 120;
  int white = 0, red = 0;
  for (int x = 0; x < 320; ++x) {
    const std::uint8_t* p = rgb.data() + 3 * (y * 320 + x);
    white += p[0] == 255 && p[1] == 255 && p[2] > 100 ? 1 : 0;
    red += p[0] > p[1] + 80 ? 1 : 0;
    EXPECT_GE(p[0], p[1]);
  }
  EXPECT_GE(white, 3);
  EXPECT_GE(red, 2);
  const Image8 mosaic = expose_bayer(light.total, light.laser, imaging, 1, 1);
  const Image<float> green = channel_light(light.total, light.laser, imaging.colour, 1);
  EXPECT_EQ(mosaic(101, 100), std::min(255L, std::lround(green(101, 100))));
  EXPECT_EQ(mosaic(100, 100), std::min(255L, std::lround(light.total(100, 100))));
}

TEST(Materials, WithoutThemEverythingStaysAsItWas) {
  const SimulatedSensor sensor = make_sensor(looking_down());
  const auto [left, right] = sides_of(rendered(ground_of(Material{0.8}), lit_view(sensor, 0), dark_room()));
  EXPECT_NEAR(left / right, 1, 0.001);
}

}  // namespace
}  // namespace lightstripe
