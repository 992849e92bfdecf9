// What a command may write, checked before any work.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "passes/pipeline/written_file.h"
#include "tools/cli/flags.h"

namespace wrlkit {

/// False, which was printed, when an output of the command is a file that it reads, two of them are one file, or the
/// name of one ends in none of the verb's `endings` (".xml .xml.gz"; empty: any). With Flags::load.in_place the output
/// may be the input. `makes`: the output is a folder, in which a file of this name is made; empty: it is a file.
bool check_outputs(const Flags& flags, std::string_view endings, std::string_view makes);
/// The same of files that options of passes name, which must not be those of check_outputs either. Each is of one
/// world: several would replace it one after the other.
bool check_written_files(const Flags& flags, std::span<const WrittenFileOption> files);

/// Keeps the input when --in-place is about to replace it: as FILE.bak, or as FILE.bak.2 when that is there.
class Backup {
 public:
  explicit Backup(const Flags& flags);
  /// There is no backup of what was not replaced.
  ~Backup();
  Backup(const Backup&) = delete;
  void keep() { path_.clear(); }
  /// False when one is needed and there can be none, which was printed.
  bool good() const { return good_; }

 private:
  std::string path_;
  bool good_ = true;
};

}  // namespace wrlkit
