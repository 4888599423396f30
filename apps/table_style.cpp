// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/table_style.h"

#include "apps/options.h"
#include "io/atomic_file.h"
#include "io/excel_csv.h"

namespace lightstripe {

void add_table_style_option(CLI::App& command, TableStyle& style) {
  add_choice<TableStyle>(command, "--csv-style", style,
                         {{"plain", TableStyle::kPlain}, {"excel", TableStyle::kExcel}},
                         "plain, or excel: semicolons, decimal commas and a byte order mark [plain]");
}

void apply_table_style(const std::filesystem::path& table, TableStyle style) {
  if (style == TableStyle::kExcel && table.extension() == ".csv")
    write_file(table, excel_csv(read_file(table)));
}

}  // namespace lightstripe
