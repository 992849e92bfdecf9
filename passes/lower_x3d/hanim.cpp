#include "passes/lower_x3d/hanim.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

/// A field that the node table does not know.
const Value* extra(const Scene& scene, NodeId n, std::string_view name) {
  for (const Value& v : scene.fields(n))
    if (scene.is_extra(v) && v.extra->name == name) return &v.extra->value;
  return nullptr;
}

/// The numbers of its text; none when there are others than `count`.
std::vector<double> numbers(const Scene& scene, NodeId n, std::string_view name, std::size_t count) {
  const Value* v = extra(scene, n, name);
  if (!v || v->is || v->type != FieldType::verbatim) return {};
  std::string text(v->text());
  std::ranges::replace(text, ',', ' ');
  std::vector<double> out;
  const char* at = text.c_str();
  for (char* end = nullptr; out.size() <= count; at = end) {
    const double d = std::strtod(at, &end);
    if (end == at) break;
    out.push_back(d);
  }
  return out.size() == count ? out : std::vector<double>{};
}

constexpr std::string_view names[] = {"HAnimHumanoid", "HAnimJoint", "HAnimSite", "HAnimSegment"};

}  // namespace

bool lower_humanoid(Scene& scene, NodeId n, Diagnostics& diag) {
  namespace t = nodes::transform;
  const auto& type = scene.type(n);
  if (type.kind != NodeKind::unknown || std::ranges::find(names, type.name) == std::end(names)) return false;
  const bool humanoid = type.name == names[0], segment = type.name == names[3];
  std::vector<NodeId> children;
  for (std::string_view field :
       {humanoid ? "skeleton" : "children", humanoid ? "skin" : "", humanoid ? "viewpoints" : ""})
    if (const Value* v = field.empty() ? nullptr : extra(scene, n, field))
      for (NodeId c : v->node_span())
        if (c) children.push_back(c);
  std::vector<Value> fields;
  struct Row {
    std::string_view name;
    std::uint16_t slot;
    FieldType type;
    std::size_t count;
  };
  constexpr Row rows[] = {{"translation", t::translation.slot, FieldType::SFVec3f, 3},
                          {"rotation", t::rotation.slot, FieldType::SFRotation, 4},
                          {"scale", t::scale.slot, FieldType::SFVec3f, 3},
                          {"scaleOrientation", t::scaleOrientation.slot, FieldType::SFRotation, 4},
                          {"center", t::center.slot, FieldType::SFVec3f, 3}};
  for (const Row& r : rows)
    if (auto v = numbers(scene, n, r.name, r.count); !segment && !v.empty())
      fields.push_back(scene.make(r.type, r.slot, v));
  if (!children.empty())
    fields.push_back(scene.make(FieldType::MFNode, segment ? nodes::group::children.slot : t::children.slot, children));
  diag.report(Diag::no_vrml97_node, scene.where(n), type.name);
  scene.become(n, segment ? nodes::Group : nodes::Transform, fields);
  return true;
}

}  // namespace wrlkit::x3d
