// wrlkit render: a picture of a world; of a world from all sides; of two worlds and how they differ; of many worlds.
#include <fmt/format.h>

#include <filesystem>

#include "tools/render_sheets.h"
#include "writers/output.h"

namespace wrlkit {

MeshSource open_world(Session& s, const std::string& input) {
  if (!s.read(input)) return {};
  return s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
}

Image draw(Session& s, const MeshSource& meshes, RenderOptions options, std::string name, Diagnostics* diag) {
  const bool path = options.mode == RenderOptions::Mode::path;
  const auto pixels = static_cast<double>(options.width) * options.height;
  s.progress().begin(std::move(name), path ? static_cast<std::uint64_t>(pixels) : 0, path ? "pixels" : "");
  if (path) options.done = [&](double share) { s.progress().set(static_cast<std::uint64_t>(share * pixels)); };
  return render(s.world().scene, meshes, options, &s.resources(), diag ? *diag : s.diag());
}

bool write_picture(Session& s, const Image& picture, const std::string& name) {
  std::string why;
  auto bytes = encode_as(name == "-" ? ".png" : name, picture, why);
  if (!bytes) return s.diag().report(Diag::cannot_write, {}, name, why), false;
  auto file = OutputFile::open(name, {}, s.diag());
  if (!file) return false;
  file->write(*bytes);
  return file->commit(s.diag());
}

namespace {

bool render_one(Session& s) {
  const auto meshes = open_world(s, s.flags().inputs[0]);
  if (!meshes) return false;
  return write_picture(s, draw(s, meshes, render_options(s.flags()), "picture"), s.flags().output);
}

/// "pump.png", 7: "pump_007.png".
std::string numbered(const std::string& name, int i) {
  const std::filesystem::path path(name);
  return (path.parent_path() / fmt::format("{}_{:03}{}", path.stem().string(), i, path.extension().string())).string();
}

bool render_turntable(Session& s) {
  const auto meshes = open_world(s, s.flags().inputs[0]);
  if (!meshes) return false;
  const Scene& scene = s.world().scene;
  // What is to be said about the world is said with the first picture.
  Diagnostics unheard(s.diag().shared_sources());
  int i = 0;
  for (const auto& options : turntable(scene, meshes, render_options(s.flags()), s.flags().turntable, s.diag())) {
    if (!write_picture(s, draw(s, meshes, options, fmt::format("picture {}", i), i == 0 ? nullptr : &unheard), numbered(s.flags().output, i))) return false;
    ++i;
  }
  return true;
}

bool is_usable(const Flags& f, bool sheet) {
  auto fault = [](std::string_view why) { return fmt::print(stderr, "wrlkit render: {}\n", why), false; };
  if (!can_encode_as(f.output) && f.output != "-") return fmt::print(stderr, "wrlkit: '{}': pictures are written as .png, .jpg or .webp\n", f.output), false;
  if (sheet + !f.compare.empty() + (f.turntable > 0) > 1) return fault("several worlds, --compare or --turntable, one of them");
  if (f.turntable > 0 && f.output == "-") return fault("--turntable: pictures in a series need a name");
  return true;
}

}  // namespace

int run_render(const Flags& flags) {
  Session s(flags);
  const bool sheet = is_sheet(flags);
  if (!is_usable(flags, sheet) || !s.good() || !s.choose_pipeline("picture")) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (sheet) return render_sheet(s);
  const bool made = !flags.compare.empty() ? render_comparison(s) : flags.turntable > 0 ? render_turntable(s) : render_one(s);
  if (made && flags.verbose && flags.mode == "density") fmt::print(stderr, "texels a metre: blue 1, cyan 6, green 32, yellow 181, red {:.0f} and more; grey: no lightmap\n", most_texels_per_metre);
  return s.end(made);
}

}  // namespace wrlkit
