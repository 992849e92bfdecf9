// Meshes of glTF as geometry nodes. Points stay points, lines lines, triangles faces: those that wrlkit has cut out of
// a polygon become that polygon again.
//
// In files of others every attribute keeps its vertices: Coordinate, Normal, Color and TextureCoordinate have the
// accessor's values, coordIndex its indices, and a shared accessor is a shared node. In files of wrlkit vertices
// that were split for their attributes are one point again, and what VRML makes itself (normals from creaseAngle,
// texture coordinates from the bounding box) is left to it.
#pragma once
#include <functional>

#include "parsers/gltf/materials.h"
#include "parsers/gltf/part_rows.h"
#include "parsers/gltf/primitives.h"

namespace wrlkit::gltf_reader {

class Meshes {
 public:
  Meshes(const Context& c, Extras& extras, PartRows& rows)
      : c_(c),
        extras_(extras),
        rows_(rows),
        reader_(c),
        materials_(c, extras),
        reported_(c.file.count(Table::meshes)) {}

  struct Part {
    NodeId appearance, geometry;
    std::uint32_t row = none;  // of a part of a merged mesh, in the table of parts
  };
  /// One for each primitive that can be read.
  std::vector<Part> parts(std::uint32_t mesh, const Pose&);
  /// Is it a mesh of wrlkit with feature ids, which becomes several Shapes?
  bool has_features(std::uint32_t mesh) const;
  /// See Materials::nodes_of.
  std::vector<std::pair<NodeId, bool>> materials_of(std::uint32_t material) const {
    return materials_.nodes_of(material);
  }
  /// The morphs of the last call, one for each primitive with targets.
  std::vector<Morph> take_morphs() { return std::move(reader_.morphs()); }

 private:
  std::optional<Part> part(const Primitive&, const Pose&);
  /// The parts of a mesh with feature ids; none if it has no valid ones.
  std::vector<Part> features(const Primitive&, const Part& whole);
  NodeId kept_whole(const Primitive&);
  NodeId recognised(const Primitive&);
  /// The nodes of one primitive of others' files; null where it has none of a kind.
  struct Attributes {
    NodeId coord, normal, color, texcoord, light;
  };
  NodeId foreign(const Primitive&, Streams&, const Look&);
  Attributes attributes_of(const Primitive&, Streams&, const Look&);
  NodeId color_of(const Primitive&, Streams&, const Look&, int variant);
  NodeId texcoord_of(Streams&, const Look&, int variant);
  NodeId foreign_points(const Primitive&, const Streams&, Attributes, std::span<const std::uint32_t> corners);
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
  PrimitiveReader reader_;
  Materials materials_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Part>> parts_;  // by mesh and primitive
  std::map<std::tuple<std::uint32_t, std::uint32_t, int>, NodeId> attributes_;  // by type, accessor and variant
  std::map<std::tuple<int, std::uint32_t, std::size_t>, Value> coord_index_;    // by mode, accessor and vertices
  std::map<std::string, NodeId> own_;                                           // by what they are made of
  std::map<std::uint32_t, std::vector<std::uint32_t>> first_vertex_;            // by geometry node: of each face
  std::vector<char> reported_;
};

}  // namespace wrlkit::gltf_reader
