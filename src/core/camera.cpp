// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/camera.h"

#include <Eigen/LU>

namespace lightstripe {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kStep = 1e-6;  // for central differences in normalised coordinates: error about 1e-11

Vector2d distort(const Camera& camera, const Vector2d& normalised) {
  return lightstripe::distort<double>(camera.distortion.data(), normalised);
}

Matrix2d distortion_jacobian(const Camera& camera, const Vector2d& at) {
  Matrix2d J;
  for (int i = 0; i < 2; ++i) {
    const Vector2d step = kStep * Vector2d::Unit(i);
    J.col(i) = (distort(camera, at + step) - distort(camera, at - step)) / (2 * kStep);
  }
  return J;
}

}  // namespace

std::optional<Vector2d> project(const Camera& camera, const Eigen::Vector3d& p_cam) {
  if (!(p_cam.z() > 0)) return std::nullopt;
  const double k[4] = {camera.fx, camera.fy, camera.cx, camera.cy};
  return project<double>(k, camera.distortion.data(), p_cam);
}

std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Vector2d& pixel) {
  constexpr int kMaxIterations = 20;
  constexpr double kTolerance = 1e-12;
  const Vector2d target{(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
  Vector2d x = target;
  Vector2d residual = distort(camera, x) - target;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (residual.norm() < kTolerance) break;
    const Matrix2d J = distortion_jacobian(camera, x);
    if (!(J.determinant() > 1e-3)) return std::nullopt;  // at or beyond the fold
    Vector2d step = J.inverse() * residual;
    // Halve the step until the residual shrinks: strong distortion makes the full step overshoot.
    for (int half = 0; half < 10; ++half, step *= 0.5) {
      const Vector2d next = distort(camera, x - step) - target;
      if (next.norm() < residual.norm() || half == 9) {
        x -= step;
        residual = next;
        break;
      }
    }
  }
  if (!(residual.norm() < 1e-9) || !(distortion_jacobian(camera, x).determinant() > 1e-3)) return std::nullopt;
  return Eigen::Vector3d(x.x(), x.y(), 1.0);
}

Matrix2d projection_jacobian(const Camera& camera, const Vector2d& normalised) {
  return Vector2d(camera.fx, camera.fy).asDiagonal() * distortion_jacobian(camera, normalised);
}

bool invertible_over_image(const Camera& camera) {
  constexpr int kSamples = 16;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      const Vector2d pixel{-0.5 + camera.width * double(i) / kSamples, -0.5 + camera.height * double(j) / kSamples};
      const auto ray = unproject(camera, pixel);
      if (!ray) return false;
      for (double part : {0.25, 0.5, 0.75, 1.0})
        if (!(distortion_jacobian(camera, part * ray->head<2>()).determinant() > 0.02)) return false;
    }
  }
  return true;
}

}  // namespace lightstripe
