#include "tools/gltf_output.h"

#include <fmt/format.h>

#include <numbers>

#include "tools/lengths.h"
#include "writers/json.h"

namespace wrlkit {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

GltfCompression::Method method_of(const std::string& name) {
  using enum GltfCompression::Method;
  return name == "meshopt" ? meshopt : name == "quantize" ? quantize : none;
}

/// 1,234,567.
std::string grouped(std::uint64_t n) {
  std::string s = std::to_string(n);
  for (auto i = static_cast<std::ptrdiff_t>(s.size()) - 3; i > 0; i -= 3) s.insert(static_cast<std::size_t>(i), ",");
  return s;
}

void size_line(std::string& out, std::string_view what, std::uint64_t bytes, std::uint64_t gzip) {
  out += fmt::format("  {:<10}{:>14} bytes", what, grouped(bytes));
  if (gzip > 0) out += fmt::format("{:>14} gzipped", grouped(gzip));
  out += '\n';
}

}  // namespace

std::optional<GltfCompression> compression_of(const Flags& f) {
  GltfCompression c{.method = method_of(f.compress), .position_bits = f.position_bits, .normal_bits = f.normal_bits, .texcoord_bits = f.texcoord_bits, .color_bits = f.color_bits};
  if (f.tolerance.empty()) return c;
  c.tolerance = length_of(f.tolerance);
  if (!(c.tolerance > 0)) return fmt::print(stderr, "wrlkit: --tolerance: '{}' is no length\n", f.tolerance), std::nullopt;
  return c;
}

std::string summary_text(const GltfSummary& s) {
  std::string out;
  size_line(out, "JSON", s.json, s.json_gzip);
  size_line(out, "geometry", s.geometry, s.geometry_gzip);
  if (s.pictures > 0) size_line(out, "textures", s.pictures, s.pictures_gzip);
  out += fmt::format("  {} nodes, {} of them with a name; {} meshes, {} draws, {} triangles\n", grouped(s.nodes), grouped(s.named), grouped(s.meshes), grouped(s.draws), grouped(s.triangles));
  const auto& q = s.quantization;
  if (q.tolerance > 0)
    out += fmt::format("  quantised: positions within {:.3g} mm (asked for: {:.3g} mm), normals {:.2g} degrees, texture coordinates {:.2g}, colours {:.2g}\n", q.position * 1e3, q.tolerance * 1e3,
                       q.normal * degrees, q.texcoord, q.color);
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
  const auto& q = s.quantization;
  if (q.tolerance > 0) {
    json.key("quantization");
    json.begin_object();
    json.member("tolerance", q.tolerance);
    json.member("position", q.position);
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
