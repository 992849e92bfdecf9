#include "parsers/gltf/features.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

/// A field with values for corners, and the one with their indices.
struct Values {
  std::uint16_t node_slot;
  std::uint16_t index_slot;
  bool per_face = false;
  NodeId node{};
  std::span<const std::int32_t> index{};
};

class Parting {
 public:
  Parting(Scene& scene, NodeId geometry, const std::vector<std::uint32_t>& part_of_face)
      : scene_(scene), geometry_(geometry), part_of_face_(part_of_face) {}

  std::vector<std::pair<std::uint32_t, NodeId>> run() {
    find_faces();
    find_values();
    std::map<std::uint32_t, std::size_t> number;
    std::vector<std::pair<std::uint32_t, std::vector<std::size_t>>> parts;
    for (std::size_t f = 0; f + 1 < begin_.size() && f < part_of_face_.size(); ++f) {
      const auto [at, is_new] = number.try_emplace(part_of_face_[f], parts.size());
      if (is_new) parts.push_back({part_of_face_[f], {}});
      parts[at->second].second.push_back(f);
    }
    std::vector<std::pair<std::uint32_t, NodeId>> out;
    for (const auto& [part, faces] : parts) out.push_back({part, make(faces)});
    return out;
  }

 private:
  bool is_points() const { return scene_.is(geometry_, nodes::PointSet); }

  /// Where faces begin in coordIndex, each with the -1 behind it; points are faces of their own.
  void find_faces() {
    begin_ = {0};
    if (is_points()) {
      for (std::size_t i = 0;
           i < scene_.get(scene_.get(geometry_, nodes::point_set::coord), nodes::coordinate::point).size() / 3; ++i)
        begin_.push_back(i + 1);
      return;
    }
    coord_index_ = scene_.is(geometry_, nodes::IndexedFaceSet)
                       ? scene_.get(geometry_, nodes::indexed_face_set::coordIndex)
                       : scene_.get(geometry_, nodes::indexed_line_set::coordIndex);
    for (std::size_t i = 0; i < coord_index_.size(); ++i)
      if (coord_index_[i] == -1) begin_.push_back(i + 1);
  }

  void find_values() {
    namespace ifs = nodes::indexed_face_set;
    namespace ils = nodes::indexed_line_set;
    constexpr std::uint16_t none = Value::extra_slot;
    if (is_points()) {
      values_ = {{nodes::point_set::coord.slot, none}, {nodes::point_set::color.slot, none}};
    } else if (scene_.is(geometry_, nodes::IndexedLineSet)) {
      values_ = {{ils::coord.slot, ils::coordIndex.slot},
                 {ils::color.slot, ils::colorIndex.slot, !scene_.get(geometry_, ils::colorPerVertex)}};
    } else {
      values_ = {{ifs::coord.slot, ifs::coordIndex.slot},
                 {ifs::color.slot, ifs::colorIndex.slot, !scene_.get(geometry_, ifs::colorPerVertex)},
                 {ifs::normal.slot, ifs::normalIndex.slot, !scene_.get(geometry_, ifs::normalPerVertex)},
                 {ifs::texCoord.slot, ifs::texCoordIndex.slot}};
    }
    for (Values& v : values_) {
      v.node = scene_.value(geometry_, v.node_slot).node;
      if (v.index_slot != none) v.index = scene_.value(geometry_, v.index_slot).integer_span();
    }
    std::erase_if(values_, [](const Values& v) { return !v.node; });
  }

  /// The value that the i-th place takes: of coordIndex, or the number of the face.
  std::int32_t value_at(const Values& v, std::size_t i) const {
    if (i < v.index.size()) return v.index[i];
    if (v.per_face || is_points()) return static_cast<std::int32_t>(i);
    return v.index.empty() ? coord_index_[i] : 0;
  }

  NodeId make(const std::vector<std::size_t>& faces) {
    const NodeId n = scene_.add(scene_.type_id(geometry_), scene_.where(geometry_));
    const auto fields = scene_.copy_of_fields(geometry_);
    scene_.set_fields(n, fields);
    std::vector<std::int32_t> coord;
    for (const Values& v : values_) {
      std::map<std::int32_t, std::int32_t> known;
      std::vector<std::int32_t> index, order;
      auto take = [&](std::int32_t i) {
        const auto [at, is_new] = known.try_emplace(i, static_cast<std::int32_t>(order.size()));
        if (is_new) order.push_back(i);
        index.push_back(at->second);
      };
      for (auto f : faces) {
        if (v.per_face) {
          take(value_at(v, f));
          continue;
        }
        for (std::size_t i = begin_[f]; i < begin_[f + 1]; ++i) {
          if (!is_points() && coord_index_[i] == -1)
            index.push_back(-1);
          else
            take(value_at(v, i));
        }
      }
      put_values(n, v, order);
      if (v.index_slot == Value::extra_slot) continue;
      if (&v == &values_[0]) coord = index;
      const bool counts_up =
          v.per_face && std::ranges::equal(index, order, [&, i = 0](auto a, auto) mutable { return a == i++; });
      if (&v != &values_[0] && (index == coord || counts_up))
        scene_.unset(n, v.index_slot);
      else
        scene_.set(n, scene_.make(FieldType::MFInt32, v.index_slot, index));
    }
    return n;
  }

  void put_values(NodeId n, const Values& v, const std::vector<std::int32_t>& order) {
    const NodeId to = scene_.add(scene_.type_id(v.node), scene_.where(v.node));
    for (const Value& list : scene_.copy_of_fields(v.node)) {
      if (info(list.type).element != Element::number || !info(list.type).multiple) continue;
      const std::size_t width = info(list.type).arity;
      std::vector<double> some;
      for (auto i : order)
        for (std::size_t k = 0; k < width; ++k)
          some.push_back(list.number_span()[static_cast<std::size_t>(i) * width + k]);
      scene_.set(to, scene_.make(list.type, list.slot, some));
    }
    scene_.set(n, scene_.make(FieldType::SFNode, v.node_slot, to));
  }

  Scene& scene_;
  NodeId geometry_;
  const std::vector<std::uint32_t>& part_of_face_;
  std::vector<std::size_t> begin_;
  std::span<const std::int32_t> coord_index_;
  std::vector<Values> values_;
};

}  // namespace

std::vector<std::pair<std::uint32_t, NodeId>> take_apart(Scene& scene, NodeId geometry,
                                                         const std::vector<std::uint32_t>& part_of_face) {
  return Parting(scene, geometry, part_of_face).run();
}

NodeId PartGroups::group(Scene& scene, PartRows& table, std::uint32_t row, std::vector<NodeId>& out) {
  const auto [known, is_new] = groups_.try_emplace(row);
  if (!is_new) return known->second;
  const NodeId made = known->second = scene.add(nodes::Group);
  const auto& rows = table.rows();
  table.set_made(row, made);
  const bool number = rows[row].name.starts_with('#');  // merge has called it so
  if (!rows[row].name.empty() && !number) scene.set_name(made, rows[row].name);
  if (rows[row].parent == none)
    out.push_back(made);
  else
    children_[group(scene, table, rows[row].parent, out)].push_back(made);
  return made;
}

void PartGroups::put(Scene& scene, PartRows& rows, std::uint32_t row, NodeId node, std::vector<NodeId>& out) {
  if (row >= rows.rows().size()) return out.push_back(node);
  const NodeId g = group(scene, rows, row, out);
  children_[g].push_back(node);
}

void PartGroups::put_empty(Scene& scene, PartRows& rows, std::vector<NodeId>& out) {
  for (std::uint32_t row = 0; row < rows.rows().size(); ++row)
    if (!rows.made(row)) group(scene, rows, row, out);
}

void PartGroups::finish(Scene& scene) const {
  for (const auto& [group, children] : children_) scene.set(group, nodes::group::children, children);
}

}  // namespace wrlkit::gltf_reader
