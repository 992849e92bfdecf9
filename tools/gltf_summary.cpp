#include "tools/gltf_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/text/json.h"

namespace wrlkit {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

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

}  // namespace

std::string summary_text(const GltfSummary& s) {
  std::string out;
  size_line(out, "JSON", s.json, s.json_gzip, s.json_shares);
  size_line(out, "geometry", s.geometry, s.geometry_gzip, s.geometry_shares);
  if (s.pictures > 0) size_line(out, "textures", s.pictures, s.pictures_gzip);
  size_line(out, "together", s.bytes(), s.json_gzip + s.geometry_gzip + s.pictures_gzip);
  const auto of = [](std::uint64_t n, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", grouped(n), n == 1 ? one : many);
  };
  out += fmt::format("  {}, {}; {}, {}, {}\n", of(s.nodes, "node", "nodes"), of(s.named, "name", "names"),
                     of(s.meshes, "mesh", "meshes"), of(s.draws, "draw", "draws"),
                     of(s.triangles, "triangle", "triangles"));
  if (s.instances > 0) out += fmt::format("  {} instances in tables (EXT_mesh_gpu_instancing)\n", grouped(s.instances));
  if (const auto& r = s.recoding; r.pictures > 0) {
    out += fmt::format("  pictures: {} re-encoded, {} of them resized; {} bytes became {}", grouped(r.pictures),
                       grouped(r.resized), grouped(r.before), grouped(r.after));
    out += r.psnr > 0 ? fmt::format(", PSNR at least {:.1f} dB\n", r.psnr) : "\n";
  }
  const auto& q = s.quantization;
  if (q.tolerance <= 0) return out;
  out += fmt::format("  quantised: positions within {:.3g} mm (asked for: {:.3g} mm), places of nodes within {:.2g} mm",
                     (q.position + q.rounding) * 1e3, q.tolerance * 1e3, q.placement * 1e3);
  if (q.normal > 0) out += fmt::format(", normals {:.2g} degrees", q.normal * degrees);
  if (q.texcoord > 0) out += fmt::format(", texture coordinates {:.2g}", q.texcoord);
  if (q.color > 0) out += fmt::format(", colours {:.2g}", q.color);
  out += '\n';
  return out;
}

std::string summary_json(const GltfSummary& s) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("nodes", s.nodes, "named", s.named, "meshes", s.meshes, "draws", s.draws, "triangles", s.triangles);
      if (s.instances > 0) json.member("instances", s.instances);
      auto sizes = [&](std::string_view name, std::uint64_t text, std::uint64_t geometry, std::uint64_t pictures) {
        json.member(name, json_object("json", text, "geometry", geometry, "textures", pictures));
      };
      sizes("bytes", s.json, s.geometry, s.pictures);
      if (s.json_gzip > 0) sizes("gzip", s.json_gzip, s.geometry_gzip, s.pictures_gzip);
      if (const auto& r = s.recoding; r.pictures > 0) {
        json.object("pictures", [&] {
          json.members("reencoded", r.pictures, "resized", r.resized, "bytes_before", r.before, "bytes_after", r.after);
          if (r.psnr > 0) json.member("psnr", r.psnr);
        });
      }
      auto kinds = [&](std::string_view name, const std::vector<GltfSummary::Share>& shares) {
        json.member(name, shares);
      };
      kinds("json_bytes", s.json_shares);
      kinds("geometry_bytes", s.geometry_shares);
      const auto& q = s.quantization;
      if (q.tolerance > 0)
        json.member("quantization", json_object("tolerance", q.tolerance, "position", q.position + q.rounding,
                                                "placement", q.placement, "normal_degrees", q.normal * degrees,
                                                "texcoord", q.texcoord, "color", q.color, "kept_as_floats", q.kept));
    });
  });
}

}  // namespace wrlkit
