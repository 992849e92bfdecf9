#include "tests/fuzz/world_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenegraph/access_word.h"

namespace wrlkit {
namespace {

constexpr int deepest = 4;  // of nodes in one edit

std::string number_text(double v) {
  std::string text = std::to_string(v);
  while (text.find('.') != text.npos && (text.ends_with('0') || text.ends_with('.'))) text.pop_back();
  return text;
}

std::string quoted(const std::string& s) { return '"' + s + '"'; }

}  // namespace

WorldText::WorldText(Dialect dialect, Encoding encoding, std::mt19937& random, std::vector<NamedNode> named)
    : dialect_(dialect), encoding_(encoding), random_(random), named_(std::move(named)), n_names_(named_.size()) {
  for (const auto& t : builtin_nodes()) {
    if (!has(t.dialects) || t.is_own()) continue;
    types_.push_back(&t);
    if (dialect == Dialect::vrml1 || t.is_named("X3DChildNode")) roots_.push_back(&t);
  }
}

std::string WorldText::file() {
  std::string out = encoding_ == Encoding::xml    ? "<X3D version='4.0' profile='Full'><Scene>\n"
                    : dialect_ == Dialect::vrml97 ? "#VRML V2.0 utf8\n"
                    : dialect_ == Dialect::vrml1  ? "#VRML V1.0 ascii\n"
                                                  : "#X3D V4.0 utf8\nPROFILE Full\n";
  for (auto n = 1 + random_() % 4; n > 0; --n) out += root();
  if (dialect_ != Dialect::vrml1 && one_in(2)) out += proto();
  if (dialect_ != Dialect::vrml1) out += route();
  return out + (encoding_ == Encoding::xml ? "</Scene></X3D>\n" : "");
}

std::string WorldText::root() { return node(one_of(roots_), "", 0); }

std::vector<const FieldDef*> WorldText::fields_of(const NodeType& t) const {
  std::vector<const FieldDef*> out;
  for (const auto& f : t.fields)
    if (has(f.dialects) && !f.is_own() && f.has_value()) out.push_back(&f);
  return out;
}

FieldText WorldText::field(const NodeType& t) {
  const auto fields = fields_of(t);
  return fields.empty() ? FieldText{} : field(*one_of(fields), deepest - 2);
}

FieldText WorldText::field(const FieldDef& f, int depth) {
  const auto& type = info(f.type);
  const std::string name(f.name_in(dialect_));
  if (type.element != Element::node) {
    if (encoding_ == Encoding::xml) return {" " + name + "='" + value(f) + "'", ""};
    return {"", name + " " + value(f) + "\n"};
  }
  std::string nodes;
  for (auto n = type.multiple ? random_() % 4 : 1; n > 0; --n) nodes += node_for(f, depth);
  if (encoding_ == Encoding::xml || (dialect_ == Dialect::vrml1 && name == "children")) return {"", nodes};
  if (type.multiple) return {"", name + " [\n" + nodes + "]\n"};
  return {"", name + " " + (nodes.empty() ? "NULL\n" : nodes)};
}

std::string WorldText::node_for(const FieldDef& f, int depth) {
  if (one_in(4)) {
    std::vector<const NamedNode*> fitting;
    for (const auto& n : named_)
      if (f.accepts(*n.type)) fitting.push_back(&n);
    if (!fitting.empty()) {
      const auto& n = *one_of(fitting);
      const std::string type(n.type->name);
      return encoding_ == Encoding::vrml
                 ? "USE " + n.name + "\n"
                 : "<" + type + " USE='" + n.name + "' containerField='" + std::string(f.name) + "'/>\n";
    }
  }
  Types fitting;
  for (const auto* t : types_)
    if (f.accepts(*t)) fitting.push_back(t);
  return depth <= 0 || fitting.empty() ? "" : node(one_of(fitting), f.name, depth);
}

std::string WorldText::node(const NodeType* t, std::string_view container, int depth) {
  std::string attributes, content, def;
  if (one_in(2)) def = "N" + std::to_string(n_names_++);
  auto fields = fields_of(*t);
  std::ranges::shuffle(fields, random_);
  fields.resize(std::min<std::size_t>(fields.size(), random_() % 5));
  for (const auto* f : fields) {
    const auto made = field(*f, depth == 0 ? deepest - 1 : depth - 1);
    attributes += made.attribute;
    content += made.content;
  }
  if (!def.empty()) named_.push_back({def, t});
  const std::string name(t->name);
  if (encoding_ == Encoding::vrml) return (def.empty() ? "" : "DEF " + def + " ") + name + " {\n" + content + "}\n";
  const std::string in = container.empty() ? "" : " containerField='" + std::string(container) + "'";
  const std::string is = def.empty() ? "" : " DEF='" + def + "'";
  return "<" + name + is + attributes + in + ">" + content + "</" + name + ">\n";
}

std::string WorldText::number(const FieldRange& range) {
  static constexpr double some[] = {0, 1, -1, 0.5, 2, 3, 10, 0.001, -0.25, 1.5707963, 100, 1e6, 1e-7, 4096};
  double v = one_of(some);
  if (one_in(16)) return one_in(2) ? "1e38" : "-1e-38";
  if (!range.contains(v) && !one_in(8)) {
    const double low = std::isfinite(range.low) ? range.low : -1,
                 high = std::isfinite(range.high) ? range.high : low + 2;
    v = low + (high - low) * (1 + random_() % 7) / 8;
  }
  return number_text(v);
}

std::string WorldText::value(const FieldDef& f) {
  const auto& type = info(f.type);
  if (type.element == Element::text) return text(f);
  if (type.element == Element::image) return image();
  const bool truth = f.type == FieldType::SFBool || f.type == FieldType::MFBool;
  const bool xml = encoding_ == Encoding::xml;
  std::string out;
  for (auto n = (type.multiple ? random_() % 7 : 1) * type.arity; n > 0; --n) {
    if (truth)
      out += one_in(2) ? (xml ? "true" : "TRUE") : (xml ? "false" : "FALSE");
    else if (type.element == Element::integer)
      out += std::to_string(static_cast<int>(random_() % 9) - 1);
    else
      out += number(f.range);
    out += ' ';
  }
  return type.multiple && !xml ? "[ " + out + "]" : out;
}

/// A word that the field may have, or any.
std::string WorldText::words(const FieldDef& f) {
  static const std::string some[] = {"", "a", "N1", "b.png", "N2.wrl", "#N3", "two words", "\xc3\xa9", "x=1"};
  return f.kinds.empty() ? one_of(some) : std::string(one_of(f.kinds));
}

std::string WorldText::text(const FieldDef& f) {
  const auto& type = info(f.type);
  if (f.type == FieldType::SFEnum) return words(f);
  if (f.type == FieldType::SFBitMask) return "(" + words(f) + (one_in(2) ? " | " + words(f) : "") + ")";
  if (!type.multiple) return encoding_ == Encoding::xml ? words(f) : quoted(words(f));
  std::string out;
  for (auto n = random_() % 4; n > 0; --n) out += quoted(words(f)) + " ";
  return encoding_ == Encoding::xml ? out : "[ " + out + "]";
}

std::string WorldText::image() {
  const auto width = random_() % 4, height = random_() % 4, channels = random_() % 5;
  std::string out = std::to_string(width) + " " + std::to_string(height) + " " + std::to_string(channels);
  for (auto n = width * height; n > 0; --n) out += " " + std::to_string(random_() % 256);
  return out;
}

std::string WorldText::proto() {
  const NodeType* body = one_of(roots_);
  auto fields = fields_of(*body);
  std::erase_if(fields, [](const FieldDef* f) { return info(f->type).element == Element::node; });
  const FieldDef* f = fields.empty() ? nullptr : one_of(fields);
  const std::string name = "P" + std::to_string(random_() % 4), type(body->name);
  const auto given = f ? value(*f) : "", of = std::string(f ? f->name_in(dialect_) : "");
  const auto field_type = std::string(f ? info(f->type).name : "");
  const auto access = std::string(f ? access_word(f->access, dialect_) : "");
  if (encoding_ == Encoding::vrml) {
    const auto declared = f ? access + " " + field_type + " p " + given : "";
    return "PROTO " + name + " [ " + declared + " ] {\n" + type + " { " + (f ? of + " IS p" : "") + " }\n}\n" +
           instance(name, f);
  }
  const auto declared =
      f ? "<field accessType='" + access + "' type='" + field_type + "' name='p' value='" + given + "'/>" : "";
  const auto is = f ? "<IS><connect nodeField='" + of + "' protoField='p'/></IS>" : "";
  return "<ProtoDeclare name='" + name + "'><ProtoInterface>" + declared + "</ProtoInterface><ProtoBody><" + type +
         ">" + is + "</" + type + "></ProtoBody></ProtoDeclare>\n" + instance(name, f);
}

std::string WorldText::instance(const std::string& name, const FieldDef* given) {
  const bool gives = given && one_in(2);
  if (encoding_ == Encoding::vrml) return name + " { " + (gives ? "p " + value(*given) : "") + " }\n";
  const auto field = gives ? "<fieldValue name='p' value='" + value(*given) + "'/>" : "";
  return "<ProtoInstance name='" + name + "'>" + field + "</ProtoInstance>\n";
}

std::string WorldText::route() {
  using Pair = std::pair<const NamedNode*, const FieldDef*>;
  std::vector<Pair> from, to;
  for (const auto& n : named_)
    for (const auto& f : n.type->fields) {
      if (!has(f.dialects) || f.is_own() || f.access == Access::init) continue;
      if (f.access != Access::in) from.emplace_back(&n, &f);
      if (f.access != Access::out) to.emplace_back(&n, &f);
    }
  if (from.empty()) return {};
  const auto a = one_of(from);
  std::erase_if(to, [&](const Pair& p) { return p.second->type != a.second->type; });
  if (to.empty()) return {};
  const auto b = one_of(to);
  const std::string out(a.second->name_in(dialect_)), in(b.second->name_in(dialect_));
  if (encoding_ == Encoding::vrml)
    return "ROUTE " + a.first->name + "." + out + " TO " + b.first->name + "." + in + "\n";
  return "<ROUTE fromNode='" + a.first->name + "' fromField='" + out + "' toNode='" + b.first->name + "' toField='" +
         in + "'/>\n";
}

}  // namespace wrlkit
