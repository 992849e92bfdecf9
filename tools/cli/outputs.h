// What a command may write, checked before any work.
#pragma once
#include <string_view>

#include "tools/cli/flags.h"

namespace wrlkit {

/// False, which was printed, when an output of the command is a file that it reads, or its name ends in none of the
/// verb's `endings` (".xml .xml.gz"; empty: any). With Flags::load.in_place the output may be the input.
bool check_outputs(const Flags& flags, std::string_view endings);

/// Keeps the input when it is about to be replaced: as FILE.bak, or as FILE.bak.2 when that is there.
class Backup {
 public:
  explicit Backup(const Flags& flags);
  /// There is no backup of what was not replaced.
  ~Backup();
  Backup(const Backup&) = delete;
  void keep() { path_.clear(); }
  /// Why there can be none; empty when there is one, or none is needed.
  const std::string& why_not() const { return why_not_; }

 private:
  std::string path_, why_not_;
};

}  // namespace wrlkit
