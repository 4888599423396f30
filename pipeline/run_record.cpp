// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/run_record.h"

#include <fmt/format.h>

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/yaml_binding.h"
#include "parallel/parallel.h"

namespace lightstripe {
FileFacts facts_of(const std::filesystem::path& path) {
  refuse_special_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string(), "cannot be read", "check the path");
  FileFacts facts;
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> digest(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  LIGHTSTRIPE_CHECK(digest && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) == 1,
                    "SHA-256 is there");
  std::vector<char> part(std::size_t{1} << 20);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0) {
    const auto got = static_cast<std::size_t>(file.gcount());
    facts.bytes += got;
    EVP_DigestUpdate(digest.get(), part.data(), got);
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
  unsigned length = 0;
  EVP_DigestFinal_ex(digest.get(), sum.data(), &length);
  for (unsigned i = 0; i < length; ++i) facts.sha256 += fmt::format("{:02x}", sum[i]);
  return facts;
}

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t before) {
  for (const char byte : bytes) before = (before ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return before;
}

std::string indented(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    out += "  " + text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return out;
}

void write_run_record(const std::filesystem::path& output, const std::string& command,
                      const std::vector<std::filesystem::path>& inputs, const std::string& options) {
  std::string text = fmt::format("lightstripe: {}\ncommand: {}\ninputs:\n", LIGHTSTRIPE_VERSION, command);
  std::vector<FileFacts> all(inputs.size());
  parallel_for(inputs.size(), 0, [&](std::size_t i) { all[i] = facts_of(inputs[i]); });
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& input = inputs[i];
    const FileFacts& facts = all[i];
    text += fmt::format("  - {{file: {}, bytes: {}, sha256: \"{}\"}}\n", yaml_text(input.string()),
                        facts.bytes, facts.sha256);
  }
  write_file(output.string() + ".run.yaml", text + options);
}

}  // namespace lightstripe
