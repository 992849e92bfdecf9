// The part of the parser that compares a node with its neighbour before it reads it (node_pattern.h).
#include <array>

#include "parsers/vrml/grammar.h"
#include "parsers/vrml/node_pattern.h"

namespace wrlkit::vrml {

/// The one for the nodes of a list that is being opened, or of a scope.
NodePattern& Parser::begin_pattern() {
  const auto depth = open_lists_ + scope_depth_;
  if (patterns_.size() <= depth) patterns_.resize(depth + 1);
  patterns_[depth].forget();
  return patterns_[depth];
}

NodeId Parser::next_node(bool children, NodePattern& before) {
  if (NodeId n = node_again(before)) {
    forget_lists();
    return n;
  }
  const auto begin = lex_.peek().begin;
  const NodeId first{static_cast<std::uint32_t>(scene_.node_count())};
  const auto n_lists = lists_met_.size();
  const auto state = [&] {
    return std::array{diag_.count(), misplaced_.size(), n_statements_, scene_.own_types().size()};
  };
  const auto state_before = state();
  const NodeId n = children ? child_statement() : node_statement();
  before.forget();
  const bool few = scene_.node_count() <= first.value + NodePattern::most_nodes;
  if (few && n == first && state() == state_before)
    before.learn(scene_, lex_.text(begin, lex_.offset()), base_ + begin, first, std::span(lists_met_).subspan(n_lists));
  forget_lists();
  return n;
}

/// What holds a node may be learnt with it, if it has no more nodes than that.
void Parser::forget_lists() {
  if (build_.depth() == 0 || scene_.node_count() > build_.current().value + NodePattern::most_nodes) lists_met_.clear();
}

NodeId Parser::node_again(NodePattern& pattern) {
  if (pattern.empty()) return {};
  const auto begin = lex_.peek().begin;
  const auto rest = lex_.text(begin, lex_.size());
  const auto length = pattern.match(rest, lists_again_);
  if (length == 0) return {};
  const NodeId first{static_cast<std::uint32_t>(scene_.node_count())};
  if (first.value + pattern.n_nodes() > limits_.nodes || !read_again(pattern)) return {};
  // Nothing can be wrong with it any more.
  for (std::size_t i = 0; i < lists_again_.size(); ++i)
    if (const auto& list = lists_again_[i]; is_for_others(list.text))
      values_again_[i] = lists_->add(list.text, list.type, list.slot, NodeId{list.node.value + first.value});
  pattern.make(scene_, base_ + begin, rest, lists_again_, values_again_);
  for (const auto& list : lists_again_)
    lists_met_.push_back({list.text, NodeId{list.node.value + first.value}, list.slot, list.type});
  lex_.seek(begin + length);
  if (part_read_) tell_part_read();
  return first;
}

/// The lists that are not for other threads. False: one has to be read in full, for there is something to say of it.
bool Parser::read_again(const NodePattern& pattern) {
  values_again_.resize(lists_again_.size());
  for (std::size_t i = 0; i < lists_again_.size(); ++i) {
    const auto& list = lists_again_[i];
    if (is_for_others(list.text)) continue;
    if (const Value* known = pattern.known(i, list.text))
      values_again_[i] = *known;
    else if (!plain_list(list.text, lex_.limit(), list.type, list.slot, values_again_[i]))
      return false;
  }
  return true;
}

}  // namespace wrlkit::vrml
