#include "tools/gen_nodes/table.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

namespace gen_nodes {

using wrlkit::Element;
using wrlkit::FieldType;

namespace {

std::string file;
int line_number = 0;

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

std::vector<std::string> split(const std::string& s, const char* separators) {
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
    else if (w.starts_with("mesh="))
      n.maker = w.substr(5);
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

}  // namespace

void fail(const std::string& why) {
  std::fprintf(stderr, "%s:%d: %s\n", file.c_str(), line_number, why.c_str());
  std::exit(1);
}

FieldType type_of(const std::string& name) {
  FieldType t{};
  if (!wrlkit::find_field_type(name, t)) fail("no field type " + name);
  return t;
}

int dialects(const std::string& clauses) {
  int d = 0;
  for (auto& w : split(clauses, " ;,"))
    d |= w == "vrml1" ? 1 : w == "vrml97" ? 2 : w == "x3d" ? 4 : w == "wrlkit" ? 8 : 0;
  return d;
}

void NodeTable::add_bases(const Node& n, std::vector<std::string>& out) const {
  for (auto& b : n.bases) {
    if (std::ranges::find(out, b) != out.end()) continue;
    out.push_back(b);
    add_bases(bases_.at(b), out);
  }
}

std::vector<std::string> NodeTable::all_bases(const Node& n) const {
  std::vector<std::string> out;
  add_bases(n, out);
  return out;
}

std::string NodeTable::container(const Node& n) const {
  if (!n.container.empty()) return n.container;
  for (auto& b : n.bases)
    if (auto c = container(bases_.at(b)); !c.empty()) return c;
  return {};
}

Node* NodeTable::begin_node(Node n) {
  if (!seen_.insert(n.name + (n.abstract ? "" : "/" + std::to_string(dialects(n.clauses)))).second)
    fail("node twice: " + n.name);
  for (auto& b : n.bases)
    if (!bases_.contains(b)) fail("no base " + b);
  if (n.abstract && bases_.size() == 64) fail("a BaseSet has 64 bits");
  if (n.abstract) return &(bases_[n.name] = n);
  if (!dialects(n.clauses)) fail("node in no dialect: " + n.name);
  return &nodes_.emplace_back(std::move(n));
}

void NodeTable::add_field(Node* n, const std::string& text, const std::string& doc) {
  if (!n) fail("field outside a node");
  Field f = read_field(text, doc);
  if (std::ranges::find(n->fields, f.name, &Field::name) != n->fields.end()) fail("field twice: " + f.name);
  n->fields.push_back(std::move(f));
}

void NodeTable::read(const char* path) {
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
    const auto body = trim(text);
    if (body.starts_with('#') || (body.empty() && doc.empty())) continue;
    const bool abstract = body.starts_with("base ");
    if (abstract || body.starts_with("node ")) {
      Node n = read_head(body, abstract);
      n.doc = doc;
      current = begin_node(std::move(n));
    } else if (!body.empty())
      add_field(current, body, doc);
    else if (current)
      current->doc += (current->doc.empty() ? "" : " ") + doc;
  }
}

void NodeTable::check_kinds() const {
  std::set<std::string> names;
  for (auto& n : nodes_) names.insert(n.name);
  for (auto& n : nodes_)
    for (auto& f : n.fields) {
      auto e = wrlkit::info(type_of(f.type)).element;
      if (e != Element::node) continue;
      for (auto& k : f.kinds)
        if (!names.count(k) && !bases_.count(k)) {
          std::fprintf(stderr, "%s.%s: no node or base %s\n", n.name.c_str(), f.name.c_str(), k.c_str());
          std::exit(1);
        }
    }
}

}  // namespace gen_nodes
