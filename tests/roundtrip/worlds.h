#pragma once
// The folders of worlds that the round trips go through.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

/// What CTest knows a skipped test by.
constexpr int skipped = 77;

inline std::filesystem::path found_corpus() {
  const char* shared = std::getenv("WRLKIT_SHARED");
  const std::filesystem::path beside = std::filesystem::path(WRLKIT_SOURCE_DIR).parent_path() / "shared";
  return (shared ? std::filesystem::path(shared) : beside) / "corpus";
}

/// Files below a folder, in their order.
inline std::vector<std::string> files_below(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

/// The folders that the command line names; `--found` is the found corpus. None when one of them is not there, which is
/// said.
inline std::vector<std::string> folders_of(int argc, char** argv) {
  std::vector<std::string> folders;
  for (int i = 1; i < argc; ++i) {
    folders.push_back(std::string(argv[i]) == "--found" ? found_corpus().string() : argv[i]);
    if (std::filesystem::is_directory(folders.back())) continue;
    std::printf("skipped: there is no %s\n", folders.back().c_str());
    return {};
  }
  return folders;
}
