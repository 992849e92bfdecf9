#include "writers/vrml.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "scenegraph/equal.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Calls proto(ProtoId) and node(NodeId) in the order in which a scope is printed: prototypes first, but those whose name
/// means something else as well, where they stood: one that is declared again, of the standard, or of nodes that nobody knew.
template <class P, class N>
void for_each_statement(const Scene& scene, const std::unordered_set<std::string_view>& unknown, const Scope& s, P&& proto, N&& node) {
  std::unordered_set<std::string_view> declared;
  std::vector<ProtoId> later;
  for (ProtoId p : s.protos) {
    auto name = scene.type(scene.proto(p).type).name;
    if (declared.insert(name).second && later.empty() && !unknown.contains(name) && !find_builtin(name, Dialect::vrml97)) proto(p);
    else later.push_back(p);
  }
  auto next = later.begin();
  for (std::size_t i = 0; i < s.roots.size(); ++i) {
    for (; next != later.end() && scene.proto(*next).roots_before <= i; ++next) proto(*next);
    node(s.roots[i]);
  }
  for (; next != later.end(); ++next) proto(*next);
}

/// Output names of a scope and of the bodies of its prototypes, which are scopes of their own: what stands in one and
/// outside is printed in both. A name may be defined several times: USE means the last one before it (4.4.3). Nodes are met in
/// the order in which they will be printed, and one that a USE or a ROUTE would miss gets a name of its own.
class Names {
 public:
  explicit Names(const Scene& scene) : scene_(scene), met_(scene.node_count(), 0) {
    for (const auto& t : scene.own_types())
      if (t.kind == NodeKind::unknown) unknown_.insert(t.name);
  }

  /// Types of nodes that nobody knew.
  const std::unordered_set<std::string_view>& unknown() const { return unknown_; }

  void scope(const Scope& s) {
    ++scope_;
    last_.clear();
    auto defaults = [&](ProtoId p) { for (auto& f : scene_.type(scene_.proto(p).type).fields) meet(f.default_value.node_span()); };
    for_each_statement(scene_, unknown_, s, defaults, [&](NodeId n) { meet({&n, 1}); });
    for (auto& r : s.routes) referred(r.from), referred(r.to);
    for_each_statement(scene_, unknown_, s, [&](ProtoId p) { scope(scene_.proto(p).body); }, [](NodeId) {});
  }
  std::string_view operator[](NodeId n) const {
    auto i = given_.find(n.value);
    return i == given_.end() ? scene_.name(n) : std::string_view(i->second);
  }

 private:
  void meet(std::span<const NodeId> roots) {
    std::vector<NodeId> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      NodeId n = stack.back();
      stack.pop_back();
      if (!n) continue;
      if (std::exchange(met_[n.value], scope_) == scope_) { referred(n); continue; }
      if (auto name = scene_.name(n); !name.empty()) last_[name] = n;
      auto mark = stack.size();
      for_each_printed_child(n, [&](NodeId c) { stack.push_back(c); });
      std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(mark), stack.end());
    }
  }

  template <class F>
  void for_each_printed_child(NodeId n, F&& f) {
    for (const Value* v : printed_order(scene_, n))
      for (NodeId c : scene_.content(*v).node_span()) f(c);
  }

  void referred(NodeId n) {
    auto name = scene_.name(n);
    if (given_.count(n.value)) return;
    if (!name.empty() && last_[name] == n) return;
    given_[n.value] = fresh(name);
  }

  std::string fresh(std::string_view base) {
    if (taken_.empty()) {
      taken_.insert("");
      for (std::uint32_t i = 0; i < scene_.node_count(); ++i) taken_.insert(std::string(scene_.name(NodeId{i})));
    }
    auto& k = counter_[std::string(base)];
    for (;;) {
      std::string s = (base.empty() ? std::string("_") : std::string(base) + "_") + std::to_string(++k);
      if (taken_.insert(s).second) return s;
    }
  }

 public:
  /// Written fields in the order of the table, unknown ones behind.
  static std::vector<const Value*> printed_order(const Scene& scene, NodeId n) {
    std::vector<const Value*> v;
    for (auto& f : scene.fields(n)) v.push_back(&f);
    auto by_slot = [](const Value* a, const Value* b) { return a->slot < b->slot; };
    if (!std::ranges::is_sorted(v, by_slot)) std::ranges::stable_sort(v, by_slot);
    return v;
  }

 private:
  std::unordered_set<std::string_view> unknown_;
  const Scene& scene_;
  std::vector<std::uint32_t> met_;  // the last scope that held the node
  std::uint32_t scope_ = 0;
  std::unordered_map<std::string_view, NodeId> last_;
  std::unordered_map<std::uint32_t, std::string> given_;
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::uint64_t> counter_;
};

class Writer {
 public:
  Writer(const Scene& scene, const VrmlOptions& options, const Sink& sink) : scene_(scene), options_(options), out_(sink), names_(scene), printed_(scene.node_count(), 0) {}

  void file() {
    out_ << (!vrml1_ ? "#VRML V2.0 utf8" : scene_.header.empty() ? "#VRML V1.0 ascii" : scene_.header) << '\n' << scene_.comment;
    names_.scope(scene_.main);
    scope(scene_.main);
  }

  void single(NodeId n) {
    names_.scope(Scope{{n}, {}, {}});
    node(n);
  }

 private:
  void line() {
    out_ << '\n';
    for (int i = 0; i < depth_; ++i) out_ << ' ';
  }

  void scope(const Scope& s) {
    for_each_statement(scene_, names_.unknown(), s, [&](ProtoId p) { line_start(); proto(scene_.proto(p)); }, [&](NodeId n) { line_start(); node(n); });
    for (auto& r : s.routes) {
      if (printed_[r.from.value] != scope_ || printed_[r.to.value] != scope_) continue;
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
    ++depth_;
    for (const auto& f : t.fields) {
      line();
      declaration(f);
      if (!p.external && f.has_value()) { out_ << ' '; value(f.default_value); }
    }
    --depth_;
    if (!t.fields.empty()) line();
    out_ << "] ";
    if (p.external) { urls(p.where, p.urls); return; }
    out_ << '{';
    ++depth_;
    body(p.body);
    --depth_;
    line();
    out_ << '}';
  }

  /// Knows nothing of what is printed around it, and leaves that known behind it.
  void body(const Scope& s) {
    const auto around = std::exchange(scope_, ++scopes_);
    const auto mark = again_.size();
    scope(s);
    for (; again_.size() > mark; again_.pop_back()) printed_[again_.back().first] = again_.back().second;
    scope_ = around;
  }

  void declaration(const FieldDef& f) {
    constexpr std::string_view words[] = {"field ", "exposedField ", "eventIn ", "eventOut "};
    out_ << words[static_cast<int>(f.access)] << info(f.type).name << ' ' << f.name;
  }

  void node(NodeId n) {
    if (!n) { out_ << "NULL"; return; }
    auto name = names_[n];
    auto& printed = printed_[n.value];
    if (printed == scope_) { out_ << "USE " << name; return; }
    if (printed) again_.emplace_back(n.value, printed);
    printed = scope_;
    if (!name.empty()) out_ << "DEF " << name << ' ';
    out_ << scene_.type(n).name << " {";
    ++depth_;
    bool empty = true;
    if (vrml1_) empty &= !declarations(n);
    const auto own = own_fields(scene_.type(n));
    const auto written = Names::printed_order(scene_, n);
    for (const Value* v : written)
      if (v->slot < own) empty &= !field(n, *v);
    for (std::size_t i = own; i < scene_.type(n).fields.size(); ++i) own_field(n, static_cast<std::uint16_t>(i)), empty = false;
    for (const bool children : {true, false})  // before fields without a value, which would take a node for it
      for (const Value* v : written)
        if (scene_.is_extra(*v) && is_children(n, *v) == children) empty &= !field(n, *v);
    --depth_;
    if (!empty) line();
    out_ << '}';
  }

  /// VRML 1.0: the fields that a node describes itself, but for nodes and isA. False: there are none.
  bool declarations(NodeId n) {
    std::vector<const ExtraField*> own;
    for (const Value& v : scene_.fields(n))
      if (scene_.is_extra(v) && v.extra->value.type != FieldType::verbatim && info(v.extra->value.type).element != Element::node && v.extra->name != "isA") own.push_back(v.extra);
    if (own.empty()) return false;
    line();
    out_ << "fields [ ";
    for (std::size_t i = 0; i < own.size(); ++i) out_ << (i ? ", " : "") << info(own[i]->value.type).name << ' ' << own[i]->name;
    out_ << " ]";
    return true;
  }

  /// VRML 1.0: children have no field in the file. False: these are none.
  bool children(NodeId n, const Value& v) {
    if (!is_children(n, v)) return false;
    for (NodeId c : scene_.content(v).node_span()) { line(); node(c); }
    return true;
  }

  bool is_children(NodeId n, const Value& v) const {
    const bool here = vrml1_ && scene_.type(n).dialects & static_cast<DialectSet>(Dialect::vrml1);
    return here && scene_.field_name(n, v) == "children" && scene_.content(v).type == FieldType::MFNode;
  }

  /// False when it says what the default says.
  bool field(NodeId n, const Value& v) {
    const auto& t = scene_.type(n);
    if (children(n, v)) return scene_.content(v).count > 0;
    if (scene_.is_extra(v)) {
      line();
      out_ << v.extra->name;
      if (const auto& c = v.extra->value; c.is || c.type != FieldType::verbatim || c.count) { out_ << ' '; unknown_content(c); }
      return true;
    }
    const auto& f = t.fields[v.slot];
    if (t.kind != NodeKind::proto && !v.is && equal_default(v, f)) return false;
    line();
    out_ << f.name_in(t.dialects & static_cast<DialectSet>(Dialect::vrml1) ? Dialect::vrml1 : Dialect::vrml97) << ' ';
    if (!v.is && v.type == FieldType::MFString && (f.name == "url" || f.name.ends_with("Url"))) urls(scene_.where(n), v.text_span());
    else content(v);
    return true;
  }

  /// Urls are relative to the file that they stand in. Those of an inlined world, and those of a world that is written
  /// elsewhere, are led to the folder they mean.
  void urls(Span where, std::span<const std::string_view> list) {
    namespace fs = std::filesystem;
    auto folder = [](std::string_view file) { return (fs::absolute("." / fs::path(file).parent_path()) / "").lexically_normal(); };
    const auto read = scene_.sources->file(where.begin), main = scene_.sources->file(0);
    if (read.empty() || read == "-") return strings(list);
    const fs::path from = folder(read), here = folder(options_.file.empty() ? main : std::string_view(options_.file));
    if (from == here) return strings(list);
    const fs::path prefix = from.lexically_relative(here);
    std::vector<std::string> led;
    for (auto url : list) {
      bool relative = !url.empty() && url[0] != '/' && url[0] != '#' && url.find(':') == url.npos;
      led.push_back(relative && !prefix.empty() ? (prefix / url).lexically_normal().generic_string() : std::string(url));
    }
    const std::vector<std::string_view> views(led.begin(), led.end());
    strings(views);
  }

  /// A field or event that a Script declares.
  void own_field(NodeId n, std::uint16_t slot) {
    const auto& f = scene_.type(n).fields[slot];
    line();
    declaration(f);
    if (const Value* v = scene_.find(n, slot)) { out_ << ' '; content(*v); }
    else if (f.has_value()) { out_ << ' '; value(f.default_value); }
  }

  /// Where the fields that a Script declares itself begin.
  static std::size_t own_fields(const NodeType& t) {
    if (t.kind != NodeKind::script) return t.fields.size();
    return builtin_nodes()[find_builtin(t.name, Dialect::vrml97).value].fields.size();
  }

  static bool equal_default(const Value& v, const FieldDef& f) {
    if (info(v.type).element == Element::node) return v.type == f.type && v.node_span().empty();
    return equal_plain(v, f.default_value);
  }

  void content(const Value& v) {
    if (v.is) out_ << "IS " << v.text();
    else value(v);
  }

  /// Of an unknown field: nothing but the brackets tells a list of one node from a node.
  void unknown_content(const Value& v) {
    if (v.is || v.type != FieldType::MFNode || v.count != 1) return content(v);
    out_ << "[ ";
    node(v.nodes[0]);
    out_ << " ]";
  }

  void value(const Value& v) {
    const auto& t = info(v.type);
    switch (t.element) {
      case Element::node: return t.multiple ? node_list(v.node_span()) : node(v.node);
      case Element::text:
        if (v.type == FieldType::verbatim || v.type == FieldType::SFEnum) out_ << v.text();
        else if (v.type == FieldType::SFBitMask) out_ << '(' << v.text() << ')';
        else if (t.multiple) strings(v.text_span());
        else string(v.text());
        return;
      case Element::image: return bare(v.integer_span(), [&](std::int32_t i) { pixel(static_cast<std::uint32_t>(i)); });
      case Element::integer:
        if (v.type == FieldType::SFBool) out_ << (v.integer ? "TRUE" : "FALSE");
        else if (v.type == FieldType::MFBool) list(v.integer_span(), 1, [&](std::int32_t b) { out_ << (b ? "TRUE" : "FALSE"); });
        else if (t.multiple) list(v.integer_span(), 1, [&](std::int32_t i) { out_.integer(i); });
        else out_.integer(v.integer);
        return;
      case Element::number:
        if (t.multiple) list(v.number_span(), t.arity, [&](double d) { out_.number(d, options_.precision); });
        else bare(v.number_span(), [&](double d) { out_.number(d, options_.precision); });
    }
  }

  template <class T, class Print>
  void bare(std::span<const T> values, Print print) {
    for (std::size_t i = 0; i < values.size(); ++i) { if (i) out_ << ' '; print(values[i]); }
  }

  /// [ ... ], wrapped between tuples at some hundred characters.
  template <class T, class Print>
  void list(std::span<const T> values, std::size_t arity, Print print) {
    constexpr std::uint64_t width = 110;
    out_ << '[';
    auto start = out_.size();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i) {
        if (i % arity == 0 && vrml1_) out_ << ',';
        if (i % arity == 0 && out_.size() - start > width) { out_ << '\n'; start = out_.size(); }
        else out_ << ' ';
      }
      print(values[i]);
    }
    out_ << ']';
  }

  /// Four components do not fit into a decimal int32.
  void pixel(std::uint32_t p) {
    if (p <= 0x7fffffffu) return void(out_.integer(p));
    char b[16] = "0x";
    *std::to_chars(b + 2, b + sizeof b, p, 16).ptr = 0;
    out_ << std::string_view(b);
  }

  void string(std::string_view s) {
    out_ << '"';
    for (std::size_t from = 0;;) {
      auto at = s.find_first_of("\"\\", from);
      out_ << s.substr(from, at - from);
      if (at == s.npos) break;
      out_ << '\\' << s[at];
      from = at + 1;
    }
    out_ << '"';
  }

  void strings(std::span<const std::string_view> v) {
    if (v.size() == 1) return string(v[0]);
    out_ << '[';
    for (std::size_t i = 0; i < v.size(); ++i) { if (i) out_ << (vrml1_ ? ", " : " "); string(v[i]); }
    out_ << ']';
  }

  void node_list(std::span<const NodeId> v) {
    if (v.size() == 1 && v[0]) return node(v[0]);
    out_ << '[';
    ++depth_;
    for (NodeId n : v) { line(); node(n); }
    --depth_;
    if (!v.empty()) line();
    out_ << ']';
  }

  const Scene& scene_;
  const bool vrml1_ = scene_.format == Format::vrml1;
  VrmlOptions options_;
  TextOut out_;
  Names names_;
  std::vector<std::uint32_t> printed_;                            // the scope that printed the node last, from 1
  std::vector<std::pair<std::uint32_t, std::uint32_t>> again_;    // nodes printed once more in a body, and where before
  std::uint32_t scope_ = 1, scopes_ = 1;
  int depth_ = 0;
  bool first_ = true;
};

}  // namespace

void write_vrml(const Scene& scene, const VrmlOptions& options, const Sink& sink, Diagnostics&) { Writer(scene, options, sink).file(); }

std::string node_text(const Scene& scene, NodeId n, Diagnostics&) {
  std::string text;
  Writer(scene, {}, [&](std::string_view s) { text += s; }).single(n);
  return text;
}

}  // namespace wrlkit
