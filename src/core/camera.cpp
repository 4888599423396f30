// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/camera.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace lightstripe {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFold = 1e-3;  // determinant of the lens' Jacobian below which a point counts as on its fold

/// Where a function leads, and its derivative there.
struct Mapped {
  Vector2d value;
  Matrix2d J;
};

/// The lens without the sensor's tilt: distort() with tau = 0 and its analytic Jacobian, one pass for both
/// because undistortion runs for every stripe point.
Mapped lens(const double* k, const Vector2d& at) {
  const double x = at.x(), y = at.y(), r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double inverse = 1 / (1 + k[5] * r2 + k[6] * r4 + k[7] * r6);
  const double radial = (1 + k[0] * r2 + k[1] * r4 + k[4] * r6) * inverse;
  // d(radial)/d(r^2), by the quotient rule
  const double slope =
      (k[0] + 2 * k[1] * r2 + 3 * k[4] * r4 - radial * (k[5] + 2 * k[6] * r2 + 3 * k[7] * r4)) * inverse;
  const double prism_x = 2 * (k[8] + 2 * k[9] * r2), prism_y = 2 * (k[10] + 2 * k[11] * r2);
  const double mixed = 2 * x * y * slope + 2 * k[2] * x + 2 * k[3] * y;
  Mapped out;
  out.value = {x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x) + k[8] * r2 + k[9] * r4,
               y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y + k[10] * r2 + k[11] * r4};
  out.J << radial + 2 * x * x * slope + 2 * k[2] * y + 6 * k[3] * x + prism_x * x, mixed + prism_x * y,
      mixed + prism_y * x, radial + 2 * y * y * slope + 6 * k[2] * y + 2 * k[3] * x + prism_y * y;
  return out;
}

/// The homography of the tilted sensor, as in distort().
Matrix3d tilt_homography(double tau_x, double tau_y) {
  const double cx = std::cos(tau_x), sx = std::sin(tau_x);
  const double cy = std::cos(tau_y), sy = std::sin(tau_y);
  Matrix3d R, to_sensor;
  R << cy, sy * sx, -sy * cx, 0, cx, sx, sy, -cy * sx, cy * cx;
  to_sensor << R(2, 2), 0, -R(0, 2), 0, R(2, 2), -R(1, 2), 0, 0, 1;
  return to_sensor * R;
}

Matrix3d tilt_homography(const Camera& camera) {
  return tilt_homography(camera.distortion[12], camera.distortion[13]);
}

Mapped tilt(const Matrix3d& H, const Vector2d& at) {
  const Vector3d p = H * at.homogeneous();
  Mapped out;
  out.value = p.hnormalized();
  out.J = (H.topLeftCorner<2, 2>() - out.value * H.bottomLeftCorner<1, 2>()) / p.z();
  return out;
}

using TermDerivatives = Eigen::Matrix<double, 2, kDistortionTerms>;

/// d(lens)/d(k1 k2 p1 p2 k3 .. s4); the columns of the tilt stay 0.
TermDerivatives lens_by_terms(const double* k, const Vector2d& at) {
  const double x = at.x(), y = at.y(), r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double inverse = 1 / (1 + k[5] * r2 + k[6] * r4 + k[7] * r6);
  const double radial = (1 + k[0] * r2 + k[1] * r4 + k[4] * r6) * inverse;
  TermDerivatives J = TermDerivatives::Zero();
  J.col(0) = r2 * inverse * at;
  J.col(1) = r4 * inverse * at;
  J.col(2) = Vector2d(2 * x * y, r2 + 2 * y * y);
  J.col(3) = Vector2d(r2 + 2 * x * x, 2 * x * y);
  J.col(4) = r6 * inverse * at;
  J.col(5) = -radial * J.col(0);
  J.col(6) = -radial * J.col(1);
  J.col(7) = -radial * J.col(4);
  J(0, 8) = J(1, 10) = r2;
  J(0, 9) = J(1, 11) = r4;
  return J;
}

/// d(tilted point)/d(tau_x, tau_y) of a point `d` of the lens' image plane, term by term as in distort().
Matrix2d tilt_by_angles(double tau_x, double tau_y, const Vector2d& d) {
  const double cx = std::cos(tau_x), sx = std::sin(tau_x), cy = std::cos(tau_y), sy = std::sin(tau_y);
  const Vector2d v(cy * d.x() + sy * sx * d.y() - sy * cx, cx * d.y() + sx);
  const double vz = sy * d.x() - cy * sx * d.y() + cy * cx, r22 = cy * cx;
  const Vector2d v_x(sy * cx * d.y() + sy * sx, -sx * d.y() + cx);
  const Vector2d v_y(-sy * d.x() + cy * sx * d.y() - cy * cx, 0);
  const double vz_x = -cy * cx * d.y() - cy * sx, vz_y = cy * d.x() + sy * sx * d.y() - sy * cx;
  Matrix2d J;
  J.col(0) = -cy * sx * v / vz + r22 * (v_x - v * vz_x / vz) / vz - Vector2d(sy * sx, cx);
  J.col(1) = -sy * cx * v / vz + r22 * (v_y - v * vz_y / vz) / vz - Vector2d(-cy * cx, 0);
  return J;
}

Matrix2d distortion_jacobian(const Camera& camera, const Vector2d& at) {
  const Mapped distorted = lens(camera.distortion.data(), at);
  if (!camera.tilted()) return distorted.J;
  return tilt(tilt_homography(camera), distorted.value).J * distorted.J;
}

/// The pixel in the lens' own image plane: focal lengths and tilt taken off. Nothing behind the tilted
/// sensor.
std::optional<Vector2d> distorted_point(const Camera& camera, const Vector2d& pixel) {
  const Vector2d on_sensor{(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
  if (!camera.tilted()) return on_sensor;
  const Vector3d p = tilt_homography(camera).inverse() * on_sensor.homogeneous();
  if (!(p.z() > 0)) return std::nullopt;
  return Vector2d(p.hnormalized());
}

/// A strong distortion can fold back twice; an inverse found behind the folds is not where the light came
/// from. Looks at the radial terms alone, n/d: the derivative of r n/d has the sign of d n + 2 r^2 (n' d - n
/// d').
bool reached_without_fold(const std::array<double, kDistortionTerms>& k, const Vector2d& at) {
  for (double part : {0.25, 0.5, 0.75}) {
    const double r2 = part * part * at.squaredNorm();
    const double n = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4])), d = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
    const double dn = k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]), dd = k[5] + r2 * (2 * k[6] + r2 * 3 * k[7]);
    if (!(d > 0 && d * n + 2 * r2 * (dn * d - n * dd) > 0)) return false;
  }
  return true;
}

}  // namespace

std::optional<Vector2d> project(const Camera& camera, const Vector3d& p_cam) {
  if (!(p_cam.z() > 0)) return std::nullopt;
  const double k[4] = {camera.fx, camera.fy, camera.cx, camera.cy};
  return project<double>(k, camera.distortion.data(), p_cam);
}

std::optional<Vector3d> unproject(const Camera& camera, const Vector2d& pixel) {
  constexpr int kMaxIterations = 20, kMaxHalvings = 10;
  constexpr double kEnough = 1e-14, kAccepted = 1e-13;  // times a focal length of 5000 px: below 1e-9 px
  const auto target = distorted_point(camera, pixel);
  if (!target) return std::nullopt;
  Vector2d x = *target;
  Mapped image = lens(camera.distortion.data(), x);
  double residual = (image.value - *target).squaredNorm();
  for (int i = 0; i < kMaxIterations && !(residual < kEnough * kEnough); ++i) {
    if (!(image.J.determinant() > kFold)) return std::nullopt;
    Vector2d step = image.J.inverse() * (image.value - *target);
    const double before = residual;
    // Halve the step until the residual shrinks: strong distortion makes the full step overshoot.
    for (int half = 0; half < kMaxHalvings; ++half, step *= 0.5) {
      const Mapped next = lens(camera.distortion.data(), x - step);
      const double next_residual = (next.value - *target).squaredNorm();
      if (!(next_residual < before)) continue;
      x -= step, image = next, residual = next_residual;
      break;
    }
    if (!(residual < before)) break;  // at the floor of rounding, or stuck
  }
  if (!(residual < kAccepted * kAccepted) || !(image.J.determinant() > kFold)) return std::nullopt;
  if (!reached_without_fold(camera.distortion, x)) return std::nullopt;
  return Vector3d(x.x(), x.y(), 1.0);
}

Matrix2d projection_jacobian(const Camera& camera, const Vector2d& normalised) {
  return Vector2d(camera.fx, camera.fy).asDiagonal() * distortion_jacobian(camera, normalised);
}

DistortionDerivatives distortion_derivatives(const double* terms, const Vector2d& normalised) {
  const Mapped undisturbed = lens(terms, normalised);
  const Mapped tilted = tilt(tilt_homography(terms[12], terms[13]), undisturbed.value);
  DistortionDerivatives result{tilted.value, tilted.J * undisturbed.J,
                               tilted.J * lens_by_terms(terms, normalised)};
  result.by_terms.rightCols<2>() = tilt_by_angles(terms[12], terms[13], undisturbed.value);
  return result;
}

bool invertible_over_image(const Camera& camera) {
  constexpr int kSamples = 16;
  constexpr double kMargin = 0.02;  // wider than kFold: parameters of a calibration are only known so well
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      const Vector2d pixel{-0.5 + camera.width * double(i) / kSamples,
                           -0.5 + camera.height * double(j) / kSamples};
      const auto ray = unproject(camera, pixel);
      if (!ray) return false;
      for (double part : {0.25, 0.5, 0.75, 1.0})
        if (!(lens(camera.distortion.data(), part * ray->head<2>()).J.determinant() > kMargin)) return false;
    }
  }
  return true;
}

}  // namespace lightstripe
