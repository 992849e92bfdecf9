// wrlkit info: what is inside a scene. The keys of --json are stable.
#include "tools/verbs/info.h"
#include "tools/cli/documents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/io/url.h"
#include "base/text/json.h"
#include "parsers/gltf/stored.h"
#include "parsers/patches/patches.h"
#include "tools/cli/inputs.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/session.h"
#include "tools/verbs/patches_info.h"

namespace wrlkit {
namespace {

void write_bounds(JsonOut& json, const Box& b) {
  json.key("bounds");
  if (b.empty()) return json.raw("null");
  json.object("min", std::span<const double>(b.low), "max", std::span<const double>(b.high));
}

std::uint64_t n_forms(const FormsCensus& f) {
  std::uint64_t out = 0;
  for (auto& [kind, n] : f.parts) out += n;
  return out;
}

/// The share of all triangles.
double share_of_forms(const Info& i) {
  const auto all = static_cast<double>(std::max<std::uint64_t>(i.geometry.triangles, 1));
  return std::clamp(1 - static_cast<double>(i.forms->triangles_left) / all, 0.0, 1.0);
}

void write_forms(JsonOut& json, const Info& i) {
  json.object("forms", [&] {
    json.member("count", n_forms(*i.forms));
    json.member("kinds", i.forms->parts);
    json.members("triangles_left", i.forms->triangles_left, "share", share_of_forms(i), "residual", i.forms->residual);
  });
}

std::string forms_text(const Info& i) {
  if (i.forms->parts.empty()) return "  forms: none\n";
  std::string kinds;
  for (auto& [kind, n] : i.forms->parts) kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", kind, n);
  return fmt::format("  forms {}, {:.1f} % of the triangles, within {:.2g} mm: {}\n", n_forms(*i.forms),
                     100 * share_of_forms(i), 1000 * i.forms->residual, kinds);
}

}  // namespace

std::string info_json(const std::string& file, const Info& i, const Diagnostics& diag) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("file", file, "format", to_string(i.format), "bytes", i.bytes, "gzip", i.gzip);
      json.member("nodes", i.nodes);
      json.members("shapes", i.geometry.shapes, "polygons", i.geometry.polygons, "triangles", i.geometry.triangles,
                   "unique", i.geometry.unique, "lines", i.geometry.lines, "points", i.geometry.points);
      write_bounds(json, i.geometry.bounds);
      json.member("materials", i.materials);
      json.list("textures", i.textures,
                [&](auto& t) { json.object("url", t.url, "found", t.found, "width", t.width, "height", t.height); });
      json.members("lights", i.lights, "viewpoints", i.viewpoints, "lods", i.lods, "levels",
                   std::span<const std::uint64_t>(i.levels), "animations", i.animations, "protos", i.protos, "routes",
                   i.routes, "scripts", i.scripts, "inlines", i.inlines, "names", i.names);
      if (i.forms) write_forms(json, i);
      json.member("diagnostics", json_object("error", diag.count(Severity::error), "warning",
                                             diag.count(Severity::warning), "lost", diag.count(Severity::lost)));
    });
  });
}

namespace {

/// Kilometres are seldom meant.
std::string unit_hint(const Box& b) {
  constexpr double wide = 2000;
  double longest = 0;
  for (std::size_t i = 0; i < 3 && !b.empty(); ++i) longest = std::max(longest, b.high[i] - b.low[i]);
  if (longest < wide) return "";
  return fmt::format("  {:.6g} m is wide: if the unit is another one, say so (--unit mm, --unit in)\n", longest);
}

/// Places of scenes far away from the origin with the digits that tell their sizes.
std::string bounds_text(const Box& b) {
  double farthest = 0, extent = 0;
  for (int i = 0; i < 3; ++i) {
    farthest = std::max({farthest, std::abs(b.low[i]), std::abs(b.high[i])});
    extent = std::max(extent, b.high[i] - b.low[i]);
  }
  constexpr int fewest = 6, most = 15, of_extent = 4;
  const double times = extent > 0 ? std::ceil(std::log10(farthest / extent)) : 0;
  const int digits = std::clamp(of_extent + static_cast<int>(std::clamp(times, 0.0, double{most})), fewest, most);
  const auto place = [digits](const auto& p) {
    return fmt::format("{:.{}g} {:.{}g} {:.{}g}", p[0], digits, p[1], digits, p[2], digits);
  };
  return fmt::format("  from {} to {}: {:.6g} x {:.6g} x {:.6g} m\n", place(b.low), place(b.high), b.high[0] - b.low[0],
                     b.high[1] - b.low[1], b.high[2] - b.low[2]);
}

bool is_inside(std::string_view url) { return url.empty() || url_kind(url) == UrlKind::data; }

std::string info_text(const std::string& file, const Info& i) {
  const auto& b = i.geometry.bounds;
  const auto format = i.is_inventor ? std::string_view("Open Inventor") : to_string(i.format);
  std::string out = fmt::format("{}: {}{}, {} bytes\n", file, format, i.gzip ? " (gzip)" : "", i.bytes);
  const auto& g = i.geometry;
  const auto unique =
      g.unique == g.triangles ? "" : fmt::format(" ({} {})", g.unique, i.format == Format::gltf ? "stored" : "unique");
  out += fmt::format("  shapes {}, polygons {}, triangles {}{}, lines {}, points {}\n", g.shapes, g.polygons,
                     g.triangles, unique, g.lines, g.points);
  if (!b.empty()) out += bounds_text(b);
  out += unit_hint(b);
  out += fmt::format("  materials {}, textures {}, lights {}, viewpoints {}, LODs {}\n", i.materials, i.textures.size(),
                     i.lights, i.viewpoints, i.lods);
  out +=
      fmt::format("  named nodes {}, prototypes {}, routes {}, scripts {}, inlines {}, animations {}{}\n", i.names,
                  i.protos, i.routes, i.scripts, i.inlines, i.animations, i.inlines > 0 ? " (of this file alone)" : "");
  std::vector<std::pair<std::uint64_t, std::string>> types;
  for (auto& [name, n] : i.nodes) types.emplace_back(n, name);
  std::ranges::sort(types,
                    [](auto& a, auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  out += "  nodes:";
  for (auto& [n, name] : types) out += fmt::format(" {} {}", n, name);
  out += "\n";
  if (i.forms) out += forms_text(i);
  for (auto& t : i.textures)
    out += t.found ? fmt::format("  texture {} {} x {}\n", is_inside(t.url) ? "in the file" : t.url, t.width, t.height)
                   : fmt::format("  texture {} is missing\n", t.url);
  return out;
}

/// Of a file that cannot be read.
std::string unreadable_json(const std::string& file, const Diagnostics& diag) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("file", file, "readable", false);
      json.member("messages", JsonText{messages_json(diag)});
    });
  });
}

/// Adds what --json prints to `objects`.
int info_of_one(const Flags& flags, std::vector<std::string>& objects) {
  Session s(flags);
  if (!s.good()) return usage;
  s.be_brief();
  s.leave_json();
  const auto unreadable = [&] {
    objects.push_back(unreadable_json(flags.inputs[0], s.diag()));
    return s.end(false);
  };
  const auto file = read_file(flags.inputs[0], {}, s.diag());
  if (file && is_patch_file(file->view())) {
    const auto text = patches_info(s, *file);
    if (!text) return unreadable();
    objects.push_back(*text);
    if (!flags.json) fmt::print("{}", *text);
    return s.end(true);
  }
  if (!file || !s.document().read(flags.inputs[0], *file)) return unreadable();
  if (s.diag().has_errors() && s.world().scene.node_count() == 0) return unreadable();
  auto made = info(std::move(s.document()), {flags.recognise});
  s.progress().clear();
  if (!made) return unreadable();
  if (made->format == Format::gltf) made->geometry.unique = stored_triangles(file->view());
  objects.push_back(info_json(flags.inputs[0], *made, s.diag()));
  if (!flags.json) fmt::print("{}", info_text(flags.inputs[0], *made));
  return s.end(true);
}

}  // namespace

int run_info(const Flags& flags) {
  std::string why;
  const auto inputs = named_worlds(flags.inputs, why);
  if (!inputs) {
    complain("info", why);
    return nothing;
  }
  const auto& worlds = inputs->worlds;
  std::size_t unreadable = 0;
  std::vector<std::string> objects;
  int worst = print_left_out("info", inputs->left_out, inputs->passed_over);
  for (const auto& world : worlds) {
    Flags one = flags;
    one.inputs = {world.path};
    if (inputs->is_list) one.report.clear();
    const int code = info_of_one(one, objects);
    if (code == usage) return code;
    unreadable += code == nothing;
    worst = std::max(worst, code == nothing ? static_cast<int>(partly) : code);
  }
  const auto json = json_of_scenes(*inputs, objects);
  if (flags.json && !inputs->is_list) print_document(json);
  if (inputs->is_list && !give_document(flags, json)) return nothing;
  return unreadable == worlds.size() ? static_cast<int>(nothing) : worst;
}

}  // namespace wrlkit
