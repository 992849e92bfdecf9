#include "scenegraph/browser_nodes.h"

#include <unordered_map>

namespace wrlkit {
namespace {

constexpr BrowserNode rows[] = {
#define BROWSER_NODE(name, browser, fate, what) {#name, browser, BrowserNode::Fate::fate, what},
#include "scenegraph/browser_nodes.def"
#undef BROWSER_NODE
};

}  // namespace

std::span<const BrowserNode> browser_nodes() { return rows; }

const BrowserNode* find_browser_node(std::string_view name) {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const BrowserNode*> map;
    for (const BrowserNode& n : rows) map.emplace(n.name, &n);
    return map;
  }();
  const auto i = by_name.find(name);
  return i == by_name.end() ? nullptr : i->second;
}

}  // namespace wrlkit
