// The ROUTEs of a scene, by the nodes that they touch.
#pragma once
#include <unordered_map>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

class RouteTable {
 public:
  explicit RouteTable(std::vector<Route> routes) : routes_(std::move(routes)) {
    for (std::size_t i = 0; i < routes_.size(); ++i) index(i);
  }
  void add(const Route& r) {
    routes_.push_back(r);
    index(routes_.size() - 1);
  }
  bool touches(NodeId n) const { return by_node_.count(n.value); }

  /// The ROUTEs from and to a node, which are in the table no more.
  std::vector<Route> take(NodeId n) {
    std::vector<Route> taken;
    auto found = by_node_.find(n.value);
    if (found == by_node_.end()) return taken;
    for (std::size_t i : found->second)
      if (Route r = std::exchange(routes_[i], {}); r.from) taken.push_back(r);
    by_node_.erase(found);
    return taken;
  }

  std::vector<Route> all() && {
    std::erase_if(routes_, [](const Route& r) { return !r.from; });
    return std::move(routes_);
  }

 private:
  void index(std::size_t i) {
    by_node_[routes_[i].from.value].push_back(i);
    if (routes_[i].to != routes_[i].from) by_node_[routes_[i].to.value].push_back(i);
  }

  std::vector<Route> routes_;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> by_node_;
};

}  // namespace wrlkit
