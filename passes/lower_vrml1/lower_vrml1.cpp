#include "passes/lower_vrml1/lower_vrml1.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "passes/analysis/nesting.h"
#include "passes/analysis/text_list.h"
#include "passes/lower_vrml1/lowering.h"
#include "passes/lower_vrml1/singles.h"
#include "passes/lower_vrml1/strokes.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace vrml1 {
namespace {

namespace v1 = nodes::vrml1;

constexpr std::string_view cameras = "Cameras";  // the Switch of that name holds the viewpoints

}  // namespace

void Lowering::run() {
  legal_names();
  const auto names = names_in_use();
  report_unknown_fields();
  Frame frame;
  State state;
  for (NodeId n : scene_.main.roots) visit(n, state, frame);
  scene_.main.roots = children(scene_, frame);
  report_lost(names);
  scene_.format = Format::vrml97;
  scene_.header.clear();
  limit_nesting(scene_, diag_);
}

// What Inventor puts behind a '+' tells nodes of one name apart. Other characters have no place in names of VRML97.
void Lowering::legal_names() {
  for (std::uint32_t i = 0; i < scene_.node_count(); ++i) {
    const auto old = scene_.name(NodeId{i});
    if (old.find_first_of("+.-'\\0123456789") == old.npos) continue;
    const auto own = old.substr(0, old.find('+'));
    std::string name(own);
    std::ranges::replace_if(
        name, [](char c) { return c == '.' || c == '\'' || c == '\\'; }, '_');
    if (!name.empty() && (name[0] == '-' || (name[0] >= '0' && name[0] <= '9'))) name.insert(0, 1, '_');
    if (name != own) diag_.report(Diag::name_changed, scene_.where(NodeId{i}), own, name);
    if (name != old) scene_.set_name(NodeId{i}, name);
  }
}

std::vector<std::string_view> Lowering::names_in_use() const {
  std::vector<std::string_view> out;
  for (NodeId n : reachable(scene_, scene_.main)) {
    const auto name = scene_.name(n);
    const bool says_what_it_is = scene_.is(n, nodes::Vrml1InfoNode) || (is(n, v1::Switch) && name == cameras);
    if (!name.empty() && !says_what_it_is) out.push_back(name);
  }
  return out;
}

/// Names of properties, which have no node of their own in VRML97, and of what shows nothing.
void Lowering::report_lost(std::span<const std::string_view> names_before) {
  const auto now = names_in_use();
  std::unordered_set<std::string_view> known(now.begin(), now.end());
  TextList lost;
  for (const auto name : names_before)
    if (known.insert(name).second) lost.add(name);
  if (!lost.empty()) diag_.report(Diag::names_lost, {}, "lower-vrml1", lost.count(), lost.text());
}

/// Nodes of VRML 1.0 become others, which have no place for them.
void Lowering::report_unknown_fields() {
  TextList lost;
  for (NodeId n : reachable(scene_, scene_.main)) {
    const NodeId base = scene_.type(n).kind == NodeKind::unknown ? known_base(n) : n;
    if (!scene_.is(base, nodes::Vrml1Node)) continue;
    for (const Value& v : scene_.fields(n))
      if (scene_.is_extra(v) && !v.extra->value.is && v.extra->name != "isA" &&
          !scene_.type(base).find(v.extra->name, Dialect::vrml1))
        lost.add(std::string(scene_.type(n).name) + "." + std::string(v.extra->name));
  }
  if (!lost.empty()) diag_.report(Diag::names_lost, {}, "lower-vrml1", lost.count(), lost.text());
}

bool Lowering::step(NodeId n) {
  if (n.value >= met_.size()) met_.resize(n.value + std::size_t{1});
  if (!std::exchange(met_[n.value], 1)) return true;
  if (steps_left_ > 0) {
    --steps_left_;
    return true;
  }
  if (!std::exchange(full_, true))
    diag_.report(Diag::expansion_limit, scene_.where(n), limit_, "nodes visited again in other states");
  return false;
}

NodeId Lowering::choice(NodeId child, State& s, Frame& frame) {
  visit(child, s, frame);
  if (frame.runs.size() == 1 && frame.runs[0].at.identity() && frame.runs[0].nodes.size() == 1)
    return frame.runs[0].nodes[0];
  NodeId n = group(scene_, frame, scene_.where(child), {});
  return n ? n : scene_.add(nodes::Group, scene_.where(child));
}

void Lowering::leave(Frame& outer, const std::vector<Frame::Light>& lights) {
  for (auto& l : lights)
    if (step(l.source)) shine(outer, l.source, outer.at.matrix() * l.at);
}

void Lowering::shine(Frame& frame, NodeId source, const Matrix& at) {
  frame.add_light(light(scene_, source, at, diag_));
  frame.lights.push_back({source, at});
}

void Lowering::visit(NodeId n, State& s, Frame& frame) {
  if (!n || !step(n)) return;
  if (depth_ >= deepest) return diag_.report(Diag::too_deep, scene_.where(n), deepest);
  ++depth_;
  const auto& type = scene_.type(n);
  auto single = [&](auto make) {
    auto& made = singles_[n];
    if (!made) made = make();
    if (made) frame.add(made);
  };
  if (!type.is_a(nodes::Vrml1Node))
    visit_other(n, s, frame);
  else if (is(n, v1::Environment))
    single([&] { return fog_of(scene_, n, diag_); });
  else if (is(n, v1::ClipPlane)) {
    if (scene_.get(n, v1::clip_plane::on)) shine(frame, n, frame.at.matrix());
  } else if (property(n, s)) {
  } else if (type.is_a(nodes::Vrml1TransformNode))
    visit_transform(n, s, frame);
  else if (type.is_a(nodes::Vrml1ShapeNode))
    visit_shape(n, s, frame);
  else if (type.is_a(nodes::Vrml1LightNode))
    visit_light(n, frame);
  else if (type.is_a(nodes::Vrml1CameraNode))
    single([&] { return viewpoint(scene_, n, diag_); });
  else if (type.is_a(nodes::Vrml1InfoNode))
    single([&] { return info_of(scene_, n); });
  else if (is(n, v1::WWWInline) || is(n, v1::File))
    single([&] { return inline_of(scene_, n); });
  else if (type.is_a(nodes::Vrml1SeparatorNode))
    visit_separator(n, s, frame);
  else if (is(n, v1::Switch) || is(n, v1::Blinker))
    visit_switch(n, s, frame);
  else if (is(n, v1::LOD) || is(n, v1::LevelOfDetail))
    visit_lod(n, s, frame);
  else if (is(n, v1::Array) || is(n, v1::MultipleCopy))
    visit_copies(n, s, frame);
  else if (type.is_a(nodes::Vrml1GroupNode))
    visit_group(n, children_of(n), s, frame);
  --depth_;
}

// ---- state ---------------------------------------------------------------------------------------------------------

/// The first node without a name that is small and equal: exporters write one Material over and over.
NodeId Lowering::first_equal(NodeId n) {
  constexpr std::size_t few = 64;
  if (!scene_.name(n).empty()) return n;
  auto bytes = [](const auto& span) {
    return std::string_view(reinterpret_cast<const char*>(span.data()), span.size_bytes());
  };
  std::string all = std::to_string(scene_.type_id(n).value);
  for (const Value& v : scene_.fields(n)) {
    const Element element = info(v.type).element;
    if (scene_.is_extra(v) || v.count > few || element == Element::node || v.type == FieldType::MFString) return n;
    all += '/' + std::to_string(v.slot) + ' ' + std::to_string(v.count) + ' ';
    all += element == Element::number ? bytes(v.number_span())
           : element == Element::text ? v.text()
                                      : bytes(v.integer_span());
  }
  return equals_.emplace(std::move(all), n).first->second;
}

bool Lowering::property(NodeId n, State& s) {
  const TypeId t = scene_.type_id(n);
  if (t == v1::Coordinate3 || t == v1::Coordinate4)
    s.coord = n;
  else if (t == v1::Normal)
    s.normal = n;
  else if (t == v1::NormalBinding)
    s.normal_binding = read_binding(scene_.get(n, v1::normal_binding::value));
  else if (t == v1::Material) {
    s.material = first_equal(n);
    s.color = {};
  } else if (t == v1::BaseColor || t == v1::PackedColor)
    s.color = first_equal(n);
  else if (t == v1::MaterialBinding)
    s.material_binding = read_binding(scene_.get(n, v1::material_binding::value));
  else if (t == v1::Texture2)
    s.texture = first_equal(n);
  else if (t == v1::Texture2Transform)
    s.texture_transform = looks_.then(s.texture_transform, n);
  else if (t == v1::TextureCoordinate2 || t == v1::TextureCoordinatePlane || t == v1::TextureCoordinateEnvironment)
    s.texture_coord = n;
  else if (t == v1::TextureCoordinateDefault)
    s.texture_coord = {};
  else if (t == v1::TextureCoordinateBinding)
    s.texture_binding = read_binding(scene_.get(n, v1::texture_coordinate_binding::value));
  else if (t == v1::ShapeHints)
    s.hints = first_equal(n);
  else if (t == v1::FontStyle || t == v1::Font)
    s.font = first_equal(n);
  else if (t == v1::LightModel)
    s.lit = scene_.get(n, v1::light_model::model) != "BASE_COLOR";
  else if (t == v1::DrawStyle) {
    const auto style = scene_.get(n, v1::draw_style::style);
    s.drawing = style == "LINES"       ? Drawing::lines
                : style == "POINTS"    ? Drawing::points
                : style == "INVISIBLE" ? Drawing::invisible
                                       : Drawing::filled;
    s.draw_style = says_strokes(scene_, n) ? first_equal(n) : NodeId{};
  } else if (t == v1::PickStyle) {
    if (scene_.get(n, v1::pick_style::style) != "SHAPE")
      diag_.report(Diag::no_vrml97_value, scene_.where(n), "PickStyle", "style");
  } else if (t == v1::ProfileCoordinate2 || t == v1::ProfileCoordinate3 || t == v1::LinearProfile ||
             t == v1::NurbsProfile) {
    diag_.report(Diag::no_vrml97_node, scene_.where(n), scene_.type(n).name);
  } else
    return scene_.is(n, nodes::Vrml1PropertyNode);  // of no effect on what is there: Complexity
  return true;
}

void Lowering::visit_transform(NodeId n, State& s, Frame& frame) {
  if (is(n, v1::MatrixTransform)) {
    frame.at.then(matrix_of_rows(scene_.get(n, v1::matrix_transform::matrix), scene_.where(n), diag_));
  } else if (is(n, v1::Units)) {
    const double before = metres(s.unit), k = metres(scene_.get(n, v1::units::units), s.unit) / before;
    frame.at.then(TransformFields{.scale = {k, k, k}});
  } else
    frame.at.then(transform_of(scene_, n, diag_));
}

void Lowering::visit_shape(NodeId n, const State& s, Frame& frame) {
  const auto& shapes = shapes_.of(n, s);
  if (s.drawing != Drawing::invisible) {
    for (NodeId shape : shapes) frame.add(shape);
  } else if (!shapes.empty()) {  // kept, and not seen
    NodeId hidden = scene_.add(nodes::Switch, scene_.where(n));
    scene_.set(hidden, nodes::switch_::children, shapes);
    frame.add(hidden);
  }
}

void Lowering::visit_light(NodeId n, Frame& frame) {
  if (is(n, v1::DirectionalLight)) return shine(frame, n, frame.at.matrix());
  if (frame.drawn || depth_ > 2) diag_.report(Diag::no_vrml97_light_scope, scene_.where(n), scene_.type(n).name);
  auto& made = singles_[n];
  if (!made) made = light(scene_, n, {}, diag_);
  const bool drawn = frame.drawn;
  frame.add(made);
  frame.drawn = drawn;
}

// ---- groups --------------------------------------------------------------------------------------------------------

// What is in a Group stays in force behind it; behind a TransformSeparator all but the transformation does.
void Lowering::visit_group(NodeId n, std::span<const NodeId> nodes, State& s, Frame& frame) {
  auto known = effects_.find({n, s});
  if (known == effects_.end()) {
    const State before = s;
    Frame inner;
    for (NodeId c : nodes) visit(c, s, inner);
    known = effects_
                .emplace(std::pair{n, before},
                         Effect{group(scene_, inner, scene_.where(n), scene_.name(n)), s, inner.at, inner.lights})
                .first;
  }
  const Effect& e = known->second;
  if (e.drawn) frame.add(e.drawn);
  leave(frame, e.lights);
  s = e.state;
  if (!is(n, v1::TransformSeparator)) frame.at.then(e.at);
}

void Lowering::visit_separator(NodeId n, State s, Frame& frame) {
  auto known = effects_.find({n, s});
  if (known == effects_.end()) {
    const Frame inner = contents(children_of(n), s);
    NodeId made;
    if (is(n, v1::WWWAnchor)) {
      made = scene_.add(nodes::Anchor, scene_.where(n));
      scene_.set_name(made, scene_.name(n));
      if (auto url = scene_.get(n, v1::www_anchor::name); !url.empty())
        scene_.set(made, nodes::anchor::url, std::vector<std::string_view>{url});
      scene_.set(made, nodes::anchor::description, scene_.get(n, v1::www_anchor::description), nodes::anchor::children,
                 children(scene_, inner));
      if (scene_.get(n, v1::www_anchor::map) == "POINT")
        diag_.report(Diag::no_vrml97_value, scene_.where(n), "WWWAnchor", "map");
    } else
      made = group(scene_, inner, scene_.where(n), scene_.name(n));
    known = effects_.emplace(std::pair{n, s}, Effect{made, {}, {}, {}}).first;
  }
  if (known->second.drawn) frame.add(known->second.drawn);
}

/// Of a Switch: the number of its child, -1 (none) or -3 (all). As in Coin, -2 takes that of the last Switch before it
/// in the state, and numbers beyond its children begin again at the first.
std::int32_t Lowering::chosen_of(NodeId n, std::size_t n_children, State& s) const {
  const auto chosen = which_child(scene_, n);
  if (chosen == inherits) {
    const auto count = static_cast<std::int32_t>(n_children);
    return count > 0 && s.chosen >= count ? s.chosen % count : s.chosen;
  }
  if (some_inherit_) s.chosen = chosen;
  return chosen;
}

// The chosen child acts like one of a Group; the others are drawn apart from everything, so that they can be chosen
// later.
void Lowering::visit_switch(NodeId n, State& s, Frame& frame) {
  const auto nodes = children_of(n);
  auto chosen = chosen_of(n, nodes.size(), s);
  if (is(n, v1::Blinker) && scene_.get(n, v1::blinker::on)) {
    diag_.report(Diag::no_vrml97_value, scene_.where(n), "Blinker", "speed");
    if (chosen == none) chosen = 0;  // where it begins
  }
  if (chosen == all) return visit_group(n, nodes, s, frame);
  if (scene_.name(n) == cameras) {  // the viewpoints of the world; the chosen one comes first
    std::vector<NodeId> order(nodes.begin(), nodes.end());
    if (chosen > 0 && static_cast<std::size_t>(chosen) < order.size())
      std::swap(order[0], order[static_cast<std::size_t>(chosen)]);
    for (NodeId c : order) {
      const Placement before = frame.at;
      State own = s;
      visit(c, own, frame);
      frame.at = before;
    }
    return;
  }
  std::vector<NodeId> choices;
  State after = s;
  Frame taken;
  bool any = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    State own = s;
    Frame inner;
    choices.push_back(choice(nodes[i], own, inner));
    any |= !inner.runs.empty();
    if (chosen == static_cast<int>(i)) {
      after = own;
      taken = std::move(inner);
    }
  }
  if (any) {
    NodeId made = scene_.add(nodes::Switch, scene_.where(n));
    scene_.set_name(made, scene_.name(n));
    scene_.set(made, nodes::switch_::children, choices);
    scene_.set(made, nodes::switch_::whichChoice,
               chosen >= 0 && static_cast<std::size_t>(chosen) < nodes.size() ? chosen : none);
    frame.add(made);
  }
  s = after;
  leave(frame, taken.lights);
  frame.at.then(taken.at);
}

void Lowering::visit_lod(NodeId n, const State& s, Frame& frame) {
  std::vector<NodeId> levels;
  for (NodeId c : children_of(n)) {
    State own = s;
    Frame inner;
    levels.push_back(choice(c, own, inner));
  }
  if (levels.empty()) return;
  NodeId made = scene_.add(nodes::LOD, scene_.where(n));
  scene_.set_name(made, scene_.name(n));
  scene_.set(made, nodes::lod::children, levels);
  if (is(n, v1::LOD)) {
    scene_.set(made, nodes::lod::center, scene_.get(n, v1::lod::center), nodes::lod::range,
               scene_.get(n, v1::lod::range));
  } else
    diag_.report(Diag::no_vrml97_value, scene_.where(n), "LevelOfDetail", "screenArea");
  frame.add(made);
}

// Array and MultipleCopy: one node at many places.
void Lowering::visit_copies(NodeId n, const State& s, Frame& frame) {
  const Frame inner = contents(children_of(n), s);
  const NodeId one = group(scene_, inner, scene_.where(n), scene_.name(n));
  if (!one) return;
  auto put = [&](const auto& where) {
    if (!step(n)) return;
    const Placement before = frame.at;
    frame.at.then(where);
    frame.add(one);
    frame.at = before;
  };
  if (is(n, v1::MultipleCopy)) {
    for (auto m = scene_.get(n, v1::multiple_copy::matrix); m.size() >= 16; m = m.subspan(16))
      put(matrix_of_rows(m.first(16), scene_.where(n), diag_));
    return;
  }
  namespace a = v1::array;
  const int count[] = {scene_.get(n, a::numElements1), scene_.get(n, a::numElements2), scene_.get(n, a::numElements3)};
  const Vec3 apart[] = {scene_.get(n, a::separation1), scene_.get(n, a::separation2), scene_.get(n, a::separation3)};
  const double origin = scene_.get(n, a::origin) == "CENTER" ? 0.5 : scene_.get(n, a::origin) == "LAST" ? 1 : 0;
  for (int k = 0; k < count[2] && !full_; ++k)
    for (int j = 0; j < count[1] && !full_; ++j)
      for (int i = 0; i < count[0] && !full_; ++i) {
        TransformFields t;
        const int at[] = {i, j, k};
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t d = 0; d < 3; ++d) t.translation[c] += (at[d] - origin * (count[d] - 1)) * apart[d][c];
        put(t);
      }
}

}  // namespace vrml1

Outcome lower_vrml1(Scene& scene, const LowerVrml1Options& options, PassContext& ctx) {
  vrml1::Lowering lowering(scene, options, ctx);
  if (scene.format == Format::vrml1)
    lowering.run();
  else if (scene.format == Format::vrml97 && vrml1::has_state(scene))
    lowering.run_among_vrml97();
  else
    return Outcome::unchanged;
  return Outcome::changed;
}

}  // namespace wrlkit
