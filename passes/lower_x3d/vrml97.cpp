#include "passes/lower_x3d/vrml97.h"

#include <algorithm>
#include <map>
#include <string>

#include "passes/lower_x3d/geometry.h"
#include "passes/lower_x3d/texture_background.h"
#include "passes/lower_x3d/vrml97_names.h"
#include "scenegraph/access_word.h"
#include "scenegraph/equal.h"
#include "scenegraph/looks/texture_sampler.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

constexpr auto in_vrml97 = static_cast<DialectSet>(Dialect::vrml97);

class Vrml97Lowering {
 public:
  Vrml97Lowering(Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag) {}

  bool run() {
    const auto all = all_nodes(scene_);
    for (NodeId n : all) {
      color(n);
      borders(n);
    }
    for (NodeId n : all) changed_ |= lower_texture_background(scene_, n, diag_);
    for (NodeId n : all) foreign_children(n);
    for (NodeId n : all) foreign_fields(n);
    for (NodeId n : all) foreign_node(n);
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i)
      interface(scene_.type(scene_.proto(ProtoId{i}).type), 0, scene_.proto(ProtoId{i}).where);
    const auto of_scripts = builtin_nodes()[nodes::Script.value].fields.size();
    for (NodeId n : all)
      if (scene_.type(n).kind == NodeKind::script) interface(scene_.type(n), of_scripts, scene_.where(n));
    for_each_scope(scene_, [&](Scope& s) { routes(s); });
    changed_ |= give_legal_names(scene_, diag_);
    report();
    return head() || changed_;
  }

 private:
  bool builtin(NodeId n) const { return scene_.type(n).kind == NodeKind::builtin; }
  bool foreign(NodeId n) const {
    return n && builtin(n) && !(scene_.type(n).dialects & in_vrml97) && !scene_.type(n).is_own();
  }

  void color(NodeId n) {
    if (!scene_.is(n, nodes::ColorRGBA)) return;
    std::vector<double> rgb;
    const auto rgba = scene_.get(n, nodes::color_rgba::color);
    bool opaque = true;
    for (std::size_t i = 0; i < rgba.size(); ++i) {
      if (i % 4 < 3)
        rgb.push_back(rgba[i]);
      else
        opaque &= rgba[i] == 1;
    }
    if (!opaque) diag_.report(Diag::no_vrml97_value, scene_.where(n), "ColorRGBA", "color (opacity)");
    auto fields = fields_for(scene_, n, nodes::Color);
    fields.push_back(scene_.make(FieldType::MFColor, nodes::color::color.slot, rgb));
    scene_.become(n, nodes::Color, fields);
    changed_ = true;
  }

  /// What TextureProperties say of the border of a picture, as far as repeatS
  /// and repeatT can.
  void borders(NodeId n) {
    if (!texture_properties(scene_, n)) return;
    namespace i = nodes::image_texture;
    namespace p = nodes::pixel_texture;
    const TextureSampler sampler = read_sampler(scene_, n);
    const bool s = sampler.s != Wrap::clamp, t = sampler.t != Wrap::clamp;
    if (scene_.is(n, nodes::ImageTexture)) scene_.set(n, i::repeatS, s, i::repeatT, t);
    if (scene_.is(n, nodes::PixelTexture)) scene_.set(n, p::repeatS, s, p::repeatT, t);
  }

  // ---- what has none ----
  void lose(NodeId n) { lose(n, scene_.type(n).name); }
  void lose(NodeId n, std::string_view what) {
    if (lost_.empty()) first_lost_ = scene_.where(n);
    ++lost_[what];
  }

  /// Nodes that VRML97 does not have, in fields that it has.
  void foreign_children(NodeId n) {
    const auto fields = scene_.copy_of_fields(n);
    for (const Value& v : fields) {
      if (scene_.is_extra(v) || v.is || info(v.type).element != Element::node) continue;
      auto stays = [&](NodeId c) { return !foreign(c) || scene_.is(c, nodes::X3DChildNode); };
      const auto held = v.node_span();
      if (std::ranges::all_of(held, stays)) continue;
      std::vector<NodeId> kept;
      for (NodeId c : held) stays(c) ? kept.push_back(c) : lose(c);
      if (v.type == FieldType::SFNode || kept.empty())
        scene_.unset(n, v.slot);
      else
        scene_.set(n, scene_.make(v.type, v.slot, kept));
      changed_ = true;
    }
  }

  void foreign_fields(NodeId n) {
    const auto& t = scene_.type(n);
    if (t.kind != NodeKind::builtin && t.kind != NodeKind::script) return;
    if (t.is_a(nodes::X3DMetadataObject)) return;  // lost as a whole
    const auto fields = scene_.copy_of_fields(n);
    for (const Value& v : fields) {
      if (scene_.is_extra(v) || t.fields[v.slot].is_own() || (t.fields[v.slot].dialects & in_vrml97)) continue;
      const auto& f = t.fields[v.slot];
      if (v.is || !equals_default(v, f)) diag_.report(Diag::no_vrml97_value, scene_.where(n), t.name, f.name);
      scene_.unset(n, v.slot);
      changed_ = true;
    }
  }

  /// Children of groups: an empty Group of that name, so that USE still finds
  /// something.
  void foreign_node(NodeId n) {
    if (!foreign(n) || !scene_.is(n, nodes::X3DChildNode)) return;
    lose(n);
    dropped_.resize(scene_.node_count());
    dropped_[n.value] = 1;
    scene_.become(n, nodes::Group, {});
    changed_ = true;
  }

  static bool is_vrml97(FieldType type) {
    constexpr FieldType known[] = {
        FieldType::SFBool,   FieldType::SFInt32,  FieldType::MFInt32, FieldType::SFFloat,    FieldType::MFFloat,
        FieldType::SFTime,   FieldType::MFTime,   FieldType::SFVec2f, FieldType::MFVec2f,    FieldType::SFVec3f,
        FieldType::MFVec3f,  FieldType::SFColor,  FieldType::MFColor, FieldType::SFRotation, FieldType::MFRotation,
        FieldType::SFString, FieldType::MFString, FieldType::SFNode,  FieldType::MFNode,     FieldType::SFImage};
    return std::ranges::find(known, type) != std::end(known);
  }

  /// The fields from that slot on are declared in the file. In VRML97 those of
  /// a Script are no exposedFields (6.40), though its readers may take them.
  void interface(const NodeType& t, std::size_t first, Span where) {
    for (const auto& f : t.fields.subspan(first)) {
      if (!is_vrml97(f.type))
        no_value(where, t, f, info(f.type).name);
      else if (t.kind == NodeKind::script && f.access == Access::inout && scene_.format != Format::vrml97)
        no_value(where, t, f, access_word(f.access, Dialect::x3d));
    }
  }

  void no_value(Span where, const NodeType& t, const FieldDef& f, std::string_view what) {
    diag_.report(Diag::no_vrml97_value, where, t.name, std::string(f.name) + " (" + std::string(what) + ")");
  }

  // ---- ROUTEs ----
  void links(Scope& s) {
    dropped_.resize(scene_.node_count());
    for (const Import& i : s.imports) {
      lose(i.node);
      dropped_[i.node.value] = 1;
    }
    for (const Export& e : s.exports) lose(e.node, "EXPORT");
    changed_ |= !s.imports.empty() || !s.exports.empty();
    s.imports.clear();
    s.exports.clear();
  }

  bool is_dropped(NodeId n) const { return n.value < dropped_.size() && dropped_[n.value]; }

  /// The event under its VRML97 name; empty: VRML97 has none.
  std::string_view event(NodeId n, std::string_view name) {
    const auto& t = scene_.type(n);
    if (t.kind != NodeKind::builtin) return name;
    auto slot = t.find(name, scene_.dialect(), true);
    if (!slot) return name;
    const auto& f = t.fields[*slot];
    if (!(f.dialects & in_vrml97)) return {};
    const auto at = name.find(f.name);
    const bool has_its_name = at == name.npos || f.vrml97_name.empty() || scene_.dialect() == Dialect::vrml97;
    if (has_its_name) return name;
    std::string s(name);
    s.replace(at, f.name.size(), f.vrml97_name);
    return scene_.keep(s);
  }

  void routes(Scope& s) {
    links(s);
    std::vector<Route> kept;
    for (Route r : s.routes) {
      const Route old = r;
      r.event_out = event(r.from, r.event_out);
      r.event_in = event(r.to, r.event_in);
      if (is_dropped(r.from) || is_dropped(r.to)) {
        ++lost_["ROUTE"];
        continue;
      }
      if (r.event_out.empty()) {
        diag_.report(Diag::no_vrml97_value, scene_.where(r.from), scene_.type(r.from).name, old.event_out);
        continue;
      }
      if (r.event_in.empty()) {
        diag_.report(Diag::no_vrml97_value, scene_.where(r.to), scene_.type(r.to).name, old.event_in);
        continue;
      }
      kept.push_back(r);
    }
    changed_ |= kept != s.routes;
    s.routes = std::move(kept);
  }

  void report() {
    std::string types;
    for (const auto& [type, n] : lost_)
      (types += types.empty() ? "" : ", ") += std::string(type) + (n > 1 ? " (" + std::to_string(n) + ")" : "");
    if (!lost_.empty()) diag_.report(Diag::no_vrml97_node, first_lost_, types);
  }

  bool head() {
    const bool is_x3d = scene_.format == Format::x3d_xml || scene_.format == Format::x3d_classic;
    if (!is_x3d && scene_.x3d.meta.empty()) return false;
    auto line = [](std::string s) {
      std::ranges::replace_if(
          s, [](char c) { return c == '\n' || c == '\r'; }, ' ');
      return s;
    };
    for (const auto& [name, content] : scene_.x3d.meta)
      scene_.comment += "# " + line(name) + ": " + line(content) + "\n";
    scene_.x3d = {};
    if (is_x3d) scene_.format = Format::vrml97;
    return true;
  }

  Scene& scene_;
  Diagnostics& diag_;
  std::map<std::string_view, std::size_t> lost_;
  Span first_lost_;
  std::vector<char> dropped_;
  bool changed_ = false;
};

}  // namespace

bool lower_to_vrml97(Scene& scene, Diagnostics& diag) { return Vrml97Lowering(scene, diag).run(); }

}  // namespace wrlkit::x3d
