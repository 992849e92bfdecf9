// Primitives of a mesh of glTF as they are read: vertices with their attributes, unpacked and posed. What nodes become
// of them is not known here (meshes.h).
#pragma once
#include <initializer_list>
#include <optional>

#include "parsers/gltf/context.h"
#include "scenegraph/transform.h"

namespace wrlkit::gltf_reader {

/// How many numbers an element of an accessor may have.
constexpr std::initializer_list<std::size_t> three{3}, two{2}, color_widths{3, 4};

/// How a node shows a mesh.
struct Pose {
  std::vector<double> weights;  // of its morph targets; empty: those of the mesh
  std::vector<Matrix> joints;   // of a skin: from the mesh to the node; empty: none
  std::uint32_t skin = none;
  Vec3 origin{0, 0, 0};  // what wrlkit has subtracted from the points
  bool shared() const { return weights.empty() && joints.empty() && origin == Vec3{0, 0, 0}; }
};

/// A CoordinateInterpolator's material: the points of a Coordinate with each target at full weight.
struct Morph {
  NodeId coordinate;
  std::vector<double> base;
  std::vector<std::vector<double>> targets;  // displacements
  std::vector<double> weights;               // as they are shown
};

/// Values of one attribute: of an accessor, read when they are needed, or made here.
struct Stream {
  std::uint32_t accessor = none;
  std::size_t width = 0;
  std::vector<double> values;
  explicit operator bool() const { return accessor != none || !values.empty(); }
};
struct Streams {
  Stream position, normal, color, texcoord, light, feature;  // feature: of Draco only
  std::size_t n = 0;                                         // vertices
  std::vector<std::uint32_t> index;
  std::uint32_t index_accessor = none;
  bool indexed = false, loose = false;  // loose: the values are not those of the accessors
};
/// Names of attributes: places in the picture and in the lightmap.
struct Sets {
  std::string texcoord, light;
};
struct Primitive {
  Json json, mesh;
  std::uint32_t material = none;
  int mode = 4;
  bool faces() const { return mode >= 4; }
};

/// POINTS of glTF's `mode`; those beyond lines are faces.
inline constexpr int points_mode = 0;

class PrimitiveReader {
 public:
  static constexpr std::uint64_t max_posed = 20'000'000;  // vertices of skinned and morphed meshes

  explicit PrimitiveReader(const Context& c) : c_(c) {}

  /// False, and a message, when it cannot be read. In files of others values of accessors are left to the caller.
  bool load(const Primitive&, const Pose&, const Sets&, Streams&);
  /// Triangles, segments or points, as vertices.
  std::vector<std::uint32_t> elements(const Primitive&, Streams&);
  /// The morphs of all that was loaded, one for each primitive with targets.
  std::vector<Morph>& morphs() { return morphs_; }
  /// Feature ids of the last primitive, when it was packed by Draco.
  std::vector<double>& unpacked_ids() { return unpacked_ids_; }

 private:
  bool load_draco(const Primitive&, const Sets&, Streams&);
  Stream stream(const Primitive&, std::string_view name, std::size_t n, std::initializer_list<std::size_t> widths);
  bool fill(Stream&, std::initializer_list<std::size_t> widths);
  bool pose(const Primitive&, const Pose&, Streams&);
  void morph(const Primitive&, const Pose&, Streams&);
  bool skin(const Primitive&, const Pose&, Streams&);

  Context c_;
  std::vector<double> unpacked_ids_;
  std::vector<Morph> morphs_;
  std::uint64_t n_posed_ = 0;
};

}  // namespace wrlkit::gltf_reader
