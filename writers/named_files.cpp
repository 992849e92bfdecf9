#include "writers/named_files.h"

#include <algorithm>

namespace wrlkit {

bool NamedFiles::write() {
  for (const NamedFile& file : resources_.take_named()) {
    auto out = OutputFile::open(file.path, {.inputs = &resources_.files_read(), .written = &resources_.files_written()},
                                diag_);
    if (!out) return false;
    out->write(file.bytes);
    files_.push_back(std::move(*out));
  }
  return true;
}

bool NamedFiles::commit() {
  return std::ranges::all_of(files_, [&](OutputFile& f) { return f.commit(diag_); });
}

bool write_named_files(Resources& resources, Diagnostics& diag) {
  NamedFiles files(resources, diag);
  return files.write() && files.commit();
}

}  // namespace wrlkit
