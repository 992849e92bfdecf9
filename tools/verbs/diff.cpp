// wrlkit diff: how two scenes differ in what they show, and in their names and nodes. The keys of --json are stable.
// The scenes are read one after the other; of the first one only what is compared is kept.
#include "convert/diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/text/json.h"
#include "tools/cli/session.h"

namespace wrlkit {

namespace {

std::array<std::pair<std::string_view, SaidDifference>, 5> behaviour_of(const WorldDifference& d) {
  return {{{"routes", d.routes},
           {"animations", d.animations},
           {"viewpoints", d.viewpoints},
           {"lights", d.lights},
           {"others", d.others}}};
}

std::string difference_json(const WorldDifference& d) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      const std::uint64_t triangles[] = {d.a.geometry.triangles, d.b.geometry.triangles},
                          materials[] = {d.a.materials, d.b.materials};
      json.member("triangles", std::span(triangles));
      json.member("bounds", json_object("max_delta", d.bounds));
      json.member("surface", json_object("rms", d.surface ? d.surface->rms : Box::inf, "max",
                                         d.surface ? d.surface->max : Box::inf, "of_diagonal",
                                         d.surface ? d.of_diagonal : Box::inf));
      json.member("names", json_object("missing", std::span<const std::string_view>(d.missing), "added",
                                       std::span<const std::string_view>(d.added)));
      json.member("materials", std::span(materials));
      json.member("looks", json_object("share", d.looks.share, "gone", std::span<const LookChange>(d.looks.gone),
                                       "made", std::span<const LookChange>(d.looks.made)));
      for (const auto& [name, said] : behaviour_of(d))
        json.member(name, json_object("gone", said.gone, "made", said.made));
    });
  });
}

/// "12" when both are, otherwise "12 -> 7".
std::string change(std::uint64_t a, std::uint64_t b) {
  return a == b ? fmt::format("{}", a) : fmt::format("{} -> {}", a, b);
}

std::string node_changes(const WorldDifference& d) {
  std::set<std::string_view> types;
  for (auto* facts : {&d.a, &d.b})
    for (auto& [type, n] : facts->nodes) types.insert(type);
  std::string out;
  for (auto type : types) {
    auto count = [type](const WorldFacts& f) {
      auto n = f.nodes.find(type);
      return n == f.nodes.end() ? 0 : n->second;
    };
    if (count(d.a) != count(d.b))
      out += fmt::format("{} {} {}", out.empty() ? "" : ",", type, change(count(d.a), count(d.b)));
  }
  return out.empty() ? " the same number of each type" : out;
}

std::string name_list(std::string_view what, const std::vector<std::string_view>& names) {
  constexpr std::size_t most = 10;
  if (names.empty()) return {};
  std::string out = fmt::format("  names {}: {}:", what, names.size());
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) out += fmt::format(" {}", names[i]);
  return out + (names.size() > most ? " ...\n" : "\n");
}

std::string bounds_text(double apart) {
  return std::isinf(apart) ? "one of them has none"
         : apart > 0       ? fmt::format("up to {:.4g} m apart", apart)
                           : "the same";
}

std::string surface_text(const WorldDifference& d) {
  if (!d.surface) return "too large to be measured";
  const Deviation& s = *d.surface;
  if (std::isinf(s.max)) return "one of them has none";
  const double rounding = 1e-12 * diagonal(d.a.geometry.bounds);
  if (s.max <= rounding && s.normal_max == 0) return "the same";
  auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
  return fmt::format(
      "{:.4g} m rms ({:.2g} of the diagonal), {:.4g} m at most, at {:.6g} {:.6g} {:.6g}; normals {:.3g} degrees on "
      "average",
      s.rms, d.of_diagonal, s.max, s.where[0], s.where[1], s.where[2], degrees(s.normal_mean));
}

/// "#cc0000 (40 %), #0000cc (3 %), ...".
std::string look_list(const std::vector<LookChange>& all) {
  constexpr std::size_t most = 3;
  std::string out;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    out += fmt::format("{}{} ({:.3g} %)", i ? ", " : "", text_of(all[i].look), 100 * all[i].share);
  return out + (all.size() > most ? ", ..." : "");
}

std::string looks_text(const LookDifference& d) {
  if (!(d.share > 0)) return "the same";
  std::string out = fmt::format("{:.3g} % of the surface differ", 100 * d.share);
  if (!d.gone.empty()) out += "; less " + look_list(d.gone);
  if (!d.made.empty()) out += "; more " + look_list(d.made);
  return out;
}

std::string behaviour_text(const WorldDifference& d) {
  std::string out;
  for (const auto& [name, said] : behaviour_of(d)) {
    out += fmt::format("{}{} ", out.empty() ? "" : ", ", name);
    out += said ? fmt::format("-{} +{}", said.gone, said.made) : "the same";
  }
  return out;
}

std::string difference_text(const WorldDifference& d, const Flags& flags) {
  const GeometryCensus &a = d.a.geometry, &b = d.b.geometry;
  std::string out = fmt::format("{} -> {}\n", flags.inputs[0], flags.inputs[1]);
  out += fmt::format("  shapes {}, polygons {}, triangles {}, lines {}, points {}\n", change(a.shapes, b.shapes),
                     change(a.polygons, b.polygons), change(a.triangles, b.triangles), change(a.lines, b.lines),
                     change(a.points, b.points));
  out += fmt::format("  materials {}, different names {}\n", change(d.a.materials, d.b.materials),
                     change(d.a.names.size(), d.b.names.size()));
  out += name_list("missing", d.missing) + name_list("added", d.added);
  return out + fmt::format("  nodes:{}\n  bounds: {}\n  surface: {}\n  colours and pictures: {}\n  {}\n",
                           node_changes(d), bounds_text(d.bounds), surface_text(d), looks_text(d.looks),
                           behaviour_text(d));
}

}  // namespace

int run_diff(const Flags& flags) {
  if (flags.inputs[0] == "-" && flags.inputs[1] == "-") {
    fmt::print(stderr, "wrlkit diff: only one of the two can be standard input\n");
    return usage;
  }
  Flags compared = flags;
  compared.load.gltf_in_metres = true;  // what a file in inches became by convert --unit in
  Session s(compared);
  if (!s.good()) return usage;
  const auto facts = [&](const std::string& path) {
    return s.read(path) ? facts_of(std::move(s.document())) : std::nullopt;
  };
  auto a = facts(flags.inputs[0]);
  if (!a) return s.end(false);
  auto b = facts(flags.inputs[1]);
  if (!b) return s.end(false);
  s.progress().begin("comparing", 0, "");
  const WorldDifference d = difference(std::move(*a), std::move(*b));
  s.progress().clear();
  const std::string json = difference_json(d);
  if (flags.json)
    s.print_json(json);
  else
    fmt::print("{}", difference_text(d, flags));
  s.fact("difference", json);
  return s.end(true);
}

}  // namespace wrlkit
