// Each Shape that may be joined gets a key: a text in which all is written that has to agree. Shapes of one list of
// children with equal keys become one. What an Appearance says is part of the key as a number, equal for those that say
// the same.
#include "passes/join/join.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>

#include "base/silent_task.h"
#include "geometry/geometry.h"
#include "passes/analysis/tag_watch.h"
#include "passes/analysis/usage.h"
#include "passes/join/touching.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_indices = std::numeric_limits<std::int32_t>::max() / 2;  // with room for the -1

/// Text that is the same for the same values in the same order.
class SurfaceKey {
 public:
  template <class T>
  void add(const T& v) {
    add(std::span<const T>(&v, 1));
  }
  template <class T>
  void add(std::span<const T> values) {
    text_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void add(std::string_view s) {
    add(s.size());
    text_ += s;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Numbers for what nodes say: equal where they say the same. A node that can be distinguished from others has its own.
class Contents {
 public:
  Contents(const Scene& scene, const Usage& usage, bool named) : scene_(scene), usage_(usage), named_(named) {}

  std::uint32_t operator()(NodeId n) {
    if (!n) return 0;
    if (auto known = of_node_.find(n.value); known != of_node_.end()) return known->second;
    auto number = static_cast<std::uint32_t>(of_text_.size() + 1);
    number = of_text_.emplace(describe(n), number).first->second;
    return of_node_[n.value] = number;
  }

 private:
  bool anonymous(NodeId n) const {
    if (usage_.touched(n) || !(named_ || scene_.name(n).empty())) return false;
    return std::ranges::none_of(scene_.fields(n), [&](const Value& v) { return v.is || scene_.is_extra(v); });
  }

  std::string describe(NodeId n) {
    SurfaceKey key;
    if (!anonymous(n)) {
      key.add(n.value);
      return key.text();
    }
    key.add(std::string_view(scene_.type(n).name));
    const auto& rows = scene_.type(n).fields;
    for (std::uint16_t slot = 0; slot < rows.size(); ++slot) {
      const Value* v = scene_.find(n, slot);
      if (!v || (info(v->type).element != Element::node && equal_plain(*v, rows[slot].default_value))) continue;
      key.add(slot);
      describe(*v, key);
    }
    return key.text();
  }

  void describe(const Value& v, SurfaceKey& key) {
    key.add(v.count);
    const auto& type = info(v.type);
    switch (type.element) {
      case Element::number:
        return key.add(v.number_span());
      case Element::integer:
      case Element::image:
        return key.add(v.integer_span());
      case Element::node:
        for (NodeId c : v.node_span()) key.add((*this)(c));
        return;
      case Element::text:
        if (!type.multiple) return key.add(v.text());
        for (auto s : v.text_span()) key.add(s);
    }
  }

  const Scene& scene_;
  const Usage& usage_;
  bool named_;
  std::unordered_map<std::string, std::uint32_t> of_text_;
  std::unordered_map<std::uint32_t, std::uint32_t> of_node_;
};

/// What a geometry holds; none of what is empty or of another type.
struct Parts {
  NodeId coord, color, normal, texcoord, lightcoord;
};

template <FieldType T>
NodeId if_filled(const Scene& scene, NodeId n, FieldKey<T> values) {
  return scene.is(n, values.node) && !scene.get(n, values).empty() ? n : NodeId{};
}

class Joining {
 public:
  Joining(Scene& scene, const JoinOptions& options, PassContext& ctx)
      : scene_(scene),
        named_(options.named),
        loose_(options.loose),
        ctx_(ctx),
        silent_(ctx),
        usage_(scene),
        contents_(scene, usage_, options.named) {}

  Outcome run() {
    for (NodeId n : all_nodes(scene_)) join_children(n);
    join_list(scene_.main.roots);
    if (n_joined_ == 0) return Outcome::unchanged;
    ctx_.stats["join.shapes"] += n_joined_;
    return Outcome::changed;
  }

 private:
  void join_children(NodeId parent);
  bool join_list(std::vector<NodeId>& children);
  bool may_join(NodeId shape) const;
  bool plain(NodeId n) const;
  bool own(NodeId n) const { return n && usage_.once(n) && (named_ || scene_.name(n).empty()); }
  std::string key(NodeId shape);
  void join_loose(std::span<const NodeId> shapes);
  void join_shapes(std::span<const NodeId> shapes);
  bool append(NodeId geometry, bool own_points);
  void start();
  template <class T>
  void append_used(std::span<const T> values, int width, const std::vector<std::uint32_t>& index,
                   std::vector<T>& to_values, std::vector<std::uint32_t>& to_index);

  NodeId geometry_of(NodeId shape) const { return scene_.get(shape, nodes::shape::geometry); }
  Parts parts_of(NodeId geometry) const;
  bool has_opacity(NodeId g) const {
    const bool faces = scene_.is(g, nodes::IndexedFaceSet);
    return scene_.is(
        faces ? scene_.get(g, nodes::indexed_face_set::color) : scene_.get(g, nodes::indexed_line_set::color),
        nodes::ColorRGBA);
  }
  bool may_be_textured(NodeId appearance) const {
    return appearance &&
           (!scene_.is(appearance, nodes::Appearance) || scene_.get(appearance, nodes::appearance::texture));
  }

  Scene& scene_;
  bool named_, loose_;
  PassContext& ctx_;
  SilentTask silent_;
  Usage usage_;
  Contents contents_;
  Mesh mesh_, joined_;
  MeshScratch scratch_;
  std::vector<char> gone_;  // by node
  std::size_t n_joined_ = 0;
};

void Joining::join_children(NodeId parent) {
  const auto& type = scene_.type(parent);
  bool list = type.is_a(nodes::X3DGroupingNode);
  if (!list || scene_.is(parent, nodes::Switch) || scene_.is(parent, nodes::LOD)) return;
  for (const Value v : scene_.fields(parent)) {  // a copy, as joining adds nodes
    if (scene_.is_extra(v) || v.is || v.type != FieldType::MFNode || type.fields[v.slot].name != "children") continue;
    std::vector<NodeId> children(v.node_span().begin(), v.node_span().end());
    if (join_list(children)) scene_.set(parent, scene_.make(FieldType::MFNode, v.slot, children));
    return;
  }
}

/// True when there are fewer of them now.
bool Joining::join_list(std::vector<NodeId>& children) {
  std::unordered_map<std::string, std::size_t> group_of;
  std::vector<std::vector<NodeId>> groups;
  for (NodeId n : children) {
    if (!n || !may_join(n)) continue;
    auto [group, fresh] = group_of.emplace(key(n), groups.size());
    if (fresh) groups.emplace_back();
    groups[group->second].push_back(n);
  }
  const std::size_t before = n_joined_;
  gone_.resize(scene_.node_count());
  for (const auto& g : groups) {
    if (g.size() < 2) continue;
    if (loose_)
      join_loose(g);
    else
      join_shapes(g);
  }
  if (n_joined_ == before) return false;
  std::erase_if(children, [&](NodeId n) { return n && n.value < gone_.size() && gone_[n.value]; });
  return true;
}

Parts Joining::parts_of(NodeId g) const {
  namespace ifs = nodes::indexed_face_set;
  namespace ils = nodes::indexed_line_set;
  auto coord = [&](NodeId n) { return if_filled(scene_, n, nodes::coordinate::point); };
  auto color = [&](NodeId n) { return if_filled(scene_, n, nodes::color::color); };
  if (scene_.is(g, nodes::IndexedLineSet))
    return {coord(scene_.get(g, ils::coord)), color(scene_.get(g, ils::color)), {}, {}, {}};
  return {coord(scene_.get(g, ifs::coord)), color(scene_.get(g, ifs::color)),
          if_filled(scene_, scene_.get(g, ifs::normal), nodes::normal::vector),
          if_filled(scene_, scene_.get(g, ifs::texCoord), nodes::texture_coordinate::point),
          if_filled(scene_, scene_.get(g, ifs::lightCoord), nodes::texture_coordinate::point)};
}

bool Joining::plain(NodeId n) const {
  return !usage_.touched(n) &&
         std::ranges::none_of(scene_.fields(n), [&](const Value& v) { return v.is || scene_.is_extra(v); });
}

bool Joining::may_join(NodeId shape) const {
  if (!scene_.is(shape, nodes::Shape) || !own(shape) || !plain(shape)) return false;
  NodeId g = geometry_of(shape);
  bool faces = scene_.is(g, nodes::IndexedFaceSet);
  if (!(faces || scene_.is(g, nodes::IndexedLineSet)) || !own(g) || !plain(g)) return false;
  const Parts parts = parts_of(g);
  // What is known of one part is not known of another.
  for (NodeId n : {shape, g, parts.coord, parts.color, parts.normal, parts.texcoord, parts.lightcoord})
    if (has_tags(scene_, n)) return false;
  for (NodeId n : {parts.color, parts.normal, parts.texcoord, parts.lightcoord})
    if (n && !plain(n)) return false;
  if (!parts.coord || !plain(parts.coord) || has_opacity(g)) return false;
  return !faces || parts.texcoord || !may_be_textured(scene_.get(shape, nodes::shape::appearance));
}

/// All that has to agree.
std::string Joining::key(NodeId shape) {
  namespace ifs = nodes::indexed_face_set;
  NodeId g = geometry_of(shape);
  const Parts parts = parts_of(g);
  SurfaceKey key;
  key.add(contents_(scene_.get(shape, nodes::shape::appearance)));
  key.add(scene_.type_id(g).value);
  key.add((own(parts.coord) ? NodeId{} : parts.coord).value);
  for (NodeId n : {parts.color, parts.normal, parts.texcoord, parts.lightcoord}) key.add(static_cast<bool>(n));
  if (!scene_.is(g, nodes::IndexedFaceSet)) return key.text();
  for (bool flag : {scene_.get(g, ifs::ccw), scene_.get(g, ifs::solid), scene_.get(g, ifs::convex)}) key.add(flag);
  key.add(scene_.get(g, ifs::creaseAngle));
  return key.text();
}

void Joining::join_loose(std::span<const NodeId> shapes) {
  constexpr std::size_t most_faces = 4;
  Touching touching;
  std::vector<NodeId> loose;
  for (const NodeId shape : shapes) {
    MeshJob job{scene_, geometry_of(shape), mesh_, scratch_, silent_};
    read_mesh(job);
    if (mesh_.n_faces() > most_faces) continue;
    touching.add(mesh_.positions.span(), mesh_.corners);
    loose.push_back(shape);
  }
  for (const auto& group : touching.groups()) {
    std::vector<NodeId> joined;
    for (const auto i : group) joined.push_back(loose[i]);
    if (joined.size() > 1) join_shapes(joined);
  }
}

void Joining::join_shapes(std::span<const NodeId> shapes) {
  const NodeId first = geometry_of(shapes[0]);
  const bool own_points = own(parts_of(first).coord);
  joined_.clear();
  std::size_t n = 0;
  for (NodeId shape : shapes) {
    bool done = append(geometry_of(shape), own_points);
    if (!done && n == 0) return;
    if (done && n++ > 0) gone_[shape.value] = 1;
  }
  if (n < 2) return;
  store_mesh(scene_, first, joined_);
  n_joined_ += n - 1;
}

/// False, and nothing done, for what does not fit.
bool Joining::append(NodeId geometry, bool own_points) {
  const auto points = scene_.get(parts_of(geometry).coord, nodes::coordinate::point);
  MeshJob job{scene_, geometry, mesh_, scratch_, ctx_};
  read_mesh(job);
  bool moved = mesh_.positions.data() != points.data();  // numbers that are not finite were replaced
  if (mesh_.corners.empty() || (moved && !own_points)) return false;
  if (joined_.corners.size() + mesh_.corners.size() > most_indices) return false;
  if (joined_.kind == Mesh::Kind::none) {
    start();
    if (!own_points) joined_.positions = Array<double>::borrow(points);
  }
  const auto n_corners = static_cast<std::uint32_t>(joined_.corners.size());
  for (std::size_t f = 0; f < mesh_.n_faces(); ++f)
    joined_.face_begin.push_back(n_corners + static_cast<std::uint32_t>(mesh_.end_of(f)));
  if (own_points)
    append_used(mesh_.positions.span(), 3, mesh_.corners, joined_.positions.edit(), joined_.corners);
  else
    joined_.corners.insert(joined_.corners.end(), mesh_.corners.begin(), mesh_.corners.end());
  for (auto a : {&Mesh::normal, &Mesh::color, &Mesh::texcoord, &Mesh::lightcoord}) {
    const Attribute& from = mesh_.*a;
    append_used(std::span<const float>(from.values), from.width, from.index, (joined_.*a).values, (joined_.*a).index);
  }
  return true;
}

/// The joined mesh is to be like the first, without its faces.
void Joining::start() {
  joined_.kind = mesh_.kind;
  joined_.ccw = mesh_.ccw;
  joined_.solid = mesh_.solid;
  joined_.convex = mesh_.convex;
  joined_.crease_angle = mesh_.crease_angle;
  joined_.face_begin.push_back(0);
}

/// The values that are indexed, in the order in which they are.
template <class T>
void Joining::append_used(std::span<const T> values, int width, const std::vector<std::uint32_t>& index,
                          std::vector<T>& to_values, std::vector<std::uint32_t>& to_index) {
  StampedMap& map = scratch_.map;
  map.reset(values.size() / width);
  for (auto i : index) {
    if (!map.contains(i)) {
      map.set(i, static_cast<std::uint32_t>(to_values.size() / width));
      auto value = values.subspan(std::size_t{i} * width, width);
      to_values.insert(to_values.end(), value.begin(), value.end());
    }
    to_index.push_back(map[i]);
  }
}

}  // namespace

Outcome join(Scene& scene, const JoinOptions& options, PassContext& ctx) {
  const TagWatch tags(scene);
  const Outcome out = Joining(scene, options, ctx).run();
  if (out == Outcome::changed) tags.report_lost(scene, "join", ctx.diag);
  return out;
}

}  // namespace wrlkit
