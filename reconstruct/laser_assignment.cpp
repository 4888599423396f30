// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/laser_assignment.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "reconstruct/laser_reach.h"

namespace lightstripe {
namespace {

using Lines = std::vector<LineInImage>;

constexpr int kMaxTrials = 100'000;  // assignments looked at; beyond it all stripes count as ambiguous
constexpr int kMaxStray = 3;         // lines of a group that may be no plane's light (reflections)

/// For each line of a group which of its candidates it gets in some assignment; the last entry: none.
using Options = std::vector<std::vector<bool>>;

/// What the assignments of a group of lines say.
struct GroupResult {
  bool decided = false;
  bool has_far = false;   ///< no assignment does without depths far from the range
  Options likely, every;  ///< of the assignments with the fewest far depths; of all
};

/// Walks all assignments in which exactly `stray` lines are no plane's light.
class GroupSearch {
 public:
  GroupSearch(const Sensor& sensor, Lines group, const Eigen::Vector2d& normal)
      : sensor_(sensor), lines_(std::move(group)), normal_(normal), chosen_(lines_.size(), kNone) {
    for (const auto& line : lines_) stride_ = std::max(stride_, line.candidates.size());
    compatible_.assign(lines_.size() * stride_ * lines_.size() * stride_, kUnknown);
  }

  GroupResult run() {
    for (int stray = 0; stray <= kMaxStray && stray < static_cast<int>(lines_.size()); ++stray) {
      result_ = {false, false, none_possible(), none_possible()};
      fewest_far_ = std::numeric_limits<int>::max();
      from(0, stray, 0);
      if (trials_ > kMaxTrials) return {};
      if (!result_.decided) continue;
      result_.has_far = fewest_far_ > 0;
      return result_;
    }
    return {};
  }

 private:
  static constexpr int kNone = -1;
  static constexpr std::int8_t kUnknown = -1;

  Options none_possible() const {
    Options options;
    for (const auto& line : lines_) options.emplace_back(line.candidates.size() + 1, false);
    return options;
  }

  void note(Options& options) const {
    for (std::size_t k = 0; k < lines_.size(); ++k)
      options[k][chosen_[k] == kNone ? lines_[k].candidates.size() : static_cast<std::size_t>(chosen_[k])] =
          true;
  }

  void note_assignment(int far) {
    result_.decided = true;
    if (far < fewest_far_) fewest_far_ = far, result_.likely = none_possible();
    if (far == fewest_far_) note(result_.likely);
    note(result_.every);
  }

  bool fits(std::size_t i, std::size_t candidate, std::size_t k) {
    if (chosen_[k] == kNone) return true;
    const auto other = static_cast<std::size_t>(chosen_[k]);
    std::int8_t& known = compatible_[((i * stride_ + candidate) * lines_.size() + k) * stride_ + other];
    if (known == kUnknown)
      known = are_compatible(sensor_, lines_[k], lines_[k].candidates[other], lines_[i],
                             lines_[i].candidates[candidate], normal_);
    return known != 0;
  }

  void from(std::size_t i, int stray, int far) {
    if (trials_ > kMaxTrials) return;
    if (i == lines_.size()) {
      if (stray == 0) note_assignment(far);
      return;
    }
    for (std::size_t c = 0; c < lines_[i].candidates.size(); ++c) {
      ++trials_;
      bool all_fit = true;
      for (std::size_t k = 0; all_fit && k < i; ++k) all_fit = fits(i, c, k);
      if (!all_fit) continue;
      chosen_[i] = static_cast<int>(c);
      from(i + 1, stray, far + (lines_[i].candidates[c].reach == Reach::kFar ? 1 : 0));
      chosen_[i] = kNone;
    }
    if (stray > 0) from(i + 1, stray - 1, far);
  }

  const Sensor& sensor_;
  Lines lines_;
  Eigen::Vector2d normal_;
  std::vector<int> chosen_;
  std::size_t stride_ = 0;
  std::vector<std::int8_t> compatible_;
  int trials_ = 0, fewest_far_ = 0;
  GroupResult result_;
};

/// Lines that are beside each other, directly or by others between, by their indices; those of no plane are
/// in none: they say nothing about the others.
std::vector<std::vector<std::size_t>> groups_of(const Lines& lines) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<bool> taken(lines.size(), false);
  for (std::size_t start = 0; start < lines.size(); ++start) {
    if (taken[start] || lines[start].candidates.empty()) continue;
    std::vector<std::size_t> group{start};
    taken[start] = true;
    for (std::size_t at = 0; at < group.size(); ++at)
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (!taken[k] && !lines[k].candidates.empty() && are_beside(lines[group[at]], lines[k])) {
          taken[k] = true;
          group.push_back(k);
        }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

Lines chosen(const Lines& lines, const std::vector<std::size_t>& indices) {
  Lines out;
  for (const std::size_t i : indices) out.push_back(lines[i]);
  return out;
}

/// The only option of a line, if it is a plane.
const PlaneCandidate* only_plane(const LineInImage& line, const std::vector<bool>& options) {
  if (std::count(options.begin(), options.end(), true) != 1 || options.back()) return nullptr;
  return &line.candidates[static_cast<std::size_t>(std::find(options.begin(), options.end(), true) -
                                                   options.begin())];
}

/// Whether at least two lines of the group lie outside the range for certain, by their order: then so may
/// those of the other groups. One alone could be a reflection.
bool proves_light_outside(const Lines& group, const GroupResult& result) {
  int outside = 0;
  for (std::size_t i = 0; result.decided && i < group.size(); ++i) {
    const PlaneCandidate* only = only_plane(group[i], result.every[i]);
    if (only != nullptr && only->reach != Reach::kInside) ++outside;
  }
  return outside >= 2;
}

LineDecision decision_of(const LineInImage& line, const std::vector<bool>& options) {
  LineDecision decision;
  const PlaneCandidate* only = only_plane(line, options);
  if (only != nullptr && only->reach == Reach::kInside) {
    decision.plane = only->plane;
    return decision;
  }
  for (std::size_t c = 0; c < line.candidates.size(); ++c)
    if (options[c] && line.candidates[c].reach != Reach::kInside) decision.may_lie_outside = true;
  if (only != nullptr) decision.outside_mm = only->depth_mm;
  return decision;
}

}  // namespace

std::vector<LineDecision> assign_by_reach(const std::vector<Stripe>& stripes, const Sensor& sensor) {
  const Eigen::Vector2d normal = common_normal(stripes);
  Lines lines;
  for (const auto& stripe : stripes) lines.push_back(line_in_image(stripe, sensor, normal));
  const auto groups = groups_of(lines);
  std::vector<GroupResult> results;
  bool light_outside = false;
  for (const auto& group : groups) {
    results.push_back(GroupSearch(sensor, chosen(lines, group), normal).run());
    light_outside = light_outside || proves_light_outside(chosen(lines, group), results.back());
  }
  std::vector<LineDecision> decisions(stripes.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!results[g].decided) continue;
    const Options& options = light_outside || results[g].has_far ? results[g].every : results[g].likely;
    for (std::size_t i = 0; i < groups[g].size(); ++i)
      decisions[groups[g][i]] = decision_of(lines[groups[g][i]], options[i]);
  }
  return decisions;
}

}  // namespace lightstripe
