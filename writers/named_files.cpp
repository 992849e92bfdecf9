#include "writers/named_files.h"

#include <algorithm>

namespace wrlkit {

bool NamedFiles::write() {
  for (const NamedFile& file : resources_.take_named()) {
    if (resources_.is_input(file.path)) {
      diag_.report(Diag::cannot_write, {}, file.path, "it is an input");
      return false;
    }
    auto out = OutputFile::open(file.path, {}, diag_);
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
