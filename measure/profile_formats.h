// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Files of the railway world: MiniProf (.ban, .whl) and Simpack (.prr, .prw), read and written.
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/reference_shape.h"

namespace lightstripe {

/// Of a wheel: from the flange's back to the place of the tread where v is 0, mm.
inline constexpr double kTreadDatumMm = 70;

/// One recorded section, turned so that v is up. Rail: u, v as recorded. Wheel: u from the tread datum, i.e.
/// the file's distance from the flange's back minus 70.
struct RecordedProfile {
  ObjectKind kind = ObjectKind::kRail;
  std::vector<Eigen::Vector2d> points;
  std::map<std::string, std::string> header;  ///< keys and values as they stand
  int further_profiles = 0;                   ///< of an .mpt: profiles behind the first, which are not read

  /// A header value that is a number.
  std::optional<double> number(const std::string& key) const;
};

enum class ProfileFormat { kMiniProf, kSimpack };

/// By the file name's end (any case): .ban .whl .mpt are MiniProf, .prr .prw Simpack; nothing for others.
std::optional<ProfileFormat> profile_format(std::string_view file_name);

/// MiniProf: "key=value" lines, an empty line, rows "x y ..."; the older style that begins with "MINIPROF"
/// and "key...: value" lines; the first part "[...Points]" of an .mpt. What stands behind " ! or % is a
/// remark, also a whole row, and so is text behind a row's numbers; a Ctrl-Z ends the file. Up or down and
/// left or right are found from the shape, and of a wheel whether x counts from the flange's back or the
/// tread datum. An Error with `name` for what is no profile: fewer than ten points, more than a million, no
/// number, decimal commas.
RecordedProfile read_miniprof(std::istream& in, const std::string& name, ObjectKind kind);
/// Simpack: type 0 rail, 1 wheel; units from units.len.f. An Error also where the file asks for a shift, a
/// rotation or a mirror, which are not applied.
RecordedProfile read_simpack(std::istream& in, const std::string& name);

void write_miniprof(std::ostream& out, const RecordedProfile& profile);
void write_simpack(std::ostream& out, const RecordedProfile& profile);

/// As a section: one chain, one sensor.
Section section_of(const RecordedProfile& profile);

}  // namespace lightstripe
