// What every pass promises, tried on every world of a corpus:
//
// - it says `unchanged` exactly when the text of the scene is the same;
// - a second run changes nothing, where the registry says so;
// - the invariants of its level hold behind it;
// - one and two threads give the same text and the same files;
// - every count has a name in the registry.
//
//   properties FOLDER [SHARD COUNT]        all worlds, or each COUNT-th from SHARD on
//   properties --random N FOLDER           N random pipelines over small worlds, by a fixed seed
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/task.h"
#include "geometry/geometry.h"
#include "geometry/mesh_check.h"
#include "parsers/parsers.h"
#include "parsers/resources.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;
namespace fs = std::filesystem;

namespace {

constexpr int skipped = 77;
constexpr std::uintmax_t large = 40'000;  // bytes of a file from which on the passes below are left out
constexpr std::string_view costly[] = {"lightmap", "lod", "cull", "combine-lightmap"};

std::size_t n_checks = 0, n_faults = 0;

void require(bool holds, const std::string& world, std::string_view pass, const std::string& what) {
  ++n_checks;
  if (holds || ++n_faults > 40) return;
  std::printf("%s: %s: %s\n", world.c_str(), std::string(pass).c_str(), what.c_str());
}

/// A world with its files.
struct Stage {
  Diagnostics diag;
  Statistics stats;
  FileResources resources;
  PassContext ctx{diag, stats, &resources};

  explicit Stage(const std::string& path)
      : resources({.input = path, .allowed = {"corpus"}}, [](const std::string& inlined, Diagnostics& said) {
          auto world = read_world(inlined, {}, said);
          Statistics uncounted;
          PassContext lowering{said, uncounted};
          if (world) lower_vrml1(world->scene, {}, lowering);
          return world ? std::make_shared<const Scene>(std::move(world->scene)) : nullptr;
        }) {}

  std::string files() const {
    std::string out;
    for (const auto& made : resources.made()) out += made.name + *made.bytes;
    return out;
  }
};

/// With what the head of a file of its own format would say.
std::string text_of(const Scene& scene) {
  Diagnostics unheard;
  std::string text = std::to_string(static_cast<int>(scene.format)) + " " + scene.x3d.profile;
  for (const auto& [name, level] : scene.x3d.components) text += " " + name + std::to_string(level);
  for (const auto& [name, content] : scene.x3d.meta) text += " " + name + "=" + content;
  text += "\n";
  write_vrml(
      scene, {.own_fields = true}, [&](std::string_view s) { text += s; }, unheard);
  return text;
}

std::string first_difference(const std::string& a, const std::string& b) {
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  const auto from = at < 60 ? 0 : at - 60;
  return "'" + a.substr(from, 120) + "' and '" + b.substr(from, 120) + "'";
}

std::string first_message(const Diagnostics& diag) {
  for (const auto& m : diag.messages())
    if (m.id == Diag::verify) return m.text();
  return "nothing was reported";
}

using Options = std::vector<std::pair<std::string, std::string>>;

/// With which a pass has something to do in small worlds.
Options options_of(std::string_view pass) {
  if (pass == "cull") return {{"smaller", "0.05"}, {"hidden", "true"}, {"rays", "8"}};
  if (pass == "merge") return {{"max-draws", "2"}};
  if (pass == "place") return {{"unit", "mm"}, {"up", "z"}};
  if (pass == "lightmap") return {{"quality", "draft"}, {"max-size", "32"}, {"density", "0.1"}};
  if (pass == "instance") return {{"min-saving", "0"}};
  if (pass == "lower-x3d") return {{"vrml97", "true"}};
  return {};
}

std::string text_with_options(std::string_view pass) {
  Pipeline p;
  std::string why;
  p.add(pass, options_of(pass), why);
  return p.text();
}

bool equal(const Mesh& a, const Mesh& b) {
  if (a.kind != b.kind || !std::ranges::equal(a.positions.span(), b.positions.span()) || a.corners != b.corners ||
      a.face_begin != b.face_begin || a.ccw != b.ccw || a.solid != b.solid)
    return false;
  for (std::size_t i = 0; i < a.attributes().size(); ++i)
    if (a.attributes()[i]->values != b.attributes()[i]->values || a.attributes()[i]->index != b.attributes()[i]->index)
      return false;
  return true;
}

class WorldTrial {
 public:
  explicit WorldTrial(const std::string& path) : path_(path) {}

  /// False when there is no scene.
  bool run() {
    Diagnostics diag;
    const auto read = read_world(path_, {}, diag);
    if (!read) return false;
    Stage stage(path_);
    Scene authored = std::move(read->scene);
    if (!verify(authored, Level::authored, diag)) require(false, path_, "reading", first_message(diag));
    Scene expanded = authored;
    std::string why;
    Pipeline::parse("lower-vrml1,expand", why)->run(expanded, stage.ctx);
    const bool is_large = fs::file_size(path_) > large;
    for (const auto& info : passes()) {
      if (is_large && std::ranges::find(costly, info.name) != std::end(costly)) continue;
      const bool lowered = info.needs != Level::authored || info.traits.phase >= Phase::world;
      const auto pass = info.make();
      for (const auto& [option, value] : options_of(info.name))
        require(pass->set(option, value, why), path_, info.name, why);
      try_pass(info, *pass, lowered ? expanded : authored);
    }
    return true;
  }

 private:
  struct Result {
    std::string text, files;
    Outcome outcome;
  };

  /// The pass alone, on the scene or on each of its meshes. Nothing when it fails.
  std::optional<Result> result(const PassInfo& info, const PassInstance& pass, Scene& scene, Stage& stage) {
    Outcome outcome = Outcome::unchanged;
    if (!pass.is_mesh_pass())
      outcome = pass.run(scene, stage.ctx);
    else
      for (NodeId n : all_nodes(scene))
        if (scene.is(n, nodes::X3DGeometryNode)) run_mesh(info, pass, scene, n, stage);
    if (outcome == Outcome::failed) return std::nullopt;
    for (const auto& [name, n] : stage.stats)
      if (name.starts_with(info.name))
        require(std::ranges::find(info.statistics, name, &StatisticInfo::name) != info.statistics.end(), path_,
                info.name, "counts " + name + ", which it does not declare");
    return Result{text_of(scene), stage.files(), outcome};
  }

  void run_mesh(const PassInfo& info, const PassInstance& pass, Scene& scene, NodeId n, Stage& stage) {
    MeshJob job{scene, n, mesh_, scratch_, stage.ctx};
    read_mesh(job);
    const Mesh before = mesh_;
    const auto outcome = pass.run(job);
    const bool same = equal(before, mesh_);
    require(outcome != Outcome::failed && same == (outcome == Outcome::unchanged), path_, info.name,
            same ? "says changed, but the mesh is the same" : "says unchanged, but the mesh is another one");
    require(breach_of(mesh_).empty(), path_, info.name, breach_of(mesh_));
    if (!info.traits.idempotent) return;
    const Mesh once = mesh_;
    require(pass.run(job) == Outcome::unchanged && equal(once, mesh_), path_, info.name, "a second run changes a mesh");
  }

  void try_pass(const PassInfo& info, const PassInstance& pass, const Scene& before) {
    Stage stage(path_), other(path_);
    Scene scene = before, again = before;
    const auto text_before = text_of(before);
    std::optional<Result> one, two;
    {
      ThreadLimit limit(1);
      one = result(info, pass, scene, stage);
    }
    {
      ThreadLimit limit(2);
      two = result(info, pass, again, other);
    }
    require(one && two, path_, info.name, "failed");
    if (!one || !two) return;
    if (pass.is_mesh_pass()) return;
    const bool same = one->text == text_before;
    require(same || one->outcome == Outcome::changed, path_, info.name,
            "says unchanged, but there are " + first_difference(text_before, one->text));
    require(!same || one->outcome == Outcome::unchanged, path_, info.name, "says changed, but the text is the same");
    require(one->text == two->text && one->files == two->files, path_, info.name,
            "other results on two threads: " + first_difference(one->text, two->text));
    check_level(info, scene);
    if (!info.traits.idempotent) return;
    const auto twice = result(info, pass, scene, stage);
    require(twice && twice->outcome == Outcome::unchanged && twice->text == one->text, path_, info.name,
            "a second run changes " + (twice ? first_difference(one->text, twice->text) : "everything"));
  }

  void check_level(const PassInfo& info, const Scene& scene) {
    Diagnostics diag;
    const Level level = info.traits.phase == Phase::gather ? info.leaves : info.needs;
    require(verify(scene, level, diag), path_, info.name, first_message(diag));
  }

  std::string path_;
  Mesh mesh_;
  MeshScratch scratch_;
};

std::vector<std::string> worlds_in(const fs::path& folder) {
  std::vector<std::string> out;
  const std::set<std::string> endings = {".wrl", ".x3d", ".x3dv", ".gltf", ".glb", ".iv"};
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (endings.contains(entry.path().extension().string())) out.push_back(entry.path().string());
  std::ranges::sort(out);
  return out;
}

std::string random_pipeline(std::mt19937& random) {
  std::string text;
  for (auto n = 1 + random() % 5; n > 0; --n) {
    const auto& info = passes()[random() % passes().size()];
    if (info.name == "lightmap") continue;
    text += (text.empty() ? "" : ",") + (random() % 2 ? std::string(info.name) : text_with_options(info.name));
  }
  return text;
}

/// Random passes one after the other: no harm is done, every level holds, the text says all of it.
void try_pipeline(const std::string& path, const std::string& text) {
  std::string why;
  auto pipeline = Pipeline::parse(text, why);
  require(pipeline.has_value(), path, text, why);
  if (!pipeline) return;
  pipeline->meet_needs();
  auto again = Pipeline::parse(pipeline->text(), why);
  require(again && again->text() == pipeline->text(), path, text, "does not read back: " + pipeline->text());
  if (!again) return;
  std::string results[2];
  for (int i = 0; i < 2; ++i) {
    Stage stage(path);
    auto world = read_world(path, {}, stage.diag);
    if (!world) return;
    const bool good = (i ? *again : *pipeline).run(world->scene, stage.ctx, {.verify_each = i == 0});
    require(good, path, text, first_message(stage.diag));
    results[i] = text_of(world->scene) + stage.files();
  }
  require(results[0] == results[1], path, text, "other results: " + first_difference(results[0], results[1]));
}

void try_random(int n, std::vector<std::string> worlds) {
  std::erase_if(worlds, [](const auto& path) { return fs::file_size(path) > 8'000; });
  std::mt19937 random(17);
  for (int i = 0; i < n && !worlds.empty(); ++i) {
    const auto& path = worlds[random() % worlds.size()];
    // As for every writer, what only other standards have is lowered first: no pass makes a mesh of a LineSet.
    const std::string passes = random_pipeline(random);  // maybe none
    try_pipeline(path, "lower-vrml1,expand,lower-x3d" + (passes.empty() ? "" : "," + passes));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool random = argc == 4 && std::string_view(argv[1]) == "--random";
  if (argc < 2) return 2;
  const fs::path folder = argv[random ? 3 : 1];
  if (!fs::exists(folder)) {
    std::printf("skipped: there is no %s\n", folder.c_str());
    return skipped;
  }
  const auto worlds = worlds_in(folder);
  if (random) {
    try_random(std::atoi(argv[2]), worlds);
  } else {
    const std::size_t shard = argc > 3 ? static_cast<std::size_t>(std::atoi(argv[2])) : 0;
    const std::size_t step = argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : 1;
    for (std::size_t i = shard; i < worlds.size(); i += step) WorldTrial(worlds[i]).run();
  }
  std::printf("%zu checks, %zu faults\n", n_checks, n_faults);
  return n_faults || n_checks == 0 ? 1 : 0;
}
