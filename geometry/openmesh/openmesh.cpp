#ifdef WRLKIT_OPENMESH

#include "geometry/openmesh/openmesh.h"

#include <array>
#include <bit>
#include <unordered_map>

#include "base/hashing.h"

namespace wrlkit {
namespace {

using HalfEdge = OpenMesh::HalfedgeHandle;
using LightcoordHandle = OpenMesh::HPropHandleT<OpenMesh::Vec2f>;

class Maker {
 public:
  Maker(const Mesh& mesh, bool attributes) : in_(mesh), attributes_(attributes) {}

  ToOpenMesh run() {
    omerr().disable();
    add_vertices();
    if (attributes_) request();
    FaceAdder adder(out_.mesh);
    std::vector<std::uint32_t> apart;
    for (std::uint32_t f = 0; f < in_.n_faces(); ++f) {
      face_.clear();
      for (std::size_t c = in_.begin_of(f); c < in_.end_of(f); ++c) face_.push_back(vertex_[in_.corners[c]]);
      const auto handle = adder.add(face_);
      if (!handle.is_valid()) {
        apart.push_back(f);
        continue;
      }
      out_.face_of.push_back(f);
      if (attributes_) set_corners(handle, in_.begin_of(f));
    }
    out_.faults = adder.faults();
    keep_apart(apart);
    return std::move(out_);
  }

 private:
  void add_vertices() {
    constexpr std::uint32_t none = 0xffffffffu;
    vertex_.resize(in_.n_positions(), none);
    for (std::uint32_t p : in_.corners) {
      if (vertex_[p] != none) continue;
      vertex_[p] = static_cast<std::uint32_t>(out_.position_of.size());
      out_.position_of.push_back(p);
      const double* x = in_.positions.data() + std::size_t{3} * p;
      out_.mesh.add_vertex({x[0], x[1], x[2]});
    }
  }

  void request() {
    if (in_.normal.present()) out_.mesh.request_halfedge_normals();
    if (in_.color.present()) out_.mesh.request_halfedge_colors();
    if (in_.texcoord.present()) out_.mesh.request_halfedge_texcoords2D();
    if (in_.lightcoord.present()) out_.mesh.add_property(lightcoord_, openmesh_lightcoord);
  }

  void set_corners(OpenMesh::FaceHandle face, std::size_t corner) {
    for (HalfEdge h : out_.mesh.fh_range(face)) set_corner(h, corner++);
  }

  void set_corner(HalfEdge h, std::size_t corner) {
    auto value = [&](const Attribute& a) { return a.at(a.index[corner]); };
    if (in_.normal.present()) {
      const float* n = value(in_.normal);
      out_.mesh.set_normal(h, {n[0], n[1], n[2]});
    }
    if (in_.color.present()) {
      const float* c = value(in_.color);
      out_.mesh.set_color(h, {c[0], c[1], c[2], in_.color.width == 4 ? c[3] : 1});
    }
    if (in_.texcoord.present()) out_.mesh.set_texcoord2D(h, OpenMesh::Vec2f(value(in_.texcoord)));
    if (in_.lightcoord.present()) out_.mesh.property(lightcoord_, h) = OpenMesh::Vec2f(value(in_.lightcoord));
  }

  void keep_apart(const std::vector<std::uint32_t>& faces) {
    if (faces.empty()) return;
    Mesh& apart = out_.apart;
    apart = in_;
    apart.corners.clear();
    apart.face_begin.assign(1, 0);
    apart.cut.clear();
    for (Attribute* a : apart.attributes()) a->index.clear();
    for (std::uint32_t f : faces) {
      for (std::size_t c = in_.begin_of(f); c < in_.end_of(f); ++c) copy_corner(apart, c);
      apart.face_begin.push_back(static_cast<std::uint32_t>(apart.corners.size()));
    }
  }

  void copy_corner(Mesh& to, std::size_t corner) const {
    to.corners.push_back(in_.corners[corner]);
    const auto from = in_.attributes();
    const auto into = to.attributes();
    for (std::size_t i = 0; i < from.size(); ++i)
      if (from[i]->present()) into[i]->index.push_back(from[i]->index[corner]);
  }

  const Mesh& in_;
  const bool attributes_;
  ToOpenMesh out_;
  LightcoordHandle lightcoord_;
  std::vector<std::uint32_t> vertex_;  // of the mesh, by position
  std::vector<std::uint32_t> face_;
};

/// Values of one attribute, each once.
class Values {
 public:
  explicit Values(Attribute& attribute) : attribute_(attribute) {}

  template <class Value>
  void add(const Value& value) {
    Key key{};
    for (int i = 0; i < attribute_.width; ++i) key[static_cast<std::size_t>(i)] = static_cast<float>(value[i]);
    const auto [at, is_new] = number_.try_emplace(key, static_cast<std::uint32_t>(attribute_.count()));
    if (is_new) attribute_.values.insert(attribute_.values.end(), key.begin(), key.begin() + attribute_.width);
    attribute_.index.push_back(at->second);
  }

 private:
  using Key = std::array<float, 4>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (float f : key) h = mixed(h, std::bit_cast<std::uint32_t>(f + 0.f));
      return h;
    }
  };

  Attribute& attribute_;
  std::unordered_map<Key, std::uint32_t, Hash> number_;
};

bool has_alpha(const OpenMeshPolygons& mesh) {
  for (auto face : mesh.faces())
    for (HalfEdge h : mesh.fh_range(face))
      if (mesh.color(h)[3] != 1) return true;
  return false;
}

template <class Get>
void read(const OpenMeshPolygons& mesh, Attribute& attribute, Get get) {
  Values values(attribute);
  for (auto face : mesh.faces())
    for (HalfEdge h : mesh.fh_range(face)) values.add(get(h));
}

void read_faces(const OpenMeshPolygons& mesh, Mesh& out) {
  std::vector<std::uint32_t> number(mesh.n_vertices());
  auto& positions = out.positions.edit();
  for (auto v : mesh.vertices()) {
    number[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(positions.size() / 3);
    const auto& p = mesh.point(v);
    positions.insert(positions.end(), p.data(), p.data() + 3);
  }
  bool triangles = true;
  out.face_begin.push_back(0);
  for (auto face : mesh.faces()) {
    for (auto v : mesh.fv_range(face)) out.corners.push_back(number[static_cast<std::size_t>(v.idx())]);
    triangles &= out.corners.size() - out.face_begin.back() == 3;
    out.face_begin.push_back(static_cast<std::uint32_t>(out.corners.size()));
  }
  if (triangles) out.face_begin.clear();
}

}  // namespace

ToOpenMesh to_openmesh(const Mesh& mesh, bool attributes) { return Maker(mesh, attributes).run(); }

Mesh from_openmesh(const OpenMeshPolygons& mesh) {
  Mesh out;
  out.kind = Mesh::Kind::faces;
  read_faces(mesh, out);
  if (mesh.has_halfedge_normals()) read(mesh, out.normal, [&](HalfEdge h) { return mesh.normal(h); });
  if (mesh.has_halfedge_colors()) {
    out.color.width = has_alpha(mesh) ? 4 : 3;
    read(mesh, out.color, [&](HalfEdge h) { return mesh.color(h); });
  }
  if (mesh.has_halfedge_texcoords2D()) read(mesh, out.texcoord, [&](HalfEdge h) { return mesh.texcoord2D(h); });
  LightcoordHandle lightcoord;
  if (mesh.get_property_handle(lightcoord, openmesh_lightcoord))
    read(mesh, out.lightcoord, [&](HalfEdge h) { return mesh.property(lightcoord, h); });
  return out;
}

}  // namespace wrlkit

#endif
