// Shapes of VRML97 for a geometry node of VRML 1.0 in a state. Coordinates, normals and texture coordinates become one
// node each, however many shapes are made of them.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "passes/lower_vrml1/faces.h"
#include "passes/lower_vrml1/look.h"

namespace wrlkit::vrml1 {

class Shapes {
 public:
  /// `crease_angle`: of faces for which no ShapeHints says one.
  Shapes(Scene& scene, Looks& looks, Diagnostics& diag, double crease_angle)
      : scene_(scene), looks_(looks), diag_(diag), crease_angle_(crease_angle) {}

  /// What the node draws: none, a Shape, or several where one is not enough.
  const std::vector<NodeId>& of(NodeId geometry, const State&);

 private:
  /// A polygon or line shape on its way.
  struct Job {
    NodeId source;
    State state;  // with what a vertexProperty says
    std::size_t n_points;
    Attribute colors, normals, texture;
    NodeId texture_coord;  // as a node of VRML97
    bool baked = false, lines = false;
  };
  using Parts = std::vector<std::pair<NodeId, std::size_t>>;  // geometry and its material

  std::vector<NodeId> make(NodeId, const State&);
  NodeId shape(NodeId geometry, const State&, std::size_t material, bool colored = false, bool strokes = false,
               bool baked = false);
  NodeId add(TypeId, NodeId source);

  // Primitives.
  Parts cone(NodeId), cylinder(NodeId), sphere(NodeId);
  std::vector<NodeId> cube(NodeId, const State&);
  std::vector<NodeId> primitive(const Parts&, const State&);
  NodeId text(NodeId, const State&);
  NodeId font_style(NodeId font, NodeId text);

  // Polygons, lines, points.
  std::vector<NodeId> polygons(NodeId, State);
  void bind_all(Job&, const Faces&);
  void bind_texture(Job&, const Faces&);
  std::vector<NodeId> emit_all(const Job&, const Faces&);
  NodeId emit(const Job&, const Faces&, const Attribute& colors, const Attribute& normals, const Attribute& texture,
              std::size_t material, NodeId coord);
  NodeId face_set(const Job&, const Faces&, const Attribute& normals, const Attribute& texture);
  NodeId line_set(const Job&, const Faces&);
  void set_colors(NodeId geometry, const Job&, const Faces&, const Attribute&);
  std::vector<NodeId> points(NodeId, State);

  // Arrays.
  std::vector<double> positions(NodeId source) const;
  std::size_t n_positions(NodeId source) const;
  NodeId coordinate(NodeId source);
  NodeId normal(NodeId source);
  NodeId texture_coordinate(NodeId source, std::uint32_t map);
  NodeId projected(NodeId plane, NodeId coord);
  void apply_vertex_property(NodeId geometry, State&) const;

  Scene& scene_;
  Looks& looks_;
  Diagnostics& diag_;
  double crease_angle_;
  std::map<std::pair<NodeId, State>, std::vector<NodeId>> made_;
  std::map<NodeId, NodeId> coordinates_, normals_;
  std::map<std::pair<NodeId, std::uint32_t>, NodeId> texture_coordinates_;
  std::map<std::tuple<NodeId, std::string_view, double>, NodeId> font_styles_;
};

}  // namespace wrlkit::vrml1
