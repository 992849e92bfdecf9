#include "passes/lower_x3d/groups.h"

#include <algorithm>
#include <iterator>

#include "passes/lower_x3d/geometry.h"
#include "scenegraph/equal.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/metadata.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

struct GroupRow {
  TypeId from, to;
  std::uint16_t children;     // slot of `from`
  bool does_nothing = false;  // what else it did is lost, and is reported
};

constexpr GroupRow groups[] = {
    {nodes::StaticGroup, nodes::Group, nodes::static_group::children.slot},
    {nodes::CADAssembly, nodes::Group, nodes::cad_assembly::children.slot},
    {nodes::CADLayer, nodes::Group, nodes::cad_layer::children.slot},
    {nodes::CADPart, nodes::Transform, nodes::cad_part::children.slot},
    {nodes::CADFace, nodes::Group, nodes::cad_face::shape.slot},
    {nodes::ViewpointGroup, nodes::Group, nodes::viewpoint_group::children.slot},
    {nodes::LayerSet, nodes::Group, nodes::layer_set::layers.slot},
    {nodes::Layer, nodes::Group, nodes::layer::children.slot},
    {nodes::Viewport, nodes::Group, nodes::viewport::children.slot},
    {nodes::HAnimHumanoid, nodes::Transform, nodes::h_anim_humanoid::skeleton.slot, true},
    {nodes::HAnimJoint, nodes::Transform, nodes::h_anim_joint::children.slot},
    {nodes::HAnimSite, nodes::Transform, nodes::h_anim_site::children.slot},
    {nodes::HAnimSegment, nodes::Group, nodes::h_anim_segment::children.slot},
    {nodes::EspduTransform, nodes::Transform, nodes::espdu_transform::children.slot, true},
    {nodes::LayoutGroup, nodes::Group, nodes::layout_group::children.slot, true},
    {nodes::LayoutLayer, nodes::Group, nodes::layout_layer::children.slot, true},
    {nodes::ScreenGroup, nodes::Group, nodes::screen_group::children.slot, true},
    {nodes::PickableGroup, nodes::Group, nodes::pickable_group::children.slot},
    {nodes::RigidBodyCollection, nodes::Group, nodes::rigid_body_collection::bodies.slot, true},
    {nodes::RigidBody, nodes::Group, nodes::rigid_body::geometry.slot},
    {nodes::CollidableShape, nodes::Transform, nodes::collidable_shape::shape.slot},
    {nodes::CollidableOffset, nodes::Transform, nodes::collidable_offset::collidable.slot},
};

void take_name(Scene& scene, NodeId n) {
  auto slot = scene.type(n).find("name", Dialect::x3d);
  if (!slot || !scene.name(n).empty() || scene.value(n, *slot).is) return;
  if (auto name = legal_name(scene.value(n, *slot).text()); !name.empty()) scene.set_name(n, name);
}

/// A Switch that shows none of them.
NodeId hidden(Scene& scene, NodeId at, std::span<const NodeId> children) {
  NodeId s = scene.add(nodes::Switch, scene.where(at));
  scene.set(s, nodes::switch_::children, children);
  return s;
}

std::vector<NodeId> children_of(Scene& scene, NodeId n, const GroupRow& row) {
  const Value& v = scene.value(n, row.children);
  std::vector<NodeId> all(v.is ? nullptr : v.node_span().data(),
                          v.is ? nullptr : v.node_span().data() + v.node_span().size());
  if (row.from == nodes::HAnimHumanoid) {
    std::ranges::copy(scene.get(n, nodes::h_anim_humanoid::skin), std::back_inserter(all));
    std::ranges::copy(scene.get(n, nodes::h_anim_humanoid::viewpoints), std::back_inserter(all));
  }
  if (row.from != nodes::CADLayer) return all;
  const auto visible = scene.get(n, nodes::cad_layer::visible);
  for (std::size_t i = 0; i < std::min(all.size(), visible.size()); ++i)
    if (!visible[i]) all[i] = hidden(scene, n, std::span(&all[i], 1));
  return all;
}

/// Fields that the group does not have which a node becomes, as metadata; nodes in them are reported.
NodeId what_is_left(Scene& scene, NodeId n, const GroupRow& row, Diagnostics& diag) {
  constexpr std::string_view shown[] = {"visible", "skin", "viewpoints"},
                             said_of_others[] = {"joints", "segments", "sites"};
  const auto is_in = [](const auto& list, std::string_view name) {
    return std::ranges::find(list, name) != std::end(list);
  };
  std::vector<NodeId> members;
  for (const Value& v : scene.copy_of_fields(n)) {
    if (scene.is_extra(v) || v.is || v.slot == row.children) continue;
    const auto& field = scene.type(n).fields[v.slot];
    const auto kept = scene.type(row.to).find(field.name, Dialect::x3d);
    if (equals_default(v, field) || (kept && scene.type(row.to).fields[*kept].type == v.type)) continue;
    if (is_in(shown, field.name) || is_in(said_of_others, field.name)) continue;
    if (field.name == "name" && v.text() == scene.name(n)) continue;
    if (const NodeId m = metadata_of(scene, {scene.where(n), field.name}, v))
      members.push_back(m);
    else if (!row.does_nothing)
      diag.report(Diag::no_vrml97_value, scene.where(n), scene.type(n).name, field.name);
  }
  return members.empty() ? NodeId{} : metadata_set(scene, {scene.where(n), scene.type(n).name}, members);
}

bool rename_group(Scene& scene, NodeId n, Diagnostics& diag) {
  auto row = std::ranges::find(groups, scene.type_id(n), &GroupRow::from);
  if (row == std::end(groups)) return false;
  if (row->does_nothing) diag.report(Diag::no_vrml97_node, scene.where(n), scene.type(n).name);
  take_name(scene, n);
  auto children = children_of(scene, n, *row);
  const auto slot = row->to == nodes::Transform ? nodes::transform::children.slot : nodes::group::children.slot;
  auto fields = fields_for(scene, n, row->to);
  std::erase_if(fields, [&](const Value& v) { return v.slot == slot && !v.is; });
  if (!children.empty()) fields.push_back(scene.make(FieldType::MFNode, slot, children));
  const NodeId left = what_is_left(scene, n, *row, diag);
  scene.become(n, row->to, fields);
  if (left) add_metadata(scene, n, left);
  return true;
}

/// The node becomes a Switch that does not show what it was, which is returned.
NodeId put_into_switch(Scene& scene, NodeId n) {
  const NodeId copy = scene.add(scene.type_id(n), scene.where(n));
  scene.set_fields(copy, scene.copy_of_fields(n));
  scene.become(
      n, nodes::Switch,
      std::vector<Value>{scene.make(FieldType::MFNode, nodes::switch_::children.slot, std::vector<NodeId>{copy})});
  return copy;
}

bool hide(Scene& scene, NodeId n) {
  // Nodes without a FALSE, which are nearly all, have none under that name.
  const auto is_false = [](const Value& v) { return v.type == FieldType::SFBool && !v.is && v.integer == 0; };
  if (std::ranges::none_of(scene.fields(n), is_false)) return false;
  const auto& t = scene.type(n);
  auto slot = t.find("visible", Dialect::x3d);
  if (!slot || t.fields[*slot].type != FieldType::SFBool) return false;
  const Value* v = scene.find(n, *slot);
  if (!v || v->is || v->integer) return false;
  scene.unset(n, *slot);
  if (auto children = t.find("children", Dialect::x3d)) {
    const auto all = hierarchy_children(scene, n);
    scene.set(n, scene.make(FieldType::MFNode, *children, std::vector<NodeId>{hidden(scene, n, all)}));
    return true;
  }
  put_into_switch(scene, n);  // a Shape or an Inline
  return true;
}

bool is_of_lines_or_points(const Scene& scene, NodeId geometry) {
  static constexpr TypeId types[] = {nodes::IndexedLineSet, nodes::LineSet,    nodes::PointSet,    nodes::Arc2D,
                                     nodes::Circle2D,       nodes::Polyline2D, nodes::Polypoint2D, nodes::NurbsCurve};
  return std::ranges::any_of(types, [&](TypeId t) { return scene.is(geometry, t); });
}

/// Faces that are neither filled nor hatched (X3D 12.4.2) are not drawn.
bool hide_unfilled(Scene& scene, NodeId n) {
  namespace a = nodes::appearance;
  namespace f = nodes::fill_properties;
  if (!scene.is(n, nodes::Shape) || is_of_lines_or_points(scene, scene.get(n, nodes::shape::geometry))) return false;
  const NodeId look = scene.get(n, nodes::shape::appearance);
  const NodeId fill = scene.is(look, nodes::Appearance) ? scene.get(look, a::fillProperties) : NodeId{};
  if (!scene.is(fill, nodes::FillProperties) || scene.get(fill, f::filled) || scene.get(fill, f::hatched)) return false;
  const NodeId shape = put_into_switch(scene, n), own = scene.add(nodes::Appearance, scene.where(look));
  scene.set_fields(own, scene.copy_of_fields(look));
  scene.unset(own, a::fillProperties.slot);
  scene.set(shape, nodes::shape::appearance, own);
  return true;
}

}  // namespace

bool lower_group(Scene& scene, NodeId n, Diagnostics& diag) {
  const bool renamed = rename_group(scene, n, diag);
  return hide(scene, n) || hide_unfilled(scene, n) || renamed;
}

}  // namespace wrlkit::x3d
