#include "parsers/vrml/node_pattern.h"

#include <algorithm>

#include "parsers/vrml/repeated_lists.h"

namespace wrlkit::vrml {

void NodePattern::learn(const Scene& scene, std::string_view text, std::uint32_t base, NodeId first,
                        std::span<const List> lists) {
  forget();
  std::size_t in_lists = 0;
  for (const List& list : lists) in_lists += list.text.size();
  if (lists.empty() || lists.size() > most_lists || text.size() - in_lists > longest) return;
  first_ = first;
  pieces_.clear();
  piece_ends_.clear();
  lists_.resize(lists.size());
  const char* at = text.data();
  auto add_piece = [&](const char* end) {
    pieces_.append(at, end);
    piece_ends_.push_back(static_cast<std::uint32_t>(pieces_.size()));
  };
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const List& list = lists[i];
    add_piece(list.text.data());
    at = list.text.data() + list.text.size();
    lists_[i].node = list.node.value - first.value;
    lists_[i].slot = list.slot;
    lists_[i].type = list.type;
    lists_[i].is_short = list.text.size() < RepeatedLists::shortest;
    lists_[i].text = lists_[i].is_short ? list.text : std::string_view();
  }
  add_piece(text.data() + text.size());
  if (!learn_nodes(scene, base, text, lists)) forget();
}

bool NodePattern::learn_nodes(const Scene& scene, std::uint32_t base, std::string_view text,
                              std::span<const List> lists) {
  fields_.clear();
  std::size_t n_lists = 0;
  for (NodeId n = first_; n.value < scene.node_count(); ++n.value) {
    if (!scene.name(n).empty() || scene.type(n).kind != NodeKind::builtin) return false;
    const std::uint32_t at = scene.where(n).begin - base;  // in the text
    std::uint32_t piece = 0, begin = 0;
    for (const List& list : lists) {
      const auto end = static_cast<std::uint32_t>(list.text.data() + list.text.size() - text.data());
      if (end > at) break;
      begin = end;
      ++piece;
    }
    const auto fields = scene.fields(n);
    nodes_.push_back({scene.type_id(n), piece, at - begin, static_cast<std::uint32_t>(fields_.size()),
                      static_cast<std::uint32_t>(fields.size())});
    for (const Value& v : fields) {
      if (scene.is_extra(v) || v.is) return false;
      const auto list = std::ranges::find_if(lists, [&](const List& l) { return l.node == n && l.slot == v.slot; });
      const auto i = static_cast<std::uint32_t>(list - lists.begin());
      if (list != lists.end()) lists_[i].value = v;
      n_lists += list != lists.end();
      fields_.push_back({v, list == lists.end() ? no_list : i});
    }
  }
  return n_lists == lists.size();
}

std::uint32_t NodePattern::match(std::string_view text, std::vector<List>& lists) const {
  lists.clear();
  std::size_t at = 0, begin = 0;
  for (std::size_t i = 0; i < piece_ends_.size(); ++i) {
    const auto piece = std::string_view(pieces_).substr(begin, piece_ends_[i] - begin);
    begin = piece_ends_[i];
    if (!text.substr(at).starts_with(piece)) return 0;
    at += piece.size();
    if (i == lists_.size()) break;
    const auto end = text.find(']', at);
    if (end == text.npos) return 0;
    lists.push_back({text.substr(at, end - at), NodeId{lists_[i].node}, lists_[i].slot, lists_[i].type});
    at = end;
  }
  return static_cast<std::uint32_t>(at);
}

void NodePattern::make(Scene& scene, std::uint32_t where, std::string_view text, std::span<const List> lists,
                       std::span<const Value> values) {
  const auto by = static_cast<std::uint32_t>(scene.node_count()) - first_.value;
  for (const Node& node : nodes_) {
    const auto begin =
        node.piece == 0 ? 0 : lists[node.piece - 1].text.data() + lists[node.piece - 1].text.size() - text.data();
    scene.add(node.type, {where + static_cast<std::uint32_t>(begin) + node.offset, 1});
  }
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    values_.clear();
    for (const Field& f : std::span(fields_).subspan(nodes_[i].first_field, nodes_[i].n_fields))
      values_.push_back(f.list == no_list ? moved(scene, f.value, by) : values[f.list]);
    scene.set_fields(NodeId{first_.value + by + i}, values_);
  }
}

/// References to the nodes themselves are to the new ones.
Value NodePattern::moved(Scene& scene, Value v, std::uint32_t by) const {
  auto now = [&](NodeId n) { return n && n.value >= first_.value ? NodeId{n.value + by} : n; };
  if (v.type == FieldType::SFNode) v.node = now(v.node);
  if (v.type != FieldType::MFNode) return v;
  NodeId* nodes = scene.arena().allocate<NodeId>(v.count);
  std::ranges::transform(v.node_span(), nodes, now);
  v.nodes = nodes;
  return v;
}

}  // namespace wrlkit::vrml
