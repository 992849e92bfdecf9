// A file's scene and its meshes behind a pipeline, as the benches of geometry and light take them.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"

namespace wrlkit {

struct LoadedWorld {
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  std::unique_ptr<World> file;
  std::optional<Pipeline> pipeline;
  MeshSource meshes;

  /// Ends the program where the file cannot be read.
  LoadedWorld(const char* path, const char* passes) : file(read_world(path, {}, diag)) {
    if (!file) {
      std::fprintf(stderr, "cannot read %s\n", path);
      std::exit(1);
    }
    std::string why;
    pipeline = Pipeline::parse(passes, why);
    meshes = pipeline->run_lazily(file->scene, ctx);
  }

  template <class F>
  void each_mesh(F&& f) {
    for (std::uint32_t i = 0; i < file->scene.node_count(); ++i)
      if (file->scene.is(NodeId{i}, nodes::X3DGeometryNode)) f(meshes(NodeId{i}));
  }
};

}  // namespace wrlkit
