// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/calibration_report.h"

#include <fmt/format.h>

#include <cmath>

#include "calib/assess/diagnosis.h"
#include "io/images.h"
#include "parallel/parallel.h"
#include "report/board_overlay.h"
#include "report/report_json.h"
#include "report/report_texts.h"

namespace lightstripe {
namespace {

std::string sensors_json(const CalibrationResult& result) {
  JsonList list;
  const auto& summary = result.summary;
  for (std::size_t i = 0; i < result.rig.quality.sensors.size(); ++i) {
    const auto& q = result.rig.quality.sensors[i];
    JsonList trials;
    std::string lens = "-";
    for (const auto& choice : summary.lenses) {
      if (choice.sensor != q.name) continue;
      lens = enum_name(choice.lens);
      for (const auto& trial : choice.trials)
        trials.add(fmt::format("{{\"lens\": {}, \"px\": {}}}", json(enum_name(trial.lens)),
                               json(trial.held_out_rms_px)));
    }
    const auto& coverage = result.diagnosis ? result.diagnosis->corner_coverage : std::vector<double>{};
    const bool known = i < result.rig.sensors.size();
    list.add(fmt::format(
        "{{\"name\": {}, \"lens\": {}, \"trials\": {}, \"board_rms_px\": {}, \"stripe_rms_px\": {}, "
        "\"board_views\": {}, \"stripe_views\": {}, \"coverage\": {}, \"size\": [{}, {}]}}",
        json(q.name), json(lens), trials.text(), json(q.board_rms_px), json(q.stripe_rms_px), q.board_views,
        q.stripe_views, i < coverage.size() ? json(coverage[i]) : "-1",
        known ? result.rig.sensors[i].camera.width : 1, known ? result.rig.sensors[i].camera.height : 1));
  }
  return list.text();
}

std::string stripes_json(const CalibrationSummary& summary) {
  JsonList list;
  for (const auto& s : summary.stripes)
    list.add(
        fmt::format("{{\"name\": {}, \"found\": {}, \"agreeing\": {}}}",
                    json(s.plane > 0 ? fmt::format("{}, laser plane {}", s.sensor, s.plane + 1) : s.sensor),
                    s.found, s.agreeing));
  return list.text();
}

std::string views_json(const CalibrationSummary& summary) {
  JsonList list;
  for (const auto& v : summary.views)
    list.add(fmt::format(
        "{{\"sensor\": {}, \"image\": {}, \"board_rms_px\": {}, \"stripe_rms_px\": {}, \"left_out\": {}}}",
        json(v.sensor), json(v.image), json(v.board_rms_px), json(v.stripe_rms_px), v.left_out));
  return list.text();
}

std::string residuals_json(const CalibrationDiagnosis& diagnosis) {
  JsonList list;
  for (const auto& r : diagnosis.residuals)
    list.add(fmt::format("[{},{},{},{:.1f},{:.1f},{:.4f},{:.4f}]", r.view, r.corner ? 1 : 0, r.used ? 1 : 0,
                         r.pixel.x(), r.pixel.y(), r.residual_px.x(), r.residual_px.y()));
  return list.text();
}

std::string map_json(const CalibrationDiagnosis& diagnosis) {
  JsonList list;
  for (const auto& c : diagnosis.map)
    list.add(fmt::format(
        "{{\"sensor\": {}, \"u\": {:.2f}, \"v\": {:.2f}, \"shape\": {:.5f}, \"absolute\": {:.5f}, "
        "\"extrapolated\": {}}}",
        c.sensor, c.section_mm.x(), c.section_mm.y(), c.shape_mm, c.absolute_mm, c.extrapolated));
  return list.text();
}

std::string point_json(const Eigen::Vector3d& p) {
  return fmt::format("[{:.2f},{:.2f},{:.2f}]", p.x(), p.y(), p.z());
}

std::string outline_json(const std::vector<Eigen::Vector3d>& points) {
  JsonList list;
  for (const auto& p : points) list.add(point_json(p));
  return list.text();
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
std::string sheets_json(const Rig& rig, const CalibrationDiagnosis& diagnosis) {
  JsonList list;
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
      if (corners.size() == 4)
        list.add(fmt::format("{{\"sensor\": {}, \"corners\": {}}}", s, outline_json(corners)));
    }
  }
  return list.text();
}

std::string rig_json(const SessionObservations& seen, const CalibrationResult& result) {
  JsonList cameras, boards;
  for (const auto& sensor : result.rig.sensors)
    cameras.add(fmt::format("{{\"name\": {}, \"centre\": {}, \"frustum\": {}}}", json(sensor.name),
                            point_json(sensor.rig_from_camera.translation),
                            outline_json(frustum(sensor, 120))));
  const Target& t = seen.observations.target;
  const double w = t.extent().x(), h = t.extent().y();
  if (result.diagnosis)
    for (const auto& pose : result.diagnosis->rig_from_board)
      boards.add(outline_json({pose * Eigen::Vector3d(0, 0, 0), pose * Eigen::Vector3d(w, 0, 0),
                               pose * Eigen::Vector3d(w, h, 0), pose * Eigen::Vector3d(0, h, 0)}));
  return fmt::format("{{\"cameras\": {}, \"boards\": {}, \"sheets\": {}}}", cameras.text(), boards.text(),
                     result.diagnosis ? sheets_json(result.rig, *result.diagnosis) : "[]");
}

/// The pictures with or without a complaint, with their overlays.
std::string pictures_json(const std::vector<SeenPicture>& pictures, bool rejected) {
  constexpr int kWidthPx = 420;
  std::vector<std::string> texts(pictures.size());
  const auto draw = [&](std::size_t i) {
    const auto& p = pictures[i];
    if (p.reason.empty() == rejected) return;
    const OverlayPicture overlay = draw_board(p, kWidthPx);
    texts[i] = fmt::format(
        "{{\"sensor\": {}, \"image\": {}, \"reason\": {}, \"picture\": \"data:image/jpeg;base64,{}\"}}",
        json(p.sensor), json(p.image), json(p.reason),
        base64(encode_jpeg(overlay.rgb, overlay.width, overlay.height)));
  };
  parallel_for(pictures.size(), draw);
  JsonList list;
  for (const auto& text : texts)
    if (!text.empty()) list.add(text);
  return list.text();
}

std::string report_data(const SessionObservations& seen, const CalibrationResult& result) {
  const auto& quality = result.rig.quality;
  const CalibrationDiagnosis none;
  const CalibrationDiagnosis& diagnosis = result.diagnosis ? *result.diagnosis : none;
  const auto& cross = diagnosis.cross_validation;
  JsonList warnings;
  for (const auto& warning : quality.warnings) warnings.add(json(warning));
  std::string sigma;
  for (const auto& [name, value] : quality.sigma)
    sigma += fmt::format("{}{}: {}", sigma.empty() ? "" : ", ", json(name), json(value));
  return fmt::format(
      "{{\"usable\": {}, \"message\": {}, \"warnings\": {}, \"shape_mm\": {}, \"absolute_mm\": {}, "
      "\"warp_mm\": [{}, {}],\n"
      "\"weakest\": {}, \"cross_validation\": {{\"done\": {}, \"why_not\": {}, \"difference_mm\": {}, "
      "\"predicted_mm\": {}}},\n"
      "\"stripes\": {},\n\"sensors\": {},\n\"views\": {},\n\"map\": {},\n\"rig3d\": {},\n\"sigma\": "
      "{{{}}},\n\"residuals\": "
      "{},\n"
      "\"rejected\": {},\n\"used\": {}}}",
      result.summary.usable, json(result.summary.message), warnings.text(),
      json(quality.section_shape_sigma_mm), json(quality.section_absolute_sigma_mm),
      json(result.summary.board_warp_mm.x()), json(result.summary.board_warp_mm.y()), json(diagnosis.weakest),
      cross.done, json(cross.why_not), json(cross.difference_mm), json(cross.predicted_mm),
      stripes_json(result.summary), sensors_json(result), views_json(result.summary), map_json(diagnosis),
      rig_json(seen, result), sigma, residuals_json(diagnosis), pictures_json(seen.pictures, true),
      pictures_json(seen.pictures, false));
}

void replace(std::string& text, std::string_view mark, std::string_view with) {
  const auto at = text.find(mark);
  if (at != std::string::npos) text.replace(at, mark.size(), with);
}

}  // namespace

std::string calibration_report(const SessionObservations& seen, const CalibrationResult& result) {
  std::string page(report_page()), libraries;
  for (const auto library : {chart_library(), three_library(), orbit_controls()})
    libraries += fmt::format("<script>{}</script>\n", library);
  replace(page, "/*PAGE*/", report_script());
  replace(page, "<!--DATA-->", report_data(seen, result));
  replace(page, "<!--LIBRARIES-->", libraries);
  return page;
}

}  // namespace lightstripe
