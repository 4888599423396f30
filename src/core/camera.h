// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The camera: pinhole with OpenCV's distortion up to the rational, thin-prism and tilt terms.
// Camera frame: x right, y down, z forward. Pixel (0, 0) = centre of the top-left pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>

namespace lightstripe {

/// Distortion in OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y (radians).
inline constexpr int kDistortionTerms = 14;

struct Camera {
  int width = 0;                          ///< px
  int height = 0;                         ///< px
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< px
  std::array<double, kDistortionTerms> distortion{};

  bool tilted() const { return distortion[12] != 0 || distortion[13] != 0; }
};

/// Normalised image coordinates (x/z, y/z) to distorted ones; templated so that Ceres can differentiate it.
/// OpenCV's model, see its calib3d documentation, section "Detailed description".
template <class T>
Eigen::Matrix<T, 2, 1> distort(const T* k, const Eigen::Matrix<T, 2, 1>& normalised) {
  using std::cos;
  using std::sin;
  const T x = normalised.x(), y = normalised.y();
  const T r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const T radial = (T(1) + k[0] * r2 + k[1] * r4 + k[4] * r6) / (T(1) + k[5] * r2 + k[6] * r4 + k[7] * r6);
  const T xd = x * radial + T(2) * k[2] * x * y + k[3] * (r2 + T(2) * x * x) + k[8] * r2 + k[9] * r4;
  const T yd = y * radial + k[2] * (r2 + T(2) * y * y) + T(2) * k[3] * x * y + k[10] * r2 + k[11] * r4;
  if (k[12] == T(0) && k[13] == T(0)) return {xd, yd};
  // Sensor tilted by tau_x, then tau_y: R = R_y R_x, p ~ [R22 0 -R02; 0 R22 -R12; 0 0 1] R (xd, yd, 1).
  const T cx = cos(k[12]), sx = sin(k[12]), cy = cos(k[13]), sy = sin(k[13]);
  const T vx = cy * xd + sy * sx * yd - sy * cx;
  const T vy = cx * yd + sx;
  const T vz = sy * xd - cy * sx * yd + cy * cx;
  const T r22 = cy * cx, r02 = -sy * cx, r12 = sx;
  return {(r22 * vx - r02 * vz) / vz, (r22 * vy - r12 * vz) / vz};
}

/// A point of the camera frame (mm, z > 0) to its pixel.
template <class T>
Eigen::Matrix<T, 2, 1> project(const T* fx_fy_cx_cy, const T* distortion,
                               const Eigen::Matrix<T, 3, 1>& p_cam) {
  const Eigen::Matrix<T, 2, 1> d = distort<T>(distortion, {p_cam.x() / p_cam.z(), p_cam.y() / p_cam.z()});
  return {fx_fy_cx_cy[0] * d.x() + fx_fy_cx_cy[2], fx_fy_cx_cy[1] * d.y() + fx_fy_cx_cy[3]};
}

/// A point of the camera frame (mm) to its pixel; nothing for a point that is not in front of the camera.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& p_cam);

/// The ray (x, y, 1) that a pixel sees: Newton's inverse of the whole model, tilt included, to 1e-12.
/// Nothing where the model cannot be inverted (beyond the fold of a non-monotonic distortion).
/// (OpenCV's undistortPoints is not used: it is wrong for the tilt terms, opencv#27916.)
std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Eigen::Vector2d& pixel);

/// d(pixel)/d(x/z, y/z) at a normalised point; used for error propagation.
Eigen::Matrix2d projection_jacobian(const Camera& camera, const Eigen::Vector2d& normalised);

/// distort() of doubles with its derivatives.
struct DistortionDerivatives {
  Eigen::Vector2d value;
  Eigen::Matrix2d by_point;                             ///< by the normalised point
  Eigen::Matrix<double, 2, kDistortionTerms> by_terms;  ///< by the coefficients, in OpenCV's order
};
DistortionDerivatives distortion_derivatives(const double* terms, const Eigen::Vector2d& normalised);

/// Whether the distortion can be inverted everywhere in the image: its Jacobian keeps its sign
/// on the way from the centre to each point of the border.
bool invertible_over_image(const Camera& camera);

}  // namespace lightstripe
