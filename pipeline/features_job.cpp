// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/features_job.h"

#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/output_guard.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "io/yaml_binding.h"
#include "measure/section_bends.h"
#include "parallel/parallel.h"
#include "pipeline/job.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

void append_estimate(std::string& out, const Estimate& estimate) {
  out.push_back(',');
  if (estimate.value) append_decimals(out, *estimate.value, 5);
  out.push_back(',');
  if (estimate.value && estimate.sigma) append_decimals(out, *estimate.sigma, 6);
}

std::string missing_of(const MeasuredFeatures& row, const FeatureFile& file) {
  std::string out;
  for (std::size_t i = 0; i < row.quantities.size(); ++i)
    if (!row.quantities[i].value)
      out += (out.empty() ? "" : " | ") + file.measurements[i].name + ": " + row.quantities[i].reason;
  return out;
}

std::filesystem::path along_file(std::filesystem::path table) {
  table.replace_extension();
  return table += "_along.csv";
}

std::string along_table(const FeaturesResult& result) {
  std::string out = "name,type,value,sigma,reason\n";
  for (std::size_t i = 0; i < result.along.size(); ++i) {
    out += csv_cell(result.file.along[i].name) + ',' + std::string(enum_name(result.file.along[i].type));
    append_estimate(out, result.along[i]);
    out += ',' + csv_cell(result.along[i].reason) + '\n';
  }
  return out;
}

}  // namespace

std::string features_table(const FeaturesResult& result) {
  std::string out = "frame,travel";
  for (const QuantityRecipe& one : result.file.measurements)
    out += ',' + csv_cell(one.name) + ',' + csv_cell(one.name + "_sigma");
  out += ",status,verdict,missing\n";
  for (const MeasuredFeatures& row : result.rows) {
    append_integer(out, row.frame);
    out.push_back(',');
    append_decimals(out, row.travel, 6);
    for (const Estimate& estimate : row.quantities) append_estimate(out, estimate);
    const std::string missing = missing_of(row, result.file);
    out += missing.empty() ? ",ok," : ",incomplete,";
    out += row.verdict + ',' + (missing.empty() ? "" : csv_cell(missing)) + '\n';
  }
  return out;
}

namespace {

/// With what the calibration's error does to each quantity.
MeasuredFeatures measure_with_bends(const Profile& profile, const FeatureFile& file,
                                    const SectionBends& bends) {
  MeasuredFeatures row = measure_features(profile, file);
  for (std::size_t b = 0; b < bends.bends.size(); ++b) {
    const MeasuredFeatures other = measure_features(bent(profile, bends, b), file);
    for (std::size_t i = 0; i < row.quantities.size(); ++i) add_bend(other.quantities[i], row.quantities[i]);
  }
  return row;
}

}  // namespace

FeaturesResult measure_features_job(const FeaturesJob& job) {
  const JobThreads threads(job.threads);
  std::vector<std::filesystem::path> outputs = job.other_outputs;
  outputs.insert(outputs.end(), {job.table, along_file(job.table)});
  guard_outputs({job.profiles, job.features, job.rig}, outputs);
  FeaturesResult result;
  read_yaml(job.features, result.file);
  result.file.check(job.features.string());
  result.profiles = read_profiles(job.profiles);
  if (result.profiles.empty())
    throw Error(job.profiles.string(), "has no rows", "give the sections of a scan");
  result.rows.resize(result.profiles.size());
  const SectionBends bends =
      job.rig.empty() ? SectionBends{} : read_rig(job.rig).quality.section_bends.value_or(SectionBends{});
  parallel_for(result.profiles.size(), [&](std::size_t i) {
    result.rows[i] = measure_with_bends(result.profiles[i], result.file, bends);
  });
  result.along = measure_along(result.rows, result.file);
  for (const MeasuredFeatures& row : result.rows)
    result.num_complete += std::all_of(row.quantities.begin(), row.quantities.end(),
                                       [](const Estimate& e) { return e.value.has_value(); })
                               ? 1
                               : 0;
  write_file(job.table, features_table(result));
  if (!result.along.empty()) {
    result.along_table = along_file(job.table);
    write_file(result.along_table, along_table(result));
  }
  return result;
}

}  // namespace lightstripe
