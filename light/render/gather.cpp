#include "light/render/gather.h"

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

constexpr std::uint32_t unknown = 0xffffffff;
/// Up to this number of points, bounds are those of the points; beyond, of the boxes of their meshes.
constexpr std::size_t most_points = 50'000'000;

}  // namespace

std::vector<std::uint32_t> Gatherer::meshes_of(const Stage& stage, Diagnostics& diag) {
  of_node_.assign(scene_.node_count(), unknown);
  std::vector<std::uint32_t> out;
  out.reserve(stage.uses.size());
  const std::uint32_t empty = pool_.add(Mesh());
  bool full = false;
  for (const Use& u : stage.uses) {
    auto& mesh = of_node_[u.geometry.value];
    if (mesh == unknown && !full) {
      mesh = mesh_of(u.geometry);
      full = pool_.n_elements() > MeshPool::most_elements;
      if (full) diag.report(Diag::expansion_limit, scene_.where(u.geometry), MeshPool::most_elements, "triangles");
    }
    out.push_back(mesh == unknown ? empty : mesh);
  }
  return out;
}

std::uint32_t Gatherer::mesh_of(NodeId geometry) {
  if (!is_primitive(geometry)) return pool_.add(source_(geometry));
  auto [at, added] = of_primitive_.try_emplace(description(geometry));
  if (added) at->second = pool_.add(source_(geometry));
  return at->second;
}

bool Gatherer::is_primitive(NodeId n) const {
  return scene_.is(n, nodes::Box) || scene_.is(n, nodes::Cone) || scene_.is(n, nodes::Cylinder) ||
         scene_.is(n, nodes::Sphere);
}

/// Its type and the values of all its fields, which are numbers and truth values.
std::vector<double> Gatherer::description(NodeId n) const {
  std::vector<double> out{static_cast<double>(scene_.type_id(n).value)};
  const auto fields = scene_.type(n).fields;
  for (std::uint16_t slot = 0; slot < fields.size(); ++slot) {
    if (!fields[slot].has_value()) continue;
    const Value& written = scene_.value(n, slot);
    const Value& v = written.is || written.type != fields[slot].type ? fields[slot].default_value : written;
    if (v.type == FieldType::SFBool)
      out.push_back(v.integer);
    else
      out.insert(out.end(), v.number_span().begin(), v.number_span().end());
  }
  return out;
}

Box bounds(const Stage& stage, const MeshPool& pool, std::span<const std::uint32_t> mesh_of) {
  Box all;
  std::size_t points = 0;
  for (std::size_t i = 0; i < mesh_of.size(); ++i) {
    const PooledMesh& m = pool[mesh_of[i]];
    const Affine& frame = stage.frames[stage.uses[i].frame];
    if (!m.n_elements || !finite(frame)) continue;
    points += m.n_points;
    auto add = [&](const V3& p) { all.add(frame.point(p)); };
    if (points > most_points)
      for (int k = 0; k < 8; ++k) add(m.box.corner(k));
    else
      for (std::uint32_t k = 0; k < m.n_points; ++k)
        add(m.origin + V3(pool.point(m, k)[0], pool.point(m, k)[1], pool.point(m, k)[2]));
  }
  return all;
}

}  // namespace wrlkit::drawing
