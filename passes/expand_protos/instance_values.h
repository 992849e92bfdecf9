// Values of prototype instances that no node of the body takes, such as the tags of CAD exporters. Once the instance is
// its body, they are metadata of it:
//
//   PROTO Pump [ field SFString tag "" ] { Transform {} }   Pump { tag "P-101" }
//   ->  Transform { metadata MetadataSet { name "Pump" value [ MetadataString { name "tag" value "P-101" } ] } }
#pragma once
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "passes/analysis/prototypes.h"

namespace wrlkit {

class InstanceValues {
 public:
  struct Unused {
    std::string_view name;
    Value value;
  };

  InstanceValues(Scene& scene, Prototypes& prototypes, Diagnostics& diag)
      : scene_(scene), prototypes_(prototypes), diag_(diag) {}

  /// What the instance gives and its body does not take. `whole`: all nodes of the body stay, not only the first one
  /// and what it holds.
  std::vector<Unused> unused(NodeId instance, const Prototype&, bool whole);
  /// The instance says them as metadata, in addition to what is said of it already. Before it becomes its body.
  void add(NodeId instance, std::span<const Unused>);
  /// The metadata of `other`, but for the first of its sets.
  void add_like(NodeId instance, NodeId other, std::size_t without);
  std::size_t n_sets(NodeId n) const;
  /// Gives the nodes their metadata, when all instances have become what they are.
  void finish();

 private:
  using Names = std::unordered_set<std::string_view>;
  const Names& taken(ProtoId body, bool whole);
  NodeId set_of(NodeId instance, std::span<const Unused>);
  NodeId member(NodeId instance, const Unused&);

  Scene& scene_;
  Prototypes& prototypes_;
  Diagnostics& diag_;
  std::unordered_map<std::uint64_t, Names> taken_;
  std::unordered_map<std::uint32_t, std::vector<NodeId>> sets_;  // by instance; of a prototype before those in its body
};

}  // namespace wrlkit
