// Values that are nodes: SFNode and MFNode, and what stands for them in files that are not quite right.
#include <algorithm>

#include "parsers/vrml/grammar.h"

namespace wrlkit::vrml {

bool Parser::node_list_follows() {
  auto at = lex_.offset();
  lex_.next();
  Token first = lex_.peek();
  bool yes = node_follows(first);
  lex_.seek(at);
  return yes;
}

bool Parser::single_node(std::uint16_t slot, std::string_view field, Value& out) {
  Token t = lex_.peek();
  NodeId n;
  if (t.kind == Kind::open_bracket && !node_list_follows()) {
    if (!property_node(slot, n)) {
      expected("a node", t);
      lex_.next();
      skip_list();
      return false;
    }
  } else if (t.kind == Kind::open_bracket) {
    Value list;
    diag_.report(Diag::extra_bracket, span(t), field);
    node_list(slot, list);
    if (list.count) n = list.nodes[0];
  } else if (name_like(t) && node_follows(t)) {
    n = node_statement();
  } else {
    expected("a node", t);
    return false;
  }
  out = scene_.make(FieldType::SFNode, slot, n);
  return true;
}

// `color [ 1 0 0 ]` where a Color node belongs: the node that holds such a list and nothing else is put around it.
bool Parser::property_node(std::uint16_t slot, NodeId& out) {
  if (build_.depth() == 0 || slot >= build_.current_type().fields.size())
    return false;  // a field that the file declares
  const auto& def = build_.current_type().fields[slot];
  for (std::uint32_t i = 0; i < builtin_nodes().size(); ++i) {
    const auto& t = builtin_nodes()[i];
    const bool list = !t.fields.empty() && t.fields[0].has_value() && info(t.fields[0].type).multiple &&
                      info(t.fields[0].type).element == Element::number;
    bool fits = list && t.is_a(nodes::X3DGeometricPropertyNode) && def.accepts(t);
    if (!fits) continue;
    Token first = lex_.peek();
    diag_.report(Diag::list_repaired, span(first), t.name);
    out = build_.open(TypeId{i}, {}, span(first));
    known_field(0, t.fields[0], first);
    build_.close();
    return true;
  }
  return false;
}

// The nodes are collected on one stack for all open lists.
bool Parser::node_list(std::uint16_t slot, Value& out) {
  const auto mark = nodes_.size(), misplaced_before = misplaced_.size();
  const bool children = slot != Value::extra_slot && holds_children(slot);
  Token first = lex_.peek();
  if (first.kind != Kind::open_bracket) {
    if (!name_like(first) || !node_follows(first)) {
      expected("a node or '['", first);
      return false;
    }
    if (NodeId n = children ? child_statement() : node_statement()) nodes_.push_back(n);
  } else {
    lex_.next();
    ++open_lists_;
    list_elements(first, children);
    --open_lists_;
  }
  take_misplaced(misplaced_before, [&](NodeId m) { nodes_.push_back(m); });
  if (children)
    for (auto& n : std::span(nodes_).subspan(mark)) n = shape_around(n);
  out = scene_.make(FieldType::MFNode, slot, std::span<const NodeId>(nodes_).subspan(mark));
  nodes_.resize(mark);
  return true;
}

// Geometry among children gets a Shape of its own.
bool Parser::holds_children(std::uint16_t slot) const {
  if (build_.depth() == 0 || slot >= build_.current_type().fields.size()) return false;
  auto kinds = build_.current_type().fields[slot].kinds;
  return std::ranges::find(kinds, "X3DChildNode") != kinds.end();
}

NodeId Parser::shape_around(NodeId n) {
  if (!scene_.is(n, nodes::X3DGeometryNode)) return n;
  diag_.report(Diag::shape_repaired, scene_.where(n), scene_.type(n).name);
  NodeId shape = scene_.add(nodes::Shape, scene_.where(n));
  scene_.set(shape, nodes::shape::geometry, n);
  return shape;
}

void Parser::list_elements(Token opened, bool children) {
  NodePattern& before = begin_pattern();
  for (;;) {
    Token t = lex_.peek();
    if (ends(t, Kind::close_bracket, opened)) return;
    if (t.kind == Kind::close_brace) {
      expected("']'", t);
      return;
    }  // the bracket is missing
    if (statement(t)) {
      before.forget();  // the same words may mean another thing now
      continue;
    }
    if (name_like(t) && node_follows(t)) {
      if (text(t) == "NULL") diag_.report(Diag::null_repaired, span(t));
      const auto mark = misplaced_.size();
      if (NodeId n = next_node(children, before)) nodes_.push_back(n);
      take_misplaced(mark, [&](NodeId m) { nodes_.push_back(m); });
      continue;
    }
    expected("a node", t);
    lex_.next();
    if (t.kind == Kind::open_brace) skip_to_close(Kind::open_brace, Kind::close_brace);
    if (t.kind == Kind::open_bracket) skip_to_close(Kind::open_bracket, Kind::close_bracket);
  }
}

}  // namespace wrlkit::vrml
