// The Scripts of a world while they start: what they ask for, and the events of that instant.
#pragma once
#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "passes/pipeline/pass.h"
#include "passes/startup/host.h"
#include "passes/startup/wire.h"

namespace wrlkit {

class ScriptRun {
 public:
  /// Changes `scene`, also when it fails: what is to stay as it was works on a copy.
  ScriptRun(Scene& scene, PassContext& ctx);

  bool start(const std::string& path) { return host_.start(path); }
  /// Calls `initialize` of a Script, and whatever its events lead to. False when nothing runs any more.
  bool initialize(NodeId script);
  const std::string& fault() const { return host_.fault(); }
  /// The Script whose function was running when it ended.
  NodeId running() const { return running_; }

  /// Fields that were set, with the values they had, in the order in which they were set first.
  struct Change {
    NodeId node;
    std::uint16_t slot;
    std::string before;  // value_text
  };
  const std::vector<Change>& changes() const { return changes_; }
  std::size_t n_events() const { return n_events_; }
  std::size_t n_made() const { return made_nodes_; }
  /// ROUTEs or roots are others.
  bool changed_graph() const { return changed_graph_; }

 private:
  struct Event {
    NodeId from;
    std::uint16_t slot;  // of the sender; of `to` when it has no ROUTE
    Value value;
    NodeId to{};  // of a Script that another one has set by directOutput
    std::string_view event_in{};
  };
  using End = std::pair<std::uint32_t, std::uint16_t>;  // a field of a node

  // Scripts (script_run.cpp).
  bool load(NodeId script);
  std::string interface_of(NodeId script) const;
  bool call(NodeId script, std::string_view function, const Value* value, std::string_view field);
  void take_result(NodeId script, std::string_view function, std::string_view result);
  bool cascade();
  void add_route(const Route&);
  std::optional<std::uint16_t> slot_of(NodeId, std::string_view event) const;
  bool send(const Event&);
  bool deliver(const Event&, NodeId to, std::uint16_t slot, std::string_view event_in);
  bool deliver_input(const Event&, NodeId to, const FieldDef&, std::string_view event_in);
  void add_or_remove_children(NodeId group, const Value& children, bool add);
  bool set(NodeId, Value);

  // What Scripts ask for (requests.cpp).
  std::string answer(std::string_view request);
  void get(Json, JsonOut&);
  void set_field(Json, JsonOut&);
  void create(Json, JsonOut&);
  void route(Json, JsonOut&, bool add);
  void describe(Json, JsonOut&) const;
  void find_named(Json, JsonOut&) const;
  void add_root(Json);
  NodeId node_in(Json request, std::string_view key) const;
  bool may_change(NodeId) const;

  Scene& scene_;
  PassContext& ctx_;
  ScriptHost host_;
  NodeId running_;
  std::map<std::uint32_t, bool> loaded_;  // Scripts, and whether they run
  std::map<End, std::vector<Route>> routes_;
  std::set<std::uint32_t> entered_;  // Scripts that events lead to
  std::deque<Event> queue_;
  std::set<End> sent_;  // eventOuts of this instant
  std::vector<Change> changes_;
  std::set<End> changed_;
  std::set<std::uint32_t> touched_;  // Scripts with a function that has run in this instant
  std::size_t n_events_ = 0, n_routes_ = 0, made_text_ = 0, made_texts_ = 0, made_nodes_ = 0, first_made_;
  bool changed_graph_ = false;
};

}  // namespace wrlkit
