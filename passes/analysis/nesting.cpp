#include "passes/analysis/nesting.h"

#include <algorithm>
#include <vector>

#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::uint16_t deepest = 1000;  // as in files, see ParseLimits

class Nesting {
 public:
  Nesting(Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag), height_(scene.node_count(), fresh) {}

  void run() {
    for_each_scope(scene_, [&](const Scope& s) { scope(s); });
  }

 private:
  enum : std::uint16_t {
    fresh = 0,
    open = 0xffff
  };  // otherwise: how many nodes stand below each other, this one included

  void scope(const Scope& s) {
    todo_.assign(s.roots.rbegin(), s.roots.rend());
    while (!todo_.empty()) {
      NodeId n = todo_.back();
      if (height_[n.value] == fresh) {
        height_[n.value] = open;
        for_each_child(scene_, n, [&](NodeId c) {
          if (height_[c.value] == fresh) todo_.push_back(c);
        });
        continue;
      }
      todo_.pop_back();
      if (height_[n.value] == open) close(n);
    }
  }

  /// All nodes below `n` are done. Those that are still open have `n` below them.
  void close(NodeId n) {
    bool faulty = false;
    std::uint16_t height = 0;
    for_each_child(scene_, n, [&](NodeId c) {
      if (!fits(n, c))
        faulty = report(n, c);
      else if (height_[c.value] != open)
        height = std::max(height, height_[c.value]);
    });
    if (faulty) take_out(n);
    height_[n.value] = static_cast<std::uint16_t>(height + 1);
  }

  bool fits(NodeId parent, NodeId child) const {
    if (height_[child.value] != open) return height_[child.value] < deepest;
    auto kind = scene_.type(parent).kind;
    return kind == NodeKind::script || kind == NodeKind::proto;
  }

  bool report(NodeId parent, NodeId child) {
    if (height_[child.value] == open)
      diag_.report(Diag::use_cycle, scene_.where(parent), scene_.name(child));
    else
      diag_.report(Diag::too_deep, scene_.where(child), deepest);
    return true;
  }

  void take_out(NodeId parent) {
    std::vector<Value> fields;
    for (const Value& v : scene_.fields(parent)) {
      const Value& content = scene_.content(v);
      std::vector<NodeId> left;
      std::ranges::copy_if(content.node_span(), std::back_inserter(left), [&](NodeId c) { return fits(parent, c); });
      if (left.size() == content.node_span().size()) {
        fields.push_back(v);
        continue;
      }
      if (!info(content.type).multiple) continue;
      Value list = scene_.make(content.type, v.slot, left);
      fields.push_back(scene_.is_extra(v) ? scene_.make_extra(v.extra->name, list) : list);
    }
    scene_.set_fields(parent, fields);
  }

  Scene& scene_;
  Diagnostics& diag_;
  std::vector<std::uint16_t> height_;
  std::vector<NodeId> todo_;
};

}  // namespace

void limit_nesting(Scene& scene, Diagnostics& diag) { Nesting(scene, diag).run(); }

}  // namespace wrlkit
