// What a pass that makes fewer nodes of many cannot keep of what was said of them: metadata and unknown fields.
#pragma once
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

class TagWatch {
 public:
  /// Before the pass. O(nodes).
  explicit TagWatch(const Scene&);
  /// After it: reports what nothing holds any more. O(nodes) where there was something.
  void report_lost(const Scene&, std::string_view pass, Diagnostics&) const;

 private:
  std::vector<Value> tags_;
};

}  // namespace wrlkit
