#include "tools/vrml_file.h"

#include "base/io/output.h"
#include "writers/made_files.h"
#include "writers/vrml/vrml.h"
#include "writers/x3d/x3d.h"

namespace wrlkit {
namespace {

template <class Options>
bool write_text_file(Session& s, const Scene& scene, const std::string& path, bool gzip,
                     void (*write)(const Scene&, const Options&, const Sink&, Diagnostics&)) {
  auto file = OutputFile::open(path, {.gzip = gzip}, s.diag());
  if (!file) return false;
  if (path == "-")
    s.progress().clear();
  else
    s.progress().begin("writing " + path, 0, "");
  MadeFiles made(scene, s.resources(), path, s.diag());
  const auto place = [&](std::string_view url) { return made.place(url); };
  write(scene,
        {.precision = s.flags().precision,
         .own_fields = s.flags().dump,
         .file = path == "-" || s.flags().keep_urls ? "" : path,
         .place = place},
        file->sink(), s.diag());
  return made.write() && made.commit() && file->commit(s.diag());
}

}  // namespace

std::string_view vrml_pipeline(const Flags& flags) { return flags.dump || flags.pipeline == "none" ? "none" : "vrml"; }

bool write_vrml_file(Session& s, const Scene& scene, const std::string& path, bool gzip) {
  return write_text_file(s, scene, path, gzip, write_vrml);
}
bool write_x3d_file(Session& s, const Scene& scene, const std::string& path, bool gzip) {
  return write_text_file(s, scene, path, gzip, write_x3d);
}

}  // namespace wrlkit
