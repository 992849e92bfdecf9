#include "tools/verbs/patches_info.h"

#include <fmt/format.h>

#include "base/math/box.h"
#include "base/text/json.h"
#include "light/render/linear.h"
#include "parsers/patches/patches.h"

namespace wrlkit {
namespace {

using drawing::V3;

struct PatchesInfo {
  Box bounds;
  double area = 0;
  Vec3 radiance{};  // mean over the area
  std::size_t n_back = 0;
};

PatchesInfo measure(const PatchSet& set) {
  PatchesInfo o;
  V3 sum;
  for (const auto& p : set.patches) {
    const V3 a = p.corners[0], b = p.corners[1], c = p.corners[2];
    const double area = 0.5 * length(cross(b - a, c - a));
    for (const auto& v : p.corners) o.bounds.add(v);
    o.area += area;
    o.n_back += p.back;
    sum += area * V3(p.rgb[0], p.rgb[1], p.rgb[2]);
  }
  if (o.area > 0) o.radiance = {sum.x / o.area, sum.y / o.area, sum.z / o.area};
  return o;
}

std::string as_json(const std::string& path, const FileText& file, const PatchSet& set, const PatchesInfo& o) {
  return json_of(json_object("file", path, "format", "patches", "bytes", file.bytes_on_disk, "source", set.source,
                             "method", set.method, "samples", set.samples, "shapes", set.shapes.size(), "triangles",
                             set.triangles.size(), "patches", set.patches.size(), "back", o.n_back, "area", o.area,
                             "radiance", std::span<const double>(o.radiance)));
}

std::string as_text(const std::string& path, const FileText& file, const PatchSet& set, const PatchesInfo& o) {
  std::string out = fmt::format("{}: patches, {} bytes\n", path, file.bytes_on_disk);
  if (!set.source.empty())
    out += fmt::format("  of {}{}{}{}\n", set.source, set.method.empty() ? "" : ", by ", set.method,
                       set.samples ? fmt::format(", {} samples", set.samples) : "");
  out +=
      fmt::format("  shapes {}, triangles {}, patches {}", set.shapes.size(), set.triangles.size(), set.patches.size());
  if (o.n_back) out += fmt::format(", of them {} on back sides", o.n_back);
  const auto& b = o.bounds;
  if (!b.empty())
    out += fmt::format("\n  from {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}", b.low[0], b.low[1], b.low[2], b.high[0],
                       b.high[1], b.high[2]);
  return out + fmt::format("\n  area {:.6g} m2, mean radiance {:.4g} {:.4g} {:.4g}\n", o.area, o.radiance[0],
                           o.radiance[1], o.radiance[2]);
}

}  // namespace

std::optional<std::string> patches_info(Session& s, const FileText& file) {
  const auto set = parse_patches(file, s.diag());
  if (!set) return std::nullopt;
  const auto& path = s.flags().inputs[0];
  const auto measured = measure(*set);
  return s.flags().json ? as_json(path, file, *set, measured) : as_text(path, file, *set, measured);
}

}  // namespace wrlkit
