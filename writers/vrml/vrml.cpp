#include "writers/vrml/vrml.h"

#include <algorithm>
#include <utility>

#include "geometry/forms/form_faces.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "writers/text/document.h"

namespace wrlkit {
namespace {

class VrmlWriter : TextDocument {
 public:
  VrmlWriter(const Scene& scene, const TextOptions& options, const Sink& sink, Diagnostics& diag)
      : TextDocument(scene,
                     {.dialect = Dialect::vrml97,
                      .yes = "TRUE",
                      .no = "FALSE",
                      .between_tuples = scene.format == Format::vrml1 ? "," : ""},
                     options.own_fields, options.precision, sink, diag),
        options_(options) {}

  void file() {
    out_ << (!vrml1_                 ? "#VRML V2.0 utf8"
             : scene_.header.empty() ? "#VRML V1.0 ascii"
                                     : scene_.header)
         << '\n'
         << scene_.comment;
    names_.scope(scene_.main);
    scope(scene_.main);
    end();
  }

 private:
  void scope(const Scope& s) {
    for_each_statement(
        scene_, Dialect::vrml97, names_.unknown(), s,
        [&](ProtoId p) {
          line_start();
          proto(scene_.proto(p));
        },
        [&](NodeId n) {
          line_start();
          node(n);
        });
    for (auto& r : s.routes) {
      if (!is_printed(r.from) || !is_printed(r.to)) continue;
      line_start();
      out_ << "ROUTE " << names_[r.from] << '.' << r.event_out << " TO " << names_[r.to] << '.' << r.event_in;
    }
    if (depth_ == 0) out_ << '\n';
  }

  // The header line and the comments end with a line feed of their own.
  void line_start() {
    if (depth_ > 0 || !first_) line();
    first_ = false;
  }

  void proto(const Proto& p) {
    const auto& t = scene_.type(p.type);
    out_ << (p.external ? "EXTERNPROTO " : "PROTO ") << t.name << " [";
    indented([&] {
      for (std::uint16_t slot = 0; slot < t.fields.size(); ++slot) parameter(p, slot);
    });
    if (!t.fields.empty()) line();
    out_ << "] ";
    if (p.external) {
      urls(p.where, p.urls, UrlUse::world);
      return;
    }
    out_ << '{';
    indented([&] { body([&] { scope(p.body); }); });
    line() << '}';
  }

  void parameter(const Proto& p, std::uint16_t slot) {
    const auto& f = scene_.type(p.type).fields[slot];
    declaration(f);
    if (p.external || !f.has_value()) return;
    out_ << ' ';
    if (const auto use = url_use(p.type, slot, f.default_value); use != UrlUse::none)
      urls(p.where, f.default_value.text_span(), use);
    else
      value(f.default_value);
  }

  void declaration(const FieldDef& f) {
    constexpr std::string_view words[] = {"field ", "exposedField ", "eventIn ", "eventOut "};
    line() << words[static_cast<int>(f.access)] << info(f.type).name << ' ' << f.name;
  }

  void node(NodeId n) {
    if (!n) {
      out_ << "NULL";
      return;
    }
    auto name = names_[n];
    if (is_printed(n)) {
      out_ << "USE " << name;
      return;
    }
    set_printed(n);
    if (!name.empty()) out_ << "DEF " << name << ' ';
    out_ << scene_.type(n).name << " {";
    bool empty = true;
    indented([&] { empty = !fields(n); });
    if (!empty) line();
    out_ << '}';
  }

  /// False: there are none but defaults.
  bool fields(NodeId n) {
    bool any = vrml1_ && declarations(n);
    const auto own = own_fields(scene_.type(n));
    const auto written = names_.printed_order(n);
    for (const Value* v : written)
      if (v->slot < own) any |= field(n, *v);
    for (std::size_t i = own; i < scene_.type(n).fields.size(); ++i) {
      own_field(n, static_cast<std::uint16_t>(i));
      any = true;
    }
    for (const bool children : {true, false})  // before fields without a value, which would take a node for it
      for (const Value* v : written)
        if (scene_.is_extra(*v) && is_children(n, *v) == children) any |= field(n, *v);
    return any;
  }

  /// VRML 1.0: the fields that a node describes itself, but for nodes and isA. False: there are none.
  bool declarations(NodeId n) {
    std::vector<const ExtraField*> own;
    for (const Value& v : scene_.fields(n))
      if (scene_.is_extra(v) && v.extra->value.type != FieldType::verbatim &&
          info(v.extra->value.type).element != Element::node && v.extra->name != "isA")
        own.push_back(v.extra);
    if (own.empty()) return false;
    line() << "fields [ ";
    for (std::size_t i = 0; i < own.size(); ++i)
      out_ << (i ? ", " : "") << info(own[i]->value.type).name << ' ' << own[i]->name;
    out_ << " ]";
    return true;
  }

  /// VRML 1.0: children have no field in the file. False: these are none.
  bool children(NodeId n, const Value& v) {
    if (!is_children(n, v)) return false;
    lines_of(scene_.content(v).node_span());
    return true;
  }

  bool is_children(NodeId n, const Value& v) const {
    const auto& t = scene_.type(n);
    const bool here = t.is_a(nodes::Vrml1Node) || (vrml1_ && t.dialects & static_cast<DialectSet>(Dialect::vrml1));
    return here && scene_.field_name(n, v) == "children" && scene_.content(v).type == FieldType::MFNode;
  }

  /// False when it is equal to the default.
  bool field(NodeId n, const Value& v) {
    const auto& t = scene_.type(n);
    if (children(n, v)) return scene_.content(v).count > 0;
    if (scene_.is_extra(v)) {
      line() << v.extra->name;
      if (const auto& c = v.extra->value; c.is || c.type != FieldType::verbatim || c.count) {
        out_ << ' ';
        unknown_content(c);
      }
      return true;
    }
    const auto& f = t.fields[v.slot];
    if (t.kind != NodeKind::proto && !v.is && equals_default(v, f) && !shares_name_with_x3d(t)) return false;
    line() << f.name_in(t.dialects & static_cast<DialectSet>(Dialect::vrml1) ? Dialect::vrml1 : Dialect::vrml97) << ' ';
    if (const auto use = url_use(scene_.type_id(n), v.slot, v); use != UrlUse::none)
      urls(scene_.where(n), v.text_span(), use);
    else
      content(v);
    return true;
  }

  /// A node of VRML 1.0 among those of VRML97 is told from the one of X3D by its fields: none may be left out.
  bool shares_name_with_x3d(const NodeType& t) const {
    const bool only_vrml1 = t.kind == NodeKind::builtin && t.dialects == static_cast<DialectSet>(Dialect::vrml1);
    return !vrml1_ && only_vrml1 && find_builtin(t.name, Dialect::x3d);
  }

  void urls(Span where, std::span<const std::string_view> list, UrlUse use) {
    const auto led = led_urls(scene_, where, list, use, {options_.file, options_.place, options_.copy});
    strings(std::vector<std::string_view>(led.begin(), led.end()));
  }

  /// A field or event that a Script declares.
  void own_field(NodeId n, std::uint16_t slot) {
    const auto& f = scene_.type(n).fields[slot];
    declaration(f);
    if (const Value* v = scene_.find(n, slot)) {
      out_ << ' ';
      content(*v);
    } else if (f.has_value()) {
      out_ << ' ';
      value(f.default_value);
    }
  }

  void content(const Value& v) {
    if (v.is)
      out_ << "IS " << v.text();
    else
      value(v);
  }

  /// The content of an unknown field: only the brackets distinguish a list of one node from a node.
  void unknown_content(const Value& v) {
    if (v.is || v.type != FieldType::MFNode || v.count != 1) return content(v);
    out_ << "[ ";
    node(v.nodes[0]);
    out_ << " ]";
  }

  void value(const Value& v) {
    const auto& t = info(v.type);
    switch (t.element) {
      case Element::node:
        return t.multiple ? node_list(v.node_span()) : node(v.node);
      case Element::text:
        if (v.type == FieldType::verbatim || v.type == FieldType::SFEnum)
          out_ << v.text();
        else if (v.type == FieldType::SFBitMask)
          out_ << '(' << v.text() << ')';
        else if (t.multiple)
          strings(v.text_span());
        else
          string(v.text());
        return;
      default:
        if (t.multiple) out_ << '[';
        numbers(v);
        if (t.multiple) out_ << ']';
    }
  }

  void string(std::string_view s) {
    quoted(s, [&](std::string_view part) { out_ << part; });
  }

  void strings(std::span<const std::string_view> v) {
    if (v.size() == 1) return string(v[0]);
    out_ << '[';
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (i) out_ << (vrml1_ ? ", " : " ");
      string(v[i]);
    }
    out_ << ']';
  }

  void lines_of(std::span<const NodeId> nodes) {
    for (NodeId n : nodes) {
      line();
      node(n);
    }
  }

  void node_list(std::span<const NodeId> v) {
    if (v.size() == 1 && v[0]) return node(v[0]);
    out_ << '[';
    indented([&] { lines_of(v); });
    if (!v.empty()) line();
    out_ << ']';
  }

  const bool vrml1_ = scene_.format == Format::vrml1;
  TextOptions options_;
  bool first_ = true;
};

}  // namespace

void write_vrml(const Scene& scene, const TextOptions& options, const Sink& sink, Diagnostics& diag) {
  const auto faces = options.own_fields ? std::nullopt : with_form_faces(scene);
  VrmlWriter(faces ? *faces : scene, options, sink, diag).file();
}

}  // namespace wrlkit
