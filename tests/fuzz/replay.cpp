// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Stands in for libFuzzer where only g++ is there: runs every seed, then a fixed number of seeded mutations
// of them. usage: <target> [--mutations N] FILE|FOLDER...
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr double kMaxSeconds = 5;  // for one input: longer is a hang

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void add_seeds(const fs::path& path, std::vector<std::string>& seeds) {
  std::vector<fs::path> files;
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
  } else if (fs::exists(path)) {
    files.push_back(path);
  }
  for (const auto& file : files) seeds.push_back(bytes_of(file));
}

/// What makes readers stumble: limits of types, numbers that are none, brackets, line ends, zeros.
constexpr std::string_view kTokens[] = {"nan",
                                        "inf",
                                        "-1",
                                        "0",
                                        "1e999",
                                        "1e-999",
                                        "2147483648",
                                        "-9223372036854775809",
                                        "18446744073709551616",
                                        "[",
                                        "{",
                                        "\"",
                                        "'",
                                        "*",
                                        "&a",
                                        "!t",
                                        "\n",
                                        "\r",
                                        ",",
                                        ",,",
                                        "#",
                                        "- ",
                                        ": ",
                                        "\xff\xff\xff\xff",
                                        "\x80",
                                        "\t",
                                        "|",
                                        "%",
                                        "---\n",
                                        "...\n"};

class Mutator {
 public:
  std::string operator()(const std::string& seed, const std::string& other) {
    std::string text = seed;
    for (std::uint64_t i = 1 + below(4); i > 0; --i) mutate(text, other);
    text.resize(std::min(text.size(), kMaxBytes));
    return text;
  }

  std::uint64_t below(std::uint64_t limit) { return limit == 0 ? 0 : random_() % limit; }

 private:
  std::mt19937_64 random_{1};

  void mutate(std::string& text, const std::string& other) {
    const std::size_t at = below(text.size() + 1),
                      length = below(std::min<std::size_t>(text.size() - at, 64) + 1);
    switch (below(6)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, kTokens[below(std::size(kTokens))]);
        break;
      case 4:
        text.insert(at, other.substr(below(other.size() + 1), below(200)));
        break;
      default:
        text.resize(below(4) == 0 ? at : text.size());
        text.insert(at, text.substr(at, length));
    }
  }
};

bool run(const std::string& input) {
  const auto start = std::chrono::steady_clock::now();
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "finding: %s\n", error.what());
    return false;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  if (took.count() > kMaxSeconds) std::fprintf(stderr, "finding: took %.1f s\n", took.count());
  return took.count() <= kMaxSeconds;
}

/// Keeps the input that did it, for a seed of its own.
int report(const std::string& input) {
  std::ofstream("fuzz-finding", std::ios::binary) << input;
  std::fprintf(stderr, "the input is kept in %s\n", fs::absolute("fuzz-finding").c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  long mutations = 0;
  std::vector<std::string> seeds;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--mutations" && i + 1 < argc) {
      mutations = std::atol(argv[++i]);
    } else {
      add_seeds(argv[i], seeds);
    }
  }
  if (seeds.empty()) {
    std::fprintf(stderr, "no seeds given\n");
    return 2;
  }
  for (const auto& seed : seeds)
    if (!run(seed)) return report(seed);
  Mutator mutator;
  for (long i = 0; i < mutations; ++i) {
    const std::string input = mutator(seeds[mutator.below(seeds.size())], seeds[mutator.below(seeds.size())]);
    if (!run(input)) return report(input);
  }
  std::printf("%zu seeds, %ld mutations: no finding\n", seeds.size(), mutations);
  return 0;
}
