// wrlkit render: a picture of a world.
#include <fmt/format.h>

#include "scenegraph/image.h"
#include "tools/render_options.h"
#include "tools/session.h"
#include "writers/output.h"

namespace wrlkit {
namespace {

bool is_jpeg(std::string_view name) { return name.ends_with(".jpg") || name.ends_with(".jpeg"); }

bool write_picture(Session& s, const Image& picture) {
  const auto& name = s.flags().output;
  constexpr int quality = 92;
  std::string why;
  auto bytes = is_jpeg(name) ? encode_jpeg(picture, quality, why) : encode_png(picture, why);
  if (!bytes) return s.diag().report(Diag::cannot_write, {}, name, why), false;
  auto file = OutputFile::open(name, {}, s.diag());
  if (!file) return false;
  file->write(*bytes);
  return file->commit(s.diag());
}

}  // namespace

int run_render(const Flags& flags) {
  Session s(flags);
  if (!is_jpeg(flags.output) && !flags.output.ends_with(".png") && flags.output != "-") return fmt::print(stderr, "wrlkit: '{}': pictures are written as .png or .jpg\n", flags.output), usage;
  if (!s.good() || !s.choose_pipeline("picture")) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (!s.read(flags.inputs[0])) return s.end(false);
  auto meshes = s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
  if (!meshes) return s.end(false);
  auto picture = render(s.world().scene, meshes, render_options(flags), &s.resources(), s.diag());
  return s.end(write_picture(s, picture));
}

}  // namespace wrlkit
