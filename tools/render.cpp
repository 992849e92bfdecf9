// wrlkit render: a picture of a world.
#include <fmt/format.h>

#include <numbers>

#include "passes/render/render.h"
#include "scenegraph/image.h"
#include "tools/session.h"
#include "writers/output.h"

namespace wrlkit {
namespace {

RenderOptions options_of(const Flags& f) {
  RenderOptions o;
  o.width = f.width;
  o.height = f.height;
  o.samples = f.samples;
  o.mode = f.mode == "wireframe" ? RenderOptions::Mode::wireframe : RenderOptions::Mode::preview;
  o.viewpoint = f.viewpoint;
  o.fit = f.fit;
  o.field_of_view = f.field_of_view * std::numbers::pi / 180;
  if (f.background.size() == 3) o.background = Vec3{f.background[0], f.background[1], f.background[2]};
  if (!f.headlight.empty()) o.headlight = f.headlight == "on";
  if (const auto& l = f.look_at; l.size() == 9) o.look_at = LookAt{{l[0], l[1], l[2]}, {l[3], l[4], l[5]}, {l[6], l[7], l[8]}};
  return o;
}

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
  auto picture = render(s.world().scene, meshes, options_of(flags), &s.resources(), s.diag());
  return s.end(write_picture(s, picture));
}

}  // namespace wrlkit
