// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The scan half of session_file.h.
#include <fmt/format.h>

#include "core/error.h"
#include "io/backgrounds_field.h"
#include "io/session_file.h"

namespace lightstripe {
namespace {

constexpr const char* kTravelForms =
    "give one of {file: travel.csv}, {step: 2.0}, {poses: poses.csv, of: sensor}";

/// The file as it is written.
struct TravelFields {
  std::optional<std::string> file, poses, of;
  std::optional<double> step;
};
template <class V>
void visit_fields(V&& v, TravelFields& o) {
  v("file", o.file);
  v("step", o.step);
  v("poses", o.poses);
  v("of", o.of);
}

struct ScanFields {
  std::string rig;
  std::vector<std::pair<std::string, std::string>> frames;
  std::optional<TravelFields> travel;
  std::optional<Channel> channel;
  std::optional<Backgrounds> background;
  std::optional<std::string> polarity;  ///< as extraction: {polarity: ...}
  YamlSubtree extraction;
};
template <class V>
void visit_fields(V&& v, ScanFields& o) {
  v("rig", o.rig);
  v("frames", o.frames);
  v("travel", o.travel);
  v("channel", o.channel);
  v("background", o.background);
  v("polarity", o.polarity);
  v("extraction", o.extraction);
}

void check_travel(const TravelFields& travel, const std::string& subject) {
  const int forms =
      int(travel.file.has_value()) + int(travel.step.has_value()) + int(travel.poses.has_value());
  if (forms != 1)
    throw Error(subject, forms == 0 ? "says nothing" : "says more than one thing", kTravelForms);
  if (travel.poses.has_value() != travel.of.has_value())
    throw Error(subject, travel.of ? "'of' goes with poses only" : "poses need to know whose they are",
                "write {poses: poses.csv, of: <sensor's name, or rig>}");
  for (const auto& text : {travel.file, travel.poses, travel.of})
    if (text && text->empty()) throw Error(subject, "has an empty text", kTravelForms);
  if (travel.step && *travel.step == 0)
    throw Error(subject + ".step", "is 0", "give the travel between two frames, or leave `travel` out");
}

void set_travel(Scan& scan, const TravelFields& travel) {
  scan.travel = travel.file ? TravelSource::kFile : travel.step ? TravelSource::kStep : TravelSource::kPoses;
  scan.travel_file = travel.file.value_or("");
  scan.travel_step = travel.step.value_or(0);
  scan.poses_file = travel.poses.value_or("");
  scan.poses_of = travel.of.value_or("");
}

constexpr SensorWords kWords{"frames", "frames",
                             "e.g. background: {gauge: off/gauge/*.png, field: off/field/*.png}"};

std::vector<std::string> sensor_names(const Scan& scan) {
  std::vector<std::string> names;
  for (const auto& [sensor, pattern] : scan.frames) names.push_back(sensor);
  return names;
}

}  // namespace

Scan read_scan(const std::filesystem::path& path) {
  ScanFields fields;
  read_yaml(path, fields);
  const std::string file = path.string();
  if (fields.rig.empty()) throw Error(file + ": rig", "is missing", "name the rig file, e.g. rig: rig.yaml");
  if (fields.frames.empty())
    throw Error(file + ": frames", "is missing or empty",
                "give each sensor its images, e.g. frames: {gauge: scan/*.png}");
  for (const auto& [sensor, pattern] : fields.frames)
    if (pattern.empty())
      throw Error(fmt::format("{}: frames.{}", file, sensor), "is empty",
                  "give a file pattern or a video file");
  Scan scan;
  scan.folder = path.parent_path();
  scan.rig = fields.rig;
  scan.frames = fields.frames;
  if (fields.travel) {
    check_travel(*fields.travel, file + ": travel");
    set_travel(scan, *fields.travel);
  }
  if (fields.channel) scan.channel = *fields.channel;
  scan.background = fields.background.value_or(Backgrounds{});
  check_backgrounds(scan.background, sensor_names(scan), file, kWords);
  scan.extraction = extraction_part(fields.extraction, fields.polarity, path);
  return scan;
}

std::string scan_to_yaml(const Scan& scan) {
  ScanFields fields;
  fields.rig = scan.rig;
  fields.frames = scan.frames;
  if (scan.travel != TravelSource::kNone) fields.travel.emplace();
  if (scan.travel == TravelSource::kFile) fields.travel->file = scan.travel_file;
  if (scan.travel == TravelSource::kStep) fields.travel->step = scan.travel_step;
  if (scan.travel == TravelSource::kPoses) {
    fields.travel->poses = scan.poses_file;
    fields.travel->of = scan.poses_of;
  }
  if (scan.channel != Channel::kAuto) fields.channel = scan.channel;
  if (!scan.background.empty()) fields.background = scan.background;
  fields.extraction = scan.extraction;
  return dump_yaml(fields);
}

}  // namespace lightstripe
