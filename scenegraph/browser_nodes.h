// Nodes that browsers added to the standards. A file may hold them without a declaration; they are kept as they are.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace wrlkit {

struct BrowserNode {
  /// Whether the node itself was only a group of what is drawn, or showed or did something that is lost.
  enum class Fate : std::uint8_t { below, drawn, kept };
  std::string_view name;
  std::string_view browser;
  Fate fate;
  std::string_view what;  // what it shows or does
};

/// All of them, in the order of browser_nodes.def.
std::span<const BrowserNode> browser_nodes();
/// The one of that name; null when there is none. O(1).
const BrowserNode* find_browser_node(std::string_view name);

}  // namespace wrlkit
