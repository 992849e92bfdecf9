// Looks through a scene for what is drawn, as far as nodes tell without their meshes.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "scenegraph/scene.h"

namespace wrlkit {

enum class IsDrawn : std::uint8_t { no, perhaps, yes };

/// Ask: IsDrawn(NodeId) of the node alone. Below: void(NodeId, std::vector<NodeId>& stack) adds the nodes below it that
/// are to be asked, too. A node is asked once, however many fields hold it.
template <class Ask, class Below>
class DrawnSearch {
 public:
  DrawnSearch(const Scene& scene, Ask ask, Below below)
      : ask_(std::move(ask)), below_(std::move(below)), seen_(scene.node_count()) {}

  /// The surest answer of the nodes that have not been asked before: everything below those that have been draws
  /// nothing. Ends at the first yes. O(nodes).
  IsDrawn operator()(std::span<const NodeId> roots) {
    IsDrawn out = IsDrawn::no;
    std::vector<NodeId> stack(roots.rbegin(), roots.rend());
    while (!stack.empty() && out != IsDrawn::yes) {
      check_stop();
      const NodeId n = stack.back();
      stack.pop_back();
      if (std::exchange(seen_[n.value], 1)) continue;
      out = std::max(out, ask_(n));
      below_(n, stack);
    }
    return out;
  }

 private:
  Ask ask_;
  Below below_;
  std::vector<char> seen_;
};

}  // namespace wrlkit
