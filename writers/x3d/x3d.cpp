#include "writers/x3d/x3d.h"

#include <algorithm>
#include <utility>

#include "base/text/blanks.h"
#include "base/text/vrml_value.h"
#include "base/text/xml_characters.h"
#include "base/text/xml_text.h"
#include "geometry/forms/form_faces.h"
#include "scenegraph/access_word.h"
#include "scenegraph/container_field.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "scenegraph/x3d_version.h"
#include "writers/text/document.h"
#include "writers/x3d/x3d_profile.h"

namespace wrlkit {
namespace {

bool number_like(std::string_view s) {
  return s == "true" || s == "false" || s.find_first_not_of("+-.0123456789eE, ") == s.npos;
}

class X3dWriter : TextDocument {
 public:
  X3dWriter(const Scene& scene, const TextOptions& options, const Sink& sink, Diagnostics& diag)
      : TextDocument(scene, {.dialect = Dialect::x3d, .yes = "true", .no = "false", .wraps_images = true},
                     options.own_fields, options.precision, sink, diag),
        options_(options),
        version_(x3d_version(scene)) {}

  void file() {
    const auto profile = x3d_profile(scene_);
    const std::string version = std::to_string(version_ / 10) + '.' + std::to_string(version_ % 10);
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE X3D PUBLIC \"ISO//Web3D//DTD X3D " << version
         << "//EN\" \"https://www.web3d.org/specifications/x3d-" << version << ".dtd\">\n";
    comment();
    out_ << "<X3D profile='" << profile.name << "' version='" << version
         << "' xmlns:xsd='http://www.w3.org/2001/XMLSchema-instance' "
            "xsd:noNamespaceSchemaLocation='https://www.web3d.org/specifications/x3d-"
         << version << ".xsd'>";
    head(profile);
    names_.scope(scene_.main);
    indented([&] { element("Scene", [&] { scope(scene_.main); }); });
    line() << "</X3D>\n";
    if (const auto n = characters_.n_replaced()) diag_.report(Diag::x3d_character, replaced_at_, n);
    end();
  }

 private:
  /// A text as XML can hold it, until the next one. Where the first one stood that it could not is remembered.
  std::string_view characters(std::string_view text) {
    const auto before = characters_.n_replaced();
    const auto held = characters_.only(text);
    if (before == 0 && characters_.n_replaced() > 0) replaced_at_ = at_;
    return held;
  }

  /// Inside of an attribute.
  void attribute_text(std::string_view text) { xml_attribute_text(out_, characters(text)); }

  /// Names and texts in turn.
  template <class... More>
  void attribute(std::string_view name, std::string_view text, const More&... more) {
    out_ << ' ' << name << "='";
    attribute_text(text);
    out_ << '\'';
    if constexpr (sizeof...(more) > 0) attribute(more...);
  }

  /// An element with nothing in it but attributes.
  template <class... Attributes>
  void empty_element(std::string_view name, const Attributes&... attributes) {
    line() << '<' << name;
    attribute(attributes...);
    out_ << "/>";
  }

  /// An element without attributes; `content` prints what is in it.
  template <class Print>
  void element(std::string_view name, Print content) {
    line() << '<' << name << '>';
    indented(content);
    line() << "</" << name << '>';
  }

  // ---- the document ----

  /// The lines without their '#'.
  void comment() {
    std::string_view rest = scene_.comment;
    if (rest.empty()) return;
    std::string text;
    for (; !rest.empty(); rest.remove_prefix(std::min(rest.size(), rest.find('\n') + 1))) {
      auto l = rest.substr(0, rest.find('\n'));
      text += l.substr(std::min<std::size_t>(l.size(), 1));
      if (rest.find('\n') == rest.npos) break;
      text += '\n';
    }
    for (std::size_t at; (at = text.find("--")) != text.npos;) text.insert(at + 1, " ");
    if (!text.ends_with('\n')) text += '\n';
    out_ << "<!--\n" << characters(text) << "-->\n";
  }

  void head(const X3dProfile& profile) {
    if (profile.beyond.empty() && scene_.x3d.meta.empty()) return;
    const auto content = [&] {
      for (const auto& [name, level] : profile.beyond)
        empty_element("component", "name", name, "level", std::to_string(level));
      for (const auto& [name, text] : scene_.x3d.meta) empty_element("meta", "name", name, "content", text);
    };
    indented([&] { element("head", content); });
  }

  void scope(const Scope& s) {
    for_each_statement(
        scene_, Dialect::x3d, names_.unknown(), s, [&](ProtoId p) { proto(scene_.proto(p)); },
        [&](NodeId n) { node(n, {}); });
    for (auto& i : s.imports) {
      if (!is_printed(i.inline_node)) continue;
      set_printed(i.node);
      empty_element("IMPORT", "inlineDEF", names_[i.inline_node], "importedDEF", i.exported, "AS", names_[i.node]);
    }
    for (auto& r : s.routes)
      if (is_printed(r.from) && is_printed(r.to))
        empty_element("ROUTE", "fromNode", names_[r.from], "fromField", event(r.from, r.event_out), "toNode",
                      names_[r.to], "toField", event(r.to, r.event_in));
    for (auto& e : s.exports)
      if (is_printed(e.node)) empty_element("EXPORT", "localDEF", names_[e.node], "AS", e.name);
  }

  /// The name of an event of a node in X3D.
  std::string event(NodeId n, std::string_view name) const {
    std::string s(name);
    const auto& t = scene_.type(n);
    auto slot = t.find(name, scene_.dialect(), true);
    if (!slot || t.kind != NodeKind::builtin) return s;
    const auto& f = t.fields[*slot];
    if (auto old = f.name_in(scene_.dialect()); old != f.name) s.replace(s.find(old), old.size(), f.name);
    return s;
  }

  // ---- prototypes ----

  void proto(const Proto& p) {
    const auto& t = scene_.type(p.type);
    const std::string_view tag = p.external ? "ExternProtoDeclare" : "ProtoDeclare";
    line() << '<' << tag;
    attribute("name", t.name);
    if (p.external) {
      out_ << " url='";
      urls(p.where, p.urls, UrlUse::world);
      out_ << '\'';
    }
    out_ << '>';
    const auto parameters = [&] {
      for (std::uint16_t slot = 0; slot < t.fields.size(); ++slot) parameter(p, slot);
    };
    indented([&] {
      if (p.external) return parameters();
      if (!t.fields.empty()) element("ProtoInterface", parameters);
      element("ProtoBody", [&] { body([&] { scope(p.body); }); });
    });
    line() << "</" << tag << '>';
  }

  void parameter(const Proto& p, std::uint16_t slot) {
    const auto& f = scene_.type(p.type).fields[slot];
    const auto use = url_use(p.type, slot, f.default_value);
    if (p.external || !f.has_value() || use == UrlUse::none)
      return declaration(f, p.external ? nullptr : &f.default_value);
    begin_declaration(f);
    end_with_urls(p.where, f.default_value, use);
  }

  void end_with_urls(Span where, const Value& v, UrlUse use) {
    out_ << " value='";
    urls(where, v.text_span(), use);
    out_ << "'/>";
  }

  void begin_declaration(const FieldDef& f) {
    line() << "<field";
    attribute("name", f.name, "type", info(f.type).name, "accessType", access_word(f.access, Dialect::x3d));
  }

  void declaration(const FieldDef& f, const Value* v) {
    begin_declaration(f);
    end_with_value("field", f.has_value() ? v : nullptr);
  }

  /// The value of a field or fieldValue element, and its end.
  void end_with_value(std::string_view element, const Value* v) {
    const bool nodes = v && info(v->type).element == Element::node;
    if (v && !nodes) {
      out_ << " value='";
      value(*v);
      out_ << '\'';
    }
    if (!nodes || v->node_span().empty()) {
      out_ << "/>";
      return;
    }
    out_ << '>';
    indented([&] {
      for (NodeId n : v->node_span()) node(n, {});
    });
    line() << "</" << element << '>';
  }

  // ---- nodes ----

  /// `field`: of the node around it; empty where no field needs to be named. Of metadata the default depends on the
  /// version.
  void node(NodeId n, std::string_view field) {
    if (!n) return;
    at_ = scene_.where(n);
    const auto& t = scene_.type(n);
    const bool instance = t.kind == NodeKind::proto;
    const auto element = instance ? std::string_view("ProtoInstance") : element_name(n);
    line() << '<' << element;
    if (instance) attribute("name", t.name);
    auto name = names_[n];
    const bool use = is_printed(n);
    if (!name.empty()) attribute(use ? "USE" : "DEF", name);
    if (!field.empty() && (field != container_field(scene_, n) || t.is_a(nodes::X3DMetadataObject)))
      attribute("containerField", field);
    if (use) {
      out_ << "/>";
      return;
    }
    set_printed(n);
    if (!instance) attributes(n);
    if (!has_content(n)) {
      out_ << "/>";
      return;
    }
    out_ << '>';
    indented([&] { instance ? field_values(n) : children(n); });
    at_ = scene_.where(n);
    line() << "</" << element << '>';
  }

  /// Anything that stands between the tags.
  bool has_content(NodeId n) const {
    const auto& t = scene_.type(n);
    if (t.kind == NodeKind::proto) return !scene_.fields(n).empty();
    return own_fields(t) < t.fields.size() || std::ranges::any_of(names_.printed_order(n), [&](const Value* v) {
             const auto& c = scene_.content(*v);
             return c.is || !c.node_span().empty() || program(n, *v);
           });
  }

  std::string_view element_name(NodeId n) {
    auto name = scene_.type(n).name;
    if (is_xml_name(name)) return name;
    diag_.report(Diag::no_x3d_value, scene_.where(n), "type name", name);
    return "Group";
  }

  bool says_default(const Value& v, const FieldDef& f) const {
    if (info(v.type).element == Element::node) return v.node_span().empty();
    return equal_plain(v, f.x3d_default_in(version_));
  }

  void attributes(NodeId n) {
    const auto& t = scene_.type(n);
    const auto own = own_fields(t);
    for (const Value* v : names_.printed_order(n)) {
      if (scene_.is_extra(*v)) {
        extra_attribute(n, *v);
        continue;
      }
      const auto& f = t.fields[v->slot];
      if (v->slot >= own || v->is || info(v->type).element == Element::node || says_default(*v, f) || program(n, *v))
        continue;
      field_attribute(n, f, *v, url_use(scene_.type_id(n), v->slot, *v));
    }
    if (t.kind != NodeKind::builtin) return;
    for (const auto& f : t.fields)  // what the reader would take for another default
      if (f.x3d_from && version_ >= f.x3d_from && !scene_.find(n, f.x3d_default.slot))
        field_attribute(n, f, f.default_value, UrlUse::none);
  }

  void field_attribute(NodeId n, const FieldDef& f, const Value& v, UrlUse use) {
    out_ << ' ' << f.name << "='";
    if (use != UrlUse::none)
      urls(scene_.where(n), v.text_span(), use);
    else
      value(v);
    out_ << '\'';
  }

  /// An attribute of that name stands in the tag already.
  bool is_written_before(NodeId n, const Value& v) const {
    const auto& fields = scene_.type(n).fields;
    for (const Value* other : names_.printed_order(n)) {
      if (other == &v) break;
      if (scene_.field_name(n, *other) == v.extra->name) return true;
    }
    return std::ranges::any_of(
        fields, [&](const FieldDef& f) { return f.name == v.extra->name && f.x3d_from && version_ >= f.x3d_from; });
  }

  /// A field that nobody knows.
  void extra_attribute(NodeId n, const Value& v) {
    const auto& c = v.extra->value;
    if (c.is || (info(c.type).element == Element::node && is_xml_name(v.extra->name)))
      return;  // stands among the children
    const auto name = v.extra->name;
    const bool reserved = name.starts_with("xml") || name == "DEF" || name == "USE" || name == "containerField" ||
                          name == "class" || name == "id" || name == "style";
    const bool is_node = info(c.type).element == Element::node;
    if (!is_xml_name(name) || reserved || is_node || is_written_before(n, v))
      return diag_.report(Diag::no_x3d_value, scene_.where(n), name, scene_.type(n).name);
    if (c.type == FieldType::verbatim) return attribute(name, as_xml(without_brackets(c.text())));
    out_ << ' ' << name << "='";
    value(c);
    out_ << '\'';
  }

  /// XML has no brackets around lists.
  static std::string_view without_brackets(std::string_view s) {
    if (!s.starts_with('[') || !s.ends_with(']')) return s;
    const auto list = s.substr(1, s.size() - 2);
    return list == R"("")" || is_bare_list_of_strings(list) ? list : s;
  }

  /// A value whose type nobody knows, as VRML writes it: a single string needs no quotes here, and truth is written
  /// small.
  static std::string_view as_xml(std::string_view s) {
    if (s == "TRUE") return "true";
    if (s == "FALSE") return "false";
    if (s == R"("")") return {};
    const bool string = s.size() > 2 && s.front() == '"' && s.find_first_of("\"\\", 1) == s.size() - 1;
    return string && s.find_first_of("[{\"", 1) == s.size() - 1 && s[1] > ' ' && s[s.size() - 2] > ' ' &&
                   !number_like(s.substr(1, s.size() - 2))
               ? s.substr(1, s.size() - 2)
               : s;
  }

  void children(NodeId n) {
    const auto& t = scene_.type(n);
    const auto own = own_fields(t);
    const auto written = names_.printed_order(n);
    for (std::size_t i = own; i < t.fields.size(); ++i) {
      const Value* v = scene_.find(n, static_cast<std::uint16_t>(i));
      declaration(t.fields[i], v && v->is ? nullptr : v ? v : &t.fields[i].default_value);
    }
    connections(n, written);
    for (const Value* v : written) {
      const auto& c = scene_.content(*v);
      const bool extra = scene_.is_extra(*v);
      if (c.is || info(c.type).element != Element::node || (!extra && v->slot >= own) ||
          (extra && !is_xml_name(v->extra->name)))
        continue;
      for (NodeId m : c.node_span()) node(m, extra ? v->extra->name : t.fields[v->slot].name);
    }
    for (const Value* v : written)
      if (program(n, *v)) line() << "<![CDATA[" << characters(v->text_span()[0]) << "]]>";
  }

  void connections(NodeId n, const std::vector<const Value*>& written) {
    bool any = false;
    for (const Value* v : written) {
      const auto& c = scene_.content(*v);
      if (!c.is) continue;
      if (!std::exchange(any, true)) {
        line() << "<IS>";
        ++depth_;
      }
      const auto& fields = scene_.type(n).fields;
      const auto name = scene_.is_extra(*v) ? event(n, v->extra->name) : std::string(fields[v->slot].name);
      empty_element("connect", "nodeField", name, "protoField", c.text());
    }
    if (any) {
      --depth_;
      line() << "</IS>";
    }
  }

  /// The program of a Script that can be written as it is: nothing of it would be lost behind CDATA.
  bool program(NodeId n, const Value& v) const {
    if (scene_.type(n).name != "Script" || scene_.is_extra(v) || v.is || v.slot != nodes::script::url.slot ||
        v.count != 1)
      return false;
    const auto s = v.text_span()[0];
    const bool inside = s.starts_with("javascript:") || s.starts_with("ecmascript:") || s.starts_with("vrmlscript:");
    return inside && s.find("]]>") == s.npos && s.find('\r') == s.npos && !trim(s).empty();
  }

  void field_values(NodeId n) {
    const auto& t = scene_.type(n);
    const auto written = names_.printed_order(n);
    connections(n, written);
    for (const Value* v : written) {
      const auto& c = scene_.content(*v);
      if (c.is) continue;
      if (scene_.is_extra(*v) && info(c.type).element != Element::node && c.type != FieldType::verbatim) continue;
      line() << "<fieldValue";
      attribute("name", scene_.is_extra(*v) ? v->extra->name : t.fields[v->slot].name);
      const auto use = scene_.is_extra(*v) ? UrlUse::none : url_use(scene_.type_id(n), v->slot, *v);
      if (use == UrlUse::none)
        end_with_value("fieldValue", &c);
      else
        end_with_urls(scene_.where(n), c, use);
    }
  }

  // ---- values, between apostrophes ----

  void value(const Value& v) {
    const auto& t = info(v.type);
    if (t.element == Element::node) return;
    if (t.element != Element::text)
      numbers(v);
    else if (t.multiple)
      strings(v.text_span());
    else
      attribute_text(v.text());
  }

  template <class S>
  void strings(const S& list) {
    bool first = true;
    for (std::string_view s : list) {
      if (!std::exchange(first, false)) out_ << ' ';
      quoted(s, [&](std::string_view part) { attribute_text(part); });
    }
  }

  void urls(Span where, std::span<const std::string_view> list, UrlUse use) {
    strings(led_urls(scene_, where, list, use, {options_.file, options_.place, options_.copy}));
  }

  const TextOptions& options_;
  int version_;
  XmlCharacters characters_;
  Span at_;           // of the node that is printed
  Span replaced_at_;  // of the first one with a character that XML cannot hold
};

}  // namespace

void write_x3d(const Scene& scene, const TextOptions& options, const Sink& sink, Diagnostics& diag) {
  const auto faces = options.own_fields ? std::nullopt : with_form_faces(scene);
  X3dWriter(faces ? *faces : scene, options, sink, diag).file();
}

}  // namespace wrlkit
