// The name of a file that a pass writes, as an option: merge{csv=parts.csv}. Whoever runs a pipeline can ask it for
// them (Pipeline::written_files), so that none takes the place of another file of the command.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

struct WrittenFile {
  static constexpr std::string_view type = "file";
  static constexpr std::string_view table = ".csv .tsv .txt";

  std::string path = {};          // empty: none is written
  std::string_view endings = {};  // that its name may have, with blanks between them; empty: any but a scene's

  bool read(std::string_view text) {
    path = text;
    return true;
  }
  const std::string& print() const { return path; }
};

/// One of the files that a pipeline writes in addition to the scene.
struct WrittenFileOption {
  std::string option;  // "merge{csv=...}"
  WrittenFile file;
};

}  // namespace wrlkit
