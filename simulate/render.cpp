// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/render.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSheetReach = 5;  // sigmas; beyond, the laser adds less than a thousandth of a grey level
constexpr double kGlowReach = 8;   // reaches; as little as that
constexpr double kAmbientFloor = 0.4;  // light that reaches a surface from everywhere
constexpr float kBend = 0.2F;  // second difference, grey levels: a 24th of it is what a single ray errs by

/// Lambert and Phong for light of strength 1 from the unit direction `to_light`.
double reflected(const SurfaceHit& hit, const Vector3d& to_light, const Vector3d& to_eye) {
  const double incidence = hit.normal.dot(to_light);
  if (incidence <= 0) return 0;
  double level = hit.material.albedo * incidence;
  if (hit.material.specular > 0) {
    const double glance = (2 * incidence * hit.normal - to_light).dot(to_eye);
    if (glance > 0) level += hit.material.specular * std::pow(glance, hit.material.shininess);
  }
  return level;
}

/// Even in the middle, 0 at the edge, as behind a Powell lens.
double fan_profile(double angle, double half_fan) {
  const double share = angle / half_fan;
  return std::abs(share) >= 1 ? 0 : 1 - share * share * share * share;
}

/// Light that entered the surface under the sheet and comes out again beside it, on the side that the camera
/// sees deeper: an exponential tail that begins under the sheet's Gaussian (their convolution). `x` and
/// `reach` in standard deviations of the sheet; its largest value is about 1 for a long reach.
double glow_tail(double x, double reach) {
  const double ratio = 1 / reach;
  return 0.5 * std::exp(std::min(0.5 * ratio * ratio - x * ratio, 50.0)) *
         std::erfc((ratio - x) / std::numbers::sqrt2);
}

/// The sheet's light over its peak at a signed distance from its middle, mm.
double sheet_profile(const SimulatedSensor& sensor, const Material& material, double distance_mm) {
  const double thickness = sensor.laser.thickness_sigma_mm, off = distance_mm / thickness;
  const double direct = std::abs(off) > kSheetReach ? 0.0 : std::exp(-0.5 * off * off);
  if (material.glow.share <= 0) return direct;
  const double away = sensor.sheet.signed_distance(sensor.world_from_camera.translation) > 0 ? -1 : 1;
  const double reach = material.glow.reach_mm / thickness, beside = away * off;
  if (beside < -kSheetReach || beside > kSheetReach + kGlowReach * reach) return direct;
  return direct + material.glow.share * glow_tail(beside, reach);
}

/// In [0, 1], the same for the same lattice point.
double lattice_value(double x, double y, double z) {
  const auto part = [](double v) { return scatter_bits(static_cast<std::uint64_t>(std::llround(v))); };
  return Random(part(x) ^ scatter_bits(part(y) ^ scatter_bits(part(z)))).uniform();
}

/// What a textured albedo is multiplied by at a point of the surface: value noise of the grain's size,
/// mean 1.
double texture_factor(const Material& material, const Vector3d& p_world) {
  if (material.texture.contrast <= 0) return 1;
  // Trilinear interpolation of uniform values has this standard deviation, on average over the cells.
  constexpr double kSpread = 0.157;  // sqrt(1 / 12 (2 / 3)^3)
  // The lattice stands askew, since a surface along one of its planes would show no mean over the cells.
  const Eigen::AngleAxisd askew(1.0, Vector3d(1, 2, 3).normalized());
  const Vector3d p = askew * p_world / material.texture.grain_mm, corner = p.array().floor(), t = p - corner;
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const Vector3d step(k & 1, k >> 1 & 1, k >> 2);
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] > 0 ? t[axis] : 1 - t[axis];
    sum += weight * lattice_value(corner.x() + step.x(), corner.y() + step.y(), corner.z() + step.z());
  }
  return std::max(0.0, 1 + material.texture.contrast * (sum - 0.5) / kSpread);
}

/// Offsets from a pixel's centre: points in a quarter of the pixel and their turns by 90, 180 and 270
/// degrees, so that odd moments and the mixed second moment vanish as they do for the pixel's area. Each
/// offset along x and along y occurs once (a Hammersley set), which places upright and level edges to
/// 1/samples px.
std::vector<Vector2d> sample_pattern(int samples) {
  if (samples == 1) return {Vector2d::Zero()};
  std::vector<Vector2d> out;
  const int n = samples / 4;
  for (int i = 0; i < n; ++i) {
    double mirrored_bits = 0, weight = 0.5;
    for (int rest = i; rest > 0; rest /= 2, weight /= 2) mirrored_bits += weight * (rest % 2);
    const double x = 0.5 * (i + 0.25) / n, y = 0.5 * (mirrored_bits + 0.75 / n);
    for (const Vector2d& turned : {Vector2d(x, y), Vector2d(-y, x), Vector2d(-x, -y), Vector2d(y, -x)})
      out.push_back(turned);
  }
  return out;
}

void set_level(const ShadedRay& level, int x, int y, Light& out) {
  out.total(x, y) = static_cast<float>(level.total);
  out.laser(x, y) = static_cast<float>(level.laser);
}

/// One ray a pixel over the whole grid.
Light render_centres(const World& world, const View& view, const RayGrid& rays, const Imaging& imaging) {
  Light out{{rays.width, rays.height}, {rays.width, rays.height}};
  for (int y = 0; y < rays.height; ++y)
    for (int x = 0; x < rays.width; ++x)
      set_level(shade(world, view, imaging, view.ray(rays.at(x, y))), x, y, out);
  return out;
}

/// Whether the picture bends more around a pixel than a single ray can stand for; even slopes do not count.
bool bends_at(const Image<float>& image, int x, int y) {
  const float twice = 2 * image(x, y);
  const auto bend = [&](int dx, int dy) {
    return std::abs(image(x - dx, y - dy) + image(x + dx, y + dy) - twice);
  };
  return std::max(std::max(bend(1, 0), bend(0, 1)), std::max(bend(1, 1), bend(1, -1))) > kBend;
}

/// Grey levels between the means of two halves of the samples above which a sharp edge crosses the pixel.
constexpr double kSharp = 1.5;

/// What an exposure's rays need.
struct Eyepiece {
  const World& world;
  const View& view;
  const RayGrid& rays;
  const Imaging& imaging;

  ShadedRay level(double x, double y) const {
    return shade(world, view, imaging, view.ray(rays.between(x, y)));
  }

  /// Mean over the samples, and how far the means of every other four of them differ.
  std::pair<ShadedRay, double> mean(const std::vector<Vector2d>& pattern, int x, int y) const {
    double halves[2] = {0, 0}, laser = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      const ShadedRay ray = level(x + pattern[i].x(), y + pattern[i].y());
      halves[i / 4 % 2] += ray.total;
      laser += ray.laser;
    }
    const double n = static_cast<double>(pattern.size());
    return {{(halves[0] + halves[1]) / n, laser / n},
            pattern.size() < 8 ? 0 : std::abs(halves[0] - halves[1]) / (n / 2)};
  }
};

/// The mean over each pixel's area; pixels with sharp edges take four times the samples. The grid's outermost
/// pixels stay as they are.
Light integrate_pixels(const Eyepiece& eye, const Light& centres) {
  const std::vector<Vector2d> pattern = sample_pattern(eye.imaging.samples);
  const std::vector<Vector2d> fine = sample_pattern(4 * eye.imaging.samples);
  Light out = centres;
  for (int y = 1; y + 1 < centres.total.height; ++y)
    for (int x = 1; x + 1 < centres.total.width; ++x) {
      if (!bends_at(centres.total, x, y)) continue;
      const auto [level, contrast] = eye.mean(pattern, x, y);
      set_level(contrast > kSharp ? eye.mean(fine, x, y).first : level, x, y, out);
    }
  return out;
}

/// The lens' blur, and the grid without its margin.
Image<float> through_lens(Image<float>& sharp, const Camera& camera, const RayGrid& rays,
                          const Imaging& imaging) {
  cv::Mat light(rays.height, rays.width, CV_32F, sharp.pixels.data());
  if (imaging.blur_sigma_px > 0) {
    const int size = 2 * blur_margin(imaging) + 1;
    cv::GaussianBlur(light, light, {size, size}, imaging.blur_sigma_px, 0, cv::BORDER_REPLICATE);
  }
  Image<float> out(camera.width, camera.height);
  light({rays.margin, rays.margin, camera.width, camera.height})
      .copyTo(cv::Mat(camera.height, camera.width, CV_32F, out.pixels.data()));
  return out;
}

}  // namespace

double laser_level(const World& world, const View& view, const Imaging& imaging, const Vector3d& p_world,
                   const SurfaceHit& hit) {
  const SimulatedSensor& sensor = *view.sensor;
  const Vector3d p = view.moved.inverse() * p_world;  // where the sensor's sheet stands at travel 0
  const double sheet = sheet_profile(sensor, hit.material, sensor.sheet.signed_distance(p));
  if (sheet == 0) return 0;
  const Vector3d to_source = sensor.source - p;
  const double distance = to_source.norm();
  const double angle = std::atan2(-to_source.dot(sensor.across), -to_source.dot(sensor.axis));
  const double fan = fan_profile(angle, sensor.laser.fan_deg / 2 * std::numbers::pi / 180);
  const double level =
      reflected(hit, view.moved.rotation * to_source / distance, (view.eye() - p_world).normalized());
  if (fan == 0 || level == 0 || blocked(world, view.source(), p_world)) return 0;
  return imaging.exposure * view.laser_power * sensor.laser.brightness * fan * sensor.reference_mm /
         distance * sheet * level;
}

ShadedRay shade(const World& world, const View& view, const Imaging& imaging, const Ray& ray) {
  if (ray.direction.isZero()) return {imaging.dark_level, 0};  // beyond what the lens can see
  std::optional<SurfaceHit> hit = first_hit(world, ray);
  if (!hit) return {imaging.dark_level, 0};
  hit->material.albedo *= texture_factor(hit->material, ray.at(hit->s));
  const double lamp =
      reflected(*hit, view.moved.rotation * imaging.light.normalized(), -ray.direction.normalized());
  const double ambient = view.ambient * (kAmbientFloor * hit->material.albedo + (1 - kAmbientFloor) * lamp);
  const double laser = view.laser_power > 0 ? laser_level(world, view, imaging, ray.at(hit->s), *hit) : 0;
  return {imaging.dark_level + imaging.exposure * ambient + laser, laser};
}

int blur_margin(const Imaging& imaging) { return static_cast<int>(std::ceil(4 * imaging.blur_sigma_px)); }

Light render_light(const World& world, const View& view, const RayGrid& rays, const Imaging& imaging) {
  Light sharp = integrate_pixels({world, view, rays, imaging}, render_centres(world, view, rays, imaging));
  const Camera& camera = view.sensor->camera;
  Light out{through_lens(sharp.total, camera, rays, imaging), {}};
  if (view.laser_power > 0 && imaging.separates_laser())
    out.laser = through_lens(sharp.laser, camera, rays, imaging);
  return out;
}

Image<float> render(const World& world, const View& view, const RayGrid& rays, const Imaging& imaging) {
  return render_light(world, view, rays, imaging).total;
}

}  // namespace lightstripe
