// Runs a fuzz target without libFuzzer: on every seed, and on mutations of it that are the same on
// every machine. Usage: TARGET MUTATIONS_PER_SEED FILE_OR_FOLDER...
// An input that ends the process, or takes too long, is left in crash-input, in the working folder.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

#include "fuzz/fuzz_target.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

// In seconds, on a slow machine with sanitizers: what takes longer hangs.
constexpr unsigned longest_run = 30;

std::string current_input;

void save_input(int signal) {
  std::ofstream("crash-input", std::ios::binary) << current_input;
  std::fprintf(stderr, "signal %d: see crash-input\n", signal);
  std::_Exit(1);
}

void run(const std::string& input) {
  current_input = input;
  alarm(longest_run);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// A few bytes changed, taken out, repeated or moved.
std::string mutated(std::string input, std::mt19937& random) {
  for (unsigned change = 1 + random() % 4; change > 0; --change) {
    const std::size_t at = random() % (input.size() + 1);
    const std::size_t length = std::min<std::size_t>(random() % 9, input.size() - at);
    switch (random() % 4) {
      case 0:
        input.insert(at, 1, static_cast<char>(random()));
        break;
      case 1:
        input.erase(at, length);
        break;
      case 2:
        input.insert(random() % (input.size() + 1), input.substr(at, length));
        break;
      default:
        if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1U << random() % 8));
    }
  }
  return input;
}

std::vector<fs::path> seeds_in(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

int replay(int mutations, const std::vector<fs::path>& seeds) {
  for (const fs::path& seed : seeds) {
    std::ifstream file(seed, std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(file), {}};
    require(file.good(), "cannot read " + seed.string());
    std::fprintf(stderr, "%s\n", seed.c_str());
    run(input);
    std::mt19937 random(20240607);
    for (int i = 0; i < mutations; ++i) run(mutated(input, random));
  }
  require(!seeds.empty(), "there are no seeds");
  std::fprintf(stderr, "%zu seeds, %d mutations of each\n", seeds.size(), mutations);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace hexwall::test

int main(int argc, char** argv) {
  using namespace hexwall::test;
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGALRM}) {
    std::signal(signal, save_input);
  }
  require(argc > 2, "usage: TARGET MUTATIONS_PER_SEED FILE_OR_FOLDER...");
  std::vector<fs::path> seeds;
  for (int i = 2; i < argc; ++i) {
    for (const fs::path& seed : seeds_in(argv[i])) seeds.push_back(seed);
  }
  return replay(std::atoi(argv[1]), seeds);
}
