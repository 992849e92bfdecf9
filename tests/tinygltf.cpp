// tinygltf as a second judge of the glTF that is written, and as a neighbour (convert/tinygltf/tinygltf.h).
//   tinygltf_tests judge FOLDER MADE [N]   every .glb below MADE (tests/convert_worlds.py), and every N-th world below
//                                          FOLDER, converted in other ways: tinygltf loads it without a word
//   tinygltf_tests road FOLDER [N]         every N-th world becomes a tinygltf::Model and comes back as it does by way
//                                          of a file
// The exit code is 77 when there is no such folder.
#include <tiny_gltf.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "convert/tinygltf/tinygltf.h"
#include "parsers/resources.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/equal.h"
#include "tests/tinygltf_verdict.h"

namespace {

namespace fs = std::filesystem;
using namespace wrlkit;

/// Resources of a world; what one conversion makes, the next does not see.
FileResources resources_of(const std::string& path) {
  auto parse = [](const std::string& file, Diagnostics& diag) -> std::shared_ptr<const Scene> {
    std::shared_ptr<World> world = read_world(file, {}, diag);
    return world ? std::shared_ptr<const Scene>(world, &world->scene) : nullptr;
  };
  return {ResourceOptions{.input = path}, parse};
}

std::string glb_of(const std::string& path, const World& world, const char* front, const GltfOptions& options,
                   std::shared_ptr<Sources> sources) {
  Diagnostics diag(std::move(sources));
  Statistics stats;
  auto resources = resources_of(path);
  Scene scene = world.scene;
  PassContext context{diag, stats, &resources};
  std::string why, bytes;
  auto pipeline = Pipeline::parse(front, why);
  pipeline->complete("gltf");
  const auto meshes = pipeline->run_lazily(scene, context);
  const bool good = meshes && write_glb(
                                  scene, meshes, options, &resources, [&](std::string_view b) { bytes += b; }, diag);
  return good ? bytes : std::string();
}

struct Way {
  const char *name, *front = "";
  GltfOptions options = {};
};

/// Not packed: tinygltf 2.7 refuses buffers without bytes (EXT_meshopt_compression), and this build of it knows no
/// Draco. Nor KHR_animation_pointer, whose channels have no node.
std::vector<Way> ways() {
  std::vector<Way> all{{"quantize"}, {"table"}};
  all[0].options.compression.method = GltfCompression::Method::quantize;
  all[1].front = "dedup,instance";
  all[1].options.names = GltfOptions::Names::table;
  all[1].options.facts_only = true;
  all[1].options.gpu_instancing = true;
  return all;
}

std::string judge(const std::string& path, const World& world, const std::shared_ptr<Sources>& sources) {
  for (const Way& way : ways()) {
    const auto glb = glb_of(path, world, way.front, way.options, sources);
    if (glb.empty()) continue;  // nothing to be seen in this world
    if (const auto said = tinygltf_verdict(glb); !said.empty()) return std::string(way.name) + ": " + said;
  }
  return {};
}

std::string road(const std::string& path, const World& world, const std::shared_ptr<Sources>& sources) {
  const auto glb = glb_of(path, world, "", {}, sources);
  if (glb.empty()) return {};
  Diagnostics of_file, of_world(sources), of_model;
  auto resources = resources_of(path);
  const auto by_file = parse_world(glb, "by file", {}, of_file);
  const auto model = to_tinygltf(world.scene, {}, &resources, of_world);
  if (!model) return "there is no model";
  const auto by_model = from_tinygltf(*model, {}, of_model);
  if (!by_file || !by_model) return by_file || by_model ? "only one of both ways leads back" : "";
  return difference(by_file->scene, by_model->scene);
}

std::vector<std::string> files_in(const char* folder, std::initializer_list<const char*> endings) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    for (const char* ending : endings)
      if (entry.is_regular_file() && entry.path().string().ends_with(ending)) paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  return paths;
}

struct Count {
  std::size_t n_files = 0, n_faults = 0;

  void add(const std::string& path, const std::string& fault) {
    ++n_files;
    if (fault.empty()) return;
    ++n_faults;
    std::printf("%s: %s\n", path.c_str(), fault.c_str());
  }
};

void judge_made(const char* folder, Count& count) {
  for (const auto& path : files_in(folder, {".glb"})) {
    std::ifstream in(path, std::ios::binary);
    count.add(path, tinygltf_verdict({std::istreambuf_iterator<char>(in), {}}));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool judging = argc >= 4 && !std::strcmp(argv[1], "judge");
  const int n_folders = judging ? 2 : 1;
  if (argc < 2 + n_folders) return 2;
  const std::size_t every = argc > 2 + n_folders ? std::stoul(argv[2 + n_folders]) : 1;
  for (int i = 2; i < 2 + n_folders; ++i) {
    if (fs::is_directory(argv[i])) continue;
    std::printf("skipped: there is no folder %s\n", argv[i]);
    return 77;
  }
  Count made, worlds;
  if (judging) judge_made(argv[3], made);
  const auto paths = files_in(argv[2], {".wrl", ".wrz", ".x3d", ".x3dv", ".iv", ".wrl.gz", ".glb", ".gltf"});
  for (std::size_t i = 0; i < paths.size(); i += every) {
    const std::string& path = paths[i];
    Diagnostics diag;
    const auto world = read_world(path, {}, diag);
    if (world) worlds.add(path, (judging ? judge : road)(path, *world, diag.shared_sources()));
  }
  std::printf("%zu files and %zu worlds, %zu faults\n", made.n_files, worlds.n_files, made.n_faults + worlds.n_faults);
  return made.n_faults + worlds.n_faults > 0 || worlds.n_files == 0 || (judging && made.n_files == 0);
}
