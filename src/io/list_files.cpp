// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Files by pattern, in natural order.
#include <dirent.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

#include "core/error.h"
#include "io/images.h"
#include "io/name_numbers.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWildcards = "*?";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }  // UTF-8

/// '*' = any text, '?' = one character. Greedy with one step back to the last '*': no exponential patterns.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, star_at = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_at = n;
    } else if (p < pattern.size() && pattern[p] == '?') {
      ++p;
      do {
        ++n;
      } while (n < name.size() && continues_character(name[n]));
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++star_at;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool begins_negative(std::string_view text, std::size_t at) {
  return is_minus_sign(text, at) && at + 1 < text.size() && is_digit(text[at + 1]);
}

/// The digits of the number at `at`, which goes behind it; without sign and zeros ahead.
std::string_view magnitude_at(std::string_view text, std::size_t& at, bool negative) {
  if (negative) ++at;
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t start = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return text.substr(start, at - start);
}

bool is_folder(const fs::path& folder, const dirent& entry) {
  if (entry.d_type != DT_UNKNOWN && entry.d_type != DT_LNK) return entry.d_type == DT_DIR;
  std::error_code ignored;
  return fs::is_directory(folder / entry.d_name, ignored);
}

/// By readdir: std::filesystem makes a path of each entry, which takes half the time of a long listing.
std::vector<std::string> matching_names(const fs::path& folder, const std::string& pattern) {
  const auto fail = [&folder] {
    throw Error(folder.string(), fmt::format("cannot be read ({})", std::generic_category().message(errno)),
                "check its permissions");
  };
  const std::unique_ptr<DIR, int (*)(DIR*)> listing(::opendir(folder.empty() ? "." : folder.c_str()),
                                                    ::closedir);
  if (!listing) fail();
  std::vector<std::string> found;
  errno = 0;
  while (const dirent* entry = ::readdir(listing.get())) {
    const std::string_view name(entry->d_name);
    const bool hidden = name.front() == '.' && pattern.front() != '.';
    if (!hidden && matches(pattern, name) && !is_folder(folder, *entry)) found.emplace_back(name);
    errno = 0;
  }
  if (errno != 0) fail();
  return found;
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const bool negative_a = begins_negative(a, i), negative_b = begins_negative(b, j);
    const bool number_a_here = negative_a || is_digit(a[i]), number_b_here = negative_b || is_digit(b[j]);
    if (!number_a_here || !number_b_here) {
      if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
      ++i;
      ++j;
      continue;
    }
    const std::string_view number_a = magnitude_at(a, i, negative_a),
                           number_b = magnitude_at(b, j, negative_b);
    if (number_a.empty() && number_b.empty()) continue;  // 0 and -0: equal so far
    if (negative_a != negative_b) return negative_a;
    const bool less =
        number_a.size() != number_b.size() ? number_a.size() < number_b.size() : number_a < number_b;
    if (number_a != number_b) return less != negative_a;
  }
  const std::size_t left_a = a.size() - i, left_b = b.size() - j;
  return left_a != left_b ? left_a < left_b : a < b;  // "01" and "1": any order, but always the same
}

FileNames list_file_names(const fs::path& base, const std::string& pattern) {
  const fs::path whole = base / pattern;
  const fs::path folder = whole.parent_path();
  const std::string name = whole.filename().string();
  std::error_code error;
  // A file of exactly this name, though it has a * or ? in it.
  if (name.find_first_of(kWildcards) != std::string::npos && fs::is_regular_file(whole, error))
    return {folder, {name}};
  if (fs::path(pattern).parent_path().string().find_first_of(kWildcards) != std::string::npos)
    throw Error(pattern, "has a * or ? in a folder's name",
                "name one folder and use * in the file name only");
  if (name.find_first_of(kWildcards) == std::string::npos) {
    if (fs::is_directory(whole, error))
      throw Error(whole.string(), "is a folder", "say which files, e.g. folder/*.png");
    if (!fs::exists(whole, error)) throw Error(whole.string(), "no such file", "check the path");
    return {folder, {name}};
  }
  if (!folder.empty() && !fs::is_directory(folder, error))
    throw Error(folder.string(), "no such folder", "check the path");
  FileNames files{folder, matching_names(folder, name)};
  if (files.names.empty()) throw Error(whole.string(), "no file matches", "check the pattern");
  std::sort(files.names.begin(), files.names.end(), natural_less);
  return files;
}

std::vector<fs::path> list_files(const fs::path& base, const std::string& pattern) {
  const FileNames files = list_file_names(base, pattern);
  std::vector<fs::path> paths;
  for (const std::string& name : files.names) paths.push_back(files.folder / name);
  return paths;
}

std::string matched_text(const std::string& pattern, const fs::path& file) {
  const std::string wanted = fs::path(pattern).filename().string(), name = file.filename().string();
  LIGHTSTRIPE_CHECK(matches(wanted, name), "the file matches the pattern");
  const std::size_t first = wanted.find_first_of(kWildcards);
  if (first == std::string::npos) return "";
  const std::size_t behind = wanted.size() - 1 - wanted.find_last_of(kWildcards);
  return name.substr(first, name.size() - first - behind);
}

}  // namespace lightstripe
