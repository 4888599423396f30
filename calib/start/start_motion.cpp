// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/adjust/session_views.h"
#include "calib/start/initial_values.h"
#include "core/counted.h"
#include "core/linear_algebra.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr double kMaxScaleError = 0.02;  // of travel against what the camera sees, before a warning
constexpr double kWrongScale = 0.05;     // no scale or encoder is as bad: squares or travel are wrong

/// The fixed board as the motion views see it, first frame, with the signed travel of each.
struct Track {
  std::vector<Rigid3> first_from_board;
  std::vector<double> travel;  ///< times SessionViews::motion_sign()
  double extent() const {
    const auto [low, high] = std::minmax_element(travel.begin(), travel.end());
    return *high - *low;
  }
};

/// Boards that look the same from several sides are listed so that neighbours in travel differ by the
/// smallest rotation.
Track follow_board(InitialValues& values) {
  auto& m = values.session;
  const auto orders = corner_orders(m.target);
  const Rigid3 first_from_cam =
      values.state.sensors[static_cast<std::size_t>(m.motion_sensor)].cam_from_first.inverse();
  Track track;
  for (std::size_t i = 0; i < m.views.size(); ++i) {
    auto& view = m.views[i];
    if (view.pose >= 0) continue;
    std::size_t best = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < orders.size() && !track.travel.empty(); ++k) {
      const Rigid3 turned = first_from_cam * values.cam_from_board[i] * board_turn(m.target, k);
      const double angle =
          rotation_angle(track.first_from_board.back().rotation.conjugate() * turned.rotation);
      if (angle >= smallest) continue;
      smallest = angle;
      best = k;
    }
    view.corners = relisted(view.corners, orders[best]);
    values.cam_from_board[i] = values.cam_from_board[i] * board_turn(m.target, best);
    track.first_from_board.push_back(first_from_cam * values.cam_from_board[i]);
    track.travel.push_back(m.motion_sign() * view.travel);
  }
  return track;
}

/// Least squares of the board's middle against travel.
MotionState fit_direction(const Track& track, const Target& target, std::vector<std::string>& warnings) {
  const Vector3d middle(target.middle().x(), target.middle().y(), 0);
  const double n = static_cast<double>(track.travel.size());
  double mean_s = 0;
  Vector3d mean_p = Vector3d::Zero();
  for (std::size_t i = 0; i < track.travel.size(); ++i) {
    mean_s += track.travel[i] / n;
    mean_p += track.first_from_board[i] * middle / n;
  }
  double ss = 0;
  Vector3d sp = Vector3d::Zero();
  for (std::size_t i = 0; i < track.travel.size(); ++i) {
    ss += (track.travel[i] - mean_s) * (track.travel[i] - mean_s);
    sp += (track.travel[i] - mean_s) * (track.first_from_board[i] * middle - mean_p);
  }
  const double scale = sp.norm() / ss;
  if (!(std::abs(scale - 1) < kWrongScale))
    throw NotUsable(
        fmt::format("motion: the board moved {} mm in the camera for each mm of travel; check that "
                    "travel and squares are given in mm, and the order of the positions",
                    scale < 0.01 ? fmt::format("{:.2g}", scale) : fmt::format("{:.2f}", scale)));
  if (std::abs(scale - 1) > kMaxScaleError)
    warnings.push_back(
        fmt::format("motion: the board moved {:.3f} mm in the camera for each mm of travel", scale));
  MotionState motion;
  motion.direction = sp.normalized();
  const Eigen::Quaterniond rotation = track.first_from_board.front().rotation;
  motion.first_from_board = {rotation, mean_p - mean_s * motion.direction - rotation * middle};
  return motion;
}

/// The axis as the mean of the relative rotations' axes; a point on it from (I - R) c = p - R p0, next to the
/// board.
MotionState fit_axis(const Track& track) {
  const Rigid3& first = track.first_from_board.front();
  Vector3d axis = Vector3d::Zero();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * track.travel.size() + 1), 3);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  for (std::size_t i = 1; i < track.travel.size(); ++i) {
    const Eigen::Quaterniond turn = track.first_from_board[i].rotation * first.rotation.conjugate();
    const Eigen::Index row = static_cast<Eigen::Index>(3 * i);
    A.middleRows<3>(row) = Eigen::Matrix3d::Identity() - turn.toRotationMatrix();
    b.segment<3>(row) = track.first_from_board[i].translation - turn * first.translation;
    const double angle = track.travel[i] - track.travel.front();
    const double half = std::sin(0.5 * angle);  // full turns do not show
    const Vector3d sine_axis = turn.w() < 0 ? Vector3d(-turn.vec()) : Vector3d(turn.vec());
    const double wrapped = std::cos(0.5 * angle) < 0 ? -half : half;
    axis += wrapped * sine_axis;
  }
  if (!(axis.norm() > 1e-6))
    throw NotUsable("motion: the board does not turn in the images; check the angles and their order");
  axis.normalize();
  A.row(A.rows() - 1) = axis.transpose();
  b(A.rows() - 1) = axis.dot(first.translation);
  MotionState motion;
  motion.direction = axis;
  motion.axis_point = solve_least_squares(A, b);
  const Eigen::Quaterniond back(Eigen::AngleAxisd(-track.travel.front(), axis));
  motion.first_from_board = {(back * first.rotation).normalized(),
                             motion.axis_point + back * (first.translation - motion.axis_point)};
  return motion;
}

}  // namespace

void start_motion(InitialValues& values) {
  constexpr double kMinTravelMm = 1, kMinTurn = 5 * kDegree;
  const bool rotary = values.session.motion == MotionType::kRotary;
  const Track track = follow_board(values);
  if (track.travel.size() < 2)
    throw NotUsable(
        fmt::format("motion: the fixed board was found in {}; at least 2 positions of travel are needed, "
                    "better 5",
                    counted(track.travel.size(), "image")));
  if (track.extent() < (rotary ? kMinTurn : kMinTravelMm))
    throw NotUsable(
        fmt::format("motion: all images of the fixed board have the same travel within {:.3g} {}; move the "
                    "rig between them, and "
                    "give the travel in {}",
                    rotary ? track.extent() / kDegree : track.extent(), rotary ? "degrees" : "mm",
                    rotary ? "degrees" : "mm"));
  values.state.motion =
      rotary ? fit_axis(track) : fit_direction(track, values.session.target, values.warnings);
}

}  // namespace lightstripe
