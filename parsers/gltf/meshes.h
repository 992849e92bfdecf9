// Meshes of glTF as geometry nodes. Points stay points, lines lines, triangles faces: those that wrlkit has cut out of
// a polygon become that polygon again.
//
// In files of others every attribute keeps its vertices: Coordinate, Normal, Color and TextureCoordinate have the
// accessor's values, coordIndex its indices, and who shares an accessor shares the node. In files of wrlkit vertices
// that were split for their attributes are one point again, and what VRML makes itself (normals from creaseAngle,
// texture coordinates from the bounding box) is left to it.
#pragma once
#include <functional>

#include "parsers/gltf/materials.h"
#include "parsers/gltf/part_rows.h"
#include "scenegraph/transform.h"

namespace wrlkit::gltf_reader {

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

class Meshes {
 public:
  static constexpr std::uint64_t max_posed = 20'000'000;  // vertices of skinned and morphed meshes

  Meshes(const Context& c, Extras& extras, PartRows& rows)
      : c_(c), extras_(extras), rows_(rows), materials_(c, extras), reported_(c.file.count(Table::meshes)) {}

  struct Part {
    NodeId appearance, geometry;
    std::uint32_t row = none;  // of a part of a merged mesh, in the table of parts
  };
  /// One for each primitive that can be had.
  std::vector<Part> parts(std::uint32_t mesh, const Pose&);
  /// Is it a mesh of wrlkit with feature ids, which becomes several Shapes?
  bool has_features(std::uint32_t mesh) const;
  /// See Materials::nodes_of.
  std::vector<std::pair<NodeId, bool>> materials_of(std::uint32_t material) const {
    return materials_.nodes_of(material);
  }
  /// Of the last call, one for each primitive with targets.
  std::vector<Morph> take_morphs() { return std::move(morphs_); }

 private:
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
  std::optional<Part> part(const Primitive&, const Pose&);
  /// Of a mesh with feature ids the parts; none if it has no good ones.
  std::vector<Part> features(const Primitive&, const Part& whole);
  NodeId kept_whole(const Primitive&);
  bool load(const Primitive&, const Pose&, const Sets&, Streams&);
  bool load_draco(const Primitive&, const Sets&, Streams&);
  Stream stream(const Primitive&, std::string_view name, std::size_t n, std::initializer_list<std::size_t> widths);
  bool fill(Stream&, std::initializer_list<std::size_t> widths);
  bool pose(const Primitive&, const Pose&, Streams&);
  void morph(const Primitive&, const Pose&, Streams&);
  bool skin(const Primitive&, const Pose&, Streams&);
  /// Triangles, segments or points, as vertices.
  std::vector<std::uint32_t> elements(const Primitive&, Streams&);
  NodeId foreign(const Primitive&, Streams&, const Look&);
  NodeId own(const Primitive&, Streams&, const Look&);
  void own_faces(NodeId, const Primitive&, const Streams&, const std::vector<std::uint32_t>& triangles);
  void note_first_vertices(NodeId, const Primitive&, const std::vector<std::uint32_t>& corners);
  std::vector<std::uint32_t> first_vertices(const Primitive&, const std::vector<std::uint32_t>& corners) const;
  void own_lines(NodeId, const Streams&, const std::vector<std::uint32_t>& segments);
  NodeId attribute(TypeId, std::uint16_t slot, FieldType, Stream&, int variant, bool loose,
                   const std::function<void(std::vector<double>&)>& change);
  void name_attribute(NodeId, Json kept);
  void name_attributes(NodeId, Json kept);
  void report_lost(const Primitive&, const Sets&);

  Context c_;
  Extras& extras_;
  PartRows& rows_;
  Materials materials_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Part>> parts_;  // by mesh and primitive
  std::map<std::tuple<std::uint32_t, std::uint32_t, int>, NodeId> attributes_;  // by type, accessor and variant
  std::map<std::tuple<int, std::uint32_t, std::size_t>, Value> coord_index_;    // by mode, accessor and vertices
  std::map<std::string, NodeId> own_;                                           // by what they are made of
  std::map<std::uint32_t, std::vector<std::uint32_t>> first_vertex_;            // by geometry node: of each face
  std::vector<double> unpacked_ids_;                                            // of the primitive at hand
  std::vector<Morph> morphs_;
  std::vector<char> reported_;
  std::uint64_t n_posed_ = 0;
};

}  // namespace wrlkit::gltf_reader
