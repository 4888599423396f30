// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/calibration_report.h"

#include <fmt/format.h>

#include <cmath>

#include "calib/assess/diagnosis.h"
#include "io/images.h"
#include "parallel/parallel.h"
#include "report/board_overlay.h"
#include "report/page.h"

namespace lightstripe {
namespace {

using nlohmann::json;

json sensors_json(const CalibrationResult& result) {
  json list = json::array();
  const auto& summary = result.summary;
  for (std::size_t i = 0; i < result.rig.quality.sensors.size(); ++i) {
    const auto& q = result.rig.quality.sensors[i];
    json trials = json::array();
    std::string lens = "-";
    for (const auto& choice : summary.lenses) {
      if (choice.sensor != q.name) continue;
      lens = enum_name(choice.lens);
      for (const auto& trial : choice.trials)
        trials.push_back({{"lens", enum_name(trial.lens)}, {"px", trial.held_out_rms_px}});
    }
    const auto& coverage = result.diagnosis ? result.diagnosis->corner_coverage : std::vector<double>{};
    const bool known = i < result.rig.sensors.size();
    list.push_back({{"name", q.name},
                    {"lens", lens},
                    {"trials", trials},
                    {"board_rms_px", q.board_rms_px},
                    {"stripe_rms_px", q.stripe_rms_px},
                    {"board_views", q.board_views},
                    {"stripe_views", q.stripe_views},
                    {"coverage", i < coverage.size() ? coverage[i] : -1},
                    {"size",
                     {known ? result.rig.sensors[i].camera.width : 1,
                      known ? result.rig.sensors[i].camera.height : 1}}});
  }
  return list;
}

json stripes_json(const CalibrationSummary& summary) {
  json list = json::array();
  for (const auto& s : summary.stripes)
    list.push_back(
        {{"name", s.plane > 0 ? fmt::format("{}, laser plane {}", s.sensor, s.plane + 1) : s.sensor},
         {"found", s.found},
         {"agreeing", s.agreeing}});
  return list;
}

json views_json(const CalibrationSummary& summary) {
  json list = json::array();
  for (const auto& v : summary.views)
    list.push_back({{"sensor", v.sensor},
                    {"image", v.image},
                    {"board_rms_px", v.board_rms_px},
                    {"stripe_rms_px", v.stripe_rms_px},
                    {"left_out", v.left_out}});
  return list;
}

json residuals_json(const CalibrationDiagnosis& diagnosis) {
  json list = json::array();
  for (const auto& r : diagnosis.residuals)
    list.push_back({r.view, r.corner ? 1 : 0, r.used ? 1 : 0, rounded(r.pixel.x(), 1),
                    rounded(r.pixel.y(), 1), rounded(r.residual_px.x(), 4), rounded(r.residual_px.y(), 4)});
  return list;
}

json map_json(const CalibrationDiagnosis& diagnosis) {
  json list = json::array();
  for (const auto& c : diagnosis.map)
    list.push_back({{"sensor", c.sensor},
                    {"u", rounded(c.section_mm.x(), 2)},
                    {"v", rounded(c.section_mm.y(), 2)},
                    {"shape", rounded(c.shape_mm, 5)},
                    {"absolute", rounded(c.absolute_mm, 5)},
                    {"extrapolated", c.extrapolated}});
  return list;
}

json point_json(const Eigen::Vector3d& p) {
  return {rounded(p.x(), 2), rounded(p.y(), 2), rounded(p.z(), 2)};
}

json outline_json(const std::vector<Eigen::Vector3d>& points) {
  json list = json::array();
  for (const auto& p : points) list.push_back(point_json(p));
  return list;
}

/// The corners of the image, at a depth, in the rig frame.
std::vector<Eigen::Vector3d> frustum(const Sensor& sensor, double depth_mm) {
  std::vector<Eigen::Vector3d> corners;
  const double w = sensor.camera.width, h = sensor.camera.height;
  for (const auto& pixel : {Eigen::Vector2d(0, 0), {w - 1, 0}, {w - 1, h - 1}, {0, h - 1}})
    if (const auto ray = unproject(sensor.camera, pixel))
      corners.push_back(sensor.rig_from_camera * (depth_mm * *ray));
  return corners;
}

/// Where the image's border columns and rows of the map's cells meet each laser plane.
json sheets_json(const Rig& rig, const CalibrationDiagnosis& diagnosis) {
  json list = json::array();
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    for (std::size_t p = 0; p < rig.sensors[s].laser_planes.size(); ++p) {
      Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
      for (const auto& cell : diagnosis.map) {
        if (cell.sensor != static_cast<int>(s) || cell.plane != static_cast<int>(p) || cell.extrapolated)
          continue;
        low = low.cwiseMin(cell.pixel);
        high = high.cwiseMax(cell.pixel);
      }
      std::vector<Eigen::Vector3d> corners;
      for (const auto& pixel :
           {low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())}) {
        const auto ray = unproject(rig.sensors[s].camera, pixel);
        const auto x =
            ray ? intersect(rig.sensors[s].laser_planes[p], Eigen::Vector3d::Zero(), *ray) : std::nullopt;
        if (x) corners.push_back(rig.sensors[s].rig_from_camera * *x);
      }
      if (corners.size() == 4) list.push_back({{"sensor", s}, {"corners", outline_json(corners)}});
    }
  }
  return list;
}

json rig_json(const SessionObservations& seen, const CalibrationResult& result) {
  json cameras = json::array(), boards = json::array();
  for (const auto& sensor : result.rig.sensors)
    cameras.push_back({{"name", sensor.name},
                       {"centre", point_json(sensor.rig_from_camera.translation)},
                       {"frustum", outline_json(frustum(sensor, 120))}});
  const Target& t = seen.observations.target;
  const double w = t.extent().x(), h = t.extent().y();
  if (result.diagnosis)
    for (const auto& pose : result.diagnosis->rig_from_board)
      boards.push_back(outline_json({pose * Eigen::Vector3d(0, 0, 0), pose * Eigen::Vector3d(w, 0, 0),
                                     pose * Eigen::Vector3d(w, h, 0), pose * Eigen::Vector3d(0, h, 0)}));
  return {{"cameras", cameras},
          {"boards", boards},
          {"sheets", result.diagnosis ? sheets_json(result.rig, *result.diagnosis) : json::array()}};
}

/// The pictures with or without a complaint, with their overlays.
json pictures_json(const std::vector<SeenPicture>& pictures, bool rejected) {
  constexpr int kWidthPx = 420;
  std::vector<json> drawn(pictures.size());
  const auto draw = [&](std::size_t i) {
    const auto& p = pictures[i];
    if (p.reason.empty() == rejected) return;
    const OverlayPicture overlay = draw_board(p, kWidthPx);
    drawn[i] = {{"sensor", p.sensor},
                {"image", p.image},
                {"reason", p.reason},
                {"picture", "data:image/jpeg;base64," +
                                base64(encode_jpeg(overlay.rgb, overlay.width, overlay.height))}};
  };
  parallel_for(pictures.size(), draw);
  json list = json::array();
  for (auto& one : drawn)
    if (!one.is_null()) list.push_back(std::move(one));
  return list;
}

json report_data(const SessionObservations& seen, const CalibrationResult& result) {
  const auto& quality = result.rig.quality;
  const CalibrationDiagnosis none;
  const CalibrationDiagnosis& diagnosis = result.diagnosis ? *result.diagnosis : none;
  const auto& cross = diagnosis.cross_validation;
  return {{"usable", result.summary.usable},
          {"message", result.summary.message},
          {"warnings", quality.warnings},
          {"shape_mm", quality.section_shape_sigma_mm},
          {"absolute_mm", quality.section_absolute_sigma_mm},
          {"warp_mm", {result.summary.board_warp_mm.x(), result.summary.board_warp_mm.y()}},
          {"weakest", diagnosis.weakest},
          {"cross_validation",
           {{"done", cross.done},
            {"why_not", cross.why_not},
            {"difference_mm", cross.difference_mm},
            {"predicted_mm", cross.predicted_mm}}},
          {"stripes", stripes_json(result.summary)},
          {"sensors", sensors_json(result)},
          {"views", views_json(result.summary)},
          {"map", map_json(diagnosis)},
          {"rig3d", rig_json(seen, result)},
          {"sigma", quality.sigma},
          {"residuals", residuals_json(diagnosis)},
          {"rejected", pictures_json(seen.pictures, true)},
          {"used", pictures_json(seen.pictures, false)}};
}

}  // namespace

std::string calibration_report(const SessionObservations& seen, const CalibrationResult& result) {
  return assemble_page({.title = "lightstripe calibration",
                        .name = "calibration",
                        .libraries = {"chart.js", "three.js", "OrbitControls.js"},
                        .data = report_data(seen, result)});
}

}  // namespace lightstripe
