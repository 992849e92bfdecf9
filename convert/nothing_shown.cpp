#include "convert/nothing_shown.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "convert/expanded_copy.h"
#include "convert/hidden_geometry.h"
#include "scenegraph/nodes.h"
#include "scenegraph/switches.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_listed = 4;

bool is_instance(const Scene& scene, NodeId n) { return scene.type(n).kind == NodeKind::proto; }

/// What is drawn, the sky too, or may be for all that is known.
bool draws(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::X3DGeometryNode) || scene.is(n, nodes::X3DShapeNode) ||
         scene.is(n, nodes::X3DBackgroundNode) || scene.is(n, nodes::Vrml1ShapeNode) || scene.is(n, nodes::Inline) ||
         scene.is(n, nodes::vrml1::WWWInline) || scene.is(n, nodes::vrml1::File) ||
         scene.type(n).kind == NodeKind::unknown;
}

std::vector<NodeId> shown(const Scene& scene, NodeId n) {
  if (is_switch(scene, n)) return shown_of_switch(scene, n);
  std::vector<NodeId> out;
  for_each_child(scene, n, [&](NodeId c) { out.push_back(c); });
  return out;
}

enum class Answer : std::uint8_t { no, perhaps, yes };  // perhaps: there are instances of prototypes

/// Looks for what is drawn; `all`: or would be, were every Switch on. What draws nothing is gone through once, however
/// many fields hold it.
class Search {
 public:
  Search(const Scene& scene, bool all) : scene_(scene), all_(all), seen_(scene.node_count()) {}

  /// Of the nodes that have not been asked for: everything below those that have been draws nothing.
  Answer is_drawn(std::span<const NodeId> roots) {
    Answer out = Answer::no;
    std::vector<NodeId> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      check_stop();
      const NodeId n = stack.back();
      stack.pop_back();
      if (std::exchange(seen_[n.value], 1)) continue;
      if (draws(scene_, n)) return Answer::yes;
      if (is_instance(scene_, n)) out = Answer::perhaps;
      push_below(n, stack);
    }
    return out;
  }

 private:
  void push_below(NodeId n, std::vector<NodeId>& stack) const {
    if (scene_.type(n).kind == NodeKind::script) return;
    if (all_) return for_each_child(scene_, n, [&](NodeId c) { stack.push_back(c); });
    if (is_instance(scene_, n)) return;
    for (const NodeId c : shown(scene_, n)) stack.push_back(c);
  }

  const Scene& scene_;
  bool all_;
  std::vector<char> seen_;
};

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), most_listed); ++i) out += (i ? ", " : "") + names[i];
  return out + (names.size() > most_listed ? ", ..." : "");
}

/// An instance whose field holds what its prototype does not draw.
struct Ignored {
  NodeId instance;
  std::string field;
};

std::optional<Ignored> ignored_field(const Scene& scene) {
  Search search(scene, true);
  for (const NodeId n : reachable(scene, scene.main)) {
    if (!is_instance(scene, n)) continue;
    for (const Value& v : scene.fields(n)) {
      if (search.is_drawn(scene.content(v).node_span()) == Answer::yes)
        return Ignored{n, std::string(scene.field_name(n, v))};
    }
  }
  return std::nullopt;
}

std::vector<std::string> proto_names(const Scene& scene) {
  std::vector<std::string> out;
  for (const ProtoId p : scene.main.protos) out.emplace_back(scene.type(scene.proto(p).type).name);
  return out;
}

/// Those that there are most of, first.
std::vector<std::string> types_of(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const NodeId n : reachable(scene, scene.main)) --counts[std::string(scene.type(n).name)];
  std::vector<std::pair<int, std::string>> order;
  for (const auto& [name, n] : counts) order.emplace_back(n, name);
  std::ranges::sort(order);
  std::vector<std::string> out;
  for (auto& [n, name] : order) out.push_back(std::move(name));
  return out;
}

/// `hidden`: something would be drawn, were every Switch on.
void report_cause(const Scene& scene, bool hidden, Diagnostics& diag) {
  const auto report = [&](Span where, const std::string& cause) { diag.report(Diag::nothing_shown, where, cause); };
  const Span first = scene.where(scene.main.roots[0]);
  if (hidden) return report(first, "all of it is in Switches that are off; use --show-all or the pass switch");
  if (const auto found = ignored_field(scene))
    return report(scene.where(found->instance), "prototype '" + std::string(scene.type(found->instance).name) +
                                                    "' does not draw what its field '" + found->field + "' holds");
  report(first, "it has no geometry, but only " + listed(types_of(scene)));
}

void report_without_roots(const Scene& scene, Diagnostics& diag) {
  if (scene.main.protos.empty() && diag.has_errors()) return;  // nothing could be read
  if (scene.main.protos.empty()) return diag.report(Diag::nothing_shown, scene.file, "it holds no node");
  diag.report(Diag::nothing_shown, scene.proto(scene.main.protos[0]).where,
              "its prototypes (" + listed(proto_names(scene)) + ") are declared, and none of them is used");
}

/// `hidden_told`: what its Switches hide has been reported.
void report_nothing_shown(const Scene& scene, bool hidden_told, Diagnostics& diag) {
  if (scene.main.roots.empty()) return report_without_roots(scene, diag);
  if (Search(scene, false).is_drawn(scene.main.roots) == Answer::yes) return;
  // Switches may be in prototypes, and prototypes in Switches.
  const Scene expanded = expanded_copy(scene, nullptr, diag);
  const auto& roots = expanded.main.roots;
  if (Search(expanded, false).is_drawn(roots) != Answer::no) return;
  const bool hidden = Search(expanded, true).is_drawn(roots) != Answer::no;
  if (!hidden || !hidden_told) report_cause(scene, hidden, diag);
}

}  // namespace

void report_undrawn(const Scene& scene, Resources* files, Diagnostics& diag) {
  const auto before = diag.count(Diag::hidden_geometry);  // of other files
  report_hidden_geometry(scene, files, diag);
  report_nothing_shown(scene, diag.count(Diag::hidden_geometry) > before, diag);
}

}  // namespace wrlkit
