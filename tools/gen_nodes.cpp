// Reads the node table (scenegraph/nodes/*.nodes, notation in scenegraph/nodes/README.md) and writes two files into the
// build tree: nodes.h, the constants `nodes::cone::height` (`nodes::vrml1::cone::height` of a node that only VRML 1.0
// has), and node_rows.cpp, the rows behind builtin_nodes().
//
//   gen_nodes OUT_DIR FILE.nodes...
//
// Errors are printed as file:line: text; exit code 1. It uses nothing of the library but value.h, which has the types.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "scenegraph/value.h"

namespace {

using wrlkit::Element;
using wrlkit::FieldType;

struct Field {
  std::string access, type, name, vrml97, unit, doc, default_text, low = "-inf", high = "inf";
  bool low_open = false, high_open = false, ranged = false;
  std::vector<std::string> kinds;
  std::vector<std::string> values;      // of the default: numbers, strings without quotes
  std::vector<std::string> x3d_values;  // of X3D's default, where it has another one
  int x3d_from = 30;                    // in version 3.0, or from this one on
  std::string only;
  int since = 0;  // version of X3D; 0: one that is not newer than 3.3
};

struct Node {
  std::string name, clauses, component, container, doc;
  std::vector<std::string> bases;
  std::vector<Field> fields;
  bool abstract = false;
  int since = 0;  // as of a field
};

std::string file;
int line_number = 0;

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "%s:%d: %s\n", file.c_str(), line_number, why.c_str());
  std::exit(1);
}

// One line of a field, cut into words: quoted strings, <...>, {...}, ranges and [...] stay whole.
std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < text.size();) {
    if (std::isspace(static_cast<unsigned char>(text[i]))) {
      ++i;
      continue;
    }
    std::size_t j = i;
    auto until = [&](char c) {
      j = text.find(c, i + 1);
      if (j == std::string::npos) fail(std::string("missing ") + c);
      ++j;
    };
    if (text[i] == '"')
      until('"');
    else if (text[i] == '<')
      until('>');
    else if (text[i] == '{')
      until('}');
    else if (text[i] == '[' || text[i] == '(') {
      j = text.find_first_of("])", i);
      if (j == std::string::npos) fail("missing ]");
      ++j;
    } else
      while (j < text.size() && !std::isspace(static_cast<unsigned char>(text[j]))) ++j;
    out.push_back(text.substr(i, j - i));
    i = j;
  }
  return out;
}

std::vector<std::string> split(std::string s, const char* separators) {
  std::vector<std::string> out;
  std::string part;
  for (char c : s)
    if (std::string_view(separators).find(c) != std::string_view::npos) {
      if (!part.empty()) out.push_back(part);
      part.clear();
    } else
      part += c;
  if (!part.empty()) out.push_back(part);
  return out;
}

std::string trim(const std::string& s) {
  auto b = s.find_first_not_of(" \t"), e = s.find_last_not_of(" \t");
  return b == std::string::npos ? "" : s.substr(b, e - b + 1);
}

FieldType type_of(const std::string& name) {
  FieldType t{};
  if (!wrlkit::find_field_type(name, t)) fail("no field type " + name);
  return t;
}

/// 33 of "3.3".
int version(const std::string& s) { return std::stoi(s) * 10 + (s[1] == '.' ? s[2] - '0' : 0); }

void read_default(Field& f, const std::vector<std::string>& w, std::size_t& i) {
  const auto& t = wrlkit::info(type_of(f.type));
  auto take = [&]() -> const std::string& {
    if (i >= w.size()) fail("default missing");
    return w[i++];
  };
  auto unquote = [&](const std::string& s) {
    if (s.size() < 2 || s[0] != '"') fail("string expected: " + s);
    return s.substr(1, s.size() - 2);
  };
  if (t.multiple || t.element == Element::image) {
    f.default_text = take();
    if (f.default_text[0] != '[') {
      if (t.element != Element::image) fail("'[' expected");
      f.values = {f.default_text, take(), take()};
      f.default_text = "0 0 0";
      return;
    }
    auto inner = f.default_text.substr(1, f.default_text.size() - 2);
    if (t.element == Element::text) {
      for (auto& s : words(inner)) f.values.push_back(unquote(s));
    } else
      f.values = split(inner, " ,");
    if (f.values.size() % t.arity) fail("default is not a multiple of the arity");
  } else if (t.element == Element::text) {
    f.default_text = take();
    f.values = {f.default_text[0] == '"' ? unquote(f.default_text) : f.default_text};
  } else {
    for (int k = 0; k < t.arity; ++k) {
      f.values.push_back(take());
      f.default_text += (k ? " " : "") + f.values.back();
    }
  }
}

Field read_field(const std::string& text, const std::string& doc) {
  Field f;
  f.doc = doc;
  auto w = words(text);
  if (w.size() < 3) fail("access, type and name expected");
  f.access = w[0];
  f.type = w[1];
  f.name = w[2];
  if (!std::set<std::string>{"init", "inout", "in", "out"}.count(f.access)) fail("no access " + f.access);
  type_of(f.type);
  std::size_t i = 3;
  if (f.access[0] == 'i' && f.access != "in") read_default(f, w, i);
  for (; i < w.size(); ++i) {
    const auto& s = w[i];
    if (s[0] == '(' || s[0] == '[') {
      auto ends = split(s.substr(1, s.size() - 2), ",");
      if (ends.size() != 2) fail("range expected: " + s);
      f.low = trim(ends[0]);
      f.high = trim(ends[1]);
      f.low_open = s[0] == '(';
      f.high_open = s.back() == ')';
      f.ranged = true;
    } else if (s[0] == '<' || s[0] == '{')
      f.kinds = split(s.substr(1, s.size() - 2), "| ");
    else if (s.starts_with("unit="))
      f.unit = s.substr(5);
    else if (s.starts_with("vrml97="))
      f.vrml97 = s.substr(7);
    else if (s.starts_with("only="))
      f.only = s.substr(5);
    else if (s.starts_with("since="))
      f.since = version(s.substr(6));
    else if (s.starts_with("x3d")) {
      auto equals = s.find('=');
      if (equals == std::string::npos) fail("not understood: " + s);
      if (equals > 3) f.x3d_from = version(s.substr(3));
      f.x3d_values = split(s.substr(equals + 1), "[]|\"");
    } else
      fail("not understood: " + s);
  }
  return f;
}

Node read_head(const std::string& text, bool abstract) {
  Node n;
  n.abstract = abstract;
  std::istringstream in(text);
  std::string w, clauses;
  in >> w >> n.name;
  bool bases = false;
  while (in >> w) {
    if (w == ":") {
      bases = true;
      continue;
    }
    if (w.starts_with("component="))
      n.component = w.substr(10);
    else if (w.starts_with("since="))
      n.since = version(w.substr(6));
    else if (w.starts_with("container="))
      n.container = w.substr(10);
    else if (w == "vrml1" || w == "vrml97" || w == "x3d" || w == "wrlkit") {
      bases = false;
      clauses += (clauses.empty() ? "" : " ") + w;
    } else if (bases)
      n.bases.push_back(w.back() == ',' ? w.substr(0, w.size() - 1) : w);
    else
      clauses += (clauses.empty() ? "" : " ") + w;
  }
  while (!clauses.empty() && clauses.back() == ';') clauses.pop_back();
  n.clauses = clauses;
  return n;
}

int dialects(const std::string& clauses) {
  int d = 0;
  for (auto& w : split(clauses, " ;,"))
    d |= w == "vrml1" ? 1 : w == "vrml97" ? 2 : w == "x3d" ? 4 : w == "wrlkit" ? 8 : 0;
  return d;
}

std::string quoted(const std::string& s) {
  std::string o = "\"";
  for (char c : s) {
    if (c == '"' || c == '\\') o += '\\';
    o += c;
  }
  return o + "\"";
}

std::string infinite(const std::string& s) {
  if (s == "inf") return "std::numeric_limits<double>::infinity()";
  if (s == "-inf") return "-std::numeric_limits<double>::infinity()";
  if (s == "pi") return "3.14159265358979323846";
  if (s == "-pi") return "-3.14159265358979323846";
  if (s == "pi/2") return "1.57079632679489661923";
  return s;
}

// Keywords and the macros of <cmath> that a lower-case node name could hit.
std::string identifier(const std::string& name) {
  static const std::set<std::string> taken{"switch",  "inline",   "double", "float",   "namespace",
                                           "default", "operator", "export", "template"};
  return taken.count(name) ? name + "_" : name;
}

std::string snake(const std::string& name) {
  std::string o;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned char c = name[i];
    bool lower_before = i && std::islower(static_cast<unsigned char>(name[i - 1]));
    bool lower_after = i && i + 1 < name.size() && std::isupper(static_cast<unsigned char>(name[i - 1])) &&
                       std::islower(static_cast<unsigned char>(name[i + 1]));
    if (std::isupper(c) && (lower_before || lower_after)) o += '_';
    o += static_cast<char>(std::tolower(c));
  }
  return identifier(o);
}

std::string list_of(const std::vector<std::string>& v) {
  std::string o;
  for (auto& s : v) o += (o.empty() ? "" : ", ") + quoted(s);
  return o;
}

struct Generator {
  std::vector<Node> nodes;
  std::map<std::string, Node> bases;
  std::set<std::string> seen;

  void all_bases(const Node& n, std::vector<std::string>& out) const {
    for (auto& b : n.bases) {
      if (std::find(out.begin(), out.end(), b) != out.end()) continue;
      out.push_back(b);
      all_bases(bases.at(b), out);
    }
  }

  std::string container(const Node& n) const {
    if (!n.container.empty()) return n.container;
    for (auto& b : n.bases)
      if (auto c = container(bases.at(b)); !c.empty()) return c;
    return {};
  }

  void read(const char* path) {
    file = path;
    line_number = 0;
    std::ifstream in(path);
    if (!in) fail("cannot be read");
    Node* current = nullptr;
    for (std::string text; std::getline(in, text);) {
      ++line_number;
      std::string doc;
      if (auto p = text.find("--"); p != std::string::npos) {
        doc = trim(text.substr(p + 2));
        text = text.substr(0, p);
      }
      auto body = trim(text);
      if (body.starts_with('#') || (body.empty() && doc.empty())) continue;
      if (body.empty()) {
        if (current) current->doc += (current->doc.empty() ? "" : " ") + doc;
        continue;
      }
      bool abstract = body.starts_with("base ");
      if (!abstract && !body.starts_with("node ")) {
        if (!current) fail("field outside a node");
        current->fields.push_back(read_field(body, doc));
        for (std::size_t i = 0; i + 1 < current->fields.size(); ++i)
          if (current->fields[i].name == current->fields.back().name)
            fail("field twice: " + current->fields.back().name);
        continue;
      }
      Node n = read_head(body, abstract);
      n.doc = doc;
      if (!seen.insert(n.name + (abstract ? "" : "/" + std::to_string(dialects(n.clauses)))).second)
        fail("node twice: " + n.name);
      for (auto& b : n.bases)
        if (!bases.count(b)) fail("no base " + b);
      if (abstract) {
        current = &(bases[n.name] = n);
        continue;
      }
      if (!dialects(n.clauses)) fail("node in no dialect: " + n.name);
      nodes.push_back(n);
      current = &nodes.back();
    }
  }

  void check_kinds() const {
    std::set<std::string> names;
    for (auto& n : nodes) names.insert(n.name);
    for (auto& n : nodes)
      for (auto& f : n.fields) {
        auto e = wrlkit::info(type_of(f.type)).element;
        if (e != Element::node) continue;
        for (auto& k : f.kinds)
          if (!names.count(k) && !bases.count(k)) {
            std::fprintf(stderr, "%s.%s: no node or base %s\n", n.name.c_str(), f.name.c_str(), k.c_str());
            std::exit(1);
          }
      }
  }

  static bool vrml1_only(const Node& n) { return dialects(n.clauses) == 1; }

  void write_keys(std::ostream& o, std::size_t i) const {
    o << "namespace " << snake(nodes[i].name) << " {\n";
    for (std::size_t k = 0; k < nodes[i].fields.size(); ++k)
      o << "inline constexpr FieldKey<FieldType::" << nodes[i].fields[k].type << "> "
        << identifier(nodes[i].fields[k].name) << "{TypeId{" << i << "}, " << k << "};\n";
    o << "}\n";
  }

  void write_header(std::ostream& o) const {
    o << "// Generated by tools/gen_nodes.cpp from scenegraph/nodes/*.nodes.\n#pragma once\n#include "
         "\"scenegraph/node_table.h\"\n\nnamespace wrlkit::nodes {\n\n";
    for (bool old : {false, true}) {
      if (old) o << "\n// VRML 1.0 has other nodes of the same names.\nnamespace vrml1 {\n\n";
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (vrml1_only(nodes[i]) == old) o << "inline constexpr TypeId " << nodes[i].name << "{" << i << "};\n";
      o << "\n";
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (vrml1_only(nodes[i]) == old) write_keys(o, i);
      if (old) o << "\n}  // namespace vrml1\n";
    }
    o << "\n}  // namespace wrlkit::nodes\n";
  }

  // The arrays behind the defaults, then the rows that point at them.
  void write_rows(std::ostream& o) const {
    o << "// Generated by tools/gen_nodes.cpp from scenegraph/nodes/*.nodes.\n#include "
         "\"scenegraph/node_table.h\"\n\nnamespace wrlkit {\nnamespace {\n\nusing T = FieldType;\n"
         "constexpr double inf [[maybe_unused]] = std::numeric_limits<double>::infinity();\n"
         "constexpr Value number(T t, std::uint16_t s, double v) { Value o; o.type = t; o.slot = s; o.count = 1; "
         "o.number = v; return o; }\n"
         "constexpr Value integer(T t, std::uint16_t s, std::int32_t v) { Value o; o.type = t; o.slot = s; o.count = "
         "1; o.integer = v; return o; }\n"
         "constexpr Value numbers(T t, std::uint16_t s, std::uint32_t n, const double* v) { Value o; o.type = t; "
         "o.slot = s; o.count = n; o.numbers = v; return o; }\n"
         "constexpr Value integers(T t, std::uint16_t s, std::uint32_t n, const std::int32_t* v) { Value o; o.type = "
         "t; o.slot = s; o.count = n; o.integers = v; return o; }\n"
         "constexpr Value texts(T t, std::uint16_t s, std::uint32_t n, const std::string_view* v) { Value o; o.type = "
         "t; o.slot = s; o.count = n; o.texts = v; return o; }\n"
         "constexpr Value chars(T t, std::uint16_t s, std::string_view v) { Value o; o.type = t; o.slot = s; o.count = "
         "static_cast<std::uint32_t>(v.size()); o.chars = v.data(); return o; }\n"
         "constexpr Value node(T t, std::uint16_t s) { Value o; o.type = t; o.slot = s; o.node = NodeId{}; if (t == "
         "T::MFNode) { o.nodes = nullptr; o.count = 0; } else o.count = 1; return o; }\n\n";
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t k = 0; k < nodes[i].fields.size(); ++k) write_arrays(o, i, k);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      std::vector<std::string> b;
      all_bases(nodes[i], b);
      if (!b.empty()) o << "constexpr std::string_view b" << i << "[] = {" << list_of(b) << "};\n";
      if (nodes[i].fields.empty()) continue;
      o << "constexpr FieldDef f" << i << "[] = {\n";
      for (std::size_t k = 0; k < nodes[i].fields.size(); ++k) write_field(o, i, k);
      o << "};\n";
    }
    o << "constexpr NodeType rows[] = {\n";
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto& n = nodes[i];
      o << "    {" << quoted(n.name) << ", NodeKind::builtin, " << dialects(n.clauses) << ", "
        << (n.fields.empty() ? "{}" : "f" + std::to_string(i)) << ", "
        << (n.bases.empty() ? "{}" : "b" + std::to_string(i)) << ", " << quoted(n.clauses) << ", "
        << quoted(n.component) << ", " << quoted(container(n)) << ", " << quoted(n.doc) << ", {}, {}, " << n.since
        << "},\n";
    }
    o << "};\nconstexpr std::string_view base_names[] = {";
    std::vector<std::string> names;
    for (auto& [name, b] : bases) names.push_back(name);
    o << list_of(names)
      << "};\n\n}  // namespace\n\nstd::span<const NodeType> builtin_nodes() { return rows; }\nstd::span<const "
         "std::string_view> builtin_bases() { return base_names; }\n\n}  // namespace wrlkit\n";
  }

  void write_arrays(std::ostream& o, std::size_t i, std::size_t k) const {
    const auto& f = nodes[i].fields[k];
    const auto& t = wrlkit::info(type_of(f.type));
    std::string id = std::to_string(i) + "_" + std::to_string(k);
    if (!f.kinds.empty()) o << "constexpr std::string_view k" << id << "[] = {" << list_of(f.kinds) << "};\n";
    if (f.values.empty() || t.element == Element::node) return;
    if (t.element == Element::number && (t.multiple || t.arity > 1)) {
      o << "constexpr double d" << id << "[] = {";
      for (auto& v : f.values) o << infinite(v) << ", ";
      o << "};\n";
    } else if (t.element == Element::image || (t.element == Element::integer && t.multiple)) {
      o << "constexpr std::int32_t d" << id << "[] = {";
      for (auto& v : f.values) o << (v == "TRUE" ? "1" : v == "FALSE" ? "0" : v) << ", ";
      o << "};\n";
    } else if (t.element == Element::text && t.multiple) {
      o << "constexpr std::string_view d" << id << "[] = {" << list_of(f.values) << "};\n";
      if (!f.x3d_values.empty())
        o << "constexpr std::string_view x" << id << "[] = {" << list_of(f.x3d_values) << "};\n";
    }
  }

  void write_field(std::ostream& o, std::size_t i, std::size_t k) const {
    const auto& f = nodes[i].fields[k];
    const auto& t = wrlkit::info(type_of(f.type));
    std::string id = std::to_string(i) + "_" + std::to_string(k), head = "T::" + f.type + ", " + std::to_string(k),
                value;
    auto array = [&](const char* fn, std::size_t n) {
      return std::string(fn) + "(" + head + ", " + std::to_string(n) + ", " +
             (f.values.empty() ? "nullptr" : "d" + id) + ")";
    };
    if (t.element == Element::node)
      value = "node(" + head + ")";
    else if (t.element == Element::image || (t.element == Element::integer && t.multiple))
      value = array("integers", f.values.size());
    else if (t.element == Element::text && t.multiple)
      value = array("texts", f.values.size());
    else if (t.element == Element::text)
      value = "chars(" + head + ", " + quoted(f.values.empty() ? "" : f.values[0]) + ")";
    else if (t.element == Element::integer)
      value = "integer(" + head + ", " +
              (f.values.empty()         ? "0"
               : f.values[0] == "TRUE"  ? "1"
               : f.values[0] == "FALSE" ? "0"
                                        : f.values[0]) +
              ")";
    else if (t.multiple || t.arity > 1)
      value = array("numbers", f.values.size() / t.arity);
    else
      value = "number(" + head + ", " + (f.values.empty() ? "0" : infinite(f.values[0])) + ")";
    int d = f.only.empty() ? dialects(nodes[i].clauses) : dialects(f.only);
    o << "    {" << quoted(f.name) << ", " << quoted(f.vrml97) << ", T::" << f.type << ", Access::" << f.access << ", "
      << d << ", " << value << ", {" << infinite(f.low) << ", " << infinite(f.high) << ", "
      << (f.low_open ? "true" : "false") << ", " << (f.high_open ? "true" : "false") << "}, "
      << (f.kinds.empty() ? "{}" : "k" + id) << ", " << quoted(f.unit) << ", " << quoted(f.doc) << ", "
      << quoted(f.default_text) << ", " << f.since << x3d_default(f, head, id) << "},\n";
  }

  static std::string x3d_default(const Field& f, const std::string& head, const std::string& id) {
    if (f.x3d_values.empty()) return {};
    const auto& t = wrlkit::info(type_of(f.type));
    std::string value = t.element == Element::text && t.multiple
                            ? "texts(" + head + ", " + std::to_string(f.x3d_values.size()) + ", x" + id + ")"
                        : t.element == Element::number && !t.multiple && t.arity == 1
                            ? "number(" + head + ", " + f.x3d_values[0] + ")"
                            : "";
    if (value.empty()) fail("no default of X3D's own for this type: " + f.name);
    return ", " + std::to_string(f.x3d_from) + ", " + value;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: gen_nodes OUT_DIR FILE.nodes...\n");
    return 2;
  }
  Generator g;
  for (int i = 2; i < argc; ++i) g.read(argv[i]);
  g.check_kinds();
  std::ofstream h(std::string(argv[1]) + "/nodes.h"), rows(std::string(argv[1]) + "/node_rows.cpp");
  g.write_header(h);
  g.write_rows(rows);
  return h.good() && rows.good() ? 0 : 1;
}
