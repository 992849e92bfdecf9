// What comes back from other languages: VRML97 -> X3D -> VRML97, VRML97 -> glTF -> VRML97, X3D -> VRML97 -> X3D,
// glTF -> VRML97 -> glTF, VRML 1.0 -> VRML97 -> glTF (and back). Both scenes are walked side by side, and each name,
// sharing, ROUTE and field is equal, within a bound (1e-5 of its size, as single precision and quaternions have it), or
// other. The counts, over corpus/ and tests/gltf and over a part of the found corpus (WRLKIT_SHARED, or ../shared), are
// the tables in docs/conformance.md.
//
//   gltf_roundtrip --check own|found     fails when a table in docs/conformance.md says something else; ends with 77
//   when
//                                        the found corpus is not there
//   gltf_roundtrip --update own|found    writes them there; not when more is lost than before, but with --more-is-lost
//   gltf_roundtrip FOLDER...             counts for the VRML97 worlds below other folders, through glTF
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "parsers/parsers.h"
#include "parsers/resources.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "passes/lower_x3d/lower_x3d.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "scenegraph/walk.h"
#include "tests/roundtrip/worlds.h"
#include "writers/gltf/gltf.h"
#include "writers/vrml/vrml.h"
#include "writers/x3d/x3d.h"

using namespace wrlkit;

namespace {

namespace fs = std::filesystem;

struct Counts {
  std::size_t equal = 0, near = 0, other = 0;
};
using Tally = std::map<std::string, Counts>;

bool near(double a, double b) { return std::abs(a - b) <= 1e-5 * (1 + std::abs(a)); }

bool near_numbers(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), near);
}

bool same_rotation(std::span<const double> a, std::span<const double> b) {
  return near_numbers(rotation_matrix({a[0], a[1], a[2], a[3]}).m, rotation_matrix({b[0], b[1], b[2], b[3]}).m);
}

std::vector<double> unit(std::span<const double> v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// Two scenes, node by node.
class Comparison {
 public:
  Comparison(const Scene& a, const Scene& b, Tally& tally) : a_(a), b_(b), tally_(tally) {}

  void run() {
    nodes(a_.main.roots, b_.main.roots, "roots");
    count("ROUTE", a_.main.routes.size(), b_.main.routes.size());
    count("PROTO", a_.main.protos.size(), b_.main.protos.size());
  }

 private:
  void count(const std::string& what, std::size_t wanted, std::size_t found) {
    auto& c = tally_[what];
    c.equal += std::min(wanted, found);
    c.other += std::max(wanted, found) - std::min(wanted, found);
  }

  void nodes(std::span<const NodeId> x, std::span<const NodeId> y, const std::string& where) {
    if (x.size() != y.size()) {
      tally_[where + ": another number of nodes"].other++;
      return;
    }
    for (std::size_t i = 0; i < x.size(); ++i) node(x[i], y[i], where);
  }

  void node(NodeId x, NodeId y, const std::string& where) {
    if (!x && !y) return;
    if (!x || !y || a_.type(x).name != b_.type(y).name) {
      std::string from(x ? a_.type(x).name : "NULL"), to(y ? b_.type(y).name : "NULL");
      tally_[where + ": " + from + " is " + to].other++;
      return;
    }
    auto [at, is_new] = met_.try_emplace(x.value, y);
    if (!is_new) {
      ++(at->second == y ? tally_["USE"].equal : tally_["USE"].other);
      return;
    }
    ++tally_["nodes"].equal;
    if (!a_.name(x).empty()) name(x, y);
    if (!has_points(a_, x) || !has_points(b_, y)) return fields(x, y);
    if (a_.is(x, nodes::IndexedFaceSet)) return polygons(x, y, "polygons", polygons_of);
    if (a_.is(x, nodes::IndexedLineSet)) return polygons(x, y, "polylines", polylines_of);
    fields(x, y);
  }

  /// Whether the coordinates of a geometry, if it has any, are a Coordinate, not CoordinateDouble or GeoCoordinate.
  static bool has_points(const Scene& s, NodeId geometry) {
    const NodeId coord = s.is(geometry, nodes::IndexedFaceSet)   ? s.get(geometry, nodes::indexed_face_set::coord)
                         : s.is(geometry, nodes::IndexedLineSet) ? s.get(geometry, nodes::indexed_line_set::coord)
                                                                 : NodeId{};
    return !coord || s.is(coord, nodes::Coordinate);
  }

  /// Instances of a prototype have the names of its body; what a ROUTE refers to among them gets a number.
  void name(NodeId x, NodeId y) {
    const auto wanted = a_.name(x), found = b_.name(y);
    if (found == wanted)
      ++tally_["DEF names"].equal;
    else if (found.starts_with(std::string(wanted) + "_"))
      ++tally_["DEF names"].near;
    else
      ++tally_["DEF names of " + std::string(a_.type(x).name)].other;
  }

  void fields(NodeId x, NodeId y) {
    const auto& t = a_.type(x);
    for (std::uint16_t slot = 0; slot < std::min(t.fields.size(), b_.type(y).fields.size()); ++slot) {
      const auto& f = t.fields[slot];
      if (!f.has_value()) continue;
      const Value &v = a_.value(x, slot), &w = b_.value(y, slot);
      const std::string name = std::string(t.name) + "." + std::string(f.name_in(Dialect::vrml97));
      if (info(f.type).element == Element::node)
        nodes(v.node_span(), w.node_span(), name);
      else if (a_.find(x, slot) || b_.find(y, slot))
        value(v, w, name);
    }
  }

  void value(const Value& v, const Value& w, const std::string& name) {
    if (equal_plain(v, w)) {
      ++tally_["fields"].equal;
      return;
    }
    bool close = info(v.type).element == Element::number && v.count == w.count;
    if (close)
      close = v.type == FieldType::SFRotation ? same_rotation(v.number_span(), w.number_span())
                                              : near_numbers(v.number_span(), w.number_span());
    if (!close && name.ends_with(".direction")) close = near_numbers(unit(v.number_span()), unit(w.number_span()));
    // In front of the urls stands where the picture is now: what lies where they lead may be another one.
    if (!close && name.ends_with("Texture.url"))
      close = w.count > v.count && std::ranges::equal(v.text_span(), w.text_span().last(v.count));
    if (close) {
      ++tally_["fields"].near;
      return;
    }
    ++tally_[name].other;
  }

  using Point = std::array<double, 3>;
  /// The polygons of an IndexedFaceSet, each from its least corner on.
  static std::vector<std::vector<Point>> polygons_of(const Scene& s, NodeId n) {
    namespace f = nodes::indexed_face_set;
    NodeId coord = s.get(n, f::coord);
    std::vector<std::vector<Point>> out(1);
    if (!coord) return {};
    auto p = s.get(coord, nodes::coordinate::point);
    for (auto i : s.get(n, f::coordIndex)) {
      const auto k = static_cast<std::size_t>(i) * 3;
      if (i >= 0 && k + 2 < p.size())
        out.back().push_back({p[k], p[k + 1], p[k + 2]});
      else if (i < 0)
        out.emplace_back();
    }
    std::erase_if(out, [](auto& face) { return face.size() < 3; });
    for (auto& face : out) {
      if (!s.get(n, f::ccw)) std::ranges::reverse(face);
      std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    }
    return out;
  }

  static std::vector<std::vector<Point>> polylines_of(const Scene& s, NodeId n) {
    namespace f = nodes::indexed_line_set;
    std::vector<std::vector<Point>> out(1);
    NodeId coord = s.get(n, f::coord);
    if (!coord) return {};
    auto p = s.get(coord, nodes::coordinate::point);
    for (auto i : s.get(n, f::coordIndex)) {
      const auto k = static_cast<std::size_t>(i) * 3;
      if (i >= 0 && k + 2 < p.size())
        out.back().push_back({p[k], p[k + 1], p[k + 2]});
      else if (i < 0)
        out.emplace_back();
    }
    std::erase_if(out, [](auto& line) { return line.size() < 2; });
    return out;
  }

  template <class Read>
  void polygons(NodeId x, NodeId y, const char* what, Read read) {
    auto p = read(a_, x), q = read(b_, y);
    auto& c = tally_[what];
    auto close = [](const auto& f, const auto& g) {
      bool all = f.size() == g.size();
      for (std::size_t k = 0; all && k < f.size(); ++k) all = near_numbers(f[k], g[k]);
      return all;
    };
    // Faces without area are dropped on the way: what follows is looked for a little further on.
    constexpr std::size_t further = 8;
    std::size_t at = 0;
    for (const auto& face : p) {
      std::size_t i = at;
      while (i < std::min(q.size(), at + further) && !close(face, q[i])) ++i;
      if (i == std::min(q.size(), at + further)) {
        ++c.other;
        continue;
      }
      ++(face == q[i] ? c.equal : c.near);
      at = i + 1;
    }
  }

  const Scene &a_, &b_;
  Tally& tally_;
  std::map<std::uint32_t, NodeId> met_;
};

std::unique_ptr<World> read(const fs::path& path) {
  Diagnostics diag;
  return read_world(path.string(), {}, diag);
}

/// Writes a world as .glb with the standard pipeline; the scene stays as it was before its meshes were made.
bool write_glb(World& world, const fs::path& from, const fs::path& to) {
  Diagnostics diag(world.scene.sources);
  Statistics stats;
  auto parse = [](const std::string& path, Diagnostics& d) {
    auto w = read_world(path, {}, d);
    return w ? std::make_shared<const Scene>(std::move(w->scene)) : nullptr;
  };
  FileResources resources({.input = from.string()}, parse);
  PassContext context{diag, stats, &resources};
  std::string why;
  auto pipeline = Pipeline::parse("gltf", why);
  auto meshes = pipeline->run_lazily(world.scene, context);
  return meshes && write_gltf(world.scene, meshes, {}, &resources, to.string(), diag);
}

fs::path temporary(const char* name) {
  return fs::temp_directory_path() / (std::string(name) + std::to_string(::getpid()));
}

std::unique_ptr<World> again(const Scene& scene, const char* name, void (*write)(const Scene&, std::string&)) {
  Diagnostics diag;
  std::string text;
  write(scene, text);
  return parse_world(text, name, {}, diag);
}

void as_vrml(const Scene& scene, std::string& text) {
  Diagnostics diag(scene.sources);
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
}

void as_x3d(const Scene& scene, std::string& text) {
  Diagnostics diag(scene.sources);
  write_x3d(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
}

/// The scene in the nodes of VRML97.
Scene lowered(Scene scene) {
  Diagnostics diag(scene.sources);
  Statistics stats;
  PassContext context{diag, stats};
  lower_vrml1(scene, {}, context);
  lower_x3d(scene, {.vrml97 = true}, context);
  return scene;
}

/// A world as .glb and back, against the world as it is brought to glTF.
void compare_with_glb(World& world, const fs::path& path, Tally& tally) {
  const auto glb = temporary("through.glb");
  if (write_glb(world, path, glb)) {
    if (auto back = read(glb))
      Comparison(world.scene, back->scene, tally).run();
    else
      ++tally["not read"].other;
  }
  fs::remove(glb);
}

bool through_gltf(const fs::path& path, Tally& tally) {
  auto world = read(path);
  if (!world || world->format != Format::vrml97) return false;
  compare_with_glb(*world, path, tally);
  return true;
}

bool through_x3d(const fs::path& path, Tally& tally) {
  auto world = read(path);
  if (!world || world->format != Format::vrml97) return false;
  if (auto back = again(world->scene, "through.x3d", as_x3d))
    Comparison(lowered(world->scene), lowered(back->scene), tally).run();
  else
    ++tally["not read"].other;
  return true;
}

bool x3d_through_vrml(const fs::path& path, Tally& tally) {
  auto world = read(path);
  if (!world || (world->format != Format::x3d_xml && world->format != Format::x3d_classic)) return false;
  auto vrml = again(lowered(world->scene), "through.wrl", as_vrml);
  auto back = vrml ? again(vrml->scene, "back.x3d", as_x3d) : nullptr;
  if (back)
    Comparison(world->scene, back->scene, tally).run();
  else
    ++tally["not read"].other;
  return true;
}

bool gltf_through_vrml(const fs::path& path, Tally& tally) {
  auto world = read(path);
  if (!world || world->format != Format::gltf) return false;
  if (auto vrml = again(world->scene, (path.string() + ".wrl").c_str(), as_vrml)) compare_with_glb(*vrml, path, tally);
  return true;
}

bool vrml1_through_vrml(const fs::path& path, Tally& tally) {
  auto world = read(path);
  if (!world || world->format != Format::vrml1) return false;
  if (auto vrml = again(lowered(world->scene), (path.string() + ".wrl").c_str(), as_vrml))
    compare_with_glb(*vrml, path, tally);
  return true;
}

using Run = bool (*)(const fs::path&, Tally&);

/// Of the files one in `every`; of very large ones none, where not all are asked for.
std::string table(const std::string& title, const fs::path& folder, Run run, std::size_t every = 1) {
  constexpr std::uintmax_t large = 200'000;
  Tally tally;
  std::size_t worlds = 0, n = 0;
  for (const auto& path : files_below(folder))
    if (n++ % every == 0 && (every == 1 || fs::file_size(path) < large)) worlds += run(path, tally);
  std::ostringstream out;
  out << title << ", " << worlds << " files:\n\n| what | equal | within the bound | other |\n|---|---|---|---|\n";
  for (const auto& [what, c] : tally)
    out << "| " << what << " | " << c.equal << " | " << c.near << " | " << c.other << " |\n";
  return out.str() + "\n";
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The last column of each row of tables, by the table's title and the row's name: how often something comes back
/// otherwise.
std::map<std::string, long> losses_of(const std::string& tables) {
  std::map<std::string, long> losses;
  std::istringstream in(tables);
  std::string title;
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with(" files:")) title = line.substr(0, line.rfind(','));
    if (!line.starts_with("| ") || line.starts_with("| what")) continue;
    const auto last = line.rfind('|', line.size() - 2);
    losses[title + ": " + line.substr(2, line.find(" |") - 2)] = std::stol(line.substr(last + 1));
  }
  return losses;
}

/// Whether something comes back otherwise more often than before; says what.
bool more_is_lost(const std::string& before, const std::string& after) {
  bool more = false;
  auto old = losses_of(before);
  for (const auto& [what, n] : losses_of(after)) {
    if (n <= old[what]) continue;
    std::printf("%s: %ld come back otherwise, %ld did before\n", what.c_str(), n, old[what]);
    more = true;
  }
  return more;
}

/// Where a table is in docs/conformance.md; nothing: it has no place there.
std::optional<std::pair<std::size_t, std::size_t>> place_of(const std::string& text, const std::string& mark) {
  const std::string begin = "<!-- made by tests/roundtrip/" + mark + " -->\n", end = "<!-- end -->";
  const auto from = text.find(begin), to = text.find(end, from);
  if (from == text.npos || to == text.npos) return std::nullopt;
  return std::pair(from + begin.size(), to - from - begin.size());
}

struct Row {
  const char* title;
  const char *folder, *found;
  Run run;
};
constexpr Row rows[] = {{"VRML97 -> X3D -> VRML97", "corpus", "", through_x3d},
                        {"VRML97 -> glTF -> VRML97", "corpus", "", through_gltf},
                        {"X3D -> VRML97 -> X3D", "corpus", "x3d", x3d_through_vrml},
                        {"glTF -> VRML97 -> glTF", "tests/gltf", nullptr, gltf_through_vrml},
                        {"VRML 1.0 -> VRML97 -> glTF", "corpus", "vrml1", vrml1_through_vrml}};

std::string own_tables() {
  std::string text;
  for (const Row& r : rows)
    text += table(r.title + std::string(", ") + r.folder + "/", fs::path(WRLKIT_SOURCE_DIR) / r.folder, r.run);
  return text;
}

std::string found_tables() {
  std::string text;
  for (const Row& r : rows)
    if (r.found) text += table(r.title + std::string(", one of ten found files"), found_corpus() / r.found, r.run, 10);
  return text;
}

struct Command {
  bool update = false, found = false, more_is_lost = false;
};

int check_page(const Command& command) {
  if (command.found && !fs::exists(found_corpus() / "MANIFEST.tsv")) {
    std::printf("skipped: there is no %s\n", found_corpus().c_str());
    return skipped;
  }
  const fs::path page = fs::path(WRLKIT_SOURCE_DIR) / "docs/conformance.md";
  auto text = text_of(page);
  const auto place = place_of(text, command.found ? "gltf_roundtrip, found corpus" : "gltf_roundtrip");
  if (!place) {
    std::puts("docs/conformance.md has no place for the tables");
    return 1;
  }
  const auto before = text.substr(place->first, place->second);
  const auto made = command.found ? found_tables() : own_tables();
  if (before == made) return 0;
  const bool more = more_is_lost(before, made);
  if (!command.update) {
    std::printf("docs/conformance.md says otherwise than this; gltf_roundtrip --update writes it there\n%s",
                made.c_str());
    return 1;
  }
  if (more && !command.more_is_lost) return 1;
  text.replace(place->first, place->second, made);
  std::ofstream(page) << text;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
  if (has("--check") || has("--update"))
    return check_page({.update = has("--update"), .found = has("found"), .more_is_lost = has("--more-is-lost")});
  for (const auto& folder : words) std::fputs(table("VRML97 -> glTF -> VRML97", folder, through_gltf).c_str(), stdout);
  return words.empty();
}
