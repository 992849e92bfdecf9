// glTF by tinygltf and by wrlkit, each row in a process of its own: CPU seconds of one run, and peak memory above what
// the process had before it.
//   tinygltf_bench FILE.glb [RUNS]
//
//   load tinygltf    bytes to a tinygltf::Model; pictures are not decoded
//   load wrlkit      bytes to a scene, with its meshes as nodes
//   write tinygltf   that model to bytes
//   write wrlkit     that scene to bytes, with all passes: faces, normals, equal geometry found
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "base/parallel.h"
#include "bench/process_cost.h"
#include "convert/wrlkit.h"

namespace {

using namespace wrlkit;

bool keep_bytes(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                void*) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

tinygltf::Model model_of(const std::string& glb) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_bytes, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto* bytes = reinterpret_cast<const unsigned char*>(glb.data());
  if (!loader.LoadBinaryFromMemory(&model, &error, &warning, bytes, static_cast<unsigned>(glb.size()))) {
    std::fprintf(stderr, "tinygltf: %s\n", error.c_str());
    std::exit(1);
  }
  return model;
}

/// `prepare` is not measured; it gives the work that is.
void row(const char* name, int runs, const std::function<std::function<void()>()>& prepare) {
  std::fflush(stdout);
  if (const pid_t child = fork()) {
    waitpid(child, nullptr, 0);
    return;
  }
  const auto work = prepare();
  const double peak = peak_megabytes(), begin = cpu_seconds();
  for (int i = 0; i < runs; ++i) work();
  std::printf("%-15s cpu=%.4f peak=%.1f MB\n", name, (cpu_seconds() - begin) / runs, peak_megabytes() - peak);
  std::fflush(stdout);
  _exit(0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "see the head of tinygltf_bench.cpp\n");
    return 2;
  }
  const ThreadLimit one(1);
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  std::ifstream in(argv[1], std::ios::binary);
  const std::string glb{std::istreambuf_iterator<char>(in), {}};
  std::size_t n_bytes = 0;
  row("load tinygltf", runs, [&] { return [&] { n_bytes += model_of(glb).meshes.size(); }; });
  row("load wrlkit", runs, [&] { return [&] { n_bytes += load_bytes(glb, "bench.glb").scene().node_count(); }; });
  row("write tinygltf", runs, [&] {
    return [&, model = std::make_shared<tinygltf::Model>(model_of(glb))] {
      std::ostringstream out;
      tinygltf::TinyGLTF writer;
      writer.WriteGltfSceneToStream(model.get(), out, false, true);
      n_bytes += out.str().size();
    };
  });
  row("write wrlkit", runs, [&] {
    return [&, document = std::make_shared<Document>(load_bytes(glb, "bench.glb"))] {
      save(
          *document, [&](std::string_view piece) { n_bytes += piece.size(); }, ".glb");
    };
  });
}
