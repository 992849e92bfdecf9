// Files that options of passes name (Resources::add_named), written as all outputs are: whole or not at all.
#pragma once
#include <vector>

#include "base/io/output.h"
#include "scenegraph/resources.h"

namespace wrlkit {

class NamedFiles {
 public:
  /// Takes them.
  NamedFiles(Resources& resources, Diagnostics& diag) : resources_(resources), diag_(diag) {}

  /// Into temporary files. False, and a message, when one cannot be written, or would replace what the scene was read
  /// from.
  bool write();
  /// Puts them into their places.
  bool commit();

 private:
  Resources& resources_;
  Diagnostics& diag_;
  std::vector<OutputFile> files_;
};

/// Both, for callers that write nothing else.
bool write_named_files(Resources&, Diagnostics&);

}  // namespace wrlkit
