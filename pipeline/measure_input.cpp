// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/robust.h"
#include "io/atomic_file.h"
#include "io/nominal_outlines.h"
#include "io/tables.h"
#include "measure/profile_formats.h"
#include "measure/robust_line.h"
#include "pipeline/recorded_profile.h"

namespace lightstripe {
namespace {

/// The radius where the file's v is 0: its figure is that of the tread at WheelDiameterTaperline, which need
/// not lie at v = 0.
std::optional<double> radius_where_v_is_0(const RecordedProfile& recorded) {
  constexpr double kHalfWidthMm = 4, kDeepMm = 20;
  const auto diameter = recorded.number("DiameterTaperline");
  if (!diameter || !(*diameter > 0)) return std::nullopt;
  const double u = recorded.number("WheelDiameterTaperline").value_or(kTreadDatumMm) - kTreadDatumMm;
  std::vector<Sample1> tread;
  for (const Eigen::Vector2d& p : recorded.points)
    if (std::abs(p.x() - u) < kHalfWidthMm && std::abs(p.y()) < kDeepMm)
      tread.push_back({p.x() - u, p.y(), 1});
  const auto fit = fit_polynomial(tread, 2, kMinScaleMm);
  if (!fit) return std::nullopt;
  return *diameter / 2 - fit->value;
}

MeasureInput input_of(const RecordedProfile& recorded, const std::string& path) {
  MeasureInput input;
  input.file = path;
  input.kind = recorded.kind;
  Profile profile;
  for (const Eigen::Vector2d& p : recorded.points) {
    ProfilePoint point;
    point.position = {0, p.x(), p.y()};
    point.u = p.x(), point.v = p.y();
    profile.points.push_back(point);
  }
  input.profiles.push_back(std::move(profile));
  input.further_profiles = recorded.further_profiles;
  if (recorded.kind == ObjectKind::kRail) return input;
  input.prior.pose = SectionPose{};
  input.wheel.back_is_given = true;
  input.wheel.radius_offset_mm = radius_where_v_is_0(recorded);
  return input;
}

/// Whether most of some sections show a rail's head without web and foot.
bool shows_head_alone(const std::vector<Profile>& profiles, const RegistrationOptions& options) {
  constexpr std::size_t kSections = 7;
  const ReferenceShape reference = read_reference("", ObjectKind::kRail);
  const std::size_t count = std::min(kSections, profiles.size());
  std::size_t alone = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (register_section(section_of(profiles[i * profiles.size() / count]), reference, {}, options).view ==
        RegistrationView::kHeadOnly)
      ++alone;
  return 2 * alone > count;
}

/// Median rms of some sections that can be registered to this rail; nothing if fewer than half can.
std::optional<double> median_rms(const std::vector<Profile>& profiles, const std::string& name,
                                 const RegistrationOptions& options) {
  constexpr std::size_t kSections = 7;
  const ReferenceShape reference = read_reference(name, ObjectKind::kRail);
  std::vector<double> rms;
  const std::size_t count = std::min(kSections, profiles.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Section section = section_of(profiles[i * profiles.size() / count]);
    const Registration registration = register_section(section, reference, {}, options);
    if (registration.usable()) rms.push_back(registration.rms_mm);
  }
  if (2 * rms.size() < count || rms.empty()) return std::nullopt;
  return median(std::move(rms));
}

}  // namespace

std::string kind_name(ObjectKind kind) { return kind == ObjectKind::kRail ? "rail" : "wheel"; }

MeasureInput read_measure_input(const std::string& path, ObjectKind kind) {
  if (const auto format = profile_format(path)) return input_of(read_recorded(path, *format, kind), path);
  MeasureInput input;
  input.file = path;
  input.kind = kind;
  input.profiles = read_profiles(path);
  if (input.profiles.empty()) throw Error(path, "has no rows", "give the sections of a scan");
  if (kind == ObjectKind::kRail) return input;
  input.wheel.radial = sections_are_radial(input.profiles);
  input.prior.may_mirror = true;
  input.prior.may_be_upside_down = !input.wheel.radial;
  input.prior.upright = input.wheel.radial;
  return input;
}

ReferenceShape read_reference(const std::string& nominal, ObjectKind kind) {
  const std::string name = !nominal.empty() ? nominal : kind == ObjectKind::kRail ? "60E1" : "S1002";
  if (const auto format = profile_format(name)) {
    const Section baseline = section_of(read_recorded(name, *format, kind));
    const Outline chain = outline_of_section(baseline);
    // Material lies on the left of an outline's passage: a rail's head runs from right to left, a wheel from
    // field to flange.
    const bool leftwards = baseline.back().position.x() < baseline.front().position.x();
    return ReferenceShape(name, kind, leftwards ? chain : reversed(chain));
  }
  NominalProfile profile = read_nominal_profile(name);
  if (profile.kind != kind_name(kind))
    throw Error(name, "is the outline of a " + (profile.kind.empty() ? "thing without kind" : profile.kind),
                "give the outline of a " + kind_name(kind) + ", or the other --kind");
  return ReferenceShape(profile.name.empty() ? name : profile.name, kind, std::move(profile.outline));
}

IdentifiedRail identify_rail(const std::vector<Profile>& profiles, const RegistrationOptions& options) {
  constexpr double kAsGood = 1.25;  // times the best rms
  std::vector<std::pair<double, std::string>> fits;
  for (const std::string& name : nominal_names()) {
    if (read_nominal_profile(name).kind != "rail") continue;
    if (const auto rms = median_rms(profiles, name, options)) fits.emplace_back(*rms, name);
  }
  if (fits.empty() && shows_head_alone(profiles, options))
    throw Error("--nominal auto", "the sections show a head alone, and rails are told apart by web and foot",
                "name the rail or give its outline");
  if (fits.empty())
    throw Error("--nominal auto", "none of the built-in rails fits the sections",
                "name the rail or give its outline");
  std::sort(fits.begin(), fits.end());
  IdentifiedRail found{fits[0].second, {}};
  for (std::size_t i = 1; i < fits.size(); ++i)
    if (fits[i].first < kAsGood * fits[0].first) found.also.push_back(fits[i].second);
  return found;
}

}  // namespace lightstripe
