// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/assess/board_spread.h"
#include "calib/assess/diagnosis.h"
#include "calib/assess/uncertainty.h"
#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;

constexpr int kColumns = 24, kRows = 18;
constexpr double kNear = 0.06;  // of the image's diagonal: a cell this near to a stripe is not extrapolated

/// Pixels of used stripe points of one laser plane.
std::vector<Vector2d> stripe_pixels(const std::vector<SectionSample>& samples, int sensor, int plane) {
  std::vector<Vector2d> pixels;
  for (const auto& sample : samples)
    if (sample.sensor == sensor && sample.plane == plane) pixels.push_back(sample.pixel);
  return pixels;
}

double distance_to_nearest(const std::vector<Vector2d>& pixels, const Vector2d& pixel) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& q : pixels) nearest = std::min(nearest, (q - pixel).norm());
  return nearest;
}

/// The image's grid cells whose points of the laser plane lie in the range.
void add_cells(const SessionViews& session, const RigState& state, int sensor, int plane,
               const DepthRange& range, const std::vector<Vector2d>& stripe,
               std::vector<UncertaintyCell>& cells) {
  const auto& of = state.sensors[static_cast<std::size_t>(sensor)];
  const auto& size = session.image_sizes[static_cast<std::size_t>(sensor)];
  const double diagonal = std::hypot(size[0], size[1]);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Vector2d pixel((column + 0.5) * size[0] / kColumns - 0.5, (row + 0.5) * size[1] / kRows - 0.5);
      const auto ray = unproject(of.camera, pixel);
      const auto p =
          ray ? intersect(of.laser_planes[static_cast<std::size_t>(plane)], Eigen::Vector3d::Zero(), *ray)
              : std::nullopt;
      if (!p || p->z() < range.near_mm || p->z() > range.far_mm) continue;
      UncertaintyCell cell;
      cell.sensor = sensor;
      cell.plane = plane;
      cell.pixel = pixel;
      cell.extrapolated = distance_to_nearest(stripe, pixel) > kNear * diagonal;
      cells.push_back(cell);
    }
  }
}

DepthRange range_of(const BoardSpread& spread, double near_mm, double far_mm) {
  constexpr double kBeyond = 0.1;  // of the depths seen
  if (far_mm > near_mm) return {near_mm, far_mm};
  const DepthRange& seen = spread.stripe_depths;
  const double margin = kBeyond * (seen.far_mm - seen.near_mm);
  return {seen.near_mm - margin, seen.far_mm + margin};
}

/// Displacements of all cells less the rigid move that fits the cells which are not extrapolated.
MatrixXd after_rigid_move(const std::vector<UncertaintyCell>& cells, const MatrixXd& J) {
  const Eigen::Index n = static_cast<Eigen::Index>(cells.size());
  MatrixXd rigid(2 * n, 3), fitted = MatrixXd::Zero(2 * n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& cell = cells[static_cast<std::size_t>(i)];
    rigid.middleRows<2>(2 * i) << 1, 0, -cell.section_mm.y(), 0, 1, cell.section_mm.x();
    if (!cell.extrapolated) fitted.middleRows<2>(2 * i) = rigid.middleRows<2>(2 * i);
  }
  return J - rigid * solve_least_squares(fitted, J);
}

}  // namespace

std::vector<UncertaintyCell> uncertainty_map(const SessionViews& session, const JointAdjustment& adjustment,
                                             const std::vector<BoardSpread>& spreads,
                                             const Eigen::Vector3d& up, double near_mm, double far_mm) {
  const auto stripes = section_samples(session, adjustment.residuals);
  std::vector<UncertaintyCell> cells;
  for (std::size_t s = 0; s < adjustment.state.sensors.size(); ++s) {
    const int sensor = static_cast<int>(s);
    const DepthRange range = range_of(spreads[s], near_mm, far_mm);
    for (std::size_t p = 0; p < adjustment.state.sensors[s].laser_planes.size(); ++p) {
      const int plane = static_cast<int>(p);
      add_cells(session, adjustment.state, sensor, plane, range, stripe_pixels(stripes, sensor, plane),
                cells);
    }
  }
  std::vector<SectionSample> samples;
  for (const auto& cell : cells) samples.push_back({cell.sensor, cell.plane, cell.pixel});
  if (samples.empty()) return cells;
  const Eigen::VectorXd section = section_of(adjustment.state, session.motion, up, samples);
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i].section_mm = section.segment<2>(2 * static_cast<Eigen::Index>(i));
  const MatrixXd J = section_jacobian(session, adjustment, up, samples);
  const MatrixXd shape = after_rigid_move(cells, J);
  const auto sigma = [&](const MatrixXd& of, std::size_t i) {
    const MatrixXd rows = of.middleRows<2>(2 * static_cast<Eigen::Index>(i));
    return std::sqrt((rows * adjustment.covariance * rows.transpose()).trace());
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].absolute_mm = sigma(J, i);
    cells[i].shape_mm = sigma(shape, i);
  }
  return cells;
}

}  // namespace lightstripe
