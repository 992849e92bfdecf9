// Nodes of VRML 1.0 and Inventor in a file of VRML97, as programs that are built on Coin write and draw them. A name
// that both languages have is VRML97's, as in Coin, unless the fields say otherwise.
#include <optional>

#include "parsers/vrml/grammar.h"

namespace wrlkit::vrml {

NodeId Parser::child_statement() {
  among_children_ = true;
  const NodeId n = node_statement();
  among_children_ = false;
  return n;
}

TypeId Parser::node_type(Token name, bool among_children) {
  const auto w = name_of(name);
  const TypeId old = among_children && scene_.dialect() == Dialect::vrml97 ? find_builtin(w, Dialect::vrml1) : TypeId{};
  if (!old) return build_.type(w, span(name));
  TypeId now = build_.known_type(w);
  if (!now) now = find_builtin(w, Dialect::x3d);
  const NodeType* other = now ? &scene_.type(now) : nullptr;
  const bool own = other && other->kind != NodeKind::builtin;
  const bool groups = other && (other->name == "Group" || other->name == "Transform");
  if (own || groups || !reads_as_vrml1(scene_.type(old), other)) return build_.type(w, span(name));
  return build_.vrml1_type(w, span(name));
}

// The first field that only one of the two has decides. Without one, what VRML97 has nowhere among children or cannot
// draw without a `coord` is VRML 1.0's; of Materials, which may be defined there for Shapes further down, those of
// nodes of VRML 1.0 and those with lists. Browsers have a MatrixTransform with `children`.
bool Parser::reads_as_vrml1(const NodeType& old, const NodeType* now) {
  const auto at = lex_.offset();
  const bool material = old.name == "Material";
  std::optional<bool> decided;
  while (!decided) {
    const Token t = lex_.next();
    if (t.kind == Kind::end || t.kind == Kind::close_brace) break;
    if (material && t.kind == Kind::open_bracket) decided = true;
    if (!name_like(t)) continue;
    const auto w = text(t);
    const bool is_old = w != "children" && old.find(w, Dialect::vrml1), is_now = now && now->find(w, Dialect::vrml97);
    if (node_follows(t))
      decided = old.is_a(nodes::Vrml1GroupNode);
    else if (!now && w == "children")
      decided = false;
    else if (now && is_old != is_now)
      decided = is_old;
  }
  lex_.seek(at);
  if (decided) return *decided;
  if (material) return in_vrml1();
  if (!now) return true;
  return !now->is_a(nodes::X3DChildNode) &&
         (old.is_a(nodes::Vrml1PropertyNode) || now->find("coord", Dialect::vrml97).has_value());
}

}  // namespace wrlkit::vrml
