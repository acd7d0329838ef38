// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzz target without libFuzzer: mutants FOLDER COUNT reads each file of the folder, and mutants of
// them, the same ones every time. None may end by a signal, take 5 s, or 1 GB; one that does is left in the
// file `mutant`.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" {
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t longest, unsigned seed)
    __attribute__((weak));
}

namespace {

constexpr unsigned longest_seconds = 5;
constexpr rlim_t most_bytes = 1000000000;

std::string present;  // the text at work

/// Leaves what ends the process in a file.
void keep_and_die(int signal) {
  const int file = open("mutant", O_CREAT | O_TRUNC | O_WRONLY, 0666);
  if (write(file, present.data(), present.size()) < 0) _exit(3);
  _exit(128 + signal);
}

std::vector<std::string> texts_of(const char* folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// A text with some bytes changed, or of something else of its kind.
std::string mutant(std::string text, unsigned seed) {
  constexpr std::size_t longest = 100000;
  if (LLVMFuzzerCustomMutator) {
    const std::size_t size = std::min(text.size(), longest);
    text.resize(longest);
    text.resize(LLVMFuzzerCustomMutator(reinterpret_cast<std::uint8_t*>(text.data()), size, longest, seed));
    return text;
  }
  std::minstd_rand random(seed);
  for (unsigned more = 1 + random() % 4; more > 0 && !text.empty(); --more) {
    const std::size_t at = random() % text.size();
    if (random() % 3 == 0)
      text.erase(at, 1 + random() % 10);
    else
      text[at] = static_cast<char>(random() % 2 ? random() : text[at] ^ (1 << random() % 8));
  }
  return text;
}

void run(const std::string& text) {
  present = text;
  alarm(longest_seconds);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(present.data()), present.size());
  alarm(0);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
#ifndef __SANITIZE_ADDRESS__
  const rlimit memory = {most_bytes, most_bytes};
  setrlimit(RLIMIT_AS, &memory);
#endif
  for (const int one : {SIGABRT, SIGALRM, SIGFPE, SIGSEGV, SIGBUS}) signal(one, keep_and_die);
  const std::vector<std::string> corpus = texts_of(words[1]);
  if (corpus.empty()) return 2;
  for (const std::string& text : corpus) run(text);
  const auto mutants = static_cast<unsigned>(std::atoi(words[2]));
  for (unsigned seed = 1; seed <= mutants; ++seed) {
    std::string text = corpus[seed % corpus.size()];
    for (unsigned generation = 0; generation <= seed % 3; ++generation)
      text = mutant(text, seed + 1000003 * generation);
    run(text);
  }
  std::printf("%zu files and %u mutants\n", corpus.size(), mutants);
}
