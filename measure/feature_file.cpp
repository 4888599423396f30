// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/feature_file.h"

#include <cstddef>
#include <set>
#include <utility>

#include "core/counted.h"
#include "core/error.h"

namespace lightstripe {
namespace {

struct Use {
  std::size_t least, most;
  bool first_is_line = false;
};

Use use_of(QuantityType type) {
  switch (type) {
    case QuantityType::kStepHeight:
      return {2, 2, true};
    case QuantityType::kGap:
    case QuantityType::kFlush:
      return {2, 3};
    case QuantityType::kAngle:
      return {1, 2, true};
    case QuantityType::kDistance:
    case QuantityType::kWidth:
      return {2, 2};
    case QuantityType::kArea:
    case QuantityType::kFlatness:
      return {1, 1, true};
    default:
      return {1, 1};
  }
}

/// Names of the features so far, and what they are.
struct Names {
  std::string origin;
  std::vector<std::pair<std::string, FeatureType>> known;

  FeatureType type_of(const std::string& name, const std::string& user) const {
    for (const auto& [one, type] : known)
      if (one == name) return type;
    throw Error(origin + ": " + user, "asks for the feature '" + name + "', which is not named before it",
                "name it above");
  }
  void need(const std::string& name, const std::string& user, FeatureType type) const {
    if (type_of(name, user) != type)
      throw Error(origin + ": " + user,
                  "needs '" + name + "' to be of the type " + std::string(enum_name(type)),
                  "name another feature");
  }
};

void check_range(const std::vector<double>& range, const std::string& subject) {
  if (!range.empty() && (range.size() != 2 || !(range[0] < range[1])))
    throw Error(subject, "is no range", "write [from, to] with from < to");
}

void check_feature(const FeatureRecipe& one, Names& names) {
  const std::string subject = names.origin + ": " + one.name;
  if (one.name.empty()) throw Error(names.origin + ": features", "one has no name", "add a name");
  for (const auto& [name, type] : names.known)
    if (name == one.name) throw Error(subject, "is named twice", "give each feature its own name");
  check_range(one.u, subject + ".u"), check_range(one.v, subject + ".v");
  if (!one.anchor.empty()) names.type_of(one.anchor, one.name);
  if (one.type == FeatureType::kIntersection) {
    if (one.of.size() != 2) throw Error(subject, "needs two lines", "write of: [first, second]");
    for (const std::string& line : one.of) names.need(line, one.name, FeatureType::kLine);
  }
  names.known.emplace_back(one.name, one.type);
}

void check_quantity(const QuantityRecipe& one, const Names& names) {
  const std::string subject = names.origin + ": " + one.name;
  if (one.name.empty()) throw Error(names.origin + ": measurements", "one has no name", "add a name");
  const Use use = use_of(one.type);
  if (one.of.size() < use.least || one.of.size() > use.most)
    throw Error(subject,
                "names " + counted(one.of.size(), "feature") + ", " + std::to_string(use.least) +
                    (use.most > use.least ? " or " + std::to_string(use.most) : "") + " needed",
                "correct `of`");
  for (const std::string& feature : one.of) names.type_of(feature, one.name);
  if (use.first_is_line) names.need(one.of[0], one.name, FeatureType::kLine);
  if (one.type == QuantityType::kAngle && one.of.size() == 2)
    names.need(one.of[1], one.name, FeatureType::kLine);
  if (one.of.size() == 3) names.need(one.of[2], one.name, FeatureType::kLine);
  if (one.type == QuantityType::kRadius) names.need(one.of[0], one.name, FeatureType::kArc);
  check_range(one.u, subject + ".u");
}

}  // namespace

void FeatureFile::check(const std::string& origin) const {
  if (measurements.empty() && along.empty())
    throw Error(origin + ": measurements", "are missing", "name what to measure; see configs/features.yaml");
  Names names{origin, {}};
  for (const FeatureRecipe& one : features) check_feature(one, names);
  std::set<std::string> quantities;
  for (const QuantityRecipe& one : measurements) {
    check_quantity(one, names);
    if (!quantities.insert(one.name).second)
      throw Error(origin + ": " + one.name, "is measured twice", "give each measurement its own name");
  }
  for (const AlongRecipe& one : along) {
    if (one.of.size() != (one.type == AlongType::kParallelism ? 2U : 1U))
      throw Error(origin + ": " + one.name, "names the wrong number of features",
                  "parallelism needs two lines, the others one feature");
    for (const std::string& feature : one.of) names.type_of(feature, one.name);
    if (one.type == AlongType::kFlatness) names.need(one.of[0], one.name, FeatureType::kLine);
  }
}

}  // namespace lightstripe
