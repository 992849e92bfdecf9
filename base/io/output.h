// Files are written whole or not at all: into a file without a name in the folder of the target, which takes the
// target's place when everything is written. Standard output is held back the same way. Devices and pipes are written
// directly.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "base/io/files_read.h"
#include "base/io/files_written.h"
#include "base/io/sink.h"

namespace wrlkit {

struct OutputOptions {
  bool gzip = false;                  // RFC 1952; without time and name, so that the same bytes give the same file
  const FilesRead* inputs = nullptr;  // a file of these is not replaced; they must outlive the output
  FilesWritten* written = nullptr;    // where it is noted; must outlive the output, too
  bool report_replaced = false;       // a file of other contents that is replaced: for names that nobody has chosen
};

class OutputFile {
 public:
  /// Begins to write `path`; "-" is standard output. Folders that are not there are made. Null when nothing can be
  /// written there, which is reported.
  static std::optional<OutputFile> open(const std::string& path, OutputOptions, Diagnostics&);

  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  /// What was not committed is gone.
  ~OutputFile();

  /// Pieces one after another, without copying the large ones. After a failure nothing more is written; commit tells.
  void write(std::span<const std::string_view> pieces);
  void write(std::string_view piece) { write({&piece, 1}); }
  /// Whether bytes can be written over: not what is packed, nor on a device or pipe.
  bool can_rewrite() const;
  /// Writes over bytes that were written, for heads with sizes of what follows.
  void rewrite(std::uint64_t at, std::string_view bytes);
  Sink sink() {
    return [this](std::string_view s) { write(s); };
  }

  /// Puts the file into its place, with the permissions of the file that was there. False, and a message, when that or
  /// one of the writes has failed; what was there before is untouched then.
  bool commit(Diagnostics&);

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State>);
  std::unique_ptr<State> state_;
};

}  // namespace wrlkit
