// store_mesh: the way back from a Mesh to a geometry node. Each attribute is written in the shortest of its bindings:
// none where it follows coordIndex, per face where the corners of each face agree, otherwise an index list of its own.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/math/digits.h"
#include "geometry/geometry.h"
#include "scenegraph/metadata.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

bool identical(const std::vector<std::uint32_t>& index) {
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != i) return false;
  return true;
}

enum class Binding { coord, face, own };

class Store {
 public:
  Store(Scene& scene, NodeId geometry, const Mesh& mesh) : scene_(scene), geometry_(geometry), mesh_(mesh) {}

  void faces() {
    namespace ifs = nodes::indexed_face_set;
    if (!mesh_.corners.empty()) add(ifs::coord, coordinate(mesh_.positions.span()));
    color(ifs::color, ifs::colorIndex, ifs::colorPerVertex);
    if (mesh_.normal.present()) {
      add(ifs::normal, attribute("normal", nodes::normal::vector, mesh_.normal));
      bind(mesh_.normal, ifs::normalIndex, &ifs::normalPerVertex);
    }
    if (mesh_.texcoord.present()) {
      add(ifs::texCoord, attribute("texCoord", nodes::texture_coordinate::point, mesh_.texcoord));
      bind(mesh_.texcoord, ifs::texCoordIndex, nullptr);
    }
    if (mesh_.lightcoord.present()) {
      add(ifs::lightCoord, attribute("lightCoord", nodes::texture_coordinate::point, mesh_.lightcoord));
      bind(mesh_.lightcoord, ifs::lightCoordIndex, nullptr);
    }
    add_unless_default(ifs::ccw, mesh_.ccw, true);
    add_unless_default(ifs::convex, mesh_.convex, true);
    add_unless_default(ifs::solid, mesh_.solid, true);
    add_unless_default(ifs::creaseAngle, mesh_.crease_angle, 0.0);
    add_runs(ifs::coordIndex, mesh_.corners);
    become(nodes::IndexedFaceSet);
  }

  void lines() {
    namespace ils = nodes::indexed_line_set;
    if (!mesh_.corners.empty()) add(ils::coord, coordinate(mesh_.positions.span()));
    color(ils::color, ils::colorIndex, ils::colorPerVertex);
    add_runs(ils::coordIndex, mesh_.corners);
    become(nodes::IndexedLineSet);
  }

  // A PointSet has no indices: points and colours are in the order of the corners.
  void points() {
    const bool as_they_are = identical(mesh_.corners) && mesh_.corners.size() == mesh_.n_positions();
    std::vector<double> gathered;
    if (!as_they_are) gather(mesh_.positions.data(), mesh_.corners, gathered);
    if (!mesh_.corners.empty())
      add(nodes::point_set::coord,
          coordinate(as_they_are ? mesh_.positions.span() : std::span<const double>(gathered)));
    if (mesh_.color.present()) {
      Attribute colors(mesh_.color.width);
      gather(mesh_.color.values.data(), mesh_.color.index, colors.values, colors.width);
      add(nodes::point_set::color, color_node(identical(mesh_.color.index) ? mesh_.color : colors));
    }
    become(nodes::PointSet);
  }

 private:
  template <FieldType T, class V>
  void add(FieldKey<T> key, const V& value) {
    fields_.push_back(scene_.make(T, key.slot, value));
  }
  template <FieldType T, class V>
  void add_unless_default(FieldKey<T> key, V value, V standard) {
    if (value != standard) add(key, value);
  }

  template <class T>
  static void gather(const T* values, const std::vector<std::uint32_t>& index, std::vector<T>& out, int width = 3) {
    for (auto i : index) out.insert(out.end(), values + std::size_t{i} * width, values + (std::size_t{i} + 1) * width);
  }

  // The node that a field of the geometry held before: fields of one name mean the same everywhere.
  NodeId authored(std::string_view field, TypeId type) const {
    const auto& rows = scene_.type(geometry_).fields;
    for (std::uint16_t slot = 0; slot < rows.size(); ++slot)
      if (rows[slot].name == field && rows[slot].type == FieldType::SFNode) {
        const Value& v = scene_.value(geometry_, slot);
        if (!v.is && v.type == FieldType::SFNode && scene_.is(v.node, type)) return v.node;
      }
    return {};
  }

  // The authored Coordinate if it has these very points, otherwise a new one.
  NodeId coordinate(std::span<const double> points) {
    if (NodeId old = authored("coord", nodes::Coordinate)) {
      auto had = scene_.get(old, nodes::coordinate::point);
      if (had.size() == points.size() && (had.data() == points.data() || std::ranges::equal(had, points))) return old;
    }
    NodeId n = scene_.add(nodes::Coordinate, scene_.where(geometry_));
    scene_.set(n, nodes::coordinate::point, points);
    take_tags(scene_, authored("coord", nodes::Coordinate), n);
    return n;
  }

  // The same for a node of single precision values. Of more components than the field has (alpha) the first are taken.
  template <FieldType T>
  NodeId attribute(std::string_view field, FieldKey<T> key, const Attribute& a) {
    NodeId old = authored(field, key.node);
    if (old && same_values(scene_.get(old, key), a)) return old;
    const std::size_t width = info(T).arity;
    std::vector<double> values;
    values.reserve(a.count() * width);
    for (std::size_t i = 0; i < a.count(); ++i)
      for (std::size_t k = 0; k < width; ++k) values.push_back(decimal(a.values[i * a.width + k]));
    NodeId n = scene_.add(key.node, scene_.where(geometry_));
    scene_.set(n, key, values);
    take_tags(scene_, old, n);
    return n;
  }

  static bool same_values(std::span<const double> had, const Attribute& a) {
    return std::ranges::equal(had, a.values, [](double d, float f) { return static_cast<float>(d) == f; });
  }

  NodeId color_node(const Attribute& a) {
    return a.width == 4 ? attribute("color", nodes::color_rgba::color, a) : attribute("color", nodes::color::color, a);
  }

  template <FieldType N, FieldType I, FieldType B>
  void color(FieldKey<N> node, FieldKey<I> index, FieldKey<B> per_vertex) {
    if (!mesh_.color.present()) return;
    add(node, color_node(mesh_.color));
    bind(mesh_.color, index, &per_vertex);
  }

  Binding binding_of(const Attribute& a, bool may_be_per_face) const {
    if (a.index == mesh_.corners) return Binding::coord;
    if (!may_be_per_face) return Binding::own;
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f)
      for (std::size_t c = mesh_.begin_of(f) + 1; c < mesh_.end_of(f); ++c)
        if (a.index[c] != a.index[mesh_.begin_of(f)]) return Binding::own;
    return Binding::face;
  }

  void bind(const Attribute& a, FieldKey<FieldType::MFInt32> index, const FieldKey<FieldType::SFBool>* per_vertex) {
    switch (binding_of(a, per_vertex != nullptr)) {
      case Binding::coord:
        return;
      case Binding::own:
        return add_runs(index, a.index);
      case Binding::face:
        break;
    }
    add(*per_vertex, false);
    std::vector<std::uint32_t> of_face(mesh_.n_faces());
    for (std::size_t f = 0; f < of_face.size(); ++f) of_face[f] = a.index[mesh_.begin_of(f)];
    if (!identical(of_face)) add(index, std::vector<std::int32_t>(of_face.begin(), of_face.end()));
  }

  // Corner by corner, -1 behind each face; written into the arena at once, without a copy between.
  void add_runs(FieldKey<FieldType::MFInt32> key, const std::vector<std::uint32_t>& index) {
    Value v;
    v.type = FieldType::MFInt32;
    v.slot = key.slot;
    v.count = static_cast<std::uint32_t>(index.size() + mesh_.n_faces());
    auto* to = scene_.arena().allocate<std::int32_t>(v.count);
    v.integers = to;
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f) {
      to = std::copy(index.begin() + mesh_.begin_of(f), index.begin() + mesh_.end_of(f), to);
      *to++ = -1;
    }
    fields_.push_back(v);
  }

  // What is said of the geometry stays, and fields that the node type did not have.
  void become(TypeId type) {
    const auto tags = tags_for(scene_, geometry_, type);
    fields_.insert(fields_.end(), tags.begin(), tags.end());
    for (const Value& v : scene_.fields(geometry_))
      if (scene_.is_extra(v) && scene_.content(v).is) fields_.push_back(v);
    scene_.become(geometry_, type, fields_);
  }

  Scene& scene_;
  NodeId geometry_;
  const Mesh& mesh_;
  std::vector<Value> fields_;
};

}  // namespace

void store_mesh(Scene& scene, NodeId geometry, const Mesh& mesh) {
  Store store(scene, geometry, mesh);
  switch (mesh.kind) {
    case Mesh::Kind::none:
      return;
    case Mesh::Kind::faces:
      return store.faces();
    case Mesh::Kind::lines:
      return store.lines();
    case Mesh::Kind::points:
      return store.points();
  }
}

}  // namespace wrlkit
