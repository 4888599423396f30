// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/rig_of_sections.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "io/crc32.h"
#include "io/rig_file.h"
#include "io/yaml_binding.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// A record outlives a table that is replaced by hand or by a program that knows nothing of it.
struct TableFacts {
  std::uint64_t bytes = 0;
  std::string crc32;  ///< of the whole file, 8 hexadecimal digits
  bool operator==(const TableFacts&) const = default;
};
template <class V>
void visit_fields(V&& v, TableFacts& o) {
  v("bytes", o.bytes), v("crc32", o.crc32);
}

/// Folders are moved as a whole, tables without their rig: one of both paths still holds.
struct RigFields {
  std::string file;       ///< absolute
  std::string from_here;  ///< from the record's folder
  std::string sha256;
};
template <class V>
void visit_fields(V&& v, RigFields& o) {
  v("file", o.file), v("from_here", o.from_here), v("sha256", o.sha256);
}

struct RecordFields {
  TableFacts table;
  std::optional<RigFields> rig;
  std::optional<std::string> without_rig;
};
template <class V>
void visit_fields(V&& v, RecordFields& o) {
  v("table", o.table), v("rig", o.rig), v("without_rig", o.without_rig);
}

fs::path record_of(const fs::path& table) { return table.string() + ".run.yaml"; }

TableFacts table_facts(const fs::path& table) {
  std::ifstream file(table, std::ios::binary);
  if (!file) throw Error(table.string(), "cannot be read", "check the path");
  TableFacts facts;
  std::uint32_t crc = 0;
  std::vector<char> part(std::size_t{1} << 20);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0) {
    const auto got = static_cast<std::size_t>(file.gcount());
    crc = crc32({part.data(), got}, crc);
    facts.bytes += got;
  }
  facts.crc32 = fmt::format("{:08x}", crc);
  return facts;
}

/// Symbolic links resolved, so that the way between both is one that the system goes as well.
fs::path full_path(const fs::path& path) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : full;
}

RigFields fields_of(const RigPlace& rig, const fs::path& table) {
  const fs::path file = full_path(rig.file);
  return {file.string(), file.lexically_relative(full_path(table).parent_path()).string(), rig.sha256};
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// Where the rig is to be looked for: the file of this hash, else one that is there at all.
fs::path present_place(const RigFields& rig, const fs::path& table) {
  const fs::path from_here = (full_path(table).parent_path() / rig.from_here).lexically_normal();
  for (const fs::path& place : {from_here, fs::path(rig.file)})
    if (is_file(place) && facts_of(place).sha256 == rig.sha256) return place;
  return is_file(from_here) && !rig.from_here.empty() ? from_here : fs::path(rig.file);
}

RecordedRig read_record(const fs::path& table) {
  const std::string record = record_of(table).string();
  RecordFields fields;
  const YamlSubtree of_table = read_entry(record, "table"), of_rig = read_entry(record, "rig");
  const YamlSubtree without = read_entry(record, "without_rig");
  if (of_table.empty()) return {std::nullopt, record + " says nothing of the rig"};
  read_subtree(of_table, fields.table);
  if (fields.table != table_facts(table))
    return {std::nullopt, record + " was written for another " + table.filename().string()};
  if (of_rig.empty())
    return {std::nullopt,
            record + " names no rig" + (without.empty() ? "" : ": the reason stands under without_rig")};
  read_subtree(of_rig, fields.rig.emplace());
  return {RigPlace{present_place(*fields.rig, table), fields.rig->sha256}, ""};
}

/// What to say where the table's own rig cannot be taken; empty where it can.
std::string why_not_taken(const RecordedRig& recorded, const fs::path& table) {
  if (!recorded.rig) return recorded.why_not;
  const std::string file = recorded.rig->file.string(), name = table.filename().string();
  if (!is_file(recorded.rig->file)) return fmt::format("the rig that made {} is gone ({})", name, file);
  if (facts_of(recorded.rig->file).sha256 != recorded.rig->sha256)
    return fmt::format("{} has changed since {} was made with it", file, name);
  return "";
}

}  // namespace

std::optional<RigPlace> place_of_rig(const fs::path& file, const Rig& rig) {
  if (!is_file(file)) return std::nullopt;
  const RigPlace place{file, facts_of(file).sha256};
  try {
    if (rig_to_yaml(read_rig(file, RigUse::kCameras)) == rig_to_yaml(rig)) return place;
  } catch (const Error&) {  // it is being written anew
  }
  return std::nullopt;
}

void write_sections_record(const fs::path& table, const std::string& command,
                           const std::vector<fs::path>& inputs, const std::optional<RigPlace>& rig,
                           const std::string& without_rig) {
  RecordFields fields;
  fields.table = table_facts(table);
  if (rig) fields.rig = fields_of(*rig, table);
  if (!rig && !without_rig.empty()) fields.without_rig = without_rig;
  write_run_record(table, command, inputs, dump_yaml(fields));
}

RecordedRig recorded_rig(const fs::path& table) {
  if (!is_file(table) || !is_file(record_of(table))) return {};
  try {
    return read_record(table);
  } catch (const Error& error) {
    return {std::nullopt, error.what()};
  }
}

RigOfSections rig_of_sections(const fs::path& table, const fs::path& given) {
  const RecordedRig recorded = recorded_rig(table);
  if (!given.empty()) {
    RigOfSections out{given, false, ""};
    if (recorded.rig && is_file(given) && facts_of(given).sha256 != recorded.rig->sha256)
      out.warning = fmt::format("{} is not the rig that made {}: its record names another", given.string(),
                                table.filename().string());
    return out;
  }
  const std::string why_not = why_not_taken(recorded, table);
  if (recorded.rig && why_not.empty()) return {recorded.rig->file, true, ""};
  if (why_not.empty()) return {};
  return {{}, false, why_not + ": the sigmas do not count the calibration's error; name the rig with --rig"};
}

}  // namespace lightstripe
