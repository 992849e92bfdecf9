#include "tools/gltf_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/text/json.h"
#include "scenegraph/walk.h"
#include "tools/cli/lengths.h"
#include "tools/profiles.h"
#include "writers/made_files.h"

namespace wrlkit {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

GltfCompression::Method method_of(const std::string& name) {
  using enum GltfCompression::Method;
  return name == "meshopt" ? meshopt : name == "draco" ? draco : name == "quantize" ? quantize : none;
}

GltfTextures::Format format_of(const std::string& name) {
  using enum GltfTextures::Format;
  return name == "png" ? png : name == "jpeg" ? jpeg : name == "webp" ? webp : keep;
}

/// 1,234,567.
std::string grouped(std::uint64_t n) {
  std::string s = std::to_string(n);
  for (auto i = static_cast<std::ptrdiff_t>(s.size()) - 3; i > 0; i -= 3) s.insert(static_cast<std::size_t>(i), ",");
  return s;
}

void size_line(std::string& out, std::string_view what, std::uint64_t bytes, std::uint64_t gzip,
               const std::vector<GltfSummary::Share>& shares = {}) {
  out += fmt::format("  {:<10}{:>14} bytes", what, grouped(bytes));
  if (gzip > 0) out += fmt::format("{:>14} gzipped", grouped(gzip));
  std::string kinds;
  for (const auto& [name, n] : shares) kinds += fmt::format("{}{} {}", kinds.empty() ? "  " : ", ", name, grouped(n));
  out += kinds + '\n';
}

struct LightRow {
  std::string_view name;
  GltfOptions::Lightmaps as;
  std::string_view pipeline;
};

/// What --lightmap-as says.
const LightRow* light_of(std::string_view name) {
  using As = GltfOptions::Lightmaps;
  static constexpr LightRow rows[] = {{"base-color", As::base_color, "gltf"},
                                      {"emissive", As::emissive, "gltf-emissive"},
                                      {"occlusion", As::occlusion, "gltf-light"},
                                      {"moz", As::moz, "gltf-light"},
                                      {"extras", As::extras, "gltf-light"}};
  return std::ranges::find(rows, name, &LightRow::name);
}

std::size_t count_geometries(const Scene& scene) {
  return static_cast<std::size_t>(std::ranges::count_if(
      reachable(scene, scene.main), [&](NodeId n) { return scene.type(n).is_a("X3DGeometryNode"); }));
}

/// A glTF without meshes is what some worlds deserve (lights, PROTO libraries), but nobody should find it out later.
void say_why_empty(const Scene& scene, Diagnostics& diag) {
  const auto& roots = scene.main.roots;
  if (diag.count(Diag::unknown_node) > 0)
    diag.report(Diag::nothing_drawn, roots.empty() ? Span{} : scene.where(roots[0]),
                "it has no geometry, but nodes that are not known");
  else if (roots.empty() && scene.proto_count() == 0)
    diag.report(Diag::nothing_drawn, Span{.begin = 0}, "it holds no node");
}

}  // namespace

void apply_profile(Flags& f) {
  const Profile* profile = f.profile.empty() ? nullptr : find_profile(f.profile);
  if (!profile) return;
  auto given = [&](std::string_view name) {
    return std::ranges::any_of(f.given, [&](const auto& g) { return g.first == name; });
  };
  if (!given("compress")) f.compress = profile->compress;
  if (!given("extras")) f.extras = profile->extras;
  if (!given("texture-format")) f.texture_format = profile->texture_format;
  if (!given("names")) f.names = profile->names;
}

std::optional<GltfOptions> gltf_options(const Flags& f) {
  GltfCompression c{.method = method_of(f.compress),
                    .position_bits = f.position_bits,
                    .normal_bits = f.normal_bits,
                    .texcoord_bits = f.texcoord_bits,
                    .color_bits = f.color_bits,
                    .level = f.draco_level};
  if (!f.tolerance.empty()) c.tolerance = length_of(f.tolerance);
  if (!f.tolerance.empty() && !(c.tolerance > 0)) {
    fmt::print(stderr, "wrlkit: --tolerance: '{}' is no length\n", f.tolerance);
    return std::nullopt;
  }
  const bool table = f.names == "table";
  std::string name = f.output;
  std::ranges::transform(name, name.begin(), [](unsigned char ch) { return static_cast<char>(std::tolower(ch)); });
  return GltfOptions{.binary = !name.ends_with(".gltf"),
                     .lightmaps = light_of(f.lightmap_as)->as,
                     .compression = c,
                     .textures = {format_of(f.texture_format), f.texture_quality, f.texture_size},
                     .animation_pointer = f.animation_pointer,
                     .names = table ? GltfOptions::Names::table : GltfOptions::Names::nodes,
                     .gpu_instancing = f.gpu_instancing,
                     .extras = f.extras != "none",
                     .facts_only = table || f.extras != "all"};
}

std::string_view gltf_pipeline(const Flags& f) { return light_of(f.lightmap_as)->pipeline; }

bool write_gltf_file(Session& s, const GltfOptions& options, GltfSummary& summary) {
  Scene& scene = s.world().scene;
  auto meshes = s.pipeline().run_lazily(scene, s.context(), s.pipeline_options());
  if (!meshes) return false;
  const auto n_geometries = count_geometries(scene);
  if (n_geometries == 0) say_why_empty(scene, s.diag());
  s.progress().begin("writing " + s.flags().output, n_geometries, "shapes");
  auto counted = [&](NodeId n) -> const Mesh& {
    s.progress().step();
    return meshes(n);
  };
  MadeFiles beside(scene, s.resources(), s.flags().output,
                   s.diag());  // pictures are glTF's own matter; the rest is here
  GltfOptions measured = options;
  measured.measure_gzip |= s.flags().verbose || s.flags().json;
  if (!beside.write() || !write_gltf(scene, counted, measured, &s.resources(), s.flags().output, s.diag(), &summary) ||
      !beside.commit())
    return false;
  s.fact("gltf", summary_json(summary));
  return true;
}

std::string summary_text(const GltfSummary& s) {
  std::string out;
  size_line(out, "JSON", s.json, s.json_gzip, s.json_shares);
  size_line(out, "geometry", s.geometry, s.geometry_gzip, s.geometry_shares);
  if (s.pictures > 0) size_line(out, "textures", s.pictures, s.pictures_gzip);
  size_line(out, "together", s.bytes(), s.json_gzip + s.geometry_gzip + s.pictures_gzip);
  out += fmt::format("  {} nodes, {} names; {} meshes, {} draws, {} triangles\n", grouped(s.nodes), grouped(s.named),
                     grouped(s.meshes), grouped(s.draws), grouped(s.triangles));
  if (s.instances > 0) out += fmt::format("  {} instances in tables (EXT_mesh_gpu_instancing)\n", grouped(s.instances));
  if (const auto& r = s.recoding; r.pictures > 0) {
    out += fmt::format("  pictures: {} written anew, {} of them at another size; {} bytes became {}",
                       grouped(r.pictures), grouped(r.resized), grouped(r.before), grouped(r.after));
    out += r.psnr > 0 ? fmt::format(", PSNR at least {:.1f} dB\n", r.psnr) : "\n";
  }
  const auto& q = s.quantization;
  if (q.tolerance <= 0) return out;
  out += fmt::format("  quantised: positions within {:.3g} mm (asked for: {:.3g} mm), places of nodes within {:.2g} mm",
                     q.position * 1e3, q.tolerance * 1e3, q.placement * 1e3);
  if (q.normal > 0) out += fmt::format(", normals {:.2g} degrees", q.normal * degrees);
  if (q.texcoord > 0) out += fmt::format(", texture coordinates {:.2g}", q.texcoord);
  if (q.color > 0) out += fmt::format(", colours {:.2g}", q.color);
  out += '\n';
  return out;
}

std::string summary_json(const GltfSummary& s) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.member("nodes", s.nodes);
  json.member("named", s.named);
  json.member("meshes", s.meshes);
  json.member("draws", s.draws);
  json.member("triangles", s.triangles);
  if (s.instances > 0) json.member("instances", s.instances);
  auto sizes = [&](std::string_view name, std::uint64_t text, std::uint64_t geometry, std::uint64_t pictures) {
    json.key(name);
    json.begin_object();
    json.member("json", text);
    json.member("geometry", geometry);
    json.member("textures", pictures);
    json.end_object();
  };
  sizes("bytes", s.json, s.geometry, s.pictures);
  if (s.json_gzip > 0) sizes("gzip", s.json_gzip, s.geometry_gzip, s.pictures_gzip);
  if (const auto& r = s.recoding; r.pictures > 0) {
    json.key("pictures");
    json.begin_object();
    json.member("written_anew", r.pictures);
    json.member("resized", r.resized);
    json.member("bytes_before", r.before);
    json.member("bytes_after", r.after);
    if (r.psnr > 0) json.member("psnr", r.psnr);
    json.end_object();
  }
  auto kinds = [&](std::string_view name, const std::vector<GltfSummary::Share>& shares) {
    json.key(name);
    json.begin_object();
    for (const auto& [kind, n] : shares) json.member(kind, n);
    json.end_object();
  };
  kinds("json_bytes", s.json_shares);
  kinds("geometry_bytes", s.geometry_shares);
  const auto& q = s.quantization;
  if (q.tolerance > 0) {
    json.key("quantization");
    json.begin_object();
    json.member("tolerance", q.tolerance);
    json.member("position", q.position);
    json.member("placement", q.placement);
    json.member("normal_degrees", q.normal * degrees);
    json.member("texcoord", q.texcoord);
    json.member("color", q.color);
    json.member("kept_as_floats", q.kept);
    json.end_object();
  }
  json.end_object();
  return out;
}

}  // namespace wrlkit
