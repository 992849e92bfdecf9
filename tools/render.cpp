// wrlkit render: a picture of a world.
#include <fmt/format.h>

#include "scenegraph/image.h"
#include "tools/render_options.h"
#include "tools/session.h"
#include "writers/output.h"

namespace wrlkit {
namespace {

bool write_picture(Session& s, const Image& picture) {
  const auto& name = s.flags().output;
  std::string why;
  auto bytes = encode_as(name == "-" ? ".png" : name, picture, why);
  if (!bytes) return s.diag().report(Diag::cannot_write, {}, name, why), false;
  auto file = OutputFile::open(name, {}, s.diag());
  if (!file) return false;
  file->write(*bytes);
  return file->commit(s.diag());
}

}  // namespace

int run_render(const Flags& flags) {
  Session s(flags);
  if (!can_encode_as(flags.output) && flags.output != "-") return fmt::print(stderr, "wrlkit: '{}': pictures are written as .png, .jpg or .webp\n", flags.output), usage;
  if (!s.good() || !s.choose_pipeline("picture")) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (!s.read(flags.inputs[0])) return s.end(false);
  auto meshes = s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
  if (!meshes) return s.end(false);
  auto picture = render(s.world().scene, meshes, render_options(flags), &s.resources(), s.diag());
  if (flags.verbose && flags.mode == "density") fmt::print(stderr, "texels a metre: blue 1, cyan 6, green 32, yellow 181, red {:.0f} and more; grey: no lightmap\n", most_texels_per_metre);
  return s.end(write_picture(s, picture));
}

}  // namespace wrlkit
