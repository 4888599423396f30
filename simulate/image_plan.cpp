// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/image_plan.h"

#include <fmt/format.h>

#include "simulate/board_poses.h"

namespace lightstripe {
namespace {

void add_image(ImagePlan& plan, std::string file, std::size_t sensor, const View& view, int frame) {
  PlannedImage image{std::move(file), sensor, plan.worlds.size() - 1, view, frame};
  image.view.sensor = &plan.sensors[sensor];
  plan.images.push_back(image);
}

World with_board(const BoardPlan& boards, const Rigid3& pose) {
  World world;
  world.boards.push_back(make_board(boards, pose));
  return world;
}

void plan_boards(const Scene& scene, ImagePlan& plan) {
  plan.board_poses = draw_board_poses(scene, plan.sensors);
  const bool pair = scene.boards.images == BoardImages::kPair;
  const Imaging& light = scene.imaging;
  const View unlit{nullptr, {}, light.board_ambient, 0}, lit{nullptr, {}, light.laser_ambient, 1};
  const View both{nullptr, {}, light.single_ambient, light.single_laser};
  for (int i = 0; i < scene.boards.count; ++i) {
    plan.worlds.push_back(with_board(scene.boards, plan.board_poses[static_cast<std::size_t>(i)]));
    for (std::size_t s = 0; s < plan.sensors.size(); ++s) {
      const std::string folder = "calib/" + plan.sensors[s].name;
      add_image(plan, folder + "/board/" + board_file(i), s, pair ? unlit : both, -1);
      if (pair) add_image(plan, folder + "/laser/" + board_file(i), s, lit, -1);
    }
  }
}

void plan_motion(const Scene& scene, ImagePlan& plan) {
  if (scene.motion.positions == 0) return;
  plan.motion_board.push_back(draw_motion_board(scene, plan.sensors));
  plan.worlds.push_back(with_board(scene.boards, plan.motion_board.front()));
  const std::size_t sensor = motion_sensor(scene);
  for (int i = 0; i < scene.motion.positions; ++i) {
    const View view{nullptr, moved_in_motion(scene, i), scene.imaging.board_ambient, 0};
    add_image(plan, "calib/" + plan.sensors[sensor].name + "/travel/" + board_file(i), sensor, view, -1);
  }
}

void plan_scan(const Scene& scene, ImagePlan& plan) {
  plan.still_scan = same_in_all_frames(scene);
  for (int i = 0; i < scene.scan.frames; ++i) {
    if (i == 0 || !plan.still_scan) plan.worlds.push_back(scan_world(scene, plan.nominal, i));
    const View view{nullptr, moved_in_scan(scene, i), scene.imaging.scan_ambient, 1};
    for (std::size_t s = 0; s < plan.sensors.size(); ++s)
      add_image(plan, "scan/" + plan.sensors[s].name + "/" + frame_file(i), s, view, i);
  }
}

}  // namespace

std::string board_file(int number) { return fmt::format("{:03}.png", number); }
std::string frame_file(int number) { return fmt::format("{:04}.png", number); }

ImagePlan plan_images(const Scene& scene) {
  ImagePlan plan;
  plan.sensors = make_sensors(scene);
  plan.nominal = nominal_outlines(scene);
  plan_boards(scene, plan);
  plan_motion(scene, plan);
  plan_scan(scene, plan);
  return plan;
}

}  // namespace lightstripe
