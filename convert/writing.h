// What the writers of the table of formats get. For those who add a format.
#pragma once
#include "convert/formats.h"
#include "convert/save.h"
#include "geometry/mesh.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit {

struct Writing {
  const Scene& scene;
  const MeshSource& meshes;  // null except for formats that ask for them
  PassContext& context;
  const SaveOptions& options;
  const Output& to;
  const Sink* sink = nullptr;   // in place of the file `to`, which is then only a name
  Saved& saved;                 // what there is to tell
  MeshMakers makers = nullptr;  // of the same meshes, for other threads
};

bool write_gltf_file(const Writing&);
bool write_vrml_file(const Writing&);
bool write_x3d_file(const Writing&);

}  // namespace wrlkit
