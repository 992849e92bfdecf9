#include "tools/vrml_file.h"

#include "writers/made_files.h"
#include "writers/output.h"
#include "writers/vrml.h"

namespace wrlkit {

bool write_vrml_file(Session& s, const Scene& scene, const std::string& path, bool gzip) {
  auto file = OutputFile::open(path, {.gzip = gzip}, s.diag());
  if (!file) return false;
  MadeFiles made(scene, s.resources(), path, s.diag());
  const auto place = [&](std::string_view url) { return made.place(url); };
  write_vrml(scene, {.precision = s.flags().precision, .own_fields = s.flags().dump, .file = path == "-" ? "" : path, .place = place}, file->sink(), s.diag());
  return made.write() && made.commit() && file->commit(s.diag());
}

}  // namespace wrlkit
