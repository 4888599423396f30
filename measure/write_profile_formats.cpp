// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <ostream>

#include "measure/profile_formats.h"

namespace lightstripe {
namespace {

double file_x(const RecordedProfile& profile, const Eigen::Vector2d& p) {
  return profile.kind == ObjectKind::kWheel ? p.x() + kTreadDatumMm : p.x();
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

}  // namespace

void write_miniprof(std::ostream& out, const RecordedProfile& profile) {
  out << "ProgramName=lightstripe\n";
  for (const auto& [key, value] : profile.header)
    if (key != "ProgramName" && key != "ColumnDef" && key != "XYPoints" && key != "Chars")
      out << one_line(key) << '=' << one_line(value) << '\n';
  out << fmt::format("ColumnDef=X,Y\nXYPoints={}\nChars=UTF8\n\n", profile.points.size());
  for (const Eigen::Vector2d& p : profile.points)
    out << fmt::format("{:.5f} {:.5f}\n", file_x(profile, p), p.y());
}

void write_simpack(std::ostream& out, const RecordedProfile& profile) {
  const bool wheel = profile.kind == ObjectKind::kWheel;
  out << fmt::format("header.begin\n  version = 1\n  type    = {}\nheader.end\nspline.begin\n",
                     wheel ? 1 : 0);
  out << "  approx.smooth = 0.0\n  comment       = 'lightstripe'\n  units.len.f   = 1000.\n  units.ang.f   = "
         "1.\n";
  out << "  point.begin\n";
  // z is down for a rail, as in the files known; a wheel's flange is up there.
  for (const Eigen::Vector2d& p : profile.points)
    out << fmt::format("    {:.6f} {:.6f}\n", file_x(profile, p), wheel ? p.y() : -p.y());
  out << "  point.end\nspline.end\n";
}

}  // namespace lightstripe
