// Vertices and indices as they are stored: as they are, quantised, or quantised and packed. This is done last, when it
// is known how large the world is and how much every mesh is scaled where it is shown: the grid of a mesh is as fine as
// the tolerance asks for in the world.
#pragma once
#include "writers/gltf/document/document.h"
#include "writers/gltf/gltf.h"
#include "writers/gltf/meshes.h"
#include "writers/gltf/quantize.h"

namespace wrlkit::gltf {

/// Accessors of one mesh.
struct Streams {
  std::uint32_t positions = none, normals = none, colors = none, texcoords = none, lightcoords = none, indices = none,
                features = none;
  std::uint32_t draco = none;  // into Packing::blobs: the values of all of them
  auto operator<=>(const Streams&) const = default;
};

class Packing {
 public:
  Packing(const GltfCompression&, const Store& from, const Meshes&, const Document&);

  const Store& store() const { return *store_; }
  const Streams& streams(std::uint32_t mesh) const { return streams_[mesh]; }
  /// Where an accessor has gone that is of no mesh.
  std::uint32_t of(std::uint32_t accessor) const { return to_.empty() ? accessor : to_[accessor]; }
  /// Null: the positions are metres.
  const Dequantization* dequantization(const MeshRecord& m) const {
    auto at = short_.find(meshes_.geometries()[m.geometry].positions);
    return at == short_.end() ? nullptr : &at->second;
  }
  /// Compressed data of Draco, a mesh each.
  const std::vector<std::string>& blobs() const { return blobs_; }
  bool uses_meshopt() const { return options_.method == GltfCompression::Method::meshopt; }
  /// Are there numbers of kinds that glTF knows by KHR_mesh_quantization only?
  bool uses_quantization() const;
  const GltfSummary::Quantization& quantization() const { return summary_; }
  /// How far, in metres of the world, what is stored may still be moved; 0 or less: no further.
  double tolerance_left() const;
  /// It was moved so far by other numbers of nodes.
  void note_placement(double moved) { summary_.placement += moved; }

 private:
  void note_uses(const Document&);
  void keep_floats(const Geometry&);
  Streams packed(const Streams&);
  Streams copied(const Streams&);
  Streams draco(const Streams&);
  /// Tables of places on grids, so that nothing moves by more than the tolerance; how far it may.
  double pack_places(const Document&, double tolerance);
  void pack_others();
  double step(std::uint32_t positions) const;
  std::vector<std::uint32_t> corners(std::uint32_t indices, std::size_t n_vertices) const;
  template <class Pack>
  std::uint32_t once(std::uint32_t accessor, Pack);
  std::uint32_t copied(std::uint32_t accessor, View);
  std::uint32_t positions(std::uint32_t accessor);
  std::uint32_t normals(std::uint32_t accessor);
  std::uint32_t colors(std::uint32_t accessor);
  std::uint32_t texcoords(std::uint32_t accessor);
  std::uint32_t indices(std::uint32_t accessor);
  std::vector<float> floats(std::uint32_t accessor) const;

  using Method = GltfCompression::Method;

  const GltfCompression options_;
  const Store& from_;
  const Meshes& meshes_;
  Store own_;
  const Store* store_;
  std::vector<Streams> streams_;
  std::vector<std::uint32_t> to_;
  std::vector<double> scale_;  // of accessors of positions: how much larger they are in the world
  std::map<std::uint32_t, std::vector<std::uint32_t>>
      faces_;                                // by accessor of positions: of indices of triangles; none: as they stand
  std::vector<std::uint8_t> lines_, light_;  // accessors of indices that are not triangles; of places in lightmaps
  std::unordered_map<std::uint32_t, Dequantization> short_;  // of accessors of positions
  std::vector<std::string> blobs_;
  std::map<Streams, Streams> by_draco_;
  GltfSummary::Quantization summary_;
};

}  // namespace wrlkit::gltf
