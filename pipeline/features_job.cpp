// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/features_job.h"

#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/output_guard.h"
#include "io/tables.h"
#include "io/yaml_binding.h"
#include "measure/section_bends.h"
#include "parallel/parallel.h"
#include "pipeline/job.h"
#include "pipeline/measurement_table.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

constexpr int kFeatureDecimals = 5;

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
    append_estimate(out, result.along[i], kFeatureDecimals);
    out += ',' + csv_cell(result.along[i].reason) + '\n';
  }
  return out;
}

}  // namespace

std::string features_table(const FeaturesResult& result) {
  std::string out = "frame,travel";
  for (const QuantityRecipe& one : result.file.measurements)
    out += ',' + csv_cell(one.name) + ',' + csv_cell(one.name + "_sigma");
  out += ",status,verdict,missing,calibration_error\n";
  for (const MeasuredFeatures& row : result.rows) {
    append_integer(out, row.frame);
    out.push_back(',');
    append_decimals(out, row.travel, 6);
    for (const Estimate& estimate : row.quantities) append_estimate(out, estimate, kFeatureDecimals);
    const std::string missing = missing_of(row, result.file);
    out += missing.empty() ? ",ok," : ",incomplete,";
    out += row.verdict + ',' + (missing.empty() ? "" : csv_cell(missing)) + ',' +
           calibration_word(result.calibration) + '\n';
  }
  return out;
}

namespace {

/// The sections' rows and what is measured along them, with what the calibration's error does to each.
void measure_all(FeaturesResult& result) {
  const SectionBends& bends = result.calibration.bends;
  result.rows.resize(result.profiles.size());
  // Kept only for what is measured over all of them.
  std::vector<std::vector<MeasuredFeatures>> bent_rows;
  if (!result.file.along.empty()) bent_rows.assign(bends.bends.size(), result.rows);
  parallel_for(result.profiles.size(), [&](std::size_t i) {
    result.rows[i] = measure_with_errors(bends.bends.size(), [&](std::optional<std::size_t> bend) {
      if (!bend) return measure_features(result.profiles[i], result.file);
      MeasuredFeatures row = measure_features(bent(result.profiles[i], bends, *bend), result.file);
      if (!bent_rows.empty()) bent_rows[*bend][i] = row;
      return row;
    });
  });
  result.along = measure_along(result.rows, result.file);
  for (const auto& rows : bent_rows) {
    const std::vector<Estimate> under_bend = measure_along(rows, result.file);
    for (std::size_t i = 0; i < result.along.size(); ++i) add_bend(under_bend[i], result.along[i]);
  }
  for (const MeasuredFeatures& row : result.rows)
    result.num_complete += std::all_of(row.quantities.begin(), row.quantities.end(),
                                       [](const Estimate& e) { return e.value.has_value(); })
                               ? 1
                               : 0;
}

void guard(const FeaturesJob& job, const RigOfSections& rig) {
  std::vector<std::filesystem::path> outputs = job.other_outputs;
  outputs.insert(outputs.end(), {job.table, job.table.string() + ".run.yaml", along_file(job.table)});
  guard_outputs({job.profiles, job.profiles.string() + ".run.yaml", job.features, rig.file}, outputs);
}

void write_results(const FeaturesJob& job, FeaturesResult& result) {
  write_file(job.table, features_table(result));
  if (!result.along.empty()) {
    result.along_table = along_file(job.table);
    write_file(result.along_table, along_table(result));
  }
  std::vector<std::filesystem::path> inputs{job.profiles, job.features};
  if (!result.rig.file.empty()) inputs.push_back(result.rig.file);
  write_run_record(job.table, "measure", inputs, calibration_yaml(result.calibration) + "kind: features\n");
}

}  // namespace

FeaturesResult measure_features_job(const FeaturesJob& job) {
  const JobThreads threads(job.threads);
  FeaturesResult result;
  result.rig = rig_of_sections(job.profiles, job.rig);
  guard(job, result.rig);
  read_yaml(job.features, result.file);
  result.file.check(job.features.string());
  result.profiles = read_profiles(job.profiles);
  if (result.profiles.empty())
    throw Error(job.profiles.string(), "has no rows", "give the sections of a scan");
  result.calibration = calibration_errors(result.rig.file, job.profiles, result.profiles);
  measure_all(result);
  write_results(job, result);
  return result;
}

}  // namespace lightstripe
